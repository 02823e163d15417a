//! One of the two machines: its states, each once, and the steps of each, made when they are asked for.
//!
//! In: a program and its bounds. Out: numbers of states, and the [`Move`]s from each. A move knows which values the inputs had that
//! both machines share, so that they can be compared. INVARIANT: a state's moves are all of them, in the order of its alternatives, or
//! the state has none and [`Stopped`] says why.

mod ahead;
mod followed;
mod kept;
mod looked;
mod stepper;

use std::collections::{BTreeMap, BTreeSet};
use std::rc::Rc;
use std::sync::Arc;

use explore::{Interner, Numbered, Outcome, Start, Told, Trouble, Unbounded, Widening};
use machine::{Fault, Interrupt, Location, Value};
use program::{Expression, FunctionId, Program};
use rustc_hash::{FxHashMap, FxHashSet};

use crate::CONCRETE;
use crate::computed::Values;
use crate::coupling::Coupling;
use crate::joint::Bridge;
use crate::limited::{Limit, limited};
use crate::options::Extent;
pub(crate) use ahead::{Ahead, Ending};
use followed::Followed;
pub(crate) use followed::Unmade;
use looked::Looked;
pub(crate) use looked::{Place, ValueId};
use stepper::{Leads, Step};
pub(crate) use stepper::{Recipe, Stepper, Steps};

/// The number of a state of one machine.
pub type StateId = u32;

/// The inputs that a step read and that both machines have: numbers of locations with numbers of values, ascending.
pub(crate) type Label = Rc<[(u32, u32)]>;

/// The number of a [`Label`].
pub(crate) type LabelId = u32;

/// Numbers for the locations and values of inputs, in the joint model, and for the labels of steps.
#[derive(Debug, Default)]
pub(crate) struct Inputs {
    locations: FxHashMap<(u32, Vec<Value>), u32>,
    values: FxHashMap<Value, u32>,
    /// By number, for telling.
    pub told: Vec<(u32, Vec<Value>)>,
    pub told_values: Vec<Value>,
    labels: FxHashMap<Label, LabelId>,
    told_labels: Vec<Label>,
}

impl Inputs {
    /// The number of an input's location, if any value of it has been met.
    pub fn location(&self, input: u32, arguments: Vec<Value>) -> Option<u32> {
        self.locations.get(&(input, arguments)).copied()
    }

    /// The numbers of an input's location and value.
    pub fn number(&mut self, input: u32, arguments: Vec<Value>, value: Value) -> (u32, u32) {
        let next = self.locations.len() as u32;
        let location = *self.locations.entry((input, arguments.clone())).or_insert(next);
        if location == next {
            self.told.push((input, arguments));
        }
        let next = self.values.len() as u32;
        let number = *self.values.entry(value.clone()).or_insert(next);
        if number == next {
            self.told_values.push(value);
        }
        (location, number)
    }

    /// The number of a label with these entries.
    pub fn label(&mut self, mut entries: Vec<(u32, u32)>) -> LabelId {
        entries.sort_unstable();
        let next = self.told_labels.len() as LabelId;
        let Inputs { labels, told_labels, .. } = self;
        *labels.entry(entries.into()).or_insert_with_key(|label| {
            told_labels.push(Rc::clone(label));
            next
        })
    }

    /// How many labels there are.
    pub fn labels(&self) -> usize {
        self.told_labels.len()
    }

    /// The label of a number.
    pub fn entries(&self, label: LabelId) -> &Label {
        &self.told_labels[label as usize]
    }
}

/// Where a step leads.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub(crate) enum Goal {
    /// To a state.
    State(StateId),
    /// It cannot be made: the number of a fault.
    Fault(u32),
    /// What it comes to cannot be gone through: the number of a reason.
    Open(u32),
}

/// A step.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub(crate) struct Move {
    pub label: LabelId,
    pub goal: Goal,
}

/// Why there are no moves.
#[derive(Debug)]
pub(crate) enum Stopped {
    /// States need more room: begin again with this.
    Narrow(usize, Widening),
    /// Whoever waits has had enough.
    Interrupted,
    /// One state has more steps than may be made.
    Many,
}

/// Things of which there are few, each with a number.
#[derive(Debug)]
struct Kinds<T>(Vec<T>);

impl<T> Default for Kinds<T> {
    fn default() -> Kinds<T> {
        Kinds(Vec::new())
    }
}

impl<T: PartialEq> Kinds<T> {
    fn number(&mut self, kind: T) -> u32 {
        let known = self.0.iter().position(|other| *other == kind);
        let number = known.unwrap_or_else(|| {
            self.0.push(kind);
            self.0.len() - 1
        });
        number as u32
    }

    fn get(&self, number: u32) -> &T {
        &self.0[number as usize]
    }
}

/// One of the two machines.
pub(crate) struct Side<'c> {
    /// Which of the two it is.
    place: usize,
    coupling: &'c Coupling,
    pub program: Arc<Program>,
    pub stepper: Stepper,
    /// For more steppers.
    pub recipe: Recipe<'c>,
    /// Who makes steps besides.
    ahead: Option<Arc<Ahead>>,
    /// Looked at between states: diagrams may go through known ones for long.
    interrupt: Interrupt,
    states: Numbered,
    moves: Vec<Option<Rc<[Move]>>>,
    faults: Kinds<String>,
    opens: Kinds<Unbounded>,
    looked: Looked,
    /// Inputs of which bounds leave out values, and their locations at which the initial states or the steps of a state looked.
    pub limited: BTreeMap<FunctionId, Limit>,
    looked_at: BTreeMap<Option<StateId>, BTreeSet<Location>>,
    /// How many different steps there are, and how many change the state.
    pub steps: (u64, u64),
    /// The most steps of one state that are gone through.
    pub most: u64,
    /// If a run is followed: its steps, which are all that are made.
    followed: Option<Followed>,
}

impl<'c> Side<'c> {
    /// One of the machines of a coupling. The interner holds nothing, or what it held when the states were packed that follow.
    ///
    /// # Errors
    /// Its initial states cannot be made.
    pub fn new(
        coupling: &'c Coupling,
        place: usize,
        extent: &Extent,
        packing: (&Widening, &Arc<Interner>),
    ) -> Result<Side<'c>, Trouble> {
        let mut recipe = Recipe::new(coupling, place, extent, packing);
        let stepper = recipe.first()?;
        let program = Arc::clone(&coupling.programs[place]);
        Ok(Side {
            place,
            coupling,
            states: Numbered::new(stepper.explorer.words()),
            stepper,
            recipe,
            ahead: None,
            interrupt: extent.interrupt.clone(),
            moves: Vec::new(),
            faults: Kinds::default(),
            opens: Kinds::default(),
            looked: Looked::default(),
            limited: limited(&program, extent),
            program,
            looked_at: BTreeMap::new(),
            steps: (0, 0),
            most: u64::MAX,
            followed: None,
        })
    }

    /// From now on others make steps, too; or nobody else.
    pub fn ahead(&mut self, ahead: Option<&Arc<Ahead>>) {
        self.ahead = ahead.cloned();
    }

    /// Somebody will ask for the steps of a state.
    pub fn offer(&self, state: StateId) {
        if let Some(ahead) = self.ahead.as_ref().filter(|_| self.moves[state as usize].is_none()) {
            ahead.offer((self.place, state), self.states.get(state));
        }
    }

    /// From now on nothing is interrupted; for telling what was found.
    pub fn ignore_interrupts(&mut self) {
        self.interrupt = Interrupt::default();
        self.stepper.explorer.ignore_interrupts();
    }

    /// How many states there are.
    pub fn count(&self) -> usize {
        self.states.len()
    }

    /// Whether a state that was looked at has no step at all, since assumptions leave none.
    pub fn has_dead_end(&self) -> bool {
        self.dead_ends() > 0
    }

    /// How many such states there are.
    pub fn dead_ends(&self) -> u64 {
        self.moves.iter().flatten().filter(|moves| moves.is_empty()).count() as u64
    }

    /// Inputs of which bounds leave out values, and at which the machine looked.
    pub fn limited_and_read(&self) -> BTreeSet<FunctionId> {
        self.looked_at.values().flatten().map(|location| location.function).collect()
    }

    /// The locations of such inputs at which the steps of a state looked, or the initial states.
    pub fn limited_at(&self, at: Option<StateId>) -> impl Iterator<Item = (&Location, &Limit)> {
        let all = self.looked_at.get(&at).into_iter().flatten();
        all.map(|location| (location, &self.limited[&location.function]))
    }

    fn look_at(&mut self, at: Option<StateId>, read: &[(Location, Value)]) {
        let limited = read.iter().filter(|(location, _)| self.limited.contains_key(&location.function));
        for (location, _) in limited {
            self.looked_at.entry(at).or_default().insert(location.clone());
        }
    }

    /// The packed state of a number.
    pub fn packed(&self, state: StateId) -> Box<[u64]> {
        self.states.get(state).into()
    }

    /// A fault that some step leads to.
    pub fn fault(&self, fault: u32) -> &String {
        self.faults.get(fault)
    }

    /// Why some step cannot be gone through.
    pub fn unbounded(&self, open: u32) -> Unbounded {
        *self.opens.get(open)
    }

    fn number(&mut self, state: &[u64]) -> StateId {
        let (number, is_new) = self.states.number(state);
        if is_new {
            self.moves.push(None);
            // Of the abstract machine's states only those are asked for that correspond to something.
            if self.place == CONCRETE {
                self.offer(number);
            }
        }
        number
    }

    /// The initial states, each with the inputs that it read.
    pub fn initial(&mut self, inputs: &mut Inputs, bridge: &Bridge) -> Vec<(LabelId, StateId, Start)> {
        let starts: Vec<(Box<[u64]>, Start)> =
            self.stepper.explorer.initial().iter().map(|(state, start)| (state.into(), start)).collect();
        // With other values there may be states that the assumptions admit: those that were left out count, too.
        if !self.limited.is_empty() {
            let asked = self.stepper.explorer.asked_by_starts().to_vec();
            self.look_at(None, &asked);
        }
        let mut found = Vec::new();
        let mut seen = FxHashSet::default();
        for (state, start) in starts {
            let told = match self.shared().is_empty() {
                true => Told::default(),
                false => self.stepper.explorer.told_of_start(start),
            };
            if !self.stepper.is_assumed(&state) {
                continue;
            }
            let label = self.entries(&told.inputs, inputs, bridge);
            let label = inputs.label(label);
            let state = self.number(&state);
            if seen.insert((label, state)) {
                found.push((label, state, start));
            }
        }
        found
    }

    /// By input of this machine: the inputs of the abstract machine that have its value.
    fn shared(&self) -> &'c FxHashMap<FunctionId, Vec<u32>> {
        &self.coupling.shared[self.place]
    }

    /// What both machines have of the inputs that a step read, the inputs that are terms over it, and those that the state determines.
    fn label(
        &self,
        read: &[(Location, Value)],
        values: Values,
        given: &[(u32, u32)],
        inputs: &mut Inputs,
        bridge: &Bridge,
    ) -> LabelId {
        let mut entries = self.entries(read, inputs, bridge);
        // What cannot be evaluated is a value that no abstract step reads.
        let computed = values.into_iter().map(|(input, value)| (input, value.unwrap_or_else(Value::string)));
        entries.extend(computed.map(|(input, value)| inputs.number(input, Vec::new(), value)));
        entries.extend(given);
        inputs.label(entries)
    }

    fn entries(&self, read: &[(Location, Value)], inputs: &mut Inputs, bridge: &Bridge) -> Vec<(u32, u32)> {
        let mut entries = Vec::new();
        for (location, value) in read {
            let Some(named) = self.shared().get(&location.function) else { continue };
            let arguments: Option<Vec<Value>> = location.arguments.iter().map(|value| bridge.over(value)).collect();
            // What has no name in the joint model is a value that the other machine never has.
            let Some((arguments, value)) = arguments.zip(bridge.over(value)) else { continue };
            entries.extend(named.iter().map(|input| inputs.number(*input, arguments.clone(), value.clone())));
        }
        entries
    }

    /// The steps of a state, if they have been made.
    pub fn known(&self, state: StateId) -> Result<Option<Rc<[Move]>>, Stopped> {
        if self.interrupt.is_raised() {
            return Err(Stopped::Interrupted);
        }
        Ok(self.made(state))
    }

    /// The steps of a state; `given` are the inputs of the abstract machine that this state determines.
    pub fn moves(
        &mut self,
        state: StateId,
        given: &[(u32, u32)],
        inputs: &mut Inputs,
        bridge: &Bridge,
    ) -> Result<Rc<[Move]>, Stopped> {
        if let Some(known) = self.known(state)? {
            return Ok(known);
        }
        if self.followed.is_some() {
            let goal = Goal::Open(self.opens.number(Followed::NOTHING));
            return Ok(Rc::from([Move { label: inputs.label(Vec::new()), goal }]));
        }
        let ahead = self.ahead.as_ref().and_then(|ahead| ahead.take((self.place, state), &self.interrupt));
        let steps = match ahead {
            Some(made) => made?,
            None => self.stepper.steps(self.states.get(state), self.most, bridge)?,
        };
        let moves: Rc<[Move]> = self.numbered(state, steps, given, inputs, bridge).into();
        self.steps.0 += moves.len() as u64;
        self.steps.1 += moves.iter().filter(|made| made.goal != Goal::State(state)).count() as u64;
        self.moves[state as usize] = Some(Rc::clone(&moves));
        Ok(moves)
    }

    /// Steps with numbers, each once.
    fn numbered(
        &mut self,
        state: StateId,
        steps: Steps,
        given: &[(u32, u32)],
        inputs: &mut Inputs,
        bridge: &Bridge,
    ) -> Vec<Move> {
        let steps = match steps {
            Steps::Plain(next) => {
                let label = inputs.label(given.to_vec());
                let words = self.stepper.explorer.words().max(1);
                let made = |next: &[u64]| Move { label, goal: Goal::State(self.number(next)) };
                return next.chunks_exact(words).map(made).collect();
            }
            Steps::Labelled(steps) => steps,
        };
        let mut moves = Vec::with_capacity(steps.len());
        let mut seen = FxHashSet::default();
        for Step { read, values, leads } in steps {
            self.look_at(Some(state), &read);
            let goal = match leads {
                Leads::State(next) => Goal::State(self.number(&next)),
                Leads::Fault(fault) => Goal::Fault(self.faults.number(fault)),
                Leads::Open(unbounded) => Goal::Open(self.opens.number(unbounded)),
                Leads::Nowhere => continue,
            };
            let made = Move { label: self.label(&read, values, given, inputs, bridge), goal };
            if seen.insert(made) {
                moves.push(made);
            }
        }
        moves
    }

    /// The number of a function with arguments.
    pub fn place(&mut self, function: FunctionId, arguments: Vec<Value>) -> Place {
        self.looked.place(function, arguments)
    }

    /// The number of what a function is in a state.
    #[inline]
    pub fn value_at(&mut self, state: StateId, place: Place) -> ValueId {
        match self.looked.get(place, state) {
            Some(known) => known,
            None => self.look(state, place),
        }
    }

    fn look(&mut self, state: StateId, place: Place) -> ValueId {
        let Side { stepper, coupling, states, looked, .. } = self;
        let (function, arguments) = looked.told(place);
        let reader = &coupling.readers[self.place][function];
        let value = stepper.explorer.evaluate_with(reader, arguments, states.get(state));
        let value = value.map_err(|fault| stepper.told(&fault));
        looked.note(place, state, states.len(), value)
    }

    /// What a number stands for: a value, or why there is none.
    pub fn value(&self, number: ValueId) -> &Result<Value, String> {
        self.looked.value(number)
    }

    /// The value of a term of this machine in a state.
    ///
    /// # Errors
    /// What evaluation meets.
    pub fn evaluate(&mut self, formula: &Expression, state: StateId) -> Result<Value, Fault> {
        self.stepper.explorer.evaluate(formula, self.states.get(state))
    }

    /// The same, whoever wants to stop.
    pub fn made(&self, state: StateId) -> Option<Rc<[Move]>> {
        match &self.followed {
            Some(followed) => followed.moves(state),
            None => self.moves[state as usize].clone(),
        }
    }

    /// The locations of a function that have a value in a state, in canonical order.
    pub fn located(&mut self, state: StateId, function: FunctionId) -> Vec<(Vec<Value>, Value)> {
        let values = self.stepper.explorer.values(self.states.get(state));
        let of = values.into_iter().filter(|(location, _)| location.function == function);
        of.map(|(location, value)| (location.arguments, value)).collect()
    }

    /// All there is to say of a step from one state to another with this label; none if there is no such step.
    pub fn told(
        &mut self,
        from: StateId,
        wanted: &Move,
        given: &[(u32, u32)],
        inputs: &mut Inputs,
        bridge: &Bridge,
    ) -> Option<Told> {
        if let Some(followed) = &self.followed {
            return followed.told(from, wanted);
        }
        let packed = self.packed(from);
        let (paths, _) = self.stepper.paths(&packed, u64::MAX, bridge);
        let (path, _) = paths.into_iter().find(|(path, values)| {
            let leads = match (&path.outcome, &wanted.goal) {
                (Outcome::Next(next), Goal::State(to)) => **next == *self.states.get(*to),
                (Outcome::Fault(fault), Goal::Fault(number)) => {
                    fault.show(&self.program).to_string() == *self.fault(*number)
                }
                _ => false,
            };
            leads && self.label(&path.inputs, values.clone(), given, inputs, bridge) == wanted.label
        })?;
        Some(self.stepper.tell(&packed, &path.picks, bridge))
    }
}
