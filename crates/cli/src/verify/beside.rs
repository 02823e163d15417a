//! `MODEL.verify.yaml`: what is to be verified of a model, and with which inputs, in a file beside it.
//!
//! In: the file, if it is there. Out: a [`Beside`]. What the command line says of an input, of `terminal` and `fair`, and what it
//! assumes, counts before it; properties are added to those of the model.

use std::path::{Path, PathBuf};

use groundstate::Overlay;
use program::PropertyKind;
use syntax::{Diagnostic, SourceFile, Sources, Span};

use crate::failure::Failure;
use crate::files::read_text;
use crate::report::node::{Key, Node, Shape, read};
use crate::shell::Shell;

/// What the file says.
#[derive(Debug, Default)]
pub struct Beside {
    /// As `--bound` takes them.
    pub bounds: Vec<String>,
    pub terminal: Option<String>,
    pub fair: Option<String>,
    /// Invariants, CTL and LTL formulas.
    pub properties: [Vec<String>; 3],
    /// Further assumptions, as `--assume` takes them.
    pub assumptions: Vec<String>,
}

/// Where the file of a model is.
pub fn path_of(model: &Path) -> PathBuf {
    model.with_extension("verify.yaml")
}

/// Reads the file named, or the one beside the model if there is one; none after a fault, which is shown.
pub fn beside(
    shell: &mut Shell,
    sources: &mut Sources,
    named: Option<&Path>,
    model: &Path,
) -> Result<Option<Beside>, Failure> {
    let path = named.map_or_else(|| path_of(model), Path::to_path_buf);
    let text = match read_text(&path, shell.global.limits.max_file_size) {
        Err(Failure::Missing(_)) if named.is_none() => return Ok(Some(Beside::default())),
        read => read?,
    };
    match parsed(sources, &path, &text) {
        Ok(beside) => Ok(Some(beside)),
        Err(fault) => {
            shell.diagnostic(sources, &fault)?;
            Ok(None)
        }
    }
}

/// What a text says.
fn parsed(sources: &mut Sources, path: &Path, text: &str) -> Result<Beside, Box<Diagnostic>> {
    let file = sources.add(SourceFile::new(path.display().to_string(), text));
    read(file, text).and_then(|root| understood(&root)).map_err(|mut fault| {
        fault.id = "bad-verification-file";
        fault
    })
}

/// The faults of a text against its model: its own, and those of its terms.
pub fn check(asked: &mut Overlay, path: &Path, text: &str) -> Vec<Diagnostic> {
    let beside = match parsed(&mut asked.sources, path, text) {
        Ok(beside) => beside,
        Err(fault) => return vec![*fault],
    };
    let name = path.display().to_string();
    let mut faults = Vec::new();
    if let Err(failure) = super::bound::read(&asked.program, &beside.bounds) {
        faults.push(whole(asked, &failure.to_string()));
    }
    if beside.fair.as_deref().is_some_and(|fair| !["weak", "strong"].contains(&fair)) {
        faults.push(whole(asked, "`fair` is neither weak nor strong"));
    }
    let kinds = [PropertyKind::Invariant, PropertyKind::Ctl, PropertyKind::Ltl];
    let properties =
        kinds.iter().zip(&beside.properties).flat_map(|(kind, texts)| texts.iter().map(|text| (*kind, text)));
    for (kind, text) in beside.assumptions.iter().map(|text| (PropertyKind::Invar, text)).chain(properties) {
        faults.extend(asked.property(kind, &name, text).err().into_iter().flatten());
    }
    if let Some(text) = &beside.terminal {
        faults.extend(asked.ask(&name, text).err().into_iter().flatten());
    }
    faults
}

/// A fault whose line is not known.
fn whole(asked: &Overlay, message: &str) -> Diagnostic {
    let file = asked.sources.iter().map(|(file, _)| file).last().unwrap_or(asked.model.root);
    *fault(Span { file, start: 0, end: 0 }, message)
}

fn fault(span: Span, message: impl Into<String>) -> Box<Diagnostic> {
    Box::new(Diagnostic::error("bad-verification-file", span, message.into()))
}

fn understood(root: &Node) -> Result<Beside, Box<Diagnostic>> {
    let mut beside = Beside::default();
    let entries = match &root.shape {
        Shape::Map(entries) => entries,
        Shape::Text(text) if text.is_empty() => return Ok(beside),
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
                    beside.bounds.push(format!("{}={}", input.text, texts(values)?.join(",")));
                }
            }
            "terminal" => beside.terminal = Some(texts(node)?.join(" ")),
            "fair" => beside.fair = Some(texts(node)?.join(" ")),
            "invariants" => beside.properties[0] = texts(node)?,
            "ctl" => beside.properties[1] = texts(node)?,
            "ltl" => beside.properties[2] = texts(node)?,
            "assume" => beside.assumptions = texts(node)?,
            other => return Err(fault(*span, format!("`{other}` says nothing here"))),
        }
    }
    Ok(beside)
}

/// A text, or a list of texts.
fn texts(node: &Node) -> Result<Vec<String>, Box<Diagnostic>> {
    match &node.shape {
        Shape::Text(text) => Ok(vec![text.clone()]),
        Shape::List(items) => items.iter().map(|item| texts(item).map(|texts| texts.join(","))).collect(),
        Shape::Map(_) => Err(fault(node.span, "a text or a list of texts is expected")),
    }
}
