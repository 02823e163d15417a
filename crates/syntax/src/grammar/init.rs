//! Initial states (spec/language.md, section 5).

use super::{function, name, recovery, rule};
use crate::SyntaxKind::*;
use crate::fault;
use crate::parser::Parser;

/// `[default] init NAME: domain D = t function f = t agent D: r_x[]`
pub(super) fn init(p: &mut Parser<'_>) {
    p.start(INIT);
    p.eat(DEFAULT_KW);
    if p.expect(INIT_KW, "behind `default`") {
        name::generic_name(p);
        p.expect(COLON, "behind the name of the initial state");
    }
    loop {
        match p.current() {
            DOMAIN_KW => function::domain_definition(p),
            FUNCTION_KW => function::definition(p),
            AGENT_KW => agent(p),
            _ if p.at_any(recovery::SECTION_STARTS) => break,
            _ => recovery::no_definition(p, "a definition of the initial state"),
        }
    }
    p.finish();
}

/// `agent D: r_x[]`
fn agent(p: &mut Parser<'_>) {
    p.start(AGENT_INIT);
    p.bump();
    if name::domain_name(p) && p.expect(COLON, "behind the domain of the agents") {
        if p.at(RULE_ID) {
            rule::call(p);
        } else {
            let found = p.missing();
            p.fault(fault::expected_rule(found, "a call of a macro rule, `r_x[]`,"));
        }
    }
    p.finish();
}
