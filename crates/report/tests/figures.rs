//! Figures of small runs, counted by hand.

use report::{ActivitySpec, Report, ReportBuilder, SeriesSpec, Spec, SvgOptions, TaskSpec, Tone, render_svg};

/// A run; `states` has a value for each of the terms.
fn run(spec: Spec, states: &[&[(&str, &str)]]) -> Report {
    let mut builder = ReportBuilder::new(spec);
    for (step, state) in states.iter().enumerate() {
        for (term, value) in *state {
            let index = builder.terms().iter().position(|known| known == term).expect("it is watched");
            builder.set(index, value);
        }
        match step {
            0 => builder.begin(),
            _ => builder.step(),
        }
    }
    builder.finish("Small")
}

fn level(tick_ns: Option<u64>) -> Report {
    let series =
        SeriesSpec { name: "level".into(), value: "level".into(), bound: Some("most".into()), ..SeriesSpec::default() };
    let spec = Spec { tick_ns, series: vec![series], ..Spec::default() };
    run(spec, &[&[("level", "10"), ("most", "9")], &[("level", "9")], &[("level", "8")]])
}

#[test]
fn the_initial_state_is_one_of_those_that_are_counted() {
    let counted = level(None);
    assert_eq!((counted.ticks, counted.steps()), (3, 2));
    assert_eq!(counted.series[0].values.greatest(), Some((10, 0)));
    assert_eq!(counted.troubles(), ["level reached 10, above its bound 9"]);
    // Where a step takes time, it is seen in the state behind it; there is none before the first.
    let timed = level(Some(1_000_000));
    assert_eq!((timed.ticks, timed.steps()), (2, 2));
    assert_eq!(timed.series[0].values.greatest(), Some((9, 0)));
}

fn late(deadline: &'static str, may_miss: &'static str) -> Report {
    let term = |name: &str| Some(name.to_string());
    let task = TaskSpec {
        name: "motor".into(),
        activity: "activity".into(),
        period: term("period"),
        deadline: term("deadline"),
        may_miss: term("mayMiss"),
        release: term("release"),
        missed: term("missed"),
        ..TaskSpec::default()
    };
    let spec = Spec { tick_ns: Some(1_000_000), tasks: vec![task], ..Spec::default() };
    let first: &[(&str, &str)] = &[
        ("activity", "WORK"),
        ("period", "5"),
        ("deadline", deadline),
        ("mayMiss", may_miss),
        ("release", "0"),
        ("missed", "0"),
    ];
    let same: &[(&str, &str)] = &[];
    run(spec, &[first, same, same, same, &[("missed", "1")], &[("release", "5")], same, same, same, same])
}

#[test]
fn a_deadline_may_come_before_the_end_of_the_period() {
    let report = late("3", "undef");
    assert_eq!((report.tasks[0].allowed(), report.tasks[0].overdue), (Some(3), Some(1)));
    let said = ["motor missed a deadline", "motor was 1\u{202f}ms late with the cycle it was in at the end"];
    assert_eq!(report.troubles(), said);
    assert_eq!((late("undef", "undef").tasks[0].allowed(), late("undef", "undef").tasks[0].overdue), (Some(5), None));
}

#[test]
fn what_a_task_may_miss_is_no_trouble() {
    let report = late("3", "true");
    assert!(report.troubles().is_empty(), "{:?}", report.troubles());
    assert_eq!(report.deadlines(), (0, 2));
}

/// A mark stands at each deadline that is not the end of its period, and the legend says so.
#[test]
fn early_deadlines_are_marked() {
    let picture = |deadline| render_svg(&late(deadline, "true"), &SvgOptions::default());
    let (early, whole) = (picture("3"), picture("undef"));
    assert!(early.contains("<path class=\"deadline\" d=\"M") && early.contains(">deadline</text>"), "{early}");
    assert!(!whole.contains("<path class=\"deadline\"") && whole.contains("the deadline of the one before"), "{whole}");
}

/// A location without a value is not drawn like one that is false.
#[test]
fn undef_is_not_false() {
    let lane = |name: &str| TaskSpec { name: name.into(), activity: name.into(), ..TaskSpec::default() };
    let activity = |value: &str, tone| ActivitySpec { value: value.into(), label: value.into(), tone };
    let activities = vec![activity("false", Tone::Idle), activity("true", Tone::Work)];
    let spec = Spec { activities, tasks: vec![lane("unset"), lane("off")], ..Spec::default() };
    let report = run(spec, &[&[("off", "false")], &[], &[("unset", "true")]]);
    let kinds = |task: usize| -> Vec<(u64, u64, &str)> {
        let track = &report.tasks[task].track;
        track.spans().iter().map(|span| (span.start, span.end, track.kind(*span).label.as_str())).collect()
    };
    assert_eq!(kinds(0), [(0, 2, "undef"), (2, 3, "true")]);
    assert_eq!(kinds(1), [(0, 3, "false")]);
    assert_eq!(Tone::named("undef"), None, "it is no tone of a specification");
    let picture = render_svg(&report, &SvgOptions::default());
    assert!(picture.contains("<path class=\"undef\"") && picture.contains(">undef</text>"), "{picture}");
}
