//! The examples of spec/review.md have the findings shown below them. Faults that only reviews find have pages whose
//! examples show them.

use std::fmt::Write;
use std::sync::Arc;

use groundstate::verify::Options;
use groundstate::verify::review::{Meta, MetaOutcome, review};
use groundstate::{REVIEW_IDS, diagnose_finding};
use syntax::SourceFile;
use testkit::{NoFiles, Page};

/// The findings for a model: the outcome of each meta-property, then line and kind of each finding.
fn findings(text: &str) -> String {
    let name = text.split_whitespace().nth(1).expect("it begins with `asm` and its name");
    let loaded = groundstate::load(SourceFile::new(format!("{name}.asm"), text), &mut NoFiles);
    let loaded = loaded.unwrap_or_else(|faulty| panic!("{:#?}", faulty.diagnostics));
    let (root, program) = (loaded.model.root, Arc::clone(&loaded.program));
    let review = review(&loaded.model, &program, &Options::default(), &Meta::ALL, &|file| file == root, &mut |_| true);
    let review = review.unwrap_or_else(|trouble| panic!("{trouble:?}"));
    let mut told = String::new();
    for (meta, outcome) in &review.outcomes {
        let word = match outcome {
            MetaOutcome::Holds => "holds",
            MetaOutcome::Violated => "violated",
            MetaOutcome::Unknown => "unknown",
        };
        let _ = writeln!(told, "MP{} {word}", meta.number());
        for finding in review.findings.iter().filter(|finding| finding.meta == *meta) {
            let diagnostic = diagnose_finding(finding, &review, &program);
            let line = loaded.sources.file(root).line_column(finding.span.start).line;
            let _ = writeln!(told, "  {line} {}", diagnostic.id);
            // A finding about an event has a run that ends with the step.
            let happens = matches!(meta, Meta::Consistent | Meta::Complete);
            assert_eq!(finding.witness.is_some(), happens, "{told}");
        }
    }
    let _ = writeln!(told, "states {}", review.progress.states);
    told
}

#[test]
fn the_examples_have_the_findings_that_the_page_says() {
    let page = Page::spec("review");
    let (models, expected) = (page.texts("asmetal review"), page.texts("findings"));
    assert_eq!(models.len(), expected.len());
    for (model, expected) in models.iter().zip(expected) {
        assert_eq!(findings(model), expected, "{model}");
    }
}

#[test]
fn the_pages_of_findings_show_them() {
    for id in REVIEW_IDS {
        let page = Page::fault(id);
        let found = findings(page.example("asmetal review"));
        assert!(found.lines().any(|line| line.ends_with(id)), "{id}: {found}");
    }
}

#[test]
fn a_clash_is_found_with_a_run_that_ends_in_it() {
    let page = Page::fault("inconsistent-update");
    let model = page.example("asmetal run");
    assert!(findings(model).starts_with("MP1 violated\n"), "{}", findings(model));
}

#[test]
fn all_clashes_of_a_step_are_found() {
    let found = findings(
        "asm Clashes\nsignature:\n\tcontrolled a: Boolean\n\tcontrolled b: Boolean\n\tcontrolled c: Boolean\ndefinitions:\n\
         \tmain rule r_Main =\n\t\tpar\n\t\t\ta := true\n\t\t\ta := false\n\t\t\tb := true\n\t\t\tb := false\n\
         \t\t\tseq\n\t\t\t\tc := true\n\t\t\t\tpar\n\t\t\t\t\tc := false\n\t\t\t\t\tc := true\n\t\t\t\tendpar\n\t\t\tendseq\n\
         \t\tendpar\ndefault init s0:\n\tfunction a = true\n\tfunction b = true\n\tfunction c = true\n",
    );
    // One for the second update of each pair that clashes. A `seq` ends at its first clash.
    assert_eq!(found.lines().filter(|line| line.ends_with("inconsistent-update")).count(), 3, "{found}");
}

/// What no rule updates has its values all the same, whether or not the search keeps them in its states.
#[test]
fn what_keeps_its_initial_value_takes_it() {
    let check = |functions: &str, rule: &str, initials: &str, expected: &[&str]| {
        let text = format!(
            "asm M import StandardLibrary signature: enum domain E = {{AA | BB}} {functions} controlled x: Boolean\n\
             definitions: main rule r_Main = {rule} default init s0: {initials} function x = true"
        );
        let told = findings(&text);
        let about_values = |line: &&str| {
            line.starts_with("MP5") || line.starts_with("MP6") || line.ends_with("taken") || line.ends_with("element")
        };
        let found: Vec<&str> = told.lines().filter(about_values).map(str::trim).collect();
        assert_eq!(found, expected, "{text}");
    };
    let (holds, flips) = (["MP5 holds", "MP6 holds"], "x := (k(x) = BB)");
    let by_argument = "function k($b in Boolean) = if $b then AA else BB endif";
    check("controlled k: Boolean -> E", flips, by_argument, &holds);
    let one = ["MP5 violated", "1 unused-element", "MP6 violated", "1 value-never-taken"];
    check("controlled k: Boolean -> E", "x := (k(x) = BB) = x", "function k($b in Boolean) = AA", &one);
    check("controlled k: E", "if k = AA then x := not x endif", "function k = AA", &one);
    // So many locations cannot be listed: the values are those that are written.
    let of_numbers = "controlled k: Integer -> E";
    check(
        of_numbers,
        "x := k(if x then 1 else 2 endif) = AA or not x",
        "function k($i in Integer) = if $i > 1 then AA else BB endif",
        &holds,
    );
    check(of_numbers, "x := not x and k(1) = AA", "function k($i in Integer) = AA", &one);
    check(
        of_numbers,
        "x := not x and k(1) = AA",
        "function k($i in Integer) = if $i > 1 then last(asSequence({AA})) else AA endif",
        &["MP5 unknown", "MP6 unknown"],
    );
}

/// What a model of this signature, main rule and initial state is found to have never, as `MP7` and lines.
fn never(signature: &str, main: &str, init: &str) -> Vec<String> {
    let text = format!(
        "asm M\nimport StandardLibrary\nsignature:\nenum domain D = {{AA | BB}}\n{signature}\ndefinitions:\nmain rule r_Main = {main}\ndefault init s0: {init}"
    );
    let told = findings(&text);
    let mut lines = told.lines().skip_while(|line| !line.starts_with("MP7")).map(|line| line.trim().to_string());
    let outcome = lines.next().unwrap_or_default();
    std::iter::once(outcome).chain(lines.take_while(|line| !line.starts_with("states"))).collect()
}

/// The guard of a choice reads what it refuses a candidate for, if the step is made with another.
#[test]
fn what_refuses_a_candidate_is_read() {
    let guarded = "controlled locked: D -> Boolean\ncontrolled n: D -> Boolean";
    let opens = "choose $d in D with not locked($d) do par n($d) := not n($d) locked(BB) := locked(BB) endpar";
    let both = "function locked($d in D) = $d = AA function n($d in D) = false";
    // Line 5 is `locked`, line 6 is `n`: `n(AA)` is never read, and neither it nor `locked(AA)` is updated.
    assert_eq!(never(guarded, opens, both), ["MP7 violated", "5 never-updated", "6 never-updated", "6 never-read"]);
    let none = "choose $d in D with armed do n($d) := not n($d) ifnone t := not t";
    let init = "function armed = false function n($d in D) = false function t = false";
    let told = never("controlled armed: Boolean\ncontrolled n: D -> Boolean\ncontrolled t: Boolean", none, init);
    assert_eq!(told, ["MP7 violated", "5 never-updated", "6 never-updated", "6 never-read"]);
    // No step is made in which the candidate is refused.
    let only = "choose $d in D with armed do n := not n ifnone n := undef and 1 / 0 = 1";
    let told =
        never("controlled armed: Boolean\ncontrolled n: Boolean", only, "function armed = false function n = true");
    assert_eq!(told, ["MP7 violated", "5 never-updated", "5 never-read", "6 never-updated", "6 never-read"]);
}

#[test]
fn what_initial_values_read_decides_how_a_run_begins() {
    let signature = "monitored wanted: D\ncontrolled hot: Boolean";
    let init = "function hot = (wanted = BB)";
    assert_eq!(never(signature, "if hot then hot := false endif", init), ["MP7 holds"]);
}

#[test]
fn locations_are_told_apart_where_only_an_undefined_one_is_touched() {
    let signature = "controlled count: D -> Boolean\ncontrolled cur: D";
    let told =
        never(signature, "par count(cur) := not count(cur) cur := undef endpar", "function count($d in D) = false");
    assert_eq!(told, ["MP7 violated", "5 never-updated", "5 never-read"]);
}

/// An update that has not been run may yet turn out to be trivial.
#[test]
fn whether_an_update_is_trivial_is_unknown_before_it_runs() {
    let text = "asm M\nimport StandardLibrary\nsignature:\nmonitored level: Integer\ncontrolled on: Boolean\ndefinitions:\n\
        main rule r_Main = if level > 3 then on := on endif\ndefault init s0: function on = false";
    assert!(findings(text).contains("MP4 unknown\n"), "{}", findings(text));
}
