//! Sequences and sets packed in place: their elements by codes, in the bits of one field.
//!
//! In: the elements that a collection may have, a value. Out: its code, and back; and where in the code the pieces of it stand that
//! a step can look at or change by themselves. A sequence has its first element lowest and its length on top, a set one
//! bit for each element. How long a sequence may be is found by the search: a longer one does not fit, and the next packing
//! has room for it ([`crate::packed::room`]). INVARIANT: two values are equal exactly when their codes are; places beyond the length are 0.

use std::sync::Arc;

use machine::{Edit, Piece, Value};

use crate::packed::words::{Field, Overwrite};

/// LIMIT: a collection that needs more bits gets a number. In a state of one word the highest bit belongs to the table.
const BITS: usize = 63;

/// Why a value has no code.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Misfit {
    /// It needs room for so many elements.
    Longer(usize),
    /// It is no collection of these elements.
    Foreign,
}

/// Whether a collection is a sequence, and of how many elements at most, or a set.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Shape {
    Sequence { capacity: usize, bits: usize },
    Set,
}

/// The collections of some elements.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(crate) struct Collection {
    /// Sorted.
    elements: Arc<Vec<Value>>,
    shape: Shape,
}

fn bits_for(count: usize) -> usize {
    (usize::BITS - count.saturating_sub(1).leading_zeros()) as usize
}

impl Collection {
    /// The sets of these elements, if there is room.
    pub fn sets(elements: Vec<Value>) -> Option<Collection> {
        let fits = !elements.is_empty() && elements.len() <= BITS;
        fits.then(|| Collection { elements: Arc::new(elements), shape: Shape::Set })
    }

    /// The sequences of these elements that are so long at most, if there is room.
    pub fn sequences(elements: Vec<Value>, longest: usize) -> Option<Collection> {
        let bits = bits_for(elements.len());
        (!elements.is_empty()).then(|| Collection::of_length(Arc::new(elements), bits, longest.max(1))).flatten()
    }

    fn of_length(elements: Arc<Vec<Value>>, bits: usize, capacity: usize) -> Option<Collection> {
        let fits = capacity <= BITS && capacity * bits + bits_for(capacity + 1) <= BITS;
        fits.then_some(Collection { elements, shape: Shape::Sequence { capacity, bits } })
    }

    /// The same with sequences that are longer by one, if there is room.
    pub fn longer(&self) -> Option<Collection> {
        match self.shape {
            Shape::Sequence { capacity, bits } => Collection::of_length(Arc::clone(&self.elements), bits, capacity + 1),
            Shape::Set => None,
        }
    }

    /// Whether these are sequences.
    pub fn is_sequence(&self) -> bool {
        matches!(self.shape, Shape::Sequence { .. })
    }

    /// How many bits its codes have.
    pub fn bits(&self) -> usize {
        match self.shape {
            Shape::Sequence { capacity, bits } => capacity * bits + bits_for(capacity + 1),
            Shape::Set => self.elements.len(),
        }
    }

    fn code_of(&self, element: &Value) -> Result<u64, Misfit> {
        self.elements.binary_search(element).map(|code| code as u64).map_err(|_| Misfit::Foreign)
    }

    /// The code of a value.
    pub fn code(&self, value: &Value) -> Result<u64, Misfit> {
        match (self.shape, value) {
            (Shape::Sequence { capacity, bits }, Value::Seq(items)) => {
                if items.len() > capacity {
                    return Err(Misfit::Longer(items.len()));
                }
                let mut code = (items.len() as u64) << (capacity * bits);
                for (position, element) in items.iter().enumerate() {
                    code |= self.code_of(element)? << (position * bits);
                }
                Ok(code)
            }
            (Shape::Set, Value::Set(items)) => {
                items.iter().try_fold(0, |code, element| Ok(code | 1 << self.code_of(element)?))
            }
            (Shape::Sequence { .. } | Shape::Set, _) => Err(Misfit::Foreign),
        }
    }

    /// The value of a code.
    pub fn value(&self, code: u64) -> Value {
        match self.shape {
            Shape::Sequence { capacity, bits } => {
                let length = code >> (capacity * bits);
                let element = |position: u64| (code >> (position as usize * bits) & ((1 << bits) - 1)) as usize;
                Value::seq((0..length).map(|position| self.elements[element(position)].clone()).collect())
            }
            Shape::Set => {
                let is_in = |place: &usize| code >> place & 1 == 1;
                Value::set((0..self.elements.len()).filter(is_in).map(|place| self.elements[place].clone()).collect())
            }
        }
    }

    /// The pieces of a collection that stands in a field: of a sequence its length, then its elements; of a set its members.
    pub fn pieces(&self, field: Field) -> Vec<Field> {
        let piece = |at: usize, bits: usize| Field { shift: field.shift + at as u8, bits: bits as u8, ..field };
        match self.shape {
            Shape::Sequence { capacity, bits } => {
                let length = piece(capacity * bits, bits_for(capacity + 1));
                std::iter::once(length).chain((0..capacity).map(|position| piece(position * bits, bits))).collect()
            }
            Shape::Set => (0..self.elements.len()).map(|place| piece(place, 1)).collect(),
        }
    }

    /// Which of [`Collection::pieces`] it is; none where no value could say otherwise.
    pub fn place(&self, piece: Piece<'_>) -> Option<usize> {
        match (self.shape, piece) {
            (Shape::Sequence { .. }, Piece::Length) => Some(0),
            (Shape::Sequence { capacity, .. }, Piece::Element(position)) => {
                Some(1 + position).filter(|_| position < capacity)
            }
            (Shape::Set, Piece::Member(element)) => self.elements.binary_search(element).ok(),
            (Shape::Sequence { .. }, Piece::Member(_)) | (Shape::Set, Piece::Length | Piece::Element(_)) => {
                unreachable!("a piece of another collection")
            }
        }
    }

    /// What an edit overwrites in a field that holds a collection, of which it is known how long it is.
    pub fn overwrites(&self, edit: &Edit, field: Field, words: &[u64]) -> Result<Overwrite, Misfit> {
        let pieces = self.pieces(field);
        let word = field.word;
        let plain = |clear: u64, set: u64| Overwrite { word, clear, set, from: 0, turn: 0 };
        let (capacity, bits) = match (self.shape, edit) {
            (Shape::Set, Edit::Include(element)) => {
                let mask = pieces[self.code_of(element)? as usize].mask();
                return Ok(plain(mask, mask));
            }
            (Shape::Set, Edit::Exclude(element)) => {
                // What it cannot have it has not.
                let mask = self.code_of(element).map_or(0, |code| pieces[code as usize].mask());
                return Ok(plain(mask, 0));
            }
            (Shape::Sequence { capacity, bits }, _) => (capacity, bits),
            (Shape::Set, Edit::Append(_) | Edit::Prepend(_) | Edit::Tail) => return Err(Misfit::Foreign),
        };
        let length = pieces[0].code(words) as usize;
        let length_is = |length: usize| (length as u64) << pieces[0].shift;
        let (top, first) = (pieces[0].mask(), u32::from(field.shift));
        let all = field.mask() & !top;
        let room = |length: usize| if length > capacity { Err(Misfit::Longer(length)) } else { Ok(()) };
        match edit {
            Edit::Append(element) => {
                room(length + 1)?;
                let place = pieces[1 + length];
                let set = self.code_of(element)? << place.shift;
                Ok(plain(top | place.mask(), length_is(length + 1) | set))
            }
            Edit::Prepend(element) => {
                room(length + 1)?;
                let set = self.code_of(element)? << first;
                // The last place is empty.
                let from = all & !pieces[capacity].mask();
                let turn = (64 - bits as u32) as u8 % 64;
                Ok(Overwrite { word, clear: field.mask(), set: length_is(length + 1) | set, from, turn })
            }
            Edit::Tail => {
                let from = all & !pieces[1].mask();
                let set = length_is(length.checked_sub(1).ok_or(Misfit::Foreign)?);
                Ok(Overwrite { word, clear: field.mask(), set, from, turn: bits as u8 })
            }
            Edit::Include(_) | Edit::Exclude(_) => Err(Misfit::Foreign),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::packed::words::apply;
    use program::FunctionId;

    fn integers(range: std::ops::Range<i64>) -> Vec<Value> {
        range.map(Value::Integer).collect()
    }

    /// Each sequence of up to `most` of these elements.
    fn sequences(elements: &[Value], most: usize) -> Vec<Vec<Value>> {
        let mut all = vec![Vec::new()];
        let mut from = 0;
        for _ in 0..most {
            let to = all.len();
            for index in from..to {
                for element in elements {
                    let mut longer = all[index].clone();
                    longer.push(element.clone());
                    all.push(longer);
                }
            }
            from = to;
        }
        all
    }

    /// An edit of the packed value is the packed value of the edited one, and nothing else in the word changes.
    fn check(collection: &Collection, before: &Value, edit: &Edit, after: &Value, shift: u8) {
        let field =
            Field { location: 0, function: FunctionId(0), word: 0, shift, bits: collection.bits() as u8, few: false };
        let around = !field.mask() & 0xdead_beef_cafe_f00d;
        let mut words = [around];
        field.put(collection.code(before).unwrap(), &mut words);
        let overwrite = collection.overwrites(edit, field, &words);
        if let Err(Misfit::Longer(length)) = collection.code(after) {
            assert_eq!(overwrite, Err(Misfit::Longer(length)));
            return;
        }
        apply(&[overwrite.unwrap()], &mut words);
        assert_eq!(field.code(&words), collection.code(after).unwrap(), "{before:?} by {edit:?}");
        assert_eq!(words[0] & !field.mask(), around);
    }

    #[test]
    fn edits_of_sequences_are_those_of_values() {
        for count in 1..4 {
            let elements = integers(0..count);
            let collection = Collection::sequences(elements.clone(), 3).unwrap();
            for sequence in sequences(&elements, 3) {
                let value = Value::seq(sequence.clone());
                assert_eq!(collection.value(collection.code(&value).unwrap()), value);
                for shift in [0, 5, 64 - collection.bits() as u8] {
                    for element in &elements {
                        let longer = [sequence.clone(), vec![element.clone()]].concat();
                        check(&collection, &value, &Edit::Append(element.clone()), &Value::seq(longer), shift);
                        let longer = [vec![element.clone()], sequence.clone()].concat();
                        check(&collection, &value, &Edit::Prepend(element.clone()), &Value::seq(longer), shift);
                    }
                    if let Some(rest) = sequence.get(1..) {
                        check(&collection, &value, &Edit::Tail, &Value::seq(rest.to_vec()), shift);
                    }
                }
            }
        }
    }

    #[test]
    fn edits_of_sets_are_those_of_values() {
        let elements = integers(3..7);
        let collection = Collection::sets(elements.clone()).unwrap();
        for code in 0..16 {
            let value = collection.value(code);
            assert_eq!(collection.code(&value), Ok(code));
            let Value::Set(items) = &value else { panic!("a set") };
            for element in &elements {
                let with = Value::set(items.iter().chain([element]).cloned().collect());
                check(&collection, &value, &Edit::Include(element.clone()), &with, 9);
                let without = Value::set(items.iter().filter(|item| *item != element).cloned().collect());
                check(&collection, &value, &Edit::Exclude(element.clone()), &without, 9);
            }
            check(&collection, &value, &Edit::Exclude(Value::Undef), &value, 9);
        }
    }

    #[test]
    fn what_does_not_fit_has_no_code() {
        let sequences = Collection::sequences(integers(0..3), 2).unwrap();
        let seq = |numbers: &[i64]| Value::seq(numbers.iter().map(|number| Value::Integer(*number)).collect());
        assert_eq!(sequences.code(&seq(&[0, 1, 2])), Err(Misfit::Longer(3)));
        assert_eq!(sequences.code(&seq(&[0, 3])), Err(Misfit::Foreign));
        assert_eq!(sequences.code(&Value::seq(vec![Value::Undef])), Err(Misfit::Foreign));
        assert_eq!(sequences.code(&Value::Undef), Err(Misfit::Foreign));
        let sets = Collection::sets(integers(0..3)).unwrap();
        assert_eq!(sets.code(&Value::set(vec![Value::Integer(7)])), Err(Misfit::Foreign));
        assert_eq!(Collection::sets(integers(0..64)), None);
        // Fifteen elements of four bits and a length of four are too many; fourteen are not.
        assert_eq!(Collection::sequences(integers(0..16), 15), None);
        assert_eq!(Collection::sequences(integers(0..16), 14).map(|fits| fits.bits()), Some(60));
    }
}
