//! Makes one start after another along a [`Trail`].
//!
//! In: the trail of the last start, how many of its first answers stay. Out: the next start, in which only what may be otherwise was
//! evaluated anew.

use program::{Builtin, Term};

use crate::execute::{Core, Executor, Outcome};
use crate::trail::{Chosen, Moment, Place, Trail};
use crate::value::Value;

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
