//! Generated scenarios pass, and together they cover what was said to be reached. Goals and scenario coverage are
//! counted by different code and must agree goal by goal.

use std::collections::BTreeSet;
use std::path::{Path, PathBuf};
use std::sync::Arc;

use groundstate::scenario::{FirstCandidate, Items, Options as Scenario};
use groundstate::test_generation::{GoalKind, Method, Subject, Tests, generate_tests};
use groundstate::verify::Options;
use groundstate::{Loaded, Suite};
use syntax::{SourceFile, Span};
use testkit::{Disk, repository};

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
