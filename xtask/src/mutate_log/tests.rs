//! Each so many-th change of two logs of cpp/systems/Contention.chart, and what the judge itself lets through. The logs are of
//! the program that `make systems` compiles: a run in the model's time, and one in drawn time.

use super::*;

fn log(name: &str) -> Log {
    let path = crate::repository::root().join("cpp/systems/logs").join(format!("{name}.mcap"));
    let bytes = std::fs::read(&path).expect("the log is there");
    Log { name: name.to_string(), recording: Recording::read(&bytes).expect("a recording") }
}

fn contention() -> &'static Subject {
    SUBJECTS.iter().find(|subject| subject.name == "contention").expect("it is there")
}

/// Another part of all changes with each log.
#[test]
fn no_change_of_an_event_goes_unseen() {
    for (name, every) in [("contention-modelled", 17), ("contention-drawn", 19)] {
        let log = log(name);
        let counts = look(contention(), &log, every).expect("it conforms");
        let mut sum = Count::default();
        counts.values().for_each(|count| sum.add(*count));
        assert_eq!(sum.of(Fate::Missed), 0, "{name}: {counts:?}");
        assert!(sum.of(Fate::Parts) > 50, "{name}: {counts:?}");
    }
}

/// The judge lets the log through, and of its changes those alone that leave a run.
#[test]
fn the_judge_has_an_opinion_of_its_own() {
    let log = log("contention-drawn").recording;
    let chart = contention().chart().expect("a chart");
    let plan = judge::Plan::new(chart.system.as_ref().expect("a system"), &log);
    assert_eq!(plan.allows(&log), Ok(()));
    let (mut legal, mut other) = (0, 0);
    for (place, change) in changes(&log).into_iter().step_by(7) {
        let Some(changed) = mutant(&log, place, change) else { continue };
        match plan.allows(&changed) {
            Ok(()) => legal += 1,
            Err(_) => other += 1,
        }
        assert!(plan.allows(&changed).is_err() || !matches!(change, Change::OtherNumber(_)), "{change:?} at {place:?}");
    }
    assert!(legal > 0 && other > 10 * legal, "{legal} legal, {other} not");
}
