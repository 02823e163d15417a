//! Formula → SMT-LIB 2.6: one script, which asks whether the condition holds in some state and for that state's values.
//!
//! Names stand between bars, as AsmetaL has letters that SMT-LIB has not. A closed carrier is an enumeration, an open one a
//! sort of its own with distinct constants. Integers have 64 bits: each location is bounded, and what the translation says
//! to be safe bounds each operation. Quotients are made towards zero of SMT-LIB's, which are Euclid's.

use std::fmt::Write;

use crate::formula::{Arithmetic, Carrier, Formula, Order, Sort, SymbolId, Term, Value};

/// The script, and the terms whose values it asks for, in order.
pub(crate) fn script(formula: &Formula) -> (String, Vec<Asked>) {
    let writer = Writer { formula };
    let mut out = "(set-option :produce-models true)\n(set-logic ALL)\n".to_string();
    for (index, carrier) in formula.carriers.iter().enumerate() {
        writer.carrier(&mut out, index, carrier);
    }
    for (index, symbol) in formula.symbols.iter().enumerate() {
        let parameters: Vec<String> = symbol.parameters.iter().map(|sort| writer.sort(*sort)).collect();
        let (name, sort) = (writer.symbol(SymbolId(index)), writer.sort(symbol.sort));
        let _ = writeln!(out, "(declare-fun {name} ({}) {sort})", parameters.join(" "));
    }
    let mut locations: Vec<&Term> = Vec::new();
    formula.condition.walk(&mut |term| {
        if matches!(term, Term::Apply(..)) && !locations.contains(&term) {
            locations.push(term);
        }
    });
    for location in &locations {
        let Term::Apply(id, _) = location else { continue };
        let (symbol, text) = (formula.symbol(*id), writer.term(location));
        match &symbol.values {
            Some(values) => {
                let any: Vec<String> =
                    values.iter().map(|value| format!("(= {text} {})", writer.value(*value))).collect();
                let _ = match &any[..] {
                    [] => writeln!(out, "(assert false)"),
                    [one] => writeln!(out, "(assert {one})"),
                    several => writeln!(out, "(assert (or {}))", several.join(" ")),
                };
            }
            None if symbol.sort == Sort::Integer => {
                let (low, high) = (writer.value(Value::Integer(i64::MIN)), i64::MAX);
                let _ = writeln!(out, "(assert (<= {low} {text} {high}))");
            }
            None => {}
        }
    }
    let _ = writeln!(out, "(assert {})\n(check-sat)", writer.term(&formula.condition));
    let asked = asked(formula, &locations);
    if !asked.is_empty() {
        let terms: Vec<String> = asked.iter().map(|asked| writer.asked(asked)).collect();
        let _ = writeln!(out, "(get-value ({}))", terms.join(" "));
    }
    (out, asked)
}

/// Something whose value is asked for.
#[derive(Debug, Clone, PartialEq)]
pub(crate) enum Asked {
    /// An element of an open carrier, to know it by its value.
    Element(usize, usize),
    /// An argument or a location.
    Term(Term),
}

fn asked(formula: &Formula, locations: &[&Term]) -> Vec<Asked> {
    let mut asked = Vec::new();
    for (index, carrier) in formula.carriers.iter().enumerate().filter(|(_, carrier)| carrier.open) {
        asked.extend((0..carrier.elements.len()).map(|element| Asked::Element(index, element)));
    }
    for location in locations {
        let Term::Apply(_, arguments) = location else { continue };
        for term in arguments.iter().chain([*location]) {
            let known = matches!(term, Term::Constant(_)) || asked.contains(&Asked::Term(term.clone()));
            if !known {
                asked.push(Asked::Term(term.clone()));
            }
        }
    }
    asked
}

struct Writer<'f> {
    formula: &'f Formula,
}

impl Writer<'_> {
    fn carrier(&self, out: &mut String, index: usize, carrier: &Carrier) {
        let name = self.sort(Sort::Carrier(index));
        let elements: Vec<String> = (0..carrier.elements.len()).map(|element| self.element(index, element)).collect();
        let _ = if carrier.open {
            let declared: String =
                elements.iter().map(|element| format!("(declare-const {element} {name})\n")).collect();
            let distinct = match elements.len() {
                0 | 1 => String::new(),
                _ => format!("(assert (distinct {}))\n", elements.join(" ")),
            };
            write!(out, "(declare-sort {name} 0)\n{declared}{distinct}")
        } else {
            let constructors: Vec<String> = elements.iter().map(|element| format!("({element})")).collect();
            writeln!(out, "(declare-datatypes (({name} 0)) (({})))", constructors.join(" "))
        };
    }

    fn sort(&self, sort: Sort) -> String {
        match sort {
            Sort::Boolean => "Bool".to_string(),
            Sort::Integer => "Int".to_string(),
            Sort::Real => "Real".to_string(),
            Sort::Carrier(index) => format!("|{} {index}|", self.formula.carriers[index].name),
        }
    }

    fn element(&self, carrier: usize, index: usize) -> String {
        format!("|{} {carrier}.{index}|", bare(&self.formula.carriers[carrier].elements[index]))
    }

    fn symbol(&self, id: SymbolId) -> String {
        let symbol = self.formula.symbol(id);
        format!("|{}{} {}|", if symbol.definedness { "isDef " } else { "" }, bare(&symbol.name), id.0)
    }

    fn asked(&self, asked: &Asked) -> String {
        match asked {
            Asked::Element(carrier, index) => self.element(*carrier, *index),
            Asked::Term(term) => self.term(term),
        }
    }

    fn value(&self, value: Value) -> String {
        match value {
            Value::Boolean(truth) => truth.to_string(),
            Value::Integer(number) if number < 0 => format!("(- {})", number.unsigned_abs()),
            Value::Integer(number) => number.to_string(),
            Value::Real(number) => {
                let digits = format!("{}", number.abs());
                let digits = if digits.contains('.') { digits } else { digits + ".0" };
                if number < 0.0 { format!("(- {digits})") } else { digits }
            }
            Value::Element(carrier, index) => self.element(carrier, index),
        }
    }

    fn list(&self, head: &str, terms: &[&Term]) -> String {
        let terms: Vec<String> = terms.iter().map(|term| self.term(term)).collect();
        format!("({head} {})", terms.join(" "))
    }

    fn term(&self, term: &Term) -> String {
        match term {
            Term::Constant(value) => self.value(*value),
            Term::Apply(id, arguments) if arguments.is_empty() => self.symbol(*id),
            Term::Apply(id, arguments) => self.list(&self.symbol(*id), &arguments.iter().collect::<Vec<_>>()),
            Term::Not(a) => self.list("not", &[a]),
            Term::And(terms) => self.list("and", &terms.iter().collect::<Vec<_>>()),
            Term::Or(terms) => self.list("or", &terms.iter().collect::<Vec<_>>()),
            Term::Equal(a, b) => self.list("=", &[a, b]),
            Term::Compare(Order::Less, a, b) => self.list("<", &[a, b]),
            Term::Compare(Order::LessEqual, a, b) => self.list("<=", &[a, b]),
            Term::If(a, b, c) => self.list("ite", &[a, b, c]),
            Term::Compute(operation, a, b) => match operation {
                Arithmetic::Add => self.list("+", &[a, b]),
                Arithmetic::Subtract => self.list("-", &[a, b]),
                Arithmetic::Multiply => self.list("*", &[a, b]),
                Arithmetic::Divide => self.list("/", &[a, b]),
                Arithmetic::Quotient => self.towards_zero("div", a, b),
                Arithmetic::Remainder => self.towards_zero("mod", a, b),
            },
            Term::ToReal(a) => self.list("to_real", &[a]),
            Term::Floor(a) => self.list("to_int", &[a]),
        }
    }

    fn towards_zero(&self, operation: &str, a: &Term, b: &Term) -> String {
        let (a, b) = (self.term(a), self.term(b));
        format!("(ite (>= {a} 0) ({operation} {a} {b}) (- ({operation} (- {a}) {b})))")
    }
}

/// A name without what cannot stand between bars.
fn bare(name: &str) -> String {
    name.replace(['|', '\\'], "_")
}
