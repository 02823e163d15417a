//! Faulty texts and all that is said about each: position, reason, help. One mistake, one fault, many in one run.

use crate::render;

use expect_test::{ExpectFile, expect_file};
use syntax::{FileId, parse_asmetal, parse_avalla};

fn check(name: &str, text: &str, expected: ExpectFile) {
    let parse = if name.ends_with(".avalla") { parse_avalla(FileId(0), text) } else { parse_asmetal(FileId(0), text) };
    assert!(parse.syntax().text() == text, "{name} is not kept");
    expected.assert_eq(&render::render(name, text, &parse.diagnostics));
}

macro_rules! golden {
    ($($test:ident: $file:literal)*) => {$(
        #[test]
        fn $test() {
            check($file, include_str!(concat!("faults/", $file)), expect_file![concat!("faults/", $file, ".txt")]);
        }
    )*};
}

golden! {
    names_and_domains: "names.asm"
    operators_of_other_languages: "operators.asm"
    ends_that_are_missing: "ends.asm"
    rules_without_their_shape: "rules.asm"
    brackets_and_separators: "brackets.asm"
    literals_and_characters: "literals.asm"
    sections_out_of_place: "sections.asm"
    switches_and_branches: "branches.asm"
    definitions_and_properties: "definitions.asm"
    initial_states: "init.asm"
    a_text_of_another_kind: "prose.asm"
    a_file_that_breaks_off: "cut.asm"
    commands_of_a_scenario: "commands.avalla"
    heads_of_a_scenario: "head.avalla"
}
