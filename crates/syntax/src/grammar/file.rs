//! The file and its sections (spec/language.md, section 2).
//!
//! In: the cursor at the start of a file. Out: the children of SOURCE_FILE. Sections in a wrong order, twice, or
//! without their heading are parsed all the same. So one misplaced word does not hide the faults of a whole section.

use super::sets::{DECLARATION_STARTS, DEFINITION_STARTS, SECTION_STARTS};
use super::{domain, function, init, list, name, property, recovery, rule};
use crate::SyntaxKind::*;
use crate::fault;
use crate::parser::Parser;

/// A whole file of AsmetaL.
pub(crate) fn source_file(p: &mut Parser<'_>) {
    if p.at(EOF) {
        return; // comments alone are no machine, and no fault
    }
    let named = machine_name(p);
    let mut sections = Sections::default();
    while !p.at(EOF) {
        section(p, &mut sections);
    }
    if named {
        sections.report_missing(p);
    }
}

/// Which sections were read.
#[derive(Debug, Default)]
struct Sections {
    export: bool,
    signature: bool,
    definitions: bool,
    main: bool,
    init: bool,
}

impl Sections {
    /// Reports a second section of one kind.
    fn once(seen: &mut bool, p: &mut Parser<'_>) {
        if std::mem::replace(seen, true) {
            let found = p.found();
            p.fault(fault::duplicate_section(found));
        }
    }

    /// Reports a section that stands after one it must precede.
    fn before(p: &mut Parser<'_>, later: &[(bool, &str)]) {
        if let Some((_, word)) = later.iter().find(|(seen, _)| *seen) {
            let found = p.found();
            p.fault(fault::misplaced_section(found, word));
        }
    }

    fn report_missing(&self, p: &mut Parser<'_>) {
        if !self.signature {
            let found = p.found();
            p.fault(fault::missing_section(found, "signature"));
        } else if !self.definitions {
            let found = p.found();
            p.fault(fault::missing_section(found, "definitions"));
        }
    }
}

fn machine_name(p: &mut Parser<'_>) -> bool {
    p.eat(ASYNCR_KW);
    let named = matches!(p.current(), ASM_KW | MODULE_KW);
    if named {
        p.start(MACHINE_NAME);
        p.bump();
        name::generic_name(p);
        p.finish();
    } else {
        let found = p.found();
        p.fault(fault::no_machine_name(found));
        recovery::no_head(p);
    }
    named
}

fn section(p: &mut Parser<'_>, seen: &mut Sections) {
    let body =
        [(seen.signature, "signature"), (seen.definitions, "definitions"), (seen.main, "main"), (seen.init, "init")];
    match p.current() {
        IMPORT_KW => {
            Sections::before(p, &body);
            import(p);
        }
        EXPORT_KW => {
            Sections::before(p, &body);
            Sections::once(&mut seen.export, p);
            export(p);
        }
        SIGNATURE_KW => {
            Sections::before(p, &body[1..]);
            Sections::once(&mut seen.signature, p);
            p.start(SIGNATURE);
            p.bump();
            p.expect(COLON, "behind `signature`");
            declarations(p);
            p.finish();
        }
        DEFINITIONS_KW => {
            Sections::before(p, &body[2..]);
            Sections::once(&mut seen.definitions, p);
            p.start(DEFINITIONS);
            p.bump();
            p.expect(COLON, "behind `definitions`");
            definitions(p);
            p.finish();
        }
        MAIN_KW => {
            Sections::before(p, &body[3..]);
            Sections::once(&mut seen.main, p);
            p.start(MAIN_RULE);
            p.bump();
            rule::declaration(p);
            p.finish();
        }
        DEFAULT_KW | INIT_KW => {
            seen.init = true;
            init::init(p);
        }
        _ => stray(p, seen),
    }
}

/// Something that no section starts with.
fn stray(p: &mut Parser<'_>, seen: &mut Sections) {
    let found = p.found();
    let declares = p.at_any(DECLARATION_STARTS) && !(p.at(DOMAIN_KW) && seen.signature);
    if declares && !seen.signature {
        p.fault(fault::missing_section(found, "signature"));
        seen.signature = true;
        p.start(SIGNATURE);
        declarations(p);
        p.finish();
    } else if p.at_any(DEFINITION_STARTS) && !seen.definitions {
        p.fault(fault::missing_section(found, "definitions"));
        seen.definitions = true;
        p.start(DEFINITIONS);
        definitions(p);
        p.finish();
    } else if p.at_any(DEFINITION_STARTS) {
        p.fault(fault::misplaced_section(found, if seen.main { "main" } else { "init" }));
        p.start(DEFINITIONS);
        definitions(p);
        p.finish();
    } else {
        recovery::no_definition(p, "a section");
    }
}

/// `import PATH (a, B, r_c)`
fn import(p: &mut Parser<'_>) {
    p.start(IMPORT);
    p.bump();
    if !p.eat(STRING) {
        p.expect(MODULE_REF, "behind `import`");
    }
    if p.at(L_PAREN) {
        p.start(IMPORT_SELECTION);
        list::list(p, R_PAREN, list::Empty::Forbidden, name_ref);
        p.finish();
    }
    p.finish();
}

/// `export *`, `export a, B, r_c`
fn export(p: &mut Parser<'_>) {
    p.start(EXPORT);
    p.bump();
    if !p.eat(STAR) {
        while name_ref(p) && p.eat(COMMA) {}
    }
    p.finish();
}

fn name_ref(p: &mut Parser<'_>) -> bool {
    let known = matches!(p.current(), DOMAIN_ID | ENUM_ID | FUNCTION_ID | RULE_ID);
    p.start(NAME_REF);
    if known {
        p.bump();
    } else {
        let found = p.missing();
        p.fault(fault::expected_name(found, FUNCTION_ID));
    }
    p.finish();
    known
}

fn declarations(p: &mut Parser<'_>) {
    loop {
        recovery::item(p);
        if domain::declaration(p) || function::declaration(p) {
            continue;
        }
        if p.at_any(SECTION_STARTS) || p.at_any(DEFINITION_STARTS) {
            return;
        }
        recovery::no_definition(p, "a declaration of a domain or function");
    }
}

fn definitions(p: &mut Parser<'_>) {
    loop {
        recovery::item(p);
        match p.current() {
            DOMAIN_KW => function::domain_definition(p),
            FUNCTION_KW => function::definition(p),
            RULE_KW | MACRO_KW | TURBO_KW => rule::declaration(p),
            INVAR_KW => property::assumption(p, INVAR),
            JUSTICE_KW | FAIRNESS_KW => property::assumption(p, JUSTICE),
            COMPASSION_KW => property::compassion(p),
            INVARIANT_KW => property::invariant(p),
            CTLSPEC_KW => property::temporal(p, CTL_SPEC, CTL_ID),
            LTLSPEC_KW => property::temporal(p, LTL_SPEC, LTL_ID),
            _ if p.at_any(SECTION_STARTS) => return,
            _ if misplaced_declaration(p) => {}
            _ => recovery::no_definition(p, "a definition"),
        }
    }
}

/// A declaration among the definitions.
fn misplaced_declaration(p: &mut Parser<'_>) -> bool {
    if !p.at_any(DECLARATION_STARTS) {
        return false;
    }
    let found = p.found();
    p.fault(fault::declaration_in_definitions(found));
    p.start(ERROR);
    let read = domain::declaration(p) || function::declaration(p);
    p.finish();
    read
}

#[cfg(test)]
mod tests {
    use crate::grammar::brief::file;
    use expect_test::{Expect, expect};

    fn check(text: &str, expected: Expect) {
        expected.assert_eq(&file(text));
    }

    #[test]
    fn heads() {
        check("", expect![[""]]);
        check("// only a comment", expect![[""]]);
        check(
            r#"module M import ../a/B import "c d" (f, D, r_x, RED) import C:\x\y.asm export * signature: definitions:"#,
            expect![[r#"
            MACHINE_NAME(module M)
            IMPORT(import ../a/B)
            IMPORT(import "c d" IMPORT_SELECTION(( f , D , r_x , RED )))
            IMPORT(import C:\x\y.asm)
            EXPORT(export *)
            SIGNATURE(signature :)
            DEFINITIONS(definitions :)"#]],
        );
        check(
            "asyncr asm asm export a, B, r_c signature: definitions:",
            expect![[r#"
            asyncr
            MACHINE_NAME(asm asm)
            EXPORT(export a , B , r_c)
            SIGNATURE(signature :)
            DEFINITIONS(definitions :)"#]],
        );
        check(
            "\u{FEFF}asm a signature: definitions: //end",
            expect!["MACHINE_NAME(asm a) SIGNATURE(signature :) DEFINITIONS(definitions :)"],
        );
    }

    #[test]
    fn sections() {
        check(
            "asm a signature: definitions: main rule r_Main = skip default init s0: function x = 1 init s1: domain D = {}",
            expect![[r#"
            MACHINE_NAME(asm a)
            SIGNATURE(signature :)
            DEFINITIONS(definitions :)
            MAIN(main RULE(rule r_Main = SKIP(skip)))
            INIT(default init s0 : FUNCTION_DEF(function x = 1))
            INIT(init s1 : DOMAIN_DEF(domain D = COLLECTION({ })))"#]],
        );
        check(
            "asm a signature: definitions: rule r_a = skip function f = 1 INVAR a domain D = {1} macro rule r_b = skip main macro rule r_M = skip",
            expect![[r#"
            MACHINE_NAME(asm a)
            SIGNATURE(signature :)
            DEFINITIONS(
              definitions
              :
              RULE(rule r_a = SKIP(skip))
              FUNCTION_DEF(function f = 1)
              INVAR(INVAR a)
              DOMAIN_DEF(domain D = COLLECTION({ 1 }))
              RULE(macro rule r_b = SKIP(skip)))
            MAIN(main RULE(macro rule r_M = SKIP(skip)))"#]],
        );
    }

    #[test]
    fn faults() {
        check("x", expect!["ERROR(x) !missing-section"]);
        check("asm", expect!["MACHINE_NAME(asm) !expected-name"]);
        check("asm a", expect!["MACHINE_NAME(asm a) !missing-section"]);
        check("asm a signature:", expect!["MACHINE_NAME(asm a) SIGNATURE(signature :) !missing-section"]);
        check("asm a definitions:", expect!["MACHINE_NAME(asm a) DEFINITIONS(definitions :) !missing-section"]);
        check(
            "asm a signature: rule r_a = skip",
            expect![[r#"
            MACHINE_NAME(asm a)
            SIGNATURE(signature :)
            DEFINITIONS(RULE(rule r_a = SKIP(skip)))
            !missing-section"#]],
        );
        check(
            "asm a controlled f: A definitions:",
            expect![[r#"
            MACHINE_NAME(asm a)
            SIGNATURE(FUNCTION(controlled f : A))
            DEFINITIONS(definitions :)
            !missing-section"#]],
        );
        check(
            "asm a signature: definitions: signature:",
            expect![[r#"
            MACHINE_NAME(asm a)
            SIGNATURE(signature :)
            DEFINITIONS(definitions :)
            SIGNATURE(signature :)
            !misplaced-section"#]],
        );
        check(
            "asm a signature: definitions: import X main rule r_M = skip rule r_b = skip",
            expect![[r#"
            MACHINE_NAME(asm a)
            SIGNATURE(signature :)
            DEFINITIONS(definitions :)
            IMPORT(import X)
            MAIN(main RULE(rule r_M = SKIP(skip)))
            DEFINITIONS(RULE(rule r_b = SKIP(skip)))
            !misplaced-section
            !misplaced-section"#]],
        );
        check(
            "asm a import\nsignature: definitions:",
            expect![[r#"
            MACHINE_NAME(asm a)
            IMPORT(import)
            SIGNATURE(signature :)
            DEFINITIONS(definitions :)
            !expected-token"#]],
        );
        check(
            "asm a signature: definitions: static f: A",
            expect![[r#"
            MACHINE_NAME(asm a)
            SIGNATURE(signature :)
            DEFINITIONS(definitions : ERROR(FUNCTION(static f : A)))
            !expected-definition"#]],
        );
        check(
            "asm a signature: definitions: foo bar main rule r_M = skip",
            expect![[r#"
            MACHINE_NAME(asm a)
            SIGNATURE(signature :)
            DEFINITIONS(definitions : ERROR(foo bar))
            MAIN(main RULE(rule r_M = SKIP(skip)))
            !expected-definition"#]],
        );
        check(
            "asm a signature: local f: A definitions:",
            expect![[r#"
            MACHINE_NAME(asm a)
            SIGNATURE(signature : ERROR(local f : A))
            DEFINITIONS(definitions :)
            !expected-definition"#]],
        );
        check(
            "asm a export signature: definitions:",
            expect![[r#"
            MACHINE_NAME(asm a)
            EXPORT(export)
            SIGNATURE(signature :)
            DEFINITIONS(definitions :)
            !expected-name"#]],
        );
    }
}
