//! With symmetry reduction the verdicts are those of all states, and runs are real ones.
//!
//! `GROUNDSTATE_CASES` sets how many random models (a few seconds' worth if absent), `GROUNDSTATE_SEED` the first seed.

#![allow(clippy::disallowed_methods, reason = "a test reads the repository's own models")]

use std::collections::BTreeMap;
use std::fmt::Write;
use std::sync::Arc;

use machine::{Location, Show, Value};
use program::Program;
use syntax::SourceFile;
use testkit::{Random, repository, sample};
use verify::{Distinct, EngineKind, Options, Outcome, Report, Storage, Subject, Symmetry, Trace, verify};

use crate::models::{Disk, lowered};

fn check(program: &Arc<Program>, options: &Options) -> Report {
    verify(program, options, &mut |_| true).expect("there is an initial state")
}

/// Each step of a run begins in the state that the previous one led to.
fn is_a_run(trace: &Trace) {
    let mut values: BTreeMap<&Location, &Value> =
        trace.values.iter().map(|(location, value)| (location, value)).collect();
    for change in trace.steps.iter().flat_map(|step| &step.changes) {
        // A location with an initial value may appear later.
        let before = values.insert(&change.location, &change.after);
        assert!(before.is_none_or(|before| *before == change.before));
    }
}

/// For each subject: the number of steps to a violation, or H or U.
fn verdicts(report: &Report) -> Vec<(Subject, String)> {
    let each = report.verdicts.iter().map(|verdict| match &verdict.outcome {
        Outcome::Holds => (verdict.subject, "H".to_string()),
        Outcome::Violated(trace) => {
            is_a_run(trace);
            let fault = trace.steps.last().is_some_and(|step| step.fault.is_some());
            (verdict.subject, format!("{} {fault}", trace.steps.len()))
        }
        Outcome::Unknown(_) => (verdict.subject, "U".to_string()),
    });
    each.collect()
}

/// The number of all states, and of their representatives; verdicts must be equal, and runs as short.
fn agrees(program: &Arc<Program>, text: &str) -> (u64, u64, Symmetry) {
    let options = Options { engine: EngineKind::Explicit, ..Options::default() };
    let whole = check(program, &options);
    let reduced = Options { symmetry: true, ..options };
    let mut reports = Vec::new();
    for workers in [1, 2] {
        let report = check(program, &Options { workers, ..reduced.clone() });
        assert_eq!(verdicts(&report), verdicts(&whole), "{text}");
        assert_eq!(report.unreachable, whole.unreachable, "{text}");
        assert_eq!(report.complete, whole.complete);
        assert!(report.progress.states <= whole.progress.states, "{text}");
        if report.symmetry.as_ref().is_some_and(|symmetry| symmetry.classes.is_empty()) {
            let counts = |report: &Report| verify::Progress { bytes: 0, ..report.progress };
            assert_eq!(counts(&report), counts(&whole), "{text}");
        }
        reports.push(report);
    }
    assert_eq!(reports[0].verdicts, reports[1].verdicts, "{text}");
    assert_eq!(reports[0].progress.states, reports[1].progress.states, "{text}");
    // Runs are found by repeating the search.
    let compact = check(program, &Options { storage: Storage::Compact, ..reduced });
    for (verdict, other) in verdicts(&compact).iter().zip(verdicts(&whole)) {
        assert!(verdict.1 == "U" || *verdict == other, "{text}");
    }
    let symmetry = reports.remove(0).symmetry.expect("it was asked for");
    (whole.progress.states, reports[0].progress.states, symmetry)
}

/// The classes as text, and the domains without one.
fn told(program: &Program, symmetry: &Symmetry) -> String {
    let mut text = String::new();
    for (domain, class) in &symmetry.classes {
        let elements: Vec<_> = class.iter().map(|element| element.show(program).to_string()).collect();
        let _ = write!(text, "{} {}; ", program.domain(*domain).name, elements.join(" "));
    }
    for (domain, distinct) in &symmetry.distinct {
        let why = match distinct {
            Distinct::Named(_) => "named",
            Distinct::Told(_) => "told",
            Distinct::Bounded(_) => "bounded",
            Distinct::Extended(_) => "extended",
            Distinct::Ordered(_) => "ordered",
            Distinct::Subsets => "subsets",
            Distinct::Packed => "packed",
        };
        let _ = write!(text, "{}: {why}; ", program.domain(*domain).name);
    }
    text.trim_end_matches("; ").to_string()
}

/// A model with this many clients at a lock.
fn lock(clients: usize) -> String {
    let names: Vec<String> = (1..=clients).map(|client| format!(" static c{client}: Client\n")).collect();
    format!(
        "asm Lock\nimport StandardLibrary\nsignature:\n abstract domain Client\n enum domain Mode = {{IDLE | WANTS | USES}}\n \
         controlled mode: Client -> Mode\n controlled owner: Client\n controlled served: Client -> Boolean\n{}definitions:\n \
         rule r_Client($c in Client) =\n  switch mode($c)\n   case IDLE: mode($c) := WANTS\n   \
         case WANTS: if owner = undef then par owner := $c mode($c) := USES endpar endif\n   \
         case USES: par owner := undef mode($c) := IDLE served($c) := true endpar\n  endswitch\n \
         invariant inv_alone over mode: not (exist $a in Client, $b in Client with $a != $b and mode($a) = USES and mode($b) = USES)\n \
         invariant inv_owner over owner: (forall $c in Client with (mode($c) = USES iff owner = $c))\n \
         invariant inv_all over served: (exist $c in Client with not served($c))\n \
         main rule r_Main = choose $c in Client with true do r_Client[$c]\ndefault init s0:\n \
         function mode($c in Client) = IDLE\n function served($c in Client) = false\n",
        names.concat()
    )
}

#[test]
fn clients_at_a_lock_are_interchangeable() {
    for clients in [3, 5] {
        let text = lock(clients);
        let program = lowered(SourceFile::new("Lock.asm", text.clone()));
        let (whole, reduced, symmetry) = agrees(&program, &text);
        // Each client idles or wants, and was served or not; one may have the lock.
        let n = clients as u64;
        let four = 4u64.pow(clients as u32);
        assert_eq!(whole, four + n * 2 * four / 4);
        // The number of each of the four kinds, with and without an owner of one of two kinds.
        let of = |n: u64| (n + 1) * (n + 2) * (n + 3) / 6;
        assert_eq!(reduced, of(n) + 2 * of(n - 1));
        let names: Vec<String> = (1..=clients).map(|client| format!("c{client}")).collect();
        assert_eq!(told(&program, &symmetry), format!("Client {}; Mode: named", names.join(" ")));
    }
    let program = lowered(SourceFile::new("Lock.asm", lock(12)));
    let report = check(&program, &Options { symmetry: true, ..Options::default() });
    // Of 4¹² + 24·4¹¹ states.
    assert_eq!(report.progress.states, 13 * 14 * 15 / 6 + 2 * 12 * 13 * 14 / 6);
    let Outcome::Violated(trace) = &report.verdicts[6].outcome else { panic!("all are served in the end") };
    assert_eq!(trace.steps.len(), 36);
}

/// A model with elements of an abstract domain, and what its rules, its invariant and its initial state are.
fn model(signature: &str, definitions: &str, main: &str, init: &str) -> String {
    format!(
        "asm M\nimport StandardLibrary\nsignature:\n abstract domain Part\n domain Count subsetof Integer\n \
         controlled count: Part -> Count\n controlled total: Integer\n static p1: Part\n static p2: Part\n static p3: Part\n{signature}\n\
         definitions:\n domain Count = {{0 : 3}}\n{definitions}\n main rule r_Main = {main}\ndefault init s0:\n \
         function count($p in Part) = 0\n function total = 0\n{init}\n"
    )
}

const STEP: &str = "choose $p in Part with count($p) < 3 do count($p) := count($p) + 1";

#[track_caller]
fn judge(text: &str, expected: &str) -> (u64, u64) {
    let program = lowered(SourceFile::new("M.asm", text));
    let (whole, reduced, symmetry) = agrees(&program, text);
    assert_eq!(told(&program, &symmetry), expected, "{text}");
    (whole, reduced)
}

#[test]
fn elements_that_are_told_apart_are_not_interchangeable() {
    let all = "Part p1 p2 p3";
    assert_eq!(judge(&model("", "", STEP, ""), all), (64, 20));
    // Initial states may name elements: permuted initial states are equivalent.
    let named = "if $p = p1 then 1 else 0 endif";
    assert_eq!(
        judge(&model("", "", STEP, "").replace("count($p in Part) = 0", &format!("count($p in Part) = {named}")), all),
        (48, 19)
    );
    // If one element is named, the others are interchangeable, as long as there are two.
    assert_eq!(judge(&model("", " invariant inv_p over count: count(p1) < 4", STEP, ""), "Part p2 p3"), (64, 40));
    assert_eq!(
        judge(&model("", " invariant inv_p over count: count(p1) < 4 or count(p2) = 0", STEP, ""), "Part: named"),
        (64, 64)
    );
    let derived = " function first($p in Part) = ($p = p1 or $p = p2)\n invariant inv_p over count: (forall $p in Part with first($p) or count($p) < 4)";
    judge(&model(" static first: Part -> Boolean", derived, STEP, ""), "Part: named");
    // A rule as a value names an element.
    let by_value = " rule r_First = count(p1) := 1\n";
    let signature = " controlled todo: Rule";
    let run = "par choose $p in Part with count($p) < 3 and $p != undef do count($p) := count($p) + 1 if total = 7 then todo[] endif endpar";
    judge(&model(signature, by_value, run, " function todo = <<r_First>>"), "Part p2 p3");
    // This reveals an order.
    let list = " invariant inv_p over count: first(asSequence({$p in Part | count($p) < 4 : $p})) != undef";
    judge(&model("", list, STEP, ""), "Part: told");
    let text = " invariant inv_p over count: (forall $p in Part with toString($p) != \"p2\" or count($p) < 3)";
    judge(&model("", text, STEP, ""), "Part: told");
    let sequence = " invariant inv_p over count: length([$p in Part | count($p) < 4 : count($p)]) = 3";
    judge(&model("", sequence, STEP, ""), "Part: told");
    let extend = "choose $p in Part with count($p) < 3 do par count($p) := count($p) + 1 if total = 0 then extend Thing with $t do total := 1 endif endpar";
    judge(&model(" dynamic abstract domain Thing", "", extend, ""), "Part: extended");
}

#[test]
fn faults_that_depend_on_the_order_of_elements_are_met() {
    // The quantifier stops at the first that has 2; one after it would divide by zero.
    let faulty = "if (exist $p in Part with 4 / count($p) = 2.0) then skip else choose $p in Part with count($p) < 3 do count($p) := count($p) + 1 endif";
    judge(&model("", "", faulty, "").replace("count($p in Part) = 0", "count($p in Part) = 1"), "Part p1 p2 p3");
    let (whole, reduced) = judge(
        &model("", "", faulty, "")
            .replace("count($p in Part) = 0", "count($p in Part) = if $p = p2 then 2 else 0 endif"),
        "Part: ordered",
    );
    assert_eq!(whole, reduced);
    // Two kinds of faults below a `forall`: which comes first depends on the order.
    let forall = "forall $p in Part with true do par count($p) := count($p) + 1 if count($p) = 3 then total := 1 / (count($p) - 3) endif endpar";
    let forall =
        forall.replace("total := 1 / (count($p) - 3)", "total := 1 div (count($p) - 3)").replace("1 div", "6 mod");
    judge(&model("", "", &forall, ""), "Part: ordered");
    // A choice makes one alternative per element, each with its own faults.
    let choice = "choose $p in Part with true do count($p) := count($p) + 1";
    assert_eq!(judge(&model("", "", choice, ""), "Part p1 p2 p3"), (64, 20));
    // An assumption that is false for one element and has no value for another.
    let assumed = " INVAR (forall $p in Part with 6 mod (count($p) - 2) = 0 and count($p) < 3)";
    let initial = "count($p in Part) = if $p = p1 then 2 else 3 endif";
    judge(&model("", assumed, STEP, "").replace("count($p in Part) = 0", initial), "Part: ordered");
}

#[test]
fn elements_stand_in_all_kinds_of_values() {
    let all = "Part p1 p2 p3";
    let sets = judge(
        &model(
            " controlled chosen: Powerset(Part)",
            " invariant inv_c over chosen: size(chosen) < 3",
            "choose $p in Part with notin(chosen, $p) do chosen := including(chosen, $p)",
            " function chosen = {}",
        ),
        all,
    );
    assert_eq!(sets, (8, 4));
    let sequences = judge(
        &model(
            " controlled line: Seq(Part)",
            " invariant inv_l over line: length(line) < 3",
            "choose $p in Part with not contains(line, $p) do line := append(line, $p)",
            " function line = []",
        ),
        all,
    );
    assert_eq!(sequences, (16, 4));
    let next = judge(
        &model(
            " controlled next: Part -> Part",
            " invariant inv_n over next: (exist $p in Part with next($p) = undef)",
            "choose $p in Part, $q in Part with next($p) = undef do next($p) := $q",
            "",
        ),
        all,
    );
    // Partial functions on three elements, and their number up to isomorphism.
    assert_eq!(next, (64, 16));
    let relation = judge(
        &model(
            " controlled knows: Prod(Part, Part) -> Boolean",
            " invariant inv_k over knows: (exist $p in Part, $q in Part with not knows($p, $q))",
            "choose $p in Part, $q in Part with not knows($p, $q) do knows($p, $q) := true",
            " function knows($p in Part, $q in Part) = false",
        ),
        all,
    );
    // Directed graphs with loops on three vertices, and their number up to isomorphism.
    assert_eq!(relation, (512, 104));
    let numbers = judge(
        &model(
            " controlled sum: Part -> Integer",
            " invariant inv_s over sum: (forall $p in Part with sum($p) < 4)",
            "choose $p in Part with sum($p) < 4 do sum($p) := sum($p) + 2",
            " function sum($p in Part) = 0",
        ),
        all,
    );
    assert_eq!(numbers, (27, 10));
    let sparse = judge(
        &model(
            " controlled of: Powerset(Part) -> Part",
            " invariant inv_o over of: isUndef(of({}))",
            "choose $p in Part, $q in Part with isUndef(of({$q})) do of({$q}) := $p",
            "",
        ),
        all,
    );
    assert_eq!(sparse, (64, 16));
    let maps = judge(
        &model(
            " controlled map: Map(Part, Part)",
            " invariant inv_m over map: size(map) < 3",
            "choose $p in Part, $q in Part with isUndef(at(map, $p)) do map := assign(map, $p, $q)",
            " function map = {->}",
        ),
        all,
    );
    assert_eq!(maps, (64, 16));
    let inputs = judge(
        &model(
            " monitored who: Part\n monitored go: Part -> Boolean",
            "",
            "par if count(who) < 3 then count(who) := count(who) + 1 endif if (exist $p in Part with go($p)) then total := 1 endif endpar",
            "",
        ),
        all,
    );
    assert_eq!(inputs, (127, 39));
}

#[test]
fn agents_of_one_subset_and_literals_are_interchangeable_too() {
    let agents = "asm Agents\nimport StandardLibrary\nsignature:\n domain Client subsetof Agent\n domain Server subsetof Agent\n \
        domain Count subsetof Integer\n controlled asked: Client -> Count\n controlled busy: Server -> Client\n static a: Client\n \
        static b: Client\n static c: Client\n static s: Server\n static t: Server\ndefinitions:\n domain Count = {0 : 2}\n \
        rule r_Client = if asked(self) < 2 then asked(self) := asked(self) + 1 endif\n \
        rule r_Server = if busy(self) = undef then choose $c in Client with asked($c) > 0 do par busy(self) := $c asked($c) := asked($c) - 1 endpar else busy(self) := undef endif\n \
        invariant inv_one over busy: (forall $x in Server, $y in Server with ($x != $y implies (busy($x) != busy($y) or busy($x) = undef)))\n \
        main rule r_Main = choose $a in Agent with true do program($a)\ndefault init s0:\n function asked($c in Client) = 0\n \
        agent Client: r_Client[]\n agent Server: r_Server[]\n";
    let program = lowered(SourceFile::new("Agents.asm", agents));
    let (whole, reduced, symmetry) = agrees(&program, agents);
    assert_eq!(told(&program, &symmetry), "Agent a b c; Agent s t");
    assert!(reduced * 6 < whole, "{whole} {reduced}");
    let literals = model("", "", STEP, "").replace("abstract domain Part", "enum domain Part = {PA | PB | PC}");
    let literals: String =
        literals.lines().filter(|line| !line.contains("static")).map(|line| format!("{line}\n")).collect();
    assert_eq!(judge(&literals, "Part PA PB PC"), (64, 20));
}

#[test]
fn the_repositorys_models_have_the_same_verdicts() {
    let root = repository::root();
    for (path, expected) in [
        ("bench/models/verify/Swing.asm", None),
        ("bench/models/verify/SwingUnlocked.asm", None),
        ("bench/models/verify/ChainXS.asm", None),
        ("examples/production_cell/ProductionCell.asm", None::<&str>),
    ] {
        let program = lowered(Disk::read(&root.join(path)).expect("the model is there"));
        let options = Options { engine: EngineKind::Explicit, max_states: 200_000, ..Options::default() };
        let whole = check(&program, &options);
        let reduced = check(&program, &Options { symmetry: true, ..options });
        if whole.complete {
            assert_eq!(verdicts(&reduced), verdicts(&whole), "{path}");
        }
        if let Some(expected) = expected {
            assert_eq!(told(&program, &reduced.symmetry.expect("it was asked for")), expected);
        }
    }
}

/// A model over an abstract domain, whose elements occur in all kinds of values and are sometimes distinguished.
fn random_model(seed: u64) -> String {
    let mut random = Random(seed.wrapping_mul(0x9e37_79b9_7f4a_7c15) + 1);
    let mut text = String::from(
        "asm Parts\nimport StandardLibrary\nsignature:\n abstract domain Part\n enum domain Mode = {ON | OFF}\n \
         domain Count subsetof Integer\n controlled mode: Part -> Mode\n controlled count: Part -> Count\n \
         controlled next: Part -> Part\n controlled owner: Part\n controlled group: Powerset(Part)\n \
         controlled line: Seq(Part)\n controlled likes: Prod(Part, Part) -> Boolean\n monitored who: Part\n \
         monitored wind: Boolean\n derived free: Part -> Boolean\n static p1: Part\n static p2: Part\n static p3: Part\n\
         definitions:\n domain Count = {0 : 2}\n function free($p in Part) = owner != $p and notin(group, $p)\n",
    );
    let conditions = [
        "mode($p) = ON",
        "count($p) < 2",
        "free($p)",
        "owner = undef",
        "contains(group, $p)",
        "next($p) = $p",
        "(exist $q in Part with likes($p, $q))",
        "(forall $q in Part with (mode($q) = ON or $q = $p))",
        "(exist unique $q in Part with count($q) = 1)",
        "(exist $q in group with count($q) > 0)",
        "true",
        "wind",
        "who = $p",
        "(exist $q in Part with 2 mod count($q) = 0)",
        "count(next($p)) > 0",
        "size(group) < 2",
    ];
    let actions = [
        "mode($p) := ON",
        "mode($p) := OFF",
        "count($p) := (count($p) + 1) mod 3",
        "count($p) := count($p) + 1",
        "next($p) := owner",
        "owner := $p",
        "owner := undef",
        "next($p) := who",
        "group := including(group, $p)",
        "group := excluding(group, $p)",
        "if length(line) < 2 then line := append(line, $p) endif",
        "line := tail(line)",
        "choose $q in Part with $q != $p do likes($p, $q) := not likes($p, $q)",
        "forall $q in Part with mode($q) = ON do count($q) := 0",
        "forall $q in Part with free($q) do next($q) := $p",
        "forall $q in group with true do mode($q) := OFF",
        "skip",
        "seq count($p) := 1 owner := $p endseq",
    ];
    let more = ["", "", "", "owner := p1", "if $p = p2 then skip endif"];
    for rule in ["A", "B"] {
        let (condition, one, other) = (random.pick(&conditions), random.pick(&actions), random.pick(&actions));
        let (otherwise, more) = (random.pick(&actions), if random.below(4) == 0 { random.pick(&more) } else { "" });
        let _ = writeln!(
            text,
            " rule r_{rule}($p in Part) = if {condition} then par {one} {other} {more} endpar else {otherwise} endif"
        );
    }
    let invariants = [
        "(exist $p in Part with mode($p) = OFF)",
        "(forall $p in Part with (count($p) < 2 or mode($p) = ON))",
        "owner = undef or mode(owner) = ON",
        "size(group) < 3",
        "(forall $p in Part, $q in Part with (likes($p, $q) implies not likes($q, $p)))",
        "(forall $p in Part with 1 mod (2 - count($p)) < 2)",
        "count(p3) < 2",
        "length(line) < 2 or first(line) != last(line)",
        "true",
    ];
    let _ = writeln!(text, " invariant inv_a over owner: {}", random.pick(&invariants));
    let _ = writeln!(text, " invariant inv_b over owner: {}", random.pick(&invariants));
    if random.below(4) == 0 {
        let _ = writeln!(
            text,
            " INVAR {}",
            random.pick(&["not (size(group) = 2 and owner = undef)", "(forall $p in Part with count($p) < 2)"])
        );
    }
    let main = random.pick(&[
        "choose $p in Part with true do if wind then r_A[$p] else r_B[$p] endif",
        "choose $p in Part with mode($p) = OFF do r_A[$p] ifnone choose $p in Part with true do r_B[$p]",
        "choose $p in Part with wind or mode($p) = ON do r_A[$p] ifnone forall $p in Part with true do r_B[$p]",
        "par choose $p in Part with true do r_A[$p] if wind then let ($p = who) in r_B[$p] endlet endif endpar",
    ]);
    let _ = writeln!(text, " main rule r_Main = {main}");
    let _ = write!(
        text,
        "default init s0:\n function mode($p in Part) = {}\n function count($p in Part) = {}\n function next($p in Part) = {}\n \
         function group = {}\n function line = []\n function likes($p in Part, $q in Part) = false\n{}",
        random.pick(&["OFF", "if $p = p1 then ON else OFF endif"]),
        random.pick(&["0", "1", "if $p = p2 then 1 else 0 endif"]),
        random.pick(&["$p", "p1"]),
        random.pick(&["{}", "{p1}"]),
        random.pick(&["", " function owner = p2\n"]),
    );
    text
}

#[test]
fn random_models_have_the_same_verdicts() {
    let seeds = sample::seeds(80, 600);
    let cases = seeds.end - seeds.start;
    let (mut fewer, mut violated, mut ordered) = (0, 0, 0);
    for seed in seeds {
        let text = random_model(seed);
        let program = lowered(SourceFile::new("Parts.asm", text.clone()));
        let options = Options { engine: EngineKind::Explicit, max_states: 3_000, ..Options::default() };
        if !check(&program, &options).complete {
            continue;
        }
        let (whole, reduced, symmetry) = agrees(&program, &format!("{seed}\n{text}"));
        fewer += u64::from(reduced < whole);
        ordered += u64::from(symmetry.distinct.iter().any(|(_, why)| matches!(why, Distinct::Ordered(_))));
        violated += u64::from(verdicts(&check(&program, &options)).iter().any(|(_, verdict)| verdict.len() > 1));
    }
    assert!(
        fewer > cases / 5 && ordered > 0 && violated > cases / 5,
        "{fewer} with fewer states, {ordered} refused, {violated} violated"
    );
}
