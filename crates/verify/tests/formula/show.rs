//! Formulas as text: `G F 0 & !1` over the numbers of propositions, which are listed after it.

use machine::Show;
use program::Program;
use verify::temporal::formula::{Ctl, CtlFormulas, FormulaId, Ltl, LtlFormulas};
use verify::temporal::read::{Formula, Properties};

fn ctl(formulas: &CtlFormulas, formula: FormulaId) -> String {
    let of = |formula| ctl(formulas, formula);
    match formulas.node(formula) {
        Ctl::Constant(truth) => truth.to_string(),
        Ctl::Proposition(number) => number.to_string(),
        Ctl::Not(p) => format!("!{}", of(p)),
        Ctl::And(p, q) => format!("({} & {})", of(p), of(q)),
        Ctl::ExistsNext(p) => format!("EX {}", of(p)),
        Ctl::ExistsUntil(p, q) => format!("E[{} U {}]", of(p), of(q)),
        Ctl::ExistsGlobally(p) => format!("EG {}", of(p)),
    }
}

fn ltl(formulas: &LtlFormulas, formula: FormulaId) -> String {
    let of = |formula| ltl(formulas, formula);
    match formulas.node(formula) {
        Ltl::Constant(truth) => truth.to_string(),
        Ltl::Proposition(number) => number.to_string(),
        Ltl::Not(p) => format!("!{}", of(p)),
        Ltl::And(p, q) => format!("({} & {})", of(p), of(q)),
        Ltl::Next(p) => format!("X {}", of(p)),
        Ltl::Until(p, q) => format!("({} U {})", of(p), of(q)),
        Ltl::Previous(p) => format!("Y {}", of(p)),
        Ltl::Since(p, q) => format!("({} S {})", of(p), of(q)),
    }
}

pub fn show(program: &Program, text: &str, properties: &Properties) -> String {
    let mut shown = String::new();
    for (index, formula) in &properties.formulas {
        let name = &program.properties[*index].name;
        shown += &match formula {
            Formula::Ctl(formula) => format!("{name}: {}\n", ctl(&properties.ctl, *formula)),
            Formula::Ltl(formula) => format!("{name}: {}\n", ltl(&properties.ltl, *formula)),
        };
    }
    for number in &properties.justice {
        shown += &format!("justice {number}\n");
    }
    for (premise, conclusion) in &properties.compassion {
        shown += &format!("compassion {premise} {conclusion}\n");
    }
    for (number, proposition) in properties.propositions.iter().enumerate() {
        let span = proposition.span(program);
        let written = &text[span.start as usize..span.end as usize];
        let values = proposition.bindings.iter().map(|(_, value)| format!(" {}", value.show(program)));
        shown += &format!("{number}: {written}{}\n", values.collect::<String>());
    }
    shown
}
