//! Propositions: the Boolean terms that formulas about runs are made of.

use machine::{Environment, Fault, Machine, Value};
use program::{Expression, Program, Slot, Term, TermId};
use syntax::Span;

/// A Boolean term, with fixed values for the variables of the enclosing formula.
#[derive(Debug, Clone, PartialEq, Eq, PartialOrd, Ord)]
pub struct Proposition {
    /// The term.
    pub term: TermId,
    /// The number of slots in its frame.
    pub frame: u32,
    /// The values of variables bound outside of it, by slot.
    pub bindings: Vec<(Slot, Value)>,
}

impl Proposition {
    /// A proposition without enclosing variables.
    pub fn of(expression: &Expression) -> Proposition {
        Proposition { term: expression.body, frame: expression.frame, bindings: Vec::new() }
    }

    /// Its place.
    pub fn span(&self, program: &Program) -> Span {
        program.term_span(self.term)
    }

    /// As an expression, for readers that only need the functions in it.
    pub fn expression(&self) -> Expression {
        let (frame, names) = (self.frame, vec![String::new(); self.frame as usize]);
        Expression { parameters: Vec::new(), frame, names, body: self.term }
    }

    /// Its value in the machine's state.
    ///
    /// # Errors
    /// What evaluation meets.
    pub fn evaluate(&self, machine: &mut Machine, environment: &mut dyn Environment) -> Result<Value, Fault> {
        machine.evaluate_with(self.term, self.frame, &self.bindings, environment)
    }
}

/// A node of a term without its operands: two terms are written alike if their pieces are equal, in order.
#[derive(Debug, Clone, PartialEq, Eq, PartialOrd, Ord)]
pub enum Piece {
    /// A variable with this value.
    Value(Value),
    /// Anything else, as text; equal nodes have equal texts.
    Other(String),
}

impl Proposition {
    /// The pieces of the term, each before its operands.
    pub fn pieces(&self, program: &Program) -> Vec<Piece> {
        let mut pieces = Vec::new();
        let mut open = vec![self.term];
        while let Some(id) = open.pop() {
            let mut parts = Vec::new();
            program.each_child_of_term(id, &mut |part| parts.push(part));
            pieces.push(self.piece(program, id, parts.len()));
            open.extend(parts.into_iter().rev());
        }
        pieces
    }

    fn piece(&self, program: &Program, id: TermId, parts: usize) -> Piece {
        let binders = |list| -> Vec<u32> { program.binder_list(list).iter().map(|binder| binder.slot.0).collect() };
        let domain = program.term_domain(id);
        Piece::Other(match program.term(id) {
            Term::Slot(slot) => match self.bindings.iter().find(|(bound, _)| bound == slot) {
                Some((_, value)) => return Piece::Value(value.clone()),
                None => format!("slot {}", slot.0),
            },
            Term::Constant(constant) => format!("constant {constant}"),
            Term::Read { function, .. } => format!("read {function:?} {parts}"),
            Term::Define { function, .. } => format!("define {function:?} {parts}"),
            Term::Builtin { builtin, .. } => format!("{builtin:?} {parts} {domain:?}"),
            Term::Domain(domain) => format!("domain {domain:?}"),
            Term::Tuple(_) => format!("tuple {parts}"),
            Term::Project { index, .. } => format!("project {index}"),
            Term::Collection { kind, .. } => format!("collection {kind:?} {parts}"),
            Term::Range { kind, .. } => format!("range {kind:?} {parts}"),
            Term::Comprehension { kind, binders: list, .. } => format!("each {kind:?} {parts} {:?}", binders(*list)),
            Term::Quantified { quantifier, binders: list, .. } => {
                format!("{quantifier:?} {parts} {:?}", binders(*list))
            }
            Term::If { otherwise, .. } => format!("if {parts} {}", otherwise.is_some()),
            Term::Switch { otherwise, .. } => format!("switch {parts} {}", otherwise.is_some()),
            Term::Let { slot, .. } => format!("let {}", slot.0),
            Term::Rule(procedure) => format!("rule {procedure:?}"),
            Term::Unbound => "unbound".to_string(),
            Term::Missing(function) => format!("missing {function:?}"),
            Term::Coerce(_) => format!("coerce {domain:?}"),
        })
    }
}
