//! What scenarios covered of a model, as a JSON object.

use ::scenario::Items;
use groundstate::tell::uncovered;
use serde::Serialize;
use syntax::Sources;

use crate::Place;

/// `{"type":"coverage",…}`
#[derive(Debug, Serialize)]
#[cfg_attr(test, derive(schemars::JsonSchema))]
pub struct Coverage<'a> {
    #[cfg_attr(test, schemars(extend("const" = "coverage")))]
    r#type: &'static str,
    model: &'a str,
    totals: Vec<Total>,
    uncovered: Vec<Uncovered<'a>>,
}

#[derive(Debug, Serialize)]
#[cfg_attr(test, derive(schemars::JsonSchema))]
struct Total {
    kind: &'static str,
    covered: usize,
    total: usize,
}

#[derive(Debug, Serialize)]
#[cfg_attr(test, derive(schemars::JsonSchema))]
struct Uncovered<'a> {
    what: String,
    rule: &'a str,
    #[serde(flatten)]
    place: Place,
}

impl<'a> Coverage<'a> {
    /// The coverage of the model in this file.
    pub fn new(model: &'a str, sources: &Sources, items: &'a Items) -> Coverage<'a> {
        let totals = items.totals();
        let total = |&(kind, ref covered): &(&'static str, ::scenario::Coverage)| Total {
            kind,
            covered: covered.covered,
            total: covered.total,
        };
        let missing = uncovered(sources, items).into_iter();
        let missing = missing.map(|missing| Uncovered {
            what: missing.what,
            rule: missing.rule,
            place: Place::new(sources, missing.span),
        });
        Coverage { r#type: "coverage", model, totals: totals.iter().map(total).collect(), uncovered: missing.collect() }
    }
}
