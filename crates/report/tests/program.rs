//! The page of a program's runs: well-formed and self-contained whatever the names are, its figures those of the events.

use recording::{Event, Kind, Recording, Rhythm, Track};
use report::{
    ClosedLoop, Fact, Held, Joint, Program, ProgramRun, RunSummary, Tally, View, render_program, summarise_program,
};

/// A page without what is raw text in HTML, which must parse as XML.
fn as_xml(page: &str) -> String {
    let mut out = String::new();
    let mut rest = page.strip_prefix("<!DOCTYPE html>").expect("the doctype");
    while let Some(at) = rest.find("<style").into_iter().chain(rest.find("<script")).min() {
        let close = if rest[at..].starts_with("<style") { "</style>" } else { "</script>" };
        let (_, after) = rest[at..].split_once(close).expect("its end");
        out.push_str(&rest[..at]);
        rest = after;
    }
    out + rest
}

/// A producer every 10 ms and the task that its data wake, `late_us` after; six cycles, the last one of the producer late.
fn recording(name: &str, late_us: i64) -> Recording {
    const US: i64 = 1_000;
    let event = |time_us: i64, kind: &str, object: &str, number: u64| Event {
        time_ns: time_us * US,
        kind: Kind::of(kind).expect("a kind"),
        object: format!("{object}{name}").into(),
        number,
        ..Event::default()
    };
    let (mut made, mut used) = (Vec::new(), Vec::new());
    for cycle in 0..6 {
        let due = cycle as i64 * 10_000 + late_us;
        made.extend([
            event(due, "begins", "grab", cycle),
            event(due + 6_000, "ends", "grab", cycle),
            event(due + 6_000, "begins", "write", cycle),
            event(due + 6_000, "asks", "frames", 0),
            event(due + 6_100, "enters", "frames", 0),
            event(due + 6_100, "writes", "frames", cycle + 1),
            event(due + 6_200, "releases", "frames", 0),
            event(due + 6_200, "ends", "write", cycle),
            event(due + 6_200, if cycle == 5 { "misses" } else { "meets" }, "camera", cycle),
        ]);
        used.extend([
            event(due + 6_250, "begins", "look", cycle),
            event(due + 6_250, "reads", "frames", cycle + 1),
            event(due + 7_250, "ends", "look", cycle),
        ]);
    }
    let rhythm = Some(Rhythm { period_ns: 10_000 * US, offset_ns: 0, deadline_ns: 10_000 * US });
    let track = |task: &str, rhythm, awaits, events| Track {
        task: format!("{task}{name}"),
        rhythm,
        awaits,
        events,
        ..Track::default()
    };
    Recording {
        tracks: vec![
            track("camera", rhythm, None, made),
            track("servo", None, recording::Awaited::read(&format!("frames{name}")), used),
        ],
        system: name.into(),
        tick_ns: 100 * US,
        stopped_ns: Some(60_000 * US),
        ..Recording::default()
    }
}

fn program(name: &str) -> Program {
    let mut ages = Tally::default();
    [12_000_000, 13_000_000, 40_000_000].into_iter().for_each(|ns| ages.add(ns, 0));
    let world = ClosedLoop {
        end: name.into(),
        reached: Some(true),
        image: (640.0, 480.0),
        goals_s: vec![0.0, 0.03],
        bound: Some(0.005),
        error: (0..60).map(|ms| (f64::from(ms) / 1e3, (ms != 7).then(|| 0.5 / f64::from(1 + ms)))).collect(),
        views: vec![View { png: b"\x89PNG\r\n\x1a\n".to_vec(), caption: name.into() }],
        joints: vec![Joint {
            name: name.into(),
            set: vec![(0.0, 1.0), (0.06, 1.5)],
            measured: vec![(0.0, 1.0), (0.06, 1.4)],
        }],
        image_ages: vec![(name.into(), ages)],
    };
    let mut first = ProgramRun::of(format!("virtual{name}"), &recording(name, 0));
    first.verdict = Some(Held { conforms: Some(true), words: name.into(), beside: vec![format!("beside {name}")] });
    first.closed_loop = Some(world);
    let mut second = ProgramRun::of(format!("real{name}"), &recording(name, 70));
    second.verdict = Some(Held { conforms: Some(false), words: format!("parts {name}"), beside: Vec::new() });
    Program {
        title: name.into(),
        note: name.into(),
        model: name.into(),
        runs: vec![first, second],
        facts: vec![Fact { label: name.into(), value: name.into() }],
    }
}

#[test]
fn figures_are_those_of_the_events() {
    let program = program("");
    let [virtually, really] = program.runs.as_slice() else { panic!("two runs") };
    let camera = &really.tasks[0];
    assert_eq!((camera.activations, camera.met, camera.missed, camera.skips), (6, Some(5), Some(1), 0));
    assert_eq!((camera.wake_ups.percentile(50), camera.responses.percentile(99)), (Some(70_000), Some(6_270_000)));
    assert_eq!(virtually.tasks[0].wake_ups.greatest(), Some((0, 0)));
    // Woken by the data, whenever the camera was.
    assert_eq!((really.tasks[1].wake_ups.percentile(99), really.tasks[1].responses.count()), (Some(50_000), 6));
    let channel = &really.channels[0];
    assert_eq!(
        (channel.from.as_str(), channel.to.as_str(), channel.ages.percentile(50)),
        ("camera", "servo", Some(150_000))
    );
    assert_eq!(program.troubles(), ["real: parts "]);
}

#[test]
fn the_page_shows_them() {
    let page = render_program(&program(""));
    for section in ["views", "error", "joints", "timeline", "wake-ups", "ages", "deadlines", "facts"] {
        assert!(page.contains(&format!("<section id=\"{section}\"")), "{section}");
    }
    assert!(page.contains("data:image/png;base64,iVBORw0KGgo=\""));
    // Period, activations, missed, skipped, response and wake-up latency of the camera in real time.
    let row = "<td>10\u{202f}ms</td><td>6</td><td class=\"bad\">1</td><td>0</td><td>6.27\u{202f}ms</td><td>6.27\u{202f}ms</td>\
               <td>70\u{202f}µs</td><td>70\u{202f}µs</td>";
    assert!(page.contains(row));
    let text = summarise_program(&program(""), &RunSummary::default());
    let rows: Vec<Vec<&str>> = text.lines().map(|line| line.split_whitespace().collect()).collect();
    let camera = ["camera", "10", "ms", "6", "1", "0", "6.27", "ms", "6.27", "ms", "70", "µs", "70", "µs"];
    assert!(rows.iter().any(|row| row == &camera), "{text}");
}

#[test]
fn names_stay_names() {
    let page = render_program(&program("</script><img src=x onerror=alert(1)> & \"quoted\" \u{1}"));
    let document = as_xml(&page);
    let document = roxmltree::Document::parse(&document).expect("well-formed");
    let images: Vec<_> = document.descendants().filter(|node| node.has_tag_name("img")).collect();
    assert!(images.len() == 1 && images[0].attribute("onerror").is_none());
    assert_eq!(page.matches("<script").count(), 2, "data and script, nothing else");
    for word in ["http://", "https://", "@import", "fetch(", "XMLHttpRequest", "import("] {
        assert_eq!(page.matches(word).count(), 0, "{word}");
    }
    let mut ids = Vec::new();
    for id in document.descendants().filter_map(|node| node.attribute("id")) {
        assert!(!ids.contains(&id), "id {id} twice");
        ids.push(id);
    }
    for drawing in document.descendants().filter(|node| node.has_tag_name("svg")) {
        let titled = drawing.children().any(|child| child.has_tag_name("title"));
        assert!(titled && drawing.attribute("role") == Some("img"), "{:?}", drawing.attribute("class"));
    }
}

#[test]
fn a_run_without_a_world_has_a_page_too() {
    let mut program = program("");
    program.runs.iter_mut().for_each(|run| run.closed_loop = None);
    let page = render_program(&program);
    assert!(!page.contains("id=\"views\"") && page.contains("id=\"deadlines\""));
    let empty = ProgramRun::of("virtual time", &Recording::default());
    program.runs = vec![empty];
    let page = render_program(&program);
    for section in ["timeline", "wake-ups", "ages", "deadlines"] {
        assert!(!page.contains(&format!("id=\"{section}\"")), "{section} shows nothing");
    }
}

#[test]
fn a_section_is_there_where_it_shows_something() {
    // All latencies are the same, and all ages; one run needs no key.
    let mut program = program("");
    program.runs.truncate(1);
    program.runs[0].closed_loop = None;
    let page = render_program(&program);
    assert!(page.contains("<p>wake-up latency always 50\u{202f}µs</p>"), "{page}");
    assert!(page.contains("<p>age when read always 150\u{202f}µs</p>"), "{page}");
    assert!(!page.contains("class=\"distribution\"") && !page.contains("class=\"swatch0\""));
    // Nobody is ever late.
    program.runs[0].tasks.retain(|task| task.name == "camera");
    assert!(!render_program(&program).contains("id=\"wake-ups\""));
}

#[test]
fn a_stored_value_is_written_and_a_loaded_one_read() {
    let event = |time_us: i64, kind: &str, object: &str| Event {
        time_ns: time_us * 1_000,
        kind: Kind::of(kind).expect("a kind"),
        object: object.into(),
        ..Event::default()
    };
    let track = |task: &str, kind: &str, phase: &str| Track {
        task: task.into(),
        events: vec![event(100, "begins", phase), event(200, kind, "goal"), event(400, "ends", phase)],
        ..Track::default()
    };
    let recording = Recording {
        tracks: vec![track("operator", "stores", "tell"), track("arm", "loads", "look"), track("desk", "sends", "ask")],
        system: "cell".into(),
        tick_ns: 100_000,
        stopped_ns: Some(1_000_000),
        ..Recording::default()
    };
    let run = ProgramRun::of("virtual time", &recording);
    let label = |task: usize| {
        let track = &run.lanes.tasks[task].track;
        track.spans().iter().map(|span| track.kind(*span).label.as_str()).collect::<Vec<_>>()
    };
    assert_eq!((label(0), label(1), label(2)), (vec!["writing"], vec!["reading"], vec!["passing a message"]));
}
