//! Reads SCXML as a chart: nested states become flat, transitions become paths that are tried in order.
//!
//! In: an SCXML document as defined by the W3C, <https://www.w3.org/TR/scxml/>, and as tools write it. Out: the text of
//! a chart. SCXML takes the first enabled transition, those of inner states before those of outer ones; so each path
//! leads through the `no` exits of those before it. An event becomes a guard that is true when the event comes; a
//! condition in AsmetaL becomes a guard, too. Text in another language becomes the text of a shape to be refined. A
//! transition executes, in sequence, the exit actions, its own actions and the entry actions. What our own export wrote
//! is read back shape by shape (`own`), with its composite states (`frames`).

mod crowded;
mod frames;
mod own;
mod remembered;

use std::collections::{BTreeMap, BTreeSet};
use std::fmt::Write;

use roxmltree::{Document, Node};
use syntax::{Diagnostic, FileId, Severity, Span};

use super::Imported;
use super::names::{Names, bare, function};
use super::tree::{States, is, is_scxml, machines, place, text_of};
use super::ways::Way;
use crate::export::NAMESPACE;
use crate::fault::foreign as fault;
use crate::read::spoken;
use crate::write::quoted;
use crowded::{MAX_ATTRIBUTES, crowded_tag};
use frames::Frames;
use own::Own;
use remembered::Remembered;

/// Reads an SCXML document; `name` is the chart's name, `file` identifies the text in faults.
pub fn scxml(file: FileId, text: &str, name: &str) -> Imported {
    if let Some(at) = crowded_tag(text) {
        let span = Span { file, start: at, end: at };
        let message = format!("an element has more than {MAX_ATTRIBUTES} attributes");
        return Imported { text: None, diagnostics: vec![fault::malformed(span, &message)] };
    }
    let document = match Document::parse(text) {
        Ok(document) => document,
        Err(error) => {
            let at = offset(text, error.pos());
            let span = Span { file, start: at, end: at };
            return Imported { text: None, diagnostics: vec![fault::malformed(span, &error.to_string())] };
        }
    };
    let root = document.root_element();
    if !is(root, "scxml") {
        let message = format!("its outermost element is `{}`", root.tag_name().name());
        return Imported { text: None, diagnostics: vec![fault::malformed(place(file, root), &message)] };
    }
    let mut faults = Vec::new();
    let mut out = format!("chart {}\n", bare(name));
    let all = machines(&document);
    let mut machine_names = Names::default();
    let mut imports = BTreeSet::new();
    let mut texts = String::new();
    for machine in &all {
        let called = machine.attribute(if *machine == root { "name" } else { "id" }).unwrap_or(name);
        let called = machine_names.fresh(called);
        let mut reader = Reader::new(file, root, *machine, &mut faults);
        texts.push_str(&reader.machine(&called));
        imports.append(&mut reader.imports);
    }
    for import in imports {
        let _ = writeln!(out, "import \"{import}.chart\"");
    }
    out.push_str(&texts);
    faults.sort_by_key(|fault| fault.primary.span.start);
    faults.dedup();
    let sound = faults.iter().all(|fault| fault.severity != Severity::Error);
    Imported { text: sound.then(|| joined(file, &out)), diagnostics: faults }
}

/// The text of a chart, its arrows joined into paths. One that has faults as a chart stays as it is but for its layout.
fn joined(file: FileId, text: &str) -> String {
    let parse = syntax::parse_chart(file, text);
    let (chart, faults) = crate::read::read(file, &parse);
    let is_whole = parse.diagnostics.iter().chain(&faults).all(|fault| fault.severity != Severity::Error);
    if is_whole { crate::write::write(&chart) } else { syntax::format(&parse) }
}

fn offset(text: &str, at: roxmltree::TextPos) -> u32 {
    let line = text.split_inclusive('\n').take(at.row.saturating_sub(1) as usize).map(str::len).sum::<usize>();
    let column = text[line..].chars().take(at.col.saturating_sub(1) as usize).map(char::len_utf8).sum::<usize>();
    (line + column).min(text.len()) as u32
}

struct Reader<'d, 'f> {
    file: FileId,
    document: Node<'d, 'd>,
    root: Node<'d, 'd>,
    states: States<'d>,
    /// Whether conditions and scripts are AsmetaL.
    asmetal: bool,
    names: Names,
    /// The composite states, if they can be read back.
    frames: Option<Frames>,
    /// The composite states of a foreign document.
    remembered: Remembered,
    /// The names of the states in the chart.
    called: BTreeMap<usize, String>,
    /// The declarations in each composite state, and outside of all.
    shapes: BTreeMap<Option<usize>, Vec<Declared>>,
    sequences: Vec<Vec<String>>,
    paths: String,
    /// Paths of our own export.
    ways: Vec<Way>,
    /// Functions and rules for texts in another language.
    foreign: BTreeMap<(&'static str, String), String>,
    /// Charts of the invoked patterns.
    imports: BTreeSet<String>,
    faults: &'f mut Vec<Diagnostic>,
}

/// A declaration in a chart.
enum Declared {
    /// A shape.
    Shape(String),
    /// The head of a composite state, which is the state with this number.
    Composite(String, usize),
}

impl<'d, 'f> Reader<'d, 'f> {
    fn new(file: FileId, document: Node<'d, 'd>, root: Node<'d, 'd>, faults: &'f mut Vec<Diagnostic>) -> Self {
        let states = States::of(file, root, faults);
        let frames = match Frames::of(file, document, root, &states) {
            Ok(frames) => frames,
            Err(fault) => {
                faults.push(*fault);
                None
            }
        };
        Reader {
            file,
            document,
            root,
            states,
            asmetal: document.attribute("datamodel") == Some("asmetal"),
            names: Names::default(),
            frames,
            remembered: Remembered::default(),
            called: BTreeMap::new(),
            shapes: BTreeMap::new(),
            sequences: Vec::new(),
            paths: String::new(),
            ways: Vec::new(),
            foreign: BTreeMap::new(),
            imports: BTreeSet::new(),
            faults,
        }
    }

    fn machine(&mut self, name: &str) -> String {
        let own = |name: &str| self.document.attribute((NAMESPACE, name)).map(str::to_string);
        let is_pattern = own("kind").as_deref() == Some("pattern");
        let word = if is_pattern { "pattern" } else { "machine" };
        let text = own("text").unwrap_or_else(|| spoken(name));
        let parameters = own("parameters").map(|list| format!("({list})")).unwrap_or_default();
        let rule = own("rule").map(|rule| format!(" {{{rule}}}")).unwrap_or_default();
        let control = own("control").or_else(|| (!is_pattern).then(|| function(&format!("{name}State"))));
        let declared = self.declared();
        self.unused(self.document);
        let start = if self.frames.is_some() { None } else { self.initial(self.root, None) };
        if self.frames.is_none() && !self.states.histories.is_empty() {
            let leaves: Vec<Option<usize>> = (0..self.states.all.len()).map(|state| self.leaf(state)).collect();
            let found = Remembered::of(self.file, &self.states, start, &|state| leaves[state]);
            self.remembered = found.unwrap_or_else(|refused| {
                self.faults.push(*refused);
                Remembered::default()
            });
        }
        for index in 0..self.states.all.len() {
            self.state(index, start, is_pattern);
        }
        for index in 0..self.states.all.len() {
            if self.frames.is_some() || !self.states.all[index].compound {
                self.transitions(index, is_pattern, &declared);
            }
        }
        let mut out = format!("\n{word} {name}{parameters} {}{rule}\n", quoted(&text));
        if let Some(control) = control {
            let _ = writeln!(out, "control {control}");
        }
        let ways = self.ways(&declared);
        self.write_shapes(None, &mut out);
        for sequence in &self.sequences {
            let _ = writeln!(out, "sequence {}", sequence.join(", "));
        }
        let _ = writeln!(out, "{ways}{}end{word}", self.paths);
        out
    }

    /// The declaration of a shape with its attributes.
    fn shape(&mut self, word: &str, name: &str, about: &dyn Fn(&str) -> Option<String>) -> String {
        let mut shape = format!("{word} {name}");
        if let Some(of) = about("of") {
            let _ = write!(shape, " of {of}({})", about("arguments").unwrap_or_default());
            self.imports.insert(of);
        }
        let _ = write!(shape, " {}", quoted(&about("text").unwrap_or_else(|| spoken(name))));
        if let Some(link) = about("link") {
            let _ = write!(shape, " {{{link}}}");
        }
        match about("refine") {
            Some(by) if by.is_empty() => shape.push_str(" to refine"),
            Some(by) => _ = write!(shape, " to refine by {by}"),
            None => {}
        }
        shape
    }

    /// Declares a shape, in a composite state or outside of all.
    fn declare(&mut self, around: Option<usize>, shape: String) {
        self.shapes.entry(around).or_default().push(Declared::Shape(shape));
    }

    fn write_shapes(&self, around: Option<usize>, out: &mut String) {
        for declared in self.shapes.get(&around).into_iter().flatten() {
            match declared {
                Declared::Shape(shape) => _ = writeln!(out, "{shape}"),
                Declared::Composite(head, state) => {
                    let _ = writeln!(out, "{head}");
                    self.write_shapes(Some(*state), out);
                    out.push_str("endstate\n");
                }
            }
        }
    }

    /// Reports elements that have no counterpart.
    fn unused(&mut self, node: Node<'d, 'd>) {
        for child in node.children().filter(|child| child.is_element() && is_scxml(*child)) {
            let at = place(self.file, child);
            match child.tag_name().name() {
                "datamodel" => {
                    let data: Vec<_> = child.children().filter(|data| is(*data, "data")).collect();
                    for data in data {
                        let what = format!("the data `{}`", data.attribute("id").unwrap_or_default());
                        self.faults.push(fault::left_out(
                            place(self.file, data),
                            &what,
                            "declare it in the specification",
                        ));
                    }
                }
                "script" => {
                    let help = "write what it does in the initial state of the specification";
                    self.faults.push(fault::left_out(at, "the script of the document", help));
                }
                "donedata" => self.faults.push(fault::left_out(at, "`donedata`", "keep it in the specification")),
                "state" | "final" | "parallel" | "history" | "transition" | "onentry" | "onexit" | "initial"
                | "invoke" => {}
                other => {
                    let what = format!("the element `{other}`");
                    self.faults.push(fault::left_out(at, &what, "say what it means in the specification"));
                }
            }
        }
    }

    /// The flat initial state of a state, or of the whole machine.
    fn initial(&mut self, node: Node<'d, 'd>, parent: Option<usize>) -> Option<usize> {
        let element = node.children().find(|child| is(*child, "initial"));
        let transition = element.and_then(|element| element.children().find(|child| is(*child, "transition")));
        let said = node.attribute("initial").or_else(|| transition?.attribute("target"));
        if let Some(content) = transition.filter(|transition| transition.children().any(|child| child.is_element())) {
            let help = "do it on a path to the state";
            self.faults.push(fault::left_out(place(self.file, content), "the content of `initial`", help));
        }
        let first = match said {
            // That a state begins in a `history` is told where histories are read.
            Some(ids) if parent.is_some() && self.states.is_history(ids) => None,
            Some(ids) => {
                let found = self.states.begins(ids.split_whitespace().next().unwrap_or_default(), parent);
                found.map_err(|fault| self.faults.push(fault(place(self.file, node)))).ok()
            }
            None => self.states.first_in(parent),
        }?;
        self.leaf(first)
    }

    /// The flat state that is reached by entering a state.
    fn leaf(&mut self, state: usize) -> Option<usize> {
        let mut state = state;
        for _ in 0..self.states.all.len() {
            if !self.states.all[state].compound {
                return Some(state);
            }
            state = self.initial(self.states.all[state].node, Some(state))?;
        }
        None
    }

    fn state(&mut self, index: usize, start: Option<usize>, is_pattern: bool) {
        let (node, id, compound) =
            (self.states.all[index].node, self.states.all[index].id.clone(), self.states.all[index].compound);
        self.unused(node);
        let own = |name: &str| node.attribute((NAMESPACE, name)).map(str::to_string);
        for invoke in node.children().filter(|child| is(*child, "invoke")) {
            if own("of").is_none() {
                let what = "`invoke`";
                let help = "draw what it does as an instance of a pattern, or as an action";
                self.faults.push(fault::left_out(place(self.file, invoke), what, help));
            }
        }
        if start == Some(index) && !is_pattern {
            for entry in self.states.around(index) {
                let content = self.states.all[entry].node.children().find(|child| is(*child, "onentry"));
                if let Some(content) = content.filter(|content| content.children().any(|child| child.is_element())) {
                    let what = "the entry action of the first state, at the start,";
                    let help = "write it in the initial state of the specification; later entries execute it";
                    self.faults.push(fault::left_out(place(self.file, content), what, help));
                }
            }
        }
        let ends = is_pattern && (id == "enter" || is(node, "final") && id == "exit");
        let is_framed = self.frames.is_some() || self.remembered.first.contains_key(&index);
        if compound && !is_framed || ends {
            return;
        }
        let name = self.names.fresh(&id);
        self.called.insert(index, name.clone());
        let begins = match &self.frames {
            Some(frames) => frames.is_first(index),
            None => match self.states.all[index].parent.and_then(|parent| self.remembered.first.get(&parent)) {
                Some(first) => *first == index,
                None => start.is_some_and(|start| self.states.around(start).contains(&index)),
            },
        };
        let word = match own("of") {
            Some(_) => "instance".to_string(),
            None => {
                let parent = self.states.all[index].parent;
                let initial = if begins && !(is_pattern && parent.is_none()) { "initial " } else { "" };
                format!("{initial}{}state", if compound { "composite " } else { "" })
            }
        };
        let text = own("text").unwrap_or_else(|| spoken(&id));
        let shape = self.shape(&word, &name, &|what| if what == "text" { Some(text.clone()) } else { own(what) });
        let around = self.frame_around(index);
        if compound {
            self.shapes.entry(around).or_default().push(Declared::Composite(shape, index));
            self.frame(index);
        } else {
            self.declare(around, shape);
        }
    }

    /// The name of a state on paths.
    fn stop(&self, state: usize, is_pattern: bool) -> String {
        match self.called.get(&state) {
            Some(name) => name.clone(),
            None if is_pattern && self.states.all[state].id == "enter" => "enter".to_string(),
            None => "exit".to_string(),
        }
    }

    /// The paths of a state: its own transitions; of a flat one also those of the enclosing states.
    fn transitions(&mut self, state: usize, is_pattern: bool, declared: &BTreeMap<String, Own<'d>>) {
        let from = self.stop(state, is_pattern);
        let mut before = vec![from.clone()];
        let mut closed: Option<Span> = None;
        let owners = if self.frames.is_some() { vec![state] } else { self.states.around(state) };
        for owner in owners {
            let node = self.states.all[owner].node;
            for transition in node.children().filter(|child| is(*child, "transition")) {
                let at = place(self.file, transition);
                if self.own(transition, state, is_pattern, declared) {
                    continue;
                }
                if closed.is_some() {
                    let what = format!("a transition that `{from}` never comes to");
                    self.faults.push(fault::left_out(at, &what, "an earlier one is always taken"));
                    continue;
                }
                let Some((rest, target)) = self.rest(transition, state, owner, is_pattern) else { continue };
                // When a guard fails, the path continues with the next transition.
                let mut next = Vec::new();
                for guard in self.events(transition) {
                    self.lead(&mut before, &guard);
                    next.push(format!("{guard} yes"));
                    before = vec![format!("{guard} no")];
                }
                if !next.is_empty() {
                    std::mem::swap(&mut before, &mut next);
                }
                if let Some(guard) = self.condition(transition, owner) {
                    self.lead(&mut before, &guard);
                    before = vec![format!("{guard} yes")];
                    next.push(format!("{guard} no"));
                }
                let stops: Vec<String> = rest.into_iter().chain([target]).collect();
                self.lead(&mut before, &stops.join(" -> "));
                if next.is_empty() {
                    closed = Some(at);
                }
                before = next;
            }
        }
    }

    /// Continues the paths from some stops.
    fn lead(&mut self, from: &mut Vec<String>, to: &str) {
        for from in from.drain(..) {
            let _ = writeln!(self.paths, "{from} -> {to}");
        }
    }

    /// A guard for each event of a transition; any one of them suffices.
    fn events(&mut self, transition: Node<'d, 'd>) -> Vec<String> {
        let events = transition.attribute("event").unwrap_or_default().split_whitespace();
        // An instance of ours goes on when its pattern is left.
        let is_block = transition.parent().is_some_and(|state| state.attribute((NAMESPACE, "of")).is_some());
        let all: Vec<&str> = events.filter(|event| !(is_block && event.starts_with(DONE))).collect();
        all.into_iter().map(|event| self.guard(event, event_function(event), false)).collect()
    }

    /// A guard for the condition of a transition.
    fn condition(&mut self, transition: Node<'d, 'd>, owner: usize) -> Option<String> {
        let cond = self.own_condition(transition, owner).filter(|cond| !cond.trim().is_empty())?;
        if self.asmetal && is_term(cond) {
            return Some(self.guard(cond, cond.to_string(), false));
        }
        let (link, new) = self.made("guard", cond, &function);
        if new {
            let at = place(self.file, transition);
            self.faults.push(fault::kept_as_text(at, &format!("the condition `{cond}`"), &link));
        }
        Some(self.guard(cond, link, true))
    }

    /// The name that a text in another language is linked to, the same for all its uses; and whether it is new.
    fn made(&mut self, kind: &'static str, text: &str, name: &dyn Fn(&str) -> String) -> (String, bool) {
        if let Some(known) = self.foreign.get(&(kind, text.to_string())) {
            return (known.clone(), false);
        }
        let base = name(text);
        let mut made = base.clone();
        let mut count = 2;
        while self.foreign.values().any(|known| *known == made) {
            made = format!("{base}{count}");
            count += 1;
        }
        self.foreign.insert((kind, text.to_string()), made.clone());
        (made, true)
    }

    fn guard(&mut self, text: &str, link: String, to_refine: bool) -> String {
        let name = self.names.fresh(&function(text));
        let text = text.to_string();
        let shape = self.shape("guard", &name, &|what| match what {
            "text" => Some(text.clone()),
            "link" => Some(link.clone()),
            "refine" => to_refine.then(String::new),
            _ => None,
        });
        self.declare(None, shape);
        name
    }

    /// The actions of a transition in the order of execution, and its target.
    fn rest(
        &mut self,
        transition: Node<'d, 'd>,
        state: usize,
        owner: usize,
        is_pattern: bool,
    ) -> Option<(Vec<String>, String)> {
        let at = place(self.file, transition);
        let Some(id) = transition.attribute("target") else {
            // Without a target, no state is left or entered.
            let actions = self.actions(transition);
            return Some((actions, self.stop(state, is_pattern)));
        };
        let mut ids = id.split_whitespace();
        let first = ids.next().unwrap_or_default();
        if ids.next().is_some() {
            self.faults.push(fault::no_counterpart(at, "a transition to several states", "lead it to one"));
        }
        if self.frames.is_some() {
            let Some(target) = self.framed_target(first, is_pattern) else {
                self.faults.push(fault::unknown_target(at, first));
                return None;
            };
            let actions = self.actions(transition);
            if actions.len() > 1 {
                self.sequences.push(actions.clone());
            }
            return Some((actions, target));
        }
        let Some(target) = self.states.named(first) else {
            self.faults.push(fault::unknown_target(at, first));
            return None;
        };
        let history = self.states.is_history(first).then_some(target);
        if history.is_some_and(|owner| self.states.around(state).contains(&owner)) {
            let help = "lead it to the state itself, or to one in it";
            self.faults.push(fault::no_counterpart(at, "a transition to the `history` of a state around it", help));
            return None;
        }
        let leaf = if history.is_some() { target } else { self.leaf(target)? };
        // The innermost state that contains both, and is not the target, is neither left nor entered.
        let (left, entered) = (self.states.around(state), self.states.around(leaf));
        let around_target = &self.states.around(target)[usize::from(history.is_none())..];
        let internal = transition.attribute("type") == Some("internal") && around_target.contains(&owner);
        let outer: Vec<usize> = self.states.around(owner).into_iter().skip(usize::from(!internal)).collect();
        let stays = outer.into_iter().find(|around| around_target.contains(around));
        let upto =
            |states: &[usize]| -> Vec<usize> { states.iter().copied().take_while(|one| Some(*one) != stays).collect() };
        let mut actions = Vec::new();
        for state in upto(&left) {
            actions.extend(self.handlers(state, "onexit"));
        }
        actions.extend(self.actions(transition));
        for state in upto(&entered).into_iter().rev() {
            actions.extend(self.handlers(state, "onentry"));
        }
        if actions.len() > 1 {
            self.sequences.push(actions.clone());
        }
        Some((actions, self.stop(leaf, is_pattern)))
    }

    fn handlers(&mut self, state: usize, name: &str) -> Vec<String> {
        let handlers: Vec<_> = self.states.all[state].node.children().filter(|child| is(*child, name)).collect();
        handlers.into_iter().flat_map(|handler| self.actions(handler)).collect()
    }

    /// Executable content, each element an action.
    fn actions(&mut self, of: Node<'d, 'd>) -> Vec<String> {
        let content: Vec<_> = of.children().filter(|child| child.is_element() && is_scxml(*child)).collect();
        content.into_iter().map(|content| self.action(content)).collect()
    }

    fn action(&mut self, node: Node<'d, 'd>) -> String {
        let (name, shape) = self.action_as("action", node);
        self.declare(None, shape);
        name
    }

    /// Executable content as an action, by this word: its name and its declaration.
    fn action_as(&mut self, word: &str, node: Node<'d, 'd>) -> (String, String) {
        let attribute = |name: &str| node.attribute(name).unwrap_or_default();
        let kind = node.tag_name().name();
        let text = match kind {
            "script" => text_of(node),
            "raise" => format!("raise {}", attribute("event")),
            "send" => format!("send {}{}", attribute("event"), attribute("eventexpr")),
            "assign" => format!("{} := {}{}", attribute("location"), attribute("expr"), text_of(node)),
            "log" => format!("log {}", [attribute("label"), attribute("expr")].join(" ")),
            "cancel" => format!("cancel {}", attribute("sendid")),
            _ => node.document().input_text()[node.range()].split_whitespace().collect::<Vec<_>>().join(" "),
        };
        let text = text.trim().to_string();
        let in_asmetal = self.asmetal && kind == "script" && is_rule(&text);
        let (link, new) = match in_asmetal {
            true => (text.clone(), false),
            false => self.made("action", &text, &|text| format!("r_{}", bare(text))),
        };
        if new {
            self.faults.push(fault::kept_as_text(place(self.file, node), &format!("`{kind}`"), &link));
        }
        let link = if in_asmetal { link } else { format!("{link}[]") };
        let name = self.names.fresh(&function(text.trim_start_matches("r_")));
        let shape = self.shape(word, &name, &|what| match what {
            "text" => Some(text.clone()),
            "link" => Some(link.clone()),
            "refine" => (!in_asmetal).then(String::new),
            _ => None,
        });
        (name, shape)
    }
}

/// How the event begins that ends an instance's pattern.
const DONE: &str = "done.invoke.";

/// The Boolean function that is true when an event comes; `*` stands for any event.
fn event_function(event: &str) -> String {
    if event == "*" { "anyEvent".to_string() } else { function(event.trim_end_matches(".*")) }
}

fn is_term(text: &str) -> bool {
    syntax::parse_term(FileId(0), text).diagnostics.is_empty() && !text.contains(['{', '}'])
}

fn is_rule(text: &str) -> bool {
    let parse = syntax::parse_chart(FileId(0), &format!("chart C machine m action a {{{text}}} endmachine"));
    parse.diagnostics.is_empty()
}
