//! What is debugged: the session, and the lines of its texts as the debugger counts them.
//!
//! In: spans of the texts. Out: lines and columns, and back: the rules and commands of a line. A built-in library has no path; its
//! text is given on request, by its number.

use std::collections::{BTreeMap, BTreeSet};
use std::sync::Arc;

use groundstate::session::{On, Scene, Session};
use groundstate::workspace::tidy;
use ide::{Encoding, Lines};
use program::{Rule, RuleId};
use serde_json::{Value, json};
use syntax::{FileId, Span};

/// How the debugger counts.
#[derive(Debug, Clone, Copy)]
pub struct Counting {
    /// The first line is 1.
    pub lines: u32,
    /// The first column is 1.
    pub columns: u32,
}

impl Default for Counting {
    fn default() -> Counting {
        Counting { lines: 1, columns: 1 }
    }
}

/// See the module.
#[derive(Debug)]
pub struct Target {
    /// What runs.
    pub session: Session,
    /// What it is about.
    pub scene: Arc<Scene>,
    lines: BTreeMap<FileId, Lines>,
    counting: Counting,
}

/// A line at which a run can be stopped.
#[derive(Debug)]
pub struct Stop {
    /// The line, as the debugger counts.
    pub line: u32,
    /// What happens there.
    pub on: On,
}

impl Target {
    /// A session with its texts.
    pub fn new(session: Session, counting: Counting) -> Target {
        let scene = Arc::clone(session.scene());
        let lines = scene.sources.iter().map(|(file, source)| (file, Lines::new(Arc::clone(&source.text)))).collect();
        Target { session, scene, lines, counting }
    }

    /// The file of a path.
    fn file(&self, path: &str) -> Option<FileId> {
        let path = absolute(path);
        self.scene.sources.iter().find(|(_, source)| absolute(&source.name) == path).map(|(file, _)| file)
    }

    fn line(&self, file: FileId, offset: u32) -> u32 {
        self.lines.get(&file).map_or(0, |lines| lines.position(offset as usize, Encoding::Utf16).line)
    }

    /// A place as the protocol writes it: `source`, `line`, `column`, `endLine`, `endColumn`.
    pub fn place(&self, span: Span) -> Value {
        let Some(lines) = self.lines.get(&span.file) else { return json!({}) };
        let at = |offset: u32| {
            let at = lines.position(offset as usize, Encoding::Utf16);
            (at.line + self.counting.lines, at.column + self.counting.columns)
        };
        let ((line, column), (end_line, end_column)) = (at(span.start), at(span.end));
        json!({
            "source": self.source(span.file), "line": line, "column": column,
            "endLine": end_line, "endColumn": end_column,
        })
    }

    fn source(&self, file: FileId) -> Value {
        let name = &self.scene.sources.file(file).name;
        let short = name.rsplit(['/', '\\']).next().unwrap_or(name);
        if ide::library_text(name).is_some() {
            let hint = "deemphasize";
            return json!({ "name": short, "sourceReference": file.0 + 1, "presentationHint": hint, "origin": name });
        }
        json!({ "name": short, "path": absolute(name) })
    }

    /// The text of a library, by its number.
    pub fn text(&self, reference: u64) -> Option<&str> {
        let file = FileId(u32::try_from(reference).ok()?.checked_sub(1)?);
        let (_, source) = self.scene.sources.iter().find(|(known, _)| *known == file)?;
        Some(&source.text)
    }

    /// The text of a place, its first line.
    pub fn excerpt(&self, span: Span) -> &str {
        let text = &self.scene.sources.file(span.file).text;
        let text = text.get(span.start as usize..span.end as usize).unwrap_or_default();
        text.lines().next().unwrap_or_default().trim()
    }

    /// The line of a file at which, or behind which, something can stop a run.
    pub fn stop_at(&self, path: &str, line: u32) -> Option<Stop> {
        let file = self.file(path)?;
        let wanted = line.checked_sub(self.counting.lines)?;
        let line = self.places(file).into_iter().filter(|line| *line >= wanted).min()?;
        Some(Stop { line: line + self.counting.lines, on: self.on_line(file, line) })
    }

    /// The lines of a file at which something can stop a run, between two.
    pub fn stops_between(&self, path: &str, first: u32, last: u32) -> Vec<u32> {
        let Some(file) = self.file(path) else { return Vec::new() };
        let all = self.places(file).into_iter().map(|line| line + self.counting.lines);
        all.filter(|line| (first..=last).contains(line)).collect()
    }

    /// The lines of a file, from 0, that have an update, a declared rule or a command of the scenario.
    fn places(&self, file: FileId) -> BTreeSet<u32> {
        let here = |span: Span| (span.file == file).then(|| self.line(file, span.start));
        let updates = self.updates().filter_map(|(_, span)| here(span));
        let rules = self.scene.model.rules.iter().filter_map(|rule| here(rule.span));
        let commands = self.commands().into_iter().filter_map(here);
        updates.chain(rules).chain(commands).collect()
    }

    fn updates(&self) -> impl Iterator<Item = (RuleId, Span)> + '_ {
        let program = &self.scene.program;
        let rules = (0..program.rules.len() as u32).map(RuleId);
        rules
            .filter(|rule| {
                matches!(program.rule(*rule), Rule::Update { .. } | Rule::Return { .. } | Rule::Extend { .. })
            })
            .map(|rule| (rule, program.rule_span(rule)))
    }

    fn commands(&self) -> Vec<Span> {
        self.scene.script.as_ref().map(|script| script.places()).unwrap_or_default()
    }

    fn on_line(&self, file: FileId, line: u32) -> On {
        let is_here = |span: &Span| span.file == file && self.line(file, span.start) == line;
        let commands: Vec<Span> = self.commands().into_iter().filter(is_here).collect();
        if !commands.is_empty() {
            return On::Commands(commands);
        }
        let updates = self.updates().filter(|(_, span)| is_here(span)).map(|(rule, _)| rule);
        let declared = |span: &Span| is_here(span);
        let bodies = self.scene.program.procedures.iter().filter(|procedure| {
            let rule = procedure.rule.and_then(|rule| self.scene.model.rules.get(rule.0 as usize));
            rule.is_some_and(|rule| declared(&rule.span))
        });
        On::Rules(bodies.map(|procedure| procedure.body).chain(updates).collect())
    }

    /// The bodies of a declared rule, and its place; none if there is no such rule.
    pub fn rule(&self, name: &str) -> Option<(On, Span)> {
        let rule = self.scene.model.rules.iter().find(|rule| rule.name == name)?;
        let bodies = self.scene.program.procedures.iter().filter(|procedure| procedure.name == name);
        Some((On::Rules(bodies.map(|procedure| procedure.body).collect()), rule.span))
    }
}

/// A path from the root on.
fn absolute(path: &str) -> String {
    let whole = std::path::absolute(path).map_or_else(|_| path.to_string(), |path| path.to_string_lossy().into_owned());
    tidy(&whole)
}
