//! What a replay needs besides the model's own main rule: the steps of single tasks, those of machines, and changes of the configuration.
//!
//! In: a checked model. Out: its program, with procedures added. The main rule is the model's own. If components have machines, the model is
//! lowered twice: with ends of elaborations that only tell so (`ends`), which events are held to; and as it is, for what is decided there.
//! Only the configuration, which is state, is changed before a run. If the replay does not follow ticks, phases take no
//! time. Wait-free channels, which have no lock and keep only the latest datum, become shared values.

use std::sync::Arc;

use machine::{Closed, Limits, Machine};
use model::{DomainId, DomainKind, FunctionId, Model};
use program::{ProcedureId, Program};
use syntax::ast::{self, AstNode};
use syntax::{Diagnostic, Severity, SourceFile, Sources};

use crate::apart::{entangled, without_counts};
use crate::ends::{self, Ends};
use crate::refusal::Refusal;
use crate::single::one_task_steps;
use crate::vocabulary::{Named, Vocabulary};
use crate::way::Way;

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

/// The programs of a model, and its steps in them.
#[derive(Debug, Clone)]
pub struct Steps {
    /// The program that makes the steps of all tasks.
    pub program: Arc<Program>,
    /// The program that makes the steps of single tasks, without the rules that only count.
    single: Arc<Program>,
    loosen: ProcedureId,
    /// A component, which is chosen, steps; otherwise why none can by itself.
    step: Result<ProcedureId, String>,
    /// What is computed at ends of elaborations; none if no component has a machine.
    decisions: Option<Decisions>,
    /// One for each wait-free channel, by its name: it becomes a shared value.
    cells: Vec<(String, ProcedureId)>,
}

/// What is computed at ends of elaborations.
#[derive(Debug, Clone)]
pub struct Decisions {
    /// The model as it is.
    pub program: Arc<Program>,
    /// For each phase at whose end something is computed, what the model does there.
    pub ends: Vec<End>,
    /// In the program of the steps, the function that tells that an elaboration ended.
    told: FunctionId,
}

/// The end of an elaboration.
#[derive(Debug, Clone)]
pub struct End {
    /// The phase.
    pub phase: String,
    /// What the model does when it ends.
    pub computes: ProcedureId,
    /// The rule that `chart build` wrote for it, and for no other.
    pub own: ProcedureId,
}

impl Steps {
    /// Makes the programs of a model that has these functions of the library.
    ///
    /// # Errors
    /// The model lacks what the replay calls, or cannot be taken apart.
    pub fn new(
        wait_free: &[String],
        sources: &mut Sources,
        model: &mut Model,
        vocabulary: &Vocabulary,
    ) -> Result<Steps, Refusal> {
        // The rests and the cells are new; the library, where all phases and values are known, does not need them.
        for name in ["SchedulePhase", "SharedValue"] {
            if let Some(domain) = model.domain_named(name)
                && let DomainKind::Abstract { dynamic } = &mut model.domains.get_mut(domain).kind
            {
                *dynamic = true;
            }
        }
        let faulty = |sources: &Sources, faults| Refusal::Model(sources.clone(), faults);
        let of = |named: Named| model.function(vocabulary.function(named)).parameters[0];
        let (phase, scheduler) = (of(Named::Action), of(Named::CurrentPhase));
        let clock = vocabulary.function(Named::Clock);
        let decisions = match ends::phases(model, phase) {
            phases if phases.is_empty() => None,
            phases => {
                let decisions = Decisions::new(phases, (clock, phase), sources, model);
                Some(decisions.map_err(|faults| faulty(sources, faults))?)
            }
        };
        let added = |sources: &mut Sources, model: &mut Model| -> Result<_, Vec<Diagnostic>> {
            let mut program = program::lower(model)?;
            let loosen = rule(LOOSEN, sources, model, &mut program)?;
            let step = match one_task_steps(model, scheduler) {
                Ok(step) => Ok(program::lower_rule(&mut program, model, &step)?),
                Err(words) => Err(words),
            };
            let cell = |name: &String| Ok((name.clone(), rule(&cell(name), sources, model, &mut program)?));
            let cells = wait_free.iter().map(cell).collect::<Result<Vec<_>, Vec<Diagnostic>>>()?;
            Ok((program, loosen, step, cells))
        };
        let (program, loosen, step, cells) = added(sources, model).map_err(|faults| faulty(sources, faults))?;
        let told = || vocabulary.functions().chain(decisions.as_ref().map(|decisions| decisions.told));
        if let Some(Decisions { program: computes, ends, .. }) = &decisions
            && let Some(words) = entangled(&program, told(), computes, ends.iter().map(|end| end.computes))
        {
            return Err(Refusal::Words(words));
        }
        let mut single = program.clone();
        if let Ok(step) = step {
            without_counts(&mut single, step, told());
        }
        let (program, single) = (Arc::new(program), Arc::new(single));
        Ok(Steps { program, single, loosen, step, decisions, cells })
    }

    /// The model in its initial state, with the wait-free channels as shared values, what is known of it, and its ends of elaborations. It
    /// makes steps of all tasks, or of single ones.
    ///
    /// # Errors
    /// It does not start, or is not made of the library of patterns; in words.
    pub fn start(&self, way: Way, limits: Limits) -> Result<(Machine, Vocabulary, Ends), String> {
        let program = if way == Way::Timed { &self.program } else { &self.single };
        let (mut machine, vocabulary) = self.start_cells(program, limits)?;
        let Some(decisions) = &self.decisions else { return Ok((machine, vocabulary, Ends::default())) };
        let phases: Vec<String> = decisions.ends.iter().map(|end| end.phase.clone()).collect();
        let ends = Ends::start(decisions.told, &phases, &mut machine, &vocabulary);
        let ends = ends.map_err(|fault| fault.show(&self.program).to_string())?;
        Ok((machine, vocabulary, ends))
    }

    fn start_cells(&self, program: &Arc<Program>, limits: Limits) -> Result<(Machine, Vocabulary), String> {
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

    /// The step of a component, which the environment chooses among all schedulers.
    ///
    /// # Errors
    /// In words, why no step of one task can be made of the model's main rule.
    pub fn step(&self) -> Result<ProcedureId, String> {
        self.step.clone()
    }

    /// What is computed at ends of elaborations; none if no component has a machine.
    pub fn decisions(&self) -> Option<&Decisions> {
        self.decisions.as_ref()
    }

    /// From now on phases take no time, and a rest follows each.
    ///
    /// # Errors
    /// It is a fault of the model, in words.
    pub fn loosen(&self, machine: &mut Machine) -> Result<(), String> {
        run(machine, self.loosen)
    }
}

impl Decisions {
    /// Lowers the model as it is, and leaves one in which the ends of elaborations only tell so.
    fn new(
        phases: Vec<String>,
        (clock, phase): (FunctionId, DomainId),
        sources: &mut Sources,
        model: &mut Model,
    ) -> Result<Decisions, Vec<Diagnostic>> {
        let mut program = program::lower(model)?;
        let mut all = Vec::new();
        for name in phases {
            let own = rule(&format!("{}{name}[]", ends::END_OF), sources, model, &mut program)?;
            let computes = match ends::has_rule(model) {
                true => rule(&format!("{}[{name}]", ends::END), sources, model, &mut program)?,
                false => own,
            };
            all.push(End { phase: name, computes, own });
        }
        Ok(Decisions { program: Arc::new(program), ends: all, told: ends::tell(model, clock, phase) })
    }
}

/// Lets a wait-free channel be a shared value.
fn cell(name: &str) -> String {
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
