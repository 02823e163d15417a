//! A refinement check as the page of `report` shows it: both runs on one axis, with the pictures of both machines.
//!
//! In: the words for a check, its report, the files beside both models. Out: plain data. Both machines make their runs again, and the terms
//! of the report specification beside each are evaluated in every state. The axis has a tick for each step: behind a diagram both machines
//! stand where they correspond. INVARIANT: the runs on the page are those of the refutation.

use std::sync::Arc;

use chart::{NotDrawn, Pictures};
use machine::Limits;
use model::Loader;
use refine::{ABSTRACT, CONCRETE, Ended, Refutation, SIDES, Vacuous, Verdict};
use report::{Candidate, Diagram, Judgement, RefinementCheck, Report, ReportBuilder, Spec, read_specification};
use simulate::{Header, Invariants, Record};
use syntax::{Diagnostic, Sources};

use crate::reporting::watch::Watch;
use crate::reporting::{charts, specification_beside};
use crate::tell::{Refinements, Row, trace_of};
use crate::workspace::{Absent, Files};
use crate::{Overlay, counterexample_run, has_errors};

/// Why there is no page.
#[derive(Debug)]
pub enum NoPage {
    /// A report specification beside a model, or a chart that it names, has faults.
    Faulty(Box<Sources>, Vec<Diagnostic>),
    /// A file beside a model cannot be read: its path, and why.
    Unread(String, Absent),
    /// A chart cannot be drawn.
    NotDrawn(NotDrawn),
}

/// What a machine shows of its run.
struct Shown {
    spec: Spec,
    /// By state: the places of the terms that have other values than before, and their values.
    states: Vec<Vec<(usize, String)>>,
}

/// The page of a check; `paths` are those of the abstract and of the concrete model.
///
/// # Errors
/// What stands beside a model cannot be shown.
pub fn refinement_page<F: Files + Loader>(
    words: &Refinements<'_>,
    report: &refine::Report,
    paths: [&str; 2],
    files: &mut F,
    pictures: &dyn Pictures,
    limits: &Limits,
) -> Result<RefinementCheck, NoPage> {
    let name = |path: &str| path.rsplit(['/', '\\']).next().unwrap_or(path).to_string();
    let refutation = match &report.verdict {
        Verdict::DoesNot(refutation) | Verdict::Vacuous(Vacuous::NoInitialPair(refutation)) => Some(refutation),
        Verdict::Refines | Verdict::Unknown(_) | Verdict::Vacuous(_) => None,
    };
    let mut check = RefinementCheck {
        models: paths.map(name),
        judgement: match report.verdict {
            Verdict::Refines => Judgement::Refines,
            Verdict::DoesNot(_) => Judgement::DoesNotRefine,
            Verdict::Unknown(_) => Judgement::NotKnown,
            Verdict::Vacuous(_) => Judgement::SaysNothing,
        },
        why: words.reason(&report.verdict),
        figures: figures(report),
        told: words.report(report),
        ..RefinementCheck::default()
    };
    if let Some(refutation) = refutation {
        let rows = words.rows(refutation);
        let axis = axis(&rows);
        check.remarks = [words.remarks(refutation), words.hindrances(refutation)].concat();
        let candidates = words.candidates(refutation).into_iter();
        check.candidates = candidates.map(|(does, failing)| Candidate { does, failing }).collect();
        check.diagrams = diagrams(rows);
        // Without a step there is no run to look at.
        if axis.len() > 1 {
            check.runs = Some(runs(words, refutation, &axis, paths, files, pictures, limits)?);
        }
    }
    Ok(check)
}

fn figures(report: &refine::Report) -> Vec<(String, String, String)> {
    let progress = &report.progress;
    let number = report::count;
    let open = match progress.queue {
        // What solvers say does not rest on the pairs that were searched before.
        _ if report.proof.is_some() || report.runs.is_some() => "searched before solvers were asked".to_string(),
        0 => "all looked at".to_string(),
        open => format!("{} not looked at", number(open)),
    };
    let [states, steps] = [progress.states, progress.steps];
    let both = |of: [u64; 2]| format!("{} abstract, {} concrete", number(of[ABSTRACT]), number(of[CONCRETE]));
    let figure = |what: &str, value: u64, remark: String| (what.to_string(), number(value), remark);
    vec![
        figure("Pairs of states", progress.pairs, open),
        figure("States", states.iter().sum(), both(states)),
        figure("Steps", steps.iter().sum(), both(steps)),
    ]
}

/// By tick, how many steps each machine has made. In a diagram, the steps of the machine that makes fewer of them are spread.
fn axis(rows: &[Row]) -> Vec<[usize; 2]> {
    let mut axis = vec![[0, 0]];
    for row in &rows[1..] {
        let [before, length] = [axis[axis.len() - 1], [row.steps.iter().copied().max().unwrap_or(0); 2]];
        let made = |side: usize, tick: usize| before[side] + row.steps[side] * tick / length[side];
        axis.extend((1..=length[0]).map(|tick| [made(ABSTRACT, tick), made(CONCRETE, tick)]));
    }
    axis
}

fn diagrams(rows: Vec<Row>) -> Vec<Diagram> {
    let mut tick = 0;
    let diagram = |row: Row| {
        tick += row.steps.iter().copied().max().unwrap_or(0) as u64;
        Diagram { label: row.label, sides: row.sides, tick, is_loose: row.is_loose }
    };
    rows.into_iter().map(diagram).collect()
}

/// Both runs on one axis.
fn runs<F: Files + Loader>(
    words: &Refinements<'_>,
    refutation: &Refutation,
    axis: &[[usize; 2]],
    paths: [&str; 2],
    files: &mut F,
    pictures: &dyn Pictures,
    limits: &Limits,
) -> Result<Report, NoPage> {
    let mut shown = Vec::new();
    for side in [ABSTRACT, CONCRETE] {
        shown.push(made_again(words, refutation, (side, paths[side]), files, pictures, limits)?);
    }
    let named = named(refutation);
    let is_named = |term: &String| SIDES.iter().any(|word| named.iter().any(|name| *name == format!("{word}.{term}")));
    let mut told: Vec<String> = shown.iter().flat_map(Shown::moving).collect();
    told.extend(shown.iter().flat_map(|shown| shown.spec.terms()).filter(is_named));
    shown.iter_mut().for_each(|shown| shown.keep(&told));
    let Ok(shown) = <[Shown; 2]>::try_from(shown) else { unreachable!("there are two sides") };
    let terms = shown.each_ref().map(|shown| shown.spec.terms());
    let [one, other] = shown.each_ref().map(|shown| shown.spec.clone());
    let mut builder = ReportBuilder::new(Spec::beside([(SIDES[ABSTRACT], one), (SIDES[CONCRETE], other)]));
    let all = builder.terms().to_vec();
    let places: [Vec<Option<usize>>; 2] = [ABSTRACT, CONCRETE].map(|side| {
        let place = |term: &String| all.iter().position(|other| *other == format!("{}.{term}", SIDES[side]));
        terms[side].iter().map(place).collect()
    });
    let mut noted = [0, 0];
    for (tick, states) in axis.iter().enumerate() {
        for side in [ABSTRACT, CONCRETE] {
            let of = &shown[side].states;
            // A step that cannot be made leaves the machine where it is.
            while noted[side] <= states[side] && noted[side] < of.len() {
                for (term, value) in &of[noted[side]] {
                    places[side][*term].iter().for_each(|place| builder.set(*place, value));
                }
                noted[side] += 1;
            }
        }
        if tick == 0 { builder.begin() } else { builder.step() }
    }
    Ok(builder.finish("both machines"))
}

/// The functions of both machines in the parts of the coupling that fail.
fn named(refutation: &Refutation) -> Vec<&str> {
    let Ended::Unmatched { tried, .. } = &refutation.ended else { return Vec::new() };
    let parts = tried.iter().flat_map(|candidate| &candidate.parts);
    let values = parts.flat_map(|part| part.values.iter().chain(part.instances.iter().flat_map(|one| &one.values)));
    values.map(|(name, _)| name.as_str()).collect()
}

/// A machine makes its run again.
fn made_again<F: Files + Loader>(
    words: &Refinements<'_>,
    refutation: &Refutation,
    (side, path): (usize, &str),
    files: &mut F,
    pictures: &dyn Pictures,
    limits: &Limits,
) -> Result<Shown, NoPage> {
    let model = words.models[side];
    let mut asked = Overlay {
        sources: model.sources.clone(),
        model: Arc::clone(&model.model),
        program: Arc::clone(&model.program),
    };
    let beside = specification_beside(path, &model.program, files);
    let specification = beside.map_err(|(path, absent)| NoPage::Unread(path, absent))?;
    let text = Arc::clone(&specification.text);
    let file = asked.add(specification);
    let mut wanted = match read_specification(file, &text) {
        Ok(wanted) => wanted,
        Err(faults) => return Err(NoPage::Faulty(Box::new(asked.sources), faults)),
    };
    let page = format!("{}-", SIDES[side]);
    let faults = charts::add(files, &mut asked.sources, &mut wanted, (path, &page), pictures);
    let faults = faults.map_err(NoPage::NotDrawn)?;
    if has_errors(&faults) {
        return Err(NoPage::Faulty(Box::new(asked.sources), faults));
    }
    let watch = Watch::new(&mut asked, &wanted.spec.terms(), &wanted.places);
    let mut watch = watch.map_err(|faults| NoPage::Faulty(Box::new(asked.sources.clone()), faults))?;
    let trace = trace_of(&refutation.runs[side]);
    let header = Header { steps: Some(trace.steps.len() as u64), invariants: Invariants::Ignore, ..Header::default() };
    let mut run = counterexample_run(&asked.program, limits.clone(), &trace, &header);
    let mut states = Vec::new();
    while let Some(record) = run.advance() {
        if matches!(record, Record::Initial { .. } | Record::Step(_)) {
            let mut changed = Vec::new();
            watch.changed(run.machine_mut(), &mut |term, value| changed.push((term, value.to_string())));
            states.push(changed);
        }
    }
    Ok(Shown { spec: wanted.spec, states })
}

impl Shown {
    /// The terms whose values change.
    fn moving(&self) -> Vec<String> {
        let terms = self.spec.terms();
        self.states.iter().skip(1).flatten().map(|(term, _)| terms[*term].clone()).collect()
    }

    /// Keeps of its lanes and pictures those that tell of such terms; all, if there are none.
    fn keep(&mut self, told: &[String]) {
        let stays = |term: &String| told.contains(term);
        let before = self.spec.terms();
        let Spec { tasks, series, charts, .. } = &mut self.spec;
        let lanes = tasks.iter().map(|task| &task.activity).chain(series.iter().map(|series| &series.value));
        if lanes.into_iter().any(stays) {
            tasks.retain(|task| stays(&task.activity));
            series.retain(|series| stays(&series.value));
        }
        let lit = |chart: &report::ChartSpec| chart.lights.iter().any(|lights| stays(&lights.term));
        if charts.iter().any(lit) {
            charts.retain(lit);
        }
        // Places are those of the terms that are left.
        let left = self.spec.terms();
        let places: Vec<Option<usize>> =
            before.iter().map(|term| left.iter().position(|other| other == term)).collect();
        for state in &mut self.states {
            let placed = state.drain(..).filter_map(|(term, value)| Some((places[term]?, value)));
            let placed: Vec<_> = placed.collect();
            *state = placed;
        }
    }
}
