//! Sequences and sets of which a step looks at a piece, or changes one, when every alternative is wanted.
//!
//! An explorer may keep the collection in a location piece by piece: a sequence as its length and its elements, a set as one
//! truth value for each element that it may have. A term such as `length(f)` or `contains(f, x)` then looks at a piece of it
//! alone, and `f := append(f, x)` changes it whatever else is in it. In: terms and rules of these forms, and from
//! [`crate::Alternatives`] which functions are kept so. Out: the same values and updates as elsewhere; what was noted says less
//! of the state. INVARIANT: a piece is that of the state before the step: where a `seq` has overwritten the location, all of it is
//! looked at. A location that is written twice is looked at as well, since the values may clash.
//! LIMIT: how much work an operation takes may depend on pieces that it did not look at, by a few units.

use program::{Builtin, FunctionId, Rule, RuleId, Term, TermId, TermList};

use crate::execute::{Executor, Outcome};
use crate::layout::LocationIndex;
use crate::piece::{Edit, Piece};
use crate::value::Value;

/// Which operand of a builtin is the collection that it looks at a piece of.
fn looks_at_piece(builtin: Builtin) -> bool {
    use Builtin::{First, Last, SeqAt, SeqIsEmpty, SeqLength, SetContains, SetNotIn};
    matches!(builtin, SeqLength | SeqIsEmpty | First | Last | SeqAt | SetContains | SetNotIn)
}

/// The collection and the other operand of a builtin that changes a piece.
fn edited(builtin: Builtin, operands: &[TermId]) -> Option<(TermId, Option<TermId>)> {
    match (builtin, operands) {
        (Builtin::Append | Builtin::SetIncluding | Builtin::SetExcluding, [from, element])
        | (Builtin::Prepend, [element, from]) => Some((*from, Some(*element))),
        (Builtin::Tail, [from]) => Some((*from, None)),
        _ => None,
    }
}

impl<'a> Executor<'a> {
    /// The function and arguments of a term that reads a location which is kept in pieces.
    fn read_in_pieces(&mut self, term: TermId) -> Option<(FunctionId, TermList)> {
        let Term::Read { function, arguments } = self.program.term(term) else { return None };
        let alternatives = self.environment.alternatives()?;
        alternatives.keeps_pieces(*function).then_some((*function, *arguments))
    }

    /// The location, if its value is that of the state before the step.
    fn untouched(&self, function: FunctionId, arguments: &[Value]) -> Option<LocationIndex> {
        let index = self.core.store.find(function, arguments)?;
        let core = &self.core;
        let value = &core.store.values[index as usize];
        let is_there = matches!(value, Value::Seq(_) | Value::Set(_));
        (is_there && !core.updates.has_overwritten(index)).then_some(index)
    }

    /// The value of a builtin that looks at a piece of what a location holds; none where it is none of these.
    #[cold]
    pub fn evaluate_piece(&mut self, builtin: Builtin, operands: &'a [TermId], id: TermId) -> Outcome<Option<Value>> {
        let Some(from) = operands.first().filter(|_| looks_at_piece(builtin)) else { return Ok(None) };
        let Some((function, arguments)) = self.read_in_pieces(*from) else { return Ok(None) };
        let arguments = self.evaluate_all(arguments)?;
        let found = self.untouched(function, &arguments);
        let value = match found {
            Some(index) => self.core.store.values[index as usize].clone(),
            None => self.read(function, &arguments, self.program.term_span(*from))?,
        };
        let mut values = vec![value];
        for operand in &operands[1..] {
            let value = self.evaluate(*operand)?;
            values.push(value);
        }
        if let Some(index) = found {
            self.note_pieces(builtin, index, &values);
        }
        self.apply(builtin, &values, id).map(Some)
    }

    fn note_pieces(&mut self, builtin: Builtin, index: LocationIndex, operands: &[Value]) {
        let Some(alternatives) = self.environment.alternatives() else { return };
        match (&operands[0], &operands[1..]) {
            (Value::Seq(items), others) => {
                alternatives.look_at_piece(index, Piece::Length);
                let position = match (builtin, others) {
                    (Builtin::First, _) => Some(0),
                    (Builtin::Last, _) => items.len().checked_sub(1),
                    (Builtin::SeqAt, [Value::Integer(position)]) => usize::try_from(*position).ok(),
                    _ => None,
                };
                if let Some(position) = position.filter(|position| *position < items.len()) {
                    alternatives.look_at_piece(index, Piece::Element(position));
                }
            }
            (_, [element]) => alternatives.look_at_piece(index, Piece::Member(element)),
            _ => {}
        }
    }

    /// Runs an update rule that changes a piece of what its location holds; false where it is none of these.
    #[cold]
    pub fn perform_edit(&mut self, id: RuleId) -> Outcome<bool> {
        let program = self.program;
        let Rule::Update { function, arguments: target, value: term } = program.rule(id) else { return Ok(false) };
        let Term::Builtin { builtin, arguments } = program.term(*term) else { return Ok(false) };
        let operands = program.term_list(*arguments);
        let Some((from, element)) = edited(*builtin, operands) else { return Ok(false) };
        let Some((read, arguments)) = self.read_in_pieces(from).filter(|(read, _)| read == function) else {
            return Ok(false);
        };
        // Operands are evaluated from the left.
        let first = operands[0] != from;
        let mut other = if first { element.map(|element| self.evaluate(element)).transpose()? } else { None };
        let arguments = self.evaluate_all(arguments)?;
        let found = self.untouched(read, &arguments);
        let value = match found {
            Some(index) => self.core.store.values[index as usize].clone(),
            None => self.read(read, &arguments, program.term_span(from))?,
        };
        if !first {
            other = element.map(|element| self.evaluate(element)).transpose()?;
        }
        if let (Some(index), Value::Seq(_)) = (found, &value)
            && let Some(alternatives) = self.environment.alternatives()
        {
            alternatives.look_at_piece(index, Piece::Length);
        }
        let edit = match (builtin, other.clone()) {
            (Builtin::Append, Some(element)) => Edit::Append(element),
            (Builtin::Prepend, Some(element)) => Edit::Prepend(element),
            (Builtin::SetIncluding, Some(element)) => Edit::Include(element),
            (Builtin::SetExcluding, Some(element)) => Edit::Exclude(element),
            _ => Edit::Tail,
        };
        let operands: Vec<Value> = match first {
            true => other.into_iter().chain([value]).collect(),
            false => std::iter::once(value).chain(other).collect(),
        };
        let value = self.apply(*builtin, &operands, *term)?;
        let start = self.gather(*target)?;
        let written = self.core.store.find(*function, &self.core.frames[start..]);
        let edit = Some(edit).filter(|_| found.is_some() && written == found);
        if edit.is_none() && found.is_some() {
            // What is written elsewhere is all of it.
            self.note_look(read, found);
        }
        self.update(*function, start, (value, edit), id)?;
        Ok(true)
    }
}
