//! The outcome of the whole comparison as a Markdown page.
//!
//! In: jobs and their answers. Out: counts, the reasons with the models that each explains, and what is not explained.
//! INVARIANT: the same answers give the same bytes.

use std::collections::BTreeMap;
use std::fmt::Write;

use super::job::{Answer, Job};
use super::reason;

/// Name of a section, and what it says in the table.
const SECTIONS: [(&str, &str); 5] = [
    ("accept", "models accepted or refused"),
    ("det", "runs without inputs and choices"),
    ("mon", "runs with inputs, replayed"),
    ("choose", "runs with choices, followed"),
    ("scenario", "verdicts of scenarios"),
];

/// The comparison as a whole.
#[derive(Debug)]
pub struct Report<'a> {
    results: Vec<(&'a Job, &'a Answer)>,
}

#[derive(Debug, Default)]
struct Counts {
    compared: usize,
    same: usize,
    explained: usize,
    unexplained: usize,
    panics: usize,
    timeouts: usize,
}

impl<'a> Report<'a> {
    /// Of all jobs and their answers, in the same order.
    pub fn new(jobs: &'a [Job], answers: &'a [Answer]) -> Self {
        Report { results: jobs.iter().zip(answers).collect() }
    }

    fn counts(&self, section: &str) -> Counts {
        let mut counts = Counts::default();
        for (_, answer) in self.results.iter().filter(|(job, _)| job.section() == section) {
            counts.compared += usize::from(!matches!(answer, Answer::Void { .. }));
            match answer {
                Answer::Same { .. } => counts.same += 1,
                Answer::Different { reasons, .. } if reasons.is_empty() => counts.unexplained += 1,
                Answer::Different { .. } => counts.explained += 1,
                Answer::Panic { .. } => counts.panics += 1,
                Answer::Timeout => counts.timeouts += 1,
                Answer::Void { .. } => {}
            }
        }
        counts
    }

    /// Every difference has a reason, and nothing panicked or took too long.
    pub fn is_explained(&self) -> bool {
        SECTIONS.iter().all(|(section, _)| {
            let counts = self.counts(section);
            counts.unexplained + counts.panics + counts.timeouts == 0
        })
    }

    /// The table of counts.
    pub fn summary(&self) -> String {
        let mut out = String::from(
            "| compared | number | same | same % | explained | with those % | unexplained | panics | timeouts |\n\
             | --- | --: | --: | --: | --: | --: | --: | --: | --: |\n",
        );
        for (section, title) in SECTIONS {
            let c = self.counts(section);
            if c.compared == 0 {
                continue;
            }
            let percent = |part: usize| 100.0 * part as f64 / c.compared as f64;
            let (same, with) = (percent(c.same), percent(c.same + c.explained));
            let Counts { compared, same: number, explained, unexplained, panics, timeouts } = c;
            let _ = writeln!(
                out,
                "| {title} | {compared} | {number} | {same:.1} | {explained} | {with:.1} | {unexplained} | {panics} | {timeouts} |"
            );
        }
        out
    }

    /// The whole page.
    pub fn page(&self) -> String {
        let mut page = String::from(HEAD);
        page.push_str(&self.summary());
        self.reasons(&mut page);
        self.unexplained(&mut page);
        self.notes(&mut page);
        page
    }

    fn reasons(&self, page: &mut String) {
        let mut by_reason: BTreeMap<&str, BTreeMap<&str, Vec<String>>> = BTreeMap::new();
        for (job, answer) in &self.results {
            let Answer::Different { reasons, detail } = answer else { continue };
            for reason in reasons {
                let line = format!("{} ({}): {}", job.subject(), job.section(), escaped(detail));
                by_reason.entry(reason).or_default().entry(job.section()).or_default().push(line);
            }
        }
        page.push_str("\n## Differences with a reason\n\n| reason | what it means | accept | det | mon | choose | scenario |\n| --- | --- | --: | --: | --: | --: | --: |\n");
        for (reason, sections) in &by_reason {
            let count = |section: &str| sections.get(section).map_or(String::new(), |lines| lines.len().to_string());
            let counts: Vec<String> = SECTIONS.iter().map(|(section, _)| count(section)).collect();
            let _ = writeln!(page, "| {reason} | {} | {} |", reason::sentence(reason), counts.join(" | "));
        }
        for (reason, sections) in &by_reason {
            let _ = writeln!(page, "\n### {}\n", capital(reason));
            for (section, _) in SECTIONS {
                for line in sections.get(section).into_iter().flatten() {
                    let _ = writeln!(page, "- {line}");
                }
            }
        }
    }

    fn unexplained(&self, page: &mut String) {
        let mut lines = Vec::new();
        for (job, answer) in &self.results {
            let what = match answer {
                Answer::Different { reasons, detail } if reasons.is_empty() => {
                    format!("UNEXPLAINED: {}", escaped(detail))
                }
                Answer::Panic { detail } => format!("PANIC: {}", escaped(detail)),
                Answer::Timeout => "TIMEOUT".to_string(),
                _ => continue,
            };
            lines.push(format!("- {} ({}): {what}", job.subject(), job.section()));
        }
        page.push_str("\n## Differences without a reason\n\n");
        if lines.is_empty() {
            page.push_str("None.\n");
        }
        lines.iter().for_each(|line| {
            let _ = writeln!(page, "{line}");
        });
    }

    fn notes(&self, page: &mut String) {
        page.push_str("\n## Agreements worth a word\n\n");
        let mut any = false;
        for (job, answer) in &self.results {
            let what = match answer {
                Answer::Same { note: Some(note) } => note.clone(),
                Answer::Void { why } => format!("not compared: {why}"),
                _ => continue,
            };
            any = true;
            let _ = writeln!(page, "- {} ({}): {}", job.subject(), job.section(), escaped(&what));
        }
        if !any {
            page.push_str("None.\n");
        }
    }
}

const HEAD: &str = "\
# Conformance with the public corpus

Written by `make corpus CORPUS=path`; not by hand. The models are those of the public repository asmeta/asmeta; they are
not part of this project, and paths below are relative to their checkout. The peer is ASMETA 26.07.

Compared are: whether a model is accepted; recorded runs, state by state, on every location that the record lists, with
the recorded inputs and with choices that lead to the recorded states; the ends of runs; verdicts of scenarios. A
difference is explained only by a reason that a test on the model or on the difference finds.

The recorded results are not part of this project either: tables `parse.csv` (path, OK or FAIL, message) and `avalla.csv`
(path, verdict, message), and traces `traces/{det,mon,choose}/*`, whose form `xtask/src/corpus/trace.rs` reads. Whoever
has the peer makes them by running its parser, simulator and validator over the checkout; `cargo xtask corpus CHECKOUT
--recorded FOLDER` names their folder.

";

fn escaped(text: &str) -> String {
    let line: String = text.split_whitespace().collect::<Vec<_>>().join(" ");
    line.replace('|', "\\|").replace('<', "&lt;")
}

fn capital(text: &str) -> String {
    let mut letters = text.chars();
    letters.next().map(|first| first.to_uppercase().collect::<String>() + letters.as_str()).unwrap_or_default()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_difference_without_reason_is_told() {
        let job = Job::Accept { path: "a/B.asm".to_string(), accepted: true, message: String::new() };
        let (jobs, answers) = ([job], [Answer::different(None, "x | y".to_string())]);
        let report = Report::new(&jobs, &answers);
        assert!(!report.is_explained());
        assert!(report.page().contains("- a/B.asm (accept): UNEXPLAINED: x \\| y"));
    }
}
