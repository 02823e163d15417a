//! Unrolls a relation: successive steps, told to a solver that keeps them.
//!
//! In: a relation. The states at times 0, 1, 2 … with their inputs, and questions about them. INVARIANT: what is
//! asserted about a time is true of every run (or, without an initial state, of every segment of a run) with that many
//! steps.

use std::fmt::Write;

use solve::session::{Constant, Session, Silence, Verdict, constants, verdict};
use solve::shared::{Kind, Node, Script, Terms, VariableId};

use crate::solver::relation::Relation;

/// A run as a solver describes it.
#[derive(Debug, Clone, Default)]
pub(crate) struct SolverRun {
    /// The index of the initial state.
    pub start: usize,
    /// For each step the values of inputs, in the relation's order.
    pub steps: Vec<Vec<Option<Constant>>>,
}

/// The time limit for a question, and the caller's wish to stop.
pub(crate) struct Patience<'w> {
    pub seconds: u32,
    pub go_on: &'w mut dyn FnMut(u64) -> bool,
    /// The present time.
    pub depth: u64,
}

/// An unrolled relation in a solver session.
pub(crate) struct Unrolling<'r> {
    relation: &'r Relation,
    session: Box<dyn Session>,
    /// For each time, what has been written.
    scripts: Vec<Script>,
    /// The variables of the state that matter.
    cone: Vec<usize>,
    inputs: Vec<VariableId>,
    /// Commands that were not sent yet.
    text: String,
    named: usize,
}

impl<'r> Unrolling<'r> {
    /// Begins at time 0, in an initial state or in any state.
    pub fn new(relation: &'r Relation, session: Box<dyn Session>, at_start: bool) -> Unrolling<'r> {
        let mut unrolling = Unrolling {
            relation,
            session,
            scripts: Vec::new(),
            cone: relation.cone(),
            inputs: relation.input_variables(),
            text: "(set-option :produce-models true)\n(set-logic ALL)\n".to_string(),
            named: 0,
        };
        if at_start {
            Script::declare(&relation.terms, relation.start.as_slice(), 0, &mut unrolling.text);
        }
        unrolling.open_time();
        if at_start {
            for index in unrolling.cone.clone() {
                unrolling.equate(relation.initial[index], 0, relation.state[index], 0);
            }
            unrolling.assert(relation.first, 0);
        }
        unrolling
    }

    /// The last time.
    pub fn time(&self) -> usize {
        self.scripts.len() - 1
    }

    fn open_time(&mut self) {
        let (relation, time) = (self.relation, self.scripts.len());
        self.scripts.push(Script::default());
        let state: Vec<VariableId> = self.cone.iter().map(|index| relation.state[*index]).collect();
        Script::declare(&relation.terms, &state, time, &mut self.text);
        Script::declare(&relation.terms, &self.inputs, time, &mut self.text);
        for known in [relation.typed, relation.admitted, relation.given] {
            self.assert(known, time);
        }
    }

    fn written(&mut self, node: Node, time: usize) -> String {
        self.scripts[time].term(&self.relation.terms, node, time, &mut self.text)
    }

    fn equate(&mut self, node: Node, time: usize, variable: VariableId, later: usize) {
        let text = self.written(node, time);
        let name = Script::name(&self.relation.terms, variable, later);
        let _ = writeln!(self.text, "(assert (= {name} {text}))");
    }

    /// Asserts a term at a time.
    pub fn assert(&mut self, node: Node, time: usize) {
        if node != Terms::TRUE {
            let text = self.written(node, time);
            let _ = writeln!(self.text, "(assert {text})");
        }
    }

    /// Adds a step.
    pub fn step(&mut self) {
        let (relation, time) = (self.relation, self.time());
        self.assert(relation.goes, time);
        self.open_time();
        for index in self.cone.clone() {
            self.equate(relation.next[index], time, relation.state[index], time + 1);
        }
    }

    /// Asserts that the last state differs from all earlier ones.
    pub fn be_new(&mut self) {
        let time = self.time();
        for former in 0..time {
            let mut text = String::new();
            for index in &self.cone {
                let id = self.relation.state[*index];
                let (a, b) =
                    (Script::name(&self.relation.terms, id, former), Script::name(&self.relation.terms, id, time));
                let _ = write!(text, " (not (= {a} {b}))");
            }
            let _ = writeln!(self.text, "(assert (or false{text}))");
        }
    }

    /// A name for a term at a time.
    pub fn name(&mut self, node: Node, time: usize) -> String {
        let text = self.written(node, time);
        self.named += 1;
        let name = format!("h{}", self.named);
        let _ = writeln!(self.text, "(declare-const {name} Bool)\n(assert (= {name} {text}))");
        name
    }

    /// A name for the disjunction of several names.
    pub fn any(&mut self, names: &[String]) -> String {
        self.named += 1;
        let name = format!("h{}", self.named);
        let _ = writeln!(self.text, "(declare-const {name} Bool)\n(assert (= {name} (or false {})))", names.join(" "));
        name
    }

    /// Asserts a text permanently.
    pub fn assert_text(&mut self, text: &str) {
        let _ = writeln!(self.text, "(assert {text})");
    }

    /// Whether the assertions are satisfiable with some names (or their negations) assumed.
    pub fn possible(&mut self, assumed: &[String], patience: &mut Patience<'_>) -> Result<Verdict, Silence> {
        // Not every solver reads an empty list.
        let _ = match assumed.is_empty() {
            true => writeln!(self.text, "(check-sat)"),
            false => writeln!(self.text, "(check-sat-assuming ({}))", assumed.join(" ")),
        };
        let answer = self.ask(patience)?;
        verdict(&answer)
    }

    fn ask(&mut self, patience: &mut Patience<'_>) -> Result<String, Silence> {
        let text = std::mem::take(&mut self.text);
        let depth = patience.depth;
        let go_on = &mut *patience.go_on;
        self.session.ask(&text, patience.seconds, &mut || go_on(depth))
    }

    /// Which of some names are true in the solution found.
    pub fn true_among(&mut self, names: &[String], patience: &mut Patience<'_>) -> Result<Vec<bool>, Silence> {
        let _ = writeln!(self.text, "(get-value ({}))", names.join(" "));
        let answer = self.ask(patience)?;
        let values = constants(&answer, &vec![Kind::Boolean; names.len()]);
        Ok(values.into_iter().map(|value| value == Some(Constant::Boolean(true))).collect())
    }

    /// The run in the solution found.
    pub fn run(&mut self, patience: &mut Patience<'_>) -> Result<SolverRun, Silence> {
        let terms = &self.relation.terms;
        let mut names = Vec::new();
        let mut kinds = Vec::new();
        names.extend(self.relation.start.map(|id| Script::name(terms, id, 0)));
        kinds.extend(self.relation.start.map(|_| Kind::Integer));
        for time in 0..self.scripts.len() {
            names.extend(self.inputs.iter().map(|id| Script::name(terms, *id, time)));
            kinds.extend(self.inputs.iter().map(|id| terms.variable_of(*id).kind));
        }
        let mut values = Vec::new();
        if !names.is_empty() {
            let _ = writeln!(self.text, "(get-value ({}))", names.join(" "));
            let answer = self.ask(patience)?;
            values = constants(&answer, &kinds);
        }
        let mut values = values.into_iter();
        let start = match self.relation.start.and_then(|_| values.next()).flatten() {
            Some(Constant::Integer(start)) => usize::try_from(start).unwrap_or(0),
            _ => 0,
        };
        let steps = (0..self.scripts.len()).map(|_| values.by_ref().take(self.inputs.len()).collect()).collect();
        Ok(SolverRun { start: start.min(self.relation.starts.len() - 1), steps })
    }
}
