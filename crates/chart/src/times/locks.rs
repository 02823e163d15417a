//! How long tasks keep each other waiting at channels.
//!
//! In: a system, and which of its tasks are more urgent. Out: for each component the longest time that others keep it waiting in one
//! cycle, or why that is not analysed. Each buffer has a lock with two users, each of which takes it once a cycle. On one processor,
//! the holder of a lock inherits the urgency of the task that waits: L. Sha, R. Rajkumar, J. Lehoczky, *Priority Inheritance Protocols*
//! (1990). So each lock delays a task once at most: a lock of a less urgent task and of one that is at least as urgent.

use super::{Platform, executed, is_apart};
use crate::system::{Action, Channel, ChannelKind, System};

/// The longest blocking of each component.
pub(super) fn blocking(system: &System, platform: Platform, urgency: &[usize]) -> Vec<Result<u64, String>> {
    let place = |component: usize| urgency.iter().position(|other| *other == component).unwrap_or(usize::MAX);
    let has_locks = system.channels.iter().any(|channel| matches!(channel.kind, ChannelKind::Buffer { .. }));
    let each = |index: usize| {
        if let Some(queue) = system.channels.iter().find(|one| one.from == index && !has_room(system, one)) {
            return Err(format!("it may wait for room in the queue {}", queue.name));
        }
        let locked = (0..system.channels.len()).map(|channel| (&system.channels[channel], channel));
        let locked = locked.filter(|(channel, _)| matches!(channel.kind, ChannelKind::Buffer { .. }));
        if is_apart(system, platform) {
            // The one at the other end has it, whoever is more urgent.
            let others = locked.filter_map(|(channel, number)| match index {
                _ if channel.from == index => Some(section(system, number, channel.to)),
                _ if channel.to == index => Some(section(system, number, channel.from)),
                _ => None,
            });
            return Ok(others.sum());
        }
        if platform.processors > 1 {
            return match has_locks {
                true => Err("tasks with locks are not analysed on fewer processors than tasks".to_string()),
                false => Ok(0),
            };
        }
        let held = locked.filter_map(|(channel, number)| {
            let mut users = [channel.from, channel.to];
            users.sort_by_key(|user| place(*user));
            let [urgent, other] = users;
            (place(urgent) <= place(index) && place(other) > place(index)).then(|| section(system, number, other))
        });
        Ok(held.sum())
    };
    (0..system.components.len()).map(each).collect()
}

/// Whether the sender of a channel never finds a full queue: its messages come no faster than a periodic reader takes them. Both may come
/// late, by less than their periods; so up to four messages wait.
fn has_room(system: &System, channel: &Channel) -> bool {
    let ChannelKind::Queue { capacity } = channel.kind else { return true };
    let (sender, reader) = (&system.components[channel.from], &system.components[channel.to]);
    let spacing = sender.timing.period().unwrap_or_else(|| executed(system, channel.from).0);
    capacity >= 4 && reader.timing.period().is_some_and(|period| period <= spacing)
}

/// How long a component holds the lock of a channel, with the tick in which it is handed over: a slave while it works on its array, the
/// master while it updates the indexes.
pub(crate) fn section(system: &System, channel: usize, user: usize) -> u64 {
    let ChannelKind::Buffer { master, .. } = system.channels[channel].kind else { return 0 };
    if master == user {
        return 2;
    }
    let uses = |action: &Action| matches!(action, Action::Read(other) | Action::Write(other) if *other == channel);
    let phase = system.components[user].phases.iter().find(|phase| uses(&phase.action));
    phase.map_or(0, |phase| phase.time + 1)
}
