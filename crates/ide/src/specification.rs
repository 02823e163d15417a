//! The names in report and verification specifications.
//!
//! In: the text of `MODEL.report.yaml` or `MODEL.verify.yaml`, and the model. Out: the places of names in its terms, and what they
//! mean. A term may be a pattern in which `{}` stands for each name of a list: the name is then found where the list has it.
//! What is text for people is not looked at. A name that is put together of both has no place.

use std::ops::Range;

use groundstate::Kind;
use groundstate::inputs::node::{Key, Node, Shape, read};
use groundstate::inputs::{Scalar, verification};
use model::{Model, Referent, Use};
use syntax::ast::{AstNode, TermFile};
use syntax::{FileId, SourceFile, Span};

/// The keys of a lane's entry that are text for people.
const TOLD: [&str; 4] = ["name", "caption", "from", "to"];

/// The names of a specification.
pub(crate) fn names(model: &mut Model, file: FileId, source: &SourceFile, kind: Kind) -> Vec<Use> {
    let mut walk = Walk { model, file, source, names: Vec::new() };
    if kind == Kind::Verification {
        walk.verification();
    }
    if let Ok(root) = read(file, &source.text, "")
        && let Shape::Map(entries) = &root.shape
    {
        match kind {
            Kind::Report => walk.report(Fields(entries)),
            Kind::Verification => walk.bounds(Fields(entries)),
            Kind::Model | Kind::Scenario | Kind::Chart | Kind::Coupling => {}
        }
    }
    let mut names = walk.names;
    names.sort_by_key(|name| (name.span, name.referent));
    names.dedup_by_key(|name| (name.span, name.referent));
    names
}

/// The entries of a mapping.
#[derive(Clone, Copy)]
struct Fields<'a>(&'a [(Key, Node)]);

impl<'a> Fields<'a> {
    fn of(node: Option<&'a Node>) -> Fields<'a> {
        match node.map(|node| &node.shape) {
            Some(Shape::Map(entries)) => Fields(entries),
            _ => Fields(&[]),
        }
    }

    fn get(self, name: &str) -> Option<&'a Node> {
        self.0.iter().find(|(key, _)| key.text == name).map(|(_, node)| node)
    }
}

/// A name that `{}` stands for, and where it is written.
#[derive(Clone)]
struct Given {
    text: String,
    span: Span,
}

struct Walk<'w> {
    model: &'w mut Model,
    file: FileId,
    source: &'w SourceFile,
    names: Vec<Use>,
}

impl Walk<'_> {
    fn verification(&mut self) {
        let Ok(said) = verification::read(self.file, &self.source.text) else { return };
        let formulas = said.properties.iter().flatten().chain(&said.assumptions).chain(&said.terminal);
        for scalar in formulas {
            self.term(scalar, &|part| scalar.place(part), None);
        }
    }

    fn bounds(&mut self, root: Fields<'_>) {
        match root.get("undefined").map(|node| &node.shape) {
            Some(Shape::Text(text)) => self.term(text, &|part| text.place(part), None),
            Some(Shape::List(items)) => items.iter().for_each(|item| self.pattern(item, &[])),
            Some(Shape::Map(_)) | None => {}
        }
        for (key, node) in Fields::of(root.get("bounds")).0 {
            self.key(key);
            match &node.shape {
                Shape::Text(text) => self.term(text, &|part| text.place(part), None),
                Shape::List(items) => items.iter().for_each(|item| self.pattern(item, &[])),
                Shape::Map(_) => {}
            }
        }
    }

    fn report(&mut self, root: Fields<'_>) {
        for (key, _) in Fields::of(root.get("activities")).0 {
            self.key(key);
        }
        for group in ["tasks", "buffers", "queues"] {
            let group = Fields::of(root.get(group));
            let each = given(group.get("each"));
            for shared in ["terms", "counters"] {
                Fields::of(group.get(shared)).0.iter().for_each(|(_, node)| self.pattern(node, &each));
            }
            for (key, own) in Fields::of(group.get("each")).0 {
                let this = [Given { text: key.text.clone(), span: key.span }];
                for (_, node) in Fields::of(Some(own)).0.iter().filter(|(key, _)| !TOLD.contains(&key.text.as_str())) {
                    self.pattern(node, &this);
                }
            }
        }
        for (_, series) in Fields::of(root.get("series")).0 {
            for name in ["value", "bound"] {
                Fields::of(Some(series)).get(name).into_iter().for_each(|node| self.pattern(node, &[]));
            }
        }
        let tasks = given(Fields::of(root.get("tasks")).get("each"));
        let hops = Fields::of(root.get("flow")).get("hops");
        if let Some(Shape::List(hops)) = hops.map(|node| &node.shape) {
            for hop in hops {
                let hop = Fields::of(Some(hop));
                let task = hop.get("task").and_then(text);
                let this: Vec<Given> =
                    task.map(|task| Given { text: task.to_string(), span: task.span() }).into_iter().collect();
                hop.get("value").into_iter().for_each(|node| self.pattern(node, &this));
            }
        }
        for (_, chart) in Fields::of(root.get("charts")).0 {
            let chart = Fields::of(Some(chart));
            let each = match chart.get("each").map(|node| &node.shape) {
                Some(Shape::List(items)) => {
                    let texts = items.iter().filter_map(text);
                    texts.map(|item| Given { text: item.to_string(), span: item.span() }).collect()
                }
                _ => tasks.clone(),
            };
            for (_, machine) in Fields::of(chart.get("machines")).0 {
                Fields::of(Some(machine)).get("when").into_iter().for_each(|node| self.pattern(node, &each));
            }
        }
    }

    /// A key that is a term.
    fn key(&mut self, key: &Key) {
        let span = key.span;
        let quote = u32::from(self.source.text[span.range()].starts_with(['\'', '"']));
        let start = span.start + quote;
        if self.source.text[start as usize..].starts_with(&key.text) {
            self.term(
                &key.text,
                &|part| Span { file: span.file, start: start + part.start, end: start + part.end },
                None,
            );
        }
    }

    /// A term for each name that `{}` may stand for.
    fn pattern(&mut self, node: &Node, each: &[Given]) {
        let Some(scalar) = text(node) else { return };
        if !scalar.contains("{}") {
            self.term(scalar, &|part| scalar.place(part), None);
        }
        for given in each.iter().filter(|_| scalar.contains("{}")) {
            self.term(scalar, &|part| scalar.place(part), Some(given));
        }
    }

    /// The names of a term, in which `{}` is what is given.
    fn term(&mut self, pattern: &str, place: &dyn Fn(Range<u32>) -> Span, given: Option<&Given>) {
        // Pieces of the term: where each begins there, and where it comes from; what is given has no place in the pattern.
        let mut written = String::new();
        let mut pieces: Vec<(Range<u32>, Option<u32>)> = Vec::new();
        let mut at = 0;
        for piece in pattern.split("{}") {
            if at > 0
                && let Some(given) = given
            {
                let start = written.len() as u32;
                written.push_str(&given.text);
                pieces.push((start..written.len() as u32, None));
            }
            let start = written.len() as u32;
            written.push_str(piece);
            pieces.push((start..written.len() as u32, Some(at)));
            at += piece.len() as u32 + 2;
        }
        let parsed = syntax::parse_term(self.file, &written);
        let Some(term) = TermFile::cast(parsed.syntax()).and_then(|file| file.term()) else { return };
        let known = self.model.uses.iter().count();
        self.model.check_term(self.file, &term);
        let found: Vec<Use> = self.model.uses.iter().skip(known).copied().collect();
        for name in found.iter().filter(|name| !matches!(name.referent, Referent::Variable(..))) {
            let span = (name.span.start, name.span.end);
            let Some((piece, from)) = pieces.iter().find(|(piece, _)| piece.start <= span.0 && span.1 <= piece.end)
            else {
                continue;
            };
            let span = match (from, given) {
                (Some(from), _) => place(from + span.0 - piece.start..from + span.1 - piece.start),
                (None, Some(given)) if (piece.start, piece.end) == span => given.span,
                (None, _) => continue,
            };
            let quoted = self.source.text.get(span.range()).is_none_or(|text| text.starts_with(['\'', '"']));
            if !quoted {
                self.names.push(Use { span, ..*name });
            }
        }
    }
}

fn text(node: &Node) -> Option<&Scalar> {
    match &node.shape {
        Shape::Text(text) => Some(text),
        Shape::List(_) | Shape::Map(_) => None,
    }
}

fn given(each: Option<&Node>) -> Vec<Given> {
    Fields::of(each).0.iter().map(|(key, _)| Given { text: key.text.clone(), span: key.span }).collect()
}
