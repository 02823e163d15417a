//! Prints verdicts and counterexamples, as text and as JSON.

use std::cell::RefCell;
use std::collections::{BTreeMap, BTreeSet};
use std::io::Write;

use explore::{ChoiceTaken, Told, Unbounded};
use groundstate::Said;
use groundstate::verify::runs::Why;
use groundstate::verify::solver::{Left, Proof};
use groundstate::verify::{
    EngineKind, Outcome, Progress, Reason, Report, Stop, Storage, Subject, Trace, Unreduced, Verdict,
};
use machine::{Location, Show, Value};
use program::Program;
use syntax::{Diagnostic, Sources, Span};
use wire::{Assumed, Explored, ExploredLine, Place, RunChange, RunStep};

use crate::check::plural;
use crate::failure::Failure;
use crate::shell::Shell;
use crate::verify::hint::hint;

/// Prints the results of a verification.
pub struct Teller<'a> {
    pub program: &'a Program,
    pub sources: &'a Sources,
    /// Whether the search stopped because its time was up.
    pub timed_out: bool,
    /// The initial state that was printed last.
    told: RefCell<Vec<String>>,
}

impl<'a> Teller<'a> {
    /// Prints the results of a search over a program.
    pub fn new(program: &'a Program, sources: &'a Sources, timed_out: bool) -> Self {
        Teller { program, sources, timed_out, told: RefCell::default() }
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
            shell.diagnostic(self.sources, &groundstate::diagnose_unreachable(*span))?;
        }
        for verdict in &report.verdicts {
            if told.contains(&verdict.subject) {
                if let (Outcome::Violated(trace), true) = (&verdict.outcome, shell.talks()) {
                    let (name, steps) = (self.name(verdict.subject), plural(trace.steps.len(), "step"));
                    writeln!(shell.out(), "violated  {name}, after {steps}, as shown above")?;
                }
            } else if shell.json() {
                shell.object(&self.line(verdict, report))?;
            } else if shell.talks() || !matches!(verdict.outcome, Outcome::Holds) {
                self.verdict(shell, verdict, report)?;
            }
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
            self.symmetry(shell, symmetry)?;
        }
        let symmetry = report.symmetry.as_ref().map(|symmetry| self.symmetry_lines(symmetry));
        let omission = report.omission.map(|expected| expected.0);
        let reduced = report.reduced.map(|reduced| reduced.map_or_else(why_unreduced, |()| "reduced"));
        let sets = report.engine == EngineKind::Symbolic;
        let explored = Explored { bits: Some(report.width.1), omission, partial_order: reduced, symmetry, sets };
        self.explored(shell, &report.progress, report.complete, &explored)
    }

    /// Prints how far a search came.
    pub fn explored(
        &self,
        shell: &mut Shell,
        progress: &Progress,
        complete: bool,
        more: &Explored,
    ) -> Result<(), Failure> {
        if shell.json() {
            return shell.object(&ExploredLine::new(progress, complete, more));
        }
        if shell.talks() {
            let up_to = more.symmetry.iter().flatten().any(|line| line.is_class());
            let whole = match (complete, more.partial_order) {
                (true, Some("reduced")) => "all reachable, up to the order of moves",
                (true, _) if up_to => "all reachable, up to interchangeable elements",
                (true, _) => "all reachable",
                (false, _) => "not all reachable",
            };
            let states = plural(progress.states as usize, "state");
            let transitions = match more.sets {
                true => "met as sets".to_string(),
                false => plural(progress.transitions as usize, "transition"),
            };
            // Rounds of a symbolic search are not depths.
            let depth = if more.sets { String::new() } else { format!(", depth {}", progress.depth) };
            let disk = match progress.spilled {
                0 => String::new(),
                bytes => format!(", {} MiB on disk", bytes.div_ceil(1 << 20)),
            };
            writeln!(shell.out(), "{states} ({whole}), {transitions}{depth}{disk}")?;
        }
        Ok(())
    }

    fn verdict(&self, shell: &mut Shell, verdict: &Verdict, report: &Report) -> Result<(), Failure> {
        let name = self.name(verdict.subject);
        match &verdict.outcome {
            Outcome::Holds => match self.proof(verdict.subject, report) {
                Some(proof) => writeln!(shell.out(), "holds     {name} ({proof})")?,
                None => writeln!(shell.out(), "holds     {name}")?,
            },
            Outcome::Unknown(reasons) => {
                let reasons = self.reasons(verdict.subject, reasons, report);
                writeln!(shell.out(), "unknown   {name}: {}", reasons.join("; "))?;
            }
            Outcome::Violated(trace) => self.violated(shell, verdict.subject, trace)?,
        }
        Ok(())
    }

    /// Prints a violation.
    pub fn violated(&self, shell: &mut Shell, subject: Subject, trace: &Trace) -> Result<(), Failure> {
        if shell.json() {
            return shell.object(&self.violated_line(subject, trace));
        }
        let steps = plural(trace.steps.len(), "step");
        writeln!(shell.out(), "violated  {}, after {steps}", self.name(subject))?;
        self.trace(shell, trace, subject)?;
        if let Some(hint) = hint(self.program, subject, trace) {
            writeln!(shell.out(), "  hint: {hint}")?;
        }
        Ok(())
    }

    /// Prints a run, step by step. An initial state that equals that of the previous run is not repeated.
    pub fn run(&self, shell: &mut Shell, trace: &Trace) -> Result<(), Failure> {
        let binders = groundstate::choice_variables(self.program);
        let inputs = trace.start.inputs.iter().map(|(location, value)| format!("in {}", self.value(location, value)));
        let values = trace.values.iter().map(|(location, value)| self.value(location, value));
        let state: Vec<String> = inputs.chain(values).collect();
        if state.len() > 1 && *self.told.borrow() == state {
            writeln!(shell.out(), "  state 0, as above")?;
        } else {
            writeln!(shell.out(), "  state 0")?;
            state.iter().try_for_each(|line| writeln!(shell.out(), "    {line}"))?;
            self.told.replace(state);
        }
        for (index, step) in trace.steps.iter().enumerate() {
            let made = if step.fault.is_some() { ", not made" } else { "" };
            writeln!(shell.out(), "  step {}{made}", index + 1)?;
            for (location, value) in &step.inputs {
                writeln!(shell.out(), "    in {}", self.value(location, value))?;
            }
            for choice in &step.choices {
                writeln!(shell.out(), "    choose {}", self.choice(choice, &binders))?;
            }
            for change in &step.changes {
                let (location, by) = (change.location.show(self.program), self.place(change.span));
                let (before, after) = (change.before.show(self.program), change.after.show(self.program));
                writeln!(shell.out(), "    {location}: {before} -> {after}  ({by})")?;
            }
            if step.fault.is_none() && step.changes.is_empty() {
                writeln!(shell.out(), "    no change")?;
            }
        }
        if let Some(turn) = trace.turn {
            writeln!(shell.out(), "  and again from step {}, for ever", turn + 1)?;
        }
        Ok(())
    }

    fn trace(&self, shell: &mut Shell, trace: &Trace, subject: Subject) -> Result<(), Failure> {
        self.run(shell, trace)?;
        if let Some(fault) = trace.steps.last().and_then(|step| step.fault.as_deref()) {
            return shell.diagnostic(self.sources, &groundstate::diagnose_fault(fault, self.program));
        }
        if let Subject::Property(index) = subject {
            let property = &self.program.properties[index];
            return shell.diagnostic(self.sources, &groundstate::diagnose_property(property, trace));
        }
        Ok(())
    }

    fn violated_line(&self, subject: Subject, trace: &Trace) -> wire::Verdict {
        let mut line = self.line_of(subject);
        line.verdict = "violated";
        line.trace = Some(self.steps(trace));
        line.again_from = trace.turn.map(|turn| turn + 1);
        line
    }

    /// The line of a check that holds.
    fn line_of(&self, subject: Subject) -> wire::Verdict {
        let (kind, span) = match subject {
            Subject::Property(index) => ("property", Some(self.program.properties[index].span)),
            _ => ("builtin", None),
        };
        let check = id(subject).map_or_else(|| self.name(subject), str::to_string);
        wire::Verdict::holds(check, kind, span.map(|span| Place::new(self.sources, span)))
    }

    fn line(&self, verdict: &Verdict, report: &Report) -> wire::Verdict {
        let mut line = self.line_of(verdict.subject);
        match &verdict.outcome {
            Outcome::Holds => match self.proof(verdict.subject, report) {
                None => line.states = Some(report.progress.states),
                proof => line.by = proof,
            },
            Outcome::Unknown(reasons) => {
                line.verdict = "unknown";
                line.reasons = self.reasons(verdict.subject, reasons, report);
            }
            Outcome::Violated(trace) => line = self.violated_line(verdict.subject, trace),
        }
        line
    }

    /// A run as JSON.
    pub fn steps(&self, trace: &Trace) -> Vec<RunStep> {
        let binders = groundstate::choice_variables(self.program);
        let pairs = |values: &[(Location, Value)]| -> Vec<(String, String)> {
            let show = |(location, value): &(Location, Value)| {
                (location.show(self.program).to_string(), value.show(self.program).to_string())
            };
            values.iter().map(show).collect()
        };
        let line = |step: usize, told: &Told, values: &[(Location, Value)]| RunStep {
            step,
            values: pairs(values),
            inputs: pairs(&told.inputs),
            choices: told.choices.iter().map(|choice| self.choice(choice, &binders)).collect(),
            changes: told
                .changes
                .iter()
                .map(|change| RunChange {
                    location: change.location.show(self.program).to_string(),
                    from: change.before.show(self.program).to_string(),
                    to: change.after.show(self.program).to_string(),
                    by: self.place(change.span),
                })
                .collect(),
            fault: told.fault.as_ref().map(|fault| fault.show(self.program).to_string()),
        };
        let first = line(0, &trace.start, &trace.values);
        let steps = trace.steps.iter().enumerate().map(|(index, told)| line(index + 1, told, &[]));
        std::iter::once(first).chain(steps).collect()
    }

    fn name(&self, subject: Subject) -> String {
        match subject {
            Subject::Consistent => "no inconsistent update".to_string(),
            Subject::InDomain => "no update outside its domain".to_string(),
            Subject::Defined => "every guard and operation is defined".to_string(),
            Subject::NoDeadlock => "no deadlock".to_string(),
            Subject::Property(index) => self.program.properties[index].name.clone(),
        }
    }

    fn reasons(&self, subject: Subject, reasons: &[Reason], report: &Report) -> Vec<String> {
        let why = match subject {
            Subject::Property(index) => report.runs.get(&index),
            _ => None,
        };
        let temporal = |reason: &Reason| match (reason, why) {
            (Reason::Temporal, Some(why)) => self.why(why),
            (Reason::Compacted, _) => omission(report),
            (Reason::Left, _) => report.left.get(&subject).map_or_else(|| self.reason(reason), |left| self.left(left)),
            (reason, _) => self.reason(reason),
        };
        reasons.iter().map(temporal).collect()
    }

    /// Why a temporal formula is undecided.
    fn why(&self, why: &Why) -> String {
        match why {
            Why::Unexplored(Some(stop)) => self.reason(&Reason::Stopped(*stop)),
            Why::Unexplored(None) => "some alternatives cannot be enumerated".to_string(),
            Why::NoTruth(span, values) => {
                let values: Vec<String> = values.iter().map(|(location, value)| self.value(location, value)).collect();
                let text: Vec<&str> = self.sources.text(*span).split_whitespace().collect();
                let (part, place) = (text.join(" "), self.place(*span));
                format!("`{part}` ({place}) is neither true nor false in the state {}", values.join(", "))
            }
            Why::NoFairRun => "no run is fair".to_string(),
            Why::NoScheduler => "the main rule does not choose who moves".to_string(),
            Why::TooLarge(what, most) => format!("more than {most} {what}"),
            Why::Asked => self.reason(&Reason::Stopped(Stop::Asked)),
            Why::Unread(what) => format!("its formula is at fault: {what}"),
        }
    }

    /// How a solver proved a check.
    fn proof(&self, subject: Subject, report: &Report) -> Option<String> {
        let how = match report.proofs.get(&subject)? {
            Proof::Induction(steps) => format!("k-induction, k = {steps}"),
            Proof::Reachability => "property-directed reachability".to_string(),
        };
        Some(format!("{how}, {}", report.solver.as_deref().unwrap_or("a solver")))
    }

    /// Why a solver left a check open.
    fn left(&self, left: &Left) -> String {
        match left {
            Left::Depth(depth) => format!("no run of at most {} violates it", plural(*depth, "step")),
            Left::Late(0) => "the solver does not know".to_string(),
            Left::Late(steps) => format!("the solver does not know about runs of {}", plural(*steps, "step")),
            Left::Stopped => self.reason(&Reason::Stopped(Stop::Asked)),
            Left::Broken(reason) => reason.clone(),
            Left::Beyond(outside) => {
                format!(
                    "a run meets {}, which is not translated for solvers ({})",
                    outside.what,
                    self.place(outside.span)
                )
            }
            Left::Odd => "the solver found a run that the machine does not make, which is a bug of this program or, \
                          where reals are computed, of rounding"
                .to_string(),
            Left::Untold => "a solver would have to enumerate all values of an input".to_string(),
        }
    }

    /// Why a verdict is unknown.
    pub fn reason(&self, reason: &Reason) -> String {
        match reason {
            Reason::Stopped(Stop::States) => "the limit of states is reached".to_string(),
            Reason::Stopped(Stop::Depth) => "the limit of depth is reached".to_string(),
            Reason::Stopped(Stop::Memory) => "the limit of memory is reached".to_string(),
            Reason::Stopped(Stop::Disk) => "a file of states could not be written or read".to_string(),
            Reason::Stopped(Stop::Found) => "the search ended at the first violation (--first)".to_string(),
            Reason::Stopped(Stop::Asked) if self.timed_out => "the time is up".to_string(),
            Reason::Stopped(Stop::Asked) => "interrupted".to_string(),
            Reason::Compacted => "states are told apart only by hashes".to_string(),
            Reason::Unbounded(unbounded) => self.unbounded(unbounded).message,
            Reason::Bounded(function) => {
                format!("{} is tried with only some of its values", self.program.function(*function).name)
            }
            Reason::Assumption(property) => {
                format!("the assumption {} has no value in some state", self.program.properties[*property].name)
            }
            Reason::Undecided => "it has no value in some state".to_string(),
            Reason::Temporal => "this engine does not decide temporal formulas".to_string(),
            Reason::Left => "the solver left it open".to_string(),
            Reason::Odd => {
                "the search found a run that the machine does not make, which is a bug of this program: please \
                            report it"
                    .to_string()
            }
        }
    }

    /// What cannot be enumerated, with its place.
    pub fn unbounded(&self, unbounded: &Unbounded) -> Diagnostic {
        groundstate::diagnose_unbounded(unbounded, self.program, self.sources)
    }

    fn value(&self, location: &Location, value: &Value) -> String {
        format!("{} = {}", location.show(self.program), value.show(self.program))
    }

    fn choice(&self, choice: &ChoiceTaken, binders: &BTreeMap<Span, Vec<String>>) -> String {
        let values: Vec<String> = choice.values.iter().map(|value| value.show(self.program).to_string()).collect();
        match binders.get(&choice.span) {
            Some(names) if names.len() == values.len() => {
                let pairs: Vec<String> =
                    names.iter().zip(&values).map(|(name, value)| format!("{name} = {value}")).collect();
                pairs.join(", ")
            }
            _ => values.join(", "),
        }
    }

    pub(super) fn place(&self, span: Span) -> String {
        groundstate::short_place(self.sources, span)
    }
}

/// Why partial-order reduction was not possible.
fn why_unreduced(unreduced: Unreduced) -> &'static str {
    match unreduced {
        Unreduced::NoChoice => "the main rule does not choose who moves",
        Unreduced::Inputs => "an invariant or an assumption reads inputs",
        Unreduced::AllShared => "no agent has locations of its own",
    }
}

/// The probability that a state was omitted.
fn omission(report: &Report) -> String {
    let expected = report.omission.map_or(0.0, |expected| expected.0);
    if expected >= 1.0 {
        return format!("about {expected:.0} states were mistaken for others and omitted");
    }
    let most = match report.storage {
        Storage::BitState(_) => "about",
        _ => "at most",
    };
    // Two digits, rounded up.
    let unit = 10f64.powf(expected.max(f64::MIN_POSITIVE).log10().floor() - 1.0);
    let probability = (expected / unit).ceil() * unit;
    format!("with a probability of {most} {probability:.1e} a state was mistaken for another and omitted")
}

/// The name of a check that every model has.
pub fn id(subject: Subject) -> Option<&'static str> {
    Some(match subject {
        Subject::Consistent => "consistent",
        Subject::InDomain => "in-domain",
        Subject::Defined => "defined",
        Subject::NoDeadlock => "no-deadlock",
        Subject::Property(_) => return None,
    })
}
