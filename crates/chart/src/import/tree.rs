//! The states of an SCXML document: their nesting, their initial states, and their entry and exit actions.
//!
//! In: the elements. Out: [`States`], flat lists with parents. What has no counterpart is reported.

use std::collections::BTreeMap;

use roxmltree::{Document, Node};
use syntax::{Diagnostic, FileId, Span};

use crate::fault::foreign as fault;

/// The namespace of SCXML.
pub(super) const SCXML: &str = "http://www.w3.org/2005/07/scxml";
/// LIMIT: how deeply states may be nested.
const MAX_DEPTH: usize = 100;

/// A state.
#[derive(Debug)]
pub(super) struct State<'d> {
    /// Its id, or one derived from its position.
    pub(super) id: String,
    /// Its element.
    pub(super) node: Node<'d, 'd>,
    /// The enclosing state.
    pub(super) parent: Option<usize>,
    /// Whether it contains states.
    pub(super) compound: bool,
}

/// All states of a machine.
#[derive(Debug, Default)]
pub(super) struct States<'d> {
    /// In the order of the document, outer ones first.
    pub(super) all: Vec<State<'d>>,
    /// The first state with each id.
    named: BTreeMap<String, usize>,
    /// The first state in each state, and in the whole machine.
    first: BTreeMap<Option<usize>, usize>,
    /// The pseudo-states `history`, with the states that they stand in.
    pub(super) histories: Vec<(Node<'d, 'd>, Option<usize>)>,
}

/// The span of the element's name in its start tag.
pub(super) fn place(file: FileId, node: Node<'_, '_>) -> Span {
    let range = node.range();
    let start = range.start as u32;
    // A name of ASCII letters; otherwise only the bracket is marked.
    let text = &node.document().input_text()[range];
    let length = text[1..].bytes().take_while(|byte| byte.is_ascii_alphanumeric() || b":_-.".contains(byte)).count();
    Span { file, start, end: start + 1 + length as u32 }
}

/// Whether it is an SCXML element with this name; the namespace may be missing, as some tools omit it.
pub(super) fn is(node: Node<'_, '_>, name: &str) -> bool {
    node.is_element() && node.tag_name().name() == name && is_scxml(node)
}

pub(super) fn is_scxml(node: Node<'_, '_>) -> bool {
    node.tag_name().namespace().is_none_or(|namespace| namespace == SCXML)
}

/// The text below an element.
pub(super) fn text_of(node: Node<'_, '_>) -> String {
    let texts = node.descendants().filter(Node::is_text).filter_map(|node| node.text());
    texts.collect::<Vec<_>>().join(" ").split_whitespace().collect::<Vec<_>>().join(" ")
}

/// The machines of a document: the whole, or each region if it consists of one `parallel`.
pub(super) fn machines<'d>(document: &'d Document<'d>) -> Vec<Node<'d, 'd>> {
    let root = document.root_element();
    let states: Vec<Node<'_, '_>> = root.children().filter(|node| is_state(*node)).collect();
    match states[..] {
        [only] if is(only, "parallel") => only.children().filter(|node| is_state(*node)).collect(),
        _ => vec![root],
    }
}

/// An element that is a state.
pub(super) fn is_state(node: Node<'_, '_>) -> bool {
    is(node, "state") || is(node, "final") || is(node, "parallel")
}

impl<'d> States<'d> {
    /// The states below an element.
    pub(super) fn of(file: FileId, root: Node<'d, 'd>, faults: &mut Vec<Diagnostic>) -> Self {
        let mut states = States::default();
        states.below(file, root, None, 0, faults);
        states
    }

    fn below(
        &mut self,
        file: FileId,
        node: Node<'d, 'd>,
        parent: Option<usize>,
        depth: usize,
        faults: &mut Vec<Diagnostic>,
    ) {
        for child in node.children().filter(|child| child.is_element() && is_scxml(*child)) {
            let name = child.tag_name().name();
            match name {
                "state" | "final" => {}
                "parallel" => {
                    faults.push(fault::no_counterpart(place(file, child), "`parallel` within other states", PARALLEL));
                    continue;
                }
                "history" => {
                    self.histories.push((child, parent));
                    continue;
                }
                _ => continue,
            }
            if depth > MAX_DEPTH {
                faults.push(fault::no_counterpart(place(file, child), "a state nested so deeply", "flatten it"));
                return;
            }
            let id = child.attribute("id").map_or_else(|| format!("{name}{}", self.all.len() + 1), str::to_string);
            let index = self.all.len();
            let first = *self.named.entry(id.clone()).or_insert(index);
            if first < index {
                faults.push(fault::second_state(place(file, child), &id, place(file, self.all[first].node)));
            }
            self.first.entry(parent).or_insert(index);
            let compound = child.children().any(is_state);
            self.all.push(State { id, node: child, parent, compound });
            self.below(file, child, Some(index), depth + 1, faults);
        }
    }

    /// The state with this id, or with a `history` with this id.
    pub(super) fn named(&self, id: &str) -> Option<usize> {
        self.named.get(id).copied().or_else(|| self.remembered(id))
    }

    /// Whether this is the id of a `history`.
    pub(super) fn is_history(&self, id: &str) -> bool {
        !self.named.contains_key(id) && self.remembered(id).is_some()
    }

    /// The state in which the `history` with this id stands.
    pub(super) fn remembered(&self, id: &str) -> Option<usize> {
        self.histories.iter().find(|(node, _)| node.attribute("id") == Some(id))?.1
    }

    /// The initial state with this id, of a state or of the whole machine.
    pub(super) fn begins(&self, id: &str, parent: Option<usize>) -> Result<usize, impl Fn(Span) -> Diagnostic> {
        let found = self.named(id);
        let within = |state: &usize| parent.is_none_or(|parent| self.around(*state)[1..].contains(&parent));
        found.filter(within).ok_or_else(|| {
            let id = id.to_string();
            let told = if found.is_none() { fault::unknown_target } else { fault::begins_outside };
            move |place| told(place, &id)
        })
    }

    /// The enclosing states of a state, itself first.
    pub(super) fn around(&self, state: usize) -> Vec<usize> {
        let mut around = vec![state];
        while let Some(parent) = around.last().and_then(|last| self.all[*last].parent) {
            around.push(parent);
        }
        around
    }

    /// The first direct child of a state, or of the whole machine.
    pub(super) fn first_in(&self, parent: Option<usize>) -> Option<usize> {
        self.first.get(&parent).copied()
    }
}

const PARALLEL: &str = "make a machine of each region: the machines of a chart run in parallel";
