//! Generates loops over binders: the ranges of quantifiers, comprehensions, choose and forall.
//!
//! The order is the machine's: literals and numbers ascending, elements in the order of their creation; of several
//! binders the leftmost varies slowest. Loops over scalars build no collection.

use model::{Basic, CollectionKind, Literal};
use program::{Binder, BinderList, DomainId, DomainKind, Term, TermId};

use crate::model::form::Form;
use crate::model::generator::{Generator, Table, Variable};
use crate::model::interval::Interval;
use crate::model::plan::integer;
use crate::model::term::real;
use crate::model::text::Text;
use crate::model::types::{Type, item_type, ordinals, type_of};

/// The class that iterates over a list.
fn items(solid: bool) -> &'static str {
    if solid { "solid_items" } else { "items" }
}

/// Generates the body of a loop.
pub(crate) type Inside<'i, 'a> = dyn FnMut(&mut Generator<'a>, &mut Text) + 'i;

impl<'a> Generator<'a> {
    /// Loops over the bindings, around the code of `inside`; returns the largest number of bindings, if known.
    pub fn ranging(&mut self, binders: BinderList, text: &mut Text, inside: &mut Inside<'_, 'a>) -> Option<u64> {
        let binders = self.program.binder_list(binders).to_vec();
        self.ranging_over(&binders, text, inside)
    }

    /// The same for some of the binders.
    pub fn ranging_over(&mut self, binders: &[Binder], text: &mut Text, inside: &mut Inside<'_, 'a>) -> Option<u64> {
        let Some((binder, rest)) = binders.split_first() else {
            inside(self, text);
            return Some(1);
        };
        let (variable, size) = self.open_loop(*binder, text);
        let more = self.ranging_over(rest, text, inside);
        text.close("}");
        self.frame.scope.release(&variable.name);
        Some(size?.saturating_mul(more?))
    }

    fn open_loop(&mut self, binder: Binder, text: &mut Text) -> (Variable, Option<u64>) {
        let range = self.program.term(binder.range).clone();
        let span = self.program.term_span(binder.range);
        match range {
            Term::Domain(domain) => {
                let ty = type_of(self.program, domain);
                if (!self.options.bare || ty != Type::Value)
                    && let Some((range, size)) = self.domain_range(domain)
                {
                    let variable = self.declare(binder.slot, ty, true, self.domain_interval(domain));
                    text.open(format!(
                        "for ([[maybe_unused]] const {} {} : {range}) {{",
                        self.plan.cpp(ty, true),
                        variable.name
                    ));
                    return (variable, size);
                }
                if matches!(self.program.domain(domain).kind, DomainKind::Prod(_) | DomainKind::Powerset(_)) {
                    self.needs_values(span, "the set of a domain's elements");
                    let values = self.domain_values(domain, span);
                    let variable = self.declare(binder.slot, Type::Value, false, Interval::ALL);
                    text.open(format!("for ([[maybe_unused]] const gs::Value& {} : {values}) {{", variable.name));
                    return (variable, None);
                }
                let site = self.site(binder.range);
                let variable = self.declare(binder.slot, ty, true, Interval::ALL);
                let plain = self.plan.cpp(variable.ty, true);
                text.open(format!(
                    "for ([[maybe_unused]] const {plain} {} : gs::failed<gs::Ordinals<{plain}>>(gs::FaultKind::not_enumerable, {site})) {{",
                    variable.name
                ));
                (variable, None)
            }
            Term::Range { low, high, step, .. } if self.is_integer(low) && self.is_integer(high) => {
                let site = self.site(binder.range);
                let mut bound = |term: TermId| {
                    let code = self.term(term);
                    let range = code.range;
                    (self.convert(code, Type::Integer, true, site), range)
                };
                let ((low_text, low_range), (high_text, high_range)) = (bound(low), bound(high));
                let step_text = step.map_or("1".to_string(), |step| bound(step).0);
                let between = Interval { low: low_range.low, high: high_range.high };
                let between = if between.is_empty() { Interval::EMPTY } else { between };
                let size = self.constant_size(low, high, step);
                let variable = self.declare(binder.slot, Type::Integer, true, between);
                let range = format!("gs::Integers{{{low_text}, {high_text}, {step_text}, {site}}}");
                text.open(format!("for ([[maybe_unused]] const std::int64_t {} : {range}) {{", variable.name));
                (variable, size)
            }
            Term::Collection { kind: kind @ (CollectionKind::Set | CollectionKind::Seq), elements } => {
                match self.constant_table(kind, elements, binder.range) {
                    Some((table, ty, size)) => {
                        let variable = self.declare(binder.slot, ty, true, Interval::ALL);
                        text.open(format!(
                            "for ([[maybe_unused]] const {} {} : {table}) {{",
                            self.plan.cpp(ty, true),
                            variable.name
                        ));
                        (variable, Some(size))
                    }
                    None => self.open_value_loop(binder, text),
                }
            }
            _ => self.open_value_loop(binder, text),
        }
    }

    fn open_value_loop(&mut self, binder: Binder, text: &mut Text) -> (Variable, Option<u64>) {
        let site = self.site(binder.range);
        if let Some((ty, defined, items)) = self.list_items(binder.range, site) {
            let variable = self.declare(binder.slot, ty, defined, Interval::ALL);
            let plain = self.plan.cpp(ty, defined);
            text.open(format!("for ([[maybe_unused]] const {plain} {} : {items}) {{", variable.name));
            return (variable, None);
        }
        self.needs_values(self.program.term_span(binder.range), "a collection");
        let value = self.value(binder.range);
        let ty = match &self.program.domain(self.program.term_domain(binder.range)).kind {
            DomainKind::Powerset(of) | DomainKind::Seq(of) | DomainKind::Bag(of) => type_of(self.program, *of),
            _ => Type::Value,
        };
        let ty = if ty == Type::Undef { Type::Value } else { ty };
        let items = format!("gs::iterable({value}, {site})");
        if ty == Type::Value {
            let variable = self.declare(binder.slot, ty, false, Interval::ALL);
            text.open(format!("for ([[maybe_unused]] const gs::Value& {} : {items}) {{", variable.name));
            return (variable, None);
        }
        let item = self.fresh("item");
        let variable = self.declare(binder.slot, ty, false, Interval::ALL);
        let plain = self.plan.cpp(ty, true);
        text.open(format!("for (const gs::Value& {item} : {items}) {{"));
        text.line(format!("[[maybe_unused]] const auto {} = gs::unbox<{plain}>({item}, {site});", variable.name));
        (variable, None)
    }

    /// The range over a list, or over the set of its items: the items' type, whether they are never undef, the range's
    /// expression.
    fn list_items(&mut self, range: TermId, site: u32) -> Option<(Type, bool, String)> {
        let solid = self.assumed.solid;
        let (list, set) = match self.program.term(range) {
            Term::Builtin { builtin: program::Builtin::AsSet, arguments } => {
                (*self.program.term_list(*arguments).first()?, true)
            }
            _ => (range, false),
        };
        let Type::List(of) = self.term_type(list) else { return None };
        if set && !self.unordered && (!solid || ordinals(self.program, of)? > 64) {
            return None;
        }
        let code = self.term(list);
        let text = self.convert(code, Type::List(of), true, site);
        let item = item_type(self.program, of);
        let items = match (set && !self.unordered, solid) {
            (true, _) => format!("gs::ItemSet<{}>{{{text}}}", self.plan.cpp(item, true)),
            // A part of a `seq` may change the location while a rule iterates over its former value.
            (false, _) if self.is_sequenced(list) => {
                format!("gs::{}({}{{{text}}})", items(solid), self.plan.cpp(Type::List(of), true))
            }
            (false, _) => format!("gs::{}({text})", items(solid)),
        };
        Some((item, solid, items))
    }

    /// Whether a term is a location that parts of a `seq` may change.
    fn is_sequenced(&self, term: TermId) -> bool {
        match self.program.term(term) {
            Term::Read { function, .. } => self.form(*function) == Form::General,
            _ => false,
        }
    }

    /// The range over a domain's elements, and an upper bound of their number if known; `None` if they cannot be
    /// enumerated as values of one type.
    pub fn domain_range(&mut self, domain: DomainId) -> Option<(String, Option<u64>)> {
        let plan = self.plan.domain(domain);
        let own = self.plan.domain(domain).carrier.as_ref().and_then(|_| self.carrier(domain));
        let ordinals =
            |name: &str, count: usize| Some((format!("gs::Ordinals<{name}>{{{count}}}"), Some(count as u64)));
        match &self.program.domain(domain).kind {
            DomainKind::Basic(Basic::Boolean) => ordinals("bool", 2),
            DomainKind::Enum { literals } => ordinals(plan.name(), literals.len()),
            DomainKind::Abstract { elements, .. } => match &own {
                None => ordinals(plan.name(), elements.len()),
                Some(carrier) => {
                    let most = self.capacity(&self.program.domain(domain).name).map(u64::from);
                    Some((format!("gs::listed<{}>({carrier})", plan.name()), most))
                }
            },
            DomainKind::Concrete { base, .. } => match (&own, &plan.contents) {
                (Some(carrier), _) => {
                    let most = self.capacity(&self.program.domain(domain).name).map(u64::from);
                    Some((format!("gs::listed<{}>({carrier})", self.plan.domain(*base).name()), most))
                }
                (None, Some(contents)) => {
                    let contents = contents.clone();
                    let size = contents.len() as u64;
                    Some((self.contents_range(domain, &contents), Some(size)))
                }
                (None, None) => None,
            },
            _ => None,
        }
    }

    /// The range over the contents of a domain that never changes.
    fn contents_range(&mut self, domain: DomainId, contents: &[machine::Value]) -> String {
        if let Some(Interval { low, high }) = crate::model::plan::gapless(contents) {
            return format!("gs::Integers{{{}, {}}}", integer(low), integer(high));
        }
        self.contents_table(domain, contents)
    }

    /// The name of the table of a domain's contents, ascending.
    pub fn contents_table(&mut self, domain: DomainId, contents: &[machine::Value]) -> String {
        let ty = type_of(self.program, domain);
        let plain = if ty == Type::Undef { "gs::Value".to_string() } else { self.plan.cpp(ty, true) };
        let items: Vec<String> = contents.iter().map(|value| self.constant(value, ty)).collect();
        self.table(
            &format!("{}_contents", self.plan.domain(domain).stem()),
            &plain,
            ty == Type::Undef || ty == Type::Value,
            &items,
        )
    }

    /// A table of constants; tables with the same contents are shared.
    fn table(&mut self, name: &str, plain: &str, dynamic: bool, items: &[String]) -> String {
        let contents = format!("std::array<{plain}, {}>{{{}}}", items.len(), items.join(", "));
        if let Some(known) = self.tables.iter().find(|table| table.contents == contents) {
            return known.name.clone();
        }
        let taken = |this: &Self, candidate: &str| this.tables.iter().any(|table| table.name == candidate);
        let mut candidate = name.to_string();
        let mut number = 1;
        while taken(self, &candidate) {
            number += 1;
            candidate = format!("{name}_{number}");
        }
        self.tables.push(Table { name: candidate.clone(), contents, dynamic });
        candidate
    }

    /// A known value, as a C++ constant.
    pub fn constant(&mut self, value: &machine::Value, ty: Type) -> String {
        use machine::Value;
        let list = |this: &mut Self, items: &[Value]| {
            let items: Vec<String> = items.iter().map(|item| this.constant(item, Type::Value)).collect();
            format!("gs::Values{{{}}}", items.join(", "))
        };
        let dynamic = ty == Type::Value || ty == Type::Undef;
        match value {
            Value::Undef if dynamic => "gs::Value{}".to_string(),
            Value::Undef => format!("{}{{}}", self.plan.cpp(ty, false)),
            Value::Boolean(truth) if dynamic => format!("gs::Value::boolean({truth})"),
            Value::Boolean(truth) => truth.to_string(),
            Value::Integer(number) if dynamic => format!("gs::Value::integer({})", integer(*number)),
            Value::Integer(number) if ty == Type::Real => real(*number as f64),
            Value::Integer(number) => integer(*number),
            Value::Real(number) if dynamic => format!("gs::Value::real({})", real(number.get())),
            Value::Real(number) => real(number.get()),
            Value::Char(letter) if dynamic => format!("gs::Value::character({})", *letter as u32),
            Value::Char(letter) => format!("char32_t{{{}}}", *letter as u32),
            Value::Enum(domain, index) if dynamic => format!("gs::Value::enumeration({}, {index})", domain.0),
            Value::Enum(domain, index) => {
                let plan = self.plan.domain(*domain);
                format!("{}::{}", plan.name(), plan.literals[*index as usize])
            }
            Value::Element(domain, number) if dynamic => format!("gs::Value::element({}, {number})", domain.0),
            Value::Element(domain, number) => format!("{}{{{number}}}", self.plan.domain(*domain).name()),
            Value::Rule(procedure) => format!("gs::Value::rule({})", procedure.0),
            Value::Complex(parts) => format!("gs::Value::complex({}, {})", real(parts.0.get()), real(parts.1.get())),
            Value::String(text) => crate::model::term::string(text),
            Value::Seq(items) if matches!(ty, Type::List(_)) => {
                let Type::List(of) = ty else { return "gs::Value{}".to_string() };
                let item = item_type(self.program, of);
                self.refuted.solid &= !items.contains(&Value::Undef);
                let items: Vec<String> = items.iter().map(|value| self.constant(value, item)).collect();
                format!("{}::of({{{}}})", self.plan.cpp(ty, true), items.join(", "))
            }
            Value::Tuple(items) => format!("gs::Value::tuple({})", list(self, items)),
            Value::Seq(items) => format!("gs::Value::seq({})", list(self, items)),
            Value::Set(items) => format!("gs::Value::set({})", list(self, items)),
            Value::Bag(counts) => {
                let items: Vec<Value> = counts
                    .iter()
                    .flat_map(|(item, count)| std::iter::repeat_n(item.clone(), *count as usize))
                    .collect();
                format!("gs::Value::bag({})", list(self, &items))
            }
            Value::Map(entries) => {
                let items: Vec<String> = entries
                    .iter()
                    .map(|(key, value)| {
                        format!("{{{}, {}}}", self.constant(key, Type::Value), self.constant(value, Type::Value))
                    })
                    .collect();
                format!("gs::Value::map(gs::Entries{{{}}})", items.join(", "))
            }
        }
    }

    /// A set or sequence of literals of one scalar type, as a table.
    fn constant_table(
        &mut self,
        kind: CollectionKind,
        elements: program::TermList,
        range: TermId,
    ) -> Option<(String, Type, u64)> {
        let mut values = Vec::new();
        for element in self.program.term_list(elements) {
            let Term::Constant(index) = self.program.term(*element) else { return None };
            values.push(match self.program.constants[*index as usize] {
                Literal::Integer(number) => machine::Value::Integer(number),
                Literal::Enum(domain, index) => machine::Value::Enum(domain, index),
                _ => return None,
            });
        }
        let of = match self.program.domain(self.program.term_domain(range)).kind {
            DomainKind::Powerset(of) | DomainKind::Seq(of) => of,
            _ => return None,
        };
        let ty = type_of(self.program, of);
        if !matches!(ty, Type::Integer | Type::Enum(_)) || values.is_empty() {
            return None;
        }
        if kind == CollectionKind::Set {
            values.sort_unstable();
            values.dedup();
        }
        let items: Vec<String> = values.iter().map(|value| self.constant(value, ty)).collect();
        let plain = self.plan.cpp(ty, true);
        Some((self.table("listed", &plain, false, &items), ty, items.len() as u64))
    }

    fn is_integer(&self, term: TermId) -> bool {
        self.term_type(term) == Type::Integer
    }

    fn constant_size(&self, low: TermId, high: TermId, step: Option<TermId>) -> Option<u64> {
        let number = |term: TermId| match self.program.term(term) {
            Term::Constant(index) => match self.program.constants[*index as usize] {
                Literal::Integer(number) => Some(number),
                _ => None,
            },
            _ => None,
        };
        let (low, high, step) = (number(low)?, number(high)?, step.map_or(Some(1), number)?);
        let size = (i128::from(high) - i128::from(low)) / i128::from(step.max(1)) + 1;
        u64::try_from(size.max(0)).ok()
    }
}
