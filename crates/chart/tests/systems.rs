//! A system is compared with its model: every change of a chart is reported in the system's terms, and a text with the
//! same meaning is not.

use chart::{Known, build, probed};
use model::check;
use syntax::{Severity, SourceFile};
use testkit::{NoSolver, Patterns};

const CELL: &str = "chart Cell
import patterns/ControlTask
system cell \"Cell\"
	tick 0.1 ms
	component camera \"Camera\" synchronous period 10 ms
		elaborate scan 6 ms {r_scan[]}
		write lines 0.2 ms
	endcomponent
	component classifier asynchronous awaits lines
		read lines 0.1 ms
		elaborate classify 12 ms
		write classes 0.1 ms
		write orders
	endcomponent
	component pusher synchronous period 5 ms jitter 0.5 ms offset 1 ms deadline 4 ms
		read classes 0.1 ms
		elaborate push 1 ms
	endcomponent
	component watcher synchronous period 20 ms
		read orders
		write lamp
	endcomponent
	component panel synchronous period 40 ms
		read lamp
	endcomponent
	channel lines from camera to classifier swinging buffer 2
	channel classes from classifier to pusher swinging buffer 3
	channel orders from classifier to watcher queue 4
	channel lamp from watcher to panel shared value
endsystem
";

fn chart(text: &str) -> chart::Chart {
    let loaded = chart::load(SourceFile::new("Cell.chart", text), &mut Patterns);
    let errors: Vec<_> = loaded.diagnostics.iter().filter(|fault| fault.severity == Severity::Error).collect();
    assert!(errors.is_empty(), "{errors:#?}");
    loaded.chart
}

fn built(text: &str) -> String {
    let mut drawn = chart(text);
    let known = Known::completed(&mut drawn, "Imports.asm", &mut Patterns).expect("the library has no faults");
    assert_eq!(chart::unbuilt(&drawn, &known), []);
    build(&drawn, &known, None).expect("there was no file").text
}

/// The reported differences of a chart and a model.
fn differences(text: &str, model: &str) -> Vec<String> {
    let loaded = chart::load(SourceFile::new("Cell.chart", text), &mut Patterns);
    let probed = probed(&loaded.chart, model).expect("the model parses");
    let checked = check(SourceFile::new("Cell.asm", probed.text.as_str()), &mut Patterns);
    let faults = chart::check(&loaded.chart, &probed, &checked, &mut NoSolver);
    faults.iter().map(|fault| format!("{}: {}", fault.id, fault.message)).collect()
}

/// Replaces a text of the chart, and compares the result with the model of the original chart.
fn changed(from: &str, to: &str) -> Vec<String> {
    assert!(CELL.contains(from), "{from}");
    differences(&CELL.replacen(from, to, 1), &built(CELL))
}

fn check_change(from: &str, to: &str, expected: &[&str]) {
    let told = changed(from, to);
    let expected: Vec<String> = expected.iter().map(|message| format!("system-differs: {message}")).collect();
    assert_eq!(told, expected, "`{from}` for `{to}`");
}

#[test]
fn a_chart_and_what_it_is_built_to_agree() {
    assert_eq!(differences(CELL, &built(CELL)), [""; 0]);
}

#[test]
fn each_number() {
    check_change(
        "period 10 ms",
        "period 40 ms",
        &["the component `camera`: the period is 40 ms in the chart, 10 ms in the model"],
    );
    check_change(
        "offset 1 ms",
        "offset 2 ms",
        &["the component `pusher`: the offset is 2 ms in the chart, 1 ms in the model"],
    );
    check_change(
        "jitter 0.5 ms",
        "jitter 1 ms",
        &["the component `pusher`: the jitter is 1 ms in the chart, 500 us in the model"],
    );
    check_change(
        "deadline 4 ms",
        "deadline 3 ms",
        &["the component `pusher`: the deadline is 3 ms in the chart, 4 ms in the model"],
    );
    check_change(
        "scan 6 ms",
        "scan 7 ms",
        &["the phase `camera_scan` of the component `camera`: its time is 7 ms in the chart, 6 ms in the model"],
    );
    check_change(
        "buffer 3",
        "buffer 2",
        &["the channel `classes`: the number of arrays is 2 in the chart, 3 in the model"],
    );
    check_change(
        "queue 4",
        "queue 5",
        &["the channel `orders`: the number of messages is 5 in the chart, 4 in the model"],
    );
    assert!(!changed("tick 0.1 ms", "tick 0.05 ms").is_empty());
}

#[test]
fn kinds_masters_and_order() {
    check_change(
        "swinging buffer 2",
        "swinging buffer 2 master camera",
        &["the channel `lines`: the master is `camera` in the chart, `classifier` in the model"],
    );
    check_change(
        "elaborate push 1 ms",
        "elaborate push 1 ms {r_push[]}",
        &["the phase `pusher_push` of the component `pusher`: its rule is `r_push` in the chart, none in the model"],
    );
    for (from, to) in [
        ("shared value", "queue 2"),
        ("queue 4", "shared value"),
        ("swinging buffer 3", "shared value"),
        ("synchronous period 40 ms", "asynchronous awaits lamp"),
        ("synchronous period 40 ms", "asynchronous"),
        ("asynchronous awaits lines", "asynchronous"),
        ("\t\twrite classes 0.1 ms\n\t\twrite orders\n", "\t\twrite orders\n\t\twrite classes 0.1 ms\n"),
        ("read orders\n", "read orders as take\n"),
    ] {
        let told = changed(from, to);
        assert!(!told.is_empty() && told.iter().all(|one| one.starts_with("system-differs")), "{from}: {told:#?}");
    }
}

#[test]
fn what_is_left_out_or_added() {
    let panel = "\tcomponent panel synchronous period 40 ms\n\t\tread lamp\n\tendcomponent\n";
    let lamp = "\tchannel lamp from watcher to panel shared value\n";
    let less = CELL.replace(panel, "").replace(lamp, "").replace("\t\twrite lamp\n", "");
    let told = differences(&less, &built(CELL));
    assert!(told.iter().any(|one| one.contains("the model has the component `panel`")), "{told:#?}");
    assert!(told.iter().any(|one| one.contains("the model has the shared value `lamp`")), "{told:#?}");
    let told = differences(CELL, &built(&less));
    assert!(told.iter().any(|one| one.contains("the component `panel` is not in the model")), "{told:#?}");
    assert!(told.iter().any(|one| one.contains("the channel `lamp` is not in the model")), "{told:#?}");
}

#[test]
fn what_means_the_same_is_not_told() {
    let model = built(CELL);
    // Reordered cases, a renamed variable, a comment, parentheses.
    let drawn = "function task_period($t in Task) =\n\t\tswitch $t\n\t\t\tcase camera_task: 100";
    assert!(model.contains(drawn), "{model}");
    let same = model.replace("clock := clock + 1", "clock := /* on */ clock   + 1");
    let same =
        same.replace("function mq_capacity($q in MessageQueue) = 4", "function mq_capacity($x in MessageQueue) = (4)");
    assert_ne!(same, model);
    assert_eq!(differences(CELL, &same), [""; 0]);
    // What is written by hand, and what the user adds.
    let by_hand = model.replace(
        "rule r_scan($c in Scheduler) = skip",
        "rule r_scan($c in Scheduler) = r_more[]\n\trule r_more = skip",
    );
    assert_ne!(by_hand, model);
    assert_eq!(differences(CELL, &by_hand), [""; 0]);
}

#[test]
fn changes_of_the_model() {
    let model = built(CELL);
    for (from, to) in [
        ("clock := clock + 1", "clock := clock + 2"),
        ("rule r_controlTask = r_scheduler_execute[self]", "rule r_controlTask = skip"),
        ("task_deadlinesMissed($t) = 0)", "task_deadlinesMissed($t) >= 0)"),
        ("agent Scheduler: r_controlTask[]", "agent Scheduler: r_other[]"),
        ("\tstatic lamp: SharedValue\n", "\tstatic lamp: SharedValue\n\tstatic lamp2: SharedValue\n"),
        ("\tfunction clock = 0\n", "\tfunction clock = 1\n"),
    ] {
        let mutant = model.replacen(from, to, 1);
        let mutant = mutant.replace("definitions:\n", "definitions:\n\trule r_other = skip\n");
        assert!(model.contains(from), "{from}\n{model}");
        let told = differences(CELL, &mutant);
        assert_eq!(told.len(), 1, "{from}: {told:#?}");
    }
    for (from, to) in [
        ("function sem_permits($s in Semaphore) = 1", "function sem_permits($s in Semaphore) = 2"),
        ("function sb_pending($b in SwingingBuffer) = false", "function sb_pending($b in SwingingBuffer) = true"),
    ] {
        // One for each of the two buffers.
        assert_eq!(differences(CELL, &model.replacen(from, to, 1)).len(), 2, "{from}");
    }
}

/// The cell with bounds on the ages of its data.
fn bounded(bounds: &str) -> String {
    CELL.replace("endsystem", &format!("{bounds}endsystem"))
}

#[test]
fn age_bounds() {
    let (pusher, panel) = ("\twithin 100 ms from camera to pusher\n", "\twithin 300 ms from camera to panel\n");
    let both = bounded(&format!("{pusher}{panel}"));
    let model = built(&both);
    assert_eq!(differences(&both, &model), [""; 0]);
    let told = differences(&both.replace("within 100 ms", "within 90 ms"), &model);
    let message =
        "the age bound from `camera` to `pusher`: the age that is allowed is 90 ms in the chart, 100 ms in the model";
    assert_eq!(told, [format!("system-differs: {message}")]);
    assert!(!differences(CELL, &model).is_empty() && !differences(&both, &built(CELL)).is_empty());
    // A bound that is taken away is gone from the model, too, whichever it was.
    for left in ["", pusher, panel] {
        let mut drawn = chart(&bounded(left));
        let known = Known::completed(&mut drawn, "Imports.asm", &mut Patterns).expect("the library has no faults");
        let text = build(&drawn, &known, Some(&model)).expect("the model has no faults").text;
        let checked = check(SourceFile::new("Cell.asm", text.as_str()), &mut Patterns);
        assert_eq!(checked.diagnostics, [], "{left}");
        assert_eq!(differences(&bounded(left), &text), [""; 0], "{left}");
    }
}

/// The ids of the faults of a chart.
fn told(text: &str) -> Vec<String> {
    let loaded = chart::load(SourceFile::new("Cell.chart", text), &mut Patterns);
    loaded.diagnostics.iter().map(|fault| format!("{}: {}", fault.id, fault.message)).collect()
}

#[test]
fn a_cycle_of_one_phase_may_not_take_the_whole_period() {
    let cell = |times: &str, phase: &str| {
        told(&format!(
            "chart Cell system cell tick 1 ms component a synchronous {times} elaborate x {phase} endcomponent endsystem"
        ))
    };
    let late = "long-cycle: every cycle of `a` misses its period of 10 ms: it takes 10 ms (x), and the next one begins a tick after it";
    assert_eq!(cell("period 10 ms", "10 ms"), [late]);
    let sometimes = "long-cycle: a long cycle of `a` misses its period of 10 ms: it takes up to 10 ms (x), and the next one begins a tick after it";
    assert_eq!(cell("period 10 ms", "8..10 ms"), [sometimes]);
    assert_eq!(cell("period 10 ms", "9 ms"), [""; 0]);
    assert_eq!(cell("period 10 ms deadline 9 ms", "9 ms"), [""; 0]);
    assert_eq!(cell("period 10 ms", "9 ms elaborate y 1 ms"), [""; 0]);
    assert_eq!(cell("period 0 ms", "0 ms"), ["time-unit: a period takes at least a tick"]);
    let offset = "time-unit: the first cycle begins within the first period";
    assert_eq!(cell("period 10 ms offset 11 ms", "1 ms"), [offset]);
    assert_eq!(cell("period 10 ms offset 10 ms", "1 ms"), [""; 0]);
}

/// No time is read as another one.
#[test]
fn times_are_whole_and_shorter_than_a_day() {
    let cell = |tick: &str, period: &str, phase: &str| {
        told(&format!(
            "chart Cell system cell tick {tick} component a synchronous period {period} elaborate x {phase} endcomponent endsystem"
        ))
    };
    let long = "time-unit: this is longer than a day";
    assert_eq!(cell("1 ms", "86400 s", "1 ms"), [""; 0]);
    assert_eq!(cell("1 ms", "9999999999 s", "1 ms"), [long]);
    assert_eq!(cell("1 ms", "10 s", "9999999999999999 s"), [long]);
    assert_eq!(cell("1 ms", "10 s", "1..9999999999999999 s"), [long]);
    assert_eq!(cell("99999999 s", "10 s", "1 s"), [long]);
    let fine = "time-unit: this is not a whole number of nanoseconds";
    assert_eq!(cell("1.5 ns", "10 ms", "1 ms"), [fine]);
    assert_eq!(cell("1 ns", "0.0000001 ms", "1 ns"), [fine]);
    assert_eq!(cell("0.3 ms", "0.9 ms", "0.3 ms"), [""; 0]);
    assert_eq!(cell("0 ms", "10 ms", "1 ms"), ["time-unit: a tick takes at least a nanosecond"]);
}

#[test]
fn a_jitter_is_at_least_a_tick_and_at_most_a_period() {
    let cell = |kind: &str, phase: &str| {
        let text =
            format!("chart Cell system cell tick 1 ms component a {kind} elaborate x {phase} endcomponent endsystem");
        let loaded = chart::load(SourceFile::new("Cell.chart", text.as_str()), &mut Patterns);
        let told = |fault: &syntax::Diagnostic| {
            let range = fault.primary.span.range();
            format!("{} at `{}`", fault.message, &text[range])
        };
        loaded.diagnostics.iter().map(told).collect::<Vec<_>>()
    };
    assert_eq!(cell("synchronous period 10 ms jitter 1 ms", "8 ms"), [""; 0]);
    assert_eq!(
        cell("synchronous period 10 ms jitter 9 ms offset 1 ms deadline 10 ms misses 1 of 2", "1..2 ms"),
        [""; 0]
    );
    assert_eq!(
        cell("synchronous period 10 ms jitter 11 ms", "1 ms"),
        ["a cycle is released within its period at `11 ms`"]
    );
    assert_eq!(cell("synchronous period 10 ms jitter 0 ms", "1 ms"), ["a jitter takes at least a tick at `0 ms`"]);
    assert_eq!(
        cell("asynchronous jitter 1 ms", "1 ms"),
        ["`a` is asynchronous: it has no period that its releases could miss at `1 ms`"]
    );
    assert_eq!(
        cell("synchronous jitter 1 ms", "1 ms")[0],
        "expected `period` behind `synchronous`, found `jitter` at `jitter`"
    );
    assert_eq!(
        cell("synchronous period 10 ms jitter 1 furlong", "1 ms"),
        ["`furlong` is not a unit of time at `furlong`"]
    );
    assert_eq!(
        cell("synchronous period 10 ms jitter 0.5 ms", "1 ms"),
        ["this is not a whole number of ticks at `0.5 ms`"]
    );
    assert_eq!(
        cell("synchronous period 10 ms jitter 1 offset 1 ms", "1 ms"),
        ["expected a unit behind the length of time, found `offset` at `offset`"]
    );
    let late = "a long cycle of `a` misses its period of 10 ms: it takes up to 8 ms (x) + 2 ms (jitter) = 10 ms, \
                and the next one begins a tick after it at `a`";
    assert_eq!(cell("synchronous period 10 ms jitter 2 ms", "8 ms"), [late]);
}

#[test]
fn only_stated_processors_are_judged() {
    assert_eq!(told(CELL), [""; 0]);
    assert_eq!(told(&bounded("\tprocessors 5\n")), [""; 0]);
    let late = "late-response: `pusher` may miss its deadline of 4 ms on 2 processors: \
                tasks with locks are not analysed on fewer processors than tasks";
    assert!(
        told(&bounded("\tprocessors 2\n")).contains(&late.to_string()),
        "{:#?}",
        told(&bounded("\tprocessors 2\n"))
    );
    let overloaded = bounded("\tprocessors 1\n").replace("scan 6 ms", "scan 9 ms");
    assert_eq!(told(&overloaded), ["overloaded: the synchronous tasks need 1.18 processors, more than there are"]);
    for (bound, id) in [
        ("within 9 ms from camera to pusher", "age-bound"),
        ("within 90 ms from pusher to camera", "age-bound"),
        ("within 90 ms from camera to nobody", "unknown-shape"),
        ("processors 0", "overloaded"),
        ("processors 1\n\tprocessors 1", "duplicate-shape"),
        ("tick 0.1 ms", "duplicate-shape"),
    ] {
        let told = told(&bounded(&format!("\t{bound}\n")));
        assert!(told.iter().any(|one| one.starts_with(id)), "{bound}: {told:#?}");
    }
}

/// A channel to two readers, and the same written out: a channel for each, and a phase for each that writes it.
fn broadcast(kind: &str, own: [&str; 2], written_out: bool) -> String {
    let (write, channels) = match written_out {
        false => ("write frame 0.2 ms".to_string(), format!("channel frame from grab to servo, view {kind}")),
        true => (
            "write frame_servo as grab_write_frame_servo 0.2 ms write frame_view as grab_write_frame_view 0.2 ms"
                .to_string(),
            format!(
                "channel frame_servo from grab to servo {} channel frame_view from grab to view {}",
                own[0], own[1]
            ),
        ),
    };
    let read = |reader: &str| match written_out {
        false => "read frame".to_string(),
        true => format!("read frame_{reader} as {reader}_read_frame"),
    };
    let awaits = if written_out { "frame_view" } else { "frame" };
    format!(
        "chart Cell import patterns/ControlTask system cell tick 0.1 ms \
         component grab synchronous period 10 ms elaborate shot 2 ms {write} endcomponent \
         component servo synchronous period 5 ms {} elaborate law 1 ms endcomponent \
         component view asynchronous awaits {awaits} {} elaborate show 1..3 ms endcomponent \
         {channels} sensor eye eye -> grab within 60 ms from eye to view endsystem",
        read("servo"),
        read("view")
    )
}

#[test]
fn a_channel_with_several_readers_is_one_for_each() {
    let same = |kind: &str, own: [&str; 2]| {
        let (one, other) = (built(&broadcast(kind, own, false)), built(&broadcast(kind, own, true)));
        assert_eq!(one, other, "{kind}");
        assert_eq!(differences(&broadcast(kind, own, false), &one), [""; 0], "{kind}");
    };
    // The slower of two synchronous components, the asynchronous one of a mixed pair.
    same("swinging buffer 3", ["swinging buffer 3 master grab", "swinging buffer 3 master view"]);
    same("swinging buffer 2 master grab", ["swinging buffer 2 master grab", "swinging buffer 2 master grab"]);
    // A reader that is named says nothing about the other one's buffer.
    same("swinging buffer 2 master servo", ["swinging buffer 2 master servo", "swinging buffer 2 master view"]);
    same("queue 4", ["queue 4", "queue 4"]);
    same("shared value", ["shared value", "shared value"]);
}

#[test]
fn readers_that_do_not_fit() {
    let text = broadcast("queue 4", ["", ""], false);
    let check = |from: &str, to: &str, expected: &[&str]| {
        assert!(text.contains(from), "{from}");
        let loaded = chart::load(SourceFile::new("Cell.chart", text.replace(from, to)), &mut Patterns);
        let told: Vec<&str> = loaded.diagnostics.iter().map(|fault| fault.message.as_str()).collect();
        assert_eq!(told, expected, "`{from}` for `{to}`");
    };
    check(
        "servo, view",
        "servo, view, servo",
        &["the channel `frame` does not fit: `servo` is named twice as its reader"],
    );
    check("5 ms read frame", "5 ms", &["the channel `frame` does not fit: `servo` does not read it once a cycle"]);
    check("write frame 0.2 ms", "", &["the channel `frame` does not fit: its sender does not write it once a cycle"]);
    check("servo, view queue 4", "servo, view swinging buffer 2 master eye", &["there is no component `eye`"]);
    // Of two synchronous components with one period, neither is the slower one.
    let text_of_buffers = text.replace("queue 4", "swinging buffer 2").replace("period 5 ms", "period 10 ms");
    let loaded = chart::load(SourceFile::new("Cell.chart", text_of_buffers), &mut Patterns);
    let told: Vec<&str> = loaded.diagnostics.iter().map(|fault| fault.message.as_str()).collect();
    assert_eq!(told, ["the master of the buffer `frame` to `servo` must be named"]);
    let places = "the channel `frame` does not fit: a queue has one place at least";
    for size in ["0", "99999999999999999999999999"] {
        check("queue 4", &format!("queue {size}"), &[places]);
    }
    check(
        "endcomponent component view asynchronous awaits frame read frame",
        "write frame_view endcomponent component view asynchronous awaits frame read frame read frame_view",
        &["there is no channel `frame_view`", "there is no channel `frame_view`"],
    );
    check(
        "endcomponent component view asynchronous awaits frame read frame",
        "write frame_view endcomponent channel frame_view from servo to view queue 2 \
         component view asynchronous awaits frame read frame read frame_view as other",
        &["a second channel `frame_view` would be made"],
    );
}

const FUSION: &str = "chart Cell\nimport patterns/ControlTask\nsystem cell\n\
    component camera synchronous period 10 ms write frames endcomponent component encoder synchronous period 4 ms write poses endcomponent\n\
    component fuse asynchronous awaits all frames, poses read frames read poses write fixes endcomponent\n\
    component guide asynchronous awaits fixes read fixes endcomponent\n\
    channel frames from camera to fuse swinging buffer 2 channel poses from encoder to fuse shared value\n\
    channel fixes from fuse to guide queue 4 endsystem\n";

#[test]
fn what_is_awaited() {
    let model = built(FUSION);
    assert_eq!(differences(FUSION, &model), [""; 0]);
    let waiting = "system-differs: the waiting phase of the component `fuse`";
    let check = |awaits: &str, expected: &[&str]| {
        let told = differences(&FUSION.replace("awaits all frames, poses", awaits), &model);
        let expected: Vec<String> = expected.iter().map(|text| format!("{waiting}: {text}")).collect();
        assert_eq!(told, expected, "{awaits}");
    };
    check("awaits all poses, frames", &[]);
    check("awaits any frames, poses", &["whether it awaits all of them is `false` in the chart, `true` in the model"]);
    check(
        "awaits poses",
        &[
            "the readings that it awaits is none in the chart, `{ fuse_read_frames , fuse_read_poses }` in the model",
            "whether it awaits all of them is none in the chart, `true` in the model",
            "its channel is `poses` in the chart, none in the model",
        ],
    );
}

#[test]
fn what_cannot_be_awaited() {
    let check = |from: &str, to: &str, expected: &str| {
        assert!(FUSION.contains(from), "{from}");
        let loaded = chart::load(SourceFile::new("Cell.chart", FUSION.replace(from, to)), &mut Patterns);
        let told: Vec<&str> = loaded.diagnostics.iter().map(|fault| fault.message.as_str()).collect();
        assert_eq!(told, [expected], "`{from}` for `{to}`");
    };
    let unclear = "several channels are awaited, and it is not said whether all or any of them";
    check("awaits all frames", "awaits frames", unclear);
    check("awaits all frames, poses", "awaits all frames, frames", "the channel `frames` is awaited twice");
    let elsewhere = "the channel `fixes` does not fit: the component does not read it";
    check("awaits all frames, poses", "awaits any frames, fixes", elsewhere);
    check("awaits all frames, poses", "awaits all frames, pose", "there is no channel `pose`");
    // A task that awaits its own data; two that await each other's, and a third one behind them.
    let told = |text: &str| {
        let loaded = chart::load(SourceFile::new("Cell.chart", text), &mut Patterns);
        loaded.diagnostics.iter().map(|fault| fault.message.clone()).collect::<Vec<_>>()
    };
    let hinting = |readers: &str| {
        let text = FUSION.replace("read fixes endcomponent", "read fixes write hints endcomponent");
        text.replace("endsystem", &format!("channel hints from guide to {readers} queue 4 endsystem"))
    };
    let own = hinting("guide").replace("awaits fixes read fixes", "awaits all fixes, hints read fixes read hints");
    assert_eq!(told(&own), ["`guide` never starts: `guide` awaits `guide`"]);
    let back = hinting("fuse, late")
        .replace("awaits all frames, poses read frames", "awaits all frames, hints read hints read frames")
        .replace("endsystem", "component late asynchronous awaits hints read hints endcomponent endsystem");
    assert_eq!(told(&back), ["`fuse` never starts: `fuse` awaits `guide` awaits `fuse`"]);
    // One of several may come from outside.
    assert_eq!(told(&back.replace("awaits all", "awaits any")), [""; 0]);
}

#[test]
fn a_name_that_is_made_must_not_be_that_of_a_rule() {
    let told = |text: &str| {
        let loaded = chart::load(SourceFile::new("Cell.chart", text), &mut Patterns);
        loaded.diagnostics.iter().map(|fault| fault.message.clone()).collect::<Vec<_>>()
    };
    let renamed = |from: &str| FUSION.replace(from, "r");
    assert_eq!(told(&renamed("frames")), ["`r_lock` cannot be the name of a function"]);
    // A value has no lock.
    assert_eq!(told(&renamed("poses")), [""; 0]);
    assert!(told(&renamed("guide")).contains(&"`r_task` cannot be the name of a function".to_string()));
}

#[test]
fn more_processors_are_advised_where_they_help() {
    let advice = |channel: &str, processors: usize| {
        let text = format!(
            "chart C system c\n processors {processors}\n component eye synchronous period 4 ms\n elaborate look 1 ms\n write seen 1 ms\n \
             endcomponent\n component plan asynchronous awaits seen\n read seen 1 ms\n elaborate think 9 ms\n endcomponent\n \
             component arm synchronous period 20 ms deadline 3 ms\n elaborate go 2 ms\n endcomponent\n \
             channel seen from eye to plan {channel}\nendsystem"
        );
        let (_, faults) = chart::read(syntax::FileId(0), &syntax::parse_chart(syntax::FileId(0), &text));
        let late = faults.iter().filter(|fault| fault.id == "late-response");
        late.map(|fault| {
            let more = fault.help.as_ref().is_some_and(|help| help.ends_with("or use more processors"));
            let name = fault.message.split('`').nth(1).unwrap_or_default();
            format!("{name}: {}", if more { "more processors" } else { "a later deadline" })
        })
        .collect::<Vec<String>>()
    };
    // The eye may wait for room in the queue, whoever else has a processor.
    assert_eq!(advice("queue 2", 1), ["eye: a later deadline", "arm: more processors"]);
    assert_eq!(advice("shared value", 1), ["arm: more processors"]);
    assert_eq!(advice("shared value", 3), [""; 0]);
}
