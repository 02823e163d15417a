//! Sessions: a scenario that is played command by command ends as one that is run; a run that is stepped forth and back, and looked at
//! meanwhile, is the same run.

use std::sync::Arc;
use std::time::Duration;

use groundstate::reporting::{Watched, specification_beside};
use groundstate::scenario::{FirstCandidate, Judgement, Options};
use groundstate::session::{Break, Breaks, Heard, Hit, On, Scene, Session, SessionOptions, Waits};
use groundstate::workspace::{Absent, Files};
use groundstate::{Overlay, Suite, load};
use machine::{Limits, Show};
use model::Loader;
use syntax::SourceFile;
use testkit::{Disk, NoFiles, Texts};

const METER: &str = "asm Meter
import StandardLibrary
signature:
	monitored pulse: Boolean
	controlled sum: Integer
	controlled seen: Seq(Integer)
	derived large: Boolean
definitions:
	function large = sum > 3
	rule r_Add = choose $n in {1 : 3} do sum := sum + $n
	main rule r_Main =
		par
			if pulse then r_Add[] endif
			seen := append(seen, sum)
		endpar
default init s0:
	function sum = 0
	function seen = []
";

fn options(seed: Option<u64>) -> SessionOptions {
    SessionOptions {
        seed,
        history: 100,
        passes_violations: false,
        given: Vec::new(),
        recorded: None,
        limits: Limits::default(),
        watched: None,
        begins: false,
    }
}

fn meter(seed: Option<u64>) -> Session {
    let loaded = load(SourceFile::new("Meter.asm", METER), &mut NoFiles).expect("it has no errors");
    let mut session = Session::open(Arc::new(Scene::from(&loaded)), options(seed)).expect("it starts");
    wait(&mut session);
    session
}

/// Waits until the session waits; gives why it refused, if it did.
fn wait(session: &mut Session) -> Option<String> {
    let mut refused = None;
    for _ in 0..10_000 {
        match session.hear(Duration::from_millis(20)) {
            Heard::Waits => return refused,
            Heard::Refused(reason) => {
                refused = Some(reason);
                if session.is_asking() {
                    return refused;
                }
            }
            Heard::Nothing | Heard::Said(..) => {}
            Heard::Gone => panic!("the session is gone"),
        }
    }
    panic!("the session does not answer");
}

fn step(session: &mut Session, steps: u64) {
    session.step(steps).expect("it can");
    assert_eq!(wait(session), None);
}

fn value(session: &mut Session, term: &str) -> String {
    let program = Arc::clone(&session.scene().program);
    session.evaluate(term).map_or_else(|reason| reason, |value| value.show(&program).to_string())
}

#[test]
fn a_scenario_ends_step_by_step_as_it_does_at_once() {
    let mut played = 0;
    let small = ["coffee_machine", "euclid", "game_of_life", "hanoi", "mutual_exclusion", "philosophers", "word_count"];
    let small = small.map(|name| format!("examples/{name}"));
    // The systems take half a minute.
    let all = ["examples".to_string(), "library/patterns".to_string()];
    let folders = if testkit::sample::is_full() { all.to_vec() } else { small.to_vec() };
    for folder in folders {
        for path in testkit::repository::files(&folder, &["avalla"]) {
            let source = Disk::read(&path).expect("a scenario");
            let tested = Suite::new().test(source.clone(), &mut Disk, Options::default(), &mut FirstCandidate);
            let verdict = tested.verdict.expect("it runs");
            if verdict.steps > 500 {
                continue;
            }
            let scene = Suite::new().stage(source, &mut Disk).unwrap_or_else(|_| panic!("{}", path.display()));
            let mut session = Session::open(Arc::new(scene), options(None)).expect("it starts");
            wait(&mut session);
            while *session.waits() != Waits::End {
                step(&mut session, 1);
            }
            let moment = session.moment().expect("a moment");
            let word = match verdict.judgement {
                Judgement::Passed => "passed",
                Judgement::FailedAsExpected(_) => "failed-as-expected",
                Judgement::Failed(_) => "failed",
            };
            let (steps, checks) = (verdict.steps, verdict.checks);
            assert_eq!((moment.end, moment.step, moment.checks), (Some(word), steps, checks), "{}", path.display());
            played += 1;
        }
    }
    assert!(played >= 8, "{played} scenarios were played");
}

#[test]
fn a_step_that_fails_changes_nothing_and_tells_no_update_that_it_did_not_make() {
    let model = METER.replace("sum := sum + $n", "par sum := sum + idiv(1, sum) seen := [] endpar");
    let mut texts = Texts::of([("Meter.asm", model.as_str())]);
    let source =
        SourceFile::new("test.avalla", "scenario test load Meter.asm set pulse := false; step set pulse := true; step");
    let scene = Suite::new().stage(source, &mut texts).unwrap_or_else(|tested| panic!("{:?}", tested.failures()));
    let mut session = Session::open(Arc::new(scene), options(None)).expect("it starts");
    wait(&mut session);
    step(&mut session, 2);
    let made = session.moment().expect("a moment");
    assert_eq!((made.step, made.changes.len(), made.ran_now), (1, 1, true));
    step(&mut session, 2);
    let failed = session.moment().expect("a moment");
    assert_eq!((failed.end, failed.step, failed.changes.len(), failed.idle.len()), (Some("failed"), 1, 0, 0));
    assert!(!failed.ran.is_empty() && failed.faults.len() == 1, "{failed:?}");
}

#[test]
fn going_back_and_looking_changes_nothing() {
    let mut plain = meter(Some(3));
    let mut told = Vec::new();
    for _ in 0..40 {
        step(&mut plain, 1);
        told.push(value(&mut plain, "(sum, seen)"));
    }
    // Terms that are added between steps, and steps that are taken back, do not show in it.
    let mut other = meter(Some(3));
    for (made, expected) in told.iter().enumerate() {
        step(&mut other, 1);
        assert_eq!(value(&mut other, &format!("sum + {made} > {made} or not large")), "true");
        if made % 3 == 2 {
            for _ in 0..3 {
                other.back().expect("it can");
                wait(&mut other);
            }
            step(&mut other, 3);
        }
        assert_eq!(value(&mut other, "(sum, seen)"), *expected, "step {}", made + 1);
    }
    // More terms than are kept.
    for number in 0..600 {
        assert_eq!(value(&mut other, &format!("idiv({number}, 1)")), number.to_string());
    }
    assert!(value(&mut other, &"1 + ".repeat(5_000)).contains("bytes"));
    step(&mut other, 1);
    // As many steps as are kept can be taken back.
    let mut taken = 0;
    loop {
        other.back().expect("it can");
        if wait(&mut other).is_some() {
            break;
        }
        taken += 1;
    }
    assert_eq!((taken, value(&mut other, "(sum, seen)")), (41, "(0,[])".to_string()));
}

#[test]
fn an_input_that_is_asked_for_is_given_refused_or_left() {
    let mut session = meter(None);
    step(&mut session, 1);
    assert!(matches!(session.waits(), Waits::Input { .. }), "{:?}", session.waits());
    assert!(session.step(1).is_err() && session.choose(0).is_err());
    assert!(session.answer("maybe").is_err());
    assert_eq!(value(&mut session, "pulse"), "pulse was not asked for");
    session.answer("true").expect("it is asked for");
    wait(&mut session);
    let Waits::Choice { candidates, .. } = session.waits() else { panic!("{:?}", session.waits()) };
    assert_eq!(candidates.len(), 3);
    assert!(session.choose(3).is_err());
    session.back().expect("it can");
    wait(&mut session);
    let moment = session.moment().expect("a moment");
    assert_eq!((session.waits(), moment.step), (&Waits::Step, 0));
    // The run is one step at a time, whatever was asked for before.
    let (location, given) = session.read_input("pulse", Some("false")).expect("an input");
    assert!(!session.set(location, given).expect("it is there"));
    step(&mut session, 2);
    assert_eq!((session.moment().expect("a moment").step, value(&mut session, "pulse")), (2, "false".to_string()));
    assert!(session.read_input("sum", Some("1")).is_err() && session.read_input("pulse", Some("7")).is_err());
}

#[test]
fn breaks_stop_forth_and_back() {
    let mut session = meter(Some(1));
    let condition = session.conditions().condition("large").expect("a condition");
    assert!(session.conditions().condition("sum").is_err());
    let program = Arc::clone(&session.scene().program);
    let sum = program.find_function("sum", 0).expect("a function");
    let list = vec![Break { id: 7, on: On::Function(sum), condition: Some(condition), count: None, message: None }];
    let grown = Some(Arc::clone(session.conditions().program()));
    session.set_breaks(Breaks { list, program: grown, faults: true, violations: true });
    session.resume().expect("it can");
    wait(&mut session);
    let first = session.moment().expect("a moment");
    assert_eq!((first.hit.clone(), value(&mut session, "large")), (Some(Hit::Breaks(vec![7])), "true".to_string()));
    session.resume().expect("it can");
    wait(&mut session);
    assert!(session.moment().expect("a moment").step > first.step);
    session.rewind().expect("it can");
    wait(&mut session);
    assert_eq!(session.moment().expect("a moment").step, first.step);
    session.rewind().expect("it can");
    wait(&mut session);
    assert_eq!(session.moment().expect("a moment").step, 0);
}

/// A folder without files.
struct Bare;

impl Files for Bare {
    fn read(&mut self, _: &str) -> Result<SourceFile, Absent> {
        Err(Absent::Missing)
    }
}

impl Loader for Bare {
    fn load(&mut self, _: &SourceFile, _: &str) -> Result<SourceFile, String> {
        Err("there is no such file".to_string())
    }
}

/// What a session's timeline shows, as it is drawn.
fn lanes(session: &Session) -> String {
    report::render_timeline(&session.timeline().expect("an initial state")).run
}

/// A session on the meter whose timeline shows what the model says.
fn watched(seed: Option<u64>) -> Session {
    let loaded = load(SourceFile::new("Meter.asm", METER), &mut NoFiles).expect("it has no errors");
    let mut asked = loaded.overlay();
    let says = specification_beside("Meter.asm", &loaded.program, &mut Bare).expect("nothing is beside it");
    assert!(says.text.contains("\"sum\": { value: \"sum\" }"), "{}", says.text);
    let watched = Watched::new(&mut asked, says).expect("its own specification has no faults");
    let Overlay { sources, model, program } = asked;
    let scene = Scene { sources, model, program, ..Scene::from(&loaded) };
    let options = SessionOptions { watched: Some(Arc::new(watched)), ..options(seed) };
    let mut session = Session::open(Arc::new(scene), options).expect("it starts");
    wait(&mut session);
    session
}

#[test]
fn a_timeline_is_that_of_the_run_whatever_was_taken_back() {
    let mut straight = watched(Some(3));
    straight.step(30).expect("it can");
    wait(&mut straight);
    let mut winding = watched(Some(3));
    assert_eq!(winding.timeline().map(|report| (report.ticks, report.steps())), Some((1, 0)));
    for (forth, back) in [(10, 4), (7, 12), (1, 2), (29, 0), (1, 0)] {
        winding.step(forth).expect("it can");
        wait(&mut winding);
        for _ in 0..back {
            winding.back().expect("it can");
            wait(&mut winding);
        }
    }
    assert_eq!((straight.moment().unwrap().step, winding.moment().unwrap().step), (30, 30));
    assert_eq!(lanes(&straight), lanes(&winding));
    straight.back().expect("it can");
    wait(&mut straight);
    assert_ne!(lanes(&straight), lanes(&winding), "a step was taken back");
}

const GAUGE: &str = "asm Gauge
import StandardLibrary
signature:
	domain Percent subsetof Integer
	monitored level: Percent
	monitored tap: Boolean
	controlled sum: Integer
definitions:
	domain Percent = {-10 : 200}
	main rule r_Main = if tap then sum := sum + level endif
default init s0:
	function sum = 0
";

#[test]
fn inputs_come_from_a_file_what_is_set_comes_first_and_the_rest_is_asked_for() {
    let loaded = load(SourceFile::new("Gauge.asm", GAUGE), &mut NoFiles).expect("it has no errors");
    let yaml = "always: { tap: true }\n1: { level: 5 }\n3..3: { level: 40 }\n";
    let named = inputs::named(&loaded.program, inputs::Form::Yaml, syntax::FileId(0), yaml).expect("it fits");
    let with = |recorded| SessionOptions { recorded, ..options(None) };
    let mut session = Session::open(Arc::new(Scene::from(&loaded)), with(Some(Arc::new(named)))).expect("it starts");
    wait(&mut session);
    let mut sums = Vec::new();
    for _ in 0..3 {
        step(&mut session, 1);
        sums.push(value(&mut session, "sum"));
    }
    assert_eq!(sums, ["5", "10", "50"]);
    // Steps that are taken back and made again take the same inputs; what is set by hand comes first.
    session.back().expect("it can");
    wait(&mut session);
    step(&mut session, 1);
    assert_eq!(value(&mut session, "sum"), "50");
    let (location, set) = session.read_input("level", Some("7")).expect("it is one");
    session.set(location, set).expect("it runs");
    step(&mut session, 1);
    assert_eq!(value(&mut session, "sum"), "57");
    // What the file does not give is asked for, with the ends of its domain, also of one with more values than are offered.
    let partial =
        inputs::named(&loaded.program, inputs::Form::Csv, syntax::FileId(0), "step,tap\n1,true\n").expect("it fits");
    let mut session = Session::open(Arc::new(Scene::from(&loaded)), with(Some(Arc::new(partial)))).expect("it starts");
    wait(&mut session);
    step(&mut session, 1);
    let Waits::Input { values, bounds, .. } = session.waits() else { panic!("{:?}", session.waits()) };
    assert_eq!((values.len(), *bounds), (100, Some((-10, 200))));
}

/// The last of two values would win, and the file have no say in it.
#[test]
fn a_file_gives_a_value_once() {
    let loaded = load(SourceFile::new("Gauge.asm", GAUGE), &mut NoFiles).expect("it has no errors");
    let refused = |form, text: &str| {
        let read = inputs::named(&loaded.program, form, syntax::FileId(0), text);
        read.expect_err(text).into_iter().map(|fault| fault.message).collect::<Vec<_>>().join("\n")
    };
    let yaml = |text: &str| refused(inputs::Form::Yaml, text);
    let csv = |text: &str| refused(inputs::Form::Csv, text);
    let twice = "`tap` is given twice for the same steps";
    assert_eq!(yaml("always: { tap: true, tap: false }"), twice);
    assert_eq!(yaml("1: { tap: true }\n2: { tap: false }\n1: { tap: true }"), twice);
    assert_eq!(csv("tap,tap\ntrue,false"), twice);
    assert_eq!(csv("step,tap\n1,true\n1,false"), twice);
    assert_eq!(csv("step,location,value\n1,tap,true\n1,tap,false"), twice);
    assert_eq!(yaml("random: { tap: 1 %, tap: 2 % }"), "how often `tap` comes is given twice");
    let other = "1: { tap: true }\n1..2: { tap: false }\n1: { level: 3 }";
    assert!(inputs::named(&loaded.program, inputs::Form::Yaml, syntax::FileId(0), other).is_ok());
}
