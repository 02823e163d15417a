//! What holds whatever the text: each property is a function of bytes that panics if it is broken.
//!
//! In: any bytes. Out: whether they reached the last stage, or a panic. Coverage-guided fuzzing (`fuzz/`) and the tests
//! of this crate, which mutate seeds, call the same functions. INVARIANT: everything here depends only on the bytes, so
//! an input that breaks a property once always breaks it. It must not know its callers, nor where seeds lie.

pub mod commands;
pub mod mutation;
pub mod seeds;

mod run;
mod text;
mod world;

/// What holds for any bytes, under the name of its fuzz target.
#[derive(Debug, Clone, Copy)]
pub struct Property {
    /// What it says, with low lines.
    pub name: &'static str,
    /// Panics if it does not hold. Gives whether the bytes reached the last stage that it looks at.
    pub check: fn(&[u8]) -> bool,
    /// Whether its inputs are a model and a scenario, separated by [`seeds::DIVIDER`], or one text.
    pub of_scenario: bool,
}

/// All of them.
pub const ALL: &[Property] = &[
    Property { name: "parse_is_total_and_lossless", check: text::parse_is_total_and_lossless, of_scenario: false },
    Property { name: "check_never_panics", check: text::check_never_panics, of_scenario: false },
    Property { name: "step_never_panics", check: run::step_never_panics, of_scenario: false },
    Property { name: "a_failed_step_leaves_the_state", check: run::a_failed_step_leaves_the_state, of_scenario: false },
    Property { name: "scenario_never_panics", check: run::scenario_never_panics, of_scenario: true },
];

/// Checks the property of that name; gives whether the bytes reached the last stage that it looks at.
///
/// # Panics
/// It does not hold for these bytes, or there is none of that name.
pub fn check(name: &str, bytes: &[u8]) -> bool {
    let property = ALL.iter().find(|property| property.name == name).expect("a property of that name");
    (property.check)(bytes)
}
