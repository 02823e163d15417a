//! Jobs: followed, steered, cancelled, dropped.

use std::sync::Arc;

use groundstate::job::{self, Cancel, Command, Job, NO_KEEPER, RunEvent, RunRequest, TestEvent, VerifyEvent};
use groundstate::{Loaded, load};
use machine::{Limits, Location, Value};
use simulate::{End, Record, read_location, read_value};
use syntax::SourceFile;
use verify::{NoSolvers, NoStart, Options, Outcome, Request, Stop, Subject};

struct NoFiles;

impl model::Loader for NoFiles {
    fn load(&mut self, _: &SourceFile, path: &str) -> Result<SourceFile, String> {
        match path {
            "Counter.asm" => Ok(SourceFile::new("Counter.asm", counter())),
            other => Err(format!("there is no {other}")),
        }
    }
}

fn counter() -> String {
    "asm Counter\nimport StandardLibrary\nsignature:\n\tenum domain Way = {UP | DOWN}\n\tmonitored way: Way\n\
     \tcontrolled n: Integer\n\tcontrolled m: Integer\ndefinitions:\n\tinvariant inv_small over n: n < 3\n\
     \tmain rule r_Main = par if way = UP then n := n + 1 else n := n - 1 endif choose $k in {1, 2, 3} with true do m := $k endpar\n\
     default init s0:\n\tfunction n = 0\n\tfunction m = 0\n"
        .to_string()
}

fn loaded(text: &str) -> Loaded {
    load(SourceFile::new("Counter.asm", text), &mut NoFiles).unwrap_or_else(|faulty| panic!("{:?}", faulty.diagnostics))
}

fn request(loaded: &Loaded) -> RunRequest {
    RunRequest {
        program: Arc::clone(&loaded.program),
        limits: Limits::default(),
        options: simulate::Options { history: 10, steps: None, ..simulate::Options::default() },
        inputs: Box::new(|inputs| inputs),
        asks_inputs: Some(simulate::RandomSource::new(0, simulate::Bounds::default())),
        asks_choices: true,
        paused: true,
        states: true,
        frozen: false,
        due: job::at_once(),
    }
}

fn location(loaded: &Loaded, text: &str) -> Location {
    read_location(&loaded.program, text).expect("a location")
}

fn value(loaded: &Loaded, function: &str, text: &str) -> Value {
    let function = location(loaded, function).function;
    read_value(&loaded.program, loaded.program.function(function).codomain, text).expect("a value")
}

/// The value of `n` in the state of an event.
fn n(loaded: &Loaded, state: &[(Location, Value)]) -> Value {
    let at = location(loaded, "n");
    state.iter().find(|(location, _)| *location == at).expect("it has a value").1.clone()
}

#[test]
fn a_run_is_steered() {
    let loaded = loaded(&counter());
    let (job, remote) = job::run(request(&loaded), Cancel::new()).expect("a thread");
    let way = location(&loaded, "way");
    let (up, down) = (value(&loaded, "way", "UP"), value(&loaded, "way", "DOWN"));
    let mut script = [
        Command::Back,
        Command::Step(2),
        Command::Back,
        Command::Set(way.clone(), down),
        Command::Choose(0),
        Command::Step(1),
        Command::Stop,
    ]
    .into_iter();
    let (mut told, mut asked) = (Vec::new(), 0);
    while let Some(event) = job.next_event() {
        match event {
            RunEvent::Paused => {
                // After some of the commands the run stays paused.
                for command in script.by_ref() {
                    let waits = matches!(command, Command::Set(..) | Command::Choose(_));
                    remote.send(command);
                    if !waits {
                        break;
                    }
                }
            }
            RunEvent::AsksInput { location, .. } => {
                assert_eq!(location, way);
                asked += 1;
                remote.send(Command::Set(location, up.clone()));
            }
            RunEvent::AsksChoice { candidates, .. } => {
                assert_eq!(candidates.len(), 3);
                remote.send(Command::Choose(7));
                remote.send(Command::Choose(2));
            }
            RunEvent::Progress(_) | RunEvent::Said { .. } => {}
            RunEvent::Refused(why) => told.push(why),
            RunEvent::Record { record, state, steps, .. } => told.push(match *record {
                Record::End(end) => format!("{end:?} after {steps}"),
                Record::Back { step } => format!("before {step}"),
                _ => format!("{steps}: {:?}", n(&loaded, &state.expect("states are wanted"))),
            }),
        }
    }
    let refused = "there are 3 candidates, none is number 8";
    let expected = [
        "0: Integer(0)",
        "no step is kept that could be taken back",
        refused,
        "1: Integer(1)",
        refused,
        "2: Integer(2)",
        "before 2",
        "no choice is asked for",
        refused,
        "2: Integer(0)",
        "Quit after 2",
    ];
    assert_eq!(told, expected);
    assert_eq!(asked, 1, "what was set once is not asked for again");
    assert_eq!(job.finish(), Ok(2));
}

#[test]
fn a_violation_is_told_with_what_is_wrong_and_can_be_taken_back() {
    let loaded = loaded(&counter());
    let request = RunRequest { asks_choices: false, ..request(&loaded) };
    let (job, remote) = job::run(request, Cancel::new()).expect("a thread");
    remote.send(Command::Set(location(&loaded, "way"), value(&loaded, "way", "UP")));
    remote.send(Command::Step(9));
    let (mut ended, mut back) = (0, 0);
    while let Some(event) = job.next_event() {
        match event {
            RunEvent::Record { record, faults, .. } => match *record {
                Record::Step(step) => assert_eq!(faults.len(), usize::from(step.step == 3), "{faults:?}"),
                Record::End(End::Violation) => ended += 1,
                Record::Back { step } => {
                    assert_eq!(step, 3);
                    back += 1;
                }
                _ => {}
            },
            RunEvent::Paused if ended == 1 && back == 0 => _ = remote.send(Command::Back),
            RunEvent::Paused if back == 1 => _ = remote.send(Command::Stop),
            _ => {}
        }
    }
    assert_eq!((ended, back), (1, 1));
}

#[test]
fn steps_that_nobody_looks_at_are_made_together_and_their_faults_told() {
    // A walk up and down, which leaves the bound now and then, and one that goes on until a step cannot be made.
    let walk = counter().replace("n < 3", "n mod 50 != 49");
    let dividing = walk.replace("then n := n + 1", "then n := n + idiv(6 - n, 6 - n)");
    for (text, invariants) in [
        (&walk, simulate::Invariants::Stop),
        (&walk, simulate::Invariants::Report),
        (&walk, simulate::Invariants::Ignore),
        (&dividing, simulate::Invariants::Report),
    ] {
        let loaded = loaded(text);
        let told = |keep: bool, dues: usize| {
            let options = simulate::Options { steps: Some(30_000), keep, invariants, ..simulate::Options::default() };
            let mut looked = 0;
            let due = Box::new(move || {
                looked += 1;
                dues > 0 && looked % dues == 0
            });
            let request =
                RunRequest { options, asks_choices: false, paused: false, states: false, due, ..request(&loaded) };
            let inputs = Box::new(|inputs: simulate::Inputs| {
                inputs.with(simulate::RandomSource::new(7, simulate::Bounds::default()))
            });
            let (job, _remote) =
                job::run(RunRequest { inputs, asks_inputs: None, ..request }, Cancel::new()).expect("a thread");
            let mut told = Vec::new();
            while let Some(event) = job.next_event() {
                match event {
                    RunEvent::Record { record, faults, steps, .. } => match *record {
                        Record::Step(_) if faults.is_empty() => {}
                        Record::Step(step) => told.push((steps, step.step, format!("{:?}", step.violations))),
                        Record::Attempt(step) => told.push((steps, step.step, format!("{faults:?}"))),
                        Record::End(end) => told.push((steps, 0, format!("{end:?}"))),
                        Record::Initial { .. } | Record::Back { .. } => {}
                    },
                    RunEvent::Progress(_) => {}
                    other => panic!("{other:?}"),
                }
            }
            (told, job.finish())
        };
        let one_by_one = told(true, 0);
        let divides = one_by_one.0.iter().any(|(_, _, what)| what.contains("DivisionByZero"));
        assert_eq!(divides, *text == dividing, "{one_by_one:?}");
        assert_eq!(told(false, 0), one_by_one);
        assert_eq!(told(false, 3), one_by_one);
    }
}

#[test]
fn a_run_ends_when_it_is_cancelled_or_its_owner_is_gone() {
    // Neither the run nor its one step would end within anybody's patience.
    let steps = "asm Counter\nimport StandardLibrary\nsignature:\n\tcontrolled n: Integer\ndefinitions:\n\
                 \tmain rule r_Main = n := 1 - n\ndefault init s0:\n\tfunction n = 0\n";
    let step = "asm Counter\nimport StandardLibrary\nsignature:\n\tdomain D subsetof Integer\n\tcontrolled n: Boolean\n\
                definitions:\n\tdomain D = {1:5000}\n\
                \tmain rule r_Main = n := (forall $a in D, $b in D, $c in D with $a + $b + $c > 0)\n\
                default init s0:\n\tfunction n = false\n";
    for text in [steps, step] {
        let loaded = loaded(text);
        let request =
            || RunRequest { paused: false, limits: Limits { work: u64::MAX, ..Limits::default() }, ..request(&loaded) };
        let (job, _remote) = job::run(request(), Cancel::new()).expect("a thread");
        job.next_event().expect("the initial state");
        job.cancel().cancel();
        let mut last = None;
        while let Some(event) = job.next_event() {
            last = Some(event);
        }
        assert!(
            matches!(&last, Some(RunEvent::Record { record, .. }) if **record == Record::End(End::Interrupted)),
            "{last:?}"
        );
        let (job, _remote) = job::run(request(), Cancel::new()).expect("a thread");
        job.next_event().expect("the initial state");
        let cancel = job.cancel().clone();
        drop(job);
        while step != text && Arc::strong_count(&loaded.program) > 1 {
            std::thread::yield_now();
        }
        cancel.cancel();
        while Arc::strong_count(&loaded.program) > 1 {
            std::thread::yield_now();
        }
    }
}

#[test]
fn a_verification_tells_of_violations_and_of_its_end() {
    let loaded = loaded(&counter());
    let bounded = Options { max_depth: 6, ..Options::default() };
    let request = || Request::of(&loaded.program, bounded.clone()).build().expect("nothing is in conflict");
    let job = job::verify(request(), Cancel::new(), NoSolvers, NO_KEEPER, || true).expect("a thread");
    let mut violated = Vec::new();
    while let Some(event) = job.next_event() {
        if let VerifyEvent::Violated(subject, trace) = event {
            violated.push((subject, trace.steps.len()));
        }
    }
    let (report, _) = job.finish().expect("no panic");
    let report = report.expect("there is an initial state");
    let found = |subject| report.verdicts.iter().find(|verdict| verdict.subject == subject).expect("it is asked");
    assert!(matches!(&found(Subject::Property(0)).outcome, Outcome::Violated(trace) if trace.steps.len() == 3));
    assert_eq!(violated, [(Subject::Property(0), 3)]);
    let cancel = Cancel::new();
    cancel.cancel();
    let job = job::verify(request(), cancel, NoSolvers, NO_KEEPER, || true).expect("a thread");
    assert_eq!(job.finish().expect("no panic").0, Err(NoStart::Stopped(Stop::Asked)));
}

#[test]
fn scenarios_are_told_one_by_one() {
    let scenario = |name: &str, steps: &str| {
        SourceFile::new(format!("{name}.avalla"), format!("scenario {name}\nload Counter.asm\nset way := UP;\n{steps}"))
    };
    let files = vec![scenario("good", "step\ncheck n = 1;\n"), scenario("bad", "step\ncheck n = 2;\n")];
    let job = job::test(files.clone(), NoFiles, scenario::Options::default(), None, Cancel::new()).expect("a thread");
    let mut passed = Vec::new();
    while let Some(TestEvent(tested)) = job.next_event() {
        passed.push((tested.name.clone(), tested.verdict.expect("it ran").passed()));
    }
    assert_eq!(passed, [("good".to_string(), true), ("bad".to_string(), false)]);
    let cancel = Cancel::new();
    cancel.cancel();
    let job = job::test(files, NoFiles, scenario::Options::default(), None, cancel).expect("a thread");
    assert!(job.next_event().is_none());
}

/// Nobody is woken for what the next event makes out of date, and it never comes behind what was sent later.
#[test]
fn what_is_mentioned_is_read_when_there_is_nothing_else() {
    let work = |port: groundstate::job::Port<u32>| {
        (0..1000).for_each(|number| port.mention(number));
        port.tell(1000);
        (1001..2000).for_each(|number| port.mention(number));
    };
    for _ in 0..20 {
        let job = Job::start("mention", Cancel::new(), work).expect("a thread");
        let read: Vec<u32> = std::iter::from_fn(|| job.next_event()).collect();
        assert!(read.is_sorted() && read.contains(&1000) && read.last() == Some(&1999), "{read:?}");
        job.finish().expect("no panic");
    }
}

#[test]
fn a_panic_is_told_as_what_it_is() {
    let job: Job<(), ()> = Job::start("panic", Cancel::new(), |_| panic!("a bug")).expect("a thread");
    assert_eq!(job.finish(), Err(job::Crashed("a bug".to_string())));
}
