//! Prints verdicts and counterexamples, as text and as JSON. The words are `groundstate::tell`'s.

use std::collections::BTreeSet;
use std::io::Write;

use groundstate::Said;
use groundstate::tell::{Extent, Verdicts, explored, hint, why_unreduced};
use groundstate::verify::{EngineKind, Outcome, Progress, Reason, Report, Stop, Subject, Trace, Verdict};
use program::Program;
use syntax::Sources;
use wire::{Assumed, Explored, ExploredLine};

use crate::check::plural;
use crate::failure::Failure;
use crate::shell::Shell;

/// Prints the results of a verification.
pub struct Teller<'a> {
    pub words: Verdicts<'a>,
    /// The run of a violation as a scenario that lies beside the model.
    pub scenario: Option<Box<Scripts<'a>>>,
}

/// Writes the run that violates a check as a scenario; none where no scenario makes it.
pub type Scripts<'a> = dyn Fn(Subject, &Trace) -> Option<String> + 'a;

impl<'a> Teller<'a> {
    /// Prints the results of a search over a program. `timed_out`: the search stopped because its time was up.
    pub fn new(program: &'a Program, sources: &'a Sources, timed_out: bool) -> Self {
        Teller { words: Verdicts::new(program, sources, timed_out), scenario: None }
    }
}

impl Teller<'_> {
    /// Prints the assumptions of the verdicts that do not stand in the model.
    pub fn assumed(&self, shell: &mut Shell, assumptions: &[Said<'_>]) -> Result<(), Failure> {
        for term in assumptions.iter().map(|said| said.text().trim()) {
            if shell.json() {
                shell.object(&Assumed::new(term))?;
            } else if shell.talks() {
                writeln!(shell.out(), "assumed   {term}")?;
            }
        }
        Ok(())
    }

    /// Prints the whole report. For what was shown during the search, prints only the verdict.
    pub fn report(&self, shell: &mut Shell, report: &Report, told: &BTreeSet<Subject>) -> Result<(), Failure> {
        for span in &report.unreachable {
            shell.diagnostic(self.words.sources, &groundstate::diagnose_unreachable(*span))?;
        }
        // A search that was to end at its first violation says nothing about the other checks.
        let ended = |verdict: &Verdict| matches!(&verdict.outcome, Outcome::Unknown(reasons) if reasons[..] == [Reason::Stopped(Stop::Found)]);
        let open = if shell.json() { 0 } else { report.verdicts.iter().filter(|verdict| ended(verdict)).count() };
        for verdict in report.verdicts.iter().filter(|verdict| open < 2 || !ended(verdict)) {
            if told.contains(&verdict.subject) {
                if matches!(verdict.outcome, Outcome::Violated(_)) && shell.talks() {
                    writeln!(shell.out(), "{}, as shown above", self.words.line(verdict, report))?;
                }
            } else if shell.json() {
                let mut line = wire::Verdict::new(&self.words, verdict, report);
                if let Outcome::Violated(trace) = &verdict.outcome {
                    line.scenario = self.script(verdict.subject, trace);
                }
                shell.object(&line)?;
            } else if let Outcome::Violated(trace) = &verdict.outcome {
                self.violated(shell, verdict.subject, trace)?;
            } else if shell.talks() || !matches!(verdict.outcome, Outcome::Holds) {
                writeln!(shell.out(), "{}", self.words.line(verdict, report))?;
            }
        }
        if open > 1 {
            let reason = self.words.reason(&Reason::Stopped(Stop::Found));
            writeln!(shell.out(), "unknown   {open} other checks: {reason}")?;
        }
        if let (EngineKind::Solver(_), false) = (report.engine, shell.json()) {
            if shell.talks() {
                let solver = report.solver.as_deref().unwrap_or("a solver");
                let steps = plural(report.progress.depth as usize, "step");
                writeln!(shell.out(), "decided by {solver}, for runs of at most {steps}")?;
            }
            return Ok(());
        }
        if let (Some(Err(unreduced)), false, true) = (report.reduced, shell.json(), shell.talks()) {
            writeln!(shell.out(), "not reduced: {}", why_unreduced(unreduced))?;
        }
        if let (Some(symmetry), false, true) = (&report.symmetry, shell.json(), shell.talks()) {
            self.words.symmetry(symmetry).iter().try_for_each(|line| writeln!(shell.out(), "{line}"))?;
        }
        if shell.json() {
            let more = Explored::new(&self.words, report);
            return shell.object(&ExploredLine::new(&report.progress, report.complete, &more));
        }
        self.extent(shell, &report.progress, Extent::of(report))
    }

    /// Prints that a check holds without a search, and by what.
    pub fn proved(&self, shell: &mut Shell, subject: Subject, by: String) -> Result<(), Failure> {
        if shell.json() {
            let mut line = wire::Verdict::holds(&self.words, subject);
            line.by = Some(by);
            return shell.object(&line);
        }
        if shell.talks() {
            writeln!(shell.out(), "holds     {} ({by})", self.words.name(subject))?;
        }
        Ok(())
    }

    /// Prints how far a search without reductions came.
    pub fn explored(&self, shell: &mut Shell, progress: &Progress, complete: bool) -> Result<(), Failure> {
        if shell.json() {
            return shell.object(&ExploredLine::new(progress, complete, &Explored::default()));
        }
        self.extent(shell, progress, Extent { complete, ..Extent::default() })
    }

    fn extent(&self, shell: &mut Shell, progress: &Progress, extent: Extent) -> Result<(), Failure> {
        if shell.talks() {
            writeln!(shell.out(), "{}", explored(progress, extent))?;
        }
        Ok(())
    }

    fn script(&self, subject: Subject, trace: &Trace) -> Option<String> {
        self.scenario.as_ref().and_then(|script| script(subject, trace))
    }

    /// Prints a violation.
    pub fn violated(&self, shell: &mut Shell, subject: Subject, trace: &Trace) -> Result<(), Failure> {
        if shell.json() {
            let mut line = wire::Verdict::violated(&self.words, subject, trace);
            line.scenario = self.script(subject, trace);
            return shell.object(&line);
        }
        write!(shell.out(), "{}", self.words.violation(subject, trace))?;
        if let Some(fault) = self.words.diagnose(subject, trace) {
            shell.diagnostic(self.words.sources, &fault)?;
        }
        if let Some(hint) = hint(self.words.program, subject, trace) {
            writeln!(shell.out(), "  hint: {hint}")?;
        }
        Ok(())
    }
}
