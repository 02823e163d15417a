//! Files written here, byte by byte, with the damage that a program's file may have.

use super::*;

fn text(text: &str) -> Vec<u8> {
    [&(text.len() as u32).to_le_bytes()[..], text.as_bytes()].concat()
}

fn record(code: u8, content: &[u8]) -> Vec<u8> {
    [&[code][..], &(content.len() as u64).to_le_bytes(), content].concat()
}

fn about(name: &str, pairs: &[(&str, &str)]) -> Vec<u8> {
    let map: String =
        pairs.iter().map(|(key, value)| String::from_utf8([text(key), text(value)].concat()).expect("text")).collect();
    record(0x0c, &[text(name), text(&map)].concat())
}

fn channel(id: u16, topic: &str) -> Vec<u8> {
    record(0x04, &[&id.to_le_bytes()[..], &[0; 2], &text(topic), &text("json"), &[0; 4]].concat())
}

fn event(channel: u16, order: u32, time_ns: i64) -> Vec<u8> {
    let fields = format!("{{\"order\":{order},\"kind\":\"begins\",\"object\":\"p\",\"number\":1}}");
    let head = [&channel.to_le_bytes()[..], &[0; 4], &time_ns.to_le_bytes(), &[0; 8]].concat();
    record(0x05, &[&head[..], fields.as_bytes()].concat())
}

fn chunk(inner: &[u8]) -> Vec<u8> {
    let length = (inner.len() as u64).to_le_bytes();
    let sum = Checksum::of(inner).to_le_bytes();
    record(0x06, &[&[0; 24][..], &sum, &text(""), &length, inner].concat())
}

fn head() -> Vec<u8> {
    [MAGIC, &about("groundstate", &[("tick_ns", "1000"), ("pace", "real")])].concat()
}

/// What follows the data: the end with their checksum, a summary, the footer with its own checksum.
fn ended(data: Vec<u8>) -> Vec<u8> {
    let sum = Checksum::of(&data).to_le_bytes();
    let summary = channel(0, "/task");
    let footer = record(0x02, &[0; 20]);
    let own = Checksum::of(&[&summary, &footer[..FOOTER]].concat()).to_le_bytes();
    [data, record(0x0f, &sum), summary, footer[..FOOTER].to_vec(), own.to_vec(), MAGIC.to_vec()].concat()
}

/// The end of a run that was stopped at 7 ns and lost nothing.
fn end(more: &[(&str, &str)]) -> Vec<u8> {
    about("end", &[&[("stopped_ns", "7"), ("lost", "0")], more].concat())
}

/// Two events of a task, of a run that was stopped and has its end.
fn whole() -> Vec<u8> {
    let data = [
        head(),
        channel(0, "/task"),
        chunk(&[event(0, 0, 5), event(0, 1, 9)].concat()),
        about("stop", &[("stopped_ns", "7")]),
        end(&[("events task", "2")]),
    ];
    ended(data.concat())
}

#[track_caller]
fn refused(bytes: &[u8], expect: &str) {
    assert_eq!(Recording::read(bytes), Err(Malformed(expect.to_string())));
}

#[test]
fn what_is_no_recording_is_told() {
    refused(b"", "it is no MCAP file");
    refused(MAGIC, "it is not the recording of a generated program");
    refused(b"\x89MCAP0\r\n\x05\x02\x00\x00\x00\x00\x00\x00\x00\x00\x00", "a record is shorter than it says");
}

#[test]
fn pieces_of_any_size_say_what_the_whole_says() {
    let whole = whole();
    let read = Recording::read(&whole).expect("a recording");
    assert_eq!((read.tracks[0].events.len(), read.stopped_ns, read.is_whole()), (2, Some(7), true));
    for size in [1, 7, 64] {
        let mut reader = Reader::default();
        for piece in whole.chunks(size) {
            assert!(!reader.recording().is_whole() || reader.recording() == &read);
            reader.feed(piece).expect("a piece");
        }
        assert!(reader.has_ended());
        assert_eq!(reader.finish().as_ref(), Ok(&read));
    }
}

/// They count in the order of a task's events, and stand apart from them.
#[test]
fn decisions_are_read() {
    let said = |order: u32, rest: &str| {
        let text = format!(r#"{{"order":{order},{rest}}}"#);
        record(
            0x05,
            &[
                &0_u16.to_le_bytes()[..],
                &order.to_le_bytes(),
                &5_u64.to_le_bytes(),
                &5_u64.to_le_bytes(),
                text.as_bytes(),
            ]
            .concat(),
        )
    };
    // What is left out is not taken for 0 or for false.
    for lacking in [
        r#""kind":"gets","object":"codes","known":true,"fresh":true"#,
        r#""kind":"gets","object":"codes","number":7,"fresh":true"#,
        r#""kind":"gets","object":"codes","number":7,"known":true"#,
        r#""kind":"decides","object":"lamp","known":true"#,
        r#""kind":"decides","object":"lamp","number":0"#,
        r#""kind":"takes","object":"codes""#,
    ] {
        let events = [event(0, 0, 5), said(1, lacking)];
        let refused = Recording::read(&[head(), channel(0, "/task"), chunk(&events.concat())].concat());
        assert!(refused.is_err_and(|refused| refused.0.contains("a message is no event")), "{lacking}");
    }
    let events = [
        event(0, 0, 5),
        said(1, r#""kind":"gets","object":"codes","number":7,"known":true,"fresh":true"#),
        said(2, r#""kind":"decides","object":"orders","number":18446744073709551615,"known":true"#),
        said(3, r#""kind":"decides","object":"lamp","number":0,"known":false"#),
        event(0, 4, 6),
    ];
    let read = Recording::read(&[head(), channel(0, "/task"), chunk(&events.concat())].concat()).expect("a recording");
    let track = &read.tracks[0];
    assert_eq!((track.events.len(), track.decisions.len(), track.lost), (2, 3, false));
    let shown: Vec<_> =
        track.decisions.iter().map(|one| (one.is_got, &*one.object, one.bits, one.known, one.fresh)).collect();
    assert_eq!(
        shown,
        [(true, "codes", 7, true, true), (false, "orders", u64::MAX, true, false), (false, "lamp", 0, false, false)]
    );
}

/// Damage anywhere in a file is reported, or the file counts as one without an end.
#[test]
fn a_changed_byte_is_noticed() {
    let whole = whole();
    let read = Recording::read(&whole).expect("a recording");
    let behind = whole.len() - ended(Vec::new()).len();
    for at in 0..whole.len() {
        for mask in [0x01, 0x80, 0xff] {
            let mut damaged = whole.clone();
            damaged[at] ^= mask;
            let found = Recording::read(&damaged);
            assert!(
                found.as_ref().map_or(true, |found| !found.is_whole() || *found == read && at >= behind),
                "byte {at}: {found:?}"
            );
        }
    }
}

/// Wherever a file is cut: within the data, the summary that says all again, or the last bytes.
#[test]
fn a_file_that_is_cut_has_no_end() {
    let whole = whole();
    for length in MAGIC.len() + 9..whole.len() {
        let mut reader = Reader::default();
        reader.feed(&whole[..length]).expect("a beginning");
        assert!(!reader.has_ended() && !reader.recording().is_whole(), "{length} bytes");
        assert!(reader.finish().is_ok_and(|cut| !cut.is_whole()) || length < head().len(), "{length} bytes");
    }
    refused(&[&whole[..], &whole].concat(), "something follows the end of the file");
}

#[test]
fn a_gap_in_the_order_ends_a_track() {
    let events: Vec<u8> = [0, 1, 3, 4].into_iter().flat_map(|order| event(0, order, 5)).collect();
    let read = Recording::read(&[head(), channel(0, "/task"), chunk(&events)].concat()).expect("a recording");
    assert_eq!((read.tracks[0].events.len(), read.tracks[0].lost), (2, true));
    assert!(!read.is_whole());
}

#[test]
fn events_that_are_out_of_order_are_no_gap() {
    let check = |orders: &[u32], expect: &str| {
        let events: Vec<u8> = orders.iter().flat_map(|order| event(0, *order, 5)).collect();
        refused(&[head(), channel(0, "/task"), chunk(&events)].concat(), expect);
    };
    check(&[0, 2, 1, 3], "the events of task are out of order: 1 comes after 2");
    check(&[1, 0], "the events of task are out of order: 0 comes after 1");
    check(&[0, 1, 1, 2], "event 1 of task is there twice");
    check(&[0, 5, 3], "the events of task are out of order: 3 comes after 5");
}

#[test]
fn what_the_program_lost_is_lost() {
    let read = |lost: &[(&str, &str)]| {
        let end = about("end", &[&[("stopped_ns", "7"), ("events task", "1")], lost].concat());
        Recording::read(&ended([head(), channel(1, "/task"), event(1, 0, 5), end].concat()))
    };
    for (lost, is_whole) in [("0", true), ("5", false)] {
        assert_eq!(read(&[("lost", lost)]).expect("it can be read").is_whole(), is_whole, "{lost}");
    }
    let words = "its end does not say in a number how many events were lost";
    for wrong in [&[][..], &[("lost", "?")], &[("lost", "-1")], &[("lost", "")]] {
        assert_eq!(read(wrong), Err(Malformed(words.to_string())), "{wrong:?}");
    }
}

#[test]
fn the_end_counts_the_events_of_each_task() {
    let read = |events: &[(&str, &str)]| {
        let all = [event(1, 0, 5), event(1, 1, 6), end(events)].concat();
        Recording::read(&ended([head(), channel(1, "/task"), all].concat()))
    };
    assert!(read(&[("events task", "2")]).expect("all are there").is_whole());
    assert!(!read(&[("events task", "3")]).expect("the last one is missing").is_whole());
    let fewer = "its end contradicts what comes before: task had 1 events, and event 1 of it, counted from 0, is there";
    assert_eq!(read(&[("events task", "1")]), Err(Malformed(fewer.to_string())));
    let none = "its end does not say in a number how many events task had";
    for wrong in [&[][..], &[("events task", "x")], &[("events other", "2")]] {
        assert_eq!(read(wrong), Err(Malformed(none.to_string())), "{wrong:?}");
    }
}

#[test]
fn a_run_that_ended_early_says_why() {
    let check = |more: &[(&str, &str)], expect: Option<&str>| {
        let end = end(&[&[("events task", "1")], more].concat());
        let read = Recording::read(&ended([head(), channel(1, "/task"), event(1, 0, 5), end].concat()));
        assert_eq!(read.expect("it can be read").failure.as_deref(), expect);
    };
    check(&[("outcome", "ended")], None);
    let told = [("outcome", "hung"), ("task", "task"), ("cycle", "98"), ("reason", "no progress for 200 ms")];
    check(&told, Some("task task hung in cycle 98: no progress for 200 ms"));
    check(&[("outcome", "faulted"), ("task", "task"), ("cycle", "3")], Some("task task failed in cycle 3"));
    for outcome in [&[][..], &[("outcome", "fine")]] {
        check(outcome, Some("the recording does not say that the run ended well"));
    }
}

#[test]
fn what_wakes_a_task() {
    let read = |text: &str| Awaited::read(text).map(|awaits| (awaits.to_string(), awaits.channels.len(), awaits.all));
    assert_eq!(read("frames"), Some(("frames".to_string(), 1, true)));
    assert_eq!(read("all"), Some(("all".to_string(), 1, true)));
    assert_eq!(read("all frames, poses"), Some(("all frames, poses".to_string(), 2, true)));
    assert_eq!(read("any frames,poses, all"), Some(("any frames, poses, all".to_string(), 3, false)));
    for wrong in
        ["", "all ", "any frames", "frames, poses", "some frames, poses", "all frames,, poses", "all frames, x y"]
    {
        assert_eq!(read(wrong), None, "{wrong}");
    }
    let head = about("groundstate", &[("tick_ns", "1000"), ("pace", "real"), ("awaits task", "frames, poses")]);
    let said = "it does not say in names of channels what task awaits";
    assert_eq!(Recording::read(&[MAGIC, &head, &channel(0, "/task")].concat()), Err(Malformed(said.to_string())));
}

#[test]
fn the_head_speaks_of_tasks_before_it_and_behind_it() {
    let stated = [("tick_ns", "1000"), ("pace", "real"), ("awaits other", "frames")];
    let times = [("period_ns task", "7000"), ("offset_ns task", "0"), ("deadline_ns task", "5000")];
    let head = about("groundstate", &[&stated[..], &times].concat());
    let before = Recording::read(&[MAGIC, &head, &channel(0, "/task"), &channel(1, "/other")].concat());
    let behind = Recording::read(&[MAGIC, &channel(0, "/task"), &channel(1, "/other"), &head].concat());
    let read = before.expect("a recording");
    assert_eq!(behind, Ok(read.clone()));
    let rhythm = Rhythm { period_ns: 7000, offset_ns: 0, deadline_ns: 5000 };
    assert_eq!((read.tracks[0].rhythm, read.tracks[1].awaits.clone()), (Some(rhythm), Awaited::read("frames")));
    let said = "it does not say the period, offset and deadline of task in numbers";
    for wrong in
        [&times[..1], &[times[0], times[1], ("deadline_ns task", "x")], &[("period_ns task", "0"), times[1], times[2]]]
    {
        let head = about("groundstate", &[&stated[..], wrong].concat());
        refused(&[MAGIC, &head, &channel(0, "/task")].concat(), said);
    }
}

#[test]
fn time_goes_on_from_the_beginning() {
    let check = |times: [i64; 2], expect: &str| {
        let events = [event(0, 0, times[0]), event(0, 1, times[1])].concat();
        refused(&ended([head(), channel(0, "/task"), chunk(&events)].concat()), expect);
    };
    check(
        [2_000_000, 1_500_000],
        "time goes back: event 1 of task (begins p, cycle 1) is at 1.5000 ms, the event before it at 2.0000 ms",
    );
    check(
        [-4_560_000, 1],
        "time goes back: event 0 of task (begins p, cycle 1) is at -4.5600 ms, before the run began",
    );
}

#[test]
fn what_is_said_twice_is_said_once() {
    let again = [head(), channel(0, "/task"), channel(0, "/task")].concat();
    assert_eq!(Recording::read(&again).expect("a recording").tracks.len(), 1);
    let check = |more: &[Vec<u8>], expect: &str| refused(&[&head()[..], &more.concat()].concat(), expect);
    check(&[channel(0, "/task"), channel(1, "/task")], "two channels have the name task");
    check(&[channel(0, "/task"), channel(0, "/other")], "one channel is both task and other");
    check(&[head()[MAGIC.len()..].to_vec()], "it has two heads");
    let end = || end(&[("events task", "0")]);
    check(&[end(), end()], "it has two ends");
    let two = "it does not say when the tasks were asked to stop, or says it in two ways";
    check(&[about("stop", &[("stopped_ns", "8")]), end()], two);
    check(&[about("stop", &[("stopped_ns", "-8")])], two);
    check(&[channel(0, "/task"), end(), event(0, 0, 1)], "an event comes behind the end of the run");
}

#[test]
fn decisions_stand_among_the_events() {
    let decides = |order: u32, time_ns: i64| {
        let fields =
            format!("{{\"order\":{order},\"kind\":\"decides\",\"object\":\"jaw\",\"number\":1,\"known\":true}}");
        record(0x05, &[&[0, 0, 0, 0, 0, 0][..], &time_ns.to_le_bytes(), &[0; 8], fields.as_bytes()].concat())
    };
    let check = |events: &[Vec<u8>], expect: &str| {
        refused(&ended([head(), channel(0, "/task"), chunk(&events.concat())].concat()), expect);
    };
    check(
        &[event(0, 0, 1_000_000), decides(1, 500_000)],
        "time goes back: what task decides jaw is at 0.5000 ms, the event before it at 1.0000 ms",
    );
    check(
        &[event(0, 0, 1_000_000), decides(1, 3_000_000), event(0, 2, 2_000_000)],
        "time goes back: event 1 of task (begins p, cycle 1) is at 2.0000 ms, the event before it at 3.0000 ms",
    );
    check(&[decides(0, -1_000_000)], "time goes back: what task decides jaw is at -1.0000 ms, before the run began");
    let fine = [decides(0, 1), decides(1, 1), event(0, 2, 1), decides(3, 2), decides(4, 5), event(0, 5, 5)].concat();
    let fine = Recording::read(&ended([head(), channel(0, "/task"), chunk(&fine)].concat())).expect("time goes on");
    assert_eq!((fine.tracks[0].events.len(), fine.tracks[0].decisions.len(), fine.tracks[0].lost), (2, 4, false));
}

#[test]
fn what_was_counted_of_a_bound_is_whole() {
    let counted = [
        ("bound 0", "a"),
        ("limit 0", "3 ms"),
        ("seen 0", "5"),
        ("below 0", "0"),
        ("beyond 0", "2"),
        ("greatest_ns 0", "7"),
    ];
    let read_of = |outcome: &str, counted: &[(&str, &str)]| {
        let end = end(&[&[("events task", "0"), ("outcome", outcome)], counted].concat());
        Recording::read(&ended([head(), channel(0, "/task"), end].concat()))
    };
    let read = |counted: &[(&str, &str)]| read_of("ended", counted);
    assert_eq!(read(&counted).expect("whole").bounds[0].outside(), 2);
    for index in 0..counted.len() {
        let missing: Vec<_> =
            counted.iter().enumerate().filter(|(at, _)| *at != index).map(|(_, pair)| *pair).collect();
        let words = "it does not say whole and in numbers what was counted of bound 0";
        assert_eq!(read(&missing), Err(Malformed(words.to_string())), "without {}", counted[index].0);
        let mut damaged = counted;
        damaged[index].1 = "-1";
        assert_eq!(read(&damaged).is_err(), index > 1, "{}", counted[index].0);
    }
    // More were outside than were seen.
    for (below, beyond) in [("0", "6"), ("6", "0"), ("3", "3")] {
        let mut more = counted;
        (more[3].1, more[4].1) = (below, beyond);
        let words = format!(
            "its end contradicts itself: of a it counts {below} values below the bound and {beyond} beyond it, and saw 5"
        );
        assert_eq!(read(&more), Err(Malformed(words)));
        // What a task counts that hangs may be read while it counts.
        assert!(read_of("hung", &more).is_ok());
    }
}
