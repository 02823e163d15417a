//! Whether the model keeps what is computed at the end of an elaboration, so that readers get it.
//!
//! In: a machine of the model in which only ends of elaborations are made, after one of them. Out: the first channel whose next datum is
//! not what was computed for it, or whose messages are not noted as seen. The names are those that `chart build` gives: `CHANNEL_value`
//! says what the datum of a number is, `TASK_CHANNEL` what was computed for it, `TASK_taken_CHANNEL` how many messages were seen.
//! See crates/chart/src/component/compose.rs.

use machine::{Location, LocationRef, Machine, Show, Value};
use program::{FunctionId, Program};

use crate::vocabulary::{End, Vocabulary};

/// What the end of a task's elaborations has to keep.
#[derive(Debug, Default)]
pub(crate) struct Kept {
    data: Vec<Datum>,
    seen: Vec<Seen>,
}

/// The next datum of a channel to which the task writes.
#[derive(Debug)]
pub(crate) struct Datum {
    channel: String,
    /// What was computed for it.
    pub(crate) own: FunctionId,
    /// Where it is kept.
    place: Location,
}

/// The messages of a queue from which the task takes.
#[derive(Debug)]
struct Seen {
    queue: String,
    /// How many were seen.
    seen: FunctionId,
    /// How many were taken.
    taken: Location,
}

impl Kept {
    /// What the component has to keep, in a machine that has just started.
    pub(crate) fn of(machine: &Machine, vocabulary: &Vocabulary, component: usize) -> Kept {
        let program = machine.program();
        let (mut kept, known) = (Kept::default(), &vocabulary.components[component]);
        for phase in &known.phases {
            let channel = vocabulary.channel(machine, phase);
            let name = channel.show(program).to_string();
            let Some(table) = program.find_function(&format!("{name}_value"), 1) else { continue };
            if vocabulary.end(&channel, End::Writes) == Some(component) {
                let own = program.find_function(&format!("{}_{name}", known.name), 0);
                let own = own.or_else(|| drawn(program, vocabulary, &known.name, &name));
                let (Some(own), Some(next)) = (own, next(machine, &channel, &name)) else { continue };
                let place = Location { function: table, arguments: vec![Value::Integer(next)] };
                kept.data.push(Datum { channel: name, own, place });
            } else if let (Some(seen), Some(function)) = (
                program.find_function(&format!("{}_taken_{name}", known.name), 0),
                program.find_function("mq_taken", 1),
            ) {
                kept.seen.push(Seen { queue: name, seen, taken: Location { function, arguments: vec![channel] } });
            }
        }
        kept
    }

    /// What the task computes for others.
    pub(crate) fn data(&self) -> impl Iterator<Item = &Datum> {
        self.data.iter()
    }

    /// What the end of an elaboration that decided did not keep, in words.
    pub(crate) fn lacks(&self, machine: &Machine) -> Option<String> {
        let at = |function: FunctionId| machine.value_at(LocationRef { function, arguments: &[] });
        let program = machine.program();
        self.lacks_datum(machine, &|function| Some(at(function))).or_else(|| {
            let unlike = self.seen.iter().find(|one| at(one.seen) != machine.value(&one.taken))?;
            let seen = &program.function(unlike.seen).name;
            Some(format!("{seen} does not count what it has seen of {}", unlike.queue))
        })
    }

    /// The first channel whose next datum is not what was computed for it, in words, where that is known.
    pub(crate) fn lacks_datum(
        &self,
        machine: &Machine,
        computed: &dyn Fn(FunctionId) -> Option<Value>,
    ) -> Option<String> {
        let program = machine.program();
        self.data.iter().find_map(|Datum { channel, own, place }| {
            let (computed, kept) = (computed(*own)?, machine.value(place));
            let (place, kept_shown) = (place.show(program), kept.show(program));
            (computed != kept).then(|| format!("{place}, the next datum of {channel}, is {kept_shown}"))
        })
    }
}

/// The number of the next datum of a channel.
fn next(machine: &Machine, channel: &Value, name: &str) -> Option<i64> {
    let program = machine.program();
    let domain = program.function(program.find_function(name, 0)?).codomain;
    let count = match program.domain(domain).name.as_str() {
        "SwingingBuffer" => "sb_written",
        "SharedValue" => "sv_sequence",
        _ => "mq_sent",
    };
    let function = program.find_function(count, 1)?;
    match machine.value_at(LocationRef { function, arguments: std::slice::from_ref(channel) }) {
        Value::Integer(written) => written.checked_add(1),
        _ => None,
    }
}

/// The function of what a task computes for a channel that is drawn to several readers: `TASK_DRAWN`, where the channel to one of them is
/// `DRAWN_READER`. None for other channels, for which the task has a function of their own name.
pub(crate) fn drawn(program: &Program, vocabulary: &Vocabulary, task: &str, channel: &str) -> Option<FunctionId> {
    program.find_function(&format!("{channel}_value"), 1)?;
    if program.find_function(&format!("{task}_{channel}"), 0).is_some() {
        return None;
    }
    let mut names =
        vocabulary.components.iter().filter_map(|reader| channel.strip_suffix(&reader.name)?.strip_suffix('_'));
    names.find_map(|drawn| program.find_function(&format!("{task}_{drawn}"), 0))
}
