//! The alternatives of one step, taken one after the other: an odometer over its choices and inputs.
//!
//! In: how a step before went. Out: the answers for the next one, as an [`Environment`]. A step is deterministic but for
//! what it asks for, so the same answers bring it to the same next question; the last question that has an answer left
//! is answered differently the next time. What the step looked at in the state is noted in the same order.
//!
//! A `choose` rule with a guard is asked for before its guards are evaluated: each binding is an alternative, one whose
//! guard does not hold is *dead*, and only where all are dead does the rule have no candidate. So an alternative looks
//! at no more of the state than its own guard does.

use std::collections::{BTreeMap, BTreeSet};
use std::sync::Arc;

use machine::{
    Alternatives, Bounds, Choice, Draw, Edit, Environment, Fault, FaultKind, Location, LocationRef, Piece, TimeUnit,
    Value,
};
use program::{DomainId, FunctionId, Program};
use syntax::Span;

use crate::alternatives::told::ChoiceTaken;
use crate::alternatives::unbounded::{Unbounded, UnboundedKind};
use crate::packed::collection::Collection;
use crate::packed::encoding::Encoding;
use crate::packed::words::{Field, NOWHERE, REST};

/// What a step does that matters to how it goes on, in order.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Event {
    /// It looks at a field of the packed state.
    Look(u32),
    /// It asks; the answers are in the same order.
    Ask,
}

/// A question and its answer.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) struct Asked {
    /// Which alternative, from 0.
    pub taken: u32,
    /// How many there are.
    pub of: u32,
    /// A guarded choice: after `of` alternatives comes one more, that none of them is alive.
    pub guarded: bool,
    /// Some alternative taken so far was not dead.
    alive: bool,
}

/// The collections that a packed state holds in pieces.
#[derive(Debug)]
pub(crate) struct Pieces(Arc<Encoding>);

impl Pieces {
    /// Those of an encoding, if it has any.
    pub fn of(encoding: &Arc<Encoding>) -> Option<Pieces> {
        encoding.pieces.iter().any(|first| *first > 0).then(|| Pieces(Arc::clone(encoding)))
    }

    fn of_function(&self, function: FunctionId) -> Option<&Collection> {
        self.0.collection(function)
    }

    /// What is looked at for a piece of what a field holds; none where that says nothing.
    fn look(&self, field: u32, piece: Piece<'_>) -> Option<u32> {
        // A location whose arguments are in no domain belongs to the rest.
        let Some(Field { function, .. }) = self.0.fields.get(field as usize) else { return Some(field) };
        match self.of_function(*function) {
            Some(collection) => Some(self.0.pieces[field as usize] + collection.place(piece)? as u32),
            None => Some(field),
        }
    }
}

/// See the module.
#[derive(Debug)]
pub struct Branches {
    asked: Vec<Asked>,
    at: usize,
    /// In the order of the step, each look once.
    pub(crate) events: Vec<Event>,
    /// By field, the pass that looked at it last.
    looked: Vec<u32>,
    pass: u32,
    /// By dense location number: its field, [`REST`] or [`NOWHERE`].
    pub(crate) fields: Arc<[u32]>,
    /// The field of the rest, if the packed state has one.
    pub(crate) rest: Option<u32>,
    /// The field that says in which initial state the run began, if there is one.
    pub(crate) origin: Option<u32>,
    /// The functions whose inputs may be in the rest of an initial state.
    pub(crate) inputs_in_rest: BTreeSet<FunctionId>,
    pub(crate) bounds: Arc<Bounds>,
    /// Values of inputs that go before all others: those of a run that is followed.
    pub(crate) given: BTreeMap<Location, Value>,
    /// The collections that stand in pieces.
    pub(crate) pieces: Option<Pieces>,
    /// The locations of such that were overwritten, and the edit where that is all that was done to one.
    edits: Vec<(u32, Option<Edit>)>,
    /// The alternative taken is none.
    pub(crate) dead: bool,
    pub(crate) unbounded: Option<Unbounded>,
    /// What was chosen.
    pub(crate) chosen: Vec<ChoiceTaken>,
}

impl Branches {
    pub(crate) fn new(bounds: Arc<Bounds>) -> Branches {
        Branches {
            asked: Vec::new(),
            at: 0,
            events: Vec::new(),
            looked: Vec::new(),
            pass: 0,
            fields: Arc::new([]),
            rest: None,
            origin: None,
            inputs_in_rest: BTreeSet::new(),
            bounds,
            given: BTreeMap::new(),
            pieces: None,
            edits: Vec::new(),
            dead: false,
            unbounded: None,
            chosen: Vec::new(),
        }
    }

    /// Begins the first alternative.
    pub(crate) fn first(&mut self) {
        self.asked.clear();
        self.begin();
    }

    /// Begins with these answers; where they end, with the first alternatives.
    pub(crate) fn follow(&mut self, picks: &[u32]) {
        self.asked.clear();
        // The candidates of a choice are known only when it is made.
        self.asked.extend(picks.iter().map(|taken| Asked {
            taken: *taken,
            of: u32::MAX,
            guarded: false,
            alive: false,
        }));
        self.begin();
    }

    /// Begins the next alternative; false where there is none left.
    pub(crate) fn next(&mut self) -> bool {
        if !self.dead {
            self.asked.iter_mut().for_each(|asked| asked.alive = true);
        }
        while let Some(last) = self.asked.last_mut() {
            last.taken += 1;
            if last.taken < last.of || (last.taken == last.of && last.guarded && !last.alive) {
                self.begin();
                return true;
            }
            self.asked.pop();
        }
        false
    }

    /// How many answers, the first, are those of the alternative before.
    pub(crate) fn kept(&self) -> usize {
        self.asked.len() - 1
    }

    fn begin(&mut self) {
        self.at = 0;
        self.events.clear();
        self.chosen.clear();
        self.edits.clear();
        self.dead = false;
        self.unbounded = None;
        self.pass += 1;
    }

    /// The answers given.
    pub(crate) fn answers(&self) -> &[Asked] {
        &self.asked[..self.at]
    }

    /// Notes that a field of the state is looked at.
    pub(crate) fn look_at(&mut self, field: u32) {
        let field = if field == REST { self.rest.unwrap_or(NOWHERE) } else { field };
        if field == NOWHERE {
            return;
        }
        let index = field as usize;
        if index >= self.looked.len() {
            self.looked.resize(index + 1, 0);
        }
        if std::mem::replace(&mut self.looked[index], self.pass) != self.pass {
            self.events.push(Event::Look(field));
        }
    }

    /// Where a location stands; `found` is its number, if it has one, and `kept` says whether its function's locations are
    /// part of the state.
    fn field(&self, found: Option<u32>, kept: bool) -> u32 {
        let dense = found.and_then(|index| self.fields.get(index as usize));
        dense.copied().unwrap_or(if kept { REST } else { NOWHERE })
    }

    /// The edit that is all that the step did to a location, if it is so.
    pub(crate) fn edit_of(&self, location: u32) -> Option<&Edit> {
        let edited = self.edits.iter().find(|(other, _)| *other == location)?;
        edited.1.as_ref()
    }

    /// The step ends here, since its alternatives cannot be gone through.
    fn endless(&mut self, kind: UnboundedKind, span: Span) -> String {
        self.unbounded = Some(Unbounded { kind, span });
        String::new()
    }

    /// Where a step, or the value of a condition, was not computed to its end: what it would come to is not known.
    pub(crate) fn note_limit(&mut self, fault: &Fault) {
        if let FaultKind::Limit { .. } | FaultKind::Interrupted(_) = fault.kind {
            self.endless(UnboundedKind::Limit, fault.span);
        }
    }

    /// Where an assumption has no value: whether the step counts is not known.
    pub(crate) fn note_unclear(&mut self, fault: &Fault) {
        // An input that cannot be gone through has been noted already.
        if self.unbounded.is_none() {
            self.endless(UnboundedKind::Assumption, fault.span);
        }
    }
}

impl Alternatives for Branches {
    fn ask(&mut self, of: usize, guarded: bool) -> usize {
        let of = of as u32;
        match self.asked.get_mut(self.at) {
            Some(asked) => (asked.of, asked.guarded) = (of, guarded),
            None => self.asked.push(Asked { taken: 0, of, guarded, alive: false }),
        }
        self.events.push(Event::Ask);
        self.at += 1;
        self.asked[self.at - 1].taken as usize
    }

    fn asked(&self) -> usize {
        self.at
    }

    fn ask_from(&mut self, question: usize) {
        self.at = question;
    }

    fn be_dead(&mut self) {
        self.dead = true;
    }

    fn is_dead(&self) -> bool {
        self.dead
    }

    fn chose(&mut self, span: Span, values: Vec<Value>) {
        self.chosen.push(ChoiceTaken { span, values });
    }

    fn gives(&self, input: FunctionId) -> bool {
        self.bounds.contains_key(&input) || self.given.keys().any(|location| location.function == input)
    }

    fn endless_input(&mut self, input: FunctionId, span: Span) -> String {
        self.endless(UnboundedKind::Input(input), span)
    }

    fn endless_choice(&mut self, span: Span) {
        self.endless(UnboundedKind::Choice, span);
    }

    fn look(&mut self, function: FunctionId, found: Option<u32>, kept: bool) {
        let kept = kept || self.inputs_in_rest.contains(&function);
        self.look_at(self.field(found, kept));
    }

    fn write(&mut self, found: Option<u32>, kept: bool) {
        if self.field(found, kept) == REST {
            self.look_at(REST);
        }
    }

    fn keeps_pieces(&self, function: FunctionId) -> bool {
        self.pieces.as_ref().is_some_and(|pieces| pieces.of_function(function).is_some())
    }

    fn look_at_piece(&mut self, location: u32, piece: Piece<'_>) {
        let field = self.field(Some(location), true);
        let look = match &self.pieces {
            Some(pieces) => pieces.look(field, piece),
            None => Some(field),
        };
        if let Some(look) = look {
            self.look_at(look);
        }
    }

    fn overwrite(&mut self, function: FunctionId, location: u32, edit: Option<Edit>) {
        if !self.keeps_pieces(function) {
            return;
        }
        match self.edits.iter_mut().find(|(other, _)| *other == location) {
            None => self.edits.push((location, edit)),
            Some((_, former)) => {
                // Whether the two clash, and what comes of both, depends on what was there.
                if former.take().is_some() || edit.is_some() {
                    self.look_at(self.field(Some(location), true));
                }
            }
        }
    }

    fn look_at_carriers(&mut self) {
        self.look_at(REST);
    }

    fn look_at_origin(&mut self) {
        self.look_at(self.origin.unwrap_or(NOWHERE));
    }
}

impl Environment for Branches {
    fn monitored(
        &mut self,
        program: &Program,
        location: LocationRef<'_>,
        _codomain: DomainId,
    ) -> Result<Value, String> {
        if let Some(value) = self.given.get(&location.to_location()) {
            return Ok(value.clone());
        }
        let span = program.function(location.function).span;
        let bounds = Arc::clone(&self.bounds);
        match bounds.get(&location.function) {
            Some(values) if !values.is_empty() => Ok(values[self.ask(values.len(), false)].clone()),
            _ => Err(self.endless(UnboundedKind::Input(location.function), span)),
        }
    }

    fn choose(&mut self, _program: &Program, choice: &Choice<'_>) -> Result<usize, String> {
        let taken = self.ask(choice.candidates(), false);
        if taken < choice.candidates() {
            self.chosen.push(ChoiceTaken { span: choice.span, values: choice.candidate(taken).to_vec() });
        }
        Ok(taken)
    }

    fn number(&mut self, _program: &Program, draw: &Draw) -> Result<Value, String> {
        Err(self.endless(UnboundedKind::Choice, draw.span))
    }

    fn time(&mut self, _unit: TimeUnit) -> Result<i64, String> {
        let span = Span { file: syntax::FileId(0), start: 0, end: 0 };
        Err(self.endless(UnboundedKind::Clock, span))
    }

    fn alternatives(&mut self) -> Option<&mut dyn Alternatives> {
        Some(self)
    }
}
