//! Composite states that are pasted: their declarations word by word, with names that are free where they come.
//!
//! In: the text of a declaration, from this chart or another one, and where its shapes are to lie. Out: the drawing's text with it, and the
//! names that it got. What leads out of it, or names what it does not hold, is left out, as the arrows of other shapes that are copied.
//! INVARIANT: comments, links, history, and what is done on entering and leaving come along; nothing else of a text is taken over than one
//! composite state.

use std::collections::{BTreeMap, BTreeSet};

use syntax::ast::{AstNode, ChartFile, MachineChart, PathStop, Shape};

use super::nest::initial_word;
use super::{Centre, Copied, Section, Work};

/// The name of the machine in which a declaration is read.
const PROBE: &str = "probe";

impl Work {
    /// Pastes a composite state. Out: its name, and what the shapes of it are called now, by their former names.
    pub(super) fn paste_composite(&mut self, copied: &Copied) -> Result<(String, BTreeMap<String, String>), String> {
        let Section::Machine(machine) = self.section()? else {
            return Err("composite states belong to a machine".to_string());
        };
        let is_pattern = machine.is_pattern();
        let has_state = machine.shapes().any(|shape| matches!(shape, Shape::State(_) | Shape::Composite(_)));
        let has_control = machine.control().is_some();
        drop(machine);
        if !has_state && !has_control {
            let control = self.fresh_name(&format!("{}State", self.drawing), "phase")?;
            self.add_line(|_| false, &format!("control {control}"))?;
        }
        let mut probe = probe_of(&copied.source)?;
        probe.leave_others()?;
        let names = self.rename_apart(&mut probe)?;
        let machine = probe.machine()?;
        let whole = machine.shapes().next().ok_or("there is no composite state to paste")?;
        let name = whole.name().map(|name| name.text().to_string()).unwrap_or_default();
        let text = probe.take_out(whole.syntax());
        let text = if initial_word(&text) { text["initial".len()..].trim_start() } else { &text };
        self.put(None, text)?;
        if !has_state && !is_pattern {
            self.set_initial(&name)?;
        }
        let known = self.placeable()?;
        let place =
            |(old, at): (&String, &Centre)| Some((names.get(old).filter(|name| known.contains(name))?.clone(), *at));
        let places: BTreeMap<String, Centre> = copied.places.iter().filter_map(place).collect();
        self.place(&places)?;
        Ok((name, names))
    }

    /// Takes away what names shapes that are not declared here.
    fn leave_others(&mut self) -> Result<(), String> {
        loop {
            let machine = self.machine()?;
            let own = declared(&machine);
            let named = machine.paths().flat_map(|path| path.stops().collect::<Vec<_>>());
            let named = named.filter_map(|stop: PathStop| match (stop.is_enter(), stop.is_exit()) {
                (true, _) => Some("enter".to_string()),
                (_, true) => Some("exit".to_string()),
                _ => Some(stop.name()?.text().to_string()),
            });
            let named = named.chain(
                machine
                    .sequences()
                    .flat_map(|sequence| sequence.names().map(|name| name.text().to_string()).collect::<Vec<_>>()),
            );
            let Some(other) = named.collect::<Vec<_>>().into_iter().find(|name| !own.contains(name)) else {
                return Ok(());
            };
            drop(machine);
            let before = self.text.clone();
            self.disconnect_all(&other)?;
            self.leave_sequences(&other)?;
            if self.text == before {
                return Err(format!("`{other}` is named in what is pasted, and is not in it"));
            }
        }
    }

    /// Renames what is declared there, where it would have a name that is taken here. Out: the new names by the old ones.
    fn rename_apart(&self, probe: &mut Work) -> Result<BTreeMap<String, String>, String> {
        let here: BTreeSet<String> = self.names()?.into_iter().collect();
        let mut names = BTreeMap::new();
        for name in declared(&probe.machine()?) {
            let mut wanted = name.clone();
            if here.contains(&name) {
                let there: BTreeSet<String> = probe.names()?.into_iter().collect();
                let stem = name.trim_end_matches(|c: char| c.is_ascii_digit());
                let free = |name: &String| !here.contains(name) && !there.contains(name);
                wanted = (2..).map(|number| format!("{stem}{number}")).find(free).unwrap_or(wanted);
                probe.rename(&name, &wanted)?;
            }
            names.insert(name, wanted);
        }
        Ok(names)
    }
}

/// The names that are declared, in the order of the text.
fn declared(machine: &MachineChart) -> Vec<String> {
    machine.shapes().filter_map(|shape| Some(shape.name()?.text().to_string())).collect()
}

/// A chart with the declaration alone.
fn probe_of(source: &str) -> Result<Work, String> {
    let refused = || "what is pasted is no composite state".to_string();
    // Its last line says how deep it stood.
    let last = source.rsplit('\n').next().unwrap_or_default();
    let indent: String = last.chars().take_while(|c| matches!(c, ' ' | '\t')).collect();
    let lines = source.split('\n').enumerate().map(|(index, line)| match (index, line.strip_prefix(indent.as_str())) {
        (0, _) => line.to_string(),
        (_, Some(rest)) => format!("\t{rest}"),
        (_, None) => format!("\t{}", line.trim_start()),
    });
    let lines: Vec<String> = lines.collect();
    let text = format!("chart Probe\n\nmachine {PROBE}\n\t{}\nendmachine\n", lines.join("\n"));
    let probe = Work { text, drawing: PROBE.to_string(), select: Vec::new() };
    let file: ChartFile = probe.file()?;
    let alone = file.machines().count() == 1
        && file.syntax().children().count() == 1
        && file.machines().all(|machine| machine.syntax().children().count() == 1);
    let holds = probe.machine()?.shapes().next().is_some_and(|shape| matches!(shape, Shape::Composite(_)));
    match probe.faults() == 0 && alone && holds {
        true => Ok(probe),
        false => Err(refused()),
    }
}
