//! The findings of a review, as JSON objects.

use serde::Serialize;

use crate::{Fault, RunStep};

/// `{"type":"finding",…}`
#[derive(Debug, Serialize)]
#[cfg_attr(test, derive(schemars::JsonSchema))]
pub struct Finding<'a> {
    #[cfg_attr(test, schemars(extend("const" = "finding")))]
    r#type: &'static str,
    meta: String,
    finding: Fault<'a>,
    #[serde(skip_serializing_if = "Option::is_none")]
    witness: Option<Vec<RunStep>>,
}

impl<'a> Finding<'a> {
    /// A violation of the meta-property of this number, and a run that shows it.
    pub fn new(meta: usize, finding: Fault<'a>, witness: Option<Vec<RunStep>>) -> Finding<'a> {
        Finding { r#type: "finding", meta: format!("MP{meta}"), finding, witness }
    }
}

/// `{"type":"meta-property",…}`
#[derive(Debug, Serialize)]
#[cfg_attr(test, derive(schemars::JsonSchema))]
pub struct MetaProperty {
    #[cfg_attr(test, schemars(extend("const" = "meta-property")))]
    r#type: &'static str,
    meta: String,
    /// `holds`, `violated` or `unknown`.
    outcome: &'static str,
    findings: usize,
    #[serde(skip_serializing_if = "Vec::is_empty")]
    reasons: Vec<String>,
}

impl MetaProperty {
    /// The outcome for the meta-property of this number, and why it is unknown.
    pub fn new(meta: usize, outcome: &'static str, findings: usize, reasons: Vec<String>) -> MetaProperty {
        MetaProperty { r#type: "meta-property", meta: format!("MP{meta}"), outcome, findings, reasons }
    }
}
