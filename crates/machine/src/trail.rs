//! How one initial state follows another: the trail of what was set, so that a start evaluates anew only what its answers change.
//!
//! In: a start that is made again and again, each time with other answers from some question on. Out: the state, the inputs and the
//! questions of a start from the blank state with the same answers. A *place* is a location whose initial value depends on answers; places
//! have the order in which starts come to them. What a start has set after the place of the first question that is answered otherwise is
//! taken back, unless it depends only on answers before. INVARIANT: what stays has the value that it would get again. Where that is not so
//! simple (elements of domains are asked for, locations get numbers, the initial state is kept for later) every start is made from the blank
//! state. LIMIT: what two starts have in common counts as work of the first alone.

use program::{Builtin, FunctionId, Program, Term};

use crate::execute::{Core, Executor, Outcome};
use crate::layout::LocationIndex;
use crate::value::Value;

/// See the module.
#[derive(Debug)]
pub(crate) struct Trail {
    /// By function: the functions with initial values that ask, which its own depend on; itself among them if these ask.
    asking: Vec<Vec<FunctionId>>,
    /// By function: the last place of all those; none where there is no such function.
    last: Vec<Option<usize>>,
    places: Vec<Place>,
    /// The locations that depend on answers and have got their initial values, in order.
    set: Vec<(LocationIndex, FunctionId)>,
    /// By question: the place at which it is asked.
    questions: Vec<usize>,
    /// Whether the next start can go on from this one.
    goes_on: bool,
    /// Whether this one went on from the one before; then these locations may have changed, and these inputs have not.
    went_on: bool,
    changed: Vec<LocationIndex>,
    same_inputs: usize,
}

/// A location whose initial value depends on answers, and what there was when the start came to it.
#[derive(Debug)]
struct Place {
    /// By its number in the program.
    initial: usize,
    function: FunctionId,
    arguments: Box<[Value]>,
    location: LocationIndex,
    before: Moment,
    choice: Option<Chosen>,
}

/// How far a start has come.
#[derive(Debug, Clone, Copy, Default)]
struct Moment {
    set: usize,
    inputs: usize,
    asked: usize,
}

/// An initial value that is chosen, and asks for nothing after that.
#[derive(Debug)]
struct Chosen {
    from: Value,
    /// When it was set; its question is the last one before.
    after: Moment,
}

impl Trail {
    /// Nothing is set yet.
    pub fn new(program: &Program) -> Trail {
        let count = program.functions.len();
        let (mut reads, mut asks) = (vec![Vec::new(); count], vec![false; count]);
        for initial in &program.initials {
            let (read, more) = program.all_reads(&initial.value);
            reads[initial.function.0 as usize].extend(read);
            asks[initial.function.0 as usize] |= more;
        }
        let mut asking = vec![Vec::new(); count];
        for initial in &program.initials {
            let mut reached = vec![false; count];
            let mut open = vec![initial.function];
            while let Some(function) = open.pop() {
                if std::mem::replace(&mut reached[function.0 as usize], true) {
                    continue;
                }
                open.extend(&reads[function.0 as usize]);
                if asks[function.0 as usize] {
                    asking[initial.function.0 as usize].push(function);
                }
            }
        }
        Trail {
            asking,
            last: vec![None; count],
            places: Vec::new(),
            set: Vec::new(),
            questions: Vec::new(),
            goes_on: true,
            went_on: false,
            changed: Vec::new(),
            same_inputs: 0,
        }
    }

    /// Whether the initial values of a function depend on answers.
    pub fn depends(&self, function: FunctionId) -> bool {
        !self.asking[function.0 as usize].is_empty()
    }

    /// Whether the next start can go on from the one that was made.
    pub fn goes_on(&self) -> bool {
        self.goes_on
    }

    /// The locations that may have other values than after the start before, if the last one went on from it; and how many of
    /// its inputs, the first, are the same.
    pub fn changed(&self) -> Option<(&[LocationIndex], usize)> {
        (self.goes_on && self.went_on).then_some((&self.changed, self.same_inputs))
    }

    /// A location has got its initial value.
    pub fn note(&mut self, location: LocationIndex, function: FunctionId) {
        if self.depends(function) {
            self.set.push((location, function));
        }
    }

    /// What depends on what is asked at each place, now that all are known.
    fn close(&mut self) {
        let mut own = vec![None; self.last.len()];
        for (number, place) in self.places.iter().enumerate() {
            own[place.function.0 as usize] = Some(number);
        }
        for (last, asking) in self.last.iter_mut().zip(&self.asking) {
            // One without a place is asked for at the place of another.
            *last = asking.iter().map(|function| own[function.0 as usize].unwrap_or(usize::MAX)).max();
        }
    }

    /// Whether the initial values of a function may depend on what is asked from this place on.
    fn depends_on(&self, function: FunctionId, place: usize) -> bool {
        self.last[function.0 as usize].is_some_and(|last| last >= place)
    }
}

impl Core {
    /// Takes back what was set and asked for after a moment, as far as it may depend on what is asked from this place on. Gives how many
    /// locations stay.
    fn take_back(&mut self, place: usize, moment: Moment) -> usize {
        let Core { store, inputs, trail: Some(trail), .. } = self else { return 0 };
        let mut stay = moment.set;
        for at in moment.set..trail.set.len() {
            let (location, function) = trail.set[at];
            if trail.depends_on(function, place) {
                store.clear(location);
                trail.changed.push(location);
            } else {
                trail.set[stay] = (location, function);
                stay += 1;
            }
        }
        trail.set.truncate(stay);
        for (location, _) in inputs.drain(moment.inputs..) {
            store.clear(location);
            trail.changed.push(location);
        }
        trail.questions.truncate(moment.asked);
        trail.same_inputs = moment.inputs;
        stay
    }
}

impl Executor<'_> {
    /// Comes to one more place, in a start from the blank state.
    pub fn add_place(&mut self, initial: usize, arguments: Vec<Value>) -> Outcome<()> {
        let function = self.program.initials[initial].function;
        let location = self.core.store.number(function, &arguments);
        let arguments = arguments.into();
        let Some(trail) = &mut self.core.trail else { return Ok(()) };
        let before = Moment::default();
        trail.places.push(Place { initial, function, arguments, location, before, choice: None });
        self.visit(self.core.trail.as_ref().map_or(0, |trail| trail.places.len() - 1))
    }

    /// A start from the blank state was made: says whether the next one can go on from it.
    pub fn end_trail(&mut self, sparse: usize) {
        if self.core.trail.is_none() {
            return;
        }
        let asked = self.asked();
        let Core { store, origin, trail: Some(trail), .. } = &mut *self.core else { return };
        trail.close();
        trail.goes_on &= origin.is_none() && store.sparse_len() == sparse && trail.questions.len() == asked;
    }

    /// Makes the next start, whose first answers, so many, are those of the last one.
    pub fn start_again(&mut self, kept: usize) -> Outcome<()> {
        let sparse = self.core.store.sparse_len();
        let Some(trail) = &mut self.core.trail else { return Ok(()) };
        trail.changed.clear();
        let number = trail.questions[kept];
        let place = &mut trail.places[number];
        let again = place.choice.take().filter(|choice| choice.after.asked == kept + 1);
        let moment = match &again {
            Some(choice) => Moment { asked: kept, ..choice.after },
            None => place.before,
        };
        let stay = self.core.take_back(number, moment);
        if let Some(alternatives) = self.environment.alternatives() {
            alternatives.ask_from(moment.asked);
        }
        self.core.memo.changed();
        match again {
            Some(Chosen { from, after }) => {
                self.choose_again(number, Chosen { from, after: Moment { set: stay, ..after } })?
            }
            None => self.visit(number)?,
        }
        for next in number + 1..self.core.trail.as_ref().map_or(0, |trail| trail.places.len()) {
            if self.core.trail.as_ref().is_some_and(|trail| trail.depends_on(trail.places[next].function, number)) {
                self.visit(next)?;
            }
        }
        self.core.memo.changed();
        let grown = self.core.store.sparse_len() != sparse;
        let Core { inputs, trail: Some(trail), .. } = &mut *self.core else { return Ok(()) };
        let Trail { set, changed, same_inputs, .. } = &mut **trail;
        changed.extend(set[stay..].iter().map(|(location, _)| location));
        changed.extend(inputs[*same_inputs..].iter().map(|(location, _)| location));
        changed.sort_unstable();
        changed.dedup();
        trail.went_on = true;
        trail.goes_on = !grown;
        Ok(())
    }

    /// How many questions of this start have been asked.
    fn asked(&mut self) -> usize {
        self.environment.alternatives().map_or(0, |alternatives| alternatives.asked())
    }

    /// Comes to a place: evaluates its initial value, unless another one has read it.
    fn visit(&mut self, number: usize) -> Outcome<()> {
        let program = self.program;
        let asked = self.asked();
        let Core { store, inputs, frames, trail: Some(trail), .. } = &mut *self.core else { return Ok(()) };
        trail.goes_on &= trail.questions.len() == asked;
        let before = Moment { set: trail.set.len(), inputs: inputs.len(), asked };
        let place = &mut trail.places[number];
        (place.before, place.choice) = (before, None);
        let (location, function) = (place.location, place.function);
        if store.given[location as usize] != 0 || !store.values[location as usize].is_undef() {
            return Ok(());
        }
        let initial = &program.initials[place.initial];
        let start = frames.len();
        frames.extend(place.arguments.iter().cloned());
        let body = initial.value.body;
        let set = match program.term(body) {
            Term::Builtin { builtin: Builtin::ChooseOne, arguments } => program.term_list(*arguments).first(),
            _ => None,
        };
        let mut from = None;
        let value = self.in_frame(start, initial.value.frame, initial.span, |this| {
            let Some(set) = set else { return this.evaluate(body) };
            let set = from.insert(this.evaluate(*set)?);
            this.apply(Builtin::ChooseOne, std::slice::from_ref(set), body)
        })?;
        self.set_initial(location, function, value);
        let after = Moment { asked: self.asked(), ..before };
        let Core { inputs, trail: Some(trail), .. } = &mut *self.core else { return Ok(()) };
        trail.questions.resize(after.asked, number);
        let after = Moment { set: trail.set.len(), inputs: inputs.len(), ..after };
        // Of an empty set nothing is chosen.
        let chosen = from.filter(|set| matches!(set, Value::Set(elements) if !elements.is_empty()));
        trail.places[number].choice = chosen.map(|from| Chosen { from, after });
        Ok(())
    }

    /// Chooses another initial value at a place.
    fn choose_again(&mut self, number: usize, chosen: Chosen) -> Outcome<()> {
        let Some(trail) = &self.core.trail else { return Ok(()) };
        let (place, location) = (trail.places[number].initial, trail.places[number].location);
        let body = self.program.initials[place].value.body;
        let value = self.apply(Builtin::ChooseOne, std::slice::from_ref(&chosen.from), body)?;
        self.core.store.values[location as usize] = value;
        if let Some(trail) = &mut self.core.trail {
            trail.questions.push(number);
            trail.changed.push(location);
            trail.places[number].choice = Some(chosen);
        }
        Ok(())
    }
}
