//! What the properties of a model depend on, as a JSON object.

use groundstate::verify::dependence::{Dependence, Written};
use program::{FunctionId, Program};
use serde::Serialize;
use syntax::Sources;

use crate::Place;

/// `{"type":"proof-coverage",…}`: what the properties that hold depend on, and what none of them does.
#[derive(Debug, Serialize)]
#[cfg_attr(test, derive(schemars::JsonSchema))]
pub struct ProofCoverage {
    #[cfg_attr(test, schemars(extend("const" = "proof-coverage")))]
    r#type: &'static str,
    properties: Vec<Depends>,
    /// The functions that some of them depends on.
    within: Vec<WrittenAt>,
    /// The functions that none depends on.
    outside: Vec<WrittenAt>,
}

/// A property, and the functions that it depends on.
#[derive(Debug, Serialize)]
#[cfg_attr(test, derive(schemars::JsonSchema))]
struct Depends {
    name: String,
    on: Vec<String>,
}

/// A function, and the places of its updates.
#[derive(Debug, Serialize)]
#[cfg_attr(test, derive(schemars::JsonSchema))]
struct WrittenAt {
    function: String,
    updates: Vec<Place>,
}

impl ProofCoverage {
    /// What was found.
    pub fn new(program: &Program, sources: &Sources, found: &Dependence) -> ProofCoverage {
        let name = |function: &FunctionId| program.function(*function).name.clone();
        let written = |written: &Written| WrittenAt {
            function: name(&written.function),
            updates: written.updates.iter().map(|span| Place::new(sources, *span)).collect(),
        };
        let depends = found.cones.iter().map(|cone| Depends {
            name: program.properties[cone.property].name.clone(),
            on: cone.functions.iter().map(name).collect(),
        });
        ProofCoverage {
            r#type: "proof-coverage",
            properties: depends.collect(),
            within: found.within.iter().map(written).collect(),
            outside: found.outside.iter().map(written).collect(),
        }
    }
}
