//! Packed states: the value of every location in as few bits as its domain needs.
//!
//! In: the program, its initial states, and what has been found too narrow before ([`Widening`]). Out: an [`Encoding`],
//! which says where the code of each location stands in a state's words. A location over a finite domain has a field of
//! just enough bits; one over an infinite domain a field with the number of its value ([`View`]); all others, and the
//! elements of domains that grow, are one [`Rest`] with a number. INVARIANT: two states are equal exactly when their
//! words are. That a location is never undef, and that the rest never changes, is assumed until the opposite is met.

use std::collections::BTreeSet;
use std::ops::Range;
use std::sync::Arc;

use machine::inside::{extended, is_kept};
use machine::{Location, Machine, Value};
use program::{FunctionId, FunctionKind, Program, Rule, Term};

use crate::packed::codes::{Codes, Coding, finite};
use crate::packed::collection::Collection;
use crate::packed::interner::{Rest, View};
use crate::packed::kept::{Kept, is_input};
use crate::packed::room::{Want, fit};
use crate::packed::widening::{TooNarrow, Widening};
use crate::packed::words::{Field, NOWHERE, REST};

/// LIMIT: a function with more locations has no fields.
const FIELDS_OF_A_FUNCTION: usize = 1 << 12;
/// LIMIT: the fields of a state have at most so many bits; what would not fit belongs to the rest.
pub(crate) const BITS: usize = 1 << 14;

/// See the module.
#[derive(Debug)]
pub(crate) struct Encoding {
    pub fields: Vec<Field>,
    /// By function.
    pub codes: Vec<Option<Codes>>,
    /// By dense location number: its field, [`REST`] or [`NOWHERE`].
    pub of_location: Arc<[u32]>,
    /// The dense locations that belong to the rest.
    others: Vec<u32>,
    pub rest: Option<u32>,
    /// The rest of all states, while it has no field.
    pub constant_rest: Arc<Rest>,
    pub words: usize,
    /// By function: its initial values depend on its arguments alone and are evaluated when first read.
    lazy: Vec<bool>,
    /// By domain, whether it has the same elements in all states.
    pub constant: Vec<bool>,
    /// Some domain has other elements in other states.
    grows: bool,
    /// The inputs of initial states.
    pub kept: Kept,
    /// The field that says which initial state a run began in, where initial values that come up later depend on it.
    pub origin: Option<u32>,
    /// The fields, and after them the pieces of those that hold a collection.
    pub looks: Arc<[Field]>,
    /// By field where its first piece stands among these; 0 where it has none.
    pub pieces: Arc<[u32]>,
}

impl Encoding {
    /// The encoding of a program's states; `machine` stands in an initial state, `initial` are the values of all initial
    /// states by location, `kept` the inputs that these keep, and so many `origins` are to be told apart. No step changes the
    /// `steady` functions: where they are the same in all initial states, they are no part of states. Collections may stand
    /// `in_place`.
    pub fn new(
        program: &Program,
        machine: &mut Machine,
        (initial, steady): (&[Vec<Value>], &BTreeSet<FunctionId>),
        kept: Kept,
        (origins, in_place): (usize, bool),
        widening: &Widening,
    ) -> Encoding {
        let assigned_undef = assigned_undef(program);
        let constant = program.constant_domains();
        let mut encoding = Encoding {
            fields: Vec::new(),
            codes: vec![None; program.functions.len()],
            of_location: Arc::new([]),
            others: Vec::new(),
            rest: None,
            constant_rest: Arc::default(),
            words: 1,
            lazy: machine.late_initials(),
            grows: constant.contains(&false),
            constant,
            kept: Kept::default(),
            origin: None,
            looks: Arc::new([]),
            pieces: Arc::new([]),
        };
        // Sparse locations have different numbers in different states.
        let mut of_location = vec![NOWHERE; machine.store().dense_len()];
        let (mut placed, mut wants) = (Vec::new(), Vec::new());
        for (index, function) in program.functions.iter().enumerate() {
            let id = FunctionId(index as u32);
            let is_kept = is_kept(program, id);
            let Some(dense) = machine.store().dense(id) else { continue };
            if !is_kept {
                continue;
            }
            if steady.contains(&id) && is_alike(machine, id, &dense, initial) {
                continue;
            }
            of_location[dense.start as usize..dense.end as usize].fill(REST);
            if function.library || function.kind == FunctionKind::Shared {
                continue;
            }
            let Some(locations) = declared_locations(program, &encoding.constant, machine, id) else { continue };
            let found = || locations.iter().flat_map(|location| initial.iter().map(|state| &state[*location as usize]));
            let undefined = widening.undefined.contains(&id) || assigned_undef[index] || found().any(Value::is_undef);
            let (domain, constant) = (function.codomain, &encoding.constant);
            let (codes, bits) = Codes::of(program, constant, machine, domain, found(), undefined);
            let longest = widening.longest.get(&id).copied().unwrap_or(0);
            let collection = (in_place && !undefined && !widening.numbered.contains(&id))
                .then(|| Codes::in_place(program, constant, machine, domain, found(), longest))
                .flatten();
            let rooms: Vec<Option<u8>> =
                locations.iter().map(|location| widening.rooms.get(location).copied()).collect();
            // Those of which a census has found that they are few stand by their numbers.
            let collection = collection.filter(|_| rooms.iter().all(Option::is_none));
            wants.push(Want { bits: rooms.iter().map(|room| room.map_or(bits, usize::from)).collect(), collection });
            placed.push((id, locations, codes, rooms));
        }
        fit(&mut wants);
        let mut used = 0usize;
        for ((id, locations, codes, rooms), want) in placed.into_iter().zip(wants) {
            let all: usize = want.bits().sum();
            if used + all > BITS {
                continue;
            }
            used += all;
            for ((location, room), bits) in locations.into_iter().zip(rooms).zip(want.bits()) {
                let field = encoding.add_field(location, id, bits);
                encoding.fields[field as usize].few = room.is_some();
                of_location[location as usize] = field;
            }
            encoding.codes[id.0 as usize] = Some(want.collection.map_or(codes, Codes::InPlace));
        }
        encoding.place_inputs(program, machine, initial, kept, &mut of_location);
        for (location, place) in of_location.iter().enumerate() {
            if *place == REST {
                encoding.others.push(location as u32);
            }
        }
        encoding.of_location = of_location.into();
        let mut rest = encoding.gather(program, machine);
        encoding.settle(machine, &mut rest);
        encoding.constant_rest = Arc::new(rest);
        if widening.rest {
            let field = encoding.add_field(NOWHERE, FunctionId(0), 32);
            encoding.rest = Some(field);
        }
        if origins > 1 {
            let bits = usize::BITS - (origins - 1).leading_zeros();
            encoding.origin = Some(encoding.add_field(NOWHERE, FunctionId(0), bits as usize));
        }
        if !widening.rooms.is_empty() {
            // A state of one word has no number in the table that stores it.
            encoding.words = encoding.words.max(2);
        }
        encoding.place_pieces();
        encoding
    }

    fn place_pieces(&mut self) {
        let (mut looks, mut pieces) = (self.fields.clone(), vec![0; self.fields.len()]);
        for (field, first) in self.fields.iter().zip(&mut pieces) {
            if let Some(Codes::InPlace(collection)) = self.codes_of(*field) {
                *first = looks.len() as u32;
                looks.extend(collection.pieces(*field));
            }
        }
        (self.looks, self.pieces) = (looks.into(), pieces.into());
    }

    fn codes_of(&self, field: Field) -> Option<&Codes> {
        self.codes[field.function.0 as usize].as_ref().filter(|_| field.location != NOWHERE)
    }

    /// How the collections of a function stand in its fields, if they do so in pieces.
    pub fn collection(&self, function: FunctionId) -> Option<&Collection> {
        match &self.codes[function.0 as usize] {
            Some(Codes::InPlace(collection)) => Some(collection),
            Some(Codes::Listed { .. } | Codes::Interned) | None => None,
        }
    }

    /// Whether both give each state the same words, with one interner.
    pub fn is_like(&self, other: &Encoding) -> bool {
        self.fields == other.fields
            && self.codes == other.codes
            && self.of_location == other.of_location
            && (self.rest, self.origin) == (other.rest, other.origin)
            && self.constant_rest == other.constant_rest
            && self.kept == other.kept
    }

    pub fn add_field(&mut self, location: u32, function: FunctionId, bits: usize) -> u32 {
        // A field without bits has no place of its own: after a full word there would be none.
        let last = self.fields.iter().rev().find(|field| field.bits > 0).filter(|_| bits > 0);
        let (mut word, mut shift) = match last {
            Some(last) => (last.word, u32::from(last.shift + last.bits)),
            None => (0, 0),
        };
        // In a state of one word, the highest bit belongs to the table that stores it.
        let room = if word == 0 { 63 } else { 64 };
        if shift as usize + bits > room {
            (word, shift) = (word + 1, 0);
        }
        self.words = self.words.max(word as usize + 1);
        self.fields.push(Field { location, function, word, shift: shift as u8, bits: bits as u8, few: false });
        self.fields.len() as u32 - 1
    }

    /// The code of a location's value.
    pub fn code(&self, field: Field, value: &Value, view: &mut View) -> Result<u64, TooNarrow> {
        if field.few {
            return view.few_code(field.location, field.bits, value).ok_or_else(|| TooNarrow::outgrown(field.location));
        }
        let narrow = || {
            let undefined = BTreeSet::from([field.function]);
            TooNarrow(Widening { undefined, ..Widening::default() })
        };
        match &self.codes[field.function.0 as usize] {
            Some(Codes::Listed { values, undefined }) => match (value, values.first()) {
                (Value::Undef, _) if *undefined => Ok(values.len() as u64),
                (Value::Undef, _) => Err(narrow()),
                _ => Ok(values.binary_search(value).map_err(|_| narrow())? as u64),
            },
            Some(Codes::InPlace(collection)) => {
                collection.code(value).map_err(|misfit| TooNarrow::of(field.function, misfit))
            }
            Some(Codes::Interned) | None => Ok(u64::from(view.number(value))),
        }
    }

    /// How the values of a function that has fields become codes.
    pub fn coding(&self, function: FunctionId) -> Coding<'_> {
        match &self.codes[function.0 as usize] {
            Some(Codes::Listed { values, .. }) => Coding::Listed(values),
            Some(Codes::InPlace(_)) => Coding::InPieces,
            Some(Codes::Interned) | None => Coding::Numbered,
        }
    }

    /// Whether a run's beginning is part of its states.
    pub fn tells_origins(&self) -> bool {
        self.origin.is_some()
    }

    /// Whether the declared locations of a function have fields.
    pub fn has_fields(&self, function: FunctionId) -> bool {
        self.codes[function.0 as usize].is_some()
    }

    /// The value that stands in a field.
    pub fn value(&self, field: Field, words: &[u64], view: &mut View) -> Value {
        let code = field.code(words);
        if field.few {
            return view.few_value(field.location, code).clone();
        }
        match &self.codes[field.function.0 as usize] {
            Some(Codes::Listed { values, .. }) => values.get(code as usize).cloned().unwrap_or(Value::Undef),
            Some(Codes::InPlace(collection)) => collection.value(code),
            Some(Codes::Interned) | None => view.value(code as u32).clone(),
        }
    }

    /// Packs the machine's state, an initial one that has asked for these inputs, of this origin.
    pub fn pack(
        &self,
        program: &Program,
        machine: &mut Machine,
        (inputs, origin): (&[(Location, Value)], u32),
        view: &mut View,
    ) -> Result<Box<[u64]>, TooNarrow> {
        let mut rest = self.gather(program, machine);
        self.settle(machine, &mut rest);
        self.add_inputs(&mut rest, inputs);
        let mut words = vec![0; self.words].into_boxed_slice();
        for field in self.fields.iter().filter(|field| field.location != NOWHERE) {
            let code = self.code(*field, machine.store().value(field.location), view)?;
            field.put(code, &mut words);
        }
        self.put_rest(rest, &mut words, view)?;
        if let Some(field) = self.origin {
            self.fields[field as usize].put(u64::from(origin), &mut words);
        }
        Ok(words)
    }

    /// Changes the packed initial state before this one by the locations that may differ; false where it is not enough to look at
    /// these.
    pub fn pack_changed(
        &self,
        machine: &Machine,
        changed: &[u32],
        words: &mut [u64],
        view: &mut View,
    ) -> Result<bool, TooNarrow> {
        for location in changed {
            match self.of_location.get(*location as usize) {
                Some(&NOWHERE) => {}
                Some(field) if *field < REST => {
                    let field = self.fields[*field as usize];
                    field.put(self.code(field, machine.store().value(*location), view)?, words);
                }
                Some(_) | None => return Ok(false),
            }
        }
        Ok(true)
    }

    /// Puts the machine into a packed state.
    pub fn unpack(&self, program: &Program, words: &[u64], machine: &mut Machine, view: &mut View) {
        let store = machine.store_mut();
        for field in self.fields.iter().filter(|field| field.location != NOWHERE) {
            store.overwrite(field.location, self.value(*field, words, view));
        }
        self.unpack_rest(program, words, machine, view);
    }

    /// Puts the rest of a packed state into the machine.
    pub fn unpack_rest(&self, program: &Program, words: &[u64], machine: &mut Machine, view: &mut View) {
        let store = machine.store_mut();
        let rest = match self.rest {
            Some(field) => view.rest(self.fields[field as usize].code(words) as u32),
            None => Arc::clone(&self.constant_rest),
        };
        let sparse = self.of_location.len() as u32..store.len() as u32;
        self.others.iter().copied().chain(sparse).for_each(|index| store.clear(index));
        for (location, value) in rest.locations.iter().filter(|(location, _)| !is_input(program, location)) {
            let index = store.number(location.function, &location.arguments);
            store.put(index, value.clone());
        }
        if self.grows {
            machine.set_grown(&rest.grown);
        }
    }

    /// Whether a state's rest can differ from that of the state before a step that has made no update of it.
    pub fn rest_may_change(&self, machine: &Machine) -> bool {
        self.grows || !self.others.is_empty() || machine.store().len() > self.of_location.len()
    }

    /// The rest of the state.
    pub fn gather(&self, program: &Program, machine: &Machine) -> Rest {
        self.gather_with(program, machine, false, &|_| None)
    }

    /// The same after a step: with the elements that it `creates`, if these are wanted, and its updates.
    pub fn gather_with<'m>(
        &self,
        program: &Program,
        machine: &'m Machine,
        creates: bool,
        update_of: &dyn Fn(u32) -> Option<&'m Value>,
    ) -> Rest {
        let store = machine.store();
        let sparse = self.of_location.len() as u32..store.len() as u32;
        let mut locations: Vec<(Location, Value)> = Vec::new();
        for index in self.others.iter().copied().chain(sparse) {
            let (mut value, mut given) = (store.value(index), store.is_given(index));
            if let Some(update) = update_of(index) {
                (value, given) = (update, true);
            }
            if value.is_undef() && !given {
                continue;
            }
            let location = store.location(index);
            let kind = program.function(location.function).kind;
            if !is_kept(program, location.function) {
                continue;
            }
            let has_initial = machine.has_initial(location.function);
            // Undef matters only if it replaces an initial value or an answer of the environment.
            if value.is_undef() && !has_initial && kind != FunctionKind::Shared {
                continue;
            }
            locations.push((location, value.clone()));
        }
        locations.sort_unstable();
        let grown = if self.grows { machine.grown(creates) } else { Vec::new() };
        Rest { locations, grown }
    }

    /// Puts the number of a rest into its field.
    pub fn put_rest(&self, rest: Rest, words: &mut [u64], view: &mut View) -> Result<(), TooNarrow> {
        match self.rest {
            Some(field) => {
                let code = view.rest_number(&Arc::new(rest));
                self.fields[field as usize].put(u64::from(code), words);
                Ok(())
            }
            None if rest == *self.constant_rest => Ok(()),
            None => Err(TooNarrow(Widening { rest: true, ..Widening::default() })),
        }
    }

    /// Leaves out locations that have the initial value which they would get anyway when they are first read.
    pub fn settle(&self, machine: &mut Machine, rest: &mut Rest) {
        rest.locations.retain(|(location, value)| {
            !self.lazy[location.function.0 as usize] || machine.initial_value(location).as_ref() != Some(value)
        });
    }

    /// The order of states that does not depend on what was met first: by the values of their locations.
    pub fn compare(&self, a: &[u64], b: &[u64], view: &mut View) -> std::cmp::Ordering {
        for (index, field) in self.fields.iter().enumerate() {
            if field.code(a) == field.code(b) {
                continue;
            }
            if self.rest == Some(index as u32) {
                return view.rest(field.code(a) as u32).cmp(&view.rest(field.code(b) as u32));
            }
            if self.origin == Some(index as u32) {
                return field.code(a).cmp(&field.code(b));
            }
            return self.value(*field, a, view).cmp(&self.value(*field, b, view));
        }
        std::cmp::Ordering::Equal
    }
}

/// Whether the dense locations of a function have the same values in all initial states, and none gets its initial value later.
fn is_alike(machine: &Machine, function: FunctionId, dense: &Range<u32>, initial: &[Vec<Value>]) -> bool {
    let late = machine.has_initial(function) && dense.clone().any(|location| !machine.store().is_given(location));
    let range = dense.start as usize..dense.end as usize;
    !late && initial.iter().all(|state| state[range.clone()] == initial[0][range.clone()])
}

/// The dense locations whose arguments are in the declared domains, if these are finite.
fn declared_locations(
    program: &Program,
    constant: &[bool],
    machine: &mut Machine,
    function: FunctionId,
) -> Option<Vec<u32>> {
    let mut tuples = vec![Vec::new()];
    for parameter in &program.function(function).parameters {
        let elements = finite(program, constant, machine, *parameter)?;
        if tuples.len() * elements.len() > FIELDS_OF_A_FUNCTION {
            return None;
        }
        tuples = extended(tuples, &elements);
    }
    let dense = machine.store().dense(function)?;
    let inside = |index: &u32| dense.contains(index);
    tuples.iter().map(|tuple| machine.store().find(function, tuple).filter(inside)).collect()
}

/// By function: some update rule gives it `undef` as written.
fn assigned_undef(program: &Program) -> Vec<bool> {
    let mut assigned = vec![false; program.functions.len()];
    for rule in &program.rules {
        if let Rule::Update { function, value, .. } = rule
            && let Term::Constant(constant) = program.term(*value)
            && program.constants[*constant as usize] == program::Literal::Undef
        {
            assigned[function.0 as usize] = true;
        }
    }
    assigned
}
