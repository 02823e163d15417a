//! What a chart still owes: its shapes that are `to refine`, and the same chart with such an action replaced by the pattern that refines it.
//!
//! In: a chart and its text. Out: an [`Obligation`] for each dashed shape; for one that can be replaced the new chart's text, and the
//! coupling (spec/refine.md) by which the model of the new chart has to refine that of the old one. An action is one step, the block that
//! stands for it several. INVARIANT: outside of the block everything observed is the same; while the block is at work, the other machine
//! is where the action's paths begin or end, and nowhere else.

use std::fmt::Write;

use syntax::ast::{self, AstNode};
use syntax::{FileId, Span};

use crate::build::{call, control_location, state_value};
use crate::chart::{Chart, Machine, ShapeId, ShapeKind};
use crate::flow::{Origin, Target, is_block, transitions};

/// A shape that is to be refined.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Obligation {
    /// The machine that it stands in.
    pub machine: String,
    /// The shape.
    pub shape: String,
    /// Whether it is a guard; otherwise it is an action.
    pub is_guard: bool,
    /// What refines it, if the chart says so.
    pub by: Option<String>,
    /// Where it is declared: its name.
    pub span: Span,
}

/// The shapes that are to be refined, in the order of the chart.
pub fn obligations(chart: &Chart) -> Vec<Obligation> {
    let of = |machine: &Machine| {
        let shapes = machine.shapes.iter().filter_map(|shape| {
            Some(Obligation {
                machine: machine.name.clone(),
                shape: shape.name.clone(),
                is_guard: shape.kind == ShapeKind::Guard,
                by: shape.refinement.as_ref()?.by.clone(),
                span: shape.span,
            })
        });
        shapes.collect::<Vec<_>>()
    };
    chart.machines.iter().flat_map(of).collect()
}

/// A function that both models have: its name and the domains of its parameters.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Observed {
    /// The name.
    pub name: String,
    /// The domains, as a model would write them.
    pub parameters: Vec<String>,
}

impl Obligation {
    /// The chart's text with an instance of the pattern in the place of the action.
    ///
    /// # Errors
    /// A clause that says why it cannot be replaced.
    pub fn replaced(&self, chart: &Chart, text: &str) -> Result<String, String> {
        let Some(by) = &self.by else { return Err("it does not say by what".to_string()) };
        if self.is_guard {
            return Err("a guard has two exits, and no machine that replaces it can be built".to_string());
        }
        let Some(pattern) = chart.all_patterns().find(|pattern| pattern.name == *by) else {
            return Err(format!("there is no pattern {by} in the chart"));
        };
        let found = chart
            .machine(&self.machine)
            .and_then(|machine| Some((machine, machine.shapes.iter().find(|shape| shape.name == self.shape)?)));
        let Some((machine, shape)) = found else { return Err("it is no longer there".to_string()) };
        let called = call(machine, shape);
        let given = called.split_once('[').and_then(|(_, rest)| rest.strip_suffix(']')).unwrap_or("").trim();
        let count = if given.is_empty() { 0 } else { arguments(given) };
        let given = match pattern.parameters.len() {
            0 => String::new(),
            wanted if wanted == count => format!("({given})"),
            _ => return Err(format!("{by} has other parameters than the rule of the action")),
        };
        let parse = syntax::parse_chart(FileId(0), text);
        let actions = parse.syntax().descendants().filter_map(ast::ActionShape::cast);
        let node = actions.map(|action| action.syntax().clone()).find(|node| {
            let range = node.text_range();
            (u32::from(range.start())..u32::from(range.end())).contains(&self.span.start)
        });
        let Some(node) = node else { return Err("its text is not found".to_string()) };
        // The action's text ends where its last word does.
        let (start, end) = (usize::from(node.text_range().start()), usize::from(node.text_range().end()));
        let shown = shape.text.replace(['"', '\\'], "'");
        let instance = format!("instance {} of {by}{given} \"{shown}\"", self.shape);
        let tail = text[start..end].len() - text[start..end].trim_end().len();
        Ok(format!("{}{instance}{}", &text[..start], &text[end - tail..]))
    }

    /// The coupling of the chart's model with that of the replaced chart, which is given. `observed` are the functions that are to be
    /// the same.
    ///
    /// # Errors
    /// A clause that says why there is none.
    pub fn coupling(&self, replaced: &Chart, observed: &[Observed]) -> Result<String, String> {
        if observed.is_empty() {
            return Err("the model changes nothing that could be observed".to_string());
        }
        let endless = ["Integer", "Natural", "Real", "Complex", "String", "Char", "Any"];
        if let Some(function) =
            observed.iter().find(|one| one.parameters.iter().any(|domain| endless.contains(&&**domain)))
        {
            return Err(format!("{} has values at infinitely many arguments", function.name));
        }
        let machine = replaced.machine(&self.machine).ok_or("its machine is no longer there")?.flat();
        let found = machine.numbered().find(|(_, shape)| shape.name == self.shape);
        let (id, _) = found.ok_or("its block is no longer there")?;
        if !is_block(replaced, machine, id) {
            let names: Vec<&str> = observed.iter().map(|function| function.name.as_str()).collect();
            return Ok(format!("same {};\n", names.join(", ")));
        }
        let location = control_location(machine).ok_or("its machine has no control state")?;
        let block = state_value(replaced, machine, id);
        let ends = ends(replaced, machine, id);
        let within = |formula: String| match &machine.parameters[..] {
            [] => formula,
            parameters => {
                let all: Vec<String> =
                    parameters.iter().map(|one| format!("{} in {}", one.variable, one.domain)).collect();
                format!("(forall {} with {formula})", all.join(", "))
            }
        };
        let quiet = within(format!("concrete.{location} != {block}"));
        let mut text = String::new();
        for function in observed {
            let names: Vec<String> = (1..=function.parameters.len()).map(|number| format!("$a{number}")).collect();
            let applied = if names.is_empty() { String::new() } else { format!("({})", names.join(", ")) };
            let same = format!("abstract.{0}{applied} = concrete.{0}{applied}", function.name);
            let ranges: Vec<String> =
                names.iter().zip(&function.parameters).map(|(name, domain)| format!("{name} in {domain}")).collect();
            let same = if ranges.is_empty() { same } else { format!("(forall {} with {same})", ranges.join(", ")) };
            let _ = writeln!(text, "couple {quiet} implies {same};");
        }
        let there: Vec<String> = ends
            .iter()
            .map(|value| match value {
                Some(value) => format!("abstract.{location} = {value}"),
                None => format!("isUndef(abstract.{location})"),
            })
            .collect();
        let busy = within(format!("concrete.{location} = {block} implies ({})", there.join(" or ")));
        let _ = writeln!(text, "couple {busy};");
        Ok(text)
    }
}

/// How many arguments a text lists.
fn arguments(text: &str) -> usize {
    let mut depth = 0_i32;
    1 + text.chars().fold(0, |count, letter| {
        depth += i32::from("([{".contains(letter)) - i32::from(")]}".contains(letter));
        count + usize::from(letter == ',' && depth == 0)
    })
}

/// The control states in which the paths over a block begin or end; `None` is undef.
fn ends(chart: &Chart, machine: &Machine, block: ShapeId) -> Vec<Option<String>> {
    let value = |id: ShapeId| Some(state_value(chart, machine, id));
    let mut found = Vec::new();
    for transition in transitions(chart, machine) {
        if transition.target == Target::Block(block) {
            found.push(match transition.origin {
                Origin::Enter => None,
                Origin::State(id) | Origin::Left(id) => value(id),
            });
        }
        if transition.origin == Origin::Left(block) {
            found.push(match transition.target {
                Target::Exit => None,
                Target::State(id) | Target::Block(id) => value(id),
            });
        }
    }
    let mut once = Vec::new();
    // The block leads to itself where the action was done again.
    let own = value(block);
    for value in found {
        if value != own && !once.contains(&value) {
            once.push(value);
        }
    }
    once
}
