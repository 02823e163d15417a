//! Fragments: terms, rules and updates read as if they stood in the root file of a checked model.

use crate::support::{check_body, fault_text};
use expect_test::{Expect, expect};
use model::{Domains, Fragment, Model, Target};
use syntax::ast::{self, AstNode};
use syntax::{FileId, Severity, SourceFile, Sources};

const MODEL: &str = "domain Small subsetof Natural
    monitored passed: Boolean
    monitored speed: Small -> Real
    shared level: Integer
    controlled x: Integer
    definitions:
    domain Small = {0n : 3n}
    macro rule r_Inc($l in Integer) = $l := $l + 1
    main rule r_Main = skip";

struct Case {
    sources: Sources,
    model: Model,
}

impl Case {
    fn new() -> Case {
        let checked = check_body(MODEL);
        Case { sources: checked.sources, model: checked.model }
    }

    /// A term in a file of its own, beside those of the model.
    fn term(&mut self, text: &str) -> (FileId, ast::Term) {
        let file = self.sources.add(SourceFile::new("cli", text));
        let parse = syntax::parse_term(file, text);
        (file, ast::TermFile::cast(parse.syntax()).and_then(|file| file.term()).expect("a term"))
    }

    fn show<T>(&self, fragment: &Fragment<T>, write: impl FnOnce(&T) -> String) -> String {
        let faults: String = fragment.diagnostics.iter().map(|fault| fault_text(&self.sources, fault)).collect();
        let bad = fragment.diagnostics.iter().any(|fault| fault.severity == Severity::Error);
        if bad { faults } else { write(&fragment.item) + "\n" + &faults }
    }
}

fn check_condition(text: &str, expected: Expect) {
    let mut case = Case::new();
    let (file, term) = case.term(text);
    let fragment = case.model.check_condition(file, &term, "the condition of `--until`");
    expected.assert_eq(&case.show(&fragment, |term| case.model.dump_term(term, &fragment.variables)));
}

fn check_set(text: &str, expected: Expect) {
    let mut case = Case::new();
    let scenario = format!("scenario s load t.asm\nset {text};");
    let file = case.sources.add(SourceFile::new("s.avalla", scenario.as_str()));
    let parse = syntax::parse_avalla(file, &scenario);
    let scenario = ast::ScenarioFile::cast(parse.syntax()).expect("a scenario");
    let Some(ast::Command::Set(set)) = scenario.commands().next() else { panic!("no set in {text}") };
    let (target, value) = (set.target().expect("a target"), set.value().expect("a value"));
    let fragment = case.model.check_set(file, &target, &value);
    expected.assert_eq(&case.show(&fragment, |update| match update {
        Some((Target::Location { function, arguments, .. }, value)) => {
            let arguments: Vec<String> = arguments.iter().map(|term| case.model.dump_term(term, &[])).collect();
            format!(
                "{}({}) := {}",
                case.model.function(*function).name,
                arguments.join(", "),
                case.model.dump_term(value, &[])
            )
        }
        _ => String::new(),
    }));
}

#[test]
fn a_condition_sees_the_model_and_the_library() {
    check_condition(
        "x > 3 and (exists $i in Small with speed($i) > 1)",
        expect![[r#"
        and(gt(x, 3), (exists $i in Small with gt(speed($i), 1.0)))
    "#]],
    );
}

#[test]
fn a_condition_has_to_be_boolean() {
    check_condition(
        "x + 1",
        expect![[r#"
        error[guard-not-boolean] cli:1:1 `x + 1`: the condition of `--until` must be Boolean, but this is Integer
          because Integer, where Boolean is expected
          help: compare it with something: `… = …`
    "#]],
    );
    check_condition(
        "pased",
        expect![[r#"
        error[unknown-function] cli:1:1 `pased`: there is no function `pased`
          help: did you mean `passed`?
    "#]],
    );
}

#[test]
fn the_environment_sets_its_own_functions_only() {
    check_set(
        "passed := true",
        expect![[r#"
        passed() := true
    "#]],
    );
    check_set(
        "speed(2) := 1",
        expect![[r#"
        speed(2n) := 1.0
    "#]],
    );
    check_set(
        "level := 4",
        expect![[r#"
        level() := 4
    "#]],
    );
    check_set(
        "x := 4",
        expect![[r#"
        error[update-not-allowed] s.avalla:2:5 `x`: the controlled function `x` cannot be updated
          because only the machine writes it
          see t.asm:8:16 `x`: declared controlled here
          help: run an update instead: `exec … := …;`
    "#]],
    );
    check_set(
        "level := true",
        expect![[r#"
        error[update-domain] s.avalla:2:14 `true`: `level` takes Integer, but this is Boolean
          because Boolean, where Integer is expected
          see t.asm:7:12 `level`: declared here
          help: give a term of domain Integer
    "#]],
    );
}

#[test]
fn a_value_is_taken_to_a_domain() {
    let mut case = Case::new();
    let (file, term) = case.term("2");
    let fragment = case.model.check_value(file, &term, Domains::REAL, "`$x`");
    assert_eq!(case.model.dump_term(&fragment.item, &fragment.variables), "2.0");
    let (file, term) = case.term("\"2\"");
    let fragment = case.model.check_value(file, &term, Domains::REAL, "`$x`");
    expect![[r#"
        error[update-domain] cli:1:1 `"2"`: `$x` takes Real, but this is String
          because String, where Real is expected
          help: give a term of domain Real
    "#]]
    .assert_eq(&case.show(&fragment, |_| String::new()));
    assert!(!case.model.names.functions("passed").is_empty(), "the names are still there");
}

#[test]
fn a_rule_is_checked_with_its_locations() {
    let text = "scenario s load t.asm\nexec par r_Inc[x] forall $i in {1 : 2} do level := $i endpar;\nexec r_Inc[3];";
    let mut case = Case::new();
    let file = case.sources.add(SourceFile::new("s.avalla", text));
    let parse = syntax::parse_avalla(file, text);
    let scenario = ast::ScenarioFile::cast(parse.syntax()).expect("a scenario");
    let mut out = String::new();
    for command in scenario.commands() {
        let ast::Command::Exec(exec) = command else { continue };
        let fragment = case.model.check_rule(file, &exec.rule().expect("a rule"));
        out += &case.show(&fragment, |rule| case.model.dump_rule(rule, &fragment.variables));
    }
    expect![[r#"
        par
          r_Inc[x]
          forall $i in {1 : 2}
            level := $i

        error[not-a-location] s.avalla:3:12 `3`: `r_Inc` updates its parameter `$l`, but this argument is no location
          see t.asm:11:22 `$l`: this parameter is updated
          help: give a dynamic function with its arguments: `f(a)`
    "#]]
    .assert_eq(&out);
}
