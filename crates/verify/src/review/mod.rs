//! Review: checks seven meta-properties that every good model has.
//!
//! P. Arcaini, A. Gargantini, E. Riccobene, *Automatic Review of Abstract State Machines by Meta-Property
//! Verification*, NFM 2010. In: a model, its program, bounds. Out: a [`Review`]: findings with their places, and a
//! shortest run for each finding that a run can show. INVARIANT: that something never happens is reported only if every
//! state was explored; otherwise it is unknown.

mod locations;
mod rules;
mod values;

use std::collections::BTreeSet;
use std::sync::Arc;

use machine::{Location, Value};
use model::Model;
use program::{DomainId, FunctionId, Program};
use syntax::{FileId, Span};

use crate::options::Options;
use crate::progress::Progress;
use crate::report::{NoStart, Reason};
use crate::survey::{Survey, survey};
use crate::trace::Trace;

/// A meta-property, with the paper's number.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum Meta {
    /// MP1: no inconsistent update is ever performed.
    Consistent,
    /// MP2: every conditional rule is complete.
    Complete,
    /// MP3: every rule can eventually fire.
    Fires,
    /// MP4: no assignment is always trivial.
    NotTrivial,
    /// MP5: for every domain element there is a location that has it as value.
    ElementUsed,
    /// MP6: every controlled function can take any value of its codomain.
    ValueTaken,
    /// MP7: every controlled location is updated, and every location is read.
    LocationUsed,
}

impl Meta {
    /// All of them, in order.
    pub const ALL: [Meta; 7] = [
        Meta::Consistent,
        Meta::Complete,
        Meta::Fires,
        Meta::NotTrivial,
        Meta::ElementUsed,
        Meta::ValueTaken,
        Meta::LocationUsed,
    ];

    /// Its number, from 1.
    pub fn number(self) -> usize {
        self as usize + 1
    }

    /// Whether it is violated by something that happens; the others are violated by something that never does.
    fn by_event(self) -> bool {
        matches!(self, Meta::Consistent | Meta::Complete)
    }
}

/// What was found.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Matter {
    /// Two updates clash; the place of the other one.
    Clash(Span),
    /// No branch of a conditional rule is taken.
    NoBranch,
    /// A rule never runs.
    NeverRuns,
    /// A declared rule that nothing calls.
    NeverCalled(String),
    /// A rule runs only in steps that fail.
    RunsInFaults,
    /// All updates of a rule write the present value.
    AlwaysTrivial,
    /// Elements of a domain that no location ever has.
    Unused(DomainId, Vec<Value>),
    /// Values of its codomain that a function never takes.
    NeverTaken(FunctionId, Vec<Value>),
    /// Locations that no rule updates; empty if no location of the function is updated.
    NeverUpdated(FunctionId, Vec<Location>),
    /// Locations that no rule reads; empty if no location of the function is read.
    NeverRead(FunctionId, Vec<Location>),
}

/// A finding.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Finding {
    /// The violated meta-property.
    pub meta: Meta,
    /// What was found.
    pub matter: Matter,
    /// Its place.
    pub span: Span,
    /// A shortest run that shows it, if a run can.
    pub witness: Option<Box<Trace>>,
}

/// The outcome of a meta-property.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum MetaOutcome {
    /// It holds for every rule, element and location.
    Holds,
    /// It is violated for some.
    Violated,
    /// It is unknown: not every state was explored.
    Unknown,
}

/// The result of a review.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Review {
    /// The outcomes of the requested meta-properties.
    pub outcomes: Vec<(Meta, MetaOutcome)>,
    /// In the order of meta-properties, then of the text. For an unknown meta-property: what has not been seen yet.
    pub findings: Vec<Finding>,
    /// How far the search came.
    pub progress: Progress,
    /// Why not every state was explored; empty if every one was.
    pub reasons: Vec<Reason>,
    /// Functions of which initial values are computed and too many to be listed, and the meta-properties that are unknown for that.
    pub unclear: BTreeSet<(Meta, FunctionId)>,
}

/// Reviews the parts of a model in files that `own` accepts.
///
/// # Errors
/// There is no initial state.
pub fn review(
    model: &Model,
    program: &Arc<Program>,
    options: &Options,
    metas: &[Meta],
    own: &dyn Fn(FileId) -> bool,
    watch: &mut dyn FnMut(&Progress) -> bool,
) -> Result<Review, NoStart> {
    let survey = survey(program, options, false, watch)?;
    let (findings, unclear) = (Vec::new(), BTreeSet::new());
    let mut reviewer = Reviewer { model, program, survey, own, findings, unclear, unrun_update: false };
    reviewer.rules();
    reviewer.values();
    reviewer.locations();
    let Reviewer { survey, mut findings, unclear, unrun_update, .. } = reviewer;
    // Where nothing happens, it says nothing that something does not.
    let nothing_seen = survey.reasons.iter().any(|reason| matches!(reason, Reason::Vacuous | Reason::Stepless));
    findings.retain(|finding| metas.contains(&finding.meta) && !nothing_seen);
    findings.sort_by_key(|finding| (finding.meta, finding.span));
    let outcome = |meta: Meta| {
        if nothing_seen {
            return MetaOutcome::Unknown;
        }
        let found = findings.iter().any(|finding| finding.meta == meta);
        match (found, survey.is_complete()) {
            (false, true) if unclear.iter().any(|(of, _)| *of == meta) => MetaOutcome::Unknown,
            (true, complete) if complete || meta.by_event() => MetaOutcome::Violated,
            // It may run yet, and write what is there.
            (false, false) if meta == Meta::NotTrivial && unrun_update => MetaOutcome::Unknown,
            (false, complete) if complete || !meta.by_event() => MetaOutcome::Holds,
            _ => MetaOutcome::Unknown,
        }
    };
    let outcomes = Meta::ALL.iter().filter(|meta| metas.contains(meta)).map(|meta| (*meta, outcome(*meta)));
    Ok(Review { outcomes: outcomes.collect(), findings, progress: survey.progress, reasons: survey.reasons, unclear })
}

struct Reviewer<'a> {
    model: &'a Model,
    program: &'a Program,
    survey: Survey,
    own: &'a dyn Fn(FileId) -> bool,
    findings: Vec<Finding>,
    unclear: BTreeSet<(Meta, FunctionId)>,
    /// Some update has not been run in the states that were looked at.
    unrun_update: bool,
}

impl Reviewer<'_> {
    /// The functions that initial values read: what these have decides how a run begins.
    fn read_by_initials(&self) -> BTreeSet<FunctionId> {
        self.program.initials.iter().flat_map(|initial| self.program.reads_and_more(&initial.value).0).collect()
    }

    fn find(&mut self, meta: Meta, matter: Matter, span: Span) {
        self.findings.push(Finding { meta, matter, span, witness: None });
    }

    fn is_own(&self, span: Span) -> bool {
        (self.own)(span.file)
    }
}
