//! What goes into a composite state, and out of one: declarations change their place in the text, with all that they hold.
//!
//! In: names of shapes, and the composite state that is to hold them, or none. Out: the text with their lines there. INVARIANT: no name,
//! path or place changes; each composite state and the machine keep an initial state as long as they hold a state.

use syntax::SyntaxKind::{self, *};
use syntax::SyntaxNode;
use syntax::ast::{AstNode, MachineChart, Shape};

use super::arrow::words;
use super::{Section, Work};

fn is(shape: &Shape, name: &str) -> bool {
    shape.name().is_some_and(|own| own.text() == name)
}

/// Whether it is a state, and then whether the machine, or the composite state around it, starts in it.
fn initial(shape: &Shape) -> Option<bool> {
    match shape {
        Shape::State(state) => Some(state.is_initial()),
        Shape::Composite(state) => Some(state.is_initial()),
        Shape::Guard(_)
        | Shape::Action(_)
        | Shape::Entry(_)
        | Shape::Exit(_)
        | Shape::Abort(_)
        | Shape::Instance(_) => None,
    }
}

fn name_of(shape: &Shape) -> Option<String> {
    Some(shape.name()?.text().to_string())
}

impl Work {
    /// See [`super::Operation::Nest`].
    pub(super) fn nest(&mut self, names: &[String], into: Option<&str>) -> Result<(), String> {
        for name in names {
            self.nest_one(name, into)?;
        }
        self.select = names.to_vec();
        Ok(())
    }

    pub(super) fn machine(&self) -> Result<MachineChart, String> {
        match self.section()? {
            Section::Machine(machine) => Ok(machine),
            Section::System(_) => Err("composite states belong to a machine".to_string()),
        }
    }

    fn nest_one(&mut self, name: &str, into: Option<&str>) -> Result<(), String> {
        let machine = self.machine()?;
        let found = machine.shapes().find(|shape| is(shape, name));
        let shape = found.ok_or_else(|| format!("there is no shape `{name}`"))?;
        if matches!(shape, Shape::Entry(_) | Shape::Exit(_) | Shape::Abort(_)) {
            return Err(format!("`{name}` is an action of its composite state, and stays there"));
        }
        let around = shape.around().map_or_else(|| machine.syntax().clone(), |around| around.syntax().clone());
        let wanted = match into {
            None => machine.syntax().clone(),
            Some(into) => {
                let found = machine.shapes().find(|shape| is(shape, into) && matches!(shape, Shape::Composite(_)));
                found.ok_or_else(|| format!("there is no composite state `{into}`"))?.syntax().clone()
            }
        };
        if wanted == around {
            return Ok(());
        }
        if wanted.ancestors().any(|node| node == *shape.syntax()) {
            return Err(format!("`{name}` cannot be put into itself"));
        }
        let (was_initial, was_state) = (initial(&shape) == Some(true), initial(&shape).is_some());
        let home = Shape::cast(around).and_then(|around| name_of(&around));
        if was_state
            && self.states_in(home.as_deref())?.iter().all(|(own, _)| own == name)
            && let Some(home) = &home
        {
            return Err(format!("`{home}` would hold no state any more: put another one into it first, or delete it"));
        }
        // The machine goes on starting where it did: in what now holds the state.
        let level = |holder: &Shape| holder.around().and_then(|around| name_of(&Shape::Composite(around)));
        let holder = wanted.ancestors().filter_map(Shape::cast).find(|holder| level(holder) == home);
        let holder = holder.and_then(|holder| name_of(&holder));
        let text = self.take_out(shape.syntax());
        drop(shape);
        self.put(into, &text)?;
        if initial_word(&text) && self.has_other_initial(into, name)? {
            self.drop_initial(name)?;
        }
        if was_initial {
            self.begin_somewhere(home.as_deref(), holder.as_deref())?;
        }
        self.begin_somewhere(into, None)
    }

    /// Takes a declaration out of the text. Out: its lines, without the blanks of their level.
    pub(super) fn take_out(&mut self, node: &SyntaxNode) -> String {
        let indent = self.indent_of(node);
        let tokens = words(node);
        let start = tokens.first().map_or(0, |token| usize::from(token.text_range().start()));
        let end = tokens.last().map_or(start, |token| usize::from(token.text_range().end()));
        let rest = &self.text[end..];
        let line = rest[..rest.find('\n').unwrap_or(rest.len())].trim_end();
        let begin = self.text[..start].rfind('\n').map_or(0, |at| at + 1);
        let alone = self.text[begin..start].trim().is_empty();
        // A comment at the end of its last line is its own, as where a shape is deleted.
        let whole = if alone && line.trim().starts_with("//") { end + line.len() } else { end };
        let own = self.text[start..whole].to_string();
        let own: Vec<&str> = own.split('\n').map(|line| line.strip_prefix(indent.as_str()).unwrap_or(line)).collect();
        let own = own.join("\n");
        self.remove(node);
        own
    }

    /// Puts lines into a composite state, or into the machine, behind what is declared there.
    pub(super) fn put(&mut self, into: Option<&str>, text: &str) -> Result<(), String> {
        let machine = self.machine()?;
        let found = into.and_then(|into| machine.shapes().find(|shape| is(shape, into)));
        let target = found.map_or_else(|| machine.syntax().clone(), |shape| shape.syntax().clone());
        let inner = match into {
            Some(_) => format!("{}\t", self.indent_of(&target)),
            None => "\t".to_string(),
        };
        let lines: Vec<String> = text
            .split('\n')
            .enumerate()
            .map(
                |(index, line)| if index == 0 || line.is_empty() { line.to_string() } else { format!("{inner}{line}") },
            )
            .collect();
        // Shapes of one kind stand together.
        let kind = kind_of(text);
        let has = target.children().any(|node| node.kind() == kind);
        let declares = |node: &SyntaxNode| match has {
            true => node.kind() == kind,
            false => Shape::cast(node.clone()).is_some() || matches!(node.kind(), HISTORY | CONTROL_VARIABLE),
        };
        self.add_line_in(&target, declares, &lines.join("\n"), &inner);
        Ok(())
    }

    /// Whether another state of a composite state, or of the machine, is its initial one.
    fn has_other_initial(&self, home: Option<&str>, name: &str) -> Result<bool, String> {
        Ok(self.states_in(home)?.iter().any(|(own, is_initial)| *is_initial && own != name))
    }

    /// The states right in a composite state, or in the machine, each with whether it is initial.
    fn states_in(&self, home: Option<&str>) -> Result<Vec<(String, bool)>, String> {
        let machine = self.machine()?;
        let of = |shape: &Shape| {
            let around = shape.around().and_then(|around| name_of(&Shape::Composite(around)));
            (around.as_deref() == home).then(|| Some((name_of(shape)?, initial(shape)?))).flatten()
        };
        Ok(machine.shapes().filter_map(|shape| of(&shape)).collect())
    }

    /// A level that holds states but no initial one gets one: this, or its first.
    fn begin_somewhere(&mut self, home: Option<&str>, wanted: Option<&str>) -> Result<(), String> {
        let states = self.states_in(home)?;
        if self.machine()?.is_pattern() && home.is_none() || states.iter().any(|(_, is_initial)| *is_initial) {
            return Ok(());
        }
        let first = states.iter().find(|(name, _)| Some(name.as_str()) == wanted).or(states.first());
        match first.cloned() {
            Some((name, _)) => self.set_initial(&name),
            None => Ok(()),
        }
    }

    /// The word `initial` of a state goes.
    fn drop_initial(&mut self, name: &str) -> Result<(), String> {
        let machine = self.machine()?;
        let Some(shape) = machine.shapes().find(|shape| is(shape, name)) else { return Ok(()) };
        if let [first, second, ..] = words(shape.syntax()).as_slice()
            && first.kind() == INITIAL_KW
        {
            let range = usize::from(first.text_range().start())..usize::from(second.text_range().start());
            self.replace(range, "");
        }
        Ok(())
    }
}

/// What a declaration declares, by its first words.
fn kind_of(text: &str) -> SyntaxKind {
    let mut words = text.split_whitespace().skip_while(|word| *word == "initial");
    match words.next() {
        Some("composite") => COMPOSITE_STATE,
        Some("guard") => GUARD_SHAPE,
        Some("action") => ACTION_SHAPE,
        Some("instance") => PATTERN_INSTANCE,
        _ => CONTROL_STATE,
    }
}

/// Whether a declaration begins with `initial`.
pub(super) fn initial_word(text: &str) -> bool {
    text.starts_with("initial") && !text["initial".len()..].starts_with(|c: char| c.is_alphanumeric() || c == '_')
}
