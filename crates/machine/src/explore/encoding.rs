//! Packed states: the value of every location in as few bits as its domain needs.
//!
//! In: the program, its initial states, and what has been found too narrow before ([`Widening`]). Out: an [`Encoding`],
//! which says where the code of each location stands in a state's words. A location over a finite domain has a field of
//! just enough bits; one over an infinite domain a field with the number of its value ([`View`]); all others, and the
//! elements of domains that grow, are one [`Rest`] with a number. INVARIANT: two states are equal exactly when their
//! words are. That a location is never undef, and that the rest never changes, is assumed until the opposite is met.

use std::collections::BTreeSet;
use std::sync::Arc;

use program::{Builtin, DomainId, DomainKind, FunctionId, FunctionKind, Program, Rule, Term};

use crate::enumerate::extended;
use crate::execute::Core;
use crate::explore::branches::{NOWHERE, REST};
use crate::explore::choose::is_kept;
use crate::explore::conditions::{initial_value, is_fixed};
use crate::explore::interner::{Rest, View};
use crate::explore::kept::{Kept, is_input};
use crate::explore::paths::Told;
use crate::layout::Layout;
use crate::location::Location;
use crate::machine::Machine;
use crate::value::Value;

/// LIMIT: a function with more locations has no fields.
const FIELDS_OF_A_FUNCTION: usize = 1 << 12;
/// LIMIT: a domain with more elements counts as infinite.
const CODES: usize = 1 << 12;
/// A function with more locations does not have all its initial values from the start, see [`crate::machine::Machine::start`].
const EAGER: usize = 1 << 20;
/// LIMIT: the fields of a state have at most so many bits; what would not fit belongs to the rest.
pub(crate) const BITS: usize = 1 << 14;

/// What has been found not to fit since the encoding was made.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct Widening {
    /// Functions that may be undef.
    undefined: BTreeSet<FunctionId>,
    /// The rest changes.
    rest: bool,
}

impl Widening {
    /// Adds what another has found.
    pub fn merge(&mut self, other: &Widening) {
        self.undefined.extend(&other.undefined);
        self.rest |= other.rest;
    }

    /// Whether nothing has been found.
    pub fn is_empty(&self) -> bool {
        !self.rest && self.undefined.is_empty()
    }
}

/// How values of one function become codes.
#[derive(Debug, Clone)]
pub(crate) enum Codes {
    /// The place in this list, sorted; undef, where it is possible, comes last.
    Listed { values: Arc<Vec<Value>>, undefined: bool },
    /// The number that an interner gives.
    Interned,
}

impl Codes {
    /// The codes of values of a domain and these, of undef where that is possible; and how many bits they need.
    pub fn of<'v>(
        program: &Program,
        machine: &mut Machine,
        domain: DomainId,
        found: impl Iterator<Item = &'v Value>,
        undefined: bool,
    ) -> (Codes, usize) {
        let Some(mut values) = finite(program, machine, domain) else { return (Codes::Interned, 32) };
        values.extend(found.cloned());
        values.retain(|value| !value.is_undef());
        values.sort_unstable();
        values.dedup();
        let count = values.len() + usize::from(undefined);
        let bits = (usize::BITS - count.saturating_sub(1).leading_zeros()) as usize;
        (Codes::Listed { values: Arc::new(values), undefined }, bits)
    }
}

/// How a function's values become codes, for who asks.
#[derive(Debug, Clone, Copy)]
pub(crate) enum Coding<'e> {
    /// The place in this list.
    Listed(&'e [Value]),
    /// The number of the value.
    Numbered,
}

/// A field of the words.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) struct Field {
    /// The location whose value it holds; unused for the rest.
    pub location: u32,
    pub function: FunctionId,
    pub word: u32,
    pub shift: u8,
    pub bits: u8,
}

impl Field {
    /// The ones that cover the field in its word.
    #[inline]
    pub fn mask(&self) -> u64 {
        ((1u64 << self.bits) - 1) << self.shift
    }

    /// The code that stands in it.
    #[inline]
    pub fn code(&self, words: &[u64]) -> u32 {
        ((words[self.word as usize] & self.mask()) >> self.shift) as u32
    }
}

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
    /// Some domain may grow.
    grows: bool,
    /// The inputs of initial states.
    pub kept: Kept,
    /// The field that says which initial state a run began in, where initial values that come up later depend on it.
    pub origin: Option<u32>,
}

/// The state does not fit into the encoding.
#[derive(Debug)]
pub(crate) struct TooNarrow(pub Widening);

impl Encoding {
    /// The encoding of a program's states; `machine` stands in an initial state, `initial` are the values of all initial
    /// states by location, `kept` the inputs that these keep, and so many `origins` are to be told apart.
    pub fn new(
        program: &Program,
        machine: &mut Machine,
        initial: &[Vec<Value>],
        kept: Kept,
        origins: usize,
        widening: &Widening,
    ) -> Encoding {
        let assigned_undef = assigned_undef(program);
        let mut encoding = Encoding {
            fields: Vec::new(),
            codes: vec![None; program.functions.len()],
            of_location: Arc::new([]),
            others: Vec::new(),
            rest: None,
            constant_rest: Arc::default(),
            words: 1,
            lazy: lazy(program, machine),
            grows: program.domains.iter().any(|domain| match &domain.kind {
                DomainKind::Abstract { dynamic, .. } | DomainKind::Concrete { dynamic, .. } => *dynamic,
                _ => false,
            }),
            kept: Kept::default(),
            origin: None,
        };
        // What is sparse has other numbers in other states.
        let dense = machine.core.store.len() - machine.core.store.sparse_len();
        let mut of_location = vec![NOWHERE; dense];
        let mut used = 0usize;
        for (index, function) in program.functions.iter().enumerate() {
            let id = FunctionId(index as u32);
            let is_kept = is_kept(program, id);
            let (first, len) = match &machine.core.store.layouts[index] {
                Layout::Single(location) => (*location, 1),
                Layout::Dense { base, len, .. } => (*base, *len),
                Layout::None | Layout::Sparse => continue,
            };
            if !is_kept {
                continue;
            }
            of_location[first as usize..(first + len) as usize].fill(REST);
            if function.library || function.kind == FunctionKind::Shared {
                continue;
            }
            let Some(locations) = declared_locations(program, machine, id) else { continue };
            let found = || locations.iter().flat_map(|location| initial.iter().map(|state| &state[*location as usize]));
            let undefined = widening.undefined.contains(&id) || assigned_undef[index] || found().any(Value::is_undef);
            let (codes, bits) = Codes::of(program, machine, function.codomain, found(), undefined);
            if used + bits * locations.len() > BITS {
                continue;
            }
            used += bits * locations.len();
            encoding.codes[index] = Some(codes);
            for location in locations {
                of_location[location as usize] = encoding.add_field(location, id, bits);
            }
        }
        encoding.place_inputs(program, machine, initial, kept, &mut of_location);
        for (location, place) in of_location.iter().enumerate() {
            if *place == REST {
                encoding.others.push(location as u32);
            }
        }
        encoding.of_location = of_location.into();
        let mut rest = encoding.gather(program, &machine.core, false);
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
        encoding
    }

    pub fn add_field(&mut self, location: u32, function: FunctionId, bits: usize) -> u32 {
        let (mut word, mut shift) = match self.fields.last() {
            Some(last) => (last.word, u32::from(last.shift + last.bits)),
            None => (0, 0),
        };
        // A state of one word leaves its highest bit to the table it stands in.
        let room = if word == 0 { 63 } else { 64 };
        if shift as usize + bits > room {
            (word, shift) = (word + 1, 0);
        }
        self.words = self.words.max(word as usize + 1);
        self.fields.push(Field { location, function, word, shift: shift as u8, bits: bits as u8 });
        self.fields.len() as u32 - 1
    }

    /// The code of a location's value.
    pub fn code(&self, field: Field, value: &Value, view: &mut View) -> Result<u32, TooNarrow> {
        let narrow = || {
            let undefined = BTreeSet::from([field.function]);
            TooNarrow(Widening { undefined, rest: false })
        };
        match &self.codes[field.function.0 as usize] {
            Some(Codes::Listed { values, undefined }) => match (value, values.first()) {
                (Value::Undef, _) if *undefined => Ok(values.len() as u32),
                (Value::Undef, _) => Err(narrow()),
                _ => Ok(values.binary_search(value).map_err(|_| narrow())? as u32),
            },
            _ => Ok(view.number(value)),
        }
    }

    /// How the values of a function that has fields become codes.
    pub fn coding(&self, function: FunctionId) -> Coding<'_> {
        match &self.codes[function.0 as usize] {
            Some(Codes::Listed { values, .. }) => Coding::Listed(values),
            _ => Coding::Numbered,
        }
    }

    /// Whether the declared locations of a function have fields.
    pub fn has_fields(&self, function: FunctionId) -> bool {
        self.codes[function.0 as usize].is_some()
    }

    /// The value that stands in a field.
    pub fn value(&self, field: Field, words: &[u64], view: &mut View) -> Value {
        let code = field.code(words);
        match &self.codes[field.function.0 as usize] {
            Some(Codes::Listed { values, .. }) => values.get(code as usize).cloned().unwrap_or(Value::Undef),
            _ => view.value(code).clone(),
        }
    }

    /// Puts a code into a field.
    pub fn put(field: Field, code: u32, words: &mut [u64]) {
        let word = &mut words[field.word as usize];
        *word = *word & !field.mask() | u64::from(code) << field.shift;
    }

    /// Packs the machine's state, an initial one that has asked for what is told, of this origin.
    pub fn pack(
        &self,
        program: &Program,
        machine: &mut Machine,
        (told, origin): (&Told, u32),
        view: &mut View,
    ) -> Result<Box<[u64]>, TooNarrow> {
        let mut rest = self.gather(program, &machine.core, false);
        self.settle(machine, &mut rest);
        self.add_inputs(&mut rest, told);
        let core = &machine.core;
        let mut words = vec![0; self.words].into_boxed_slice();
        for field in self.fields.iter().filter(|field| field.location != NOWHERE) {
            let code = self.code(*field, &core.store.values[field.location as usize], view)?;
            Encoding::put(*field, code, &mut words);
        }
        self.put_rest(rest, &mut words, view)?;
        if let Some(field) = self.origin {
            Encoding::put(self.fields[field as usize], origin, &mut words);
        }
        Ok(words)
    }

    /// Puts the machine into a packed state.
    pub fn unpack(&self, program: &Program, words: &[u64], core: &mut Core, view: &mut View) {
        for field in self.fields.iter().filter(|field| field.location != NOWHERE) {
            core.store.values[field.location as usize] = self.value(*field, words, view);
        }
        let rest = match self.rest {
            Some(field) => view.rest(self.fields[field as usize].code(words)),
            None => Arc::clone(&self.constant_rest),
        };
        let sparse = self.of_location.len() as u32..core.store.len() as u32;
        for index in self.others.iter().copied().chain(sparse) {
            core.store.values[index as usize] = Value::Undef;
            core.store.given[index as usize] = 0;
        }
        for (location, value) in rest.locations.iter().filter(|(location, _)| !is_input(program, location)) {
            let index = core.store.number(location.function, &location.arguments) as usize;
            core.store.values[index] = value.clone();
            core.store.given[index] = 1;
        }
        if self.grows {
            core.reset_carriers(program);
            for (domain, count, elements) in &rest.carriers {
                let carrier = &mut core.store.carriers[domain.0 as usize];
                (carrier.count, carrier.fresh) = (*count, *count);
                carrier.elements.clone_from(elements);
            }
        }
    }

    /// Whether a state's rest can differ from that of the state before a step that has made no update of it.
    pub fn rest_may_change(&self, core: &Core) -> bool {
        self.grows || !self.others.is_empty() || core.store.len() > self.of_location.len()
    }

    /// The rest of the state; with the updates of the running step, if these are wanted.
    pub fn gather(&self, program: &Program, core: &Core, updated: bool) -> Rest {
        let store = &core.store;
        let sparse = self.of_location.len() as u32..store.len() as u32;
        let mut locations: Vec<(Location, Value)> = Vec::new();
        for index in self.others.iter().copied().chain(sparse) {
            let (mut value, mut given) = (&store.values[index as usize], store.given[index as usize] != 0);
            if updated && let Some(update) = core.updates.held(index) {
                (value, given) = (&update.value, true);
            }
            if value.is_undef() && !given {
                continue;
            }
            let location = store.location(index);
            let kind = program.function(location.function).kind;
            if !is_kept(program, location.function) {
                continue;
            }
            let has_initial = core.initials[location.function.0 as usize].is_some();
            // Undef says something only where it keeps an initial value or a question away.
            if value.is_undef() && !has_initial && kind != FunctionKind::Shared {
                continue;
            }
            locations.push((location, value.clone()));
        }
        locations.sort_unstable();
        let carriers = if self.grows { self.carriers(program, core, updated) } else { Vec::new() };
        Rest { locations, carriers }
    }

    fn carriers(&self, program: &Program, core: &Core, updated: bool) -> Vec<(DomainId, u32, Vec<Value>)> {
        let created = if updated { core.updates.created() } else { &[] };
        let each = program.domains.iter().enumerate().filter_map(|(index, domain)| {
            let id = DomainId(index as u32);
            let carrier = &core.store.carriers[index];
            let new = || created.iter().filter(|(domain, _)| *domain == id);
            match &domain.kind {
                DomainKind::Abstract { elements, .. } => {
                    let count = if new().next().is_some() { carrier.fresh } else { carrier.count };
                    (count as usize != elements.len()).then(|| (id, count, Vec::new()))
                }
                DomainKind::Concrete { dynamic: true, .. } => {
                    let mut elements = carrier.elements.clone();
                    elements.extend(new().map(|(_, element)| element.clone()));
                    elements.sort_unstable();
                    elements.dedup();
                    Some((id, 0, elements))
                }
                _ => None,
            }
        });
        each.collect()
    }

    /// Puts the number of a rest into its field.
    pub fn put_rest(&self, rest: Rest, words: &mut [u64], view: &mut View) -> Result<(), TooNarrow> {
        match self.rest {
            Some(field) => {
                let code = view.rest_number(&Arc::new(rest));
                Encoding::put(self.fields[field as usize], code, words);
                Ok(())
            }
            None if rest == *self.constant_rest => Ok(()),
            None => Err(TooNarrow(Widening { undefined: BTreeSet::new(), rest: true })),
        }
    }

    /// Leaves out locations that have the initial value which they would get anyway when they are first read.
    pub fn settle(&self, machine: &mut Machine, rest: &mut Rest) {
        rest.locations.retain(|(location, value)| {
            !self.lazy[location.function.0 as usize] || initial_value(machine, location).as_ref() != Some(value)
        });
    }

    /// The order of states that does not depend on what was met first: by the values of their locations.
    pub fn compare(&self, a: &[u64], b: &[u64], view: &mut View) -> std::cmp::Ordering {
        for (index, field) in self.fields.iter().enumerate() {
            if field.code(a) == field.code(b) {
                continue;
            }
            if self.rest == Some(index as u32) {
                return view.rest(field.code(a)).cmp(&view.rest(field.code(b)));
            }
            if self.origin == Some(index as u32) {
                return field.code(a).cmp(&field.code(b));
            }
            return self.value(*field, a, view).cmp(&self.value(*field, b, view));
        }
        std::cmp::Ordering::Equal
    }
}

/// The elements of a domain that is finite and the same in all states.
fn finite(program: &Program, machine: &mut Machine, domain: DomainId) -> Option<Vec<Value>> {
    let fixed = match &program.domain(domain).kind {
        DomainKind::Basic(model::Basic::Boolean) | DomainKind::Enum { .. } => true,
        DomainKind::Abstract { dynamic, .. } | DomainKind::Concrete { dynamic, .. } => !dynamic,
        // What is inside of tuples and collections is not checked of an update, so they may hold anything.
        _ => false,
    };
    let over_growing = match &program.domain(domain).kind {
        DomainKind::Concrete { base, .. } => {
            matches!(program.domain(*base).kind, DomainKind::Abstract { dynamic: true, .. })
        }
        _ => false,
    };
    if !fixed || over_growing {
        return None;
    }
    machine.elements(domain).ok().filter(|elements| elements.len() <= CODES)
}

/// The dense locations whose arguments are in the declared domains, if these are finite.
fn declared_locations(program: &Program, machine: &mut Machine, function: FunctionId) -> Option<Vec<u32>> {
    let mut tuples = vec![Vec::new()];
    for parameter in &program.function(function).parameters {
        let elements = finite(program, machine, *parameter)?;
        if tuples.len() * elements.len() > FIELDS_OF_A_FUNCTION {
            return None;
        }
        tuples = extended(tuples, &elements);
    }
    let dense = machine.core.store.layouts.get(function.0 as usize)?;
    let inside = |index: &u32| match dense {
        Layout::Single(_) => true,
        Layout::Dense { base, len, .. } => (*base..base + len).contains(index),
        Layout::None | Layout::Sparse => false,
    };
    tuples.iter().map(|tuple| machine.core.store.find(function, tuple).filter(inside)).collect()
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

/// By function: its initial values depend on its arguments alone, and some of them are not there from the start.
fn lazy(program: &Program, machine: &mut Machine) -> Vec<bool> {
    let fixed = crate::memo::fixed_functions(program);
    let mut lazy = vec![false; program.functions.len()];
    for initial in &program.initials {
        let body = initial.value.body;
        let chooses = matches!(program.term(body), Term::Builtin { builtin: Builtin::ChooseOne, .. });
        let mut locations = 1usize;
        for parameter in &program.function(initial.function).parameters {
            let count = match is_fixed(program, *parameter) {
                true => machine.elements(*parameter).map_or(usize::MAX, |elements| elements.len()),
                false => usize::MAX,
            };
            locations = locations.saturating_mul(count);
        }
        lazy[initial.function.0 as usize] =
            locations > EAGER && !chooses && crate::memo::is_fixed_term(program, body, &fixed);
    }
    lazy
}
