//! Initial states (spec/language.md, section 5).
//!
//! In: the cursor at `default` or `init`. Out: an INIT with definitions of domains and functions, and programs of
//! agents, in any order.
//! CIRCLE(grammar)

use super::sets::SECTION_STARTS;
use super::{function, name, recovery, rule};
use crate::SyntaxKind::*;
use crate::fault;
use crate::parser::Parser;

/// `[default] init NAME: domain D = t function f = t agent D: r_x[]`
pub(super) fn init(p: &mut Parser<'_>) {
    p.start(INIT);
    p.eat(DEFAULT_KW);
    if p.expect(INIT_KW, "behind `default`") || p.at(FUNCTION_ID) {
        name::generic_name(p);
        p.expect(COLON, "behind the name of the initial state");
    }
    loop {
        recovery::item(p);
        match p.current() {
            DOMAIN_KW => function::domain_definition(p),
            FUNCTION_KW => function::definition(p),
            AGENT_KW => agent(p),
            _ if p.at_any(SECTION_STARTS) => break,
            _ => recovery::no_definition(p, "a definition of the initial state"),
        }
    }
    p.finish();
}

/// `agent D: r_x[]`
fn agent(p: &mut Parser<'_>) {
    p.start(AGENT_INIT);
    p.bump();
    if name::domain_name(p) && (p.expect(COLON, "behind the domain of the agents") || p.at(RULE_ID)) {
        if p.at(RULE_ID) {
            rule::call(p);
        } else {
            let found = p.missing();
            p.fault(fault::expected_rule(found, "a call of a macro rule, as `r_x[]`"));
        }
    }
    p.finish();
}

#[cfg(test)]
mod tests {
    use crate::grammar::brief::file;
    use expect_test::{Expect, expect};

    fn check(text: &str, expected: Expect) {
        expected.assert_eq(&file(text));
    }

    #[test]
    fn inits() {
        check(
            "asm a signature: definitions: default init s0: domain D = {1} function f($x in D) = $x agent Agent: r_a[1] init if: function x = 1 agent CPU: r_b[]",
            expect![[r#"
            MACHINE_NAME(asm a)
            SIGNATURE(signature :)
            DEFINITIONS(definitions :)
            INIT(
              default
              init
              s0
              :
              DOMAIN_DEF(domain D = COLLECTION({ 1 }))
              FUNCTION_DEF(function f PARAMETER_LIST(( PARAMETER($x in D) )) = $x)
              AGENT_INIT(agent Agent : MACRO_CALL(r_a ARGUMENT_LIST([ 1 ]))))
            INIT(
              init
              if
              :
              FUNCTION_DEF(function x = 1)
              AGENT_INIT(agent CPU : MACRO_CALL(r_b ARGUMENT_LIST([ ]))))"#]],
        );
    }

    #[test]
    fn faults() {
        check(
            "asm a signature: definitions: default s0: function x = 1",
            expect![[r#"
            MACHINE_NAME(asm a)
            SIGNATURE(signature :)
            DEFINITIONS(definitions :)
            INIT(default s0 : FUNCTION_DEF(function x = 1))
            !expected-token"#]],
        );
        check(
            "asm a signature: definitions: init : function x = agent A r_a[] agent A: skip foo function y = 1",
            expect![[r#"
            MACHINE_NAME(asm a)
            SIGNATURE(signature :)
            DEFINITIONS(definitions :)
            INIT(
              init
              :
              FUNCTION_DEF(function x =)
              AGENT_INIT(agent A MACRO_CALL(r_a ARGUMENT_LIST([ ])))
              AGENT_INIT(agent A :)
              ERROR(skip foo)
              FUNCTION_DEF(function y = 1))
            !expected-name
            !expected-term
            !expected-token
            !expected-rule"#]],
        );
        check(
            "asm a signature: definitions: init s0 function x = 1",
            expect![[r#"
            MACHINE_NAME(asm a)
            SIGNATURE(signature :)
            DEFINITIONS(definitions :)
            INIT(init s0 FUNCTION_DEF(function x = 1))
            !expected-token"#]],
        );
    }
}
