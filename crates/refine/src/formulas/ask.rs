//! Asks solvers about formulas, and keeps what they said as [`Obligation`]s.
//!
//! In: the shared terms, the solvers. Out: obligations with their scripts, which are whole files of SMT-LIB: whoever wants can run another
//! solver on them. INVARIANT: each question goes to a solver that was just started, and so depends on nothing else.

use std::fmt::Write;

use rustc_hash::FxHashMap;
use solve::session::{Constant, Silence, Solvers, Verdict, constants, verdict};
use solve::shared::{Kind, Node, Script, Terms, VariableId};

use super::obligation::{Obligation, Said};

/// Bounds of numbers in which a state to show is searched first.
const SMALL: [i128; 2] = [9, 999];

/// The solvers and how long they may take.
pub struct Provers<'s> {
    /// Two of them must accept each obligation.
    pub solvers: Vec<&'s mut dyn Solvers>,
    /// For each question, in seconds.
    pub seconds: u32,
    /// The most steps of runs that are looked at.
    pub depth: u64,
}

impl std::fmt::Debug for Provers<'_> {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("Provers").field("seconds", &self.seconds).finish_non_exhaustive()
    }
}

/// The values that a solver gave to variables.
pub(crate) type Model = FxHashMap<VariableId, Constant>;

/// See the module.
pub(crate) struct Ask<'s, 'w> {
    pub solvers: Vec<&'s mut dyn Solvers>,
    /// For each question, in seconds.
    pub seconds: u32,
    pub go_on: &'w mut dyn FnMut() -> bool,
    pub obligations: Vec<Obligation>,
    /// Whoever waits has had enough.
    pub stopped: bool,
}

impl Ask<'_, '_> {
    /// Asks whether a condition can hold, which it should not, or with `sense` should. Returns a state in which it holds, if a solver has one.
    pub fn ask(&mut self, terms: &Terms, name: &str, claim: &str, condition: Node, sense: bool) -> Option<Model> {
        let variables = terms.variables_of([condition]);
        let script = script(terms, &variables, condition, claim, sense);
        let mut said = Vec::new();
        let mut model = None;
        for index in 0..self.solvers.len() {
            let (answer, found) = self.one(terms, index, &script, &variables);
            said.push(answer);
            if let (None, Some(found)) = (&model, found) {
                model = Some(if sense { found } else { self.plainer(terms, index, &script, &variables, found) });
            }
            // What one solver says makes sense needs no second one.
            if self.stopped || sense && said.last() == Some(&Said::Possible) && said.len() > 1 {
                break;
            }
        }
        self.obligations.push(Obligation { name: name.to_string(), claim: claim.to_string(), script, sense, said });
        model
    }

    /// What each solver says of a condition, to the first that has a state in which it holds; and that state.
    pub fn look(&mut self, terms: &Terms, condition: Node) -> (Vec<Said>, Option<Model>) {
        if condition == Terms::FALSE {
            return (vec![Said::Impossible; self.solvers.len()], None);
        }
        let variables = terms.variables_of([condition]);
        let script = script(terms, &variables, condition, "", true);
        let mut said = Vec::new();
        for index in 0..self.solvers.len() {
            let (answer, found) = self.one(terms, index, &script, &variables);
            said.push(answer);
            if let Some(found) = found {
                return (said, Some(self.plainer(terms, index, &script, &variables, found)));
            }
            if self.stopped {
                break;
            }
        }
        (said, None)
    }

    /// Whether a condition cannot hold, on the word of all solvers.
    pub fn denied(&mut self, terms: &Terms, condition: Node) -> bool {
        if condition == Terms::FALSE {
            return true;
        }
        let variables = terms.variables_of([condition]);
        let script = script(terms, &variables, condition, "", true);
        let mut each = 0..self.solvers.len();
        !self.solvers.is_empty() && each.all(|index| self.one(terms, index, &script, &variables).0 == Said::Impossible)
    }

    /// Whether a condition can hold, on the word of the first solver: for what is told and not relied on.
    pub fn possible(&mut self, terms: &Terms, condition: Node) -> bool {
        let variables = terms.variables_of([condition]);
        let script = script(terms, &variables, condition, "", true);
        !self.solvers.is_empty() && self.one(terms, 0, &script, &variables).0 == Said::Possible
    }

    /// A state of smaller numbers, if there is one: it is easier to read.
    fn plainer(&mut self, terms: &Terms, index: usize, script: &str, variables: &[VariableId], found: Model) -> Model {
        let numbers: Vec<VariableId> =
            variables.iter().copied().filter(|id| terms.variable_of(*id).kind == Kind::Integer).collect();
        for most in SMALL {
            let is_small = |id: &VariableId| matches!(found.get(id), Some(Constant::Integer(n)) if n.abs() <= most);
            if numbers.iter().all(is_small) {
                break;
            }
            let mut small = String::new();
            for id in &numbers {
                let name = Script::name(terms, *id, 0);
                let _ = writeln!(small, "(assert (and (<= (- {most}) {name}) (<= {name} {most})))");
            }
            let asked = script.replace("(check-sat)\n", &format!("{small}(check-sat)\n"));
            if let (Said::Possible, Some(model)) = self.one(terms, index, &asked, variables) {
                return model;
            }
        }
        found
    }

    fn one(&mut self, terms: &Terms, index: usize, script: &str, variables: &[VariableId]) -> (Said, Option<Model>) {
        let said = |silence: Silence| match silence {
            Silence::Late => (Said::Late, None),
            Silence::Stopped => (Said::Late, None),
            Silence::Broken(reason) => (Said::Broken(reason), None),
        };
        let mut session = match self.solvers[index].start() {
            Ok(session) => session,
            Err(silence) => return said(silence),
        };
        let answer = session.ask(script, self.seconds, self.go_on);
        self.stopped |= answer == Err(Silence::Stopped);
        match answer.and_then(|answer| verdict(&answer)) {
            Ok(Verdict::Impossible) => (Said::Impossible, None),
            Ok(Verdict::Unknown) => (Said::Unknown, None),
            Err(silence) => said(silence),
            Ok(Verdict::Possible) => {
                let mut model = Model::default();
                if !variables.is_empty() {
                    let names: Vec<String> = variables.iter().map(|id| Script::name(terms, *id, 0)).collect();
                    let kinds: Vec<Kind> = variables.iter().map(|id| terms.variable_of(*id).kind).collect();
                    let asked = format!("(get-value ({}))\n", names.join(" "));
                    if let Ok(answer) = session.ask(&asked, self.seconds, self.go_on) {
                        let values = variables.iter().copied().zip(constants(&answer, &kinds));
                        model.extend(values.filter_map(|(id, value)| Some((id, value?))));
                    }
                }
                (Said::Possible, Some(model))
            }
        }
    }

    /// The solvers that have a name, with their versions.
    pub fn names(&self) -> Vec<String> {
        self.solvers.iter().filter_map(|solver| solver.name().ok()).collect()
    }

    /// The index of the last obligation.
    pub fn last(&self) -> usize {
        self.obligations.len() - 1
    }
}

/// A whole file of SMT-LIB.
fn script(terms: &Terms, variables: &[VariableId], condition: Node, claim: &str, sense: bool) -> String {
    let mut text = String::new();
    if !claim.is_empty() {
        let wanted = if sense { "sat" } else { "unsat" };
        let _ = writeln!(text, "; {claim}\n; accepted if the answer is {wanted}");
    }
    text.push_str("(set-option :produce-models true)\n(set-logic ALL)\n");
    Script::declare(terms, variables, 0, &mut text);
    let written = Script::default().term(terms, condition, 0, &mut text);
    let _ = writeln!(text, "(assert {written})\n(check-sat)");
    text
}
