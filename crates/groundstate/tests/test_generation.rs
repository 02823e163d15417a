//! Generated scenarios pass, and together they cover what was said to be reached. Goals and scenario coverage are
//! counted by different code and must agree goal by goal.

use std::collections::BTreeSet;
use std::path::{Path, PathBuf};
use std::sync::Arc;

use groundstate::scenario::{FirstCandidate, Items, Options as Scenario};
use groundstate::test_generation::{GoalKind, Method, Subject, Tests, Trial, generate_tests};
use groundstate::verify::{Options, Reason};
use groundstate::{Loaded, Suite};
use machine::Limits;
use syntax::{SourceFile, Span};
use testkit::{Disk, Texts, repository};

fn example(name: &str) -> PathBuf {
    repository::root().join(format!("{name}.asm"))
}

fn load(path: &Path) -> Loaded {
    groundstate::load(Disk::read(path).expect("it is there"), &mut Disk)
        .unwrap_or_else(|f| panic!("{:#?}", f.diagnostics))
}

fn generate(path: &Path, method: Method, options: &Options) -> Tests {
    let loaded = load(path);
    let (root, program) = (loaded.model.root, Arc::clone(&loaded.program));
    let name = path.file_name().expect("a file").to_string_lossy().into_owned();
    let subject = Subject { model: &loaded.model, program: &program, turns: &[], path: &name };
    generate_tests(subject, options, method, &|file| file == root, &mut |_| true).expect("there is an initial state")
}

/// Tests of a model in memory, by search.
fn generate_of(text: &str, options: &Options) -> Tests {
    let loaded = groundstate::load(SourceFile::new("Model.asm", text), &mut Disk)
        .unwrap_or_else(|faults| panic!("{:#?}", faults.diagnostics));
    let root = loaded.model.root;
    let subject = Subject { model: &loaded.model, program: &loaded.program, turns: &[], path: "Model.asm" };
    let tests = generate_tests(subject, options, Method::Search, &|file| file == root, &mut |_| true);
    tests.expect("there is an initial state")
}

/// Runs the scenarios beside the model, checks that all pass, and returns what they cover.
fn run(path: &Path, tests: &Tests) -> Items {
    let mut suite = Suite::new();
    let mut checks = 0;
    for scenario in &tests.scenarios {
        let source = SourceFile::new(path.with_file_name("x.avalla").display().to_string(), scenario.text.as_str());
        let options = Scenario { coverage: true, ..Scenario::default() };
        let tested = suite.test(source, &mut Disk, options, &mut FirstCandidate);
        let verdict = tested.verdict.unwrap_or_else(|| panic!("{:#?}\n{}", tested.diagnostics, scenario.text));
        assert!(verdict.passed(), "{:#?}\n{}", verdict.failures(), scenario.text);
        assert_eq!(verdict.steps, scenario.steps as u64);
        checks += verdict.checks.0;
    }
    assert!(checks > 0, "{}", path.display());
    let (_, sources, items) = suite.coverage().next().expect("some scenario ran");
    let root = sources.iter().next().expect("the model").0;
    let mut items = items;
    items.rules.retain(|item| item.span.file == root);
    items.branches.retain(|item| item.span.file == root);
    items.updates.retain(|item| item.span.file == root);
    items.foralls.retain(|item| item.span.file == root);
    items
}

type Covered = BTreeSet<(String, Span)>;

/// What the scenarios cover, in terms of goals.
fn covered(items: &Items) -> Covered {
    let single = items.rules.iter().chain(&items.branches).chain(&items.updates).filter(|item| item.covered);
    let mut all: Covered = single.map(|item| (item.what.to_string(), item.span)).collect();
    for forall in &items.foralls {
        let words = ["no element", "one element", "many elements"];
        all.extend(words.iter().zip(forall.seen).filter(|(_, seen)| *seen).map(|(w, _)| (w.to_string(), forall.span)));
    }
    all
}

/// Which goals were said to be reached, of those that scenario coverage counts.
fn stated(tests: &Tests) -> Covered {
    let reached = tests.goals.iter().filter(|goal| goal.reached);
    let words = reached.filter_map(|goal| {
        let what = match goal.kind {
            GoalKind::Rule => "rule",
            GoalKind::Branch(what) | GoalKind::Forall(what) => what,
            GoalKind::Update => "update",
            GoalKind::Condition | GoalKind::Transition => return None,
        };
        Some((what.to_string(), goal.span))
    });
    words.collect()
}

const MODELS: &[&str] = &[
    "examples/mutual_exclusion/Peterson",
    "examples/philosophers/Philosophers",
    "bench/models/verify/Swing",
    "library/verification/Lock",
];

#[test]
fn the_scenarios_cover_what_is_said() {
    for name in MODELS {
        let path = example(name);
        let options = Options { max_states: 3_000, ..Options::default() };
        let tests = generate(&path, Method::Search, &options);
        let items = run(&path, &tests);
        assert_eq!(covered(&items), stated(&tests), "{name}");
        assert!(tests.goals.iter().any(|goal| goal.reached), "{name}");
    }
}

/// What lies behind states or steps that violate an invariant is not said to be unreachable.
#[test]
fn what_violated_invariants_hide_is_not_known() {
    let reasons = |invariant: &str, assumption: &str| -> Vec<Reason> {
        let text = format!(
            "asm Model import StandardLibrary signature: domain N subsetof Integer controlled n: N monitored stop: Boolean \
             definitions: domain N = {{0:4}} {invariant} {assumption} \
             main rule r_Main = if n = 3 and not stop then n := 0 else if n < 3 then n := n + 1 endif endif \
             default init s0: function n = 0"
        );
        generate_of(&text, &Options::default()).reasons
    };
    assert_eq!(reasons("", ""), []);
    assert_eq!(reasons("invariant inv_all over n: n <= 3", ""), []);
    assert_eq!(reasons("invariant inv_few over n: n < 2", ""), [Reason::Unlawful]);
    assert_eq!(reasons("invariant inv_go over n: n < 3 or not stop", ""), [Reason::Unlawful]);
    // What an assumption leaves out is not asked for.
    assert_eq!(reasons("invariant inv_all over n: n <= 3", "INVAR n < 2"), []);
    // Where it leaves no step at all, nothing was looked at.
    assert_eq!(reasons("invariant inv_few over n: n < 2", "INVAR n < 1"), [Reason::Stepless]);
}

/// A step counts only if it leads to a state that counts: what happens in others has to be seen again, also in steps that are known.
#[test]
fn a_step_into_a_violation_reaches_no_goal() {
    let text = "asm Model import StandardLibrary signature: enum domain State = {CLOSED | OPEN}
        monitored wish: State monitored reset: Boolean controlled valve: State controlled lamp: Boolean
        definitions: invariant inv_closed over valve: valve = CLOSED
        main rule r_Main = par
            if reset then lamp := not lamp endif
            if wish = OPEN then valve := wish endif
        endpar
        default init s0: function valve = CLOSED function lamp = false";
    let tests = generate_of(text, &Options::default());
    let folder = repository::root().join("Model.asm");
    let mut files = Texts::of([(folder.to_str().expect("text"), text)]);
    let mut suite = Suite::new();
    for scenario in &tests.scenarios {
        let source = SourceFile::new(folder.with_file_name("x.avalla").display().to_string(), scenario.text.as_str());
        let options = Scenario { coverage: true, ..Scenario::default() };
        let tested = suite.test(source, &mut files, options, &mut FirstCandidate);
        assert!(tested.verdict.is_some_and(|verdict| verdict.passed()), "{}", scenario.text);
    }
    let missed: Vec<&GoalKind> = tests.goals.iter().filter(|goal| !goal.reached).map(|goal| &goal.kind).collect();
    // The branch that opens the valve, and its update.
    assert!(matches!(missed[..], [GoalKind::Branch(_), GoalKind::Update]), "{missed:?}");
    assert_eq!(tests.reasons, [Reason::Unlawful]);
    let items = suite.coverage().next().expect("some scenario ran").2;
    let reached = items.branches.iter().chain(&items.updates).filter(|item| item.covered).count();
    let said = tests.goals.iter().filter(|goal| goal.reached && !matches!(goal.kind, GoalKind::Rule)).count();
    assert_eq!(reached, said);
}

#[test]
fn conditions_that_nothing_evaluates_are_goals_too() {
    let text = "asm Model import StandardLibrary signature: enum domain Mode = {IDLE | FAILED}
        monitored hot: Boolean monitored cold: Boolean controlled mode: Mode controlled alarm: Boolean
        definitions: main rule r_Main = par
            if hot and cold then alarm := true endif
            if mode = FAILED then if hot or cold then alarm := false endif endif
        endpar
        default init s0: function mode = IDLE function alarm = false";
    for depth in [0, 1, 9] {
        let options = Options { max_depth: depth, ..Options::default() };
        let goals = generate_of(text, &options).goals;
        let conditions: Vec<bool> =
            goals.iter().filter(|goal| goal.kind == GoalKind::Condition).map(|goal| goal.reached).collect();
        let seen = depth > 0;
        assert_eq!(conditions, [seen, seen, false, false], "{depth}");
    }
}

#[test]
fn walks_at_random_cover_what_is_said_and_are_the_same_again() {
    for name in MODELS {
        let path = example(name);
        let walk = |seed| generate(&path, Method::Random(20, 30, seed), &Options::default());
        let tests = walk(3);
        assert_eq!(covered(&run(&path, &tests)), stated(&tests), "{name}");
        let texts = |tests: &Tests| tests.scenarios.iter().map(|one| one.text.clone()).collect::<Vec<_>>();
        assert_eq!(texts(&tests), texts(&walk(3)), "{name}");
    }
}

#[test]
fn no_scenario_is_superfluous() {
    for name in MODELS {
        let path = example(name);
        let options = Options { max_states: 3_000, ..Options::default() };
        let tests = generate(&path, Method::Search, &options);
        for left_out in 0..tests.scenarios.len() {
            let mut fewer = tests.clone();
            let one = fewer.scenarios.remove(left_out);
            // Scenario coverage does not count conditions and transitions; a scenario may exist only for them.
            let conditions = tests.goals.iter().any(|goal| goal.kind == GoalKind::Condition);
            if fewer.scenarios.is_empty() || conditions {
                continue;
            }
            assert_ne!(covered(&run(&path, &fewer)), stated(&tests), "{name}: {}", one.text);
        }
    }
}

/// A scenario that passes though it may go another way shows only what it shows whatever is chosen.
#[test]
fn a_way_that_cannot_be_picked_reaches_nothing() {
    let text = "asm Model import StandardLibrary signature: domain D subsetof Integer controlled a: D controlled b: D\n\
                definitions: domain D = {0:2} main rule r_Main = par if a = 0 then a := 2 endif b := 1 endpar\n\
                default init s0: function a = chooseone({0, 2}) function b = 0";
    let mut tests = generate_of(text, &Options::default());
    let mut loader = Texts::of([("Model.asm", text)]);
    let (mut trial, mut kept) = (Trial::default(), Vec::new());
    for index in 0..tests.scenarios.len() {
        let source = SourceFile::new("x.avalla", tests.scenarios[index].text.as_str());
        let shown = trial.shown(&tests.scenarios[index], &source, &mut loader, &Limits::default());
        kept.extend(shown.is_some_and(|shown| tests.settle(index, shown, &kept)).then_some(index));
    }
    let reached = tests.reached_by(&kept);
    let told: Vec<(GoalKind, bool, bool)> =
        tests.goals.iter().zip(reached).map(|(goal, reached)| (goal.kind, goal.reached, reached)).collect();
    let (then, none) = (GoalKind::Branch("then"), GoalKind::Branch("no branch"));
    let (rule, update) = (GoalKind::Rule, GoalKind::Update);
    assert_eq!(
        told,
        [(rule, true, true), (none, true, false), (then, true, false), (update, true, false), (update, true, true)]
    );
    assert_eq!(kept.len(), 1, "{kept:?}");
    assert!(tests.scenarios[kept[0]].text.starts_with("// reaches 2 goals\n"), "{}", tests.scenarios[kept[0]].text);
}

#[test]
fn where_invariants_leave_nothing_no_assumption_is_blamed() {
    let text = "asm Model import StandardLibrary signature: controlled a: Boolean definitions: invariant over a: not a\n\
                main rule r_Main = a := not a default init s0: function a = true";
    assert_eq!(generate_of(text, &Options::default()).reasons, [Reason::Unlawful]);
}
