//! One of the two machines as formulas: an arbitrary state of it, one step from there, and its initial states.
//!
//! In: a program, its initial states, the functions that the coupling reads. Out: a [`Symbolic`], whose terms stand in the store that both
//! machines and the coupling share. The meaning of rules is [`solve::encode`]'s. INVARIANT: what the concrete machine may do is never too
//! little, and what the abstract machine can do never too much: where an assumption is neither true nor false, or the machine may do what
//! is not encoded, the formulas count it against the refinement.

use std::collections::{BTreeMap, BTreeSet};
use std::sync::Arc;

use explore::{Given, Told};
use machine::{Bounds, FaultClass, Limits, Location, Machine, Value};
use program::{Expression, FunctionId, Program, PropertyKind};
use rustc_hash::FxHashMap;
use solve::Outside;
use solve::encode::{Encoder, Input, InputKind, Place};
use solve::shared::{Node, Op, Terms, VariableId};
use solve::symbol::{Codes, Shape, Symbol};

use crate::{CONCRETE, SIDES};

/// The terms and codes of both machines and the coupling.
#[derive(Debug, Default)]
pub(crate) struct Store {
    pub terms: Terms,
    pub codes: Codes,
}

impl Store {
    /// Lets an encoder work on these terms.
    pub fn lend<T>(&mut self, encoder: &mut Encoder, work: impl FnOnce(&mut Encoder) -> T) -> T {
        let swap = |store: &mut Store, encoder: &mut Encoder| {
            std::mem::swap(&mut store.terms, &mut encoder.terms);
            std::mem::swap(&mut store.codes, &mut encoder.codes);
        };
        swap(self, encoder);
        let outcome = work(encoder);
        swap(self, encoder);
        outcome
    }

    /// The variable that a term is.
    pub fn variable(&self, node: Node) -> Option<VariableId> {
        match self.terms.op(node) {
            Op::Variable(id) => Some(*id),
            _ => None,
        }
    }

    /// A term in which terms stand for variables.
    pub fn replaced(&mut self, node: Node, by: &mut Replacement) -> Node {
        let Replacement { of, made } = by;
        self.terms.replace(node, &|id| of.get(&id).copied(), made)
    }
}

/// Terms that stand for variables.
#[derive(Debug, Default)]
pub(crate) struct Replacement {
    of: FxHashMap<VariableId, Node>,
    made: FxHashMap<Node, Node>,
}

impl Replacement {
    /// Of these variables.
    pub fn new(of: impl IntoIterator<Item = (VariableId, Node)>) -> Replacement {
        Replacement { of: of.into_iter().collect(), made: FxHashMap::default() }
    }
}

/// A machine, what it starts from, and what of it the coupling reads.
pub(crate) struct Subject<'a> {
    pub side: usize,
    pub program: &'a Arc<Program>,
    pub limits: &'a Limits,
    pub bounds: Bounds,
    /// A number beyond 64 bits ends a run, and is no fault.
    pub ends_at_overflow: bool,
    /// The initial states.
    pub starts: &'a [Told],
    /// By function that the coupling reads, the term that reads it.
    pub readers: &'a FxHashMap<FunctionId, Expression>,
    /// What the coupling reads.
    pub read: &'a BTreeSet<(FunctionId, Vec<Value>)>,
    /// What it reads of a step, with its inputs.
    pub read_in_step: &'a BTreeSet<(FunctionId, Vec<Value>)>,
}

/// What the coupling reads of a state: the value, and the condition under which it cannot be evaluated.
pub(crate) type Reads = FxHashMap<(FunctionId, Vec<Value>), (Symbol, Node)>;

/// See the module.
pub(crate) struct Symbolic {
    /// The locations of the state.
    pub places: Vec<Place>,
    /// The variables of the state: for each place its value and, if it may be undef, whether it is defined.
    pub state: Vec<VariableId>,
    /// Their values after a step that is made.
    pub next: Vec<Node>,
    /// Their values in each initial state.
    pub starts: Vec<Vec<Node>>,
    /// A step changes the state.
    pub changed: Node,
    /// The step is made.
    pub goes: Node,
    /// It cannot be made: the kinds of faults in words, each with its condition.
    pub faults: Vec<(&'static str, Node)>,
    /// The machine may do what is not encoded.
    pub strays: Vec<(Node, Outside)>,
    /// What domains and assumptions say about a state: what surely holds, and what perhaps holds.
    pub surely: Node,
    pub perhaps: Node,
    /// By invariant of the model: that it surely holds of a state; or a clause that says why that is not translated.
    pub invariants: Vec<(String, Result<Node, String>)>,
    /// Facts about the inputs.
    pub given: Vec<Node>,
    pub inputs: Vec<Input>,
    pub reads: Reads,
    /// Reading what the coupling reads of a state may do what is not encoded; and what it reads of a step.
    pub reads_stray: Node,
    pub step_reads_stray: Node,
}

impl Symbolic {
    /// The formulas of a machine.
    ///
    /// # Errors
    /// What cannot be encoded.
    pub fn of(of: &Subject<'_>, store: &mut Store) -> Result<Symbolic, Outside> {
        let mut partial = BTreeSet::new();
        // By index of the property: why an invariant is not translated.
        let mut untold: BTreeMap<usize, String> = BTreeMap::new();
        let properties = of.program.properties.iter().enumerate();
        let invariants = properties.filter(|(_, property)| property.kind == PropertyKind::Invariant);
        let invariants: Vec<usize> = invariants.map(|(index, _)| index).collect();
        loop {
            let mut machine = Machine::new(Arc::clone(of.program), of.limits.clone());
            machine.ignore_interrupts();
            let mut begun = Vec::new();
            for told in of.starts.iter().rev() {
                // The search has made the same initial states.
                machine = Machine::new(Arc::clone(of.program), of.limits.clone());
                machine.ignore_interrupts();
                if machine.start(&mut Given::new(told)).is_err() {
                    return Err(nowhere("an initial state that is not made twice in the same way"));
                }
                begun.push(machine.locations().into_iter().collect::<FxHashMap<Location, Value>>());
            }
            begun.reverse();
            // Numbers that the concrete machine rounds may be any within the error.
            let exact = of.side != CONCRETE;
            let mut encoder = Encoder::new(machine, of.bounds.clone(), exact, partial.clone());
            let made = match store.lend(&mut encoder, |encoder| encode(encoder, of, &begun, &untold)) {
                // What an invariant alone looks at may be what cannot be translated.
                Err(outside) if untold.len() < invariants.len() => {
                    let why = format!("solvers are not told of {}", outside.what);
                    invariants.iter().for_each(|index| {
                        untold.entry(*index).or_insert_with(|| why.clone());
                    });
                    continue;
                }
                made => made?,
            };
            if encoder.inexact && exact {
                return Err(nowhere("real numbers that the abstract machine computes, and rounds"));
            }
            match made {
                Ok(mut symbolic) => {
                    for (index, id) in symbolic.state.iter().enumerate() {
                        let name = format!("{}.{}", SIDES[of.side], store.terms.variable_of(*id).name);
                        debug_assert!(index < symbolic.next.len());
                        store.terms.rename(*id, name);
                    }
                    for input in &symbolic.inputs {
                        if let Some(id) = store.variable(input.variable) {
                            let name = format!("{}.{}", SIDES[of.side], store.terms.variable_of(id).name);
                            store.terms.rename(id, name);
                        }
                    }
                    symbolic.inputs.retain(|input| store.variable(input.variable).is_some());
                    return Ok(symbolic);
                }
                Err(Again::Partial(more)) => partial.extend(more),
                Err(Again::Untold(index, outside)) => {
                    untold.insert(index, format!("solvers are not told of {}", outside.what));
                }
            }
        }
    }

    /// All conditions under which it may do what is not encoded.
    pub fn stray(&self, terms: &mut Terms) -> Node {
        terms.or(self.strays.iter().map(|one| one.0))
    }

    /// Any fault.
    pub fn fault(&self, terms: &mut Terms) -> Node {
        terms.or(self.faults.iter().map(|one| one.1))
    }

    /// The state as it is.
    pub fn here(&self, terms: &mut Terms) -> Vec<Node> {
        self.state.iter().map(|id| terms.known(*id)).collect()
    }

    /// Inputs that a step's formulas look at.
    pub fn used_inputs(&self, terms: &Terms) -> Vec<Input> {
        let roots = self.next.iter().copied().chain([self.goes, self.changed, self.surely]);
        let roots = roots.chain(self.strays.iter().map(|one| one.0)).chain(self.given.iter().copied());
        let used = terms.variables_of(roots);
        let is_used = |input: &&Input| match terms.op(input.variable) {
            Op::Variable(id) => used.binary_search(id).is_ok(),
            _ => false,
        };
        self.inputs.iter().filter(is_used).cloned().collect()
    }

    /// The condition that the state is one of the initial states.
    pub fn begins(&self, terms: &mut Terms) -> Node {
        let mut any = Vec::new();
        for start in &self.starts {
            let mut all = Vec::new();
            for (id, value) in self.state.iter().zip(start) {
                let variable = terms.known(*id);
                all.push(terms.equal(variable, *value));
            }
            any.push(terms.and(all));
        }
        terms.or(any)
    }
}

/// Something outside that has no place of its own.
pub(crate) fn nowhere(what: &str) -> Outside {
    Outside { what: what.to_string(), span: syntax::Span { file: syntax::FileId(0), start: 0, end: 0 } }
}

/// Why the formulas have to be made again.
enum Again {
    /// These functions may be undef as well.
    Partial(BTreeSet<FunctionId>),
    /// The invariant of this index is not translated.
    Untold(usize, Outside),
}

/// By invariant, that it surely holds, or why that is not known.
type Invariants = Vec<(String, Result<Node, String>)>;

/// The invariants of the model, but for those that are `untold`.
fn invariants(
    encoder: &mut Encoder,
    of: &Subject<'_>,
    untold: &BTreeMap<usize, String>,
) -> Result<Invariants, (usize, Outside)> {
    let mut all = Vec::new();
    for (index, property) in of.program.properties.iter().enumerate() {
        if property.kind != PropertyKind::Invariant {
            continue;
        }
        let why = match untold.get(&index) {
            None if property.reads_monitored => Some("it looks at inputs".to_string()),
            why => why.cloned(),
        };
        if let Some(why) = why {
            all.push((property.name.clone(), Err(why)));
            continue;
        }
        let (was_inexact, inputs) = (encoder.inexact, encoder.inputs.len());
        let (value, live) = encoder.value(&property.formula, Vec::new()).map_err(|outside| (index, outside))?;
        let odd = std::mem::take(&mut encoder.beyond);
        let odd = encoder.terms.or(odd.iter().map(|one| one.0));
        // A formula over more than the state says nothing of a state.
        if (encoder.inexact && !was_inexact) || encoder.inputs.len() > inputs {
            return Err((index, nowhere("what it chooses or rounds")));
        }
        let (holds, _) = encoder.truths(&value);
        let not_odd = encoder.terms.not(odd);
        all.push((property.name.clone(), Ok(encoder.terms.and([holds, live, not_odd]))));
    }
    Ok(all)
}

/// The formulas, or why they have to be made again.
type Made = Result<Symbolic, Again>;

fn encode(
    encoder: &mut Encoder,
    of: &Subject<'_>,
    begun: &[FxHashMap<Location, Value>],
    untold: &BTreeMap<usize, String>,
) -> Result<Made, Outside> {
    encoder.step()?;
    let mut strays = std::mem::take(&mut encoder.beyond);
    let course = encoder.course();
    let is_concrete = of.side == CONCRETE;
    let (mut goes, mut counts) = (course.live, Terms::TRUE);
    let mut ill = Terms::FALSE;
    let (mut surely, mut perhaps) = (Vec::new(), Vec::new());
    let invars = of.program.properties.iter().filter(|property| property.kind == PropertyKind::Invar);
    for property in invars {
        let (value, live) = encoder.value(&property.formula, Vec::new())?;
        let odd = std::mem::take(&mut encoder.beyond);
        let odd = encoder.terms.or(odd.iter().map(|one| one.0));
        let (holds, fails) = encoder.truths(&value);
        let (not_odd, not_fails) = (encoder.terms.not(odd), encoder.terms.not(fails));
        let unclear = encoder.terms.not(live);
        let sure = encoder.terms.and([holds, live, not_odd]);
        let possible = encoder.terms.or([not_fails, unclear, odd]);
        if !property.reads_monitored {
            surely.push(sure);
            perhaps.push(possible);
            continue;
        }
        // An assumption about a step: where it cannot be evaluated, nobody knows whether the step counts.
        counts = encoder.terms.and([counts, possible]);
        ill = encoder.terms.or([ill, unclear]);
        let what = "an assumption that has no value".to_string();
        strays.push((unclear, Outside { what, span: encoder.program.term_span(property.formula.body) }));
        goes = encoder.terms.and([goes, if is_concrete { possible } else { sure }]);
    }
    for (stray, _) in strays.iter_mut() {
        *stray = encoder.terms.and([*stray, counts]);
    }
    let is_clear = encoder.terms.not(ill);
    let counts = encoder.terms.and([counts, is_clear]);
    let invariants = match invariants(encoder, of, untold) {
        Ok(invariants) => invariants,
        Err((index, outside)) => return Ok(Err(Again::Untold(index, outside))),
    };
    let classes = [FaultClass::Inconsistent, FaultClass::OutOfDomain, FaultClass::Undefined];
    let mut faults = Vec::new();
    let overflows = if of.ends_at_overflow { course.overflow } else { Terms::FALSE };
    let fits = encoder.terms.not(overflows);
    for (class, fault) in classes.into_iter().zip(course.faults) {
        let fault = encoder.terms.and([fault, fits]);
        faults.push((class_in_words(class), encoder.terms.and([fault, counts])));
    }
    let mut reads = Reads::default();
    let reads_stray = look_up(encoder, of, of.read, &mut reads)?;
    let step_reads_stray = look_up(encoder, of, of.read_in_step, &mut reads)?;
    let (mut state, mut next, mut moves) = (Vec::new(), Vec::new(), Vec::new());
    let mut starts = vec![Vec::new(); begun.len()];
    let mut more = BTreeSet::new();
    let places = encoder.places.clone();
    for (index, place) in places.iter().enumerate().filter(|(_, place)| place.kept) {
        let function = place.location.function;
        let (symbol, changed) = encoder.next(index)?;
        moves.push(changed);
        let (value, defined) = encoder.lowered(&symbol, place)?;
        let mut whole = defined == Terms::TRUE;
        let both = [place.value, place.defined].map(|node| match encoder.terms.op(node) {
            Op::Variable(id) => Some(*id),
            _ => None,
        });
        state.extend(both[0]);
        next.push(value);
        if let Some(id) = both[1] {
            state.push(id);
            next.push(defined);
        }
        for (start, values) in starts.iter_mut().zip(begun) {
            let value = values.get(&place.location).cloned().unwrap_or(Value::Undef);
            let declared = encoder.program.function(function);
            let (codomain, span) = (declared.codomain, declared.span);
            if !encoder.machine().contains(codomain, &value) {
                return Err(Outside { what: "an initial value outside of its domain".to_string(), span });
            }
            let (value, defined) = encoder.begun(value, place)?;
            whole &= defined == Terms::TRUE;
            start.push(value);
            if both[1].is_some() {
                start.push(defined);
            }
        }
        if !whole && both[1].is_none() {
            more.insert(function);
        }
    }
    if !more.is_empty() {
        return Ok(Err(Again::Partial(more)));
    }
    let typed: Vec<Node> = places.iter().filter(|place| place.kept).map(|place| place.typed).collect();
    let typed = encoder.terms.and(typed);
    surely.push(typed);
    perhaps.push(typed);
    let changed = encoder.terms.or(moves);
    Ok(Ok(Symbolic {
        state,
        next,
        starts,
        changed: encoder.terms.and([changed, goes]),
        goes,
        faults,
        strays,
        surely: encoder.terms.and(surely),
        perhaps: encoder.terms.and(perhaps),
        invariants,
        given: encoder.given.clone(),
        inputs: encoder.inputs.clone(),
        reads,
        reads_stray,
        step_reads_stray,
        places: places.into_iter().filter(|place| place.kept).collect(),
    }))
}

/// The faults of a class in words.
pub(crate) fn class_in_words(class: FaultClass) -> &'static str {
    match class {
        FaultClass::Inconsistent => "an inconsistent update",
        FaultClass::OutOfDomain => "an update outside its domain",
        FaultClass::Undefined => "a guard or an operation that is not defined",
    }
}

/// Reads locations; the condition under which that may do what is not encoded.
fn look_up(
    encoder: &mut Encoder,
    of: &Subject<'_>,
    locations: &BTreeSet<(FunctionId, Vec<Value>)>,
    reads: &mut Reads,
) -> Result<Node, Outside> {
    let mut stray = Vec::new();
    for (function, arguments) in locations {
        let known = arguments.iter().cloned().map(Symbol::Known).collect();
        let (value, live) = encoder.value(&of.readers[function], known)?;
        stray.extend(std::mem::take(&mut encoder.beyond).into_iter().map(|one| one.0));
        let fails = encoder.terms.not(live);
        reads.insert((*function, arguments.clone()), (value, fails));
    }
    Ok(encoder.terms.or(stray))
}

/// The location that an input is the value of.
pub(crate) fn input_location(input: &Input) -> Option<(FunctionId, &[Value], Shape)> {
    match &input.kind {
        InputKind::Location(function, arguments, shape) => Some((*function, arguments, *shape)),
        InputKind::Pick | InputKind::Number | InputKind::Rounding => None,
    }
}
