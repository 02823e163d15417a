//! The result of a refinement check, as a JSON object.
//!
//! In: a report with the words for its runs. Out: [`Refinement`]: the verdict, the extent, where it fails both runs with their diagrams.

use groundstate::refine::{ABSTRACT, CONCRETE, Ended, Instance, Refutation, Report, SIDES, Vacuous, Verdict, Why};
use groundstate::report::LivePart;
use groundstate::tell::{Refinements, Standing};
use serde::Serialize;

use crate::RunStep;
use crate::refinement_proof::{ProofLine, RunsLine};

/// `{"type":"refinement",…}`
#[derive(Debug, Serialize)]
#[cfg_attr(test, derive(schemars::JsonSchema))]
pub struct Refinement {
    #[cfg_attr(test, schemars(extend("const" = "refinement")))]
    r#type: &'static str,
    /// `explicit`, `induction` or `bmc`.
    method: &'static str,
    /// `refines`, `does-not-refine`, `unknown` or `vacuous`.
    verdict: &'static str,
    /// Why it does not refine or is unknown.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    reasons: Vec<String>,
    /// The parts of the coupling relation.
    coupling: Vec<String>,
    /// The functions of both machines that are not compared by default, and why.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    left_out: Vec<String>,
    /// Whether it is assumed that the concrete machine does not go on for ever without a step of the abstract one.
    #[serde(skip_serializing_if = "std::ops::Not::not")]
    waiting_allowed: bool,
    /// Whether runs are looked at as far as no number of the concrete machine leaves 64 bits.
    #[serde(skip_serializing_if = "std::ops::Not::not")]
    overflow_allowed: bool,
    /// How often answers of the abstract machine use each diagram.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    diagrams: Vec<DiagramLine>,
    /// Assumptions of the models.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    assumed: Vec<AssumedLine>,
    pairs: u64,
    /// Pairs that were found and not looked at.
    open_pairs: u64,
    abstract_states: u64,
    concrete_states: u64,
    abstract_steps: u64,
    concrete_steps: u64,
    /// The properties of the abstract machine, if it refines.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    properties: Vec<PropertyLine>,
    /// Both runs, where it does not refine.
    #[serde(skip_serializing_if = "Option::is_none")]
    runs: Option<RunPair>,
    /// With `induction`: how far the proof came. Then `pairs` and what follows it are of a short search before.
    #[serde(skip_serializing_if = "Option::is_none")]
    proof: Option<ProofLine>,
    /// What solvers looked at of runs from the initial states: with `bmc`, and with `induction` where a proof fails at an obligation.
    #[serde(skip_serializing_if = "Option::is_none")]
    bmc: Option<RunsLine>,
    /// With `--page -`: the sections that show where it fails.
    #[serde(skip_serializing_if = "Option::is_none")]
    page: Option<PagePart>,
}

/// A part of a page, to be put into another one that has the scripts of a report's page.
#[derive(Debug, Serialize)]
#[cfg_attr(test, derive(schemars::JsonSchema))]
struct PagePart {
    /// The sections, as HTML. Names and strings of the models are escaped.
    markup: String,
    /// The run as the scripts read it; null if there is nothing to draw.
    run: serde_json::Value,
    /// The style sheet, for a tree of its own; colours are the variables of the palette.
    style: String,
}

/// What a property of the abstract machine is in the concrete one.
#[derive(Debug, Serialize)]
#[cfg_attr(test, derive(schemars::JsonSchema))]
struct PropertyLine {
    name: String,
    /// `holds`; `comes-along`: it holds if it holds of the abstract machine; `violated` or `unknown` there; `stays`: it does not come along.
    standing: &'static str,
    /// What it says of the concrete machine, as the concrete model would write it.
    #[serde(skip_serializing_if = "Option::is_none")]
    form: Option<String>,
    /// Why it does not come along.
    #[serde(skip_serializing_if = "Option::is_none")]
    reason: Option<String>,
}

/// A diagram.
#[derive(Debug, Serialize)]
#[cfg_attr(test, derive(schemars::JsonSchema))]
struct DiagramLine {
    r#abstract: u64,
    concrete: u64,
    /// In how many places it is used.
    #[serde(skip_serializing_if = "Option::is_none")]
    places: Option<u64>,
}

#[derive(Debug, Serialize)]
#[cfg_attr(test, derive(schemars::JsonSchema))]
struct AssumedLine {
    model: &'static str,
    name: String,
    /// The file beside the model, or the option, that says it; absent if the model itself does.
    #[serde(skip_serializing_if = "Option::is_none")]
    from: Option<String>,
}

/// Both runs to the first step that nothing matches.
#[derive(Debug, Serialize)]
#[cfg_attr(test, derive(schemars::JsonSchema))]
struct RunPair {
    r#abstract: Vec<RunStep>,
    concrete: Vec<RunStep>,
    /// The diagrams of the two runs; concrete steps behind them are those that nothing matches.
    diagrams: Vec<DiagramLine>,
    /// `unmatched`, `fault`, `waits` or `endless`: a segment of the concrete run never ends.
    ended: &'static str,
    /// The diagram, from 0, to which the concrete run returns for ever.
    #[serde(skip_serializing_if = "Option::is_none")]
    again_from: Option<usize>,
    /// The concrete step, from 0, from which a segment goes on for ever.
    #[serde(skip_serializing_if = "Option::is_none")]
    again_from_step: Option<usize>,
    /// The values of inputs in the last concrete steps.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    inputs: Vec<(String, String)>,
    /// What the abstract machine could have done.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    tried: Vec<TriedLine>,
}

#[derive(Debug, Serialize)]
#[cfg_attr(test, derive(schemars::JsonSchema))]
struct TriedLine {
    steps: Vec<RunStep>,
    fails: Vec<FailingPart>,
}

/// A part of the coupling that does not hold.
#[derive(Debug, Serialize)]
#[cfg_attr(test, derive(schemars::JsonSchema))]
struct FailingPart {
    part: String,
    values: Vec<(String, String)>,
    /// Instances of a `forall` that do not hold.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    instances: Vec<InstanceLine>,
    /// So many more instances, or arguments, are left out.
    #[serde(skip_serializing_if = "is_zero")]
    more: usize,
    /// Why it is neither true nor false.
    #[serde(skip_serializing_if = "Option::is_none")]
    trouble: Option<String>,
}

/// An instance of a `forall` that does not hold.
#[derive(Debug, Serialize)]
#[cfg_attr(test, derive(schemars::JsonSchema))]
struct InstanceLine {
    /// The variables.
    bound: Vec<(String, String)>,
    values: Vec<(String, String)>,
    /// Why it is neither true nor false.
    #[serde(skip_serializing_if = "Option::is_none")]
    trouble: Option<String>,
}

impl InstanceLine {
    fn of(instance: &Instance) -> InstanceLine {
        let Instance { bound, values, trouble } = instance.clone();
        InstanceLine { bound, values, trouble }
    }
}

fn is_zero(count: &usize) -> bool {
    *count == 0
}

impl Refinement {
    /// The result of a check.
    pub fn new(words: &Refinements<'_>, report: &Report, page: Option<LivePart>) -> Refinement {
        let (verdict, reasons, refutation) = match &report.verdict {
            Verdict::Refines => ("refines", Vec::new(), None),
            Verdict::DoesNot(refutation) => {
                ("does-not-refine", vec![words.headline(refutation)], Some(refutation.as_ref()))
            }
            Verdict::Unknown(whys) if whys.contains(&Why::Unproved) => {
                ("unknown", report.proof.iter().map(|proof| words.gap(proof)).collect(), None)
            }
            Verdict::Unknown(whys) if whys.contains(&Why::NoRun) => {
                ("unknown", report.runs.iter().map(|runs| words.no_run(runs)).collect(), None)
            }
            Verdict::Unknown(whys) => ("unknown", whys.iter().map(|why| words.why(why)).collect(), None),
            Verdict::Vacuous(vacuous) => {
                let runs = match vacuous {
                    Vacuous::NoInitialPair(refutation) => Some(refutation.as_ref()),
                    Vacuous::NoStep | Vacuous::NoFairRun | Vacuous::NoneLeft | Vacuous::Total | Vacuous::NoStart(_) => {
                        None
                    }
                };
                ("vacuous", vec![words.vacuous(vacuous).message], runs)
            }
        };
        let progress = &report.progress;
        let diagram = |((m, n), places): (&(u32, u32), &u64)| DiagramLine {
            r#abstract: u64::from(*m),
            concrete: u64::from(*n),
            places: Some(*places),
        };
        Refinement {
            r#type: "refinement",
            method: match (&report.proof, &report.runs) {
                (Some(_), _) => "induction",
                (None, Some(_)) => "bmc",
                (None, None) => "explicit",
            },
            verdict,
            reasons,
            coupling: (0..words.coupling.conjuncts()).map(|index| words.coupling.conjunct(index)).collect(),
            left_out: words.left_out().collect(),
            waiting_allowed: words.coupling.waiting,
            overflow_allowed: words.coupling.overflow,
            diagrams: report.diagrams.iter().map(diagram).collect(),
            assumed: report
                .assumed
                .iter()
                .map(|assumed| {
                    let (name, from) = words.assumed_from(assumed);
                    AssumedLine { model: SIDES[assumed.side], name, from }
                })
                .collect(),
            pairs: progress.pairs,
            open_pairs: progress.queue,
            abstract_states: progress.states[ABSTRACT],
            concrete_states: progress.states[CONCRETE],
            abstract_steps: progress.steps[ABSTRACT],
            concrete_steps: progress.steps[CONCRETE],
            properties: report
                .properties
                .iter()
                .map(|property| PropertyLine {
                    name: property.name.clone(),
                    standing: match words.standing(property) {
                        Standing::Stays => "stays",
                        Standing::Conditional => "comes-along",
                        Standing::Holds => "holds",
                        Standing::Violated => "violated",
                        Standing::Unknown => "unknown",
                    },
                    form: property.form.as_ref().ok().cloned(),
                    reason: property.form.as_ref().err().cloned(),
                })
                .collect(),
            runs: refutation.map(|refutation| RunPair::new(words, refutation)),
            proof: report.proof.as_ref().map(|proof| ProofLine::new(words, proof)),
            bmc: report.runs.as_ref().map(|runs| RunsLine::new(words, runs)),
            page: page.map(|LivePart { markup, run, style }| PagePart {
                markup,
                run: serde_json::from_str(&run).unwrap_or_default(),
                style,
            }),
        }
    }
}

impl RunPair {
    fn new(words: &Refinements<'_>, refutation: &Refutation) -> RunPair {
        let run = |side: usize| RunStep::of(words.steps(side, &refutation.runs[side]));
        let diagrams = refutation.segments.iter().map(|segment| DiagramLine {
            r#abstract: segment.m as u64,
            concrete: segment.n as u64,
            places: None,
        });
        let mut pair = RunPair {
            r#abstract: run(ABSTRACT),
            concrete: run(CONCRETE),
            diagrams: diagrams.collect(),
            ended: "fault",
            again_from: None,
            again_from_step: None,
            inputs: Vec::new(),
            tried: Vec::new(),
        };
        match &refutation.ended {
            Ended::Fault => {}
            Ended::Waits(turn) => (pair.ended, pair.again_from) = ("waits", Some(*turn)),
            Ended::Endless(turn) => (pair.ended, pair.again_from_step) = ("endless", Some(*turn)),
            Ended::Unmatched { inputs, tried, .. } => {
                pair.ended = "unmatched";
                pair.inputs.clone_from(inputs);
                pair.tried = tried
                    .iter()
                    .map(|tried| TriedLine {
                        steps: RunStep::of(words.tried(&tried.steps)),
                        fails: tried
                            .parts
                            .iter()
                            .map(|part| FailingPart {
                                part: part.text.clone(),
                                values: part.values.clone(),
                                instances: part.instances.iter().map(InstanceLine::of).collect(),
                                more: part.more,
                                trouble: part.trouble.clone(),
                            })
                            .collect(),
                    })
                    .collect();
            }
        }
        pair
    }
}
