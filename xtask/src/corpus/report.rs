//! The outcome of the whole comparison as a Markdown page.
//!
//! In: jobs and their answers. Out: counts, the reasons with the models that each explains, what is not explained, and
//! what came of everything that was run. INVARIANT: the same answers give the same bytes.

use std::collections::BTreeMap;
use std::fmt::Write;

use super::job::{Answer, Job};
use super::reason::{self, Class};

/// Name of a section, and what it says in the table.
const SECTIONS: [(&str, &str); 5] = [
    ("accept", "models accepted or refused"),
    ("det", "runs without inputs and choices"),
    ("mon", "runs with inputs, replayed"),
    ("choose", "runs with choices, followed"),
    ("scenario", "verdicts of scenarios"),
];
/// The section of what is run without comparing.
const EXPLORE: &str = "explore";

/// The comparison as a whole.
#[derive(Debug)]
pub struct Report<'a> {
    results: Vec<(&'a Job, &'a Answer)>,
}

#[derive(Debug, Default)]
struct Counts {
    compared: usize,
    same: usize,
    /// By class of the reason.
    explained: BTreeMap<Class, usize>,
    /// Refused by one of the two, as a stated superset or for a better fault.
    texts: usize,
    unexplained: usize,
    panics: usize,
    timeouts: usize,
}

impl Counts {
    fn of(&self, class: Class) -> usize {
        self.explained.get(&class).copied().unwrap_or_default()
    }

    /// The share that agrees, as parts: a defect of the peer is not counted at all, and of texts that one of the two
    /// refuses a superset or a better fault is an agreement.
    fn agreement(&self) -> (usize, usize) {
        (self.same + self.texts, self.compared - self.of(Class::Defect))
    }
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
                Answer::Different { reasons, .. } => match reason::class(reasons) {
                    Some(class) => {
                        *counts.explained.entry(class).or_default() += 1;
                        counts.texts += usize::from(reason::are_of_texts(reasons));
                    }
                    None => counts.unexplained += 1,
                },
                Answer::Panic { .. } => counts.panics += 1,
                Answer::Timeout => counts.timeouts += 1,
                Answer::Explored { .. } | Answer::Void { .. } => {}
            }
        }
        counts
    }

    /// Every difference has a reason, and nothing panicked or took too long.
    pub fn is_explained(&self) -> bool {
        SECTIONS.iter().map(|(section, _)| *section).chain([EXPLORE]).all(|section| {
            let counts = self.counts(section);
            counts.unexplained + counts.panics + counts.timeouts == 0
        })
    }

    /// The table of counts.
    pub fn summary(&self) -> String {
        let classes: Vec<&str> = Class::ALL.iter().map(|class| class.column()).collect();
        let mut out = format!(
            "| compared | number | same | same % | {} | without a reason | panics | timeouts | agreement % |\n\
             | --- |{}\n",
            classes.join(" | "),
            " --: |".repeat(classes.len() + 7)
        );
        for (section, title) in SECTIONS {
            let counts = self.counts(section);
            if counts.compared == 0 {
                continue;
            }
            let percent = |part: usize, of: usize| 100.0 * part as f64 / of.max(1) as f64;
            let (agreed, of) = counts.agreement();
            let classes: Vec<String> = Class::ALL.iter().map(|class| counts.of(*class).to_string()).collect();
            let _ = writeln!(
                out,
                "| {title} | {} | {} | {:.1} | {} | {} | {} | {} | {:.1} |",
                counts.compared,
                counts.same,
                percent(counts.same, counts.compared),
                classes.join(" | "),
                counts.unexplained,
                counts.panics,
                counts.timeouts,
                percent(agreed, of),
            );
        }
        out
    }

    /// The whole page.
    pub fn page(&self) -> String {
        let mut page = String::from(HEAD);
        page.push_str(&self.summary());
        page.push_str(LEGEND);
        self.reasons(&mut page);
        self.unexplained(&mut page);
        self.notes(&mut page);
        self.explored(&mut page);
        page
    }

    fn reasons(&self, page: &mut String) {
        let mut by_reason: BTreeMap<(Class, &str), BTreeMap<&str, Vec<String>>> = BTreeMap::new();
        for (job, answer) in &self.results {
            let Answer::Different { reasons, detail } = answer else { continue };
            for reason in reasons.iter().filter_map(|name| reason::named(name)) {
                let line = format!("{} ({}): {}", job.subject(), job.section(), escaped(detail));
                let lines = by_reason.entry((reason.class, reason.name)).or_default();
                lines.entry(job.section()).or_default().push(line);
            }
        }
        for class in Class::ALL {
            if by_reason.keys().any(|(found, _)| *found == class) {
                let _ = writeln!(page, "\n## {}\n", class.title());
                page.push_str("| reason | what it means | accept | det | mon | choose | scenario |\n| --- | --- | --: | --: | --: | --: | --: |\n");
            }
            let of_class = || by_reason.iter().filter(|((found, _), _)| *found == class);
            for ((_, name), sections) in of_class() {
                let count =
                    |section: &str| sections.get(section).map_or(String::new(), |lines| lines.len().to_string());
                let counts: Vec<String> = SECTIONS.iter().map(|(section, _)| count(section)).collect();
                let sentence = reason::named(name).map_or("", |reason| reason.sentence);
                let _ = writeln!(page, "| {name} | {sentence} | {} |", counts.join(" | "));
            }
            for ((_, name), sections) in of_class() {
                let _ = writeln!(page, "\n### {}\n", capital(name));
                for (section, _) in SECTIONS {
                    for line in sections.get(section).into_iter().flatten() {
                        let _ = writeln!(page, "- {line}");
                    }
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
        page.push_str("\n## Noteworthy agreements\n\n");
        let mut any = false;
        for (job, answer) in self.results.iter().filter(|(job, _)| job.section() != EXPLORE) {
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

    /// What came of everything that was run, and of each model and scenario that has no recorded result.
    fn explored(&self, page: &mut String) {
        let (mut models, mut scenarios) = (Outcomes::default(), Outcomes::default());
        let mut lines: BTreeMap<&str, Vec<String>> = BTreeMap::new();
        for (job, answer) in &self.results {
            let Job::Explore { path, recorded } = job else { continue };
            let (outcome, detail) = match answer {
                Answer::Explored { outcome, detail } => (outcome.as_str(), detail.as_str()),
                Answer::Panic { .. } => ("panic", ""),
                Answer::Timeout => ("timeout", ""),
                Answer::Different { .. } => ("engines that differ", ""),
                Answer::Same { .. } | Answer::Void { .. } => ("not read", ""),
            };
            let outcomes = if path.ends_with(".avalla") { &mut scenarios } else { &mut models };
            let count = outcomes.entry(outcome).or_default();
            count.0 += 1;
            count.1 += usize::from(!recorded);
            if !recorded && !detail.is_empty() {
                lines.entry(outcome).or_default().push(format!("- {path}: {}", escaped(detail)));
            }
        }
        if models.is_empty() && scenarios.is_empty() {
            return;
        }
        page.push_str(EXPLORED);
        for (title, outcomes) in [("models", models), ("scenarios", scenarios)] {
            let all = outcomes.values().fold((0, 0), |sum, count| (sum.0 + count.0, sum.1 + count.1));
            let _ = writeln!(page, "| **{title}** | **{}** | **{}** |", all.0, all.1);
            for (outcome, count) in outcomes {
                let _ = writeln!(page, "| {outcome} | {} | {} |", count.0, count.1);
            }
        }
        for (outcome, lines) in lines {
            let _ = writeln!(page, "\n### Without a recorded result: {outcome}\n\n{}", lines.join("\n"));
        }
    }
}

/// How many there are of each outcome: in all, and without a recorded result.
type Outcomes<'a> = BTreeMap<&'a str, (usize, usize)>;

const HEAD: &str = "\
# Conformance with the public corpus

Written by `make corpus CORPUS=path`; do not edit it by hand. The models are those of the public repository asmeta/asmeta.
They are not part of this project; paths below are relative to their checkout. The peer is ASMETA 26.07.

These are compared: whether a model is accepted; recorded runs, state by state, on every location in the record, with
the recorded inputs and with choices that lead to the recorded states; the ends of runs; verdicts of scenarios. A reason
explains a difference only if a test on the difference confirms it. Either a run with the peer's defect put in agrees to
its end or to another difference, or the outcomes on both sides show the reason. The latter applies to late initial
values (where no run shows them), library functions that the peer lacks, constructs that it does not run, scenarios that
it cannot translate, and all reasons that are not defects.

The recorded results are not part of this project either. They are the tables `parse.csv` (path, OK or FAIL, message)
and `avalla.csv` (path, verdict, message), and traces `traces/{det,mon,choose}/*` in the form that
`xtask/src/corpus/trace.rs` reads. To make them, run the peer's parser, simulator and validator over the checkout;
`cargo xtask corpus CHECKOUT --recorded FOLDER` names their folder. In addition, every model and scenario of the
checkout is run in every engine, with or without a recorded result.

";

const LEGEND: &str = "
A result with several reasons counts for the worst one, whose column is furthest to the right. `same %` leaves nothing
out. The last column leaves out the peer's defects; each names the sections of the language page that describe it, or
argues why it is a defect. If one of the two refuses to read a model or scenario, that agrees as a stated superset or
with a better fault. Nothing else is left out or counts as agreement.
";

const EXPLORED: &str = "
## Everything run

Models run twice for 25 steps in each of the two engines, with random inputs: once taking first candidates, once random
ones. The engines must give the same records. Scenarios run once, taking first candidates.

| outcome | all | without a recorded result |
| --- | --: | --: |
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

    fn accept(path: &str) -> Job {
        Job::Accept { path: path.to_string(), accepted: true, message: String::new() }
    }

    #[test]
    fn a_difference_without_reason_is_told() {
        let (jobs, answers) = ([accept("a/B.asm")], [Answer::different(None, "x | y".to_string())]);
        let report = Report::new(&jobs, &answers);
        assert!(!report.is_explained());
        assert!(report.page().contains("- a/B.asm (accept): UNEXPLAINED: x \\| y"));
    }

    #[test]
    fn the_worst_reason_counts() {
        let reasons = vec![reason::RANGE.to_string(), reason::SPLIT.to_string()];
        let jobs = [accept("a/B.asm"), accept("a/C.asm")];
        let answers = [Answer::same(), Answer::Different { reasons, detail: String::new() }];
        let counts = Report::new(&jobs, &answers).counts("accept");
        assert_eq!((counts.of(Class::Defect), counts.of(Class::Decision)), (0, 1));
        assert_eq!(counts.agreement(), (1, 2));
    }

    #[test]
    fn a_named_defect_is_left_out_of_the_agreement() {
        let jobs = [accept("a/B.asm"), accept("a/C.asm")];
        let answers = [Answer::same(), Answer::different(Some(reason::RANGE), String::new())];
        assert_eq!(Report::new(&jobs, &answers).counts("accept").agreement(), (1, 1));
    }
}
