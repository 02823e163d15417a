//! Composite states of our own export, read back as they were drawn.
//!
//! In: the states of a document. Out: [`Frames`], if the document means what a chart with these composite states means. SCXML takes
//! inner transitions first, a chart those of the states around them; so what lies within has to say that nothing around it is open, as
//! the export says it. A document that another tool has changed in such a way that it does not is read flat, as a foreign one is, and
//! that is told. SYNC(scxml): `export.rs`.

use std::collections::BTreeMap;
use std::rc::Rc;

use roxmltree::Node;
use syntax::{Diagnostic, FileId};

use super::super::tree::{States, is, place, text_of};
use super::Reader;
use super::own::Handler;
use crate::export::{NAMESPACE, bar, history};
use crate::fault::foreign as fault;

/// The composite states of a document.
#[derive(Debug)]
pub(super) struct Frames {
    /// By state, what the conditions of its transitions begin with: that nothing around it is open.
    barred: Vec<Rc<str>>,
    /// By state, whether what is around it begins in it.
    first: Vec<bool>,
}

impl Frames {
    /// The composite states; none if there are none, or the document is another tool's.
    ///
    /// # Errors
    /// Why a document of our own has to be read without them.
    pub(super) fn of(
        file: FileId,
        document: Node<'_, '_>,
        root: Node<'_, '_>,
        states: &States<'_>,
    ) -> Result<Option<Self>, Box<Diagnostic>> {
        let is_ours = document == root && document.attribute((NAMESPACE, "kind")).is_some();
        if !is_ours || !states.all.iter().any(|state| state.compound) {
            return Ok(None);
        }
        let unfit =
            |node, why: &str, help: &str| Err(Box::new(fault::flattened(place(file, node), why, help.to_string())));
        let mut frames = Frames { barred: Vec::new(), first: Vec::new() };
        frames.first = beginnings(root, states).map_err(|node| {
            Box::new(fault::flattened(
                place(file, node),
                "it begins deeper inside",
                "let it begin in one of its own states".into(),
            ))
        })?;
        for (node, owner) in &states.histories {
            let expected = owner.map(|owner| history(&states.all[owner].id));
            if node.attribute("id") != expected.as_deref() || !begins_alike(*node) {
                let help = "give it the id that it had, and let it begin where its state does";
                return unfit(*node, "charts have one history for each composite state", help);
            }
        }
        let mut inside: BTreeMap<usize, Rc<str>> = BTreeMap::new();
        for (index, state) in states.all.iter().enumerate() {
            // What is around it stands before it.
            let barred = state.parent.map_or_else(|| Rc::from(""), |parent| Rc::clone(&inside[&parent]));
            for transition in transitions(state.node) {
                let (why, help) = if stripped(transition, &barred).is_none() {
                    let help = format!(
                        "begin its condition with `{barred}`, so that what leads out of the state around it comes first"
                    );
                    ("it may be taken although what leads out of a state around it is open", help)
                } else if state.compound && transition.attribute("event").is_some() {
                    ("it leads out of a composite state by an event", "write a condition instead".to_string())
                } else if state.compound && transition.attribute("target").is_none() {
                    ("it leaves nothing", "give it a target".to_string())
                } else if transition.attribute("type") == Some("internal") {
                    (
                        "it does not leave the state that it starts from",
                        "let it start from the states inside".to_string(),
                    )
                } else {
                    continue;
                };
                return unfit(transition, why, &help);
            }
            let handler = |child: &Node<'_, '_>| is(*child, "onentry") || is(*child, "onexit");
            if let Some(handler) = state.node.children().find(handler).filter(|_| !state.compound) {
                let help = "do it on the paths, or in the composite state around it";
                return unfit(handler, "only composite states do something when they are entered or left", help);
            }
            if state.compound {
                let own = |transition| stripped(transition, &barred).unwrap_or_default().to_string();
                let bars =
                    [barred.to_string()].into_iter().chain(bar(&transitions(state.node).map(own).collect::<Vec<_>>()));
                inside.insert(index, bars.filter(|bar| !bar.is_empty()).collect::<Vec<_>>().join(" and ").into());
            }
            frames.barred.push(barred);
        }
        Ok(Some(frames))
    }

    /// Whether the machine, or the composite state around it, begins in a state.
    pub(super) fn is_first(&self, state: usize) -> bool {
        self.first[state]
    }
}

fn transitions<'d>(state: Node<'d, 'd>) -> impl Iterator<Item = Node<'d, 'd>> {
    state.children().filter(|child| is(*child, "transition"))
}

/// A transition's condition without what it has to begin with; `None` if it does not.
fn stripped<'d>(transition: Node<'d, 'd>, barred: &str) -> Option<&'d str> {
    let condition = transition.attribute("cond").unwrap_or_default();
    let rest = condition.strip_prefix(barred)?;
    match (barred.is_empty(), rest.is_empty()) {
        (true, _) | (_, true) => Some(rest),
        (false, false) => rest.strip_prefix(" and ").filter(|rest| !is_alternative(rest)),
    }
}

/// Whether a condition has parts, outside of all parentheses, of which one may hold without what stands before an `and` in front of it.
fn is_alternative(condition: &str) -> bool {
    let (mut depth, mut in_string, mut plain) = (0_usize, false, String::new());
    for letter in condition.chars() {
        match letter {
            '"' => in_string = !in_string,
            '(' if !in_string => depth += 1,
            ')' if !in_string => depth = depth.saturating_sub(1),
            _ if depth == 0 && !in_string => plain.push(letter),
            _ => {}
        }
    }
    plain.split_whitespace().any(|word| ["or", "xor", "implies", "iff"].contains(&word))
}

/// Whether a `history` begins where its state does.
fn begins_alike(history: Node<'_, '_>) -> bool {
    let first = transitions(history).next().and_then(|transition| transition.attribute("target"));
    first == history.parent().and_then(|state| state.attribute("initial"))
}

/// By state, whether what is around it begins in it.
///
/// # Errors
/// An element that begins neither in one of its own states nor in the history of one.
fn beginnings<'d>(root: Node<'d, 'd>, states: &States<'d>) -> Result<Vec<bool>, Node<'d, 'd>> {
    let mut first = vec![false; states.all.len()];
    let compound = (0..states.all.len()).filter(|index| states.all[*index].compound).map(Some);
    for around in std::iter::once(None).chain(compound) {
        let node = around.map_or(root, |index| states.all[index].node);
        if let Some(element) = node.children().find(|child| is(*child, "initial")) {
            return Err(element);
        }
        let begins = match node.attribute("initial") {
            None => states.first_in(around),
            Some(id) => Some(states.named(id).filter(|inner| states.all[*inner].parent == around).ok_or(node)?),
        };
        if let Some(begins) = begins {
            first[begins] = true;
        }
    }
    Ok(first)
}

impl<'d> Reader<'d, '_> {
    /// The composite state in which a state is declared.
    pub(super) fn frame_around(&self, state: usize) -> Option<usize> {
        let parent = self.states.all[state].parent;
        parent.filter(|parent| self.frames.is_some() || self.remembered.first.contains_key(parent))
    }

    /// What a composite state says besides its states: its history, and what it does when it is entered and left.
    pub(super) fn frame(&mut self, state: usize) {
        let node = self.states.all[state].node;
        let is_remembered = match &self.frames {
            Some(_) => self.states.histories.iter().any(|(_, owner)| *owner == Some(state)),
            None => self.remembered.with_history.contains(&state),
        };
        if is_remembered {
            let link = node.attribute((NAMESPACE, "history")).unwrap_or_default();
            self.declare(Some(state), format!("history {link}"));
        }
        // What else is done stands on paths.
        if self.frames.is_none() {
            return;
        }
        for Handler { word, element, shapes, script } in self.handlers_of(node) {
            let content: Vec<_> = node.children().filter(|child| is(*child, element)).collect();
            let written: Vec<String> = content.iter().map(|content| text_of(*content)).collect();
            if written == Vec::from_iter(script) {
                for declaration in shapes {
                    let name = declaration.attribute("name").unwrap_or_default();
                    let name = self.names.fresh(name);
                    let shape = self.shape(word, &name, &|what| declaration.attribute(what).map(str::to_string));
                    self.declare(Some(state), shape);
                }
                continue;
            }
            for content in content.into_iter().flat_map(|content| content.children()).filter(Node::is_element) {
                let (_, shape) = self.action_as(word, content);
                self.declare(Some(state), shape);
            }
        }
    }

    /// The state that a transition leads to, on paths.
    pub(super) fn framed_target(&self, id: &str, is_pattern: bool) -> Option<String> {
        if let Some(owner) = self.states.remembered(id) {
            return Some(self.stop(owner, is_pattern));
        }
        let mut target = self.states.named(id)?;
        // What is entered without its history is entered where it begins.
        while self.states.histories.iter().any(|(_, owner)| *owner == Some(target)) {
            let first = |(inner, state): &(usize, &super::super::tree::State<'d>)| {
                state.parent == Some(target) && self.frames.as_ref().is_some_and(|frames| frames.is_first(*inner))
            };
            target = self.states.all.iter().enumerate().find(first)?.0;
        }
        Some(self.stop(target, is_pattern))
    }

    /// The condition of a transition of a state, without what says that nothing around it is open.
    pub(super) fn own_condition(&self, transition: Node<'d, 'd>, owner: usize) -> Option<&'d str> {
        match &self.frames {
            Some(frames) => stripped(transition, &frames.barred[owner]),
            None => transition.attribute("cond"),
        }
    }
}
