//! Decides a question: by case enumeration, then by a solver; otherwise the answer is unknown.
//!
//! INVARIANT: a state that is returned satisfies the condition, checked by our own evaluation if it contains no
//! fractions. *Impossible* is returned only if all cases were tried, or on the solver's word.

use crate::answer::{Answer, answer};
use crate::cases::{Cases, MAX_CASES, Reason, State, cases, holds, value_in};
use crate::question::Question;
use crate::script::script;
use crate::session::Constant;
use crate::shared::{Kind, Node, VariableId};

/// Decides SMT-LIB scripts, for example by a process of z3 or cvc5.
pub trait Solver {
    /// The solver's output for a script. The error says why there is none, as a clause: "no solver is installed".
    fn solve(&mut self, script: &str) -> Result<String, String>;
}

/// Whether a condition can hold.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Decision {
    /// It holds in this state: its locations with their values, one text each.
    Possible(Vec<String>),
    /// It never holds.
    Impossible,
    /// Undecided, for this reason, which is a clause.
    Unknown(String),
}

impl Question {
    /// Searches for a state in which the condition holds.
    pub fn decide(&self, solver: &mut dyn Solver) -> Decision {
        let reason = match cases(self) {
            Cases::Found(state) => return Decision::Possible(self.shown(&state)),
            Cases::None => return Decision::Impossible,
            Cases::Open(reason) => reason,
        };
        let why = match reason {
            Reason::Many => format!("there are more than {MAX_CASES} cases"),
            Reason::Numbers => "the numbers have too many values to go through".to_string(),
        };
        match solver.solve(&script(self)) {
            Err(reason) => Decision::Unknown(format!("{why}, and {reason}")),
            Ok(output) => match answer(self, &output) {
                Answer::Unsat => Decision::Impossible,
                Answer::Other(line) => Decision::Unknown(format!("{why}, and the solver says `{line}`")),
                Answer::Sat(state) if holds(self, &state) == Some(true) || self.has_reals() => {
                    Decision::Possible(self.shown(&state))
                }
                Answer::Sat(_) => Decision::Unknown("the state that the solver gave does not hold".to_string()),
            },
        }
    }

    /// The SMT-LIB script for a solver.
    pub fn script(&self) -> String {
        script(self)
    }

    fn has_reals(&self) -> bool {
        self.terms.parts([self.condition]).into_iter().any(|node| self.terms.kind(node) == Kind::Real)
    }

    /// The locations of a state, in the order in which the condition reads them.
    fn shown(&self, state: &State) -> Vec<String> {
        let place = |(id, arguments): &(VariableId, Vec<Constant>)| {
            let is_it = |node: &Node| {
                let values = |terms: &[Node]| terms.iter().map(|term| value_in(self, state, *term)).collect::<Vec<_>>();
                self.location(*node).is_some_and(|(symbol, terms)| {
                    symbol == *id && values(terms).into_iter().eq(arguments.iter().copied().map(Some))
                })
            };
            self.locations.iter().position(is_it)
        };
        let mut placed: Vec<_> = state.iter().map(|one| (place(&one.0), one)).collect();
        placed.sort_by_key(|(place, _)| *place);
        // A location with a value need not be shown as defined.
        let is_defined = |id, value: &Constant| {
            *value == Constant::Boolean(true) && self.unknowns.get(id).is_some_and(|unknown| unknown.definedness)
        };
        let shown = placed.into_iter().filter(|(_, ((id, _), value))| !is_defined(id, value));
        shown.map(|(_, ((id, arguments), value))| self.show_location(*id, arguments, *value)).collect()
    }
}
