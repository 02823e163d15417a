//! Operations as jobs: the results of a review, a report, generated C++ and a comparison, and that they end when
//! cancelled.

use std::sync::Arc;

use groundstate::conform::{Recording, Track, Verdict};
use groundstate::job::{
    self, Cancel, ConformRequest, Events, Folder, GenerateJob, NoTail, NotConformed, NotGenerated, Piece,
    ReviewRequest, RunEvent, RunRequest, Tail, TestsRequest,
};
use groundstate::reporting::{Prepared, prepare_report};
use groundstate::test_generation::Method;
use groundstate::verify::review::{Meta, MetaOutcome};
use groundstate::verify::{NoStart, Options, Stop};
use groundstate::workspace::{Absent, Files};
use groundstate::{Loaded, load};
use machine::Limits;
use syntax::SourceFile;

const TOGGLE: &str = "asm Toggle\nimport StandardLibrary\nsignature:\n\tcontrolled on: Boolean\n\tcontrolled idle: Boolean\n\
                      definitions:\n\tmain rule r_Main = on := not on\ndefault init s0:\n\tfunction on = false\n\
                      \tfunction idle = true\n";

struct NoFiles;

impl model::Loader for NoFiles {
    fn load(&mut self, _: &SourceFile, path: &str) -> Result<SourceFile, String> {
        Err(format!("there is no {path}"))
    }
}

impl Files for NoFiles {
    fn read(&mut self, _: &str) -> Result<SourceFile, Absent> {
        Err(Absent::Missing)
    }
}

fn toggle() -> Loaded {
    let loaded = load(SourceFile::new("Toggle.asm", TOGGLE), &mut NoFiles);
    loaded.unwrap_or_else(|faulty| panic!("{:?}", faulty.diagnostics))
}

fn cancelled() -> Cancel {
    let cancel = Cancel::new();
    cancel.cancel();
    cancel
}

#[test]
fn a_review() {
    let request = |loaded: &Loaded| ReviewRequest {
        model: Arc::clone(&loaded.model),
        program: Arc::clone(&loaded.program),
        options: Options::default(),
        metas: Meta::ALL.to_vec(),
        files: [loaded.model.root].into(),
    };
    let loaded = toggle();
    let job = job::review(request(&loaded), Cancel::new()).expect("a thread");
    let review = job.finish().expect("no panic").expect("there is an initial state");
    let violated = review.outcomes.iter().filter(|(_, outcome)| *outcome == MetaOutcome::Violated).count();
    // Nothing reads or updates `idle`, and it is never false.
    assert_eq!((violated, review.findings.len()), (2, 3), "{:?}", review.findings);
    let job = job::review(request(&loaded), cancelled()).expect("a thread");
    assert_eq!(job.finish().expect("no panic").err(), Some(NoStart::Stopped(Stop::Asked)));
}

#[test]
fn a_report() {
    let loaded = toggle();
    let mut asked = loaded.overlay();
    let wanted = SourceFile::new("Toggle.report.yaml", "series: { Light: { value: if on then 1 else 0 endif } }\n");
    let prepared =
        prepare_report(&mut asked, wanted, "Toggle.report.yaml", &mut NoFiles, &groundstate::chart::NoPictures)
            .expect("no chart");
    let Prepared { reporter: Some(reporter), .. } = prepared else { panic!("{:?}", prepared.faults) };
    let request = RunRequest {
        program: Arc::clone(&asked.program),
        limits: Limits::default(),
        options: groundstate::simulate::Options { steps: Some(5_000), keep: false, ..Default::default() },
        inputs: Box::new(|inputs| inputs),
        asks_inputs: None,
        asks_choices: false,
        paused: false,
        states: false,
        frozen: false,
        due: job::at_once(),
    };
    let (job, _remote) = job::report(request, reporter, asked.sources, Cancel::new()).expect("a thread");
    let (mut told, mut last) = (0, 0);
    while let Some(event) = job.next_event() {
        match event {
            RunEvent::Record { steps, .. } => (told, last) = (told + 1, steps),
            RunEvent::Progress(steps) => assert!((last..=5_000).contains(&steps)),
            other => panic!("{other:?}"),
        }
    }
    // The initial state and the end are reported; nothing is wrong in between.
    assert_eq!((told, last), (2, 5_000));
    let report = job.finish().expect("no panic").finish();
    assert_eq!((report.steps(), report.stopped), (5_000, None));
}

#[test]
fn tests_of_a_model() {
    let generate = |cancel| {
        let loaded = toggle();
        let request = TestsRequest {
            files: [loaded.model.root].into(),
            model: loaded.model,
            program: loaded.program,
            path: "Toggle.asm".to_string(),
            options: Options::default(),
            method: Method::Search,
        };
        job::generate_tests(request, cancel).expect("a thread").finish().expect("no panic")
    };
    let tests = generate(Cancel::new()).expect("there is an initial state");
    assert!(tests.goals.iter().all(|goal| goal.reached) && tests.scenarios.len() == 1, "{tests:?}");
    assert_eq!(generate(cancelled()).err(), Some(NoStart::Stopped(Stop::Asked)));
}

fn folder(job: GenerateJob) -> Result<Folder, NotGenerated> {
    job.finish().expect("no panic")
}

#[test]
fn the_class_of_a_model() {
    let generate = |cancel| {
        let loaded = toggle();
        let options = groundstate::generate::model::Options::default();
        folder(job::generate_model(loaded.program, loaded.sources, options, cancel).expect("a thread"))
    };
    let folder = generate(Cancel::new()).expect("it can be generated");
    let runtime = "runtime/include/groundstate/machine/";
    let (headers, own): (Vec<_>, Vec<_>) = folder.decided.iter().partition(|(path, _)| path.starts_with(runtime));
    let paths: Vec<&str> = own.iter().map(|(path, _)| path.as_str()).collect();
    let expected = ["toggle.hpp", "toggle.cpp", "replay.cpp", "CMakeLists.txt", "source-map.json"];
    assert_eq!((paths, folder.once.len()), (expected.to_vec(), 0));
    assert!(headers.iter().any(|(path, text)| path.ends_with("/value.hpp") && text.contains("namespace")));
    assert!(own[4].1.contains("\"file\": \"Toggle.asm\""));
    assert_eq!(generate(cancelled()), Err(NotGenerated::Cancelled));
}

#[test]
fn the_program_of_a_system() {
    let generate = |text: &str| {
        let source = SourceFile::new("Blink.chart", text);
        let groundstate::chart::Loaded { chart, sources, .. } =
            groundstate::chart::load(source, &mut testkit::Patterns);
        let job = job::generate_system(chart, sources, "Blink.chart".to_string(), Default::default(), Cancel::new());
        folder(job.expect("a thread"))
    };
    let text = "chart Blink\nimport patterns/ControlTask\nsystem blink\n\tcomponent lamp synchronous period 10 ms\n\
                \t\telaborate toggle 1 ms\n\tendcomponent\nendsystem\n";
    let folder = generate(text).expect("it can be generated");
    assert!(folder.once.iter().any(|(path, _)| path == "main.cpp"));
    assert!(folder.decided.iter().any(|(path, _)| path == "generated/include/groundstate/system.hpp"));
    let map = folder.decided.iter().find(|(path, _)| path == "generated/source-map.json").expect("it has a map");
    let map: serde_json::Value = serde_json::from_str(&map.1).expect("it is JSON");
    let header = &folder.decided[0].1;
    let lines: Vec<(&str, u64)> = map["lines"]
        .as_array()
        .expect("a list")
        .iter()
        .map(|line| {
            let number = line["generated"]["line"].as_u64().expect("a number");
            (
                header.lines().nth(number as usize - 1).expect("it is there").trim(),
                line["model"]["line"].as_u64().expect("one"),
            )
        })
        .collect();
    // The class, its hook, the task and its cycle.
    assert_eq!((lines[0], lines[1].1), (("struct Lamp {", 4), 5), "{lines:?}");
    assert!(lines[1].0.contains(" bool toggle(") && lines.len() == 4, "{lines:?}");
    assert_eq!(map["texts"][0]["fingerprint"], groundstate::text_fingerprint(text));
    assert_eq!(generate("chart Blink\n"), Err(NotGenerated::NoSystem));
}

/// Returns bytes one after the other, then nothing.
struct Bytes(Vec<u8>);

impl Tail for Bytes {
    type Trouble = String;

    fn next(&mut self) -> Result<Piece, String> {
        Ok(Piece { bytes: std::mem::take(&mut self.0), is_all: true })
    }
}

#[test]
fn a_comparison() {
    let coming = |bytes: &[u8], cancel| {
        let events = Events::Coming(Bytes(bytes.to_vec()));
        let request = ConformRequest { loaded: toggle(), events, limits: Limits::default(), by_order: false };
        job::conform(request, cancel).expect("a thread").finish().expect("no panic")
    };
    assert!(matches!(coming(b"no recording", Cancel::new()), Err(NotConformed::Malformed(_))));
    assert!(matches!(coming(b"", cancelled()), Err(NotConformed::NoEvents)));
    let events = Events::<NoTail>::Whole(Recording::default());
    let request = ConformRequest { loaded: toggle(), events, limits: Limits::default(), by_order: false };
    let whole = job::conform(request, Cancel::new()).expect("a thread").finish().expect("no panic");
    assert!(matches!(whole, Err(NotConformed::Refused(_))));
}

/// Every task is silent, so without a request to end the comparison makes every step of the model.
#[test]
fn a_comparison_of_a_whole_recording_is_cancelled() {
    let path = testkit::repository::root().join("cpp/systems/Contention.asm");
    let source = testkit::Disk::read(&path).expect("the model is there");
    let loaded = load(source, &mut testkit::Disk).unwrap_or_else(|faulty| panic!("{:?}", faulty.diagnostics));
    let track = |task: &str| Track { task: task.to_string(), ..Track::default() };
    let recording = Recording {
        tracks: ["planner", "slow", "fast", "watcher"].map(track).to_vec(),
        tick_ns: 100_000,
        pace: "modelled".to_string(),
        stopped_ns: Some(i64::MAX),
        ended: true,
        ..Recording::default()
    };
    let request = ConformRequest {
        loaded,
        events: Events::<NoTail>::Whole(recording),
        limits: Limits::default(),
        by_order: false,
    };
    let conformed = job::conform(request, cancelled()).expect("a thread").finish().expect("no panic");
    let reason = "the comparison was interrupted".to_string();
    assert_eq!(conformed.expect("of this system").verdict, Verdict::Unknown { events: 0, reason });
}
