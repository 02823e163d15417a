//! How deep the cursor is, and which constructs wait for their end.

use super::Parser;
use crate::SyntaxKind;
use crate::fault::Found;
use crate::limit::MAX_NESTING;

/// A construct that waits for its end.
#[derive(Debug, Clone, Copy)]
pub(super) struct Open<'t> {
    /// The token that ends it.
    end: SyntaxKind,
    /// The index of the token that opened it.
    pub(super) opener: usize,
    /// That token.
    found: Found<'t>,
}

/// Depth.
impl Parser<'_> {
    /// Goes one construct deeper; gives `false` when that is too deep.
    pub(crate) fn enter(&mut self) -> bool {
        self.depth += 1;
        self.deepest = self.deepest.max(self.depth);
        self.depth <= MAX_NESTING
    }

    pub(crate) fn leave(&mut self) {
        self.depth -= 1;
    }

    /// Starts to measure the depth of a subtree; the result goes back by [`Parser::restore_deepest`].
    pub(crate) fn take_deepest(&mut self) -> usize {
        std::mem::replace(&mut self.deepest, self.depth)
    }

    pub(crate) fn restore_deepest(&mut self, outside: usize) {
        self.deepest = self.deepest.max(outside);
    }

    /// The depth of the subtree with one more operator on top of it.
    pub(crate) fn lift_deepest(&mut self) -> usize {
        self.deepest += 1;
        self.deepest
    }
}

/// Ends.
impl<'t> Parser<'t> {
    /// Takes the token that opens a construct which `end` ends.
    pub(crate) fn bump_opener(&mut self, end: SyntaxKind) {
        self.bump_opener_as(self.current(), end);
    }

    /// Takes the token that opens a construct, a contextual keyword.
    pub(crate) fn bump_opener_as(&mut self, kind: SyntaxKind, end: SyntaxKind) {
        self.open.push(Open { end, opener: self.at, found: self.found() });
        self.bump_as(kind);
    }

    /// The innermost construct: its end, and the token that opened it.
    pub(crate) fn innermost(&self) -> Option<(SyntaxKind, Found<'t>)> {
        self.open.last().map(|open| (open.end, open.found))
    }

    /// Takes the end of the innermost construct, and notes if it is not below the beginning.
    pub(crate) fn bump_end(&mut self) {
        let Some(open) = self.open.pop() else { return };
        if let (Some(first), Some(last)) = (self.indentation(open.opener), self.indentation(self.at))
            && first != last
        {
            self.crooked.push(open);
        }
        self.bump();
    }

    /// Closes the innermost construct without its end. Gives the opener of a construct within it whose end is likely
    /// the missing one.
    pub(crate) fn close(&mut self) -> Option<Found<'t>> {
        let within = self.crooked_within_innermost();
        self.open.pop();
        within
    }

    /// A construct within the innermost one, of the same kind, whose end does not stand below its beginning.
    pub(crate) fn crooked_within_innermost(&self) -> Option<Found<'t>> {
        let around = self.open.last().filter(|_| !self.has_enough_faults())?;
        let within = self.crooked.iter().find(|open| open.end == around.end && open.opener > around.opener);
        within.map(|open| open.found)
    }

    /// How many enclosing constructs wait for this end.
    pub(crate) fn awaiting(&self, end: SyntaxKind) -> usize {
        self.open.iter().filter(|open| open.end == end).count()
    }

    /// An enclosing construct waits for this end.
    pub(crate) fn is_awaited(&self, end: SyntaxKind) -> bool {
        self.open.iter().any(|open| open.end == end)
    }
}
