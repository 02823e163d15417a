//! What a replay needs besides the model's own main rule: the steps of single tasks, and changes of the configuration.
//!
//! In: a checked model. Out: procedures, added to its program. The rules are the library's own and stay as they are.
//! Only the configuration, which is state, is changed before a run. If the replay does not follow ticks, phases take no
//! time. Wait-free channels, which have no lock and keep only the latest datum, become shared values.

use std::sync::Arc;

use machine::{Closed, Limits, Machine};
use model::{DomainKind, Model};
use program::{ProcedureId, Program};
use syntax::ast::{self, AstNode};
use syntax::{Diagnostic, Severity, SourceFile, Sources};

use crate::vocabulary::{Named, Vocabulary};

/// Phases take no time, and a rest follows each. Each task gets a deadline of its own, so its period can differ while a
/// cycle ends.
const LOOSEN: &str = "par \
     forall $t in Task with isUndef(task_deadline($t)) do task_deadline($t) := task_period($t) \
     forall $p in SchedulePhase with true do time($p) := 0 \
     forall $q in SchedulePhase with action($q) != WAITING_TRIGGER do \
       extend SchedulePhase with $r do par \
         action($r) := ELABORATING time($r) := 0 nextPhase($r) := nextPhase($q) nextPhase($q) := $r \
       endpar \
   endpar";

/// The chosen component steps. One rule for all of them is compiled once.
const STEP: &str = "choose $c in Scheduler with true do par \
     r_scheduler_execute[$c] \
     forall $s in Semaphore with true do r_sem_arbitrate[$s] \
   endpar";

/// A tick of a system whose components have machines, without these: what they compute is not recorded.
const TICK: &str = "par \
     forall $c in Scheduler with true do r_scheduler_execute[$c] \
     forall $s in Semaphore with true do r_sem_arbitrate[$s] \
     clock := clock + 1 \
   endpar";

/// The rule of the tasks of such a system, as `chart build` names it.
const COMPUTING: &str = "r_computingTask";

/// What the names of the rules that end elaborations begin with.
const END: &str = "r_end_";

/// Adds the steps of tasks to a program.
#[derive(Debug, Clone)]
pub struct Steps {
    loosen: ProcedureId,
    /// A component, which is chosen, steps.
    step: ProcedureId,
    /// All components step, without their machines. None if none has one: the main rule is then such a step.
    tick: Option<ProcedureId>,
    /// For each phase in which a machine decides, the rule of its end.
    ends: Vec<(String, ProcedureId)>,
    /// One for each wait-free channel, by its name: it becomes a shared value.
    cells: Vec<(String, ProcedureId)>,
}

impl Steps {
    /// Adds the step of a component to a program, and the rules that make these channels shared values.
    ///
    /// # Errors
    /// The model lacks what they call.
    pub fn add(
        wait_free: &[String],
        sources: &mut Sources,
        model: &mut Model,
        program: &mut Program,
    ) -> Result<Steps, Vec<Diagnostic>> {
        // The rests and the cells are new; the library, where all phases and values are known, does not need them.
        for name in ["SchedulePhase", "SharedValue"] {
            if let Some(domain) = model.domain_named(name)
                && let DomainKind::Abstract { dynamic } = &mut model.domains.get_mut(domain).kind
            {
                *dynamic = true;
            }
        }
        *program = program::lower(model)?;
        let mut add = |text: &str| rule(text, sources, model, program);
        let loosen = add(LOOSEN)?;
        let step = add(STEP)?;
        let computes = computes(model);
        let mut add = |text: &str| rule(text, sources, model, program);
        let tick = if computes { Some(add(TICK)?) } else { None };
        let phases = ends_of(model);
        let end = |phase: String| Ok((phase.clone(), rule(&format!("{END}{phase}[]"), sources, model, program)?));
        let ends = phases.into_iter().map(end).collect::<Result<Vec<_>, Vec<Diagnostic>>>()?;
        let mut add = |text: &str| rule(text, sources, model, program);
        let cell = |name: &String| {
            format!(
                "extend SharedValue with $v do par \
                   sv_staged($v) := 0 sv_sequence($v) := 0 sv_overwritten($v) := 0 \
                   sv_received($v) := 0 sv_receivedSequence($v) := 0 sv_fresh($v) := false \
                   forall $p in SchedulePhase with sharedMemory($p) = {name} do par \
                     sharedValue($p) := $v sharedMemory($p) := undef \
                     switch action($p) case WRITING_ON_SB: action($p) := STORING \
                       case READING_FROM_SB: action($p) := LOADING endswitch \
                   endpar \
                 endpar"
            )
        };
        let cells: Result<Vec<_>, _> =
            wait_free.iter().map(|name| add(&cell(name)).map(|procedure| (name.clone(), procedure))).collect();
        Ok(Steps { loosen, step, tick, ends, cells: cells? })
    }

    /// The model in its initial state, with the wait-free channels as shared values, and what is known of it.
    ///
    /// # Errors
    /// It does not start, or is not made of the library of patterns; in words.
    pub fn start(&self, program: &Arc<Program>, limits: Limits) -> Result<(Machine, Vocabulary), String> {
        let mut machine = Machine::new(Arc::clone(program), limits);
        machine.start(&mut Closed).map_err(|fault| fault.show(program).to_string())?;
        let before = Vocabulary::new(program, &machine)?;
        if self.cells.is_empty() {
            return Ok((machine, before));
        }
        let mut names = Vec::new();
        for (name, procedure) in &self.cells {
            let phases = before.phases_on(&machine, name);
            run(&mut machine, *procedure)?;
            let Some(phase) = phases.first() else { unreachable!("the session has asked for phases on {name}") };
            names.push((before.get(&machine, Named::SharedValue, std::slice::from_ref(phase)), name.clone()));
        }
        let mut vocabulary = Vocabulary::new(program, &machine)?;
        names.into_iter().for_each(|(value, name)| vocabulary.call(value, &name));
        Ok((machine, vocabulary))
    }

    /// The step of a component, which the environment chooses: it is the first choice of the step, among all schedulers.
    pub fn step(&self) -> ProcedureId {
        self.step
    }

    /// The step of all components in a tick, if it is not the main rule.
    pub fn tick(&self) -> Option<ProcedureId> {
        self.tick
    }

    /// For each phase in which a machine decides, the rule of its end.
    pub fn ends(&self) -> &[(String, ProcedureId)] {
        &self.ends
    }

    /// From now on phases take no time, and a rest follows each.
    ///
    /// # Errors
    /// It is a fault of the model, in words.
    pub fn loosen(&self, machine: &mut Machine) -> Result<(), String> {
        run(machine, self.loosen)
    }
}

/// Whether components of the system have machines.
fn computes(model: &Model) -> bool {
    model.rules.iter().any(|rule| rule.name == COMPUTING)
}

/// The phases that have a rule of their end.
fn ends_of(model: &Model) -> Vec<String> {
    if !computes(model) {
        return Vec::new();
    }
    model.rules.iter().filter_map(|rule| rule.name.strip_prefix(END)).map(str::to_string).collect()
}

fn run(machine: &mut Machine, procedure: ProcedureId) -> Result<(), String> {
    let program = Arc::clone(machine.program());
    machine.prepare_procedure(procedure, &mut Closed).map_err(|fault| fault.show(&program).to_string())?;
    machine.commit();
    Ok(())
}

/// Adds a rule, given as text, to a program.
fn rule(
    text: &str,
    sources: &mut Sources,
    model: &mut Model,
    program: &mut Program,
) -> Result<ProcedureId, Vec<Diagnostic>> {
    let text = format!("scenario conformance\nload model.asm\nexec {text};\n");
    let file = sources.add(SourceFile::new("conformance", text.as_str()));
    let parse = syntax::parse_avalla(file, &text);
    let scenario = ast::ScenarioFile::cast(parse.syntax());
    let rule = scenario.and_then(|scenario| {
        scenario.commands().find_map(|command| match command {
            ast::Command::Exec(exec) => exec.rule(),
            _ => None,
        })
    });
    let Some(rule) = rule.filter(|_| parse.diagnostics.is_empty()) else { return Err(parse.diagnostics) };
    let fragment = model.check_rule(file, &rule);
    if fragment.diagnostics.iter().any(|fault| fault.severity == Severity::Error) {
        return Err(fragment.diagnostics);
    }
    program::lower_rule(program, model, &fragment.into_rule())
}
