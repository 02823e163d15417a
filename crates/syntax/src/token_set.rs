//! A set of token kinds as a bit mask, made at compile time.
//!
//! In: kinds. Out: membership in constant time. INVARIANT: it holds only token kinds, whose numbers lie below 192;
//! otherwise the constructor's index check fails at compile time.

use crate::SyntaxKind;

/// A set of token kinds.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) struct TokenSet([u64; 3]);

impl TokenSet {
    pub(crate) const fn new(kinds: &[SyntaxKind]) -> TokenSet {
        let mut bits = [0; 3];
        let mut at = 0;
        while at < kinds.len() {
            let kind = kinds[at] as usize;
            bits[kind / 64] |= 1 << (kind % 64);
            at += 1;
        }
        TokenSet(bits)
    }

    pub(crate) const fn union(self, other: TokenSet) -> TokenSet {
        TokenSet([self.0[0] | other.0[0], self.0[1] | other.0[1], self.0[2] | other.0[2]])
    }

    pub(crate) const fn contains(&self, kind: SyntaxKind) -> bool {
        let kind = kind as usize;
        kind < 192 && self.0[kind / 64] & (1 << (kind % 64)) != 0
    }
}
