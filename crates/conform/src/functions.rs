//! Replays what components' machines decide: each decision by the machine alone, from what the program got.
//!
//! In: the model, and the recorded decisions of each task. Out: the first that the machine makes otherwise. A decision is a group of
//! records: what was got, then what was decided. What was got is set in a machine of the model of its own, in which nothing else happens,
//! and the model's rule of ends of elaborations makes the step there. So when it was decided does not matter, and the way in which events are
//! compared neither. INVARIANT: the state of a component is that after its own decisions, and no other component's step changes it.

use std::collections::{BTreeMap, BTreeSet};
use std::sync::Arc;

use machine::{Choice, Environment, Limits, Location, LocationRef, Machine, Show, TimeUnit, Value};
use model::Basic;
use program::{DomainId, DomainKind, FunctionId, FunctionKind, ProcedureId, Program, Rule, Runs, Term};
use recording::{Decision, Recording};

use crate::carried::{Carried, To, Unlike, goes_on};
use crate::elaborated::Elaborated;
use crate::evidence::Parted;
use crate::kept::{Kept, drawn};
use crate::steps::{End, Steps};
use crate::vocabulary::{self, Vocabulary};

/// The machines of a model's components, and how far each has come.
#[derive(Debug)]
pub(crate) struct Functions {
    machine: Machine,
    tasks: Vec<Task>,
    /// The channels by their names.
    channels: BTreeMap<String, Value>,
    /// How many decisions agree.
    agreed: usize,
    /// What went through the channels.
    carried: Carried,
}

#[derive(Debug)]
struct Task {
    name: String,
    /// The elaborations at whose end it computes something; if it has a machine, one.
    ends: Vec<End>,
    /// The channels and sensors from which its machine gets something, and the channels and actuators for which it decides.
    parts: [Vec<String>; 2],
    /// What its decisions leave in the model.
    kept: Kept,
    /// What the first decision was made of: what was got, then what was decided.
    shape: Option<Vec<(bool, Arc<str>, u64)>>,
    /// The next decision.
    cursor: usize,
    /// Where its decisions were recorded.
    elaborated: Elaborated,
}

impl Functions {
    /// Starts the machines; none has decided yet.
    ///
    /// # Errors
    /// The model does not start, in words.
    pub(crate) fn new(limits: Limits, steps: &Steps) -> Result<Functions, String> {
        let decisions = steps.decisions();
        let program = decisions.map_or(&steps.program, |decisions| &decisions.program);
        let ends = decisions.map_or(&[][..], |decisions| &decisions.ends);
        let mut machine = Machine::new(Arc::clone(program), limits);
        machine.start(&mut Got::default()).map_err(|fault| fault.show(program).to_string())?;
        let (mut tasks, mut channels) = (Vec::new(), BTreeMap::new());
        let (mut names, mut elaborations) = (BTreeMap::new(), BTreeSet::new());
        if !ends.is_empty() {
            let vocabulary = Vocabulary::new(program, &machine)?;
            for (index, component) in vocabulary.components.iter().enumerate() {
                let is_own = |end: &&End| vocabulary.phase_named(&machine, index, &end.phase).is_some();
                for phase in &component.phases {
                    let channel = vocabulary.channel(&machine, phase);
                    if channel.is_undef() {
                        elaborations.insert(phase.show(program).to_string());
                        continue;
                    }
                    let name = channel.show(program).to_string();
                    if vocabulary.end(&channel, vocabulary::End::Writes) == Some(index)
                        && let Some(function) = drawn(program, &vocabulary, &component.name, &name)
                    {
                        let own = program.function(function).name.strip_prefix(&format!("{}_", component.name));
                        names.insert(name.clone(), own.unwrap_or_default().to_string());
                    }
                    channels.insert(name, channel);
                }
                let ends: Vec<End> = ends.iter().filter(is_own).cloned().collect();
                if !ends.is_empty() {
                    let (name, parts) = (component.name.clone(), [Vec::new(), Vec::new()]);
                    let (shape, cursor, elaborated) = (None, 0, Elaborated::new(&ends[0].phase));
                    let kept = Kept::of(&machine, &vocabulary, index);
                    tasks.push(Task { name, ends, parts, kept, shape, cursor, elaborated });
                }
            }
            // What a component writes without a machine is an input of the model: the program says nothing of it.
            let of = |task: &Task, kind: FunctionKind| -> Vec<String> {
                let is_kind = |channel: &&String| {
                    let own = program.find_function(&format!("{}_{channel}", task.name), 0);
                    own.is_some_and(|own| program.function(own).kind == kind)
                };
                channels.keys().filter(is_kind).cloned().collect()
            };
            let given = |task: &Task| {
                let drawn = channels.keys().filter_map(|channel| drawn(program, &vocabulary, &task.name, channel));
                drawn.into_iter().any(|function| program.function(function).kind == FunctionKind::Monitored)
            };
            let (own, others) =
                tasks.into_iter().partition(|task| of(task, FunctionKind::Monitored).is_empty() && !given(task));
            tasks = own;
            are_kept(&mut machine, others)?;
            for task in &mut tasks {
                let [sensors, actuators] = devices(program, task.ends[0].own);
                task.parts = [of(task, FunctionKind::Derived), of(task, FunctionKind::Controlled)];
                let is_told = |channel: &&String| {
                    // The machine knows a channel to several readers by the name that is drawn.
                    let own = channel.strip_suffix(&task.name).and_then(|rest| rest.strip_suffix('_'));
                    let own = own.filter(|drawn| !channels.contains_key(*drawn)).unwrap_or(channel);
                    let mut letters = own.chars();
                    let first = letters.next().map(|first| first.to_uppercase().to_string()).unwrap_or_default();
                    let name = format!("{}_isNew{first}{}", task.name, letters.as_str());
                    program.find_function(&name, 0).is_some()
                };
                let told: Vec<String> = channels.keys().filter(is_told).cloned().collect();
                for (parts, more) in task.parts.iter_mut().zip([[sensors, told].concat(), actuators]) {
                    parts.extend(more);
                    parts.sort();
                    parts.dedup();
                }
            }
        }
        let carried = Carried::new(channels.keys().cloned().collect(), names, elaborations);
        Ok(Functions { machine, tasks, channels, agreed: 0, carried })
    }

    /// How many decisions agree.
    pub(crate) fn agreed(&self) -> usize {
        self.agreed
    }

    /// Goes on as far as decisions are known; the first that the machine makes otherwise.
    pub(crate) fn go_on(&mut self, recording: &Recording, more: bool) -> Option<Parted> {
        for index in 0..self.tasks.len() {
            let Some(track) = recording.tracks.iter().find(|track| track.task == self.tasks[index].name) else {
                continue;
            };
            let more = goes_on(recording, track, more);
            while let Some(group) = next(&track.decisions[self.tasks[index].cursor..], more) {
                let decisions = &track.decisions[self.tasks[index].cursor..][..group];
                let malformed = self
                    .unlike(index, decisions)
                    .or_else(|| self.outside(index, decisions))
                    .or_else(|| self.tasks[index].elaborated.misplaced(&track.events, decisions));
                if let Some(reason) = malformed {
                    return Some(self.parted(self.named(index), recording, decisions, reason));
                }
                if let Some(reason) = self.decide(index, decisions) {
                    return Some(self.parted(self.named(index), recording, decisions, reason));
                }
                self.tasks[index].cursor += group;
                self.agreed += 1;
            }
            // Each elaboration that has ended has decided, and is recorded.
            let lacks = if more { None } else { self.tasks[index].elaborated.lacks(&track.events) };
            if let Some(reason) = lacks {
                return Some(self.parted(self.named(index), recording, &[], reason));
            }
        }
        let is_known = |task: &str| self.tasks.iter().any(|known| known.name == task);
        for track in recording.tracks.iter().filter(|track| !is_known(&track.task)) {
            if let Some(decision) = track.decisions.first() {
                let did = if decision.is_got { "got" } else { "decided for" };
                let reason = format!("{did} {}, and has no machine in the model", decision.object);
                return Some(self.parted((&track.task, None), recording, &track.decisions[..1], reason));
            }
        }
        let unlike = self.carried.go_on(recording, more)?;
        self.changed_on_the_way(recording, &unlike)
    }

    /// A datum that came out of its channel as another one.
    fn changed_on_the_way(&self, recording: &Recording, unlike: &Unlike) -> Option<Parted> {
        let task = &recording.tracks[unlike.track].task;
        let index = self.tasks.iter().position(|known| known.name == *task)?;
        let program = self.machine.program();
        let name = &unlike.got[0].object;
        let table = program.find_function(&format!("{name}_value"), 1)?;
        let got = recorded(program, table, &unlike.got);
        let reason = match &unlike.to {
            To::Nothing => format!("got {name} = {} before there was a datum", got.show(program)),
            To::Newness(true) => format!("got {name} as not new, and its reading brought a new one: {}", unlike.number),
            To::Newness(false) => format!("got {name} as new, and its last reading brought no new one"),
            To::Before { track, number, got: before } => {
                let (other, object) = (&recording.tracks[*track].task, &before[0].object);
                let who = if other == task { "it" } else { other };
                format!(
                    "got {name} = {} as datum {}, which {who} got from {object} at {:.4} ms as {} (datum {number})",
                    got.show(program),
                    unlike.number,
                    before[0].time_ns as f64 / 1e6,
                    recorded(program, table, before).show(program),
                )
            }
            To::Decided(decided) => format!(
                "got {name} = {} as datum {}, which was decided as {}",
                got.show(program),
                unlike.number,
                recorded(program, table, decided).show(program)
            ),
        };
        Some(self.parted(self.named(index), recording, &unlike.got, reason))
    }

    /// What of a decision is missing or too much, if it is not made of what decisions of this task are made of.
    fn unlike(&mut self, index: usize, decisions: &[Decision]) -> Option<String> {
        let task = &mut self.tasks[index];
        let shape: Vec<(bool, Arc<str>, u64)> =
            decisions.iter().map(|one| (one.is_got, Arc::clone(&one.object), one.part)).collect();
        for (is_got, parts) in [(true, &task.parts[0]), (false, &task.parts[1])] {
            let has = |part: &&String| shape.iter().any(|(got, object, _)| *got == is_got && **object == ***part);
            if let Some(part) = parts.iter().find(|part| !has(part)) {
                return Some(match is_got {
                    true => format!("decided, and it is not recorded what it got from {part}"),
                    false => format!("decided, and it is not recorded what for {part}"),
                });
            }
        }
        let first = task.shape.get_or_insert_with(|| shape.clone());
        if *first == shape {
            return None;
        }
        let other =
            first.iter().find(|part| !shape.contains(part)).or_else(|| shape.iter().find(|part| !first.contains(part)));
        let (is_got, object, _) = other.or_else(|| shape.first())?;
        let verb = if *is_got { "got" } else { "decided" };
        Some(format!("{verb} other things than in its first decision: see {object}"))
    }

    /// A task with a machine, for [`Functions::parted`].
    fn named(&self, index: usize) -> (&str, Option<usize>) {
        (&self.tasks[index].name, Some(index))
    }

    /// A difference of a task, which has a machine in the model if there is one with its name here.
    fn parted(
        &self,
        (task, machine): (&str, Option<usize>),
        recording: &Recording,
        decisions: &[Decision],
        reason: String,
    ) -> Parted {
        let time_ns = decisions.last().map_or(0, |decision| decision.time_ns);
        Parted {
            tick: time_ns.div_euclid(recording.tick_ns.max(1)),
            task: task.to_string(),
            event: None,
            claims: Vec::new(),
            reason: Some(reason),
            decides: true,
            agreed: self.agreed,
            before: Vec::new(),
            state: machine.map(|index| self.state(index)).unwrap_or_default(),
        }
    }

    /// The component's own part of the state.
    fn state(&self, index: usize) -> Vec<(String, String)> {
        let program = self.machine.program();
        let prefix = format!("{}_", self.tasks[index].name);
        let own = |location: &Location| {
            let function = &program.function(location.function);
            function.name.starts_with(&prefix) && function.kind == FunctionKind::Controlled
        };
        let all = self.machine.locations().into_iter().filter(|(location, _)| own(location));
        all.map(|(location, value)| (location.show(program).to_string(), value.show(program).to_string())).collect()
    }

    /// The first of these records that is no value of its domain, in words.
    fn outside(&mut self, index: usize, decisions: &[Decision]) -> Option<String> {
        let program = Arc::clone(self.machine.program());
        for decision in decisions.iter().filter(|one| one.known) {
            let name = &decision.object;
            let own = || program.find_function(&format!("{}_{name}", self.tasks[index].name), 0);
            let table = program.find_function(&format!("{name}_value"), 1);
            let Some(function) = table.or_else(own).or_else(|| program.find_function(name, 0)) else { continue };
            let mut parts = Vec::new();
            leaves(&program, program.function(function).codomain, &mut parts);
            // That a part is missing, or one too many, is found where it is compared.
            let Some(domain) = usize::try_from(decision.part).ok().and_then(|part| parts.get(part)).copied() else {
                continue;
            };
            let base = program.base_domain(domain);
            let is_value = match &program.domain(base).kind {
                DomainKind::Enum { literals } => decision.bits < literals.len() as u64,
                DomainKind::Basic(Basic::Boolean) => decision.bits < 2,
                DomainKind::Basic(Basic::Integer | Basic::Natural) => true,
                // A real number that is none is undef.
                _ => continue,
            };
            let is_value = is_value
                && value(&program, domain, &mut std::iter::once(decision.bits))
                    .is_some_and(|value| self.machine.contains(domain, &value));
            if !is_value {
                let did = if decision.is_got { "got" } else { "decided" };
                let (bits, domain) = (decision.bits as i64, &program.domain(domain).name);
                return Some(format!("{did} {name} = {bits}, which is no value of {domain}"));
            }
        }
        None
    }

    /// Makes a decision; why it is another one.
    fn decide(&mut self, index: usize, decisions: &[Decision]) -> Option<String> {
        let program = Arc::clone(self.machine.program());
        let mut got = Got::default();
        let mut words = Vec::new();
        for values in whole(decisions).filter(|values| values[0].is_got) {
            match self.give(&program, index, values, &mut got) {
                Ok(text) => words.push(text),
                Err(reason) => return Some(reason),
            }
        }
        let from = if words.is_empty() { String::new() } else { format!(" from {}", words.join(", ")) };
        let end = self.tasks[index].ends[0].computes;
        if let Err(fault) = self.machine.prepare_procedure(end, &mut got) {
            return Some(format!("its machine cannot decide{from}: {}", fault.show(&program)));
        }
        self.machine.commit();
        for values in whole(decisions).filter(|values| !values[0].is_got) {
            let decision = &values[0];
            let own = format!("{}_{}", self.tasks[index].name, decision.object);
            let function = program.find_function(&own, 0).or_else(|| program.find_function(&decision.object, 0));
            let Some(function) = function else {
                return Some(format!("the model does not know what it decides for {}", decision.object));
            };
            let decided = self.machine.value_at(LocationRef { function, arguments: &[] });
            let recorded = recorded(&program, function, values);
            if decided != recorded {
                let (name, did, does) = (&decision.object, recorded.show(&program), decided.show(&program));
                return Some(format!(
                    "decided {name} = {did}, its machine {does}{}{from}",
                    if from.is_empty() { "" } else { "," }
                ));
            }
        }
        let lacks = self.tasks[index].kept.lacks(&self.machine)?;
        Some(format!("decided as its machine does, but in the model {lacks}"))
    }

    /// Sets what was got; says it in words.
    fn give(&mut self, program: &Program, index: usize, values: &[Decision], got: &mut Got) -> Result<String, String> {
        let decision = &values[0];
        let name = decision.object.as_ref();
        let unknown = || format!("the model does not know what it gets from {name}");
        let function = |name: &str, arity| program.find_function(name, arity).ok_or_else(unknown);
        let Some(table) = program.find_function(&format!("{name}_value"), 1) else {
            let sensor = function(name, 0)?;
            let value = recorded(program, sensor, values);
            let text = format!("{name} = {}", value.show(program));
            got.said.push((sensor, value));
            return Ok(text);
        };
        let element = function(name, 0)?;
        let domain = program.domain(program.function(element).codomain).name.clone();
        let channel = self.channels.get(name).cloned().ok_or_else(unknown)?;
        let value = recorded(program, table, values);
        let text = format!("{name} = {}{}", value.show(program), if decision.fresh { " (new)" } else { "" });
        // Nothing was read here, so the number of what was read last is that of the initial state.
        self.set(Location { function: table, arguments: vec![Value::Integer(0)] }, value)?;
        let (fresh, arguments, is_new) = match domain.as_str() {
            "SwingingBuffer" => (function("sb_fresh", 1)?, vec![channel], Value::Boolean(decision.fresh)),
            "SharedValue" => (function("sv_fresh", 1)?, vec![channel], Value::Boolean(decision.fresh)),
            // None of a queue was taken; to have seen another number is to be told of a new one.
            _ => match program.find_function(&format!("{}_taken_{name}", self.tasks[index].name), 0) {
                Some(taken) => (taken, Vec::new(), Value::Integer(if decision.fresh { -1 } else { 0 })),
                None => return Ok(text),
            },
        };
        self.set(Location { function: fresh, arguments }, is_new)?;
        Ok(text)
    }

    fn set(&mut self, location: Location, value: Value) -> Result<(), String> {
        self.machine.set(&location, value).map_err(|fault| fault.show(self.machine.program()).to_string())
    }
}

/// Whether the model keeps what tasks compute without a machine. No recording says what it is, so any value stands for it.
fn are_kept(machine: &mut Machine, tasks: Vec<Task>) -> Result<(), String> {
    let program = Arc::clone(machine.program());
    for Task { name, ends, kept, .. } in tasks {
        let mut given = Got::default();
        for own in kept.data().map(|datum| datum.own) {
            let domain = program.function(own).codomain;
            let some = value(&program, domain, &mut std::iter::repeat(0));
            given.said.extend(some.filter(|some| machine.contains(domain, some)).map(|some| (own, some)));
        }
        for end in &ends {
            let made = machine.prepare_procedure(end.computes, &mut given);
            made.map_err(|fault| format!("the model cannot end {}: {}", end.phase, fault.show(&program)))?;
            machine.commit();
        }
        let said = |own: FunctionId| given.said.iter().find(|(known, _)| *known == own).map(|(_, some)| some.clone());
        if let Some(lacks) = kept.lacks_datum(machine, &said) {
            return Err(format!("the model loses what {name} computes: {lacks}"));
        }
    }
    Ok(())
}

/// The sensors that the end of an elaboration reads, and the actuators that it sets, by calls and definitions too. What a machine only
/// declares, and neither reads nor sets, is not among them.
fn devices(program: &Program, end: ProcedureId) -> [Vec<String>; 2] {
    let (mut read, mut set) = (BTreeSet::new(), BTreeSet::new());
    let (mut procedures, mut entered) = (vec![end], BTreeSet::new());
    let (mut rules, mut terms, mut defined) = (Vec::new(), Vec::new(), BTreeSet::new());
    while let Some(procedure) = procedures.pop() {
        if !entered.insert(procedure.0) {
            continue;
        }
        rules.push(program.procedure(procedure).body);
        while let Some(rule) = rules.pop() {
            if let Rule::Update { function, .. } | Rule::Return { function, .. } = program.rule(rule) {
                set.insert(*function);
            }
            if let Runs::Procedure(called) = program.rule(rule).runs() {
                procedures.push(called);
            }
            program.each_child_of_rule(rule, &mut |child| rules.push(child));
            program.each_term_of_rule(rule, &mut |term| terms.push(term));
        }
        while let Some(term) = terms.pop() {
            if let Term::Read { function, .. } | Term::Define { function, .. } = program.term(term) {
                read.insert(*function);
                if defined.insert(*function) {
                    terms.extend(program.function(*function).definition.as_ref().map(|definition| definition.body));
                }
            }
            program.each_child_of_term(term, &mut |child| terms.push(child));
        }
    }
    let of = |found: BTreeSet<FunctionId>, kind: FunctionKind| {
        let function = |id: FunctionId| program.function(id);
        let is_device = |id: &FunctionId| {
            let function = function(*id);
            function.kind == kind && function.parameters.is_empty() && !function.library
        };
        found.into_iter().filter(is_device).map(|id| function(id).name.clone()).collect()
    };
    [of(read, FunctionKind::Monitored), of(set, FunctionKind::Out)]
}

/// How many of these records are the first decision, if it is known to be whole.
fn next(decisions: &[Decision], more: bool) -> Option<usize> {
    let got = decisions.iter().take_while(|decision| decision.is_got).count();
    let mut decided: Vec<(&str, u64)> = Vec::new();
    for decision in &decisions[got..] {
        let part = (decision.object.as_ref(), decision.part);
        if decision.is_got || decided.contains(&part) {
            return Some(got + decided.len());
        }
        decided.push(part);
    }
    // What comes last may go on; a hook that threw has decided nothing.
    (!more && !decided.is_empty()).then_some(got + decided.len())
}

/// The values of decisions, each with the records of all its parts.
fn whole(decisions: &[Decision]) -> impl Iterator<Item = &[Decision]> {
    let goes_on =
        |one: &Decision, next: &Decision| next.part != 0 && one.is_got == next.is_got && one.object == next.object;
    decisions.chunk_by(goes_on)
}

/// The value of a function that is recorded in these parts. A tuple that lacks a part, or has one too many, has no value.
fn recorded(program: &Program, function: FunctionId, parts: &[Decision]) -> Value {
    let in_order = parts.iter().zip(0..).all(|(part, number)| part.part == number && part.known);
    let mut bits = parts.iter().map(|part| part.bits);
    let value = value(program, program.function(function).codomain, &mut bits);
    if in_order && bits.next().is_none() { value.unwrap_or(Value::Undef) } else { Value::Undef }
}

/// The domains of the parts of a value that are no tuples, in order.
fn leaves(program: &Program, domain: DomainId, found: &mut Vec<DomainId>) {
    match &program.domain(program.base_domain(domain)).kind {
        DomainKind::Prod(parts) => parts.iter().for_each(|part| leaves(program, *part, found)),
        _ => found.push(domain),
    }
}

/// The value of a domain with these bits.
fn value(program: &Program, domain: DomainId, bits: &mut impl Iterator<Item = u64>) -> Option<Value> {
    let domain = match &program.domain(domain).kind {
        DomainKind::Concrete { base, .. } => *base,
        _ => domain,
    };
    if let DomainKind::Prod(parts) = &program.domain(domain).kind {
        let parts: Option<Vec<Value>> = parts.iter().map(|part| value(program, *part, bits)).collect();
        return parts.map(Value::tuple);
    }
    let bits = bits.next()?;
    let value = match &program.domain(domain).kind {
        DomainKind::Enum { literals } if bits < literals.len() as u64 => Value::Enum(domain, bits as u32),
        DomainKind::Basic(Basic::Boolean) => Value::Boolean(bits != 0),
        DomainKind::Basic(Basic::Integer | Basic::Natural) => Value::Integer(bits as i64),
        DomainKind::Basic(Basic::Real) => machine::Real::new(f64::from_bits(bits)).map_or(Value::Undef, Value::Real),
        // The generator refuses data of other domains.
        _ => Value::Undef,
    };
    Some(value)
}

/// What sensors said; of several candidates the first one, as in the program.
#[derive(Default)]
struct Got {
    said: Vec<(FunctionId, Value)>,
}

impl Environment for Got {
    fn monitored(&mut self, _: &Program, location: LocationRef<'_>, _: DomainId) -> Result<Value, String> {
        let found = self.said.iter().find(|(function, _)| *function == location.function);
        Ok(found.map_or(Value::Undef, |(_, value)| value.clone()))
    }

    fn choose(&mut self, _: &Program, _: &Choice<'_>) -> Result<usize, String> {
        Ok(0)
    }

    fn time(&mut self, _: TimeUnit) -> Result<i64, String> {
        Ok(0)
    }
}
