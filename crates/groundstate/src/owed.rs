//! What a chart owes to later models: for each dashed shape the question whether the machine that it is to be refined by refines it.
//!
//! In: a chart's text, its model, a [`Loader`]. Out: an [`Owed`] for each shape: both models and their coupling, ready for
//! [`refine::refine`], or why there is no question yet. What the abstract model's rules write is observed. INVARIANT: nothing is said to
//! be proved here, and nothing is kept: who asks runs the proof.

use std::sync::Arc;

use chart::{Chart, Obligation, Observed, obligations};
use model::{FunctionKind, Loader};
use program::{Program, Rule, RuleId, Runs};
use syntax::SourceFile;

use crate::{Loaded, build_chart, has_errors, load};

/// A shape that is to be refined, and what would have to be proved.
#[derive(Debug)]
pub struct Owed {
    /// The shape.
    pub obligation: Obligation,
    /// The models and their coupling; or a clause that says what is missing.
    pub question: Result<Box<OwedProof>, String>,
}

/// A refinement that is to be proved.
#[derive(Debug)]
pub struct OwedProof {
    /// The chart's model, and that of the chart in which the machine stands for the shape.
    pub models: [Loaded; 2],
    /// How they correspond.
    pub coupling: SourceFile,
    /// The functions that are compared.
    pub observed: Vec<String>,
}

/// What a chart owes. `model` is the model's file as it is.
pub fn owed(root: &SourceFile, chart: &Chart, model: &SourceFile, loader: &mut dyn Loader) -> Vec<Owed> {
    let all = obligations(chart);
    let question = |obligation: &Obligation, loader: &mut dyn Loader| proof(root, chart, obligation, model, loader);
    all.into_iter()
        .map(|obligation| {
            let question = question(&obligation, loader).map(Box::new);
            Owed { obligation, question }
        })
        .collect()
}

fn proof(
    root: &SourceFile,
    chart: &Chart,
    obligation: &Obligation,
    model: &SourceFile,
    loader: &mut dyn Loader,
) -> Result<OwedProof, String> {
    let text = obligation.replaced(chart, &root.text)?;
    let given = load(model.clone(), loader).map_err(|_| "the model has errors".to_string())?;
    if given.program.main.is_none() {
        return Err("the model has no main rule, so it makes no steps".to_string());
    }
    let replaced = build_chart(SourceFile::new(root.name.as_str(), text), &model.name, Some(&model.text), loader);
    let Some(built) = replaced.built else {
        let first =
            replaced.faults.iter().flat_map(|(_, faults)| faults).find(|fault| has_errors(std::slice::from_ref(fault)));
        let why = first.map_or_else(String::new, |fault| format!(": {}", fault.message));
        return Err(format!("the chart with the machine in its place cannot be built{why}"));
    };
    let concrete = load(SourceFile::new(model.name.as_str(), built.text), loader)
        .map_err(|_| "the model with the machine in its place has errors".to_string())?;
    let observed = written(&given.program);
    let coupling = obligation.coupling(&replaced.chart, &observed)?;
    let coupling =
        SourceFile::new(format!("<{} by {}>", obligation.shape, obligation.by.as_deref().unwrap_or("")), coupling);
    let observed = observed.into_iter().map(|function| function.name).collect();
    Ok(OwedProof { models: [given, concrete], coupling, observed })
}

/// The functions that the rules write which a program runs.
fn written(program: &Arc<Program>) -> Vec<Observed> {
    let mut found = vec![false; program.functions.len()];
    let mut seen = vec![false; program.procedures.len()];
    let mut open: Vec<RuleId> = Vec::new();
    let mut procedures: Vec<_> = program.main.into_iter().collect();
    procedures.extend(program.agents.iter().map(|agent| agent.procedure));
    loop {
        while let Some(procedure) = procedures.pop() {
            if !std::mem::replace(&mut seen[procedure.0 as usize], true) {
                open.push(program.procedure(procedure).body);
            }
        }
        let Some(id) = open.pop() else { break };
        if let Rule::Update { function, .. } | Rule::Return { function, .. } = program.rule(id) {
            found[function.0 as usize] = true;
        }
        match program.rule(id).runs() {
            Runs::Nothing => {}
            Runs::Procedure(procedure) => procedures.push(procedure),
            // Which rule it is depends on the state: all may be.
            Runs::Value { .. } | Runs::Agent => {
                procedures.extend((0..program.procedures.len() as u32).map(program::ProcedureId));
            }
        }
        program.each_child_of_rule(id, &mut |child| open.push(child));
    }
    let is_state = |function: &program::Function| {
        matches!(function.kind, FunctionKind::Controlled | FunctionKind::Out | FunctionKind::Shared)
            && !function.library
    };
    let functions = program.functions.iter().zip(found).filter(|(function, found)| *found && is_state(function));
    functions
        .map(|(function, _)| Observed {
            name: function.name.clone(),
            parameters: function.parameters.iter().map(|domain| program.domain(*domain).name.clone()).collect(),
        })
        .collect()
}
