//! Generates `choose`: the candidates in the machine's order, and the environment that picks one.
//!
//! Candidates are listed before the environment picks one, unless a candidate can be computed from its number.
//! Variables that range over all numbers of a kind are drawn.

use model::Basic;
use program::{Binder, BinderList, DomainId, DomainKind, RuleId, TermId};

use crate::model::code::unwrapped;
use crate::model::generator::Generator;
use crate::model::interval::Interval;
use crate::model::plan::{gapless, integer};
use crate::model::selection::{Selection, drawn, selection};
use crate::model::text::Text;
use crate::model::types::{Type, type_of};

/// LIMIT: how many candidates are stored in place; more go to the heap.
const CANDIDATES_IN_PLACE: u64 = 4096;

impl Generator<'_> {
    /// A choice among the bindings of the binders.
    pub fn choose(
        &mut self,
        list: BinderList,
        condition: Option<TermId>,
        body: RuleId,
        if_none: Option<RuleId>,
        id: RuleId,
        text: &mut Text,
    ) {
        let span = self.program.rule_span(id);
        let site = self.sites.number(span);
        let binders = self.program.binder_list(list).to_vec();
        text.open("{");
        self.draws(&binders, condition, site, text);
        let listed = match selection(self.program, self.plan, list, condition) {
            Selection::Drawn => {
                // There is one candidate, whose numbers were all drawn; the choice is still made.
                text.line(format!("(void)choose(1, {site});"));
                self.rule(body, text);
                text.close("}");
                return;
            }
            Selection::Picked(binder, domain, count) => {
                let picked = self.picked(domain, count, site);
                let ty = type_of(self.program, domain);
                let name = self.declare(binder.slot, ty, true, self.domain_interval(domain)).name;
                text.marked(span, format!("[[maybe_unused]] const {} {name} = {picked};", self.plan.cpp(ty, true)));
                self.rule(body, text);
                text.close("}");
                self.frame.scope.release(&name);
                return;
            }
            Selection::Listed(listed) => listed,
        };
        let candidates = self.fresh("candidates");
        let mut inner = Text::default();
        let mut types: Vec<String> = Vec::new();
        let mut variables = Vec::new();
        let size = self.ranging_over(&listed, &mut inner, &mut |this, text| {
            let guard = condition.and_then(|condition| this.guard_unless_true(condition));
            if let Some(guard) = &guard {
                text.open_marked(span, format!("if ({}) {{", unwrapped(guard)));
            }
            variables = listed.iter().filter_map(|binder| this.frame.slots[binder.slot.0 as usize].clone()).collect();
            let names: Vec<&str> = variables.iter().map(|variable| variable.name.as_str()).collect();
            types = variables.iter().map(|variable| this.plan.cpp(variable.ty, variable.defined)).collect();
            let item = match &names[..] {
                [one] => one.to_string(),
                many => format!("{{{}}}", many.join(", ")),
            };
            text.line(format!("{candidates}.add({item}, {site});"));
            if guard.is_some() {
                text.close("}");
            }
        });
        let item = match &types[..] {
            [one] => one.clone(),
            many => format!("std::tuple<{}>", many.join(", ")),
        };
        let dynamic = variables.iter().any(|variable| variable.ty == Type::Value);
        let place = match size {
            Some(size) if size <= CANDIDATES_IN_PLACE && !dynamic => size,
            _ => 0,
        };
        if place == 0 && self.options.bare {
            self.refuse(
                span,
                "the candidates of this choice have no bound known beforehand",
                "range over a finite domain",
            );
        }
        text.line(format!("gs::Candidates<{item}, {place}> {candidates};"));
        inner.pour(text);
        match if_none {
            Some(if_none) => {
                text.open_marked(span, format!("if ({candidates}.size() == 0) {{"));
                self.rule(if_none, text);
                text.between("} else {");
            }
            None => text.open_marked(span, format!("if ({candidates}.size() > 0) {{")),
        }
        let chosen: Vec<String> = listed
            .iter()
            .zip(&variables)
            .map(|(binder, variable)| self.declare(binder.slot, variable.ty, variable.defined, variable.range).name)
            .collect();
        let pick = format!("{candidates}[choose({candidates}.size(), {site})]");
        match &chosen[..] {
            [one] => text.line(format!("[[maybe_unused]] const {} {one} = {pick};", types[0])),
            many => text.line(format!("[[maybe_unused]] const auto [{}] = {pick};", many.join(", "))),
        }
        self.rule(body, text);
        text.close("}");
        text.close("}");
        chosen.iter().chain([&candidates]).for_each(|name| self.frame.scope.release(name));
    }

    /// Picks an element of a domain by its number.
    fn picked(&self, domain: DomainId, count: usize, site: u32) -> String {
        let plan = self.plan.domain(domain);
        let ordinal = |ty: &str| format!("gs::from_ordinal<{ty}>(static_cast<std::uint32_t>(choose({count}, {site})))");
        match (&self.program.domain(domain).kind, plan.contents.as_deref().and_then(gapless)) {
            (DomainKind::Concrete { .. }, Some(Interval { low, .. })) => {
                let chosen = format!("static_cast<std::int64_t>(choose({count}, {site}))");
                if low == 0 { chosen } else { format!("{} + {chosen}", integer(low)) }
            }
            (DomainKind::Basic(_), _) => ordinal("bool"),
            _ => ordinal(plan.name()),
        }
    }

    /// Draws the variables that range over all numbers of a kind.
    fn draws(&mut self, binders: &[Binder], condition: Option<TermId>, site: u32, text: &mut Text) {
        for (variable, binder) in binders.iter().enumerate() {
            let Some((domain, basic)) = drawn(self.program, binder, condition) else { continue };
            let ty = type_of(self.program, domain);
            let range = if basic == Basic::Natural { Interval::NATURAL } else { Interval::ALL };
            let name = self.declare(binder.slot, ty, true, range).name;
            let drawn = match basic {
                Basic::Natural => format!("gs::not_negative(environment_.integer({site}, {variable}), {site})"),
                Basic::Real => format!("gs::real(environment_.real({site}, {variable}), {site})"),
                _ => format!("environment_.integer({site}, {variable})"),
            };
            text.line(format!("[[maybe_unused]] const {} {name} = {drawn};", self.plan.cpp(ty, true)));
        }
    }
}
