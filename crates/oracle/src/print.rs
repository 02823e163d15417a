//! Values as AsmetaL writes them: what `toString` gives.

use model::{DomainKind, Model};

use crate::element::named_elements;
use crate::value::{Double, Value};

/// The value as text.
pub fn show(model: &Model, value: &Value) -> String {
    let list = |open: &str, items: &mut dyn Iterator<Item = &Value>, close: &str| {
        format!("{open}{}{close}", items.map(|item| show(model, item)).collect::<Vec<_>>().join(","))
    };
    match value {
        Value::Undef => "undef".to_string(),
        Value::Boolean(truth) => truth.to_string(),
        Value::Integer(number) => number.to_string(),
        Value::Real(number) => real(*number),
        Value::Complex(re, im) => {
            let sign = if im.get() < 0.0 { "-i" } else { "+i" };
            format!("{}{sign}{}", real(*re), real(Double::new(im.get().abs()).expect("a number")))
        }
        Value::Char(char) => format!("'{}'", escaped(&char.to_string(), '\'')),
        Value::String(text) => format!("\"{}\"", escaped(text, '"')),
        Value::Rule(rule) => format!("<<{}>>", model.rule(*rule).name),
        Value::Literal(domain, place) => match model.domains.kind(*domain) {
            DomainKind::Enum { literals } => literals[*place as usize].clone(),
            _ => panic!("a literal is of an enum domain"),
        },
        Value::Element(domain, number) => {
            let mut named: Vec<_> =
                named_elements(model).filter(|(_, _, element)| same_domain(element, value)).collect();
            match named.iter().position(|(_, _, element)| element == value) {
                Some(index) => model.function(named.swap_remove(index).0).name.clone(),
                // Those made by `extend` are counted from 1.
                None => {
                    let name = model.domains.display(*domain);
                    format!("{}{}!{}", name[..1].to_lowercase(), &name[1..], *number as usize - named.len() + 1)
                }
            }
        }
        Value::Tuple(items) => list("(", &mut items.iter(), ")"),
        Value::Seq(items) => list("[", &mut items.iter(), "]"),
        Value::Set(items) => list("{", &mut items.iter(), "}"),
        Value::Bag(_) => list("<", &mut value.elements().unwrap_or_default().iter(), ">"),
        Value::Map(entries) if entries.is_empty() => "{->}".to_string(),
        Value::Map(entries) => {
            let shown = entries.iter().map(|(key, value)| format!("{}->{}", show(model, key), show(model, value)));
            format!("{{{}}}", shown.collect::<Vec<_>>().join(","))
        }
    }
}

fn same_domain(a: &Value, b: &Value) -> bool {
    matches!((a, b), (Value::Element(a, _), Value::Element(b, _)) if a == b)
}

fn real(number: Double) -> String {
    match number.get() {
        infinite if infinite.is_infinite() => if infinite > 0.0 { "Infinity" } else { "-Infinity" }.to_string(),
        finite => format!("{finite:?}"),
    }
}

fn escaped(text: &str, quote: char) -> String {
    let mut out = String::new();
    for char in text.chars() {
        match char {
            '\n' => out += "\\n",
            '\t' => out += "\\t",
            '\r' => out += "\\r",
            '\\' => out += "\\\\",
            char if char == quote => out.extend(['\\', char]),
            char => out.push(char),
        }
    }
    out
}
