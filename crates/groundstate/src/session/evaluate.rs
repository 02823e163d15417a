//! Terms in the state of a moment, whatever the run does meanwhile.
//!
//! In: the text of a term, and a [`Moment`]. Out: its value. A machine of its own takes the state over, so that terms which are
//! added later never touch the one that runs. An input that was not asked for has no value; of a choice the first candidate is
//! taken. LIMIT: so many terms are kept; a text of so many bytes is a term.

use std::collections::BTreeMap;
use std::sync::Arc;

use machine::{Choice, Environment, Limits, Location, LocationRef, Machine, TimeUnit, Value};
use model::{Basic, Model};
use program::{DomainId, DomainKind, Expression, Program};
use syntax::ast::{AstNode, TermFile};
use syntax::{Diagnostic, Severity, SourceFile, Sources};

use crate::has_errors;
use crate::session::moment::Moment;

/// LIMIT: texts that are kept as terms.
const KEPT: usize = 500;

/// LIMIT: bytes of a term.
const BYTES: usize = 10_000;

/// See the module.
#[derive(Debug)]
pub struct Evaluator {
    begun: (Sources, Arc<Model>, Arc<Program>),
    sources: Sources,
    model: Arc<Model>,
    program: Arc<Program>,
    known: BTreeMap<String, Result<Expression, String>>,
    /// Terms that were given out stay terms of the program.
    keeps: bool,
    /// The inputs of the initial state.
    initial: Vec<(Location, Value)>,
    player: Player,
}

impl Evaluator {
    /// An evaluator that knows no term yet.
    pub fn new(sources: &Sources, model: &Arc<Model>, program: &Arc<Program>, limits: Limits) -> Evaluator {
        let (sources, model, program) = (sources.clone(), Arc::clone(model), Arc::clone(program));
        Evaluator {
            begun: (sources.clone(), Arc::clone(&model), Arc::clone(&program)),
            sources,
            model,
            program,
            known: BTreeMap::new(),
            keeps: false,
            initial: Vec::new(),
            player: Player::new(limits),
        }
    }

    /// From now on what was read stays a term of the program.
    pub(crate) fn keep(mut self) -> Evaluator {
        self.keeps = true;
        self
    }

    /// These inputs were given for the initial state.
    pub fn begin(&mut self, inputs: &[(Location, Value)]) {
        if self.initial != inputs {
            self.initial = inputs.to_vec();
            // The machine was started with others, or with none.
            self.player.machine = None;
        }
    }

    /// The program with all terms that are known.
    pub fn program(&self) -> &Arc<Program> {
        &self.program
    }

    /// A text as a term.
    ///
    /// # Errors
    /// A sentence: it is none.
    pub fn term(&mut self, text: &str) -> Result<Expression, String> {
        if let Some(known) = self.known.get(text) {
            return known.clone();
        }
        if text.len() > BYTES {
            return Err(format!("a term of more than {BYTES} bytes is not evaluated"));
        }
        if self.known.len() >= KEPT && self.keeps {
            return Err(format!("{KEPT} conditions are kept: open a new session for others"));
        }
        if self.known.len() >= KEPT {
            let (sources, model, program) = self.begun.clone();
            (self.sources, self.model, self.program) = (sources, model, program);
            self.known.clear();
        }
        let read = self.read(text);
        self.known.insert(text.to_string(), read.clone());
        read
    }

    /// A text as a condition: a term that is true or false.
    ///
    /// # Errors
    /// A sentence: it is none.
    pub fn condition(&mut self, text: &str) -> Result<Expression, String> {
        let term = self.term(text)?;
        match self.program.domain(self.program.term_domains[term.body.0 as usize]).kind {
            DomainKind::Basic(Basic::Boolean) => Ok(term),
            _ => Err(format!("`{text}` is no condition: its value is not true or false")),
        }
    }

    fn read(&mut self, text: &str) -> Result<Expression, String> {
        let file = self.sources.add(SourceFile::new("term", text));
        let parsed = syntax::parse_term(file, text);
        if has_errors(&parsed.diagnostics) {
            return Err(told(&parsed.diagnostics));
        }
        let term = TermFile::cast(parsed.syntax()).and_then(|file| file.term()).ok_or("there is no term")?;
        let fragment = Arc::make_mut(&mut self.model).check_term(file, &term);
        if has_errors(&fragment.diagnostics) {
            return Err(told(&fragment.diagnostics));
        }
        program::lower_term(Arc::make_mut(&mut self.program), &self.model, &fragment.item, &fragment.variables)
            .map_err(|faults| told(&faults))
    }

    /// The value of a term of this evaluator.
    ///
    /// # Errors
    /// A sentence: it has none.
    pub fn value(&mut self, expression: &Expression, moment: &Moment) -> Result<Value, String> {
        self.player.value(&self.program, expression, moment, &self.initial)
    }

    /// The elements of a domain.
    ///
    /// # Errors
    /// A sentence: they cannot be listed.
    pub fn elements(&mut self, domain: DomainId, moment: &Moment) -> Result<Vec<Value>, String> {
        let program = Arc::clone(&self.program);
        let machine = self.player.machine(&program, moment, &self.initial);
        machine.elements(domain).map_err(|fault| fault.show(&program).to_string())
    }

    /// Whether a value is in a domain.
    pub fn contains(&mut self, domain: DomainId, value: &Value, moment: &Moment) -> bool {
        let program = Arc::clone(&self.program);
        self.player.machine(&program, moment, &self.initial).contains(domain, value)
    }

    /// All locations that have a value.
    pub fn locations(&mut self, moment: &Moment) -> Vec<(Location, Value)> {
        let program = Arc::clone(&self.program);
        self.player.machine(&program, moment, &self.initial).locations()
    }
}

fn told(faults: &[Diagnostic]) -> String {
    let fault = faults.iter().find(|fault| fault.severity == Severity::Error);
    fault.map_or_else(String::new, |fault| match fault.primary.text.as_str() {
        "" => fault.message.clone(),
        reason => format!("{}: {reason}", fault.message),
    })
}

/// A machine that takes the state of a moment over.
#[derive(Debug)]
pub(crate) struct Player {
    limits: Limits,
    machine: Option<Machine>,
    /// The state that it has.
    at: Option<Arc<machine::Snapshot>>,
}

impl Player {
    pub fn new(limits: Limits) -> Player {
        Player { limits, machine: None, at: None }
    }

    /// The value of a term of this program, which has all that the program of the moment has.
    pub fn value(
        &mut self,
        program: &Arc<Program>,
        expression: &Expression,
        moment: &Moment,
        initial: &[(Location, Value)],
    ) -> Result<Value, String> {
        let machine = self.machine(program, moment, initial);
        machine.forget_inputs();
        let mut environment = Known(&moment.inputs);
        machine.evaluate(expression, &mut environment).map_err(|fault| fault.show(program).to_string())
    }

    fn machine(&mut self, program: &Arc<Program>, moment: &Moment, initial: &[(Location, Value)]) -> &mut Machine {
        if !self.machine.as_ref().is_some_and(|machine| Arc::ptr_eq(machine.program(), program)) {
            self.at = None;
            let mut machine = Machine::new(Arc::clone(program), self.limits.clone());
            // Initial values that are evaluated late read the initial state. Where it has none, they have none.
            _ = machine.start(&mut Known(initial));
            self.machine = Some(machine);
        }
        let machine = self.machine.get_or_insert_with(|| Machine::new(Arc::clone(program), self.limits.clone()));
        if !self.at.as_ref().is_some_and(|at| Arc::ptr_eq(at, &moment.snapshot)) {
            machine.restore(&moment.snapshot);
            self.at = Some(Arc::clone(&moment.snapshot));
        }
        machine
    }
}

/// The inputs that are known.
struct Known<'a>(&'a [(Location, Value)]);

impl Environment for Known<'_> {
    fn monitored(&mut self, program: &Program, location: LocationRef<'_>, _domain: DomainId) -> Result<Value, String> {
        let location = location.to_location();
        let known = self.0.iter().find(|(known, _)| *known == location);
        match known {
            Some((_, value)) => Ok(value.clone()),
            None => Err(format!("{} was not asked for", location.show(program))),
        }
    }

    fn keeps_initial(&self, location: LocationRef<'_>) -> bool {
        let location = location.to_location();
        !self.0.iter().any(|(known, _)| *known == location)
    }

    fn choose(&mut self, _program: &Program, _choice: &Choice<'_>) -> Result<usize, String> {
        Ok(0)
    }

    fn time(&mut self, _unit: TimeUnit) -> Result<i64, String> {
        Err("the clock is only read in a step".to_string())
    }
}
