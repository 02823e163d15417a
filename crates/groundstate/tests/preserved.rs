//! A property that is said to come along by refinement is verified of the concrete machine on its own: none may fail.
//!
//! Random pairs of small machines, coupled in ways that differ in what they let through: hidden functions, mirrored ones, diagrams of
//! several steps on either side, segments, waiting, assumptions that leave states without steps. Each abstract machine has random
//! invariants and formulas of CTL and LTL. `GROUNDSTATE_FULL` takes ten times as many pairs.

#![allow(clippy::disallowed_methods, reason = "a test reads the environment")]

use std::collections::BTreeMap;
use std::sync::Arc;

use groundstate::program::PropertyKind;
use groundstate::refine::{Coupling, Preserved, Verdict, refine};
use groundstate::verify::runs::Why;
use groundstate::verify::{Options, Outcome, Subject, verify};
use groundstate::{Loaded, load, verify_preserved};
use machine::Limits;
use syntax::SourceFile;
use testkit::{NoFiles, Random};

/// The text of a main rule over `n` in 0..2, a flag `h`, a function `f` and an input. Writes begin with `:=`, so that they can be mapped.
fn rule(random: &mut Random) -> String {
    let updates = [
        "skip",
        "h := not h",
        "choose $x in N with true do n := $x",
        "choose $x in N with $x != n do n := $x",
        "par n := (n + 1) mod 3 h := not h endpar",
        "par n := 1 h := true endpar",
        "n := (n + 1) mod 3",
        "n := 0",
        "n := 2",
        "par n := (n + 1) mod 3 f(n) := not f(n) endpar",
        "par f(n) := h h := not h endpar",
    ];
    // Machines that go on by themselves, so that something must happen.
    let goes_on = [
        "n := (n + 1) mod 3",
        "if n = 2 then n := 1 else n := (n + 1) mod 3 endif",
        "if h then par n := (n + 1) mod 3 h := false endpar else h := true endif",
        "if n = 2 then par n := 0 h := not h endpar else n := (n + 1) mod 3 endif",
        "choose $x in N with $x != n do n := $x",
    ];
    if random.below(3) == 0 {
        return random.pick(&goes_on).to_string();
    }
    let guards = ["go", "h", "go and h", "n = 1", "n != 2 or go", "not h and n < 2", "f(1)"];
    let mut text = random.pick(&updates).to_string();
    for _ in 0..=random.below(3) {
        text = format!("if {} then {} else {text} endif", random.pick(&guards), random.pick(&updates));
    }
    text
}

/// The same rule with a word changed, or with a step put in between.
fn changed(random: &mut Random, rule: &str) -> String {
    let swaps = [
        ("h := not h", "skip"),
        ("skip", "h := not h"),
        ("with true", "with $x != 1"),
        ("go and h", "go"),
        ("$x != n", "$x = (n + 1) mod 3"),
        ("not h and", "h and"),
        ("n := 2", "n := 1"),
        ("f(n) := not f(n)", "skip"),
        ("(n + 1)", "(n + 2)"),
    ];
    match random.below(7) {
        0 => format!("if not w then w := true else par w := false {rule} endpar endif"),
        // In between `n` is what corresponds to nothing.
        1 => format!(
            "if not w then par w := true n := (n + 1) mod 3 endpar \
             else seq par w := false n := (n + 2) mod 3 endpar {rule} endseq endif"
        ),
        2 => rule.to_string(),
        // It waits for something outside.
        3 => format!("if go then {rule} else skip endif"),
        _ => {
            let (from, to) = swaps[random.below(swaps.len() as u64) as usize];
            rule.replacen(from, to, 1)
        }
    }
}

/// What properties often look like.
const FORMS: [&str; 18] = [
    "CTLSPEC ag(@P implies af(@Q))",
    "CTLSPEC af(@P)",
    "CTLSPEC au(@P, @Q)",
    "CTLSPEC aw(@P, @Q)",
    "CTLSPEC not eg(@P)",
    "CTLSPEC not eu(@P, @Q)",
    "CTLSPEC not ew(@P, @Q)",
    "CTLSPEC ap(@P, @Q)",
    "CTLSPEC ag(@P implies ax(@Q))",
    "CTLSPEC absenceBetween(@P, @Q, n = 0)",
    "LTLSPEC g(@P implies f(@Q))",
    "LTLSPEC f(@P)",
    "LTLSPEC u(@P, @Q)",
    "LTLSPEC v(@P, @Q)",
    "LTLSPEC not g(@P)",
    "LTLSPEC not v(@P, @Q)",
    "LTLSPEC not u(@P, @Q)",
    "LTLSPEC g(@P implies o(@Q))",
];

const PREDICATES: [&str; 14] = [
    "n = 0",
    "n = 1",
    "n != 1",
    "n < 2",
    "n = 2",
    "n + 1 > 1",
    "h",
    "not h",
    "d",
    "f(1)",
    "(forall $i in N with f($i) implies n < 2)",
    "(exists $i in N with $i = n and not f($i))",
    "go",
    "if n = 2 then h else true endif",
];

fn predicate(random: &mut Random) -> String {
    let one = random.pick(&PREDICATES);
    match random.below(4) {
        0 => format!("({one} and {})", random.pick(&PREDICATES)),
        1 => format!("({one} or {})", random.pick(&PREDICATES)),
        2 => format!("(not ({one}))"),
        _ => format!("({one})"),
    }
}

/// A formula of the logic whose operators these are: with one operand and with two.
fn formula(random: &mut Random, depth: u32, one: &[&str], two: &[&str]) -> String {
    if depth == 0 {
        return predicate(random);
    }
    let part = |random: &mut Random| {
        let depth = random.below(u64::from(depth)) as u32;
        formula(random, depth, one, two)
    };
    match random.below(8) {
        0 => format!("(not {})", part(random)),
        1 => format!("({} and {})", part(random), part(random)),
        2 => format!("({} implies {})", part(random), part(random)),
        3 | 4 => format!("{}({}, {})", random.pick(two), part(random), part(random)),
        _ => format!("{}({})", random.pick(one), part(random)),
    }
}

/// Properties of which many hold of some machine.
fn properties(random: &mut Random) -> String {
    let ctl = (["ag", "ag", "ag", "af", "ef", "eg", "ax", "absenceG"], ["au", "aw", "eu", "ap", "absenceAfter"]);
    let ltl = (["g", "g", "g", "f", "f", "x", "h", "o", "y"], ["u", "v", "s", "t"]);
    let mut text = String::new();
    for _ in 0..8 {
        text.push_str(&format!("invariant over n: {} or {}\n", predicate(random), predicate(random)));
    }
    let mut plain = |form: &str, random: &mut Random| {
        let mut filled = form.to_string();
        for mark in ["@P", "@Q"] {
            filled = filled.replace(mark, random.pick(&PREDICATES[..5]));
        }
        text.push_str(&format!("{filled}\n"));
    };
    for form in FORMS {
        plain(form, random);
        plain(form, random);
    }
    for _ in 0..8 {
        let depth = 1 + random.below(3) as u32;
        text.push_str(&format!("CTLSPEC {}\n", formula(random, depth, &ctl.0, &ctl.1)));
        text.push_str(&format!("LTLSPEC {}\n", formula(random, depth, &ltl.0, &ltl.1)));
    }
    text
}

/// How the two machines are coupled, and how the functions of the concrete one stand for those of the abstract one.
#[derive(Debug, Clone, Copy)]
struct Way {
    coupling: &'static str,
    /// The concrete machine has `2 - n` for `n`.
    mirrored: bool,
}

const WAYS: [Way; 19] = [
    Way {
        coupling: "couple (abstract.n = 0) = (concrete.n = 0); couple (abstract.n = 2) = (concrete.n = 2); couple (forall $i in N with (not abstract.f($i)) = not concrete.f($i));",
        mirrored: false,
    },
    Way { coupling: "same n; segment not concrete.w and concrete.n != 0;", mirrored: false },
    Way { coupling: "couple abstract.n = concrete.n and not concrete.w; diagrams 0..1:1..2;", mirrored: false },
    Way { coupling: "same n;", mirrored: false },
    Way { coupling: "same n, h;", mirrored: false },
    Way { coupling: "same n, h, f;", mirrored: false },
    Way { coupling: "same n, f; allow waiting;", mirrored: false },
    Way { coupling: "same n; fair concrete.go;", mirrored: false },
    Way { coupling: "same n, h; fair concrete.go or concrete.h; diagrams 0..1:1..2;", mirrored: false },
    Way { coupling: "same n, h; diagrams 1:1;", mirrored: false },
    Way { coupling: "same n; diagrams 0..2:1..2;", mirrored: false },
    Way { coupling: "same n; diagrams 0..2:1;", mirrored: false },
    Way { coupling: "same n; diagrams 2:1, 1:1;", mirrored: false },
    Way { coupling: "same n, h; segment not concrete.w;", mirrored: false },
    Way { coupling: "same n, h, f; segment not concrete.w; diagrams 1:1..2;", mirrored: false },
    Way { coupling: "same n; segment concrete.n != 1 or concrete.h;", mirrored: false },
    Way { coupling: "couple abstract.n = 2 - concrete.n; same h;", mirrored: true },
    Way {
        coupling: "couple 2 - concrete.n = abstract.n and (abstract.d iff (concrete.n = 2 or concrete.h)); diagrams 0..2:1..2;",
        mirrored: true,
    },
    Way {
        coupling: "couple abstract.n = 2 - concrete.n; couple (forall $i in N with abstract.f($i) = concrete.f($i));",
        mirrored: true,
    },
];

fn machine_of(rule: &str, first: &str, properties: &str) -> Loaded {
    let text = format!(
        "asm M\nimport StandardLibrary\nimport CTLLibrary\nimport LTLLibrary\nsignature:\ndomain N subsetof Integer\n\
         monitored go: Boolean\ncontrolled n: N\ncontrolled h: Boolean\ncontrolled w: Boolean\ncontrolled f: N -> Boolean\n\
         derived d: Boolean\ndefinitions:\ndomain N = {{0:2}}\nfunction d = n = 0 or h\n{properties}main rule r_Main = {rule}\n\
         default init s0: function n = {first} function h = false function w = false function f($i in N) = false\n"
    );
    load(SourceFile::new("M.asm", text), &mut NoFiles).unwrap_or_else(|faulty| panic!("{:#?}", faulty.diagnostics))
}

/// The rule with `2 - n` for `n`.
fn mirrored(rule: &str) -> String {
    let mut text = String::new();
    for word in rule.split(' ') {
        let mapped = match word {
            "n" => "(2 - n)".to_string(),
            "(n" => "((2 - n)".to_string(),
            _ => word.replace("f(n)", "f((2 - n))"),
        };
        text.push_str(&mapped);
        text.push(' ');
    }
    // What is written is a number below 3, or a variable over such numbers, in front of the next word.
    let mut mapped = String::new();
    let mut rest = text.as_str();
    while let Some((before, after)) = rest.split_once("(2 - n) := ") {
        let end = match after.strip_prefix("((2 - n) + 1) mod 3") {
            Some(left) => after.len() - left.len(),
            None => after.find(' ').unwrap_or(after.len()),
        };
        mapped.push_str(&format!("{before}n := 2 - ({})", &after[..end]));
        rest = &after[end..];
    }
    mapped + rest
}

/// What is found of the properties of a kind: how many come along, hold of the abstract machine, and were verified of the concrete one.
#[derive(Debug, Default)]
struct Counts {
    pairs: u64,
    refines: u64,
    verified: BTreeMap<String, u64>,
    stay: BTreeMap<String, u64>,
}

#[test]
fn what_comes_along_holds_of_the_concrete_machine() {
    let cases = if testkit::sample::is_full() { 6000 } else { 600 };
    let mut counts = Counts::default();
    for seed in 0..cases {
        let mut random = Random(seed * 7919 + 3);
        let way = WAYS[seed as usize % WAYS.len()];
        one_pair(&mut random, way, seed, &mut counts);
    }
    // A sample in which nothing happens would say nothing.
    assert!(counts.refines * 5 > counts.pairs, "{counts:?}");
    for kind in [
        "invariant",
        "invariant at segments",
        "ag",
        "g",
        "af",
        "f",
        "aw",
        "u",
        "ax",
        "x",
        "ag at segments",
        "f at segments",
    ] {
        assert!(counts.verified.get(kind).is_some_and(|count| *count >= 3), "{kind}: {counts:#?}");
    }
    for why in [
        "some run",
        "next step",
        "several abstract steps",
        "something must happen",
        "fair",
        "does not determine",
        "no `segment`",
    ] {
        let stays = counts.stay.iter().any(|(reason, count)| reason.contains(why) && *count >= 3);
        assert!(stays, "{why}: {:#?}", counts.stay);
    }
}

fn one_pair(random: &mut Random, way: Way, seed: u64, counts: &mut Counts) {
    let abstractly = rule(random);
    let mut concretely = changed(random, &abstractly);
    let assumed = |random: &mut Random| if random.below(8) == 0 { "INVAR n != 1 or not h\n" } else { "" };
    let mut said = properties(random);
    said.push_str(assumed(random));
    if random.below(12) == 0 {
        said.push_str("JUSTICE h\n");
    }
    let mut besides = assumed(random).to_string();
    // A machine that waits, and says that it does not wait for ever; or says so of something else.
    if random.below(4) == 0 {
        concretely = format!("if {} then {abstractly} endif", random.pick(&["go", "go or h"]));
    }
    if random.below(3) == 0 {
        besides.push_str(random.pick(&[
            "JUSTICE go\n",
            "JUSTICE go or w\n",
            "JUSTICE h\n",
            "JUSTICE go JUSTICE not h\n",
        ]));
    }
    let first = if way.mirrored { "2" } else { "0" };
    if way.mirrored {
        concretely = mirrored(&concretely);
    }
    let (one, other) = (machine_of(&abstractly, "0", &said), machine_of(&concretely, first, &besides));
    let of = |what: &str| {
        format!("seed {seed}: {what}\n{}\nabstract {abstractly}\nconcrete {concretely}\n{said}{besides}", way.coupling)
    };
    counts.pairs += 1;
    let text = Some(SourceFile::new("c.refine", way.coupling));
    let coupling = Coupling::new([&one.program, &other.program], text, &Limits::default());
    let coupling = coupling.unwrap_or_else(|faulty| panic!("{}", of(&format!("{:#?}", faulty.faults))));
    let report = refine(&coupling, &Default::default(), &mut |_| true).expect("it begins");
    if report.verdict != Verdict::Refines {
        assert!(report.properties.is_empty(), "{}", of("something comes along without a refinement"));
        return;
    }
    counts.refines += 1;
    let found = verify_preserved(&one.program, &report.properties, &Options::default(), &mut |_| true);
    let found = found.expect("it begins");
    let mut overlay = other.overlay();
    let mut claimed: Vec<&Preserved> = Vec::new();
    for property in &report.properties {
        match &property.form {
            Ok(form) if found[&property.property] == Outcome::Holds => {
                overlay
                    .property(property.kind, "form", form)
                    .unwrap_or_else(|faults| panic!("{}", of(&format!("{form}: {faults:#?}"))));
                claimed.push(property);
            }
            Ok(_) => {}
            Err(why) => *counts.stay.entry(why.clone()).or_default() += 1,
        }
    }
    let verified = verify(&Arc::clone(&overlay.program), &Options::default(), &mut |_| true).expect("it begins");
    let own = other.program.properties.len();
    for verdict in verified.verdicts {
        let Subject::Property(index) = verdict.subject else { continue };
        let Some(property) = index.checked_sub(own).map(|place| claimed[place]) else { continue };
        let form = property.form.as_ref().expect("it comes along");
        let why = verified.runs.get(&index);
        // Of no fair run nothing is said; and where assumptions end a run there are no inputs, which fairness may be about.
        let open = matches!(why, Some(Why::NoFairRun | Why::Unexplored(None)));
        if open && besides.contains("JUSTICE") {
            continue;
        }
        assert_eq!(verdict.outcome, Outcome::Holds, "{}", of(&format!("{form}\nfrom {:?}\n{why:?}", property.kind)));
        let at = if way.coupling.contains("segment") && form.contains(" implies ") { " at segments" } else { "" };
        match property.kind {
            PropertyKind::Invariant => *counts.verified.entry(format!("invariant{at}")).or_default() += 1,
            _ => {
                for operator in ["ag", "af", "aw", "au", "ax", "g", "f", "u", "x", "v", "s"] {
                    let called = format!("{operator}(");
                    let stands = form.starts_with(&called)
                        || form.contains(&format!("({called}"))
                        || form.contains(&format!(" {called}"));
                    if stands {
                        let segment = way.coupling.contains("segment") && form.contains("not w");
                        let at = if segment { " at segments" } else { "" };
                        *counts.verified.entry(format!("{operator}{at}")).or_default() += 1;
                    }
                }
            }
        }
    }
}
