//! Whether a log is one that the system may have written: decided anew, from the chart and spec/conform.md, by trying all.
//!
//! In: the chart's system and a recording. Out: nothing, or why not. It shares neither code nor model with `conform`, which
//! replays the ground model's rules: here the protocols of channels and tasks are written down once more, by hand.
//!
//! - A run that follows the ticks is decided by the model alone, so it is the only one: `is_the_run`.
//! - By the order of events, a task's own events must be those of its cycles (`lane`), and there must be one order of the
//!   events of all tasks in which each channel goes from state to state (`order`): every order is looked at.

mod channel;
mod lane;
mod order;

use chart::system::{Action, ChannelKind, Component, System, Timing};
use recording::{Event, Kind, Recording};

/// What the judge takes from a chart.
#[derive(Debug)]
pub struct Plan<'a> {
    system: &'a System,
    tick_ns: i64,
    /// By channel: it has no lock.
    wait_free: Vec<bool>,
    real: bool,
}

/// What a channel is to the two tasks at its ends.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Form {
    Buffer { arrays: u64, master: usize },
    Queue { capacity: u64 },
    Cell,
}

impl<'a> Plan<'a> {
    /// For recordings with this head.
    pub fn new(system: &'a System, head: &Recording) -> Plan<'a> {
        let wait_free = system.channels.iter().map(|channel| head.wait_free.contains(&channel.name)).collect();
        Plan { system, tick_ns: head.tick_ns, wait_free, real: head.pace == "real" }
    }

    fn form(&self, channel: usize) -> Form {
        match self.system.channels[channel].kind {
            ChannelKind::Buffer { .. } if self.wait_free[channel] => Form::Cell,
            ChannelKind::Buffer { arrays, master } => Form::Buffer { arrays, master },
            ChannelKind::Queue { capacity } => Form::Queue { capacity },
            ChannelKind::Shared => Form::Cell,
        }
    }

    fn channel(&self, name: &str) -> Option<usize> {
        self.system.channels.iter().position(|channel| channel.name == name)
    }

    /// What a cycle may wait, in ticks: what its work leaves of the time to its deadline. Nothing bounds an asynchronous task.
    fn budget(&self, index: usize) -> Option<i64> {
        let component = &self.system.components[index];
        let Timing::Synchronous { deadline, .. } = component.timing else { return None };
        let work = component.phases.iter().map(|phase| {
            let handshake = match phase.action {
                Action::Read(channel) | Action::Write(channel) => match self.system.channels[channel].kind {
                    ChannelKind::Buffer { master, .. } if master == index => 2,
                    ChannelKind::Buffer { .. } => 1,
                    _ => 0,
                },
                Action::Elaborate(_) => 0,
            };
            phase.time + handshake
        });
        Some(deadline as i64 - work.sum::<u64>() as i64)
    }

    /// By the order of events.
    ///
    /// # Errors
    /// Why no run of the system has this log.
    pub fn allows(&self, recording: &Recording) -> Result<(), String> {
        let stopped_ns = recording.stopped_ns.ok_or("it does not say when it was stopped")?;
        let tracks = self.tracks(recording)?;
        for (index, events) in tracks.iter().enumerate() {
            in_order(events)?;
            let until = events.partition_point(|event| event.time_ns < stopped_ns);
            lane::Lane::new(self, index, &events[..until], stopped_ns).check()?;
        }
        order::Search::new(self, &tracks, stopped_ns).run()
    }

    fn tracks<'r>(&self, recording: &'r Recording) -> Result<Vec<&'r [Event]>, String> {
        let of = |component: &Component| {
            let mut found = recording.tracks.iter().filter(|track| track.task == component.name);
            match (found.next(), found.next()) {
                (Some(track), None) => Ok(track.events.as_slice()),
                _ => Err(format!("{} is not there once", component.name)),
            }
        };
        self.system.components.iter().map(of).collect()
    }
}

fn in_order(events: &[Event]) -> Result<(), String> {
    let starts = events.first().is_none_or(|event| event.time_ns >= 0);
    match starts && events.windows(2).all(|pair| pair[0].time_ns <= pair[1].time_ns) {
        true => Ok(()),
        false => Err("time goes back".to_string()),
    }
}

/// A task, and its events with their ticks instead of their instants.
type InTicks = (String, Vec<(i64, Event)>);

/// Whether a recording is the run that another one is, tick by tick, up to the tick in which both were stopped.
pub fn is_the_run(recording: &Recording, other: &Recording) -> bool {
    let ticks = |recording: &Recording| -> Option<Vec<InTicks>> {
        let end = recording.stopped_ns? / recording.tick_ns;
        let tracks = recording.tracks.iter().map(|track| {
            in_order(&track.events).ok()?;
            let events = track.events.iter().map(|event| (event.time_ns / recording.tick_ns, event));
            let within = events.filter(|(tick, _)| *tick < end);
            let known = within.map(|(tick, event)| (tick, Event { time_ns: 0, ..event.clone() }));
            Some((track.task.clone(), known.collect()))
        });
        tracks.collect()
    };
    let (one, two) = (ticks(recording), ticks(other));
    one.is_some() && one == two
}

/// An event that is told before what it tells of is done: that lies behind its instant, what any other one tells before it.
fn told_before(kind: Kind) -> bool {
    matches!(kind, Kind::Asks | Kind::Releases | Kind::Sends | Kind::Stores | Kind::Refuses)
}
