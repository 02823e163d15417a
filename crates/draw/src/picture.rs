//! Where everything lies: boxes, lines and labels with their coordinates, for the SVG and for tests that measure it.
//!
//! Lengths are CSS pixels, to the right and down. Where a chart has a `layout` section, the origin is that of the section,
//! else the upper left corner of what was laid out; the heading stands above it.

/// What a shape looks like.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Figure {
    /// A control state.
    Circle,
    /// A state that holds others.
    Composite,
    /// A guard.
    Hexagon,
    /// An action.
    Rectangle,
    /// A pattern instance.
    Block,
    /// Where the entering arrow starts.
    Enter,
    /// Where a floating exit arrow ends.
    Exit,
    /// A component of a system.
    Component,
    /// A channel of a system.
    Channel,
    /// A sensor or actuator.
    Device,
}

/// A shape with its place.
#[derive(Debug, Clone, PartialEq)]
pub struct Placed {
    /// The name in the chart; `enter`; or `exit`, an answer if it gives one, and a number.
    pub id: String,
    /// What it looks like.
    pub figure: Figure,
    /// Drawn dashed.
    pub dashed: bool,
    /// Drawn in long dashes: what refines it is named.
    pub named: bool,
    /// Drawn with a double line: the machine starts here.
    pub initial: bool,
    /// The text in it.
    pub lines: Vec<String>,
    /// Smaller text below.
    pub details: Vec<Detail>,
    /// Left end.
    pub x: f64,
    /// Upper end.
    pub y: f64,
    /// Width.
    pub width: f64,
    /// Height.
    pub height: f64,
    /// The composite state around it, by its index.
    pub inside: Option<usize>,
}

/// A line of smaller text in a shape.
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub struct Detail {
    /// The part of the shape that it tells of, if it can be pointed at: a component's phase.
    pub id: Option<String>,
    /// The text, at the left where there is one at the right, else in the middle.
    pub text: String,
    /// At the right.
    pub right: Option<String>,
}

/// A text beside a shape or a line.
#[derive(Debug, Clone, PartialEq)]
pub struct Label {
    /// The index of the box it belongs to.
    pub of: usize,
    /// The text.
    pub text: String,
    /// A link to the specification; else the exit of a guard.
    pub is_link: bool,
    /// Left end.
    pub x: f64,
    /// Upper end.
    pub y: f64,
    /// Width.
    pub width: f64,
    /// Height.
    pub height: f64,
}

/// An arrow: its corners from the start to the tip.
#[derive(Debug, Clone, PartialEq)]
pub struct Line {
    /// The index of the box it starts at.
    pub from: usize,
    /// The index of the box it ends at.
    pub to: usize,
    /// The exit of the guard it starts at.
    pub branch: Option<bool>,
    /// The corners, each right of, left of, above or below the one before.
    pub points: Vec<(f64, f64)>,
}

/// A placed drawing.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Picture {
    /// Shapes.
    pub boxes: Vec<Placed>,
    /// Arrows.
    pub lines: Vec<Line>,
    /// Links and exits of guards.
    pub labels: Vec<Label>,
    /// The heading, and the link of the whole machine beside it.
    pub heading: (String, Option<String>),
    /// Left end of the whole.
    pub left: f64,
    /// Upper end of the whole.
    pub top: f64,
    /// Width of the whole.
    pub width: f64,
    /// Height of the whole.
    pub height: f64,
}

impl Picture {
    /// Makes room above everything, and makes the whole at least this wide.
    pub fn make_room(&mut self, above: f64, width: f64) {
        let wider = (width - self.width).max(0.0);
        self.left -= (wider / 2.0).ceil();
        self.width += wider;
        self.top -= above;
        self.height += above;
    }
}
