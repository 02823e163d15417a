//! `MODEL.verify.yaml`: what to verify of a model, and with which inputs.
//!
//! In: the file's text. Out: a [`Verification`], whose terms are still texts that know their places, or the first fault of the form.
//! [`Verification::faults`] says whether bounds fit the program. Whether the terms do is not known here.

use program::Program;
use syntax::{Diagnostic, FileId, Span};

use crate::Scalar;
use crate::bound;
use crate::node::{self, Key, Node, Shape};

/// The id of what is wrong with the file.
const ID: &str = "bad-verification-file";

/// What the file says.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct Verification {
    /// As [`bound::read`] takes them.
    pub bounds: Vec<String>,
    /// Where each of the bounds stands.
    pub bound_places: Vec<Span>,
    /// Names of inputs that may also be undef.
    pub undefined: Vec<Scalar>,
    /// The condition under which a state may be the last.
    pub terminal: Option<Scalar>,
    /// How fair runs are: `weak` or `strong`, unless the file is wrong.
    pub fair: Option<Scalar>,
    /// Invariants, CTL and LTL formulas.
    pub properties: [Vec<Scalar>; 3],
    /// Further assumptions.
    pub assumptions: Vec<Scalar>,
}

impl Verification {
    /// What of the bounds and of the fairness does not fit the program.
    pub fn faults(&self, program: &Program) -> Vec<Diagnostic> {
        let mut faults = Vec::new();
        for (bound, place) in self.bounds.iter().zip(&self.bound_places) {
            if let Err(refused) = bound::read(program, std::slice::from_ref(bound)) {
                faults.push(*fault(*place, format!("bound {refused}")));
            }
        }
        for name in &self.undefined {
            if let Err(refused) = bound::undefined(program, &[&**name]) {
                faults.push(*fault(name.span(), refused.to_string()));
            }
        }
        if let Some(fair) = self.fair.as_ref().filter(|fair| !["weak", "strong"].contains(&&***fair)) {
            faults.push(*fault(fair.span(), "`fair` is neither weak nor strong"));
        }
        faults
    }
}

/// What a text says.
///
/// # Errors
/// The first place that says nothing.
pub fn read(file: FileId, source: &str) -> Result<Verification, Box<Diagnostic>> {
    understood(&node::read(file, source, ID)?)
}

/// Something wrong with such a file.
pub fn fault(span: Span, message: impl Into<String>) -> Box<Diagnostic> {
    Box::new(Diagnostic::error(ID, span, message.into()))
}

fn understood(root: &Node) -> Result<Verification, Box<Diagnostic>> {
    let mut verification = Verification::default();
    let entries = match &root.shape {
        Shape::Map(entries) => entries,
        Shape::Text(text) if text.is_empty() => return Ok(verification),
        _ => {
            return Err(fault(
                root.span,
                "a mapping is expected: bounds, undefined, assume, terminal, fair, invariants, ctl, ltl",
            ));
        }
    };
    for (Key { text: key, span }, node) in entries {
        match key.as_str() {
            "bounds" => {
                let Shape::Map(inputs) = &node.shape else {
                    return Err(fault(node.span, "a mapping of inputs to values is expected"));
                };
                for (input, values) in inputs {
                    let values = Scalar::joined(texts(values)?, ",");
                    verification.bounds.push(format!("{}={}", input.text, values.as_deref().unwrap_or_default()));
                    let end = values.map_or(input.span.end, |values| values.span().end);
                    verification.bound_places.push(Span { end, ..input.span });
                }
            }
            "undefined" => verification.undefined = texts(node)?,
            "terminal" => verification.terminal = Scalar::joined(texts(node)?, " "),
            "fair" => verification.fair = Scalar::joined(texts(node)?, " "),
            "invariants" => verification.properties[0] = texts(node)?,
            "ctl" => verification.properties[1] = texts(node)?,
            "ltl" => verification.properties[2] = texts(node)?,
            "assume" => verification.assumptions = texts(node)?,
            other => return Err(fault(*span, format!("`{other}` says nothing here"))),
        }
    }
    Ok(verification)
}

/// A text, or a list of texts.
fn texts(node: &Node) -> Result<Vec<Scalar>, Box<Diagnostic>> {
    match &node.shape {
        Shape::Text(text) => Ok(vec![text.clone()]),
        Shape::List(items) => {
            let item = |item| texts(item).map(|texts| Scalar::joined(texts, ","));
            items.iter().filter_map(|of| item(of).transpose()).collect()
        }
        Shape::Map(_) => Err(fault(node.span, "a text or a list of texts is expected")),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_a_file_says() {
        let source = "bounds: { level: 0..10, colour: [RED, GREEN] }\nundefined: [level, colour]\nfair: weak\nctl: [a, b]\nltl: c\n";
        let said = read(FileId(0), source).expect("it says something");
        assert_eq!(said.bounds, ["level=0..10", "colour=RED,GREEN"]);
        assert_eq!(&source[said.bound_places[1].range()], "colour: [RED, GREEN");
        assert_eq!(said.undefined.iter().map(|name| &**name).collect::<Vec<_>>(), ["level", "colour"]);
        assert_eq!((said.fair.as_deref(), said.terminal), (Some("weak"), None));
        assert_eq!(
            said.properties.map(|texts| texts.iter().map(|text| text.to_string()).collect::<Vec<_>>()),
            [vec![], vec!["a".to_string(), "b".to_string()], vec!["c".to_string()]]
        );
        assert_eq!(read(FileId(0), "").ok(), Some(Verification::default()));
    }

    #[test]
    fn trouble() {
        let check = |source: &str, at: u32, message: &str| {
            let fault = read(FileId(0), source).expect_err("a fault");
            assert_eq!((fault.id, fault.primary.span.start, fault.message.as_str()), (ID, at, message));
        };
        check("fair: weak\nlimit: 10\n", 11, "`limit` says nothing here");
        check("ctl: { a: b }\n", 5, "a text or a list of texts is expected");
        check("fair: 'weak", 6, "this is not YAML: while scanning a quoted scalar, found unexpected end of stream");
    }
}
