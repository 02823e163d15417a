//! The operators of the CTL and LTL libraries: one row for each.
//!
//! In: nothing. Out: the enumeration [`TemporalOperator`] and what is known of each. Their meaning is left to code that
//! looks at runs.

use Logic::{Branching, Linear};

/// Which kind of formula an operator belongs to.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Logic {
    /// CTL.
    Branching,
    /// LTL.
    Linear,
}

/// `Variant: the names it is declared under, how many formulas it takes, its logic;`
macro_rules! operators {
    ($($variant:ident: [$($declared:literal),+], $arity:literal, $logic:expr;)*) => {
        /// An operator of the CTL or LTL library.
        #[allow(missing_docs, reason = "each is described in spec/standard-library.md under its AsmetaL name")]
        #[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
        pub enum TemporalOperator {
            $($variant,)*
        }

        impl TemporalOperator {
            /// All of them.
            pub const ALL: &[TemporalOperator] = &[$(TemporalOperator::$variant),*];

            /// The names that the library declares it under.
            pub(crate) fn declared(self) -> &'static [&'static str] {
                match self {
                    $(TemporalOperator::$variant => &[$($declared),+],)*
                }
            }

            /// The name that formulas are written with.
            pub fn name(self) -> &'static str {
                self.declared()[0]
            }

            /// How many arguments it takes.
            pub fn arity(self) -> usize {
                match self {
                    $(TemporalOperator::$variant => $arity,)*
                }
            }

            /// An operator of the CTL library; the others are of LTL.
            pub fn is_ctl(self) -> bool {
                let logic = match self {
                    $(TemporalOperator::$variant => $logic,)*
                };
                logic == Branching
            }
        }
    };
}

operators! {
    // CTL: E exists a path, A on all paths; G globally, X next, F finally, U until, W weak until, N after n steps
    Eg:                ["eg"],                1, Branching;
    Ex:                ["ex"],                1, Branching;
    Ef:                ["ef"],                1, Branching;
    Ag:                ["ag"],                1, Branching;
    Ax:                ["ax"],                1, Branching;
    Af:                ["af"],                1, Branching;
    Eu:                ["eu", "e"],           2, Branching;
    Au:                ["au", "a"],           2, Branching;
    Ew:                ["ew"],                2, Branching;
    Aw:                ["aw"],                2, Branching;
    ExN:               ["exN"],               2, Branching;
    AxN:               ["axN"],               2, Branching;
    // Patterns of CTL: absence of P globally, before R, after Q, between Q and R, after Q until R
    AbsenceGlobally:   ["absenceG"],          1, Branching;
    AbsenceBefore:     ["absenceBefore"],     2, Branching;
    AbsenceAfter:      ["absenceAfter"],      2, Branching;
    AbsenceBetween:    ["absenceBetween"],    3, Branching;
    AbsenceAfterUntil: ["absenceAfterUntil"], 3, Branching;
    // Patterns of CTL: S precedes P globally, before R; arguments (P, S) and (P, S, R)
    Precedence:        ["ap"],                2, Branching;
    PrecedenceBefore:  ["pb"],                3, Branching;
    // LTL, future: x g f u v
    Next:              ["x"],                 1, Linear;
    Globally:          ["g"],                 1, Linear;
    Finally:           ["f"],                 1, Linear;
    Until:             ["u"],                 2, Linear;
    Releases:          ["v"],                 2, Linear;
    // LTL, past: y z h o s t
    Previous:          ["y"],                 1, Linear;
    WeakPrevious:      ["z"],                 1, Linear;
    Historically:      ["h"],                 1, Linear;
    Once:              ["o"],                 1, Linear;
    Since:             ["s"],                 2, Linear;
    Triggered:         ["t"],                 2, Linear;
}
