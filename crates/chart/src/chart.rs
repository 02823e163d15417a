//! A chart as it is meant: machines with their shapes and arrows, names resolved; and, apart from it, where shapes lie.
//!
//! INVARIANT: of a chart without errors, every [`ShapeId`] is an index into its machine's shapes; an arrow out of a guard
//! has a branch and no other has; every way from a control state leads over guards and actions to a control state, a
//! pattern instance or an exit, and never in a circle without one of these.

use std::collections::BTreeMap;

use syntax::Span;

use crate::link::Link;
use crate::system::System;

/// A chart file.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Chart {
    /// The name, that of the file.
    pub name: String,
    /// The modules whose names the links use, those of imported charts included, as paths from the file.
    pub imports: Vec<String>,
    /// Where each of them is imported; of one that comes with a chart, where that is.
    pub places: Vec<Span>,
    /// The charts whose patterns can be used, as paths from the file.
    pub charts: Vec<String>,
    /// The patterns of these charts.
    pub patterns: Vec<Machine>,
    /// Machines and patterns in the order of the file.
    pub machines: Vec<Machine>,
    /// The system, if there is one.
    pub system: Option<System>,
    /// Where shapes lie, by the name of the machine; this means nothing but to the eye.
    pub layouts: BTreeMap<String, Layout>,
}

impl Chart {
    /// The machine or pattern of that name, imported patterns included.
    pub fn machine(&self, name: &str) -> Option<&Machine> {
        self.machines.iter().chain(&self.patterns).find(|machine| machine.name == name)
    }

    /// The patterns that an instance can be of.
    pub fn all_patterns(&self) -> impl Iterator<Item = &Machine> {
        self.machines.iter().filter(|machine| machine.is_pattern).chain(&self.patterns)
    }

    /// The pattern that an instance is of.
    pub fn pattern_of(&self, shape: &Shape) -> Option<&Machine> {
        match &shape.kind {
            ShapeKind::Instance(pattern) => self.machine(&pattern.name),
            _ => None,
        }
    }
}

/// Centres of shapes in pixels, to the right and down.
pub type Layout = BTreeMap<String, (f64, f64)>;

/// A control-state machine, or a pattern of one.
#[derive(Debug, Clone, PartialEq)]
pub struct Machine {
    /// The name.
    pub name: String,
    /// A pattern is entered when its control variable is undef, and left by setting it to undef.
    pub is_pattern: bool,
    /// What the rule takes.
    pub parameters: Vec<Parameter>,
    /// The text shown.
    pub text: String,
    /// The rule of the specification that the machine is; none: one is made.
    pub rule: Option<Link>,
    /// The control variable; a pattern of actions alone has none.
    pub control: Option<Control>,
    /// States, guards, actions and instances in the order of the file.
    pub shapes: Vec<Shape>,
    /// Arrows in the order of the file.
    pub arrows: Vec<Arrow>,
    /// Actions and instances to be done one after the other where one path leads over them.
    pub sequences: Vec<Vec<ShapeId>>,
    /// It has a control state or a block in which it stays: entering and leaving it takes several steps.
    pub steps: bool,
    /// Where it is declared: its name.
    pub span: Span,
}

impl Machine {
    /// The shape of that number.
    pub fn shape(&self, id: ShapeId) -> &Shape {
        &self.shapes[id.0]
    }

    /// All shapes with their numbers.
    pub fn numbered(&self) -> impl Iterator<Item = (ShapeId, &Shape)> {
        self.shapes.iter().enumerate().map(|(index, shape)| (ShapeId(index), shape))
    }

    /// The arrows out of an end.
    pub fn out_of(&self, end: End) -> impl Iterator<Item = &Arrow> {
        self.arrows.iter().filter(move |arrow| arrow.from == end)
    }

    /// The arrow out of a guard's exit.
    pub fn branch(&self, guard: ShapeId, branch: bool) -> Option<&Arrow> {
        self.out_of(End::Shape(guard)).find(|arrow| arrow.branch == Some(branch))
    }

    /// The control state in which the machine starts.
    pub fn initial(&self) -> Option<ShapeId> {
        self.numbered().find(|(_, shape)| shape.kind == ShapeKind::State { initial: true }).map(|(id, _)| id)
    }

    /// It has a control state or a block in which it stays: entering and leaving it takes several steps.
    pub fn takes_steps(&self) -> bool {
        self.steps
    }
}

/// The number of a shape in its machine.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct ShapeId(pub usize);

/// A parameter of a machine.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Parameter {
    /// The variable, with its `$`.
    pub variable: String,
    /// Its domain, as it is written.
    pub domain: String,
}

/// The control variable of a machine.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Control {
    /// A location of the specification.
    Linked(Link),
    /// A function to be made, with the machine's parameters as arguments.
    Made {
        /// The function's name.
        name: String,
        /// Where it is named.
        span: Span,
    },
}

/// A shape of a machine.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Shape {
    /// The name that paths use.
    pub name: String,
    /// The text shown in the shape.
    pub text: String,
    /// What it is.
    pub kind: ShapeKind,
    /// The part of the specification that it stands for.
    pub link: Option<Link>,
    /// It is drawn dashed: what it stands for is still to be refined.
    pub refinement: Option<Refinement>,
    /// Where it is declared: its name.
    pub span: Span,
}

/// What a shape is.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum ShapeKind {
    /// A control state: a circle.
    State {
        /// The machine starts in it.
        initial: bool,
    },
    /// A test predicate: a hexagon with the exits yes and no.
    Guard,
    /// A rule: a rectangle.
    Action,
    /// A block that stands for a pattern machine.
    Instance(Pattern),
}

/// The pattern of an instance.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Pattern {
    /// The pattern's name.
    pub name: String,
    /// The arguments, as they are written.
    pub arguments: Vec<String>,
}

/// What refines a shape.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Refinement {
    /// The chart that does so, if it is known yet.
    pub by: Option<String>,
}

/// Where an arrow starts or ends.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum End {
    /// The entering arrow of a pattern: its control variable is undef.
    Enter,
    /// A shape.
    Shape(ShapeId),
    /// The floating exit arrow of a pattern: its control variable becomes undef.
    Exit,
}

/// An arrow.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Arrow {
    /// Where it starts.
    pub from: End,
    /// The exit of the guard it starts at.
    pub branch: Option<bool>,
    /// Where it ends.
    pub to: End,
    /// The stop of the path where it ends.
    pub span: Span,
}

/// Words that items of a chart start with, and that paths use; a shape is called otherwise.
pub(crate) const WORDS: [&str; 20] = [
    "control",
    "initial",
    "state",
    "guard",
    "action",
    "instance",
    "sequence",
    "enter",
    "exit",
    "yes",
    "no",
    "machine",
    "pattern",
    "system",
    "layout",
    "endmachine",
    "endpattern",
    "endsystem",
    "endcomponent",
    "endlayout",
];
