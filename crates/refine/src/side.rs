//! One of the two machines: its states, each once, and the steps of each, made when they are asked for.
//!
//! In: a program and its bounds. Out: numbers of states, and the [`Move`]s from each. A move knows which values the inputs had that
//! both machines share, so that they can be compared. INVARIANT: a state's moves are all of them, in the order of its alternatives, or
//! the state has none and [`Stopped`] says why.

mod followed;
mod looked;

use std::collections::{BTreeMap, BTreeSet};
use std::ops::ControlFlow;
use std::rc::Rc;
use std::sync::Arc;

use explore::{
    Explorer, Interner, Numbered, Outcome, Path, Reading, Settings, Start, Told, Trouble, Truth, Unbounded, Visitor,
    Widening, input_values,
};
use machine::{Fault, FaultKind, Interrupt, Location, Value};
use program::{Expression, FunctionId, Program, PropertyKind};
use rustc_hash::{FxHashMap, FxHashSet};

use crate::CONCRETE;
use crate::computed::{Computed, Values};
use crate::joint::Bridge;
use crate::limited::{Limit, limited};
use crate::options::Extent;
use followed::Followed;
pub(crate) use followed::Unmade;
use looked::Looked;
pub(crate) use looked::{Place, ValueId};

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
pub(crate) struct Side {
    /// Which of the two it is.
    place: usize,
    pub program: Arc<Program>,
    pub explorer: Explorer,
    /// Looked at between states: diagrams may go through known ones for long.
    interrupt: Interrupt,
    /// By input of the program: the inputs of the abstract machine that have its value.
    pub shared: FxHashMap<FunctionId, Vec<u32>>,
    /// Inputs of the abstract machine that are terms over this machine's steps.
    computed: Option<Computed>,
    /// Conditions that states which count satisfy.
    assumed: usize,
    states: Numbered,
    moves: Vec<Option<Rc<[Move]>>>,
    faults: Kinds<String>,
    opens: Kinds<Unbounded>,
    looked: Looked,
    /// By function, the term that reads it.
    readers: FxHashMap<FunctionId, Expression>,
    /// Inputs of which bounds leave out values, and their locations at which the initial states or the steps of a state looked.
    pub limited: BTreeMap<FunctionId, Limit>,
    looked_at: BTreeMap<Option<StateId>, BTreeSet<Location>>,
    /// How many different steps there are, and how many change the state.
    pub steps: (u64, u64),
    /// The most steps of one state that are gone through.
    pub most: u64,
    /// A number beyond 64 bits ends a run, and is no fault.
    pub ends_at_overflow: bool,
    /// If a run is followed: its steps, which are all that are made.
    followed: Option<Followed>,
}

impl Side {
    /// A machine whose program has `readers` for the functions that a coupling reads.
    pub fn new(
        place: usize,
        program: &Arc<Program>,
        extent: &Extent,
        widening: &Widening,
        readers: FxHashMap<FunctionId, Expression>,
        computed: Option<Computed>,
    ) -> Result<Side, Trouble> {
        let bounds = input_values(program, &extent.bounds, &extent.undefined);
        let mut settings = Settings { limits: extent.limits.clone(), bounds: Arc::new(bounds), ..Settings::default() };
        settings.interrupt = extent.interrupt.clone();
        for property in program.properties.iter().filter(|property| property.kind == PropertyKind::Invar) {
            match property.reads_monitored {
                true => settings.step_conditions.push((property.formula.clone(), true)),
                false => settings.conditions.push(property.formula.clone()),
            }
        }
        let assumed = settings.conditions.len();
        settings.read_in_steps = computed.as_ref().map(Computed::readers).unwrap_or_default();
        let explorer = Explorer::new(program, settings, widening, &Arc::<Interner>::default())?;
        let words = explorer.words();
        Ok(Side {
            place,
            program: Arc::clone(program),
            explorer,
            interrupt: extent.interrupt.clone(),
            shared: FxHashMap::default(),
            computed,
            assumed,
            states: Numbered::new(words),
            moves: Vec::new(),
            faults: Kinds::default(),
            opens: Kinds::default(),
            looked: Looked::default(),
            readers,
            limited: limited(program, extent),
            looked_at: BTreeMap::new(),
            steps: (0, 0),
            most: u64::MAX,
            ends_at_overflow: false,
            followed: None,
        })
    }

    /// From now on nothing is interrupted; for telling what was found.
    pub fn ignore_interrupts(&mut self) {
        self.interrupt = Interrupt::default();
        self.explorer.ignore_interrupts();
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
        }
        number
    }

    /// Whether the assumptions hold in a state. One that cannot be evaluated counts against a refinement: such a state of the concrete machine
    /// has to be answered, and one of the abstract machine is no answer.
    fn is_assumed(&mut self, state: &[u64]) -> bool {
        (0..self.assumed).all(|condition| match self.explorer.truth(condition, state) {
            Truth::True => true,
            Truth::False | Truth::Undef => false,
            Truth::Fault | Truth::Unknown => self.place == CONCRETE,
        })
    }

    /// The initial states, each with the inputs that it read.
    pub fn initial(&mut self, inputs: &mut Inputs, bridge: &Bridge) -> Vec<(LabelId, StateId, Start)> {
        let starts: Vec<(Box<[u64]>, Start)> =
            self.explorer.initial().iter().map(|(state, start)| (state.into(), start)).collect();
        // With other values there may be states that the assumptions admit: those that were left out count, too.
        if !self.limited.is_empty() {
            let asked = self.explorer.asked_by_starts().to_vec();
            self.look_at(None, &asked);
        }
        let mut found = Vec::new();
        let mut seen = FxHashSet::default();
        for (state, start) in starts {
            let told = match self.shared.is_empty() {
                true => Told::default(),
                false => self.explorer.told_of_start(start),
            };
            if !self.is_assumed(&state) {
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
            let Some(named) = self.shared.get(&location.function) else { continue };
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
        Ok(match &self.followed {
            Some(followed) => followed.moves(state),
            None => self.moves[state as usize].clone(),
        })
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
        let moves = match self.unlabelled(state, given, inputs)? {
            Some(moves) => moves,
            None => self.labelled(state, given, inputs, bridge)?,
        };
        self.steps.0 += moves.len() as u64;
        self.steps.1 += moves.iter().filter(|made| made.goal != Goal::State(state)).count() as u64;
        let moves: Rc<[Move]> = moves.into();
        self.moves[state as usize] = Some(Rc::clone(&moves));
        Ok(moves)
    }

    /// The steps of a state, as a search makes them: remembered or compiled. None if somebody has to know more of a step than where it leads.
    fn unlabelled(
        &mut self,
        state: StateId,
        given: &[(u32, u32)],
        inputs: &mut Inputs,
    ) -> Result<Option<Vec<Move>>, Stopped> {
        let reads = !self.shared.is_empty() || self.computed.is_some() || !self.limited.is_empty();
        if reads || self.most < u64::MAX {
            return Ok(None);
        }
        let (packed, mut successors) = (self.packed(state), Vec::new());
        let expansion = match self.explorer.expand(&packed, &mut successors) {
            Err(widening) => return Err(Stopped::Narrow(self.place, widening)),
            Ok(expansion) if expansion.interrupted => return Err(Stopped::Interrupted),
            Ok(expansion) => expansion,
        };
        if expansion.faults != [0; 3] || expansion.unbounded > 0 {
            return Ok(None);
        }
        let label = inputs.label(given.to_vec());
        let mut moves = Vec::new();
        let mut seen = FxHashSet::default();
        let stays = (expansion.stayed > 0).then_some(&*packed);
        for next in successors.chunks_exact(packed.len().max(1)).chain(stays) {
            if seen.insert(next) && self.is_assumed(next) {
                moves.push(Move { label, goal: Goal::State(self.number(next)) });
            }
        }
        Ok(Some(moves))
    }

    /// The same, with the inputs of each step, by the machine.
    fn labelled(
        &mut self,
        state: StateId,
        given: &[(u32, u32)],
        inputs: &mut Inputs,
        bridge: &Bridge,
    ) -> Result<Vec<Move>, Stopped> {
        let packed = self.packed(state);
        let most = self.most;
        let mut paths =
            Paths { computed: self.computed.as_mut(), bridge, most, values: Values::new(), found: Vec::new() };
        let whole = self.explorer.paths_read(&packed, &mut paths);
        let paths = paths.found;
        match whole {
            Ok(true) if paths.len() as u64 > most => return Err(Stopped::Many),
            Err(widening) => return Err(Stopped::Narrow(self.place, widening)),
            Ok(false) => return Err(Stopped::Interrupted),
            Ok(true) => {}
        }
        let mut moves = Vec::new();
        let mut seen = FxHashSet::default();
        for (Path { inputs: read, outcome, .. }, values) in paths {
            self.look_at(Some(state), &read);
            let label = self.label(&read, values, given, inputs, bridge);
            let goal = match outcome {
                Outcome::Next(next) => {
                    if !self.is_assumed(&next) {
                        continue;
                    }
                    Goal::State(self.number(&next))
                }
                Outcome::Fault(fault) if matches!(fault.kind, FaultKind::Interrupted(_)) => {
                    return Err(Stopped::Interrupted);
                }
                Outcome::Fault(fault) if self.is_end(&fault) => continue,
                Outcome::Fault(fault) => Goal::Fault(self.faults.number(fault.show(&self.program).to_string())),
                Outcome::Unbounded(unbounded) => Goal::Open(self.opens.number(unbounded)),
                Outcome::Excluded => continue,
            };
            let made = Move { label, goal };
            if seen.insert(made) {
                moves.push(made);
            }
        }
        Ok(moves)
    }

    /// Whether a fault only says that runs are looked at no further.
    fn is_end(&self, fault: &Fault) -> bool {
        self.ends_at_overflow && matches!(fault.kind, FaultKind::Overflow { .. })
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
        let Side { explorer, readers, states, looked, program, .. } = self;
        let (function, arguments) = looked.told(place);
        let value = explorer.evaluate_with(&readers[function], arguments, states.get(state));
        let value = value.map_err(|fault| fault.show(program).to_string());
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
        self.explorer.evaluate(formula, self.states.get(state))
    }

    /// The steps of a state, if it was looked at.
    pub fn made(&self, state: StateId) -> Option<&[Move]> {
        self.moves[state as usize].as_deref()
    }

    /// The locations of a function that have a value in a state, in canonical order.
    pub fn located(&mut self, state: StateId, function: FunctionId) -> Vec<(Vec<Value>, Value)> {
        let values = self.explorer.values(self.states.get(state));
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
        let (most, computed) = (u64::MAX, self.computed.as_mut());
        let mut paths = Paths { computed, bridge, most, values: Values::new(), found: Vec::new() };
        let _ = self.explorer.paths_read(&packed, &mut paths);
        let paths = paths.found;
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
        let Side { explorer, computed, .. } = self;
        let mut read = |step: &mut Reading<'_>| match computed {
            Some(computed) => computed.values(step, bridge).map(|_| ()),
            None => Ok(()),
        };
        Some(explorer.tell_read(&packed, &path.picks, &mut read))
    }
}

/// The alternatives of a state, each with the inputs that are terms over it.
struct Paths<'p> {
    computed: Option<&'p mut Computed>,
    bridge: &'p Bridge,
    /// So many are enough.
    most: u64,
    /// Those of the alternative that is looked at.
    values: Values,
    found: Vec<(Path, Values)>,
}

impl Visitor for Paths<'_> {
    fn read(&mut self, step: &mut Reading<'_>) -> Result<(), Fault> {
        if let Some(computed) = &mut self.computed {
            self.values = computed.values(step, self.bridge)?;
        }
        Ok(())
    }

    fn visit(&mut self, path: Path) -> ControlFlow<()> {
        self.found.push((path, std::mem::take(&mut self.values)));
        if self.found.len() as u64 > self.most { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
    }
}
