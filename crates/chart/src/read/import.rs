//! Imports of charts: loads the patterns of other charts, reading each file once.
//!
//! In: a root text and a [`Loader`]. Out: its chart with the patterns of directly imported charts, and the faults of
//! all files. Importing a chart also imports its model: that model and its imports are added to the imports of the
//! importing chart, as paths relative to it. INVARIANT: no chart imports itself; an import that would close a circle is
//! a fault and is ignored. It must not know where files are.

use std::collections::BTreeMap;
use std::rc::Rc;

use model::Loader;
use syntax::ast::{AstNode, ChartFile};
use syntax::{Diagnostic, FileId, Severity, SourceFile, Sources, Span};

use crate::chart::Chart;
use crate::fault;

/// A chart with its imports.
#[derive(Debug, Clone)]
pub struct Loaded {
    /// The texts of the charts read, the root first.
    pub sources: Sources,
    /// The root's chart, as whole as the texts allow.
    pub chart: Chart,
    /// The faults, in the order of files and positions.
    pub diagnostics: Vec<Diagnostic>,
}

/// Reads a chart, the charts that it imports, and the machines of its components.
pub fn load(root: SourceFile, loader: &mut dyn Loader) -> Loaded {
    load_beside(Sources::default(), root, loader)
}

/// Like [`load`], but adds the texts to existing ones.
pub fn load_beside(sources: Sources, root: SourceFile, loader: &mut dyn Loader) -> Loaded {
    let mut files = Files { sources, faults: Vec::new(), loader, seen: BTreeMap::new(), open: Vec::new() };
    let chart = files.read(root.clone());
    let Files { mut sources, mut faults, loader, .. } = files;
    let mut chart = Rc::unwrap_or_clone(chart);
    // Machines of a system that is not understood would only be reported for what it lacks.
    if !faults.iter().any(|fault| fault.severity == Severity::Error) {
        faults.extend(crate::component::compute(&root, &mut chart, &mut sources, loader));
    }
    faults.sort_by_key(|fault| (fault.primary.span.file, fault.primary.span.start));
    Loaded { sources, chart, diagnostics: faults }
}

struct Files<'l> {
    sources: Sources,
    faults: Vec<Diagnostic>,
    loader: &'l mut dyn Loader,
    /// The chart of each file; `None` while it is being read.
    seen: BTreeMap<String, Option<Rc<Chart>>>,
    /// The files being read, the innermost last.
    open: Vec<String>,
}

impl Files<'_> {
    fn read(&mut self, source: SourceFile) -> Rc<Chart> {
        let name = source.name.clone();
        self.seen.insert(tidied(&name), None);
        self.open.push(name.clone());
        let file = self.sources.add(source.clone());
        let parse = syntax::parse_chart(file, &source.text);
        self.faults.extend(source.foreign.map(|foreign| foreign.warning(file)));
        let mut imported = Imported::default();
        for (path, span) in paths(file, ChartFile::cast(parse.syntax())) {
            if !names_chart(&path) {
                imported.add_model(path, span);
            } else if let Some(chart) = self.follow(&source, &path, span) {
                self.join(&mut imported, &path, span, &chart);
            }
        }
        let (chart, faults) = super::read_with(file, &parse, imported);
        self.faults.extend(faults);
        self.open.pop();
        let chart = Rc::new(chart);
        self.seen.insert(tidied(&name), Some(Rc::clone(&chart)));
        chart
    }

    fn follow(&mut self, importer: &SourceFile, path: &str, span: Span) -> Option<Rc<Chart>> {
        let source = match self.loader.load(importer, path) {
            Ok(source) => source,
            Err(reason) => {
                self.faults.push(fault::import::not_found(span, path, &reason));
                return None;
            }
        };
        match self.seen.get(&tidied(&source.name)) {
            Some(Some(chart)) => return Some(Rc::clone(chart)),
            Some(None) => {
                let start = self.open.iter().position(|open| tidied(open) == tidied(&source.name)).unwrap_or(0);
                let mut circle: Vec<&str> = self.open[start..].iter().map(String::as_str).collect();
                circle.push(&source.name);
                self.faults.push(fault::import::circular(span, &circle));
                return None;
            }
            None => {}
        }
        Some(stacker::maybe_grow(128 << 10, 2 << 20, || self.read(source)))
    }

    /// Adds the patterns of an imported chart, and its model.
    fn join(&mut self, imported: &mut Imported, path: &str, span: Span, chart: &Chart) {
        if imported.charts.iter().any(|known| tidied(known) == tidied(path)) {
            self.faults.push(fault::import::twice(span, path));
            return;
        }
        imported.charts.push(path.to_string());
        for pattern in chart.machines.iter().filter(|machine| machine.is_pattern) {
            match imported.patterns.iter().find(|known| known.name == pattern.name) {
                Some(first) => {
                    self.faults.push(fault::import::ambiguous(span, &pattern.name, pattern.span, first.span))
                }
                None => imported.patterns.push(pattern.clone()),
            }
        }
        imported.beyond.extend(chart.patterns.iter().map(|pattern| pattern.name.clone()));
        let folder = path.rsplit_once(['/', '\\']).map_or("", |(folder, _)| folder);
        for model in &chart.imports {
            let path = if folder.is_empty() { model.clone() } else { tidied(&format!("{folder}/{model}")) };
            imported.add_model(path, span);
        }
        imported.add_model(path.trim_end_matches(".chart").to_string(), span);
    }
}

/// What the imports of a chart contribute.
#[derive(Debug, Clone, Default)]
pub(super) struct Imported {
    /// Paths of charts, as written.
    pub(super) charts: Vec<String>,
    /// Paths of models, relative to the importing file.
    pub(super) models: Vec<String>,
    /// The place of each import.
    pub(super) places: Vec<Span>,
    /// Patterns of the imported charts.
    pub(super) patterns: Vec<crate::chart::Machine>,
    /// The names of patterns that these charts import themselves.
    pub(super) beyond: Vec<String>,
}

impl Imported {
    fn add_model(&mut self, path: String, place: Span) {
        if !self.models.contains(&path) {
            self.models.push(path);
            self.places.push(place);
        }
    }
}

/// The imports of a text without a loader: models are assumed to exist, charts cannot be found.
pub(super) fn alone(file: FileId, tree: Option<ChartFile>) -> (Imported, Vec<Diagnostic>) {
    let mut imported = Imported::default();
    let mut faults = Vec::new();
    for (path, span) in paths(file, tree) {
        if names_chart(&path) {
            faults.push(fault::import::not_found(span, &path, "this text is read alone"));
        } else {
            imported.add_model(path, span);
        }
    }
    (imported, faults)
}

/// The paths of a chart's imports, with their places.
fn paths(file: FileId, tree: Option<ChartFile>) -> Vec<(String, Span)> {
    let imports = tree.iter().flat_map(ChartFile::imports);
    imports.filter_map(|import| Some((import.path()?, Span::new(file, import.path_token()?.text_range())))).collect()
}

fn names_chart(path: &str) -> bool {
    path.ends_with(".chart")
}

/// A path with `.`, `..` and backslashes resolved, so that two paths to the same file are equal.
fn tidied(path: &str) -> String {
    let mut parts: Vec<&str> = Vec::new();
    for part in path.split(['/', '\\']) {
        match part {
            "." => {}
            ".." if parts.last().is_some_and(|last| *last != ".." && !last.is_empty()) => _ = parts.pop(),
            _ => parts.push(part),
        }
    }
    parts.join("/")
}

#[cfg(test)]
mod tests {
    use testkit::Texts;

    use super::*;

    const PATTERN: &str =
        "chart P import \"../Base\" pattern p control c state s action a enter -> a -> s -> exit endpattern";

    fn check(texts: &[(&'static str, &'static str)], expected: &[&str]) -> Chart {
        let (name, text) = texts[0];
        let loaded = load(SourceFile::new(name, text), &mut Texts::of(texts.iter().copied()));
        let faults: Vec<String> = loaded
            .diagnostics
            .iter()
            .map(|fault| format!("{}: {}: {}", loaded.sources.position(fault.primary.span), fault.id, fault.message))
            .collect();
        assert_eq!(faults, expected);
        loaded.chart
    }

    #[test]
    fn patterns_of_another_file() {
        let chart = check(
            &[
                (
                    "a/M.chart",
                    "chart M import \"lib/P.chart\" machine m control x initial state s instance i of p s -> i -> s endmachine",
                ),
                ("a/lib/P.chart", PATTERN),
            ],
            &[],
        );
        assert_eq!(chart.imports, ["Base", "lib/P"]);
        assert_eq!(chart.charts, ["lib/P.chart"]);
        assert_eq!(chart.patterns.len(), 1);
        assert!(chart.machines[0].takes_steps());
    }

    #[test]
    fn faults() {
        check(
            &[
                ("A.chart", "chart A import \"No.chart\" import \"B.chart\" import \"./B.chart\" import \"C.chart\""),
                ("B.chart", "chart B import \"A.chart\" pattern p action a enter -> a -> exit endpattern"),
                ("C.chart", "chart C pattern p control c control d action a enter -> a -> exit endpattern"),
            ],
            &[
                "A.chart:1:16: chart-import: the chart \"No.chart\" cannot be read",
                "A.chart:1:51: chart-import: the chart \"./B.chart\" is imported twice",
                "A.chart:1:70: chart-import: two imported patterns are called `p`",
                "B.chart:1:16: chart-import: the charts import each other: A.chart → B.chart → A.chart",
                "C.chart:1:29: control-variable: a second control variable",
            ],
        );
    }
}
