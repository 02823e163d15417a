//! What the tasks do in a step: changed locations of the library of patterns → events.
//!
//! In: a machine after a step, and what the step changed. Out: [`Claim`]s. Only what library/patterns declares is known
//! here; the application's own functions are not looked at. Which task an event belongs to follows from the phases: a
//! channel has one producer and one consumer.

use std::collections::BTreeMap;

use machine::{Change, Location, Machine, Show, Value};
use program::{FunctionId, Program};

use crate::evidence::Claim;
use recording::Event;

/// The names of the library that events come from, with their numbers of arguments.
const FUNCTIONS: &[(&str, usize)] = &[
    ("scheduler_currentPhase", 1),
    ("scheduler_mainThread", 1),
    ("action", 1),
    ("nextPhase", 1),
    ("sharedMemory", 1),
    ("messageQueue", 1),
    ("sharedValue", 1),
    ("task_period", 1),
    ("task_cycles", 1),
    ("task_deadlinesMet", 1),
    ("task_deadlinesMissed", 1),
    ("sem_state", 2),
    ("sem", 1),
    ("sb_master", 1),
    ("indexRead", 1),
    ("indexWrite", 1),
    ("sb_written", 1),
    ("sb_sequence", 2),
    ("sb_writingArray", 1),
    ("sb_readingArray", 1),
    ("sb_fresh", 1),
    ("mq_sent", 1),
    ("mq_refused", 1),
    ("mq_taken", 1),
    ("sv_sequence", 1),
    ("sv_receivedSequence", 1),
    ("sv_fresh", 1),
    ("clock", 0),
];

/// Adds a claim: the component's number, the kind, the object, and what else the event says.
type Claiming<'a> = dyn FnMut(usize, &str, &Value, &dyn Fn(&mut Event)) + 'a;

/// A component: its scheduler, task and phases.
#[derive(Debug, Clone)]
pub struct Component {
    /// The scheduler's name.
    pub name: String,
    /// The scheduler.
    pub scheduler: Value,
    /// Its task.
    pub task: Value,
    /// The phases of a cycle, without the waiting.
    pub phases: Vec<Value>,
}

/// The library's functions and the system's elements in one model.
#[derive(Debug)]
pub struct Vocabulary {
    functions: BTreeMap<&'static str, FunctionId>,
    /// In the order of the model.
    pub components: Vec<Component>,
    /// The channel of each lock.
    locks: BTreeMap<Value, Value>,
    /// The component that does this to a channel.
    ends: BTreeMap<(Value, End), usize>,
    /// What is called otherwise than the model does.
    called: BTreeMap<Value, String>,
}

#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
enum End {
    Writes,
    Reads,
    Manages,
}

impl Vocabulary {
    /// Reads a model's initial state.
    ///
    /// # Errors
    /// What of the library of patterns it lacks, in words.
    pub fn new(program: &Program, machine: &Machine) -> Result<Vocabulary, String> {
        let mut functions = BTreeMap::new();
        for (name, arity) in FUNCTIONS {
            let found = program.find_function(name, *arity);
            functions.insert(*name, found.ok_or(format!("the model has no `{name}` of library/patterns"))?);
        }
        let (locks, ends, called) = (BTreeMap::new(), BTreeMap::new(), BTreeMap::new());
        let mut this = Vocabulary { functions, components: Vec::new(), locks, ends, called };
        for (location, value) in machine.locations() {
            if this.is(&location, "scheduler_mainThread") {
                let scheduler = location.arguments[0].clone();
                let component = this.component(machine, scheduler, value);
                this.components.push(component);
            } else if this.is(&location, "sem") {
                this.locks.insert(value, location.arguments[0].clone());
            }
        }
        for (index, component) in this.components.iter().enumerate() {
            for phase in &component.phases {
                let action = this.show(machine, "action", phase);
                let end = match action.as_str() {
                    "WRITING_ON_SB" | "SENDING" | "STORING" => End::Writes,
                    "READING_FROM_SB" | "RECEIVING" | "LOADING" => End::Reads,
                    _ => continue,
                };
                let channel = this.channel(machine, phase);
                if this.get(machine, "sb_master", std::slice::from_ref(&channel)) == *phase {
                    this.ends.insert((channel.clone(), End::Manages), index);
                }
                this.ends.insert((channel, end), index);
            }
        }
        Ok(this)
    }

    fn component(&self, machine: &Machine, scheduler: Value, task: Value) -> Component {
        let first = self.get(machine, "scheduler_currentPhase", std::slice::from_ref(&scheduler));
        let mut phases = Vec::new();
        let mut phase = self.get(machine, "nextPhase", std::slice::from_ref(&first));
        while phase != first && !phase.is_undef() && !phases.contains(&phase) {
            phases.push(phase.clone());
            phase = self.get(machine, "nextPhase", std::slice::from_ref(&phase));
        }
        Component { name: scheduler.show(machine.program()).to_string(), scheduler, task, phases }
    }

    /// The names of the components.
    pub fn names(&self) -> Vec<String> {
        self.components.iter().map(|component| component.name.clone()).collect()
    }

    /// The phases that work on the buffer of that name.
    pub fn phases_on(&self, machine: &Machine, buffer: &str) -> Vec<Value> {
        let works_on = |phase: &&Value| self.show(machine, "sharedMemory", phase) == buffer;
        self.components.iter().flat_map(|component| &component.phases).filter(works_on).cloned().collect()
    }

    /// From now on that element is called so.
    pub fn call(&mut self, element: Value, name: String) {
        self.called.insert(element, name);
    }

    fn is(&self, location: &Location, name: &str) -> bool {
        self.functions.get(name) == Some(&location.function)
    }

    /// The value of a location of the library.
    pub fn get(&self, machine: &Machine, name: &str, arguments: &[Value]) -> Value {
        machine.value(&self.location(name, arguments))
    }

    /// A location of the library.
    pub fn location(&self, name: &str, arguments: &[Value]) -> Location {
        Location { function: self.functions[name], arguments: arguments.to_vec() }
    }

    fn show(&self, machine: &Machine, name: &str, argument: &Value) -> String {
        self.get(machine, name, std::slice::from_ref(argument)).show(machine.program()).to_string()
    }

    fn number(&self, machine: &Machine, name: &str, arguments: &[Value]) -> u64 {
        match self.get(machine, name, arguments) {
            Value::Integer(number) => u64::try_from(number).unwrap_or(0),
            _ => 0,
        }
    }

    fn channel(&self, machine: &Machine, phase: &Value) -> Value {
        let of = |name| self.get(machine, name, std::slice::from_ref(phase));
        [of("sharedMemory"), of("messageQueue"), of("sharedValue")]
            .into_iter()
            .find(|channel| !channel.is_undef())
            .unwrap_or_default()
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

    fn of_task(&self, task: &Value) -> usize {
        self.components.iter().position(|component| component.task == *task).unwrap_or(0)
    }

    /// The events of a step, the component's number with each.
    pub fn claims(&self, machine: &Machine, changes: &[Change]) -> Vec<(usize, Claim)> {
        let mut claims = Vec::new();
        for change in changes {
            self.change(machine, change, changes, &mut claims);
        }
        claims
    }

    fn change(&self, machine: &Machine, change: &Change, all: &[Change], out: &mut Vec<(usize, Claim)>) {
        let program = machine.program();
        let Change { location, before, after, span } = change;
        let Some((name, _)) = self.functions.iter().find(|(_, function)| **function == location.function) else {
            return;
        };
        let arguments = location.arguments.as_slice();
        let whole =
            |value: &Value| if let Value::Integer(number) = value { u64::try_from(*number).unwrap_or(0) } else { 0 };
        let mut claim = |component: usize, kind: &str, object: &Value, set: &dyn Fn(&mut Event)| {
            let mut event = Event {
                time_ns: 0,
                kind: kind.to_string(),
                object: self.called.get(object).cloned().unwrap_or_else(|| object.show(program).to_string()),
                number: 0,
                array: None,
                next: None,
                fresh: None,
            };
            set(&mut event);
            out.push((component, Claim { task: self.components[component].name.clone(), event, span: *span }));
        };
        let end = |channel: &Value, end: End| self.ends.get(&(channel.clone(), end)).copied();
        match *name {
            "scheduler_currentPhase" => {
                let Some(index) = self.components.iter().position(|known| known.scheduler == arguments[0]) else {
                    return;
                };
                let component = &self.components[index];
                let cycles = self.location("task_cycles", std::slice::from_ref(&component.task));
                let now = whole(&machine.value(&cycles));
                let was = all.iter().find(|other| other.location == cycles).map_or(now, |other| whole(&other.before));
                if component.phases.contains(before) {
                    claim(index, "ends", before, &|event| event.number = was);
                }
                if component.phases.contains(after) {
                    claim(index, "begins", after, &|event| event.number = now);
                    self.begun(machine, index, after, all, &mut claim);
                }
            }
            "sem_state" => {
                let kind = match (before.show(program).to_string().as_str(), after.show(program).to_string().as_str()) {
                    ("READY", "WAITING") => "asks",
                    ("WAITING", "EXECUTION") => "enters",
                    ("WAITING", "READY") => "gives_up",
                    _ => "releases",
                };
                let Some(channel) = self.locks.get(&arguments[0]) else { return };
                claim(self.of_task(&arguments[1]), kind, channel, &|_| {});
            }
            "sb_written" => {
                let Some(index) = end(&arguments[0], End::Writes) else { return };
                let array = self.number(machine, "sb_writingArray", arguments);
                claim(index, "writes", &arguments[0], &|event| {
                    (event.number, event.array) = (whole(after), Some(array));
                });
            }
            "indexRead" => {
                let Some(index) = end(&arguments[0], End::Manages) else { return };
                let number = self.number(machine, "sb_sequence", &[arguments[0].clone(), after.clone()]);
                let next = self.number(machine, "indexWrite", arguments);
                claim(index, "swaps", &arguments[0], &|event| {
                    (event.number, event.array, event.next) = (number, Some(whole(after)), Some(next));
                });
            }
            "sb_readingArray" if !after.is_undef() => {
                let Some(index) = end(&arguments[0], End::Reads) else { return };
                let number = self.number(machine, "sb_sequence", &[arguments[0].clone(), after.clone()]);
                let fresh = self.get(machine, "sb_fresh", arguments) == Value::Boolean(true);
                claim(index, "reads", &arguments[0], &|event| {
                    (event.number, event.array, event.fresh) = (number, Some(whole(after)), Some(fresh));
                });
            }
            "mq_sent" | "sv_sequence" => {
                let Some(index) = end(&arguments[0], End::Writes) else { return };
                let kind = if *name == "mq_sent" { "sends" } else { "stores" };
                claim(index, kind, &arguments[0], &|event| event.number = whole(after));
            }
            "mq_refused" => {
                let Some(index) = end(&arguments[0], End::Writes) else { return };
                claim(index, "refuses", &arguments[0], &|_| {});
            }
            "task_deadlinesMet" | "task_deadlinesMissed" => {
                let kind = if *name == "task_deadlinesMet" { "meets" } else { "misses" };
                let index = self.of_task(&arguments[0]);
                let cycles = self.number(machine, "task_cycles", arguments);
                claim(index, kind, &self.components[index].scheduler, &|event| event.number = cycles.saturating_sub(1));
            }
            _ => {}
        }
    }

    /// What a phase takes as it begins: a message, a value.
    fn begun(&self, machine: &Machine, index: usize, phase: &Value, all: &[Change], claim: &mut Claiming<'_>) {
        match self.show(machine, "action", phase).as_str() {
            "RECEIVING" => {
                let queue = self.get(machine, "messageQueue", std::slice::from_ref(phase));
                let taken = self.location("mq_taken", std::slice::from_ref(&queue));
                let number = match all.iter().find(|other| other.location == taken).map(|other| &other.after) {
                    Some(Value::Integer(number)) => u64::try_from(*number).unwrap_or(0),
                    _ => 0,
                };
                claim(index, "takes", &queue, &|event| event.number = number);
            }
            "LOADING" => {
                let cell = self.get(machine, "sharedValue", std::slice::from_ref(phase));
                let number = self.number(machine, "sv_receivedSequence", std::slice::from_ref(&cell));
                let fresh = self.get(machine, "sv_fresh", std::slice::from_ref(&cell)) == Value::Boolean(true);
                claim(index, "loads", &cell, &|event| (event.number, event.fresh) = (number, Some(fresh)));
            }
            _ => {}
        }
    }

    /// The state around a component: its phase, the lock and the buffer, queue or cell of these names, and who holds or
    /// wants the lock. Arrays that hold nothing are left out.
    pub fn state(&self, machine: &Machine, component: usize, names: &[&str]) -> Vec<(String, String)> {
        let program = machine.program();
        let known = &self.components[component];
        let shown = |value: &Value| self.called.get(value).cloned().unwrap_or_else(|| value.show(program).to_string());
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
                |text: String, (value, name): (&Value, &String)| text.replace(&value.show(program).to_string(), name);
            self.called.iter().fold(location.show(program).to_string(), renamed)
        };
        all.map(|(location, value)| (place(&location), shown(&value))).collect()
    }
}
