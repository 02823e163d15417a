//! What is set in systems: the line that changes, and what is refused.

use syntax::ast::PhaseKind;

use super::*;

const SYSTEM: &str = "chart S\n\nsystem s \"S\" // a system\n\ttick 0.5 ms // short\n\tsensor eye\n\n\
    \tcomponent look \"Looking\" synchronous period 10 ms offset 1 ms // sees\n\
    \t\telaborate scan 1.5..2 ms // slow\n\t\twrite seen 0.5 ms\n\tendcomponent\n\
    \tcomponent act asynchronous awaits seen\n\t\tread seen as take\n\t\telaborate move by Arm\n\tendcomponent\n\
    \tchannel seen : Integer from look to act queue 4 // full\n\teye -> look\n\twithin 50 ms from eye to act\nendsystem\n";

fn after(operation: &Operation) -> Result<String, String> {
    let drawn = drawn(SYSTEM, "s", operation, &BTreeMap::new())?;
    let edits: Vec<Edit> = drawn.edit.into_iter().collect();
    Ok(crate::edited(SYSTEM, &edits))
}

/// The lines that differ.
#[track_caller]
fn check(operation: &Operation, expect: &[&str]) {
    let text = after(operation).expect("it can be done");
    let (old, new): (Vec<&str>, Vec<&str>) = (SYSTEM.lines().collect(), text.lines().collect());
    let gone = old.iter().filter(|line| !new.contains(line)).map(|line| format!("-{}", line.trim()));
    let come = new.iter().filter(|line| !old.contains(line)).map(|line| format!("+{}", line.trim()));
    let told: Vec<String> = gone.chain(come).collect();
    assert_eq!(told, expect, "{text}");
}

fn set(id: &str, property: Property, value: &str) -> Operation {
    Operation::Set(id.to_string(), property, Some(value.to_string()))
}

fn none(id: &str, property: Property) -> Operation {
    Operation::Set(id.to_string(), property, None)
}

#[test]
fn times_of_components() {
    let line = "-component look \"Looking\" synchronous period 10 ms offset 1 ms // sees";
    let look = |rest: &str| format!("+component look \"Looking\" {rest} // sees");
    let both = |operation: &Operation, rest: &str| check(operation, &[line, &look(rest)]);
    both(&set("look", Property::Period, " 20 ms "), "synchronous period 20 ms offset 1 ms");
    both(&set("look", Property::Deadline, "8 ms"), "synchronous period 10 ms offset 1 ms deadline 8 ms");
    both(&none("look", Property::Offset), "synchronous period 10 ms");
    both(&set("look", Property::Jitter, "0.2 ms"), "synchronous period 10 ms jitter 0.2 ms offset 1 ms");
    let jittered = SYSTEM.replace("offset 1 ms", "jitter 2 ms");
    for (property, value, expected) in [
        (Property::Jitter, Some("1 ms"), "period 10 ms jitter 1 ms //"),
        (Property::Jitter, None, "period 10 ms //"),
        (Property::Offset, Some("1 ms"), "period 10 ms jitter 2 ms offset 1 ms //"),
        (Property::Deadline, Some("8 ms"), "period 10 ms jitter 2 ms deadline 8 ms //"),
        (Property::Timing, Some("asynchronous"), "asynchronous //"),
    ] {
        let operation = Operation::Set("look".to_string(), property, value.map(str::to_string));
        let drawn = drawn(&jittered, "s", &operation, &BTreeMap::new()).unwrap_or_else(|reason| panic!("{reason}"));
        let text = crate::edited(&jittered, &drawn.edit.into_iter().collect::<Vec<_>>());
        assert!(text.contains(expected), "{text}");
    }
    assert!(after(&set("act", Property::Jitter, "1 ms")).is_err());
    both(&set("look", Property::Misses, "1 of 20"), "synchronous period 10 ms offset 1 ms misses 1 of 20");
    let weak = SYSTEM.replace("offset 1 ms", "offset 1 ms misses 2 of 9");
    let then = |operation: &Operation| {
        let drawn = drawn(&weak, "s", operation, &BTreeMap::new()).unwrap_or_else(|reason| panic!("{reason}"));
        crate::edited(&weak, &drawn.edit.into_iter().collect::<Vec<_>>())
    };
    assert_eq!(then(&none("look", Property::Misses)), SYSTEM);
    assert!(then(&set("look", Property::Misses, "1 of 5")).contains("offset 1 ms misses 1 of 5 //"));
    assert!(then(&set("look", Property::Deadline, "8 ms")).contains("offset 1 ms deadline 8 ms misses 2 of 9 //"));
    assert!(then(&set("look", Property::Timing, "asynchronous")).contains("asynchronous //"));
    both(&set("look", Property::Timing, "asynchronous"), "asynchronous");
    check(&set("look", Property::Timing, "synchronous"), &[]);
    let act = "-component act asynchronous awaits seen";
    check(&set("act", Property::Timing, "synchronous"), &[act, "+component act synchronous period 10 ms"]);
    assert!(after(&set("look", Property::Misses, "1 of")).is_err());
    assert!(after(&set("act", Property::Misses, "1 of 20")).is_err());
    assert!(after(&set("look", Property::PhaseFresh(0), "9 ms")).is_err());
    let take = ["-read seen as take", "+read seen as take every 9 ms fresh"];
    check(&set("act", Property::PhaseFresh(0), "9 ms"), &take);
    check(&none("act", Property::Awaits), &[act, "+component act asynchronous"]);
    check(&set("act", Property::Awaits, "other"), &[act, "+component act asynchronous awaits other"]);
    let several = "+component act asynchronous awaits all seen, other";
    check(&set("act", Property::Awaits, "all seen, other"), &[act, several]);
    assert!(
        after(&set("act", Property::Awaits, "any seen, other"))
            .is_ok_and(|text| text.contains("awaits any seen, other\n"))
    );
}

#[test]
fn phases() {
    let scan = "-elaborate scan 1.5..2 ms // slow";
    check(&set("look", Property::PhaseTime(0), "3 ms"), &[scan, "+elaborate scan 3 ms // slow"]);
    check(&none("look", Property::PhaseTime(0)), &[scan, "+elaborate scan // slow"]);
    check(&set("look", Property::PhaseName(0), "view"), &[scan, "+elaborate view 1.5..2 ms // slow"]);
    check(&set("look", Property::PhaseMachine(0), "Eye"), &[scan, "+elaborate scan 1.5..2 ms by Eye // slow"]);
    check(&none("act", Property::PhaseMachine(1)), &["-elaborate move by Arm", "+elaborate move"]);
    check(
        &set("act", Property::PhaseTime(1), "1..2 ms"),
        &["-elaborate move by Arm", "+elaborate move 1..2 ms by Arm"],
    );
    check(&set("act", Property::PhaseTime(0), "1 ms"), &["-read seen as take", "+read seen as take 1 ms"]);
    check(&none("act", Property::PhaseName(0)), &["-read seen as take", "+read seen"]);
    check(&set("look", Property::PhaseName(1), "put"), &["-write seen 0.5 ms", "+write seen as put 0.5 ms"]);
    check(&Operation::AddPhase("look".into(), PhaseKind::Elaborate, "rest".into()), &["+elaborate rest"]);
    check(&Operation::RemovePhase("look".into(), 0), &[scan]);
    let moved = after(&Operation::MovePhase("look".into(), 0, 1)).expect("moved");
    assert!(moved.contains("\t\twrite seen 0.5 ms\n\t\telaborate scan 1.5..2 ms // slow\n\tendcomponent"), "{moved}");
    assert_eq!(after(&Operation::MovePhase("look".into(), 0, 2)), Err("`look` has no phase 3".to_string()));
}

#[test]
fn channels_devices_and_the_system() {
    let line = "-channel seen : Integer from look to act queue 4 // full";
    let seen = |rest: &str| format!("+channel seen{rest} // full");
    let both = |operation: &Operation, rest: &str| check(operation, &[line, &seen(rest)]);
    both(&set("seen", Property::Kind, "swinging buffer"), " : Integer from look to act swinging buffer 2");
    both(&set("seen", Property::Kind, "shared value"), " : Integer from look to act shared value");
    both(&set("seen", Property::Size, "9"), " : Integer from look to act queue 9");
    both(&none("seen", Property::Domain), " from look to act queue 4");
    both(&set("seen", Property::Domain, "Seq(Integer)"), " : Seq(Integer) from look to act queue 4");
    check(&set("eye", Property::Domain, "Boolean"), &["-sensor eye", "+sensor eye : Boolean"]);
    check(&set("s", Property::Tick, "1 ms"), &["-tick 0.5 ms // short", "+tick 1 ms // short"]);
    check(&none("s", Property::Tick), &["-tick 0.5 ms // short"]);
    check(&set("s", Property::Processors, "2"), &["+processors 2"]);
    let within = "-within 50 ms from eye to act";
    check(&set("s", Property::Age(0), "60 ms"), &[within, "+within 60 ms from eye to act"]);
    check(&none("s", Property::Age(0)), &[within]);
    let more = Operation::AddAge { from: "eye".into(), to: "look".into(), limit: "9 ms".into() };
    check(&more, &["+within 9 ms from eye to look"]);
}

#[test]
fn readers_of_a_channel() {
    let arrow = |from: &str, to: &str| Joint { from: from.into(), branch: None, to: to.into() };
    let several =
        SYSTEM.replace("\n\tchannel", "\n\tcomponent log asynchronous\n\t\telaborate note\n\tendcomponent\n\tchannel");
    let done = |text: &str, operation: &Operation| {
        let drawn = drawn(text, "s", operation, &BTreeMap::new())?;
        Ok::<String, String>(crate::edited(text, &drawn.edit.into_iter().collect::<Vec<_>>()))
    };
    let two = done(&several, &Operation::Connect(arrow("seen", "log"))).expect("one more reader");
    assert_eq!(
        two,
        several.replace("to act queue", "to act, log queue").replace("elaborate note", "read seen\n\t\telaborate note")
    );
    assert_eq!(done(&two, &Operation::Connect(arrow("seen", "log"))).as_deref(), Ok(two.as_str()));
    assert_eq!(done(&two, &Operation::Disconnect(arrow("seen", "log"))).as_deref(), Ok(several.as_str()));
    let told = done(&several, &Operation::Disconnect(arrow("seen", "act"))).expect_err("the only reader");
    assert_eq!(told, "`seen` has one reader: delete the channel instead");
    assert_eq!(
        done(&two, &Operation::Connect(arrow("seen", "eye"))),
        Err("the readers of the channel `seen` are components".into())
    );
    assert_eq!(done(&two, &Operation::Connect(arrow("seen", "look"))), Err("`look` writes the channel `seen`".into()));
    // A component that goes takes itself out of the readers, and what it was the master of.
    let mastered = two.replace("queue 4", "swinging buffer 2 master log");
    let gone = done(&mastered, &Operation::Delete(vec!["log".into()])).expect("it can go");
    assert!(gone.contains("channel seen : Integer from look to act swinging buffer 2 // full\n"), "{gone}");
    assert!(gone.contains("read seen as take") && !gone.contains("log"), "{gone}");
    let gone = done(&two, &Operation::Delete(vec!["look".into()])).expect("it can go");
    assert!(!gone.contains("channel"), "{gone}");
}

#[test]
fn what_is_no_value_is_refused() {
    let told = |operation: &Operation| after(operation).expect_err("it is refused");
    for value in [
        "10",
        "ms",
        "-1 ms",
        "1 m",
        "1..2 ms",
        "1 ms offset 2 ms",
        "1 ms // x",
        "1 ms\nendcomponent",
        "1 ms /* x */",
        "1 min",
    ] {
        let said = told(&set("look", Property::Period, value));
        assert!(said.starts_with(&format!("`{}` is no time", value.trim())), "{value}: {said}");
    }
    assert_eq!(told(&none("look", Property::Period)), "a synchronous component has a period");
    assert_eq!(told(&set("act", Property::Period, "1 ms")), "an asynchronous component has no period");
    assert_eq!(told(&set("look", Property::Awaits, "seen")), "only an asynchronous component awaits data");
    assert_eq!(told(&set("seen", Property::Master, "look")), "only a swinging buffer has a master");
    assert_eq!(told(&set("seen", Property::Size, "2 master look")), "`2 master look` is no whole number");
    assert_eq!(told(&set("seen", Property::Domain, "Integer from a")), "`Integer from a` is no domain");
    assert_eq!(told(&set("look", Property::PhaseMachine(1), "M")), "only an elaboration is done by a machine");
    assert!(told(&set("act", Property::Awaits, "a b")).starts_with("`a b` names no channels"));
    assert!(told(&set("act", Property::Awaits, "all seen,")).starts_with("`all seen,` names no channels"));
    assert!(told(&set("act", Property::Awaits, "seen read other")).starts_with("`seen read other` names no channels"));
    // A word of charts may be a name; where it would be read as that word, it is refused.
    assert!(after(&set("act", Property::Awaits, "state")).is_ok_and(|text| text.contains("awaits state\n")));
    for word in ["endcomponent", "endsystem"] {
        let _ = told(&set("act", Property::Awaits, word));
        let _ = told(&Operation::AddPhase("act".into(), PhaseKind::Elaborate, word.into()));
    }
    assert_eq!(told(&set("none", Property::Period, "1 ms")), "there is no component `none`");
    assert_eq!(told(&set("look", Property::Size, "1")), "there is no channel `look`");
}
