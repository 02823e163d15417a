//! Each name of a text is in the table of uses, with what it means.

use expect_test::expect;
use model::{Referent, check};
use syntax::{FileId, SourceFile};
use testkit::NoFiles;

/// `name@offset = meaning at its declaration`, in order.
fn told(text: &str) -> Vec<String> {
    let checked = check(SourceFile::new("lamp.asm", text), &mut NoFiles);
    let model = &checked.model;
    let mut lines = Vec::new();
    for name in model.uses.in_file(FileId(0)) {
        let written = checked.sources.text(name.span);
        let meaning = match name.referent {
            Referent::Domain(id) => format!("domain {}", model.domains.display(id)),
            Referent::Literal(id, place) => format!("literal {place} of {}", model.domains.display(id)),
            Referent::Function(id) => format!("function {}", model.function(id).name),
            Referent::Rule(id) => format!("rule {}", model.rule(id).name),
            Referent::Variable(span, domain) => {
                format!("variable {} of {}", checked.sources.text(span), model.domains.display(domain))
            }
        };
        lines.push(format!("{}{written}: {meaning}", if name.declares { "declares " } else { "" }));
    }
    lines
}

#[test]
fn names_refer_to_what_they_mean() {
    let text = "asm lamp import StandardLibrary(Boolean, Integer, plus, eq)
signature: enum domain Light = {ON | OFF} controlled light: Light -> Integer static two: Integer
definitions: function two = 2 rule r_Put($l in Light) = let ($y = 1) in light($l) := light($l) + $y endlet
invariant over light: light(OFF) = two
main rule r_Main = par forall $x in Light do r_Put[$x] nothing := lihgt(ON) endpar";
    let told = told(text);
    let own: Vec<&str> = told.iter().map(String::as_str).filter(|line| *line != "plus: function plus").collect();
    expect![[r#"
        Boolean: domain Boolean
        Integer: domain Integer
        eq: function eq
        eq: function eq
        eq: function eq
        eq: function eq
        eq: function eq
        eq: function eq
        eq: function eq
        eq: function eq
        declares Light: domain Light
        declares ON: literal 0 of Light
        declares OFF: literal 1 of Light
        declares light: function light
        Light: domain Light
        Integer: domain Integer
        declares two: function two
        Integer: domain Integer
        two: function two
        declares r_Put: rule r_Put
        declares $l: variable $l of Light
        Light: domain Light
        declares $y: variable $y of Integer
        light: function light
        $l: variable $l of Light
        light: function light
        $l: variable $l of Light
        +: function plus
        $y: variable $y of Integer
        light: function light
        light: function light
        OFF: literal 1 of Light
        =: function eq
        two: function two
        declares r_Main: rule r_Main
        declares $x: variable $x of Light
        Light: domain Light
        r_Put: rule r_Put
        $x: variable $x of Light
        ON: literal 0 of Light"#]]
    .assert_eq(&own.join("\n"));
}
