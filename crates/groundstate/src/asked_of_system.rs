//! What a verification specification asks of a chart's system: the words by which it brings in what machines decide, and its faults.
//!
//! In: the texts of `NAME.verify.yaml` and `NAME.chart`. Out: words, faults. INVARIANT: a term is refused here if and only if
//! `verify NAME.chart` refuses it: both ask [`not_kept`].

use std::collections::BTreeSet;

use inputs::verification::{self, Verification};
use model::Loader;
use program::{Expression, Program};
use syntax::ast::{AstNode, ChartFile};
use syntax::{FileId, SourceFile};

use crate::check_verification::check_terms;
use crate::workspace::Findings;
use crate::{VerifiedSystem, not_kept, verified_system};

/// Whether a chart draws a system, whatever is wrong with it.
pub fn draws_system(chart: &SourceFile) -> bool {
    let parse = syntax::parse_chart(FileId(0), &chart.text);
    ChartFile::cast(parse.syntax()).is_some_and(|file| file.systems().next().is_some())
}

/// The words of a text: whatever may be a name in it.
pub fn words(text: &str) -> impl Iterator<Item = &str> {
    text.split(|c: char| !c.is_alphanumeric() && c != '_').filter(|word| !word.is_empty())
}

/// The words of what is asked and assumed, and the names of inputs.
pub fn words_of(said: &Verification) -> BTreeSet<String> {
    let texts = said.properties.iter().flatten().chain(&said.assumptions).chain(&said.terminal).chain(&said.undefined);
    let texts = texts.map(|text| &**text).chain(said.bounds.iter().map(String::as_str));
    texts.flat_map(words).map(str::to_string).collect()
}

/// The built-in libraries whose operators the formulas need, besides that of CTL.
pub fn libraries_of(said: &Verification) -> &'static [&'static str] {
    if said.properties[2].is_empty() { &[] } else { &["LTLLibrary"] }
}

/// Why a term cannot be asked of a system; none if it can.
pub fn refusal(program: &Program, expression: &Expression, data: &[String]) -> Option<String> {
    let read = not_kept(program, expression, data);
    (!read.is_empty()).then(|| format!("reads {}, which is not kept from tick to tick", read.join(", ")))
}

/// Checks a verification specification against the system of a chart: its form, its bounds, its terms, and whether these speak of what is
/// kept of the system.
pub fn check_asked_of_system(root: &SourceFile, chart: SourceFile, loader: &mut dyn Loader) -> Findings {
    // What is wrong with the form is told when the text is read again, for the model.
    let said = verification::read(FileId(0), &root.text).unwrap_or_default();
    let spoken = words_of(&said);
    let system = match verified_system(chart, libraries_of(&said), &|name| spoken.contains(name), loader) {
        Ok(system) => system,
        Err(faults) => return Findings { faults, open: None },
    };
    let VerifiedSystem { loaded, data, .. } = &*system;
    let mut asked = loaded.overlay();
    let kept = |program: &Program, expression: &Expression| refusal(program, expression, data);
    let faults = check_terms(&mut asked, &root.name, &root.text, &kept);
    Findings { faults: vec![(asked.sources, faults)], open: None }
}
