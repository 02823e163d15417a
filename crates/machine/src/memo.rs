//! Values of derived and static functions, kept while the state stays the same.
//!
//! A definition has one value in a state, unless it reads `self` or something that a second evaluation could answer
//! differently (a choice, `pre`). The value is kept in an array like a dense function's locations, with the *version* of
//! the state in which it was evaluated. INVARIANT: two moments with the same version have the same (intermediate) state;
//! the end of a `seq` restores the version with which it began. Values of static functions that depend only on static
//! functions are kept forever.

use program::{DomainId, DomainKind, Effect, FunctionId, FunctionKind, Program, Term, TermId};

use crate::layout::{Dimension, Extents, dimensions_of};
use crate::value::Value;

/// LIMIT: definitions of fewer terms are evaluated each time.
const WORTH_KEEPING: u32 = 5;

/// The version of values that are kept forever.
const ALWAYS: u64 = 0;

/// A version of the state.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) struct Version(u64);

/// Where the values of one function are kept.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Shelf {
    pub base: u32,
    pub dimensions: Box<[Dimension]>,
    pub for_good: bool,
}

/// The values kept.
#[derive(Debug)]
pub(crate) struct Memo {
    shelves: Vec<Option<Shelf>>,
    values: Vec<Value>,
    /// By value: 1 + the version it holds in; 0 where there is none.
    versions: Vec<u64>,
    current: u64,
    last: u64,
}

impl Memo {
    /// Keeps nothing until it is laid out.
    pub fn new(program: &Program) -> Memo {
        let shelves = vec![None; program.functions.len()];
        Memo { shelves, values: Vec::new(), versions: Vec::new(), current: 1, last: 1 }
    }

    /// Decides which functions' values are kept.
    pub fn lay_out(&mut self, program: &Program, contents: &dyn Fn(DomainId) -> Option<Vec<Value>>) {
        let repeatable = closed_under(program, &|term| is_repeatable(program, term));
        let fixed = fixed_functions(program);
        let extents = Extents::new(program, contents);
        let mut next = 0u32;
        for (index, function) in program.functions.iter().enumerate() {
            let Some(definition) = &function.definition else { continue };
            if !repeatable[index] || size(program, definition.body, WORTH_KEEPING) < WORTH_KEEPING {
                continue;
            }
            let Some((dimensions, len)) = dimensions_of(&extents, &function.parameters) else { continue };
            self.shelves[index] = Some(Shelf { base: next, dimensions, for_good: fixed[index] });
            next += len;
        }
        self.values = vec![Value::Undef; next as usize];
        self.versions = vec![0; next as usize];
    }

    /// Where the value of a function at arguments is kept, and the mark of a value that holds now.
    #[inline]
    pub fn place(&self, function: FunctionId, arguments: &[Value]) -> Option<(u32, u64)> {
        let shelf = self.shelves[function.0 as usize].as_ref()?;
        let mut offset = 0;
        for (dimension, argument) in shelf.dimensions.iter().zip(arguments) {
            offset = offset * dimension.size + dimension.index(argument)?;
        }
        Some((shelf.base + offset, 1 + if shelf.for_good { ALWAYS } else { self.current }))
    }

    /// The value kept at a place, if it holds now.
    #[inline]
    pub fn get(&self, (place, mark): (u32, u64)) -> Option<&Value> {
        (self.versions[place as usize] == mark).then(|| &self.values[place as usize])
    }

    /// Keeps a value.
    #[inline]
    pub fn keep(&mut self, (place, mark): (u32, u64), value: Value) {
        self.versions[place as usize] = mark;
        self.values[place as usize] = value;
    }

    /// Keeps nothing of what it has kept.
    pub fn forget(&mut self) {
        self.versions.fill(0);
    }

    /// Where the values of each function are kept.
    pub fn shelves(&self) -> &[Option<Shelf>] {
        &self.shelves
    }

    /// The values and their marks, as compiled code reads them.
    #[inline]
    pub fn view(&mut self) -> (*mut Value, *mut u64) {
        (self.values.as_mut_ptr(), self.versions.as_mut_ptr())
    }

    /// The number of the state's version, which the marks are compared with.
    #[inline]
    pub fn version_now(&self) -> u64 {
        self.current
    }

    /// The state has changed to one it never was before.
    #[inline]
    pub fn changed(&mut self) {
        self.last += 1;
        self.current = self.last;
    }

    /// The version of the state now.
    pub fn version(&self) -> Version {
        Version(self.current)
    }

    /// The state is again what it was.
    pub fn back_to(&mut self, version: Version) {
        self.current = version.0;
    }
}

/// By function: its definition depends on its arguments alone.
pub(crate) fn fixed_functions(program: &Program) -> Vec<bool> {
    closed_under(program, &|term| is_repeatable(program, term) && is_fixed(program, term))
}

/// Whether a term depends on its variables alone, given which functions do.
pub(crate) fn is_fixed_term(program: &Program, term: TermId, fixed: &[bool]) -> bool {
    everywhere(program, term, fixed, &|term| is_repeatable(program, term) && is_fixed(program, term))
}

/// How many terms a definition has, counted up to `enough`.
fn size(program: &Program, term: TermId, enough: u32) -> u32 {
    let mut count = 1;
    program.each_child_of_term(term, &mut |child| {
        if count < enough {
            count += size(program, child, enough);
        }
    });
    count
}

/// Evaluated twice in one state, the term itself cannot give two answers.
fn is_repeatable(program: &Program, term: &Term) -> bool {
    match term {
        Term::Read { function, .. } => Some(*function) != program.self_function,
        Term::Builtin { builtin, .. } => match builtin.info().effect {
            Effect::Pure | Effect::ReadsAgents => true,
            Effect::ReadsBefore | Effect::Chooses | Effect::ReadsClock | Effect::SpeaksOfRuns => false,
        },
        Term::Constant(_)
        | Term::Slot(_)
        | Term::Define { .. }
        | Term::Domain(_)
        | Term::Tuple(_)
        | Term::Project { .. }
        | Term::Collection { .. }
        | Term::Range { .. }
        | Term::Comprehension { .. }
        | Term::Quantified { .. }
        | Term::If { .. }
        | Term::Switch { .. }
        | Term::Let { .. }
        | Term::Rule(_)
        | Term::Unbound
        | Term::Missing(_)
        | Term::Coerce(_) => true,
    }
}

/// The term itself does not depend on the state.
fn is_fixed(program: &Program, term: &Term) -> bool {
    match term {
        Term::Read { function, .. } => program.function(*function).kind == FunctionKind::Static,
        Term::Domain(domain) => match &program.domain(*domain).kind {
            DomainKind::Enum { .. } => true,
            DomainKind::Concrete { dynamic, base, .. } => {
                !dynamic && !matches!(program.domain(*base).kind, DomainKind::Abstract { .. })
            }
            _ => false,
        },
        Term::Builtin { builtin, .. } => builtin.info().effect.is_none(),
        Term::Constant(_)
        | Term::Slot(_)
        | Term::Define { .. }
        | Term::Tuple(_)
        | Term::Project { .. }
        | Term::Collection { .. }
        | Term::Range { .. }
        | Term::Comprehension { .. }
        | Term::Quantified { .. }
        | Term::If { .. }
        | Term::Switch { .. }
        | Term::Let { .. }
        | Term::Rule(_)
        | Term::Unbound
        | Term::Missing(_)
        | Term::Coerce(_) => true,
    }
}

/// By function: whether `holds` of every term of its definition, and of those of the definitions it uses.
fn closed_under(program: &Program, holds: &dyn Fn(&Term) -> bool) -> Vec<bool> {
    let mut closed: Vec<bool> = program.functions.iter().map(|f| f.definition.is_some()).collect();
    loop {
        let mut changed = false;
        for (index, function) in program.functions.iter().enumerate() {
            let Some(definition) = &function.definition else { continue };
            if closed[index] && !everywhere(program, definition.body, &closed, holds) {
                closed[index] = false;
                changed = true;
            }
        }
        if !changed {
            return closed;
        }
    }
}

fn everywhere(program: &Program, term: TermId, closed: &[bool], holds: &dyn Fn(&Term) -> bool) -> bool {
    let mut all = holds(program.term(term));
    if let Term::Define { function, .. } = program.term(term) {
        all = all && closed[function.0 as usize];
    }
    if all {
        program.each_child_of_term(term, &mut |child| all = all && everywhere(program, child, closed, holds));
    }
    all
}
