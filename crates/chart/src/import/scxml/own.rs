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
use super::Reader;
use crate::export::{NAMESPACE, condition, script};
use crate::read::spoken;

/// A guard or action of our own export.
pub(super) struct Own {
    pub is_guard: bool,
    /// `guard`, `action` or `instance`, and what our own export says of it.
    word: String,
    about: BTreeMap<String, String>,
    /// Its declaration, which is used if a path contains the shape.
    declaration: String,
    /// The text that it stands for.
    text: String,
}

impl<'d> Reader<'d, '_> {
    /// The paths of our own export. A shape on paths that go on differently gets copies, which do what it does.
    pub(super) fn ways(&mut self, declared: &BTreeMap<String, Own>) -> String {
        let ways = std::mem::take(&mut self.ways);
        let made = arrows(&ways, &mut |name| self.names.fresh(name));
        for (name, copies) in &made.copies {
            let Some(own) = declared.get(name) else { continue };
            // An instance is declared already.
            self.shapes.push_str(&own.declaration);
            for copy in &copies[1..] {
                self.shape(&own.word, copy, &|what| match what {
                    "link" if own.word != "instance" => Some(own.text.clone()),
                    // It is refined once.
                    "refine" => None,
                    "text" => Some(own.about.get(what).cloned().unwrap_or_else(|| spoken(name))),
                    _ => own.about.get(what).cloned(),
                });
            }
        }
        for sequence in &mut self.sequences {
            let all = |name: &String| made.copies.get(name).cloned().unwrap_or_else(|| vec![name.clone()]);
            *sequence = sequence.iter().flat_map(all).collect();
        }
        let mut text = String::new();
        for (from, branch, to) in made.all {
            let exit = branch.map_or("", |branch| if branch { " yes" } else { " no" });
            let _ = writeln!(text, "{from}{exit} -> {to}");
        }
        text
    }

    /// The guards, actions and sequences that our own export declares.
    pub(super) fn declared(&mut self) -> BTreeMap<String, Own> {
        let mut found = BTreeMap::new();
        for node in self.document.children().filter(|node| node.tag_name().namespace() == Some(NAMESPACE)) {
            let word = node.tag_name().name();
            let plain = |name: &str| node.attribute(name).map(str::to_string);
            if let (true, Some(names)) = (word == "sequence", plain("names")) {
                // Of a machine with composite states a name stands there once for each copy, and a sequence for each state.
                let mut sequence: Vec<String> = Vec::new();
                for name in names.split(',').map(str::trim) {
                    if !sequence.iter().any(|known| known == name) {
                        sequence.push(name.to_string());
                    }
                }
                if !self.sequences.contains(&sequence) {
                    self.sequences.push(sequence);
                }
                continue;
            }
            let Some(name) = plain("name").filter(|_| ["guard", "action", "instance"].contains(&word)) else {
                continue;
            };
            let name = self.names.fresh(&name);
            let before = self.shapes.len();
            self.shape(word, &name, &plain);
            // An instance is declared at once, since it may stand beside all paths; other shapes only if a path
            // contains them.
            let declaration = if word == "instance" { String::new() } else { self.shapes.split_off(before) };
            let made = if word == "guard" { function(&name) } else { format!("r_{name}[]") };
            let parameters = self.document.attribute((NAMESPACE, "parameters")).unwrap_or_default();
            let words = parameters.split(|letter: char| letter.is_whitespace() || "(),".contains(letter));
            let variables: Vec<&str> = words.filter(|word| word.starts_with('$')).collect();
            let made = match (word, variables.is_empty()) {
                (_, true) => made,
                ("guard", _) => format!("{made}({})", variables.join(", ")),
                _ => format!("r_{name}[{}]", variables.join(", ")),
            };
            let about = node.attributes().map(|one| (one.name().to_string(), one.value().to_string())).collect();
            let text = plain("link").unwrap_or(made);
            found.insert(name, Own { is_guard: word == "guard", word: word.to_string(), about, declaration, text });
        }
        found
    }

    /// Restores a transition of our own export, unless it has been changed since.
    pub(super) fn own(
        &mut self,
        transition: Node<'d, 'd>,
        is_pattern: bool,
        from: &str,
        declared: &BTreeMap<String, Own>,
    ) -> bool {
        let Some(path) = transition.attribute((NAMESPACE, "path")) else {
            // A path without guards and actions has no attribute `path`.
            let bare = transition.attribute("cond").is_none() && !transition.children().any(|child| child.is_element());
            let event = transition.attribute("event").is_none_or(|event| event.starts_with("done.invoke."));
            let ours = self.document.attribute((NAMESPACE, "kind")).is_some();
            let target = transition.attribute("target").and_then(|id| self.states.named(id));
            return match target.filter(|_| ours && bare && event) {
                Some(target) => {
                    let to = self.stop(target, is_pattern);
                    self.ways.push(Way { from: from.to_string(), stops: Vec::new(), to });
                    true
                }
                None => false,
            };
        };
        let (mut stops, mut tests, mut rules) = (Vec::new(), Vec::new(), Vec::new());
        for stop in path.split(',').map(str::trim) {
            let (name, branch) = match stop.rsplit_once(' ') {
                Some((name, branch)) => (name, Some(branch == "yes")),
                None => (stop, None),
            };
            match (declared.get(name), branch) {
                (Some(own), Some(holds)) if own.is_guard => tests.push(condition(&own.text, holds)),
                (Some(own), None) if !own.is_guard => rules.push(own.text.clone()),
                _ => return false,
            }
            stops.push((name.to_string(), branch));
        }
        let written = transition.attribute("cond").unwrap_or_default();
        let done: Vec<String> = transition.children().filter(|child| child.is_element()).map(text_of).collect();
        let rules = rules.iter().map(|rule| rule.split_whitespace().collect::<Vec<_>>().join(" ")).collect::<Vec<_>>();
        let target = transition.attribute("target").and_then(|id| self.states.named(id));
        let Some(target) = target.filter(|_| written == tests.join(" and ") && done == Vec::from_iter(script(&rules)))
        else {
            return false;
        };
        self.ways.push(Way { from: from.to_string(), stops, to: self.stop(target, is_pattern) });
        true
    }
}
