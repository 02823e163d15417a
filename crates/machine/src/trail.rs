//! How one initial state follows another: the trail of what was set, so that a start evaluates anew only what its answers change.
//!
//! In: a start that is made again and again, each time with other answers from some question on. Out: the state, the inputs and the
//! questions of a start from the blank state with the same answers. A *place* is a location whose initial value depends on answers; places
//! have the order in which starts come to them. What a start has set after the place of the first question that is answered otherwise is
//! taken back, unless it depends only on answers before. INVARIANT: what stays has the value that it would get again. Where that is not so
//! simple (elements of domains are asked for, locations get numbers, the initial state is kept for later) every start is made from the blank
//! state. LIMIT: what two starts have in common counts as work of the first alone. [`crate::again`] makes the starts.

use program::{FunctionId, Program};

use crate::layout::LocationIndex;
use crate::value::Value;

/// See the module.
#[derive(Debug)]
pub(crate) struct Trail {
    /// By function: the functions with initial values that ask, which its own depend on; itself among them if these ask.
    pub asking: Vec<Vec<FunctionId>>,
    /// By function: the last place of all those; none where there is no such function.
    pub last: Vec<Option<usize>>,
    pub places: Vec<Place>,
    /// The locations that depend on answers and have got their initial values, in order.
    pub set: Vec<(LocationIndex, FunctionId)>,
    /// By question: the place at which it is asked.
    pub questions: Vec<usize>,
    /// Whether the next start can go on from this one.
    pub goes_on: bool,
    /// Whether this one went on from the one before; then these locations may have changed, and these inputs have not.
    pub went_on: bool,
    pub changed: Vec<LocationIndex>,
    pub same_inputs: usize,
}

/// A location whose initial value depends on answers, and what there was when the start came to it.
#[derive(Debug)]
pub(crate) struct Place {
    /// By its number in the program.
    pub initial: usize,
    pub function: FunctionId,
    pub arguments: Box<[Value]>,
    pub location: LocationIndex,
    pub before: Moment,
    pub choice: Option<Chosen>,
}

/// How far a start has come.
#[derive(Debug, Clone, Copy, Default)]
pub(crate) struct Moment {
    pub set: usize,
    pub inputs: usize,
    pub asked: usize,
}

/// An initial value that is chosen, and asks for nothing after that.
#[derive(Debug)]
pub(crate) struct Chosen {
    pub from: Value,
    /// When it was set; its question is the last one before.
    pub after: Moment,
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
    pub fn close(&mut self) {
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
    pub fn depends_on(&self, function: FunctionId, place: usize) -> bool {
        self.last[function.0 as usize].is_some_and(|last| last >= place)
    }
}
