//! The meaning of each meta-property of a review.

use verify::review::Meta;

/// As a clause.
pub fn says(meta: Meta) -> &'static str {
    match meta {
        Meta::Consistent => "no inconsistent update is ever performed",
        Meta::Complete => "every conditional rule is complete",
        Meta::Fires => "every rule can eventually fire",
        Meta::NotTrivial => "no assignment is always trivial",
        Meta::ElementUsed => "every domain element is the value of some location",
        Meta::ValueTaken => "every controlled function can take any value of its codomain",
        Meta::LocationUsed => "every controlled location is updated and every location is read",
    }
}
