//! What a chart owes to later models: for each dashed shape the question whether the machine that it is to be refined by refines it.
//!
//! In: a chart's text, its model, a [`Loader`]. Out: an [`Owed`] for each shape: both models and their coupling, ready for
//! [`refine::refine`], or why there is no question yet. What the abstract model's rules write is observed. An input that only a guard
//! asked for which is replaced is what the machine in its place answers; one that something still asks for is the same in both. INVARIANT: nothing is said to
//! be proved here, and nothing is kept: who asks runs the proof.

use chart::{Answered, Block, Chart, Obligation, Observed, Stand, Texts, obligations, stands};
use model::{FunctionKind, Loader};
use program::{Function, Program, Rule, RuleId, Runs, Term, TermId};
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
    /// The machine in the place of the shape, if it is one block that takes steps.
    pub block: Option<Block>,
    /// There is one such block for each value of a parameter: whether it can be left is not looked at.
    pub is_for_each: bool,
    /// The control states of the chart's machines.
    pub stands: Vec<Stand>,
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
    let observed = Touched::by(&given.program).written(&given.program);
    let texts = |chart: &str| Texts { chart: chart.to_string(), model: model.text.to_string() };
    let in_place = "the machine in its place";
    let (replaced, concrete) = built(root, &texts(&text), model, loader, in_place)?;
    let answered = obligation.asks(chart).and_then(|name| answered(&name, &given.program, &concrete.program));
    let note = obligation.note(chart, &replaced, [&root.text, &model.text]);
    let (given, concrete) = match &note {
        None => (given, concrete),
        Some(note) => {
            let noted = (note.of_guard(&texts(&root.text)), note.of_block(&texts(&text)));
            let (Some(one), Some(other)) = noted else { return Err("its exits are not found".to_string()) };
            let (_, given) = built(root, &one, model, loader, "notes of what it says")?;
            (given, built(root, &other, model, loader, in_place)?.1)
        }
    };
    let coupling = obligation.coupling([chart, &replaced], &observed, answered.as_ref(), note.as_ref())?;
    let coupling =
        SourceFile::new(format!("<{} by {}>", obligation.shape, obligation.by.as_deref().unwrap_or("")), coupling);
    let observed = observed.into_iter().map(|function| function.name).collect();
    let mut block = obligation.block(chart, &replaced);
    if let Some(block) = &mut block
        && answered.is_some()
    {
        // What the pattern answers is what was asked: without an exit for it, the chart's machine waits, too.
        block.only = None;
    }
    let is_for_each = obligation.is_for_each(chart, &replaced);
    Ok(OwedProof { models: [given, concrete], coupling, observed, block, is_for_each, stands: stands(chart) })
}

/// A chart and the model that is built from it; `with` says what is new in it.
fn built(
    root: &SourceFile,
    texts: &Texts,
    model: &SourceFile,
    loader: &mut dyn Loader,
    with: &str,
) -> Result<(Chart, Loaded), String> {
    let source = SourceFile::new(root.name.as_str(), texts.chart.as_str());
    let found = build_chart(source, &model.name, Some(&texts.model), loader);
    let Some(built) = found.built else {
        let first =
            found.faults.iter().flat_map(|(_, faults)| faults).find(|fault| has_errors(std::slice::from_ref(fault)));
        let why = first.map_or_else(String::new, |fault| format!(": {}", fault.message));
        return Err(format!("the chart with {with} cannot be built{why}"));
    };
    let loaded = load(SourceFile::new(model.name.as_str(), built.text), loader);
    Ok((found.chart, loaded.map_err(|_| format!("the model with {with} has errors"))?))
}

/// The input that a guard asks for, if nothing reads it in the concrete machine: there the answer stands for it. If something does, it is
/// an input of both machines.
fn answered(name: &str, given: &Program, concrete: &Program) -> Option<Answered> {
    let inputs = |program: &Program| -> Vec<usize> {
        let named = program.functions.iter().enumerate();
        let is_input = |function: &Function| function.kind == FunctionKind::Monitored && function.name == name;
        named.filter(|(_, function)| is_input(function)).map(|(index, _)| index).collect()
    };
    let all = inputs(given);
    let read = Touched::by(concrete).read;
    if all.is_empty() || inputs(concrete).iter().any(|index| read[*index]) {
        return None;
    }
    let is_single = all.len() == 1 && given.functions[all[0]].parameters.is_empty();
    Some(Answered { name: name.to_string(), is_single })
}

/// By function of a program, whether its runs may write it, and whether they may read it.
struct Touched {
    written: Vec<bool>,
    read: Vec<bool>,
}

impl Touched {
    fn by(program: &Program) -> Touched {
        let mut found =
            Touched { written: vec![false; program.functions.len()], read: vec![false; program.functions.len()] };
        for initial in &program.initials {
            found.look(program, initial.value.body);
        }
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
            let Some(id) = open.pop() else { return found };
            if let Rule::Update { function, .. } | Rule::Return { function, .. } = program.rule(id) {
                found.written[function.0 as usize] = true;
            }
            match program.rule(id).runs() {
                Runs::Nothing => {}
                Runs::Procedure(procedure) => procedures.push(procedure),
                // Which rule it is depends on the state: all may be.
                Runs::Value { .. } | Runs::Agent => {
                    procedures.extend((0..program.procedures.len() as u32).map(program::ProcedureId));
                }
            }
            program.each_term_of_rule(id, &mut |term| found.look(program, term));
            program.each_child_of_rule(id, &mut |child| open.push(child));
        }
    }

    /// Notes what a term reads, directly or through definitions.
    fn look(&mut self, program: &Program, term: TermId) {
        let mut open = vec![term];
        while let Some(id) = open.pop() {
            if let Term::Read { function, .. } | Term::Define { function, .. } = program.term(id)
                && !std::mem::replace(&mut self.read[function.0 as usize], true)
            {
                open.extend(program.function(*function).definition.as_ref().map(|definition| definition.body));
            }
            program.each_child_of_term(id, &mut |child| open.push(child));
        }
    }

    /// The functions of the state that are written.
    fn written(&self, program: &Program) -> Vec<Observed> {
        let is_state = |function: &Function| {
            matches!(function.kind, FunctionKind::Controlled | FunctionKind::Out | FunctionKind::Shared)
                && !function.library
        };
        let functions = program.functions.iter().zip(&self.written);
        functions
            .filter(|(function, written)| **written && is_state(function))
            .map(|(function, _)| Observed {
                name: function.name.clone(),
                parameters: function.parameters.iter().map(|domain| program.domain(*domain).name.clone()).collect(),
            })
            .collect()
    }
}
