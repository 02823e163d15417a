//! Event by event: where phases last as long as they last, one task steps at a time.
//!
//! In: the model, and any recording. The model's configuration is changed before the run, its rules are not: phases take no
//! time, and between two phases there is a rest, so that leaving the one and beginning the next are two steps. The clock
//! is set to the recorded instant. Then there must be an order of the tasks' steps, consistent with the recorded times,
//! in which each step has the events that were recorded. An action was taken between the event before it and the one
//! after it, where an event that is told before the action (asks, releases, sends, stores) narrows the beginning and one
//! told after it (enters, takes) the end; among actions that overlap every order is tried.

use std::sync::Arc;

use machine::{Change, Closed, Limits, Machine, Snapshot, Value};
use model::{DomainKind, Model};
use program::{ProcedureId, Program};
use syntax::ast::{self, AstNode};
use syntax::{Diagnostic, Severity, SourceFile, Sources};

use crate::Verdict;
use crate::evidence::{Claim, Parted, Recorded, objects};
use crate::timed::tracks;
use crate::vocabulary::Vocabulary;
use recording::{Event, Recording};

/// Phases take no time, and a rest comes behind each. A deadline is said of each task, so that its period can be another
/// while a cycle ends.
const PREPARE: &str = "par \
     forall $t in Task with isUndef(task_deadline($t)) do task_deadline($t) := task_period($t) \
     forall $p in SchedulePhase with true do time($p) := 0 \
     forall $q in SchedulePhase with action($q) != WAITING_TRIGGER do \
       extend SchedulePhase with $r do par \
         action($r) := ELABORATING time($r) := 0 nextPhase($r) := nextPhase($q) nextPhase($q) := $r \
       endpar \
   endpar";

/// LIMIT: so many decisions are kept to go back to.
const KEPT: usize = 64;
/// LIMIT: so many events of another task are looked at for one that may have come before.
const NEAR: usize = 64;
/// Kinds of events that no other task has to do with.
const LOCAL: &[&str] = &["begins", "ends", "passes", "meets", "misses", "invalid", "faults"];
/// The last so many events are shown where the two part.
const SHOWN: usize = 12;

/// The steps of the tasks, added to a program.
#[derive(Debug, Clone)]
pub struct Steps {
    prepare: ProcedureId,
    /// One a component, by its name.
    each: Vec<(String, ProcedureId)>,
}

impl Steps {
    /// Adds the steps of these components to a program.
    ///
    /// # Errors
    /// The model lacks what they call.
    pub fn add(
        components: &[String],
        sources: &mut Sources,
        model: &mut Model,
        program: &mut Program,
    ) -> Result<Steps, Vec<Diagnostic>> {
        // The rests are new phases, which the library, where all phases are known, has no need of.
        if let Some(phases) = model.domain_named("SchedulePhase") {
            if let DomainKind::Abstract { dynamic } = &mut model.domains.get_mut(phases).kind {
                *dynamic = true;
            }
            *program = program::lower(model)?;
        }
        let mut rule = |text: &str| -> Result<ProcedureId, Vec<Diagnostic>> {
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
            let span = fragment.item.span;
            let rule = model::Rule {
                name: "exec".to_string(),
                turbo: false,
                variables: fragment.variables,
                parameters: Vec::new(),
                result: None,
                body: fragment.item,
                span,
            };
            program::lower_rule(program, model, &rule)
        };
        let prepare = rule(PREPARE)?;
        let step = |name: &String| {
            format!("par r_scheduler_execute[{name}] forall $s in Semaphore with true do r_sem_arbitrate[$s] endpar")
        };
        let each: Result<Vec<_>, _> =
            components.iter().map(|name| rule(&step(name)).map(|procedure| (name.clone(), procedure))).collect();
        Ok(Steps { prepare, each: each? })
    }
}

/// A replay on its way.
struct Replay<'r> {
    machine: Machine,
    vocabulary: Vocabulary,
    procedures: Vec<ProcedureId>,
    tracks: Vec<&'r [Event]>,
    tick_ns: i64,
    cursors: Vec<usize>,
    /// The last tick of each component: its clock does not go back.
    ticks: Vec<i64>,
    agreed: usize,
}

/// A point to go back to.
struct Node {
    snapshot: Snapshot,
    cursors: Vec<usize>,
    ticks: Vec<i64>,
    agreed: usize,
    /// Components that have not been tried here, the last one first.
    open: Vec<usize>,
}

/// Holds a recording against the model.
///
/// # Errors
/// The model cannot be replayed, in words.
pub fn check(program: &Arc<Program>, limits: Limits, recording: &Recording, steps: &Steps) -> Result<Verdict, String> {
    let mut machine = Machine::new(Arc::clone(program), limits);
    machine.start(&mut Closed).map_err(|fault| fault.show(program).to_string())?;
    let vocabulary = Vocabulary::new(program, &mut machine)?;
    let procedure = |name: &String| {
        let found = steps.each.iter().find(|(known, _)| known == name).map(|(_, procedure)| *procedure);
        found.ok_or(format!("there is no step of {name}"))
    };
    let procedures: Result<Vec<_>, String> = vocabulary.components.iter().map(|known| procedure(&known.name)).collect();
    // What tasks do to come to an end is no run of the model.
    let known = recording.known_until_ns().or(recording.stopped_ns).unwrap_or(i64::MAX);
    let tracks = tracks(&vocabulary, recording)?;
    let tracks: Vec<&[Event]> =
        tracks.into_iter().map(|events| &events[..events.partition_point(|event| event.time_ns < known)]).collect();
    let fault = |fault: machine::Fault| fault.show(program).to_string();
    machine.prepare_procedure(steps.prepare, &mut Closed).map_err(fault)?;
    machine.commit();
    let (cursors, ticks) = (vec![0; tracks.len()], vec![0; tracks.len()]);
    let replay = Replay {
        machine,
        vocabulary,
        procedures: procedures?,
        tracks,
        tick_ns: recording.tick_ns,
        cursors,
        ticks,
        agreed: 0,
    };
    Ok(replay.run(recording.is_whole()))
}

impl Replay<'_> {
    fn run(mut self, is_whole: bool) -> Verdict {
        let mut stack: Vec<Node> = Vec::new();
        let mut deepest: Option<Parted> = None;
        loop {
            let open = self.candidates();
            if open.is_empty() {
                break;
            }
            let node = Node {
                snapshot: self.machine.snapshot(),
                cursors: self.cursors.clone(),
                ticks: self.ticks.clone(),
                agreed: self.agreed,
                open,
            };
            stack.push(node);
            if stack.len() > KEPT {
                stack.remove(0);
            }
            // The first way on that is possible; where there is none, back to the last decision that has another.
            loop {
                let Some(node) = stack.last_mut() else {
                    let parted = deepest.unwrap_or_else(|| unreachable!("a way was tried"));
                    return Verdict::Parts(Box::new(parted));
                };
                let Some(component) = node.open.pop() else {
                    stack.pop();
                    continue;
                };
                self.machine.restore(&node.snapshot);
                self.cursors.clone_from(&node.cursors);
                self.ticks.clone_from(&node.ticks);
                self.agreed = node.agreed;
                let rivals = self.rivals(component);
                match self.advance(component) {
                    // Other orders matter only among actions on one channel.
                    Ok(()) => {
                        node.open.retain(|other| rivals.contains(other));
                        break;
                    }
                    Err(parted) => {
                        if deepest.as_ref().is_none_or(|deepest| deepest.agreed < parted.agreed) {
                            deepest = Some(*parted);
                        }
                    }
                }
            }
        }
        if is_whole {
            Verdict::Conforms { events: self.agreed, steps: self.machine.steps() }
        } else {
            Verdict::Unknown { events: self.agreed, reason: "the recording has a gap, or ends early".to_string() }
        }
    }

    /// Components that may act next, the first one last: those whose action cannot have come after another one's.
    fn candidates(&self) -> Vec<usize> {
        let spans: Vec<(usize, i64, i64)> =
            (0..self.tracks.len()).filter_map(|index| self.span(index).map(|(from, to)| (index, from, to))).collect();
        let first = spans.iter().map(|(_, _, to)| *to).min().unwrap_or(i64::MAX);
        let mut open: Vec<(i64, usize)> =
            spans.iter().filter(|(_, from, _)| *from <= first).map(|(index, _, to)| (*to, *index)).collect();
        open.sort_unstable_by(|left, right| right.cmp(left));
        open.into_iter().map(|(_, index)| index).collect()
    }

    /// The components that act on the channel of this one's next action, perhaps before it.
    fn rivals(&self, component: usize) -> Vec<usize> {
        let at = self.acts(component);
        let Some(event) = self.tracks[component].get(at).filter(|event| !LOCAL.contains(&event.kind.as_str())) else {
            return Vec::new();
        };
        let until = self.span(component).map_or(i64::MIN, |(_, to)| to);
        let meets = |other: &usize| {
            let events = self.tracks[*other][self.cursors[*other]..].iter();
            // An action is recorded at the latest by the event after it.
            let near = events.take(NEAR).take_while(|other| other.time_ns <= until);
            *other != component && near.into_iter().any(|other| other.object == event.object)
        };
        (0..self.tracks.len()).filter(meets).collect()
    }

    /// The event by which a component acts next: what comes with a beginning, or else the next one.
    fn acts(&self, index: usize) -> usize {
        let (events, at) = (self.tracks[index], self.cursors[index]);
        match (events.get(at), events.get(at + 1)) {
            (Some(event), Some(next))
                if event.kind == "begins" && ["asks", "takes", "loads", "writes"].contains(&next.kind.as_str()) =>
            {
                at + 1
            }
            _ => at,
        }
    }

    /// Between which instants the next action of a component was taken.
    fn span(&self, index: usize) -> Option<(i64, i64)> {
        let events = self.tracks[index];
        let at = self.cursors[index];
        let event = events.get(at)?;
        let before = at.checked_sub(1).map_or(i64::MIN, |before| events[before].time_ns);
        let acts = self.acts(index);
        let told_before = ["asks", "releases", "sends", "stores", "refuses"].contains(&events[acts].kind.as_str());
        let from = if told_before || acts > at { event.time_ns } else { before };
        let to =
            if told_before { events.get(acts + 1).map_or(i64::MAX, |next| next.time_ns) } else { events[acts].time_ns };
        Some((from, to))
    }

    /// Makes the steps that the component's next events are of.
    fn advance(&mut self, component: usize) -> Result<(), Box<Parted>> {
        let event = self.tracks[component][self.cursors[component]].clone();
        match event.kind.as_str() {
            "invalid" | "faults" => {
                self.cursors[component] += 1;
                self.agreed += 1;
                return Ok(());
            }
            "passes" => return self.pass(component, &event),
            _ => {}
        }
        let tick = event.time_ns.div_euclid(self.tick_ns).max(self.ticks[component]);
        // At the end of a cycle the exact instant decides: in time, or within the tick too late.
        let ticks = match event.kind.as_str() {
            "meets" | "misses" => vec![tick, tick + i64::from(event.time_ns.rem_euclid(self.tick_ns) > 0)],
            _ => vec![tick],
        };
        let start = self.machine.snapshot();
        let mut parted = None;
        for tick in ticks {
            self.machine.restore(&start);
            match self.advance_at(component, tick) {
                Ok(()) => return Ok(()),
                Err(found) => _ = parted.get_or_insert(found),
            }
        }
        Err(parted.unwrap_or_else(|| self.parted(component, Vec::new(), "no step is possible".to_string())))
    }

    fn advance_at(&mut self, component: usize, tick: i64) -> Result<(), Box<Parted>> {
        let next = &self.tracks[component][self.cursors[component]..];
        // Before giving up a lock the model counts each tick that it waits; between phases it rests for a step.
        let waited = match (next[0].kind.as_str(), self.cursors[component].checked_sub(1)) {
            ("gives_up" | "refuses", Some(before)) => {
                let asked = self.tracks[component][before].time_ns;
                ((next[0].time_ns - asked) / self.tick_ns).max(0)
            }
            _ => 0,
        };
        for _ in 0..waited + 3 {
            let ends = ["meets", "misses"].contains(&next[0].kind.as_str());
            let changes =
                self.step(component, tick, ends).map_err(|fault| self.parted(component, Vec::new(), fault))?;
            let claims = self.vocabulary.claims(&self.machine, &changes);
            let (own, others): (Vec<_>, Vec<_>) = claims.into_iter().partition(|(of, _)| *of == component);
            debug_assert!(others.is_empty(), "one task steps");
            let own: Vec<Claim> = own.into_iter().map(|(_, claim)| claim).collect();
            if own.is_empty() {
                let waits = !changes.is_empty()
                    && (["gives_up", "refuses"].contains(&next[0].kind.as_str()) || self.rests(&changes));
                if waits {
                    continue;
                }
                return Err(self.parted(component, own, "the model's task cannot go on here".to_string()));
            }
            let recorded = &next[..own.len().min(next.len())];
            let mut open: Vec<&Claim> = own.iter().collect();
            for event in recorded {
                match open.iter().position(|claim| claim.event.same(event)) {
                    Some(at) => _ = open.swap_remove(at),
                    None => {
                        let mut parted = self.parted(component, own.clone(), String::new());
                        parted.event = Some(event.clone());
                        parted.reason = None;
                        return Err(parted);
                    }
                }
            }
            self.ticks[component] = tick;
            // The recording may end within a step.
            self.cursors[component] += recorded.len();
            self.agreed += recorded.len();
            return Ok(());
        }
        Err(self.parted(component, Vec::new(), "the model's task would still wait for the lock".to_string()))
    }

    /// The step led from one phase to the next, or to the waiting one.
    fn rests(&self, changes: &[Change]) -> bool {
        let moved = self.vocabulary.location("scheduler_currentPhase", &[]).function;
        changes.iter().any(|change| change.location.function == moved)
    }

    /// A step of a component. When a cycle `ends` late the model begins the next one in the same step, where the program
    /// comes to it later; with no end of the period in sight it waits first.
    fn step(&mut self, component: usize, tick: i64, ends: bool) -> Result<Vec<Change>, String> {
        let program = Arc::clone(self.machine.program());
        let fault = |fault: machine::Fault| fault.show(&program).to_string();
        let clock = self.vocabulary.location("clock", &[]);
        let task = self.vocabulary.components[component].task.clone();
        let period = self.vocabulary.location("task_period", &[task]);
        let length = self.machine.value(&period);
        self.machine.set(&clock, Value::Integer(tick)).map_err(fault)?;
        if ends {
            self.machine.set(&period, Value::Integer(i64::MAX / 2)).map_err(fault)?;
        }
        self.machine.prepare_procedure(self.procedures[component], &mut Closed).map_err(fault)?;
        self.machine.commit();
        let changes = self.machine.changes();
        if ends {
            self.machine.set(&period, length).map_err(fault)?;
        }
        Ok(changes)
    }

    /// There was nothing to hand over: the writing phase is passed over, which the program alone decides.
    fn pass(&mut self, component: usize, event: &Event) -> Result<(), Box<Parted>> {
        let scheduler = self.vocabulary.components[component].scheduler.clone();
        let current = self.vocabulary.location("scheduler_currentPhase", &[scheduler]);
        let phase = self.vocabulary.get(&self.machine, "nextPhase", &[self.machine.value(&current)]);
        if self.vocabulary.phase_named(&self.machine, component, &event.object) != Some(phase.clone()) {
            return Err(self.parted(component, Vec::new(), "the model's task is not before this phase".to_string()));
        }
        let rest = self.vocabulary.get(&self.machine, "nextPhase", &[phase]);
        let set = self.machine.set(&current, rest);
        set.map_err(|_| self.parted(component, Vec::new(), "the phase cannot be passed over".to_string()))?;
        self.cursors[component] += 1;
        self.agreed += 1;
        Ok(())
    }

    fn parted(&self, component: usize, claims: Vec<Claim>, reason: String) -> Box<Parted> {
        let event = self.tracks[component].get(self.cursors[component]).cloned();
        let named = self.vocabulary.components.iter().zip(&self.tracks).zip(&self.cursors);
        let mut before: Vec<Recorded> = named
            .flat_map(|((known, events), cursor)| {
                let recorded = |event: &Event| Recorded { task: known.name.clone(), event: event.clone() };
                events[cursor.saturating_sub(SHOWN)..*cursor].iter().map(recorded).collect::<Vec<_>>()
            })
            .collect();
        before.sort_by_key(|recorded| recorded.event.time_ns);
        let state = self.vocabulary.state(&self.machine, component, &objects(event.as_ref(), &claims));
        Box::new(Parted {
            tick: event.as_ref().map_or(0, |event| event.time_ns.div_euclid(self.tick_ns)),
            task: self.vocabulary.components[component].name.clone(),
            event,
            claims,
            reason: Some(reason),
            agreed: self.agreed,
            before: before.split_off(before.len().saturating_sub(SHOWN)),
            state,
        })
    }
}
