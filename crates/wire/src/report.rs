//! Summaries of reports and measurements, as JSON objects.

use serde::Serialize;

/// `{"type":"report",…}`
#[derive(Debug, Serialize)]
#[cfg_attr(test, derive(schemars::JsonSchema))]
pub struct ReportMade<'a> {
    #[cfg_attr(test, schemars(extend("const" = "report")))]
    r#type: &'static str,
    model: &'a str,
    steps: u64,
    troubles: Vec<String>,
    files: Vec<String>,
}

impl<'a> ReportMade<'a> {
    /// The report of a run, and the files it was written to.
    pub fn new(report: &'a report::Report, files: Vec<String>) -> ReportMade<'a> {
        let troubles = report.troubles();
        ReportMade { files, model: &report.model, steps: report.ticks, troubles, r#type: "report" }
    }
}

/// `{"type":"program",…}`
#[derive(Debug, Serialize)]
#[cfg_attr(test, derive(schemars::JsonSchema))]
pub struct ProgramReported<'a> {
    #[cfg_attr(test, schemars(extend("const" = "program")))]
    r#type: &'static str,
    model: &'a str,
    runs: Vec<RunOfProgram<'a>>,
    troubles: Vec<String>,
    files: Vec<String>,
}

#[derive(Debug, Serialize)]
#[cfg_attr(test, derive(schemars::JsonSchema))]
struct RunOfProgram<'a> {
    name: &'a str,
    span_ns: u64,
    events: u64,
    conforms: Option<bool>,
    reached: Option<bool>,
    bounds: Vec<BoundOfProgram<'a>>,
}

/// What the program counted of a bound of its chart.
#[derive(Debug, Serialize)]
#[cfg_attr(test, derive(schemars::JsonSchema))]
struct BoundOfProgram<'a> {
    what: &'a str,
    limit: &'a str,
    seen: u64,
    outside: u64,
    /// The greatest value: in nanoseconds, but for missed deadlines how many.
    greatest: u64,
}

impl<'a> ProgramReported<'a> {
    /// The report of a program's runs, and the files it was written to.
    pub fn new(program: &'a report::Program, files: Vec<String>) -> ProgramReported<'a> {
        let bound = |bound: &'a report::Bounded| BoundOfProgram {
            what: &bound.what,
            limit: &bound.limit,
            seen: bound.seen,
            outside: bound.outside(),
            greatest: match bound.greatest {
                report::Greatest::Time(ns) => ns,
                report::Greatest::Number(number) => number,
            },
        };
        let run = |run: &'a report::ProgramRun| RunOfProgram {
            conforms: run.verdict.as_ref().and_then(|held| held.conforms),
            events: run.events,
            name: &run.name,
            reached: run.closed_loop.as_ref().and_then(|world| world.reached),
            span_ns: run.span_ns,
            bounds: run.bounds.iter().map(bound).collect(),
        };
        let runs = program.runs.iter().map(run).collect();
        ProgramReported { files, model: &program.model, runs, troubles: program.troubles(), r#type: "program" }
    }
}

/// `{"type":"bench",…}`
#[derive(Debug, Serialize)]
#[cfg_attr(test, derive(schemars::JsonSchema))]
#[allow(missing_docs, reason = "docs/cli.md says what each key is")]
pub struct Measured {
    #[cfg_attr(test, schemars(extend("const" = "bench")))]
    pub r#type: &'static str,
    pub model: String,
    pub steps_per_second: f64,
    pub lowest: f64,
    pub highest: f64,
    pub windows: u32,
    /// The number of steps after which the digest was taken.
    pub steps: u64,
    pub digest: String,
    /// The percentage of steps that changed the state.
    pub changed_percent: f64,
    pub updates_per_step: f64,
    pub restarts: u64,
    pub load_ms: f64,
    pub peak_memory_mb: Option<f64>,
}
