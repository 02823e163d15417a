//! Faults as the protocol's diagnostics, and which files have some.
//!
//! In: reports on the files that are open. Out: for each file whose faults are others than before, all of them. A file that two
//! open ones import has the faults that either shows.

use std::collections::{BTreeMap, BTreeSet};

use ide::{Fault, Report, Weight};
use lsp_types::{
    CodeDescription, Diagnostic, DiagnosticRelatedInformation, DiagnosticSeverity, DiagnosticTag, Location,
    NumberOrString, Uri,
};

use crate::answer::Answers;
use crate::location::uri_of;

/// Where the pages of the faults stand for everybody.
const PAGES: &str = "https://github.com/groundstate/groundstate/blob/main/spec/faults/";

/// What was told of which file.
#[derive(Debug, Default)]
pub struct Published {
    /// By the file that was checked: the reports that came of it.
    of: BTreeMap<String, Vec<Report>>,
    /// What the editor has been told: the faults of each file, and the version that they were told for.
    told: BTreeMap<String, (Vec<Fault>, Option<i32>)>,
}

impl Published {
    /// A file that is open was checked.
    pub fn checked(&mut self, path: &str, reports: Vec<Report>) {
        self.of.insert(path.to_string(), reports);
    }

    /// The text of a file is another one: what the check of others showed of it was about the former.
    pub fn changed(&mut self, path: &str) {
        for (_, reports) in self.of.iter_mut().filter(|(checked, _)| *checked != path) {
            reports.retain(|report| report.path != path);
        }
    }

    /// A file is not open any more.
    pub fn closed(&mut self, path: &str) {
        self.of.remove(path);
    }

    /// What has to be told: each file whose faults, or whose version, are others than those that were told.
    pub fn news(&mut self, version: impl Fn(&str) -> Option<i32>) -> Vec<(String, Vec<Fault>)> {
        let mut now: BTreeMap<String, Vec<Fault>> = BTreeMap::new();
        for report in self.of.values().flatten() {
            let faults = now.entry(report.path.clone()).or_default();
            faults.extend(report.faults.iter().filter(|fault| !faults.contains(fault)).cloned().collect::<Vec<_>>());
        }
        let paths: BTreeSet<String> = now.keys().chain(self.told.keys()).cloned().collect();
        let mut news = Vec::new();
        for path in paths {
            let faults = now.remove(&path).unwrap_or_default();
            let present = (faults, version(&path));
            if self.told.get(&path) == Some(&present) {
                continue;
            }
            let gone = present.0.is_empty() && present.1.is_none();
            if gone && !self.told.contains_key(&path) {
                continue;
            }
            news.push((path.clone(), present.0.clone()));
            match gone {
                true => _ = self.told.remove(&path),
                false => _ = self.told.insert(path, present),
            }
        }
        news
    }
}

/// A fault of a file as the protocol has it.
pub fn diagnostic(answers: &mut Answers, path: &str, fault: &Fault) -> Diagnostic {
    let severity = match fault.weight {
        Weight::Error => DiagnosticSeverity::ERROR,
        Weight::Warning => DiagnosticSeverity::WARNING,
        Weight::Note => DiagnosticSeverity::INFORMATION,
        Weight::Unused => DiagnosticSeverity::HINT,
    };
    let related = fault.related.iter().filter_map(|(place, text)| {
        let location = Location { uri: uri_of(&place.path)?, range: answers.range(&place.path, place.range) };
        Some(DiagnosticRelatedInformation { location, message: text.clone() })
    });
    let related: Vec<DiagnosticRelatedInformation> = related.collect();
    let page: Option<Uri> = format!("{PAGES}{}.md", fault.id).parse().ok();
    let message = match &fault.help {
        Some(help) => format!("{}\nhelp: {help}", fault.message),
        None => fault.message.clone(),
    };
    Diagnostic {
        range: answers.range(path, fault.range),
        severity: Some(severity),
        code: (!fault.id.is_empty()).then(|| NumberOrString::String(fault.id.to_string())),
        code_description: page.filter(|_| !fault.id.is_empty()).map(|href| CodeDescription { href }),
        source: Some("groundstate".to_string()),
        message,
        related_information: (!related.is_empty()).then_some(related),
        tags: (fault.weight == Weight::Unused).then(|| vec![DiagnosticTag::UNNECESSARY]),
        data: None,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn faults_are_told_once_and_never_of_a_former_text() {
        let report = |path: &str, faults: usize| {
            let fault = |at: usize| Fault {
                range: (at as u32, at as u32),
                weight: Weight::Error,
                id: "",
                message: String::new(),
                help: None,
                related: Vec::new(),
            };
            Report { path: path.to_string(), faults: (0..faults).map(fault).collect() }
        };
        let mut published = Published::default();
        let told = |published: &mut Published, version: i32| -> Vec<(String, usize)> {
            let news = published.news(|path| (path == "part").then_some(version));
            news.into_iter().map(|(path, faults)| (path, faults.len())).collect()
        };
        published.checked("main", vec![report("main", 0), report("part", 1)]);
        // Nothing is told of a file that has no faults, is not open, and never had any.
        assert_eq!(told(&mut published, 1), [("part".to_string(), 1)]);
        assert_eq!(told(&mut published, 1), []);
        published.changed("part");
        published.checked("part", vec![report("part", 0)]);
        assert_eq!(told(&mut published, 2), [("part".to_string(), 0)]);
        published.checked("main", vec![report("main", 2)]);
        published.closed("part");
        assert_eq!(told(&mut published, 2), [("main".to_string(), 2)]);
        published.closed("main");
        assert_eq!(told(&mut published, 2), [("main".to_string(), 0)]);
    }
}
