//! What a recording states of bounds is so in the model, in any unit; what is not compared is named.

use machine::Closed;
use std::sync::Arc;

use super::*;
use crate::session::model_named;

/// What is bounded, and by what.
fn stated(bounds: &[(&str, &str)]) -> Recording {
    let bound = |(what, limit): &(&str, &str)| Bounded {
        what: (*what).to_string(),
        limit: (*limit).to_string(),
        ..Bounded::default()
    };
    Recording { bounds: bounds.iter().map(bound).collect(), ended: true, ..Recording::default() }
}

/// What is said of it beside these bounds of the model.
fn said(bounds: &[Modelled], vocabulary: &Vocabulary, recorded: &[(&str, &str)]) -> String {
    match compare(&stated(recorded), bounds, vocabulary) {
        Err(words) => words,
        Ok(Open { unread, uncounted }) => format!("unread {unread:?}, uncounted {uncounted:?}"),
    }
}

/// An example, and its tick.
fn of_model(name: &str, tick_ns: i64) -> (Vec<Modelled>, Vocabulary) {
    let (_, _, program) = model_named(name);
    let mut machine = Machine::new(Arc::new(program.clone()), machine::Limits::default());
    machine.start(&mut Closed).expect("it starts");
    let vocabulary = Vocabulary::new(&program, &machine).expect("the library's patterns");
    (modelled(&program, &machine, &vocabulary, tick_ns), vocabulary)
}

const ALL: &str = "unread [], uncounted []";

#[test]
fn intervals_and_ages_are_those_of_the_model() {
    let (mut bounds, vocabulary) = of_model("../sorting_cell/SortingCell.asm", 100_000);
    // Two bounds over three ways each, and one whose ways are shorter by a component.
    let is_age = |bound: &Modelled| matches!(bound.what, What::Age { .. });
    assert_eq!(bounds.iter().filter(|bound| is_age(bound)).count(), 9);
    bounds.retain(|bound| !is_age(bound));
    let said = |recorded: &[(&str, &str)]| said(&bounds, &vocabulary, recorded);
    let decode = ("decode of reader", "3..9 ms");
    assert_eq!(said(&[decode, ("classify of classifier", "8..20 ms")]), ALL);
    assert_eq!(said(&[("any of classifier", "8000 us..0.02 s"), decode]), ALL);
    assert_eq!(said(&[decode]), "unread [], uncounted [\"an elaboration of classifier (8..20 ms)\"]");
    let other = "the bound of decode of reader is 3..9.5 ms in the recording, 3..9 ms in the model";
    assert_eq!(said(&[("decode of reader", "3..9.5 ms")]), other);
    let twice = "the recording bounds decode of reader (3..9 ms), the model does not";
    assert_eq!(said(&[decode, decode]), twice);
    let none = "the recording bounds deadlines missed by reader (1 of 4), the model does not";
    assert_eq!(said(&[("deadlines missed by reader", "1 of 4")]), none);

    let (bounds, vocabulary) = of_model("../press_cell/PressCell.asm", 500_000);
    let said = |recorded: &[(&str, &str)]| super::tests::said(&bounds, &vocabulary, recorded);
    // Between which devices is not in the model.
    assert_eq!(bounds.len(), 1, "{bounds:?}");
    let Limit::Ns(ns) = bounds[0].limit else { panic!("{bounds:?}") };
    let limit = format!("within {ns} ns");
    assert_eq!(said(&[("age from height to motor", &limit)]), ALL);
    let unread = said(&[("age from height to motor", "18 ms at most")]);
    assert!(
        unread.starts_with("unread [\"age from height to motor (18 ms at most)\"], uncounted [\"age from"),
        "{unread}"
    );
    let later = said(&[("age from height to motor", &format!("within {} ns", ns + 1))]);
    assert!(later.contains("in the recording, within"), "{later}");
}

#[test]
fn bounds_are_those_of_the_model() {
    let (bounds, _) = of_model("../../cpp/systems/Watched.asm", 500_000);
    let told: Vec<String> = bounds
        .iter()
        .filter_map(|Modelled { what, limit }| match what {
            What::Releases { of } => Some(format!("releases of {of} {limit:?}")),
            What::News { channel, of } => Some(format!("{channel} for {of} {limit:?}")),
            What::Misses { of } => Some(format!("missed by {of} {limit:?}")),
            What::Age { from, to, over } => Some(format!("{from} to {to} over {} {limit:?}", over.join(", "))),
            What::Elaboration { .. } => None,
        })
        .collect();
    let expected = [
        "releases of camera Ns(1000000)",
        "missed by control Misses { most: 1, of: 5 }",
        "releases of motor Ns(500000)",
        "marks for control Ns(28000000)",
        "set for motor Ns(8000000)",
        "camera to motor over frames, marks, set Ns(60000000)",
        "control to motor over set Ns(8000000)",
    ];
    assert_eq!(told, expected);
}

#[test]
fn every_kind_is_held_to_its_own() {
    let (_, vocabulary) = of_model("../sorting_cell/SortingCell.asm", 100_000);
    let name = |text: &str| text.to_string();
    let ms = |number: i128| Limit::Ns(number * 1_000_000);
    let age = |over: &[&str], limit: Limit| Modelled {
        what: What::Age {
            from: name("reader"),
            to: name("sequencer"),
            over: over.iter().map(|one| name(one)).collect(),
        },
        limit,
    };
    let bounds = [
        Modelled { what: What::Releases { of: name("reader") }, limit: ms(2) },
        Modelled { what: What::News { channel: name("codes_sequencer"), of: name("sequencer") }, limit: ms(20) },
        Modelled { what: What::Misses { of: name("sequencer") }, limit: Limit::Misses { most: 1, of: 20 } },
        age(&["codes", "orders"], ms(30)),
        age(&["images"], ms(30)),
    ];
    let good = [
        ("releases of reader", "2 ms"),
        ("new codes for sequencer", "every 20 ms"),
        ("deadlines missed by sequencer", "1 of 20"),
        ("age from eye to sequencer over images", "within 30 ms"),
        ("age from eye to sequencer over codes, orders", "within 30 ms"),
    ];
    assert_eq!(said(&bounds, &vocabulary, &good), ALL);
    // One that does not say over which channels means the one that is left, wherever it stands.
    let first = [&[("age from eye to sequencer", "within 30 ms")], &good[..3], &good[4..]].concat();
    assert_eq!(said(&bounds, &vocabulary, &first), ALL);
    for (at, other) in [
        (0, ("releases of reader", "2.5 ms")),
        (0, ("releases of sequencer", "2 ms")),
        (1, ("new codes for reader", "every 20 ms")),
        (1, ("new images for sequencer", "every 20 ms")),
        (1, ("new codes for sequencer", "every 21 ms")),
        (2, ("deadlines missed by sequencer", "1 of 19")),
        (2, ("deadlines missed by sequencer", "2 of 20")),
        (3, ("age from eye to sequencer over codes", "within 30 ms")),
        // A component is one of the model.
        (4, ("age from sequencer to sequencer over codes, orders", "within 30 ms")),
        (4, ("age from eye to reader over codes, orders", "within 30 ms")),
        (4, ("age from eye to sequencer over codes, orders", "within 31 ms")),
    ] {
        let mut wrong = good;
        wrong[at] = other;
        let words = said(&bounds, &vocabulary, &wrong);
        let (what, limit) = other;
        let is_named = [format!("the recording bounds {what} ({limit})"), format!("the bound of {what} is {limit}")];
        assert!(is_named.iter().any(|start| words.starts_with(start)), "{words}");
    }
}

#[test]
fn lengths_are_read_exactly_or_not_at_all() {
    for (text, ns) in [
        ("0.5 ms", Some(500_000)),
        ("120 ms", Some(120_000_000)),
        ("1.5 s", Some(1_500_000_000)),
        ("300 ns", Some(300)),
        ("0.25 us", Some(250)),
        ("0.5 ns", None),
        ("1 h", None),
        (".5 ms", None),
        ("-1 ms", None),
        ("1e3 ms", None),
        ("99999999999999999999999999999999999999999 s", None),
        ("ms", None),
        ("", None),
    ] {
        assert_eq!(length(text), ns, "{text}");
    }
}

/// What a generated program does not say like that is not compared, and named.
#[test]
fn other_words_are_not_compared() {
    let (_, vocabulary) = of_model("../sorting_cell/SortingCell.asm", 100_000);
    for (what, limit) in [
        ("jumps of reader", "2 ms"),
        ("releases of two words", "2 ms"),
        ("releases of ", "2 ms"),
        ("deadlines missed by two words", "1 of 20"),
        ("new codes for ", "every 20 ms"),
        ("new  for sequencer", "every 20 ms"),
    ] {
        let bounds = [Modelled { what: What::Releases { of: "reader".to_string() }, limit: Limit::Ns(2_000_000) }];
        let words = said(&bounds, &vocabulary, &[(what, limit)]);
        let unread = format!("unread [\"{what} ({limit})\"], uncounted [\"releases of reader (2 ms)\"]");
        assert_eq!(words, unread);
    }
}

#[test]
fn an_age_is_told_with_its_channels() {
    let age = |over: &[&str]| What::Age {
        from: "eye".to_string(),
        to: "arm".to_string(),
        over: over.iter().map(|one| (*one).to_string()).collect(),
    };
    assert_eq!(age(&[]).shown(), "age from eye to arm");
    assert_eq!(age(&["codes", "orders"]).shown(), "age from eye to arm over codes, orders");
}

/// What of these counts cannot be: seen, below, beyond, greatest.
fn counted(limit: &str, what: &str, [seen, below, beyond]: [u64; 3], greatest: Greatest) -> String {
    let bound = Bounded { what: what.to_string(), limit: limit.to_string(), seen, below, beyond, greatest };
    let recording = Recording { bounds: vec![bound], ended: true, ..Recording::default() };
    let failed = Recording { failure: Some("a task hung".to_string()), ..recording.clone() };
    assert_eq!(contradiction(&failed), None);
    contradiction(&recording).unwrap_or_default()
}

#[test]
fn what_is_counted_fits_together() {
    let ms = |ms: u64| Greatest::Time(ms * 1_000_000);
    let age = |counts: [u64; 3], greatest: Greatest| counted("within 100 ms", "age from a to b", counts, greatest);
    for (counts, greatest) in [([0, 0, 0], 0), ([5, 0, 0], 100), ([5, 0, 5], 101), ([5, 0, 1], 7000)] {
        assert_eq!(age(counts, ms(greatest)), "", "{counts:?}");
    }
    let of = "of age from a to b (within 100 ms)";
    assert_eq!(age([5, 0, 0], ms(5000)), format!("{of} no value is beyond, and the greatest is 5000 ms"));
    assert_eq!(age([5, 0, 1], ms(100)), format!("{of} some values are beyond, and the greatest is 100 ms"));
    assert_eq!(age([0, 0, 0], ms(1)), format!("{of} nothing was seen, and the greatest value is 1 ms"));
    assert_eq!(age([5, 1, 0], ms(9)), format!("{of} 1 value is below, and there is no least one"));
    assert_eq!(age([5, 0, 0], Greatest::Number(3)), format!("{of} the greatest value is no length of time"));
    let look = |counts: [u64; 3], greatest: Greatest| counted("3..9 ms", "look of camera", counts, greatest);
    for (counts, greatest) in [([5, 0, 0], 9), ([5, 4, 0], 3), ([5, 5, 0], 2), ([5, 2, 1], 10)] {
        assert_eq!(look(counts, ms(greatest)), "", "{counts:?}");
    }
    let of = "of look of camera (3..9 ms)";
    assert_eq!(look([5, 4, 0], ms(2)), format!("{of} 4 values are below, of 5, and the greatest is 2 ms"));
    assert_eq!(look([5, 5, 0], ms(8)), format!("{of} 5 values are below, of 5, and the greatest is 8 ms"));
    let missed = |counts: [u64; 3], greatest: Greatest| counted("1 of 20", "deadlines missed by a", counts, greatest);
    assert_eq!(missed([40, 0, 0], Greatest::Number(1)), "");
    assert_eq!(missed([40, 0, 2], Greatest::Number(2)), "");
    let of = "of deadlines missed by a (1 of 20)";
    assert_eq!(missed([40, 0, 0], Greatest::Number(2)), format!("{of} no value is beyond, and the greatest is 2"));
    assert_eq!(missed([40, 0, 0], ms(1)), format!("{of} the greatest value is a length of time"));
}
