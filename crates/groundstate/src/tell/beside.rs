//! What is said beside the verdict that a program's run conforms to its model.
//!
//! In: a comparison. Out: sentences about what such a run may have all the same: accesses that were given up, deadlines that were missed, bounds that were
//! not kept or not compared, tasks that were silent. Nothing here changes a verdict.

use conform::{Access, Event, Kind, Recording, Way};

use crate::job::Conformed;

/// For whom a task never accessed a channel, though it was its turn: what follows `conforms`, beginning with a comma.
pub fn but(accesses: &[Access]) -> String {
    let never: Vec<String> = accesses.iter().filter(|access| access.never()).map(nothing).collect();
    match never.as_slice() {
        [] => String::new(),
        [one] => format!(", but {one}"),
        [all @ .., last] => format!(", but {} and {last}", all.join(", ")),
    }
}

fn nothing(access: &Access) -> String {
    let Access { task, channel, writes, .. } = access;
    match writes {
        true => format!("{task} handed over nothing to {channel}"),
        false => format!("{task} got nothing from {channel}"),
    }
}

/// What is said, a sentence each; what the program itself counted as outside its bounds is [`outside`].
pub fn beside(conformed: &Conformed) -> Vec<String> {
    let recording = &conformed.recording;
    let mut told: Vec<String> = conformed.accesses.iter().flat_map(not_made).collect();
    told.extend(missed(recording));
    told.extend(conformed.bounds.unread.iter().map(|bound| {
        format!("the recording bounds {bound}, in words that are not known: not compared with the model")
    }));
    told.extend(
        conformed.bounds.uncounted.iter().map(|bound| {
            format!("the model bounds {bound}; the recording says nothing of it, and it is not looked at")
        }),
    );
    let not_said = |what: &String| format!("the recording does not say {what}: not compared with the model");
    told.extend(conformed.unsaid.iter().map(not_said));
    // Tick by tick, a step of the model that has no event in the recording is a difference.
    if conformed.way == Way::Untimed {
        told.extend(silent(recording));
    }
    told
}

/// How often a task did not access a channel when it was its turn.
fn not_made(access: &Access) -> Vec<String> {
    let Access { task, channel, turns, given_up, refused, left_out, .. } = access;
    let (noun, to) = if access.writes { ("writing", "to") } else { ("reading", "of") };
    let of = |count: usize| match (count == *turns, *turns) {
        (true, 1) => format!("its one {noun} {to} {channel}"),
        (true, _) => format!("all {turns} {noun}s {to} {channel}"),
        (false, 1) => format!("{count} of 1 {noun} {to} {channel}"),
        (false, _) => format!("{count} of {turns} {noun}s {to} {channel}"),
    };
    let told = [
        (*given_up, format!("{task} gave up the lock in {}", of(*given_up))),
        (*refused, format!("{task} found the queue full in {}", of(*refused))),
        (*left_out, format!("{task} left out {}, since it had nothing to hand over", of(*left_out))),
    ];
    told.into_iter().filter(|(count, _)| *count > 0).map(|(_, words)| words).collect()
}

/// The deadlines that were missed before the tasks were asked to stop: a run that has its events in order may have missed all of them.
fn missed(recording: &Recording) -> Option<String> {
    let until_ns = recording.stopped_ns.unwrap_or(i64::MAX);
    let misses = |event: &&Event| event.kind == Kind::Misses && event.time_ns <= until_ns;
    let tasks = recording.tracks.iter().map(|track| (&track.task, track.events.iter().filter(misses).count()));
    let tasks: Vec<_> = tasks.filter(|(_, count)| *count > 0).collect();
    let each = tasks.iter().map(|(task, count)| format!("{task} {count}")).collect::<Vec<_>>().join(", ");
    match tasks.iter().map(|(_, count)| count).sum::<usize>() {
        0 => None,
        1 => Some(format!("1 deadline was missed ({each}); whether the model forbids that is not looked at")),
        more => Some(format!("{more} deadlines were missed ({each}); whether the model forbids that is not looked at")),
    }
}

/// What the program counted as outside the bounds of its chart. The events of such a run may be in order.
pub fn outside(recording: &Recording) -> Vec<String> {
    let told = recording.bounds.iter().filter(|bound| bound.outside() > 0).map(|bound| {
        let (what, limit, outside, seen) = (&bound.what, &bound.limit, bound.outside(), bound.seen);
        format!("{outside} of {seen} were outside the chart's bounds, as the program counted: {what} ({limit})")
    });
    told.collect()
}

/// LIMIT: periods without an event that are told of.
const SILENT: i64 = 4;

/// The synchronous tasks of which nothing is recorded for several periods before they were asked to stop, and the others of which nothing
/// is recorded at all. An order of events says nothing of what did not come.
fn silent(recording: &Recording) -> Vec<String> {
    let Some(stopped_ns) = recording.stopped_ns else { return Vec::new() };
    let told = recording.tracks.iter().filter_map(|track| {
        let last_ns = track.events.iter().map(|event| event.time_ns).filter(|time_ns| *time_ns <= stopped_ns).max();
        let silent_ns = stopped_ns - last_ns.unwrap_or(0);
        let when = match track.rhythm.map(|rhythm| rhythm.period_ns).filter(|period_ns| *period_ns > 0) {
            Some(period_ns) if silent_ns > SILENT * period_ns => {
                let (silent, periods) = (silent_ns as f64 / 1e6, silent_ns / period_ns);
                format!("in the last {silent:.4} ms before the stop, {periods} of its periods")
            }
            None if last_ns.is_none() => "before the stop".to_string(),
            _ => return None,
        };
        Some(format!("nothing is recorded of {} {when}: whether it stood still is not looked at", track.task))
    });
    told.collect()
}

#[cfg(test)]
mod tests {
    use conform::{Rhythm, Track};

    use super::*;

    #[test]
    fn accesses_that_were_not_made_are_told() {
        let access = |channel: &str, writes: bool, made: usize, [given_up, refused, left_out]: [usize; 3]| Access {
            task: "drive".to_string(),
            channel: channel.to_string(),
            writes,
            turns: 4,
            made,
            given_up,
            refused,
            left_out,
        };
        let all = [
            access("poses", true, 0, [4, 0, 0]),
            access("marks", false, 3, [1, 0, 0]),
            access("codes", true, 0, [0, 1, 2]),
            access("fine", true, 4, [0, 0, 0]),
        ];
        assert_eq!(but(&all), ", but drive handed over nothing to poses and drive handed over nothing to codes");
        assert_eq!(but(&all[1..2]), "");
        assert_eq!(but(&[access("marks", false, 0, [3, 0, 0])]), ", but drive got nothing from marks");
        let told: Vec<String> = all.iter().flat_map(not_made).collect();
        let expected = [
            "drive gave up the lock in all 4 writings to poses",
            "drive gave up the lock in 1 of 4 readings of marks",
            "drive found the queue full in 1 of 4 writings to codes",
            "drive left out 2 of 4 writings to codes, since it had nothing to hand over",
        ];
        assert_eq!(told, expected);
    }

    #[test]
    fn missed_deadlines_are_told_of_each_task_until_the_stop() {
        let missed_at = |time_ns: i64| Event { time_ns, kind: Kind::Misses, ..Event::default() };
        let track = |task: &str, times: &[i64]| Track {
            task: task.to_string(),
            events: times.iter().copied().map(missed_at).collect(),
            ..Track::default()
        };
        let tracks = vec![track("drive", &[1, 5, 9]), track("arm", &[2]), track("eye", &[])];
        let recording = Recording { tracks, stopped_ns: Some(6), ..Recording::default() };
        let unsaid = "whether the model forbids that is not looked at";
        assert_eq!(missed(&recording), Some(format!("3 deadlines were missed (drive 2, arm 1); {unsaid}")));
        let one = Recording { stopped_ns: Some(1), ..recording };
        assert_eq!(missed(&one), Some(format!("1 deadline was missed (drive 1); {unsaid}")));
        assert_eq!(missed(&Recording { stopped_ns: Some(0), ..one }), None);
    }

    #[test]
    fn a_task_that_records_nothing_more_is_told_of() {
        let track = |task: &str, period_ns: i64, times: &[i64]| Track {
            task: task.to_string(),
            rhythm: (period_ns > 0).then_some(Rhythm { period_ns, offset_ns: 0, deadline_ns: period_ns }),
            events: times.iter().map(|time_ns| Event { time_ns: *time_ns, ..Event::default() }).collect(),
            ..Track::default()
        };
        let tracks = vec![
            track("drive", 10_000_000, &[0, 12_000_000, 501_000_000]),
            track("arm", 100_000_000, &[0, 100_000_000]),
            // Nobody says when it is due.
            track("plan", 0, &[0]),
            track("eye", 10_000_000, &[]),
            track("radio", 0, &[]),
            track("late", 0, &[501_000_000]),
        ];
        let recording = Recording { tracks, stopped_ns: Some(500_000_000), ..Recording::default() };
        let end = "whether it stood still is not looked at";
        let said = [
            format!("nothing is recorded of drive in the last 488.0000 ms before the stop, 48 of its periods: {end}"),
            format!("nothing is recorded of eye in the last 500.0000 ms before the stop, 50 of its periods: {end}"),
            format!("nothing is recorded of radio before the stop: {end}"),
            format!("nothing is recorded of late before the stop: {end}"),
        ];
        assert_eq!(silent(&recording), said);
        assert_eq!(silent(&Recording { stopped_ns: None, ..recording }), Vec::<String>::new());
    }
}
