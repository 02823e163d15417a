//! What a chart still owes: its shapes that are `to refine`, and the same chart with such a shape replaced by the pattern that refines it.
//!
//! In: a chart and its text. Out: an [`Obligation`] for each dashed shape; for one that can be replaced the new chart's text, and the
//! coupling (spec/refine.md) by which the model of the new chart has to refine that of the old one. An action is one step, and so is the
//! test of a guard; the block that stands for it takes several. INVARIANT: outside of the block everything observed is the same; while the
//! block is at work, the other machine is where the shape's paths begin or end, and nowhere else.

use std::fmt::Write;

use syntax::ast::{self, AstNode};
use syntax::{FileId, Span, SyntaxKind};

use crate::build::{answer_location, call, control_location, function_name, inner_control, state_value};
use crate::chart::{Chart, Machine, Shape, ShapeId, ShapeKind};
use crate::flow::{Origin, Target, is_block, transitions};
use crate::note::Note;

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

/// The block in the place of a shape, in terms over the model with the block.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Block {
    /// The machine is in the block.
    pub at: String,
    /// Its pattern is not at work: in the block, it has been left.
    pub left: String,
    /// What it was left with, if it answers.
    pub answer: Option<String>,
    /// The exit of the block, if it answers and has only one: of the other answer the machine stays in the block.
    pub only: Option<Only>,
}

/// The only exit of a guard.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Only {
    /// The answer that it is for.
    pub branch: bool,
    /// What the guard in its place asks, as the chart writes it.
    pub asked: String,
}

/// An input that nothing reads any more once its guard is replaced: what the pattern answers is its value.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Answered {
    /// The name.
    pub name: String,
    /// Whether a term can say its value: there is one input of this name, and it has no arguments.
    pub is_single: bool,
}

impl Obligation {
    /// The function that a guard asks for, if its term is nothing but that.
    pub fn asks(&self, chart: &Chart) -> Option<String> {
        let (_, shape) = self.found(chart)?;
        match &shape.link {
            _ if !self.is_guard => None,
            None => Some(function_name(&shape.name)),
            Some(link) => link.is_application.then(|| link.name.clone()),
        }
    }

    fn found<'c>(&self, chart: &'c Chart) -> Option<(&'c Machine, &'c Shape)> {
        let machine = chart.machine(&self.machine)?;
        Some((machine, machine.shapes.iter().find(|shape| shape.name == self.shape)?))
    }

    /// The chart's text with an instance of the pattern in the place of the shape.
    ///
    /// # Errors
    /// A clause that says why it cannot be replaced.
    pub fn replaced(&self, chart: &Chart, text: &str) -> Result<String, String> {
        let Some(by) = &self.by else { return Err("it does not say by what".to_string()) };
        let Some(pattern) = chart.all_patterns().find(|pattern| pattern.name == *by) else {
            return Err(match chart.machine(by) {
                Some(_) => format!("{by} is a machine, which is never left"),
                None => format!("there is no pattern {by} in the chart, nor in one that it imports"),
            });
        };
        match (self.is_guard, pattern.answers()) {
            (true, false) => return Err(format!("a guard has two exits, and {by} is left without an answer")),
            (false, true) => return Err(format!("{by} answers yes or no, and an action has one way on")),
            _ => {}
        }
        let Some((machine, shape)) = self.found(chart) else { return Err("it is no longer there".to_string()) };
        if !matches!(shape.kind, ShapeKind::Guard | ShapeKind::Action) {
            return Err("only guards and actions are replaced by a pattern".to_string());
        }
        let given = given(machine, shape, pattern.parameters.len()).ok_or_else(|| {
            let what = if self.is_guard { "guard" } else { "rule of the action" };
            format!("{by} has other parameters than the {what}")
        })?;
        let parse = syntax::parse_chart(FileId(0), text);
        let shapes = parse.syntax().descendants().filter_map(ast::Shape::cast);
        let node = shapes.map(|shape| shape.syntax().clone()).find(|node| {
            let range = node.text_range();
            let names = matches!(node.kind(), SyntaxKind::ACTION_SHAPE | SyntaxKind::GUARD_SHAPE);
            names && (u32::from(range.start())..u32::from(range.end())).contains(&self.span.start)
        });
        let Some(node) = node else { return Err("its text is not found".to_string()) };
        // The shape's text ends where its last word does.
        let (start, end) = (usize::from(node.text_range().start()), usize::from(node.text_range().end()));
        let shown = shape.text.replace(['"', '\\'], "'");
        let instance = format!("instance {} of {by}{given} \"{shown}\"", self.shape);
        let tail = text[start..end].len() - text[start..end].trim_end().len();
        Ok(format!("{}{instance}{}", &text[..start], &text[end - tail..]))
    }

    /// The coupling of the chart's model with that of the replaced chart, which is the second one. `observed` are the functions that are to be
    /// the same, `answered` is the input that the answer is the value of, `note` is what both models note of the guard.
    ///
    /// # Errors
    /// A clause that says why there is none.
    pub fn coupling(
        &self,
        [chart, replaced]: [&Chart; 2],
        observed: &[Observed],
        answered: Option<&Answered>,
        note: Option<&Note>,
    ) -> Result<String, String> {
        if observed.is_empty() {
            return Err("the model changes nothing that could be observed".to_string());
        }
        let endless = ["Integer", "Natural", "Real", "Complex", "String", "Char", "Any"];
        if let Some(function) =
            observed.iter().find(|one| one.parameters.iter().any(|domain| endless.contains(&&**domain)))
        {
            return Err(format!("{} has values at infinitely many arguments", function.name));
        }
        let drawn = replaced.machine(&self.machine).ok_or("its machine is no longer there")?;
        let found = drawn.numbered().find(|(_, shape)| shape.name == self.shape);
        let (id, _) = found.ok_or("its block is no longer there")?;
        let machine = drawn.flat();
        if !is_block(replaced, drawn, id) {
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
        text.extend(note.map(|note| note.coupled(&quiet)));
        if let Some(answered) = answered {
            let block = self.block(chart, replaced).filter(|_| answered.is_single);
            let exits = [true, false].map(|branch| drawn.branch(id, branch).is_some());
            let _ = match block.and_then(|block| block.said(exits)) {
                Some(term) => writeln!(text, "input abstract.{} = {term};", answered.name),
                None => writeln!(text, "free abstract.{};", answered.name),
            };
        }
        Ok(text)
    }
}

impl Obligation {
    /// The block in the place of the shape of `chart`, in a chart in which it is replaced. None if there is none, since the pattern is done in one
    /// step, or if there are many, one for each value of a parameter.
    pub fn block(&self, chart: &Chart, replaced: &Chart) -> Option<Block> {
        let (given, guard) = self.found(chart)?;
        let (machine, _) = self.found(replaced)?;
        let (id, shape) = machine.numbered().find(|(_, shape)| shape.name == self.shape)?;
        let pattern = replaced.pattern_of(shape)?;
        if !is_block(replaced, machine, id) || !machine.parameters.is_empty() || !pattern.parameters.is_empty() {
            return None;
        }
        let (control, value) = (control_location(machine)?, state_value(replaced, machine, id));
        let only = match [true, false].map(|branch| machine.branch(id, branch).is_some()) {
            [yes, no] if yes != no && pattern.answers() => Some(Only { branch: yes, asked: call(given, guard) }),
            _ => None,
        };
        Some(Block {
            at: format!("{control} = {value}"),
            left: format!("isUndef({})", inner_control(replaced, shape)?),
            answer: pattern.answers().then(|| answer_location(pattern)),
            only,
        })
    }
}

impl Obligation {
    /// Whether there are many blocks in the place of the shape, one for each value of a parameter.
    pub fn is_for_each(&self, chart: &Chart, replaced: &Chart) -> bool {
        let Some((machine, _)) = self.found(replaced) else { return false };
        let found = machine.numbered().find(|(_, shape)| shape.name == self.shape);
        found.is_some_and(|(id, _)| is_block(replaced, machine, id)) && self.block(chart, replaced).is_none()
    }

    /// What both models note of the guard, if the block in its place is one. No name of a note stands in these texts.
    pub fn note(&self, chart: &Chart, replaced: &Chart, texts: [&str; 2]) -> Option<Note> {
        self.block(chart, replaced)?.answer?;
        Note::about(&self.machine, &self.shape, texts)
    }
}

impl Block {
    /// What a guard is in a step of the machine with the block, as a coupling says it: the answer in the step that leaves the block. In
    /// other steps the guard is what it has no exit for, so that nothing is done; if it has both exits, `yes` and `no`, it has no value.
    fn said(&self, exits: [bool; 2]) -> Option<String> {
        let otherwise = match exits {
            [true, true] => "undef",
            [yes, _] => ["true", "false"][usize::from(yes)],
        };
        let left = self.left.replacen("isUndef(", "isUndef(concrete.", 1);
        let answer = self.answer.as_ref()?;
        Some(format!("(if concrete.{} and {left} then concrete.{answer} else {otherwise} endif)", self.at))
    }
}

/// The arguments that an instance in the place of a shape gives its pattern, in parentheses: those of the rule or function that the shape
/// stands for, or the parameters of the machine. None if neither fits.
fn given(machine: &Machine, shape: &Shape, wanted: usize) -> Option<String> {
    if wanted == 0 {
        return Some(String::new());
    }
    let called = call(machine, shape);
    let brackets = if shape.kind == ShapeKind::Guard { ('(', ')') } else { ('[', ']') };
    let is_application = shape.link.as_ref().is_none_or(|link| link.is_application);
    let own = called.split_once(brackets.0).and_then(|(_, rest)| rest.strip_suffix(brackets.1));
    let own = own.map(str::trim).filter(|own| is_application && !own.is_empty());
    match own {
        Some(own) if arguments(own) == wanted => Some(format!("({own})")),
        Some(_) => None,
        None if !is_application && machine.parameters.len() == wanted => {
            let variables: Vec<&str> = machine.parameters.iter().map(|one| one.variable.as_str()).collect();
            Some(format!("({})", variables.join(", ")))
        }
        None => None,
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
        if [Target::Block(block), Target::State(block)].contains(&transition.target) {
            found.push(match transition.origin {
                Origin::Enter => None,
                Origin::State(id) | Origin::Left(id) => value(id),
            });
        }
        if [Origin::Left(block), Origin::State(block)].contains(&transition.origin) {
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
