//! The library of patterns in one model: its functions, the components with their phases, and which component does what
//! to which channel.
//!
//! In: a model's program and initial state. Out: a [`Vocabulary`], by which `claims` reads steps as events and replays
//! find what they set or ask. This module knows only what library/patterns declares; it does not look at the
//! application's own functions. The phases decide to which task an event belongs: a channel has one producer and one
//! consumer.

use std::collections::BTreeMap;
use std::sync::Arc;

use machine::{Location, LocationRef, Machine, Show, Value};
use program::{DomainKind, FunctionId, Program};

/// The functions of the library that events come from, and those that a replay sets or asks.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Named {
    CurrentPhase,
    MainThread,
    Action,
    NextPhase,
    SharedMemory,
    MessageQueue,
    SharedValue,
    Awaited,
    AwaitsAll,
    Period,
    PeriodStart,
    Deadline,
    TimeInWait,
    ThereIsTime,
    DataAvailable,
    Cycles,
    DeadlinesMet,
    DeadlinesMissed,
    LockState,
    Lock,
    Master,
    IndexRead,
    IndexWrite,
    Written,
    Sequence,
    WritingArray,
    ReadingArray,
    BufferFresh,
    Sent,
    Refused,
    Taken,
    ValueSequence,
    ReceivedSequence,
    ValueFresh,
    Clock,
}

/// Their names there, with their numbers of arguments.
const FUNCTIONS: &[(Named, &str, usize)] = &[
    (Named::CurrentPhase, "scheduler_currentPhase", 1),
    (Named::MainThread, "scheduler_mainThread", 1),
    (Named::Action, "action", 1),
    (Named::NextPhase, "nextPhase", 1),
    (Named::SharedMemory, "sharedMemory", 1),
    (Named::MessageQueue, "messageQueue", 1),
    (Named::SharedValue, "sharedValue", 1),
    (Named::Awaited, "awaited", 1),
    (Named::AwaitsAll, "awaitsAll", 1),
    (Named::Period, "task_period", 1),
    (Named::PeriodStart, "task_periodStart", 1),
    (Named::Deadline, "task_deadline", 1),
    (Named::TimeInWait, "task_timeInWait", 1),
    (Named::ThereIsTime, "thereIsTime", 1),
    (Named::DataAvailable, "dataAvailable", 1),
    (Named::Cycles, "task_cycles", 1),
    (Named::DeadlinesMet, "task_deadlinesMet", 1),
    (Named::DeadlinesMissed, "task_deadlinesMissed", 1),
    (Named::LockState, "sem_state", 2),
    (Named::Lock, "sem", 1),
    (Named::Master, "sb_master", 1),
    (Named::IndexRead, "indexRead", 1),
    (Named::IndexWrite, "indexWrite", 1),
    (Named::Written, "sb_written", 1),
    (Named::Sequence, "sb_sequence", 2),
    (Named::WritingArray, "sb_writingArray", 1),
    (Named::ReadingArray, "sb_readingArray", 1),
    (Named::BufferFresh, "sb_fresh", 1),
    (Named::Sent, "mq_sent", 1),
    (Named::Refused, "mq_refused", 1),
    (Named::Taken, "mq_taken", 1),
    (Named::ValueSequence, "sv_sequence", 1),
    (Named::ReceivedSequence, "sv_receivedSequence", 1),
    (Named::ValueFresh, "sv_fresh", 1),
    (Named::Clock, "clock", 0),
];

/// A component: its scheduler, task and phases.
#[derive(Debug, Clone)]
pub struct Component {
    /// The scheduler's name.
    pub name: String,
    /// The scheduler.
    pub scheduler: Value,
    /// Its task.
    pub task: Value,
    /// The phase in which it waits for its next cycle.
    pub waiting: Value,
    /// The phases of a cycle, without the waiting.
    pub phases: Vec<Value>,
}

/// The library's functions and the system's elements in one model.
#[derive(Debug)]
pub struct Vocabulary {
    /// In the order of [`FUNCTIONS`], which is that of [`Named`].
    functions: Vec<FunctionId>,
    /// By function, its place among them.
    named: Vec<Option<Named>>,
    /// In the order of the model.
    pub components: Vec<Component>,
    /// The channel of each lock.
    pub locks: BTreeMap<Value, Value>,
    /// The component that does this to a channel.
    ends: BTreeMap<(Value, End), usize>,
    /// The name of each phase, channel and scheduler in events.
    objects: BTreeMap<Value, Arc<str>>,
    /// The ones that have another name in the model.
    renamed: BTreeMap<Value, Arc<str>>,
    pub literals: Literals,
}

/// Literals of the library's enumerations.
#[derive(Debug)]
pub struct Literals {
    pub ready: Value,
    pub waiting: Value,
    pub execution: Value,
    pub receiving: Value,
    pub loading: Value,
}

/// What wakes a component.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Wakes {
    /// Its first phase.
    pub first: Arc<str>,
    /// The channels that it awaits, in the order in which it reads them.
    pub channels: Vec<Arc<str>>,
    /// Whether it needs something new on each of them; otherwise on one.
    pub all: bool,
}

/// What a component is to a channel.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum End {
    Writes,
    Reads,
    Manages,
}

impl Vocabulary {
    /// Reads a model's initial state.
    ///
    /// # Errors
    /// In words, which parts of the library of patterns it lacks.
    pub fn new(program: &Program, machine: &Machine) -> Result<Vocabulary, String> {
        let mut named = vec![None; program.functions.len()];
        let functions = FUNCTIONS.iter().map(|(function, name, arity)| {
            let found = program.find_function(name, *arity);
            let found = found.ok_or(format!("the model has no `{name}` of library/patterns"))?;
            named[found.0 as usize] = Some(*function);
            Ok(found)
        });
        let functions = functions.collect::<Result<Vec<_>, String>>()?;
        let literal = |function: Named, literal: &str| {
            let domain = program.function(functions[function as usize]).codomain;
            let place = match &program.domain(domain).kind {
                DomainKind::Enum { literals } => literals.iter().position(|known| known == literal),
                _ => None,
            };
            let place = place.ok_or(format!("the model has no `{literal}` of library/patterns"))?;
            Ok::<Value, String>(Value::Enum(domain, place as u32))
        };
        let literals = Literals {
            ready: literal(Named::LockState, "READY")?,
            waiting: literal(Named::LockState, "WAITING")?,
            execution: literal(Named::LockState, "EXECUTION")?,
            receiving: literal(Named::Action, "RECEIVING")?,
            loading: literal(Named::Action, "LOADING")?,
        };
        let mut this = Vocabulary {
            functions,
            named,
            components: Vec::new(),
            locks: BTreeMap::new(),
            ends: BTreeMap::new(),
            objects: BTreeMap::new(),
            renamed: BTreeMap::new(),
            literals,
        };
        for (location, value) in machine.locations() {
            if this.is(&location, Named::MainThread) {
                let scheduler = location.arguments[0].clone();
                let component = this.component(machine, scheduler, value);
                this.components.push(component);
            } else if this.is(&location, Named::Lock) {
                this.locks.insert(value, location.arguments[0].clone());
            }
        }
        for (index, component) in this.components.iter().enumerate() {
            this.objects.insert(component.scheduler.clone(), component.name.as_str().into());
            for phase in &component.phases {
                this.objects.insert(phase.clone(), phase.show(program).to_string().into());
                let action = this.show(machine, Named::Action, phase);
                let end = match action.as_str() {
                    "WRITING_ON_SB" | "SENDING" | "STORING" => End::Writes,
                    "READING_FROM_SB" | "RECEIVING" | "LOADING" => End::Reads,
                    _ => continue,
                };
                let channel = this.channel(machine, phase);
                this.objects.insert(channel.clone(), channel.show(program).to_string().into());
                if this.get(machine, Named::Master, std::slice::from_ref(&channel)) == *phase {
                    this.ends.insert((channel.clone(), End::Manages), index);
                }
                this.ends.insert((channel, end), index);
            }
        }
        Ok(this)
    }

    fn component(&self, machine: &Machine, scheduler: Value, task: Value) -> Component {
        let first = self.get(machine, Named::CurrentPhase, std::slice::from_ref(&scheduler));
        let mut phases = Vec::new();
        let mut phase = self.get(machine, Named::NextPhase, std::slice::from_ref(&first));
        while phase != first && !phase.is_undef() && !phases.contains(&phase) {
            phases.push(phase.clone());
            phase = self.get(machine, Named::NextPhase, std::slice::from_ref(&phase));
        }
        Component { name: scheduler.show(machine.program()).to_string(), scheduler, task, waiting: first, phases }
    }

    /// The phases that work on the buffer of that name.
    pub fn phases_on(&self, machine: &Machine, buffer: &str) -> Vec<Value> {
        let works_on = |phase: &&Value| self.show(machine, Named::SharedMemory, phase) == buffer;
        self.components.iter().flat_map(|component| &component.phases).filter(works_on).cloned().collect()
    }

    /// From now on that element has this name.
    pub fn call(&mut self, element: Value, name: &str) {
        self.objects.insert(element.clone(), name.into());
        self.renamed.insert(element, name.into());
    }

    /// The element's name in events.
    pub fn object(&self, machine: &Machine, element: &Value) -> Arc<str> {
        let known = self.objects.get(element).cloned();
        known.unwrap_or_else(|| element.show(machine.program()).to_string().into())
    }

    /// Which function of the library that is, if it is one.
    pub fn which(&self, function: FunctionId) -> Option<Named> {
        self.named[function.0 as usize]
    }

    /// The component that does this to a channel.
    pub fn end(&self, channel: &Value, end: End) -> Option<usize> {
        self.ends.get(&(channel.clone(), end)).copied()
    }

    /// The component of that task.
    pub fn of_task(&self, task: &Value) -> usize {
        self.components.iter().position(|component| component.task == *task).unwrap_or(0)
    }

    fn is(&self, location: &Location, named: Named) -> bool {
        self.functions[named as usize] == location.function
    }

    /// The value of a location of the library.
    pub fn get(&self, machine: &Machine, named: Named, arguments: &[Value]) -> Value {
        machine.value_at(LocationRef { function: self.function(named), arguments })
    }

    /// All functions of the library that are known here.
    pub fn functions(&self) -> impl Iterator<Item = FunctionId> {
        self.functions.iter().copied()
    }

    /// A function of the library.
    pub fn function(&self, named: Named) -> FunctionId {
        self.functions[named as usize]
    }

    /// A location of the library.
    pub fn location(&self, named: Named, arguments: &[Value]) -> Location {
        Location { function: self.function(named), arguments: arguments.to_vec() }
    }

    fn show(&self, machine: &Machine, named: Named, argument: &Value) -> String {
        self.get(machine, named, std::slice::from_ref(argument)).show(machine.program()).to_string()
    }

    /// The channel that a phase works on; undef if it elaborates.
    pub fn channel(&self, machine: &Machine, phase: &Value) -> Value {
        [Named::SharedMemory, Named::MessageQueue, Named::SharedValue]
            .into_iter()
            .map(|named| self.get(machine, named, std::slice::from_ref(phase)))
            .find(|channel| !channel.is_undef())
            .unwrap_or_default()
    }

    /// The channel that is written to in a phase, if one is.
    pub fn written(&self, machine: &Machine, phase: &Value) -> Option<Value> {
        let action = self.show(machine, Named::Action, phase);
        ["WRITING_ON_SB", "SENDING", "STORING"].contains(&action.as_str()).then(|| self.channel(machine, phase))
    }

    /// For a component that data wake: by which.
    pub fn wakes(&self, machine: &Machine, component: &Component) -> Option<Wakes> {
        let is_synchronous = !self.get(machine, Named::Period, std::slice::from_ref(&component.task)).is_undef();
        let first = component.phases.first().filter(|_| !is_synchronous)?;
        let waiting = std::slice::from_ref(&component.waiting);
        let (channels, all) = match self.get(machine, Named::Awaited, waiting) {
            Value::Set(phases) => {
                let reads = component.phases.iter().filter(|phase| phases.contains(phase));
                let all = self.get(machine, Named::AwaitsAll, waiting) == Value::Boolean(true);
                (reads.map(|phase| self.channel(machine, phase)).collect(), all)
            }
            _ => (vec![self.channel(machine, &component.waiting)], true),
        };
        let channels: Vec<Arc<str>> = channels
            .iter()
            .filter(|channel| !channel.is_undef())
            .map(|channel| self.object(machine, channel))
            .collect();
        (!channels.is_empty()).then(|| Wakes { first: self.object(machine, first), channels, all })
    }

    /// The component of that name.
    pub fn component_named(&self, name: &str) -> Option<usize> {
        self.components.iter().position(|component| component.name == name)
    }

    /// The phase of that name.
    pub fn phase_named(&self, machine: &Machine, component: usize, name: &str) -> Option<Value> {
        let phases = self.components[component].phases.iter();
        phases.clone().find(|phase| phase.show(machine.program()).to_string() == name).cloned()
    }

    /// The state around a component: its phase, the lock and the buffer, queue or cell of these names, and which tasks
    /// hold or want the lock. Arrays that hold nothing are left out.
    pub fn state(&self, machine: &Machine, component: usize, names: &[&str]) -> Vec<(String, String)> {
        let program = machine.program();
        let known = &self.components[component];
        let shown = |value: &Value| match self.renamed.get(value) {
            Some(name) => name.to_string(),
            None => value.show(program).to_string(),
        };
        let about = |location: &Location, value: &Value| {
            let function = program.function(location.function).name.as_str();
            let Some(first) = location.arguments.first() else { return false };
            match function {
                "scheduler_currentPhase" => *first == known.scheduler,
                "task_timeInWait" | "task_periodStart" => *first == known.task,
                "sb_ctrlState" => known.phases.contains(first),
                "sem_state" => {
                    self.locks.get(first).is_some_and(|channel| names.contains(&shown(channel).as_str()))
                        && shown(value) != "READY"
                }
                "sb_sequence" => names.contains(&shown(first).as_str()) && *value != Value::Integer(0),
                "sb_data" | "sb_master" | "sem" => false,
                _ => {
                    ["index", "sb_", "mq_", "sv_"].iter().any(|prefix| function.starts_with(prefix))
                        && names.contains(&shown(first).as_str())
                }
            }
        };
        let all = machine.locations().into_iter().filter(|(location, value)| about(location, value));
        let place = |location: &Location| {
            let renamed =
                |text: String, (value, name): (&Value, &Arc<str>)| text.replace(&value.show(program).to_string(), name);
            self.renamed.iter().fold(location.show(program).to_string(), renamed)
        };
        all.map(|(location, value)| (place(&location), shown(&value))).collect()
    }
}
