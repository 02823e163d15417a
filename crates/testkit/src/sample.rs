//! How many random cases a test tries, and from which seed on.
//!
//! In: the environment. `GROUNDSTATE_CASES` says how many, `GROUNDSTATE_SEED` where to begin; with `GROUNDSTATE_FULL`, as in
//! `make full`, it is the larger of a test's two numbers. Out: seeds. INVARIANT: without any of them the cases are always the same.

use std::ops::Range;

/// The number in an environment variable.
pub fn setting(name: &str, default: u64) -> u64 {
    std::env::var(name).ok().and_then(|text| text.parse().ok()).unwrap_or(default)
}

/// Whether all of what is slow is wanted.
pub fn is_full() -> bool {
    std::env::var_os("GROUNDSTATE_FULL").is_some()
}

/// The seeds of so many cases: a few, or as many as the full campaign has.
pub fn seeds(few: u64, full: u64) -> Range<u64> {
    let first = setting("GROUNDSTATE_SEED", 1);
    first..first + setting("GROUNDSTATE_CASES", if is_full() { full } else { few })
}
