//! Imports: selection, export lists, re-export, circles, and what they bring.

use crate::support::{check_file, dump, faults};
use expect_test::{Expect, expect};

const MIDDLE: &str = "module middle\nimport base\nexport *\nsignature:\ncontrolled m: Level\ndefinitions:\ndefault init s0:\nfunction m = LOW";
const BASE: &str = "module base
import StandardLibrary
export Level, level, r_up
signature:
enum domain Level = {LOW | HIGH}
controlled level: Level
controlled hidden: Level
definitions:
rule r_up = level := HIGH";

fn check(text: &str, expected: Expect) {
    let checked = check_file("t.asm", text, &[("middle.asm", MIDDLE), ("base.asm", BASE)]);
    let faults = faults(&checked);
    expected.assert_eq(&if faults.is_empty() { dump(&checked) } else { faults });
}

#[test]
fn re_exported_names_are_seen_and_initial_values_are_not() {
    check(
        "asm t\nimport middle\nimport ./base\nimport StandardLibrary\nsignature:\ndefinitions:\nmain rule r_Main = if level != HIGH then par m := HIGH r_up[] endpar endif",
        expect![[r#"
            domain Level = {LOW, HIGH}
            controlled level: Level
            controlled hidden: Level
            controlled m: Level
            rule r_up =
              level := HIGH
            rule r_Main =
              if neq(level, HIGH)
                par
                  m := HIGH
                  r_up[]
            main r_Main
        "#]],
    );
}

#[test]
fn a_selection_brings_the_names_selected() {
    check(
        "asm t\nimport base (level, Levle)\nsignature:\ncontrolled x: Level\ndefinitions:\nmain rule r_Main = par level := HIGH r_up[] endpar",
        expect![[r#"
            warning[not-exported] t.asm:2:21 `Levle`: `base` does not export `Levle`
              help: did you mean `Level`?
            error[unknown-enum-literal] t.asm:6:33 `HIGH`: no enum domain has the literal `HIGH`
              help: `HIGH` is a literal of `Level` in an imported file: add `Level` to that file's export list, and to the selection of the import
            error[unknown-rule] t.asm:6:38 `r_up`: there is no rule `r_up`
              help: `r_up` is declared in an imported file: add it to that file's export list, and to the selection of the import
        "#]],
    );
}

#[test]
fn what_is_not_exported_is_said_to_be_hidden() {
    check(
        "asm t\nimport base\nimport StandardLibrary\nsignature:\ndefinitions:\nmain rule r_Main = hidden := LOW",
        expect![[r#"
            error[unknown-function] t.asm:6:20 `hidden`: there is no function `hidden`
              help: `hidden` is declared in an imported file: add it to that file's export list, and to the selection of the import
        "#]],
    );
}

#[test]
fn a_missing_import_hides_the_names_it_would_bring() {
    check(
        "asm t\nimport StandardLibrary\nimport nowhere\nsignature:\ncontrolled x: There\ndefinitions:\nmain rule r_Main = x := there(1)",
        expect![[r#"
            error[import-not-found] t.asm:3:8 `nowhere`: cannot import `nowhere`: there is no such file
              help: a path is relative to the folder of this file; `.asm` may be left out
        "#]],
    );
}

#[test]
fn a_circle_is_shown() {
    let a = "module a\nimport b\nexport *\nsignature:\ndefinitions:\n";
    let b = "module b\nimport c\nexport *\nsignature:\ndefinitions:\n";
    let c = "module c\nimport ./a\nexport *\nsignature:\ndefinitions:\n";
    let checked = check_file("a.asm", a, &[("a.asm", a), ("b.asm", b), ("c.asm", c)]);
    expect![[r#"
        error[circular-import] c.asm:2:8 `./a`: circular import: a.asm → b.asm → c.asm → a.asm
          because leads back to a file that is being read
          help: move what both files need into a third one that imports neither
    "#]]
    .assert_eq(&faults(&checked));
}

#[test]
fn without_the_standard_library_one_fault_says_so() {
    check(
        "asm t\nsignature:\ncontrolled x: Integer\ndefinitions:\nmain rule r_Main = if x = 1 and x > 2 then x := x + 1 endif",
        expect![[r#"
            error[missing-standard-library] t.asm:5:25 `=`: `=` comes from the standard library, which is not imported
              help: write `import StandardLibrary` before the signature; it is built in, so no file is needed
        "#]],
    );
}

#[test]
fn equal_functions_of_two_imports_are_one() {
    let one = "module one\nexport *\nsignature:\ncontrolled f: Integer -> Integer\ndefinitions:\n";
    let two = "module two\nexport *\nsignature:\nmonitored f: Integer -> Integer\ndefinitions:\n";
    let text = "asm t\nimport one\nimport two\nsignature:\ndefinitions:\nmain rule r_Main = f(1) := 2";
    let checked = check_file("t.asm", text, &[("one.asm", one), ("two.asm", two)]);
    expect![[""]].assert_eq(&faults(&checked));
}

#[test]
fn a_copy_of_a_time_library_is_read_once_and_in_its_place() {
    let copy = "module TimeLibrary import StandardLibrary export * signature: abstract domain Timer derived expired: Timer -> Boolean definitions: function expired($t in Timer) = mine($t) > 1";
    let copy = copy.replace("derived expired", "controlled mine: Timer -> Integer derived expired");
    let module = "module other import elsewhere/TimeLibrary import StandardLibrary export * signature: static u: Timer definitions:";
    let text = "asm t import lib/TimeLibrary import other import StandardLibrary signature: static t: Timer controlled x: Boolean \
        definitions: main rule r_Main = x := expired(t) and expired(u) and mine(t) = 1";
    let check = |others: &[(&str, &str)]| check_file("t.asm", text, others);
    let copied = check(&[("lib/TimeLibrary.asm", &copy), ("other.asm", module)]);
    assert_eq!(faults(&copied), "");
    assert!(faults(&check(&[("other.asm", module)])).contains("`mine`"), "the built-in one has no such function");
}
