//! The decision: cases first, then a solver, then that it is unknown.
//!
//! INVARIANT: a state that is given back makes the condition true, by our own evaluation where it holds no fractions; that
//! there is none is said only of all cases, or by the solver.

use crate::answer::{Answer, answer};
use crate::cases::{Cases, MAX_CASES, Reason, cases, holds};
use crate::formula::{Formula, Sort, Value};
use crate::script::script;

/// Something that decides SMT-LIB scripts, such as a process of z3 or cvc5.
pub trait Solver {
    /// What the solver prints for a script. The error is why there is none, as a clause: "no solver is installed".
    fn solve(&mut self, script: &str) -> Result<String, String>;
}

/// Whether a condition can hold.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Decision {
    /// It does in this state: its locations with their values, one a text.
    Possible(Vec<String>),
    /// It never does.
    Impossible,
    /// Not told, for this reason, which is a clause.
    Unknown(String),
}

impl Formula {
    /// Looks for a state in which the condition holds.
    pub fn decide(&self, solver: &mut dyn Solver) -> Decision {
        let reason = match cases(self) {
            Cases::Found(state) => return Decision::Possible(self.shown(&state)),
            Cases::None => return Decision::Impossible,
            Cases::Open(reason) => reason,
        };
        let (text, asked) = script(self);
        let why = match reason {
            Reason::Many => format!("there are more than {MAX_CASES} cases"),
            Reason::Numbers => "the numbers have too many values to go through".to_string(),
        };
        match solver.solve(&text) {
            Err(reason) => Decision::Unknown(format!("{why}, and {reason}")),
            Ok(output) => match answer(self, &asked, &output) {
                Answer::Unsat => Decision::Impossible,
                Answer::Other(line) => Decision::Unknown(format!("{why}, and the solver says `{line}`")),
                Answer::Sat(state) if holds(self, &state) == Some(true) || self.has_reals() => {
                    Decision::Possible(self.shown(&state))
                }
                Answer::Sat(_) => Decision::Unknown("the state that the solver gave does not hold".to_string()),
            },
        }
    }

    /// The SMT-LIB script that a solver is given.
    pub fn script(&self) -> String {
        script(self).0
    }

    fn has_reals(&self) -> bool {
        let mut found = false;
        self.condition.walk(&mut |term| found |= self.sort(term) == Sort::Real);
        found
    }

    fn shown(&self, state: &[((crate::formula::SymbolId, Vec<Value>), Value)]) -> Vec<String> {
        // That a location is defined is seen from its value.
        let plain = |id: crate::formula::SymbolId, value: Value| {
            !(self.symbol(id).definedness && value == Value::Boolean(true))
        };
        let shown = state.iter().filter(|((id, _), value)| plain(*id, *value));
        shown.map(|((id, arguments), value)| self.show_location(*id, arguments, *value)).collect()
    }
}
