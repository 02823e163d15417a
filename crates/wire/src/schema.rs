//! The JSON Schema of all output, generated from the types and compared with the files in `schema/`; `make update`
//! rewrites them.
//!
//! The schema describes what is written, so it says which keys are always there. A reader must accept more: new keys
//! and types come without a new version.

use expect_test::expect_file;
use schemars::generate::SchemaSettings;
use schemars::{Schema, SchemaGenerator};
use serde_json::{Map, Value, json};

use crate::*;

/// A document whose lines are any of these objects.
fn document(title: &str, version: u32, add: impl Fn(&mut SchemaGenerator) -> Vec<Schema>) -> String {
    let mut generator = SchemaSettings::draft2020_12().for_serialize().into_generator();
    let any: Vec<Value> = add(&mut generator).into_iter().map(Value::from).collect();
    let definitions: Map<String, Value> = generator.take_definitions(true);
    let whole = json!({
        "$schema": "https://json-schema.org/draft/2020-12/schema",
        "title": title,
        "version": version,
        "anyOf": any,
        "$defs": definitions,
    });
    serde_json::to_string_pretty(&whole).expect("it is JSON") + "\n"
}

#[test]
fn the_schema_of_traces() {
    let trace = document("A line of a trace", VERSION, |all| vec![all.subschema_for::<Line>()]);
    expect_file!["../schema/trace.json"].assert_eq(&trace);
}

#[test]
fn the_schema_of_the_output() {
    let output = document("A line of a command's output", OUTPUT_VERSION, |all| {
        vec![
            all.subschema_for::<Line>(),
            all.subschema_for::<Answer<'_>>(),
            all.subschema_for::<Assumed<'_>>(),
            all.subschema_for::<Vacuity>(),
            all.subschema_for::<Conformance>(),
            all.subschema_for::<FollowedTold>(),
            all.subschema_for::<Coverage<'_>>(),
            all.subschema_for::<ExploredLine<'_>>(),
            all.subschema_for::<Fault<'_>>(),
            all.subschema_for::<Finding<'_>>(),
            all.subschema_for::<Generated>(),
            all.subschema_for::<Goal<'_>>(),
            all.subschema_for::<Graph>(),
            all.subschema_for::<GraphState>(),
            all.subschema_for::<Measured>(),
            all.subschema_for::<MetaProperty>(),
            all.subschema_for::<Mutant>(),
            all.subschema_for::<Mutation<'_>>(),
            all.subschema_for::<ProgramReported<'_>>(),
            all.subschema_for::<ProofCoverage>(),
            all.subschema_for::<Refinement>(),
            all.subschema_for::<ReportMade<'_>>(),
            all.subschema_for::<ScenarioResult<'_>>(),
            all.subschema_for::<TimesTold<'_>>(),
            all.subschema_for::<Verdict>(),
            all.subschema_for::<WorldFailure>(),
        ]
    });
    expect_file!["../schema/output.json"].assert_eq(&output);
}
