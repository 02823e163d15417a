//! `l <- R(t)`: the body of R with the location l in the place of `result` (Börger & Stärk 2003, section 4.1.2).
//!
//! An update of `result` is then an update of l: within a `seq` a later update of l replaces it, and a read of `result`
//! reads l. The arguments of l are evaluated once, where the rule is called, and passed to a procedure of its own for
//! l's function. Most bodies do not need one: if nothing in them shows the difference, they write `result`, and at the
//! end of the call the machine turns that into an update of l. INVARIANT: the two ways have the same effect. A rule
//! that runs as a rule value or as an agent's program always writes `result`. So does a rule whose result goes to a
//! local function.

use std::collections::BTreeSet;
use std::rc::Rc;

use model::{Basic, DomainKind, FunctionId, FunctionKind, RuleId, RuleKind, RuleNode, Target, Term, TermKind};
use syntax::Span;

use crate::ir::{self, Slot, TermList};
use crate::lower::Lowering;

/// The location in the place of `result` in the body being lowered: its function, and the slots of its arguments.
#[derive(Debug, Clone)]
pub(super) struct Place {
    pub function: FunctionId,
    pub slots: Vec<Slot>,
}

/// What replaces `result` in a rule that is called.
#[derive(Debug, Clone, Copy)]
pub(super) enum InPlace {
    /// Nothing: it writes `result`.
    Nothing,
    /// What replaces it in the calling rule.
    AsAround,
    /// A location, with the terms of its arguments.
    Location(FunctionId, TermList),
}

/// What a rule does and reads, including all that it calls.
#[derive(Debug, Default)]
pub(super) struct Reach {
    writes_result: bool,
    reads_result: bool,
    /// It does something after something else.
    has_sequence: bool,
    /// It runs something that only a run can determine.
    runs_values: bool,
    functions: BTreeSet<FunctionId>,
}

impl<'m> Lowering<'m, '_> {
    /// The location that a function without arguments means, if that is `result` and a location replaces it.
    pub(super) fn in_place_of(&mut self, function: FunctionId, span: Span) -> Option<(FunctionId, TermList)> {
        if Some(function) != self.program.result_function {
            return None;
        }
        let Place { function, slots } = self.place.clone()?;
        let domains = &self.model.function(function).parameters;
        let terms: Vec<_> =
            slots.iter().zip(domains).map(|(slot, domain)| self.term(ir::Term::Slot(*slot), *domain, span)).collect();
        Some((function, self.term_list(&terms)))
    }

    /// Whether the body of a rule must be given a location of this function with these arguments.
    pub(super) fn needs_place(&mut self, rule: RuleId, function: FunctionId, arguments: TermList) -> bool {
        let declared = self.model.function(function);
        // Rules do not write what the environment holds. The called rule knows only its own local functions, even if one of
        // them is the same function.
        if matches!(declared.kind, FunctionKind::Monitored | FunctionKind::Local) {
            return false;
        }
        if self.program.term_list(arguments).iter().any(|term| self.shows_evaluation(*term)) {
            return true;
        }
        let restricted = matches!(
            self.model.domains.kind(declared.codomain),
            DomainKind::Basic(Basic::Natural) | DomainKind::Concrete { .. }
        );
        let reach = self.reach(rule);
        let told_apart = restricted || reach.runs_values || reach.functions.contains(&function);
        reach.reads_result || reach.writes_result && reach.has_sequence && told_apart
    }

    /// Whether it may show if a term is evaluated: it may be at fault, or ask for an input. At the end of a call the arguments
    /// of its location are evaluated only if the rule has set a result.
    fn shows_evaluation(&self, term: ir::TermId) -> bool {
        match self.program.term(term) {
            ir::Term::Constant(_) | ir::Term::Slot(_) => false,
            ir::Term::Read { function, arguments } => {
                matches!(self.program.function(*function).kind, FunctionKind::Monitored | FunctionKind::Shared)
                    || self.program.term_list(*arguments).iter().any(|argument| self.shows_evaluation(*argument))
            }
            _ => true,
        }
    }

    /// Whether a rule writes or reads `result`.
    pub(super) fn uses_result(&mut self, rule: RuleId) -> bool {
        let reach = self.reach(rule);
        reach.writes_result || reach.reads_result
    }

    fn reach(&mut self, rule: RuleId) -> Rc<Reach> {
        if let Some(known) = self.reaches.get(&rule) {
            return Rc::clone(known);
        }
        let mut reach = Reach::default();
        let (mut open, mut met) = (vec![rule], BTreeSet::from([rule]));
        while let Some(next) = open.pop() {
            self.model.rule(next).body.walk(&mut |node| {
                reach.has_sequence |= matches!(
                    node.kind,
                    RuleKind::Seq(_)
                        | RuleKind::Iterate(_)
                        | RuleKind::While { .. }
                        | RuleKind::RecursiveWhile { .. }
                        | RuleKind::Local { .. }
                );
                reach.runs_values |= matches!(node.kind, RuleKind::RunValue { .. } | RuleKind::RunAgent { .. });
                if let Some(called) = called(node).filter(|called| met.insert(*called)) {
                    open.push(called);
                }
                if let Some(function) = written(node) {
                    reach.writes_result |= Some(function) == self.program.result_function;
                    reach.functions.insert(function);
                }
                node.terms(&mut |term| self.reach_of_term(term, &mut reach));
            });
        }
        let reach = Rc::new(reach);
        self.reaches.insert(rule, Rc::clone(&reach));
        reach
    }

    /// Adds what a term reads, through the definitions it uses.
    fn reach_of_term(&self, term: &'m Term, reach: &mut Reach) {
        let mut open = vec![term];
        while let Some(next) = open.pop() {
            next.walk(&mut |term| {
                let TermKind::Apply { function, .. } = &term.kind else { return };
                reach.reads_result |= Some(*function) == self.program.result_function;
                if reach.functions.insert(*function)
                    && let Some(definition) = &self.model.function(*function).definition
                {
                    open.push(&definition.body);
                }
            });
        }
    }
}

/// The rule that a rule calls.
fn called(node: &RuleNode) -> Option<RuleId> {
    match &node.kind {
        RuleKind::MacroCall(call) | RuleKind::TurboCall(call) | RuleKind::Return { call, .. } => Some(call.rule),
        _ => None,
    }
}

/// The function of the location that a rule writes; for a parameter, the argument of the call says which one.
fn written(node: &RuleNode) -> Option<FunctionId> {
    match &node.kind {
        RuleKind::Update { target: Target::Location { function, .. }, .. }
        | RuleKind::Return { target: Target::Location { function, .. }, .. } => Some(*function),
        _ => None,
    }
}
