//! What our own export wrote, read back shape by shape.
//!
//! In: the guards, actions and sequences that the export declares, and the paths of its transitions. Out: their shapes and arrows. A
//! transition that was changed in another tool is left to the reader of foreign ones. SYNC(scxml): `export.rs`.

use std::collections::BTreeMap;
use std::fmt::Write;

use roxmltree::Node;

use super::super::names::function;
use super::super::tree::text_of;
use super::super::ways::{Way, arrows};
use super::{DONE, Reader};
use crate::export::{NAMESPACE, condition, script};
use crate::read::spoken;

/// A guard, an action, or an instance in which the machine does not stay, of our own export.
pub(super) struct Own<'d> {
    is_guard: bool,
    /// `guard`, `action` or `instance`.
    word: &'d str,
    /// What our own export says of it.
    node: Node<'d, 'd>,
    /// The composite state in which it stands.
    around: Option<usize>,
    /// The text that it stands for.
    text: String,
}

/// What our own export says of the actions of a composite state.
pub(super) struct Handler<'d> {
    /// `entry` or `exit`.
    pub word: &'static str,
    /// The element that does them.
    pub element: &'static str,
    /// Their declarations.
    pub shapes: Vec<Node<'d, 'd>>,
    /// What that element says, if it was not changed since.
    pub script: Option<String>,
}

fn ours<'d>(of: Node<'d, 'd>) -> impl Iterator<Item = Node<'d, 'd>> {
    of.children().filter(|node| node.tag_name().namespace() == Some(NAMESPACE))
}

/// Text with single spaces, as scripts are read.
fn spaced(text: &str) -> String {
    text.split_whitespace().collect::<Vec<_>>().join(" ")
}

impl<'d> Reader<'d, '_> {
    /// The paths of our own export. A shape on paths that go on differently gets copies, which do what it does.
    pub(super) fn ways(&mut self, declared: &BTreeMap<String, Own<'d>>) -> String {
        let ways = std::mem::take(&mut self.ways);
        let made = arrows(&ways, &mut |name| self.names.fresh(name));
        for (name, copies) in &made.copies {
            let Some(own) = declared.get(name) else { continue };
            for (index, copy) in copies.iter().enumerate() {
                // An instance is declared already.
                if index == 0 && own.word == "instance" {
                    continue;
                }
                let shape = self.shape(own.word, copy, &|what| match (what, index) {
                    ("link", 1..) if own.word != "instance" => Some(own.text.clone()),
                    // It is refined once.
                    ("refine", 1..) => None,
                    ("text", _) => Some(own.node.attribute(what).map_or_else(|| spoken(name), str::to_string)),
                    _ => own.node.attribute(what).map(str::to_string),
                });
                self.declare(own.around, shape);
            }
        }
        for sequence in &mut self.sequences {
            let all = |name: &String| match (made.copies.get(name), declared.get(name)) {
                (Some(copies), _) => copies.clone(),
                // It is on no path any more.
                (None, Some(own)) if own.word == "action" => Vec::new(),
                (None, _) => vec![name.clone()],
            };
            *sequence = sequence.iter().flat_map(all).collect();
        }
        self.sequences.retain(|sequence| sequence.len() > 1);
        let mut text = String::new();
        for (from, branch, to) in made.all {
            let exit = branch.map_or("", |branch| if branch { " yes" } else { " no" });
            let _ = writeln!(text, "{from}{exit} -> {to}");
        }
        text
    }

    /// The guards, actions and sequences that our own export declares. Where its composite states are not read back, no path of it is.
    pub(super) fn declared(&mut self) -> BTreeMap<String, Own<'d>> {
        let mut found = BTreeMap::new();
        let states: Vec<_> = self.states.all.iter().map(|state| state.node).enumerate().collect();
        let states = states.into_iter().map(|(index, node)| (Some(index), node));
        let elements: Vec<_> = std::iter::once((None, self.document))
            .chain(states)
            .flat_map(|(around, of)| ours(of).map(move |node| (around, node)))
            .collect();
        for (around, node) in elements {
            let word = node.tag_name().name();
            if let ("sequence", None, Some(names), true) = (word, around, node.attribute("names"), self.is_restored()) {
                self.sequences.push(names.split(',').map(|name| name.trim().to_string()).collect());
                continue;
            }
            let is_declared = match word {
                "guard" | "action" => self.is_restored(),
                // These stand on no path.
                "instance" | "abort" => true,
                _ => false,
            };
            let Some(name) = node.attribute("name").filter(|_| is_declared) else { continue };
            let name = self.names.fresh(name);
            let around = around.filter(|_| self.frames.is_some());
            // An instance is declared at once, since it may stand beside all paths; a guard or an action only if a path contains it.
            if !["guard", "action"].contains(&word) {
                let shape = self.shape(word, &name, &|what| node.attribute(what).map(str::to_string));
                self.declare(around, shape);
            }
            if word != "abort" {
                let is_guard = word == "guard";
                let text = self.text(node, &name, is_guard);
                found.insert(name, Own { is_guard, word, node, around, text });
            }
        }
        found
    }

    /// Whether the paths of our own export are read back.
    fn is_restored(&self) -> bool {
        self.frames.is_some() || self.states.all.iter().all(|state| !state.compound)
    }

    /// What a shape of our own export stands for: its link, or what is made of its name.
    fn text(&self, node: Node<'d, 'd>, name: &str, is_guard: bool) -> String {
        if let Some(link) = node.attribute("link") {
            return link.to_string();
        }
        let parameters = self.document.attribute((NAMESPACE, "parameters")).unwrap_or_default();
        let words = parameters.split(|letter: char| letter.is_whitespace() || "(),".contains(letter));
        let variables = words.filter(|word| word.starts_with('$')).collect::<Vec<_>>().join(", ");
        match (is_guard, variables.is_empty()) {
            (true, true) => function(name),
            (true, false) => format!("{}({variables})", function(name)),
            (false, _) => format!("r_{name}[{variables}]"),
        }
    }

    /// What our own export says of the actions of a composite state.
    pub(super) fn handlers_of(&self, state: Node<'d, 'd>) -> [Handler<'d>; 2] {
        [("entry", "onentry"), ("exit", "onexit")].map(|(word, element)| {
            let shapes: Vec<_> = ours(state).filter(|node| node.tag_name().name() == word).collect();
            let name = |node: &Node<'d, 'd>| node.attribute("name").unwrap_or_default();
            let rules: Vec<_> = shapes.iter().map(|node| spaced(&self.text(*node, name(node), false))).collect();
            Handler { word, element, shapes, script: script(&rules) }
        })
    }

    /// Restores a transition of our own export, unless it has been changed since.
    pub(super) fn own(
        &mut self,
        transition: Node<'d, 'd>,
        state: usize,
        is_pattern: bool,
        declared: &BTreeMap<String, Own<'d>>,
    ) -> bool {
        let is_ours = self.document.attribute((NAMESPACE, "kind")).is_some();
        if !is_ours || !self.is_restored() {
            return false;
        }
        // A path without guards and actions has no attribute `path`.
        let path = transition.attribute((NAMESPACE, "path")).unwrap_or_default();
        let (mut stops, mut tests, mut rules) = (Vec::new(), Vec::new(), Vec::new());
        for stop in path.split(',').map(str::trim).filter(|stop| !stop.is_empty()) {
            let (name, branch) = match stop.rsplit_once(' ') {
                Some((name, branch)) => (name, Some(branch == "yes")),
                None => (stop, None),
            };
            match (declared.get(name), branch) {
                (Some(own), Some(holds)) if own.is_guard => tests.push(condition(&own.text, holds)),
                (Some(own), None) if !own.is_guard => rules.push(spaced(&own.text)),
                _ => return false,
            }
            stops.push((name.to_string(), branch));
        }
        let event = transition.attribute("event").is_none_or(|event| event.starts_with(DONE));
        let written = self.own_condition(transition, state).unwrap_or_default();
        let done: Vec<String> = transition.children().filter(|child| child.is_element()).map(text_of).collect();
        if !event || written != tests.join(" and ") || done != Vec::from_iter(script(&rules)) {
            return false;
        }
        let Some(to) = transition.attribute("target").and_then(|id| self.framed_target(id, is_pattern)) else {
            return false;
        };
        self.ways.push(Way { from: self.stop(state, is_pattern), stops, to });
        true
    }
}
