//! t
use crate::report::Report;
/// o
#[derive(Debug, Clone, Default)]
pub struct SummaryOptions;
/// s
pub fn summarise(_report: &Report, _options: &SummaryOptions) -> String { String::new() }
