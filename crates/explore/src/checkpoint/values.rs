//! Values as words, and back.
//!
//! In: values and locations of a program. Out: words; of words what they stand for, or that they are damaged. INVARIANT: what was written is
//! read as an equal value, and nothing is read that the program does not have.

use std::collections::BTreeMap;
use std::sync::Arc;

use machine::{Location, Real, Value, Weighed};
use model::{DomainId, FunctionId};
use program::{DomainKind, ProcedureId, Program};

use super::keeper::Refusal;

/// Words that are read one after the other.
#[derive(Debug)]
pub struct Words<'w>(&'w [u64]);

impl<'w> Words<'w> {
    /// These words.
    pub fn new(words: &'w [u64]) -> Words<'w> {
        Words(words)
    }

    /// The next word.
    ///
    /// # Errors
    /// There is none.
    pub fn word(&mut self) -> Result<u64, Refusal> {
        let (word, rest) = self.0.split_first().ok_or(Refusal::Damaged)?;
        self.0 = rest;
        Ok(*word)
    }

    /// The next word, if it is a number of this type.
    ///
    /// # Errors
    /// It is not.
    pub fn number<T: TryFrom<u64>>(&mut self) -> Result<T, Refusal> {
        T::try_from(self.word()?).map_err(|_| Refusal::Damaged)
    }

    /// The next word, if it names one of so many things.
    ///
    /// # Errors
    /// It does not.
    pub fn below(&mut self, count: usize) -> Result<u32, Refusal> {
        let number: u32 = self.number()?;
        if (number as usize) < count { Ok(number) } else { Err(Refusal::Damaged) }
    }

    /// How many things follow, each of at least one word.
    ///
    /// # Errors
    /// There are not that many words.
    fn count(&mut self) -> Result<usize, Refusal> {
        let count: usize = self.number()?;
        if count <= self.0.len() { Ok(count) } else { Err(Refusal::Damaged) }
    }

    /// As many things as the next word says, each read by `one`.
    ///
    /// # Errors
    /// One of them cannot be read.
    pub fn many<T, C: FromIterator<T>>(
        &mut self,
        mut one: impl FnMut(&mut Words<'w>) -> Result<T, Refusal>,
    ) -> Result<C, Refusal> {
        (0..self.count()?).map(|_| one(self)).collect()
    }

    /// The next so many words.
    ///
    /// # Errors
    /// There are not that many.
    pub fn take(&mut self, count: usize) -> Result<&'w [u64], Refusal> {
        let (taken, rest) = self.0.split_at_checked(count).ok_or(Refusal::Damaged)?;
        self.0 = rest;
        Ok(taken)
    }

    /// A text.
    ///
    /// # Errors
    /// It is none.
    pub fn text(&mut self) -> Result<String, Refusal> {
        let len: usize = self.number()?;
        let bytes = self.take(len.div_ceil(8))?.iter().flat_map(|word| word.to_le_bytes());
        String::from_utf8(bytes.take(len).collect()).map_err(|_| Refusal::Damaged)
    }

    /// That nothing follows.
    ///
    /// # Errors
    /// Something does.
    pub fn end(&self) -> Result<(), Refusal> {
        if self.0.is_empty() { Ok(()) } else { Err(Refusal::Damaged) }
    }
}

/// Writes a text.
pub fn write_text(words: &mut Vec<u64>, text: &str) {
    words.push(text.len() as u64);
    words.extend(text.as_bytes().chunks(8).map(|bytes| {
        let mut word = [0; 8];
        word[..bytes.len()].copy_from_slice(bytes);
        u64::from_le_bytes(word)
    }));
}

/// What the values of a program are known by.
#[derive(Debug, Clone, Copy)]
pub struct Known<'p>(pub &'p Program);

/// What kind of value follows.
const UNDEF: u64 = 0;
const BOOLEAN: u64 = 1;
const INTEGER: u64 = 2;
const REAL: u64 = 3;
const ENUM: u64 = 4;
const ELEMENT: u64 = 5;
const CHAR: u64 = 6;
const RULE: u64 = 7;
const COMPLEX: u64 = 8;
const STRING: u64 = 9;
const TUPLE: u64 = 10;
const SEQ: u64 = 11;
const SET: u64 = 12;
const BAG: u64 = 13;
const MAP: u64 = 14;

/// Values may be nested deeply.
fn deeply<R>(body: impl FnOnce() -> R) -> R {
    stacker::maybe_grow(1 << 18, 4 << 20, body)
}

/// Writes a value.
pub fn write_value(words: &mut Vec<u64>, value: &Value) {
    deeply(|| match value {
        Value::Undef => words.push(UNDEF),
        Value::Boolean(is_true) => words.extend([BOOLEAN, u64::from(*is_true)]),
        Value::Integer(integer) => words.extend([INTEGER, integer.cast_unsigned()]),
        Value::Real(real) => words.extend([REAL, real.get().to_bits()]),
        Value::Enum(domain, place) => words.extend([ENUM, domain.0.into(), (*place).into()]),
        Value::Element(domain, number) => words.extend([ELEMENT, domain.0.into(), (*number).into()]),
        Value::Char(char) => words.extend([CHAR, u32::from(*char).into()]),
        Value::Rule(procedure) => words.extend([RULE, procedure.0.into()]),
        Value::Complex(parts) => words.extend([COMPLEX, parts.0.get().to_bits(), parts.1.get().to_bits()]),
        Value::String(text) => {
            words.push(STRING);
            write_text(words, text);
        }
        Value::Tuple(items) => write_items(words, TUPLE, items),
        Value::Seq(items) => write_items(words, SEQ, items),
        Value::Set(items) => write_items(words, SET, items),
        Value::Bag(counts) => {
            words.extend([BAG, counts.len() as u64]);
            for (element, count) in counts.iter() {
                write_value(words, element);
                words.push(*count);
            }
        }
        Value::Map(entries) => {
            words.extend([MAP, entries.len() as u64]);
            for (key, value) in entries.iter() {
                write_value(words, key);
                write_value(words, value);
            }
        }
    });
}

fn write_items(words: &mut Vec<u64>, kind: u64, items: &[Value]) {
    words.push(kind);
    write_values(words, items);
}

/// Writes how many values there are, and each.
pub fn write_values(words: &mut Vec<u64>, values: &[Value]) {
    words.push(values.len() as u64);
    values.iter().for_each(|value| write_value(words, value));
}

/// Writes a location.
pub fn write_location(words: &mut Vec<u64>, location: &Location) {
    words.push(location.function.0.into());
    write_values(words, &location.arguments);
}

impl Known<'_> {
    /// The value that was written.
    ///
    /// # Errors
    /// The words are none.
    pub fn value(self, words: &mut Words<'_>) -> Result<Value, Refusal> {
        deeply(|| {
            Ok(match words.word()? {
                UNDEF => Value::Undef,
                BOOLEAN => Value::Boolean(words.below(2)? == 1),
                INTEGER => Value::Integer(words.word()?.cast_signed()),
                REAL => Value::Real(real(words)?),
                ENUM => {
                    let domain = self.domain(words)?;
                    match &self.0.domains[domain.0 as usize].kind {
                        DomainKind::Enum { literals } => Value::Enum(domain, words.below(literals.len())?),
                        _ => return Err(Refusal::Damaged),
                    }
                }
                ELEMENT => {
                    let domain = self.domain(words)?;
                    match &self.0.domains[domain.0 as usize].kind {
                        DomainKind::Abstract { .. } => Value::Element(domain, words.number()?),
                        _ => return Err(Refusal::Damaged),
                    }
                }
                CHAR => Value::Char(char::from_u32(words.number()?).ok_or(Refusal::Damaged)?),
                RULE => Value::Rule(ProcedureId(words.below(self.0.procedures.len())?)),
                COMPLEX => Value::Complex(Arc::new((real(words)?, real(words)?))),
                STRING => Value::string(words.text()?),
                TUPLE => Value::tuple(self.values(words)?),
                SEQ => Value::seq(self.values(words)?),
                SET => Value::set(self.values(words)?),
                BAG => {
                    let mut counts = BTreeMap::new();
                    for _ in 0..words.count()? {
                        let (element, count) = (self.value(words)?, words.word()?);
                        if count == 0 || counts.insert(element, count).is_some() {
                            return Err(Refusal::Damaged);
                        }
                    }
                    Value::Bag(Arc::new(Weighed::new(counts)))
                }
                MAP => {
                    let entries: Vec<_> = words.many(|words| Ok((self.value(words)?, self.value(words)?)))?;
                    Value::map(entries)
                }
                _ => return Err(Refusal::Damaged),
            })
        })
    }

    /// As many values as were written.
    ///
    /// # Errors
    /// The words are none.
    pub fn values(self, words: &mut Words<'_>) -> Result<Vec<Value>, Refusal> {
        words.many(|words| self.value(words))
    }

    /// The location that was written.
    ///
    /// # Errors
    /// The words are none.
    pub fn location(self, words: &mut Words<'_>) -> Result<Location, Refusal> {
        Ok(Location { function: self.function(words)?, arguments: self.values(words)? })
    }

    /// A function.
    ///
    /// # Errors
    /// There is none of this number.
    pub fn function(self, words: &mut Words<'_>) -> Result<FunctionId, Refusal> {
        Ok(FunctionId(words.below(self.0.functions.len())?))
    }

    /// A domain.
    ///
    /// # Errors
    /// There is none of this number.
    pub fn domain(self, words: &mut Words<'_>) -> Result<DomainId, Refusal> {
        Ok(DomainId(words.below(self.0.domains.len())?))
    }
}

fn real(words: &mut Words<'_>) -> Result<Real, Refusal> {
    Real::new(f64::from_bits(words.word()?)).ok_or(Refusal::Damaged)
}
