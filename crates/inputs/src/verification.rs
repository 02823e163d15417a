//! `MODEL.verify.yaml`: what to verify of a model, and with which inputs.
//!
//! In: the file's text. Out: a [`Verification`], whose terms are still texts, or the first fault of the form. Whether the
//! terms fit the model is not known here.

use syntax::{Diagnostic, FileId, Span};

use crate::node::{self, Key, Node, Shape};

/// The id of what is wrong with the file.
const ID: &str = "bad-verification-file";

/// What the file says.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct Verification {
    /// As [`bound::read`](crate::bound::read) takes them.
    pub bounds: Vec<String>,
    /// The condition under which a state may be the last.
    pub terminal: Option<String>,
    /// How fair runs are: `weak` or `strong`, unless the file is wrong.
    pub fair: Option<String>,
    /// Invariants, CTL and LTL formulas.
    pub properties: [Vec<String>; 3],
    /// Further assumptions.
    pub assumptions: Vec<String>,
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
                "a mapping is expected: bounds, assume, terminal, fair, invariants, ctl, ltl",
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
                    verification.bounds.push(format!("{}={}", input.text, texts(values)?.join(",")));
                }
            }
            "terminal" => verification.terminal = Some(texts(node)?.join(" ")),
            "fair" => verification.fair = Some(texts(node)?.join(" ")),
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
fn texts(node: &Node) -> Result<Vec<String>, Box<Diagnostic>> {
    match &node.shape {
        Shape::Text(text) => Ok(vec![text.clone()]),
        Shape::List(items) => items.iter().map(|item| texts(item).map(|texts| texts.join(","))).collect(),
        Shape::Map(_) => Err(fault(node.span, "a text or a list of texts is expected")),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_a_file_says() {
        let source = "bounds: { level: 0..10, colour: [RED, GREEN] }\nfair: weak\nctl: [a, b]\nltl: c\n";
        let expected = Verification {
            bounds: vec!["level=0..10".to_string(), "colour=RED,GREEN".to_string()],
            fair: Some("weak".to_string()),
            properties: [vec![], vec!["a".to_string(), "b".to_string()], vec!["c".to_string()]],
            ..Verification::default()
        };
        assert_eq!(read(FileId(0), source).ok(), Some(expected));
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
