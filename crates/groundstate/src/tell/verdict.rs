//! Describes verdicts as text for people: what holds and by which proof, what does not, what is unknown and why.
//!
//! In: a [`Report`] of a verification. Out: words and lines. The lines of a run are in `found`.

use std::cell::RefCell;
use std::collections::BTreeMap;

use explore::Unbounded;
use machine::{Location, Show, Value};
use program::Program;
use syntax::{Diagnostic, Sources, Span};
use verify::runs::Why;
use verify::solver::{Left, Proof};
use verify::{Outcome, Reason, Report, Stop, Storage, Subject, Trace, Verdict};

use super::plural;

/// Describes the verdicts about a program.
#[derive(Debug)]
pub struct Verdicts<'a> {
    /// The program, with the terms that were asked about.
    pub program: &'a Program,
    /// Its texts.
    pub sources: &'a Sources,
    /// Whether the search stopped because its time was up.
    pub timed_out: bool,
    /// The checks that hold by another search, and of what more it was.
    pub elsewhere: BTreeMap<Subject, &'static str>,
    /// How runs are told, if not as steps of the program.
    pub story: Option<Story<'a>>,
    /// The initial state that was shown last.
    pub(super) initial: RefCell<Vec<String>>,
}

/// Tells the run that violates a check, as lines.
pub struct Story<'a>(pub Box<Teller<'a>>);

type Teller<'a> = dyn Fn(Subject, &Trace) -> String + 'a;

impl std::fmt::Debug for Story<'_> {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str("Story")
    }
}

impl<'a> Verdicts<'a> {
    /// Describes the results of a search over a program.
    pub fn new(program: &'a Program, sources: &'a Sources, timed_out: bool) -> Self {
        Verdicts { program, sources, timed_out, elsewhere: BTreeMap::new(), story: None, initial: RefCell::default() }
    }
}

impl Verdicts<'_> {
    /// A verdict as one line; of a violation, the head of what [`Verdicts::violation`] describes.
    pub fn line(&self, verdict: &Verdict, report: &Report) -> String {
        let name = self.name(verdict.subject);
        match &verdict.outcome {
            Outcome::Holds => match self.proof(verdict.subject, report) {
                Some(proof) => format!("holds     {name} ({proof})"),
                None => format!("holds     {name}"),
            },
            Outcome::Unknown(reasons) => {
                format!("unknown   {name}: {}", self.reasons(verdict.subject, reasons, report).join("; "))
            }
            Outcome::Violated(trace) => self.violated(verdict.subject, trace),
        }
    }

    /// The line of a violation.
    pub fn violated(&self, subject: Subject, trace: &Trace) -> String {
        format!("violated  {}, after {}", self.name(subject), plural(trace.steps.len(), "step"))
    }

    /// A violation with its run, as lines.
    pub fn violation(&self, subject: Subject, trace: &Trace) -> String {
        let run = match &self.story {
            Some(Story(told)) => told(subject, trace),
            None => self.run(trace),
        };
        format!("{}\n{run}", self.violated(subject, trace))
    }

    /// What is wrong at the end of a violating run, with its place.
    pub fn diagnose(&self, subject: Subject, trace: &Trace) -> Option<Diagnostic> {
        if let Some(fault) = trace.steps.last().and_then(|step| step.fault.as_deref()) {
            return Some(crate::diagnose_fault(fault, self.program));
        }
        let Subject::Property(index) = subject else { return None };
        Some(crate::diagnose_property(&self.program.properties[index], trace))
    }

    /// The name of a check.
    pub fn name(&self, subject: Subject) -> String {
        match subject {
            Subject::Consistent => "no inconsistent update".to_string(),
            Subject::InDomain => "no update outside its domain".to_string(),
            Subject::Defined => "every guard and operation is defined".to_string(),
            Subject::NoDeadlock => "no deadlock".to_string(),
            Subject::Property(index) => self.program.properties[index].name.clone(),
        }
    }

    /// Why a verdict is unknown, each reason in words.
    pub fn reasons(&self, subject: Subject, reasons: &[Reason], report: &Report) -> Vec<String> {
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
            Why::Unexplored(None) => {
                "some alternatives cannot be enumerated, or a run ends in a state of whose inputs a formula speaks"
                    .to_string()
            }
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
    pub fn proof(&self, subject: Subject, report: &Report) -> Option<String> {
        if let Some(more) = self.elsewhere.get(&subject) {
            return Some((*more).to_string());
        }
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
            Left::Exact(depth) => {
                let steps = plural(*depth, "step");
                format!("no run of at most {steps} that computes exactly violates it; one that rounds reals may")
            }
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
            Reason::Vacuous => "no initial state satisfies the assumptions".to_string(),
            Reason::Stepless => "no step satisfies the assumptions".to_string(),
            Reason::Unlawful => "no scenario goes on where an invariant may not hold".to_string(),
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
        crate::diagnose_unbounded(unbounded, self.program, self.sources)
    }

    pub(super) fn value(&self, location: &Location, value: &Value) -> String {
        format!("{} = {}", location.show(self.program), value.show(self.program))
    }

    pub(super) fn place(&self, span: Span) -> String {
        crate::short_place(self.sources, span)
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
