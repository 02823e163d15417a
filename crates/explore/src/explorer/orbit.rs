//! States up to permutations of elements that nothing tells apart.
//!
//! In: classes of interchangeable elements; packed states. Out: a state that the given one becomes when the elements of each
//! class are permuted, and the permutation (C. Ip, D. Dill, *Better verification through symmetry*, 1996). Elements are put in
//! the order of what the state says of each; those of which it says the same are tried in every order, and the least state is
//! taken. INVARIANT: what comes out depends on the values of the state alone. LIMIT: where too many orders would have to be tried, some
//! are not, and states that become each other may have several representatives.

use std::cmp::Ordering;
use std::collections::BTreeMap;

use machine::inside::Grown;
use machine::{Location, Value};
use program::FunctionId;

use crate::explorer::Explorer;
use crate::packed::codes::Coding;
use crate::packed::encoding::Encoding;
use crate::packed::interner::{Rest, View};
use crate::packed::words::Field;

/// LIMIT: so many orders of elements of which a state says the same are tried.
const ORDERS: usize = 5040;

/// Stands for no code.
const NONE: u32 = u32::MAX;

/// By class: where each element goes.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Permutation(Vec<Vec<u32>>);

impl Permutation {
    /// The one that takes it back.
    pub fn inverse(&self) -> Permutation {
        let of = |images: &Vec<u32>| {
            let mut inverse = vec![0; images.len()];
            images.iter().enumerate().for_each(|(from, to)| inverse[*to as usize] = from as u32);
            inverse
        };
        Permutation(self.0.iter().map(of).collect())
    }

    /// This one first, then another.
    pub fn then(&self, next: &Permutation) -> Permutation {
        let of = |(first, next): (&Vec<u32>, &Vec<u32>)| first.iter().map(|to| next[*to as usize]).collect();
        Permutation(self.0.iter().zip(&next.0).map(of).collect())
    }

    fn is_identity(&self) -> bool {
        self.0.iter().all(|images| images.iter().enumerate().all(|(from, to)| from as u32 == *to))
    }
}

/// See the module.
#[derive(Debug)]
pub struct Orbits {
    classes: Vec<Vec<Value>>,
    /// Which element of which class a value is.
    places: BTreeMap<Value, (usize, u32)>,
    families: Vec<Family>,
    /// By class: what tells its elements apart at a glance.
    marks: Vec<Vec<Mark>>,
    /// Some fields hold more than marks tell.
    is_deep: bool,
    rest: Option<Field>,
}

/// The fields that a permutation moves into each other.
#[derive(Debug)]
struct Family {
    /// The classes that the arguments range over.
    coordinates: Vec<usize>,
    /// By the elements, the first argument slowest.
    fields: Vec<Field>,
    held: Held,
}

/// What fields hold.
#[derive(Debug)]
enum Held {
    /// Values without such elements.
    Plain,
    /// Such elements, or others: by code, which one; by class and element, the code.
    Elements(Vec<Option<(usize, u32)>>, Vec<Vec<u32>>),
    /// Values that may have such elements inside.
    Deep,
}

/// The arguments of a location, each a class of elements or another value.
type Template = Vec<Result<usize, Value>>;

/// Elements of a class of which a state says the same: from where to where they stand in the order.
#[derive(Debug, Clone, Copy)]
struct Tie {
    class: usize,
    begin: usize,
    end: usize,
}

/// What a state says of one element.
#[derive(Debug)]
enum Mark {
    /// The code in a field of its own; whether codes are numbers of values.
    Own(Vec<Field>, bool),
    /// Whether a field holds it.
    Held(Field, Vec<u32>),
}

impl Orbits {
    /// The orbits of packed states; none where they are packed so that elements cannot be permuted.
    fn new(
        encoding: &Encoding,
        location: &dyn Fn(u32) -> Location,
        classes: &[Vec<Value>],
        holds: &dyn Fn(FunctionId) -> bool,
    ) -> Option<Orbits> {
        if encoding.tells_origins() {
            return None;
        }
        let mut orbits = Orbits {
            classes: classes.to_vec(),
            places: BTreeMap::new(),
            families: Vec::new(),
            marks: classes.iter().map(|_| Vec::new()).collect(),
            is_deep: encoding.rest.is_some(),
            rest: encoding.rest.map(|field| encoding.fields[field as usize]),
        };
        for (class, elements) in classes.iter().enumerate() {
            orbits.places.extend(elements.iter().enumerate().map(|(at, value)| (value.clone(), (class, at as u32))));
        }
        // The key is a function and its arguments; an element in them stands for its class.
        let mut templates: BTreeMap<(FunctionId, Template), BTreeMap<Vec<u32>, Field>> = BTreeMap::new();
        for (index, field) in encoding.fields.iter().enumerate() {
            if encoding.rest == Some(index as u32) {
                continue;
            }
            let Location { function, arguments } = location(field.location);
            let places = arguments.iter().map(|argument| orbits.places.get(argument));
            let at = places.clone().flatten().map(|(_, at)| *at).collect();
            let template = places.zip(&arguments).map(|(place, argument)| match place {
                Some((class, _)) => Ok(*class),
                None => Err(argument.clone()),
            });
            templates.entry((function, template.collect())).or_default().insert(at, *field);
        }
        for ((function, template), fields) in templates {
            let coordinates: Vec<usize> = template.iter().filter_map(|part| part.as_ref().ok().copied()).collect();
            let size: usize = coordinates.iter().map(|class| classes[*class].len()).product();
            if fields.len() != size {
                return None;
            }
            let held = if holds(function) { orbits.held(encoding.coding(function))? } else { Held::Plain };
            orbits.add(coordinates, fields.into_values().collect(), held, encoding.coding(function));
        }
        // A location with the same value in all states has no field that a permutation could move.
        let same = |permutation: &Permutation| {
            orbits.rest_image(&encoding.constant_rest, permutation) == *encoding.constant_rest
        };
        let unmoved = encoding.rest.is_some() || orbits.exchanges().iter().all(same);
        unmoved.then_some(orbits)
    }

    fn held(&self, coding: Coding<'_>) -> Option<Held> {
        let values = match coding {
            Coding::Listed(values) => values,
            Coding::Numbered => return Some(Held::Deep),
            Coding::InPieces => return None,
        };
        let stays = |value: &Value| self.places.contains_key(value) || self.image(value, &mut |_| None) == *value;
        if !values.iter().all(stays) {
            return None;
        }
        let which: Vec<_> = values.iter().map(|value| self.places.get(value).copied()).collect();
        if which.iter().all(Option::is_none) {
            return Some(Held::Plain);
        }
        let code = |value: &Value| values.binary_search(value).map_or(NONE, |code| code as u32);
        let codes: Vec<Vec<u32>> = self.classes.iter().map(|class| class.iter().map(code).collect()).collect();
        // Either all elements of a class have codes, or none has.
        let whole = |codes: &Vec<u32>| codes.iter().all(|code| *code == NONE) || !codes.contains(&NONE);
        codes.iter().all(whole).then_some(Held::Elements(which, codes))
    }

    fn add(&mut self, coordinates: Vec<usize>, fields: Vec<Field>, held: Held, coding: Coding<'_>) {
        let numbered = matches!(coding, Coding::Numbered);
        match (&coordinates[..], &held) {
            ([], Held::Plain) => return,
            ([class], Held::Plain) => self.marks[*class].push(Mark::Own(fields.clone(), numbered)),
            ([], Held::Elements(_, codes)) => {
                for (class, codes) in codes.iter().enumerate().filter(|(_, codes)| !codes.contains(&NONE)) {
                    self.marks[class].push(Mark::Held(fields[0], codes.clone()));
                }
            }
            _ => self.is_deep = true,
        }
        self.families.push(Family { coordinates, fields, held });
    }

    /// Each exchange of two neighbours of a class.
    fn exchanges(&self) -> Vec<Permutation> {
        let pairs =
            self.classes.iter().enumerate().flat_map(|(class, all)| (1..all.len() as u32).map(move |at| (class, at)));
        pairs.map(|(class, at)| self.exchange(class, at - 1, at)).collect()
    }

    fn exchange(&self, class: usize, a: u32, b: u32) -> Permutation {
        let mut images: Vec<Vec<u32>> = self.classes.iter().map(|class| (0..class.len() as u32).collect()).collect();
        images[class].swap(a as usize, b as usize);
        Permutation(images)
    }

    /// A value with other elements inside.
    fn image(&self, value: &Value, of: &mut dyn FnMut((usize, u32)) -> Option<Value>) -> Value {
        if let Some(place) = self.places.get(value) {
            return of(*place).unwrap_or(Value::Undef);
        }
        match value {
            Value::Tuple(items) => Value::tuple(items.iter().map(|item| self.image(item, of)).collect()),
            Value::Seq(items) => Value::seq(items.iter().map(|item| self.image(item, of)).collect()),
            Value::Set(items) => Value::set(items.iter().map(|item| self.image(item, of)).collect()),
            Value::Bag(items) => {
                let all = items.iter().flat_map(|(item, count)| std::iter::repeat_n(item, *count as usize));
                Value::bag(all.map(|item| self.image(item, of)).collect::<Vec<_>>())
            }
            Value::Map(items) => {
                let pairs: Vec<(Value, Value)> =
                    items.iter().map(|(key, value)| (self.image(key, of), self.image(value, of))).collect();
                let map = Value::map(pairs.clone());
                match &map {
                    Value::Map(image) if image.len() == items.len() => map,
                    // Keys that have become equal would hide each other's values.
                    _ => Value::bag(pairs.into_iter().map(|(key, value)| Value::tuple(vec![key, value]))),
                }
            }
            other => other.clone(),
        }
    }

    fn value_image(&self, value: &Value, permutation: &Permutation) -> Value {
        self.image(value, &mut |(class, at)| {
            let to = permutation.0[class][at as usize] as usize;
            Some(self.classes[class][to].clone())
        })
    }

    fn rest_with(&self, rest: &Rest, of: &mut dyn FnMut(&Value) -> Value) -> Rest {
        let mut locations: Vec<(Location, Value)> = Vec::with_capacity(rest.locations.len());
        for (location, value) in &rest.locations {
            let arguments = location.arguments.iter().map(&mut *of).collect();
            locations.push((Location { function: location.function, arguments }, of(value)));
        }
        locations.sort_unstable();
        let mut grown = Vec::with_capacity(rest.grown.len());
        for Grown { domain, count, elements } in &rest.grown {
            let mut elements: Vec<Value> = elements.iter().map(&mut *of).collect();
            elements.sort_unstable();
            grown.push(Grown { domain: *domain, count: *count, elements });
        }
        Rest { locations, grown }
    }

    fn rest_image(&self, rest: &Rest, permutation: &Permutation) -> Rest {
        self.rest_with(rest, &mut |value| self.value_image(value, permutation))
    }

    /// What a state becomes by a permutation.
    fn apply(&self, state: &[u64], permutation: &Permutation, encoding: &Encoding, view: &mut View) -> Box<[u64]> {
        let mut out: Box<[u64]> = state.into();
        for family in &self.families {
            for (from, field) in family.fields.iter().enumerate() {
                let (mut rest, mut to, mut stride) = (from, 0, 1);
                for class in family.coordinates.iter().rev() {
                    let images = &permutation.0[*class];
                    to += images[rest % images.len()] as usize * stride;
                    (rest, stride) = (rest / images.len(), stride * images.len());
                }
                let code = field.code(state);
                let code = match &family.held {
                    Held::Plain => code,
                    Held::Elements(which, codes) => match which.get(code as usize).copied().flatten() {
                        Some((class, at)) => u64::from(codes[class][permutation.0[class][at as usize] as usize]),
                        None => code,
                    },
                    Held::Deep => {
                        let value = encoding.value(*field, state, view);
                        let image = self.value_image(&value, permutation);
                        if image == value { code } else { u64::from(view.number(&image)) }
                    }
                };
                family.fields[to].put(code, &mut out);
            }
        }
        if let Some(field) = self.rest {
            let rest = view.rest(field.code(state) as u32);
            let image = self.rest_image(&rest, permutation);
            let code = if image == *rest { field.code(state) } else { u64::from(view.rest_number(&image.into())) };
            field.put(code, &mut out);
        }
        out
    }

    /// The order of two elements of a class by what a state says of them at a glance.
    fn glance(&self, class: usize, a: u32, b: u32, state: &[u64], view: &mut View) -> Ordering {
        let (a, b) = (a as usize, b as usize);
        for mark in &self.marks[class] {
            let order = match mark {
                Mark::Own(fields, numbered) => {
                    let (a, b) = (fields[a].code(state), fields[b].code(state));
                    match numbered {
                        true if a != b => view.value(a as u32).clone().cmp(view.value(b as u32)),
                        _ => a.cmp(&b),
                    }
                }
                Mark::Held(field, codes) => {
                    let code = field.code(state);
                    (u64::from(codes[a]) == code).cmp(&(u64::from(codes[b]) == code))
                }
            };
            if order.is_ne() {
                return order;
            }
        }
        Ordering::Equal
    }

    /// What a state says of an element where others are only known by their classes.
    fn profile(&self, class: usize, at: u32, state: &[u64], encoding: &Encoding, view: &mut View) -> Vec<Value> {
        let stand_in = |own: bool, class: usize| {
            Value::tuple(vec![Value::Boolean(own), Value::Integer(class as i64), Value::string("")])
        };
        let mut neutral = |value: &Value| self.image(value, &mut |place| Some(stand_in(place == (class, at), place.0)));
        let mut profile = Vec::new();
        for family in self.families.iter().filter(|family| family.is_deep()) {
            let first = profile.len();
            for (from, field) in family.fields.iter().enumerate() {
                let (mut rest, mut own) = (from, 0i64);
                for coordinate in family.coordinates.iter().rev() {
                    let len = self.classes[*coordinate].len();
                    own = own * 2 + i64::from((*coordinate, (rest % len) as u32) == (class, at));
                    rest /= len;
                }
                let value = encoding.value(*field, state, view);
                profile.push(Value::tuple(vec![Value::Integer(own), neutral(&value)]));
            }
            profile[first..].sort_unstable();
        }
        if let Some(field) = self.rest {
            let rest = self.rest_with(&view.rest(field.code(state) as u32), &mut neutral);
            for (location, value) in rest.locations {
                let arguments = Value::tuple(location.arguments.to_vec());
                profile.push(Value::tuple(vec![Value::Integer(location.function.0.into()), arguments, value]));
            }
            profile.extend(rest.grown.into_iter().map(|grown| Value::seq(grown.elements)));
        }
        profile
    }

    /// By class the elements in order, and where those of which the same is said begin and end.
    fn sorted(&self, state: &[u64], encoding: &Encoding, view: &mut View) -> (Vec<Vec<u32>>, Vec<Tie>) {
        let (mut orders, mut ties) = (Vec::with_capacity(self.classes.len()), Vec::new());
        for (class, elements) in self.classes.iter().enumerate() {
            let mut order: Vec<u32> = (0..elements.len() as u32).collect();
            order.sort_by(|a, b| self.glance(class, *a, *b, state, view));
            if self.is_deep {
                let mut begin = 0;
                for end in 1..=order.len() {
                    let same = |a, b, view: &mut View| self.glance(class, a, b, state, view).is_eq();
                    if end < order.len() && same(order[begin], order[end], view) {
                        continue;
                    }
                    self.sort_deeply(class, &mut order, (begin, end), state, encoding, view, &mut ties);
                    begin = end;
                }
            }
            orders.push(order);
        }
        (orders, ties)
    }

    #[allow(clippy::too_many_arguments, reason = "a part of the sorting that stands for itself")]
    fn sort_deeply(
        &self,
        class: usize,
        order: &mut [u32],
        (begin, end): (usize, usize),
        state: &[u64],
        encoding: &Encoding,
        view: &mut View,
        ties: &mut Vec<Tie>,
    ) {
        if end - begin < 2 {
            return;
        }
        let profiled = order[begin..end].iter().map(|at| (self.profile(class, *at, state, encoding, view), *at));
        let mut profiled: Vec<(Vec<Value>, u32)> = profiled.collect();
        profiled.sort_by(|a, b| a.0.cmp(&b.0));
        order[begin..end].iter_mut().zip(&profiled).for_each(|(at, (_, sorted))| *at = *sorted);
        let mut from = 0;
        for to in 1..=profiled.len() {
            if to < profiled.len() && profiled[to].0 == profiled[from].0 {
                continue;
            }
            if to - from > 1 {
                ties.push(Tie { class, begin: begin + from, end: begin + to });
            }
            from = to;
        }
    }

    fn normalised(&self, state: &[u64], encoding: &Encoding, view: &mut View) -> (Box<[u64]>, Permutation) {
        let (mut orders, mut ties) = self.sorted(state, encoding, view);
        // If no exchange of neighbours changes the state, no other order does.
        ties.retain(|Tie { class, begin, end }| {
            let mut neighbours = orders[*class][*begin..*end].windows(2);
            neighbours
                .any(|pair| *self.apply(state, &self.exchange(*class, pair[0], pair[1]), encoding, view) != *state)
        });
        let mut tried = 1;
        ties.retain(|Tie { begin, end, .. }| {
            let orders = (1..=end - begin).try_fold(tried, |product: usize, factor| product.checked_mul(factor));
            let few = orders.filter(|orders| *orders <= ORDERS);
            tried = few.unwrap_or(tried);
            few.is_some()
        });
        let permutation = |orders: &[Vec<u32>]| Permutation(orders.to_vec()).inverse();
        let mut best = permutation(&orders);
        let mut least = match best.is_identity() {
            true => state.into(),
            false => self.apply(state, &best, encoding, view),
        };
        while next_order(&mut orders, &ties) {
            let other = permutation(&orders);
            let image = self.apply(state, &other, encoding, view);
            if encoding.compare(&image, &least, view).is_lt() {
                (least, best) = (image, other);
            }
        }
        (least, best)
    }
}

/// Goes on to the next order of tied elements; false after the last.
fn next_order(orders: &mut [Vec<u32>], ties: &[Tie]) -> bool {
    for Tie { class, begin, end } in ties {
        let tied = &mut orders[*class][*begin..*end];
        // Take the next permutation in lexicographic order. After the last one, start over and advance the next tie.
        let Some(falls) = tied.windows(2).rposition(|pair| pair[0] < pair[1]) else {
            tied.sort_unstable();
            continue;
        };
        let with = tied.iter().rposition(|other| *other > tied[falls]).expect("the next is greater");
        tied.swap(falls, with);
        tied[falls + 1..].reverse();
        return true;
    }
    false
}

impl Family {
    /// Its fields hold more than marks tell.
    fn is_deep(&self) -> bool {
        !matches!((self.coordinates.len(), &self.held), (0 | 1, Held::Plain) | (0, Held::Elements(..)))
    }
}

impl Explorer {
    /// The orbits of the states under permutations of the elements of each class; none where states are packed so that these
    /// cannot be permuted. `holds` tells whether values of a function may be such elements, or have them inside.
    pub fn orbits(&self, classes: &[Vec<Value>], holds: &dyn Fn(FunctionId) -> bool) -> Option<Orbits> {
        Orbits::new(&self.encoding, &|location| self.machine.store().location(location), classes, holds)
    }

    /// The representative of a state, and the permutation that leads to it.
    pub fn normalised(&mut self, orbits: &Orbits, state: &[u64]) -> (Box<[u64]>, Permutation) {
        orbits.normalised(state, &self.encoding, &mut self.view)
    }

    /// Makes packed states their representatives.
    pub fn normalise(&mut self, orbits: &Orbits, states: &mut [u64]) {
        for state in states.chunks_exact_mut(self.encoding.words) {
            let (least, _) = orbits.normalised(state, &self.encoding, &mut self.view);
            state.copy_from_slice(&least);
        }
    }

    /// What a state becomes by a permutation.
    pub fn permuted(&mut self, orbits: &Orbits, state: &[u64], permutation: &Permutation) -> Box<[u64]> {
        orbits.apply(state, permutation, &self.encoding, &mut self.view)
    }

    /// Whether all locations of a function have a place of their own in the packed state.
    pub fn has_fields(&self, function: FunctionId) -> bool {
        self.encoding.has_fields(function)
    }
}
