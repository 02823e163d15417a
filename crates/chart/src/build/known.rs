//! The names that a chart's imports declare: links to these are kept, other names are created.

use std::collections::BTreeSet;

use model::{Checked, DomainKind, Loader, Model};
use syntax::{Diagnostic, Severity, SourceFile};

use crate::chart::Chart;
use crate::fault;

/// The import path of the pattern library for a chart that does not import it by another path.
const PATTERNS: &str = "patterns/ControlTask";

/// The first declaration of the patterns that the chart's imports lack.
pub(super) fn missing(known: &Known) -> Option<&'static str> {
    let domain = OWNED.into_iter().take(7).find(|domain| !known.domains.contains(*domain));
    domain.or_else(|| ["r_scheduler_execute", "r_sem_arbitrate"].into_iter().find(|rule| !known.rules.contains(*rule)))
}

/// Domains whose elements the chart alone determines.
pub(crate) const OWNED: [&str; 10] = [
    "Scheduler",
    "Task",
    "SwingingBuffer",
    "Semaphore",
    "SchedulePhase",
    "MessageQueue",
    "SharedValue",
    // of the module that follows ages, which only systems with age bounds import
    "AgeHop",
    "AgeWay",
    // of the module that follows new readings
    "FreshReading",
];

/// Names that exist already.
#[derive(Debug, Clone, Default)]
pub struct Known {
    /// Functions and enum literals.
    pub terms: BTreeSet<String>,
    /// Rules.
    pub rules: BTreeSet<String>,
    /// Domains.
    pub domains: BTreeSet<String>,
}

/// Why the imports of a chart cannot be used.
#[derive(Debug, Clone)]
pub struct Unknown {
    /// Faults of the imports themselves; their places are in the chart.
    pub imports: Vec<Diagnostic>,
    /// Faults within the imported modules; their places are in `checked`.
    pub modules: Vec<Diagnostic>,
    /// A module with the same imports as the chart.
    pub checked: Checked,
}

impl Known {
    /// The names that a chart's imports declare; `beside` names a file in the chart's folder.
    ///
    /// # Errors
    /// The faults of the imports.
    pub fn imported(chart: &Chart, beside: &str, loader: &mut dyn Loader) -> Result<Known, Box<Unknown>> {
        let mut text = "module Imports\n".to_string();
        let mut ends = Vec::new();
        for import in &chart.imports {
            text.push_str(&format!("import \"{import}\"\n"));
            ends.push(text.len());
        }
        text.push_str("signature:\ndefinitions:\n");
        let checked = model::check(SourceFile::new(beside, text), loader);
        let errors = checked.diagnostics.iter().filter(|found| found.severity == Severity::Error);
        let (own, modules): (Vec<_>, Vec<_>) =
            errors.cloned().partition(|found| found.primary.span.file == checked.model.root);
        if own.is_empty() && modules.is_empty() {
            return Ok(Known::of(&checked.model));
        }
        let placed = own.iter().filter_map(|found| {
            let number = ends.partition_point(|end| *end <= found.primary.span.start as usize);
            let import = chart.imports.get(number)?;
            let of_chart = chart.charts.iter().any(|path| path.trim_end_matches(".chart") == import);
            Some(fault::import::no_model(*chart.places.get(number)?, found, of_chart.then_some(import.as_str())))
        });
        Err(Box::new(Unknown { imports: placed.collect(), modules, checked }))
    }

    /// Like [`Known::imported`]. If a system's imports lack the patterns and the loader finds them, their import is
    /// added to the chart.
    ///
    /// # Errors
    /// The faults of the imports.
    pub fn completed(chart: &mut Chart, beside: &str, loader: &mut dyn Loader) -> Result<Known, Box<Unknown>> {
        let known = Known::imported(chart, beside, loader)?;
        let Some(system) = chart.system.as_ref().filter(|_| missing(&known).is_some()) else {
            return Ok(known);
        };
        let mut whole = chart.clone();
        whole.imports.push(PATTERNS.to_string());
        whole.places.push(system.span);
        match Known::imported(&whole, beside, loader) {
            Ok(known) if missing(&known).is_none() => {
                *chart = whole;
                Ok(known)
            }
            _ => Ok(known),
        }
    }

    /// All of them.
    pub(super) fn all(&self) -> BTreeSet<String> {
        [&self.terms, &self.rules, &self.domains].into_iter().flatten().cloned().collect()
    }

    /// The names of a model, including those of its imports.
    pub fn of(model: &Model) -> Known {
        let mut known = Known::default();
        known.terms.extend(model.functions.iter().map(|function| function.name.clone()));
        known.rules.extend(model.rules.iter().map(|rule| rule.name.clone()));
        for (_, domain) in model.domains.iter() {
            known.domains.extend(domain.name.clone());
            if let DomainKind::Enum { literals } = &domain.kind {
                known.terms.extend(literals.iter().cloned());
            }
        }
        known
    }
}
