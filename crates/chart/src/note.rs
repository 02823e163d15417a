//! What two machines note of a guard, so that each answer that replaces it is one that the guard gives.
//!
//! In: the texts of a chart and of its model, and of both with a pattern in the place of the guard. Out: the texts with notes, and what the
//! coupling says of them. The machine with the guard notes in which turn it tested the guard last, and what the guard said; the other one
//! begins a new turn whenever the block is left over an exit. INVARIANT: a note changes nothing but notes; where the block is not at work,
//! the guard was tested since the turn before ended, and said what the pattern answered. Without notes an answer that leads back to where the
//! machine came from could not be told from waiting.

use std::fmt::Write;

use syntax::ast::{AstNode, MachineChart, PathStop};
use syntax::{FileId, SyntaxKind};

use crate::build::function_name;

/// The names of notes about a guard.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Note {
    machine: String,
    guard: String,
    /// What all names begin with.
    stem: String,
}

/// Texts of a chart and of its model.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Texts {
    /// The chart.
    pub chart: String,
    /// The model that it is built into.
    pub model: String,
}

impl Note {
    /// Notes about a guard, no name of which stands in these texts.
    pub(crate) fn about(machine: &str, guard: &str, texts: [&str; 2]) -> Option<Note> {
        let name = function_name(guard);
        let stems = std::iter::once(name.clone()).chain((2..).map(|number| format!("{name}{number}")));
        let lower = texts.map(str::to_lowercase);
        let is_free = |stem: &String| {
            let words = ["Turn", "Tested", "Said", "Answers"].map(|word| format!("{stem}{word}").to_lowercase());
            words.iter().all(|word| lower.iter().all(|text| !text.contains(word)))
        };
        let stem = stems.take(100).find(is_free)?;
        Some(Note { machine: machine.to_string(), guard: guard.to_string(), stem })
    }

    /// The machine with the guard, with notes.
    pub fn of_guard(&self, texts: &Texts) -> Option<Texts> {
        let Note { stem, .. } = self;
        let declared = format!(
            "\n\tmonitored {stem}Turn: Boolean\n\tcontrolled {stem}Tested: Boolean\n\tcontrolled {stem}Said: Boolean\n"
        );
        self.with(texts, &declared, &|said| format!("par {stem}Tested := {stem}Turn {stem}Said := {said} endpar"))
    }

    /// The machine with the block, with notes.
    pub fn of_block(&self, texts: &Texts) -> Option<Texts> {
        let Note { stem, .. } = self;
        let declared = format!(
            "\n\tcontrolled {stem}Turn: Boolean\n\tcontrolled {stem}Tested: Boolean\n\tcontrolled {stem}Said: Boolean\n"
        );
        // It is undef at first, so that no initial value is needed.
        self.with(texts, &declared, &|said| {
            format!(
                "par {stem}Tested := isDef({stem}Turn) if isDef({stem}Turn) then {stem}Turn := undef else {stem}Turn := true endif \
                 {stem}Said := {said} endpar"
            )
        })
    }

    /// What the coupling says of the notes where the block is not at work, which is a condition.
    pub(crate) fn coupled(&self, quiet: &str) -> String {
        let Note { stem, .. } = self;
        let mut text = format!("input abstract.{stem}Turn = isDef(concrete.{stem}Turn);\n");
        for name in ["Tested", "Said"] {
            let [one, other] = ["abstract", "concrete"].map(|side| format!("{side}.{stem}{name}"));
            let _ = writeln!(
                text,
                "couple {quiet} implies (if isUndef({other}) then isUndef({one}) else {one} = {other} endif);"
            );
        }
        text
    }

    /// The chart with an action behind each exit, and the model with what these write.
    fn with(&self, texts: &Texts, declared: &str, rule: &dyn Fn(bool) -> String) -> Option<Texts> {
        let action = |said: bool| format!("{}Answers{}", self.stem, if said { "Yes" } else { "No" });
        let parse = syntax::parse_chart(FileId(0), &texts.chart);
        let machines = parse.syntax().descendants().filter_map(MachineChart::cast);
        let machine =
            machines.into_iter().find(|machine| machine.name().is_some_and(|name| name.text() == self.machine))?;
        // By place, from the last one on.
        let mut edits: Vec<(usize, String)> = Vec::new();
        for stop in machine.syntax().descendants().filter_map(PathStop::cast) {
            if let (Some(name), Some(said)) = (stop.name(), stop.branch())
                && name.text() == self.guard
            {
                let words = stop.syntax().descendants_with_tokens().filter_map(|element| element.into_token());
                let last = words.filter(|token| !token.kind().is_trivia()).last()?;
                edits.push((usize::from(last.text_range().end()), format!(" -> {}", action(said))));
            }
        }
        let said =
            [true, false].into_iter().filter(|said| edits.iter().any(|(_, text)| text.ends_with(&action(*said))));
        let declarations: String =
            said.map(|said| format!("\n\taction {} {{{}}}\n", action(said), rule(said))).collect();
        let name = machine.name()?;
        let head = machine.syntax().children_with_tokens().filter(|element| !element.kind().is_trivia());
        // The first item of the machine comes behind its head.
        let first =
            head.skip_while(|element| element.text_range().start() <= name.text_range().start()).find(|element| {
                !matches!(element.kind(), SyntaxKind::PARAMETER_LIST | SyntaxKind::STRING | SyntaxKind::LINK)
            })?;
        edits.push((usize::from(first.text_range().start()), format!("{declarations}\t")));
        edits.sort_by_key(|(at, _)| *at);
        let mut chart = texts.chart.clone();
        edits.into_iter().rev().for_each(|(at, text)| chart.insert_str(at, &text));
        let mut model = texts.model.clone();
        let parse = syntax::parse_asmetal(FileId(0), &model);
        let signature = parse.syntax().descendants().find(|node| node.kind() == SyntaxKind::SIGNATURE)?;
        let colon = signature.children_with_tokens().find(|element| element.kind() == SyntaxKind::COLON)?;
        model.insert_str(usize::from(colon.text_range().end()), declared);
        Some(Texts { chart, model })
    }
}
