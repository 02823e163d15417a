//! Views of charts: machines, patterns, their shapes and paths, and layouts (spec/charts.md).

use super::{AstNode, Children, Parameter, ParameterList, Rule, Term, child, children, choice, nodes, token, tokens};
use crate::{SyntaxKind::*, SyntaxToken};

nodes! {
    /// `chart NAME imports sections`
    ChartFile = CHART_FILE,
    /// `machine NAME … endmachine`, `pattern NAME … endpattern`
    MachineChart = MACHINE_CHART,
    /// `control NAME`, `control {location}`
    ControlVariable = CONTROL_VARIABLE,
    /// `[initial] state NAME "text" {value}`
    ControlState = CONTROL_STATE,
    /// `[initial] composite state NAME "text" … endstate`
    CompositeState = COMPOSITE_STATE,
    /// `history`, `history {location}`
    History = HISTORY,
    /// `entry NAME "text" {rule}`
    EntryAction = ENTRY_ACTION,
    /// `exit NAME "text" {rule}`
    ExitAction = EXIT_ACTION,
    /// `abort NAME "text" {rule}`
    AbortAction = ABORT_ACTION,
    /// `guard NAME "text" {term} [to refine]`
    GuardShape = GUARD_SHAPE,
    /// `action NAME "text" {rule} [to refine]`
    ActionShape = ACTION_SHAPE,
    /// `instance NAME of NAME (arguments) "text" {r_rule}`
    PatternInstance = PATTERN_INSTANCE,
    /// `{…}`: a term, a rule or a rule's name of the specification.
    Link = LINK,
    /// `to refine [by NAME]`
    Refinement = REFINEMENT,
    /// `stop -> stop -> …`
    ChartPath = CHART_PATH,
    /// `enter`, `exit`, `exit yes`, `exit no`, `NAME`, `NAME yes`, `NAME no`
    PathStop = PATH_STOP,
    /// `sequence NAME, NAME`
    Sequence = SEQUENCE,
    /// `layout NAME … endlayout`
    Layout = LAYOUT,
    /// `NAME at X, Y`
    Placement = PLACEMENT,
    /// A number of pixels, with its sign.
    Coordinate = COORDINATE,
}

choice! {
    /// A shape of a machine.
    Shape {
        State(ControlState), Composite(CompositeState), Guard(GuardShape), Action(ActionShape), Entry(EntryAction),
        Exit(ExitAction), Abort(AbortAction), Instance(PatternInstance),
    }
}

/// The string of a node without its quotes, with its escapes undone.
pub(super) fn text_of(node: &crate::SyntaxNode) -> Option<String> {
    let token = token(node, STRING)?;
    let inner = token.text().strip_prefix('"')?;
    // One that is not closed has no second quotation mark.
    let inner = inner.strip_suffix('"').unwrap_or(inner);
    let mut text = String::new();
    let mut letters = inner.chars();
    while let Some(letter) = letters.next() {
        match letter {
            '\\' => match letters.next() {
                Some('n') => text.push('\n'),
                Some(other) => text.push(other),
                None => {}
            },
            letter => text.push(letter),
        }
    }
    Some(text)
}

impl ChartFile {
    /// The chart's name.
    pub fn name(&self) -> Option<SyntaxToken> {
        token(self.syntax(), GENERIC_ID)
    }
    /// The imported modules of the specification.
    pub fn imports(&self) -> Children<super::Import> {
        children(self.syntax())
    }
    /// Machines and patterns.
    pub fn machines(&self) -> Children<MachineChart> {
        children(self.syntax())
    }
    /// Systems.
    pub fn systems(&self) -> Children<super::SystemChart> {
        children(self.syntax())
    }
    /// Places of shapes.
    pub fn layouts(&self) -> Children<Layout> {
        children(self.syntax())
    }
}

impl MachineChart {
    /// The name.
    pub fn name(&self) -> Option<SyntaxToken> {
        token(self.syntax(), GENERIC_ID)
    }
    /// It is a pattern.
    pub fn is_pattern(&self) -> bool {
        token(self.syntax(), PATTERN_KW).is_some()
    }
    /// The parameters.
    pub fn parameters(&self) -> Vec<Parameter> {
        child::<ParameterList>(self.syntax()).map(|list| list.parameters().collect()).unwrap_or_default()
    }
    /// The text shown.
    pub fn text(&self) -> Option<String> {
        text_of(self.syntax())
    }
    /// The rule of the specification.
    pub fn link(&self) -> Option<Link> {
        child(self.syntax())
    }
    /// The control variable.
    pub fn control(&self) -> Option<ControlVariable> {
        child(self.syntax())
    }
    /// All control variables; more than one is a fault.
    pub fn controls(&self) -> Children<ControlVariable> {
        children(self.syntax())
    }
    /// The shapes, in the order of the text; those within composite states too.
    pub fn shapes(&self) -> impl Iterator<Item = Shape> + use<> {
        inner(self.syntax())
    }
    /// The composite states.
    pub fn composites(&self) -> impl Iterator<Item = CompositeState> + use<> {
        inner(self.syntax())
    }
    /// `history` outside of a composite state, which is a fault.
    pub fn histories(&self) -> Children<History> {
        children(self.syntax())
    }
    /// The paths; those within composite states too.
    pub fn paths(&self) -> impl Iterator<Item = ChartPath> + use<> {
        inner(self.syntax())
    }
    /// What is done in sequence; within composite states too.
    pub fn sequences(&self) -> impl Iterator<Item = Sequence> + use<> {
        inner(self.syntax())
    }
}

impl ControlVariable {
    /// The name of a control variable to be made.
    pub fn name(&self) -> Option<SyntaxToken> {
        token(self.syntax(), GENERIC_ID)
    }
    /// The location of the specification.
    pub fn link(&self) -> Option<Link> {
        child(self.syntax())
    }
}

/// The items of a machine, and of the composite states in it.
fn inner<N: AstNode>(machine: &crate::SyntaxNode) -> impl Iterator<Item = N> + use<N> {
    machine.descendants().filter_map(N::cast)
}

impl CompositeState {
    /// The machine starts in it, or the composite state around it does.
    pub fn is_initial(&self) -> bool {
        token(self.syntax(), INITIAL_KW).is_some()
    }
    /// Control variables, which is a fault.
    pub fn controls(&self) -> Children<ControlVariable> {
        children(self.syntax())
    }
    /// `history`: it is entered where it was left. More than one is a fault.
    pub fn histories(&self) -> Children<History> {
        children(self.syntax())
    }
}

impl History {
    /// The location of the specification that remembers.
    pub fn link(&self) -> Option<Link> {
        child(self.syntax())
    }
}

impl ControlState {
    /// The state in which the machine starts.
    pub fn is_initial(&self) -> bool {
        token(self.syntax(), INITIAL_KW).is_some()
    }
}

impl Shape {
    /// The name.
    pub fn name(&self) -> Option<SyntaxToken> {
        token(self.syntax(), GENERIC_ID)
    }
    /// The text shown.
    pub fn text(&self) -> Option<String> {
        text_of(self.syntax())
    }
    /// The link to the specification.
    pub fn link(&self) -> Option<Link> {
        child(self.syntax())
    }
    /// The composite state that it stands in.
    pub fn around(&self) -> Option<CompositeState> {
        self.syntax().parent().and_then(CompositeState::cast)
    }
    /// Whether, and by which chart, it is to be refined.
    pub fn refinement(&self) -> Option<Refinement> {
        child(self.syntax())
    }
}

impl PatternInstance {
    /// The pattern's name.
    pub fn pattern(&self) -> Option<SyntaxToken> {
        tokens(self.syntax()).filter(|token| token.kind() == GENERIC_ID).nth(1)
    }
    /// The arguments.
    pub fn arguments(&self) -> Vec<Term> {
        child::<super::ArgumentList>(self.syntax()).map(|list| list.terms().collect()).unwrap_or_default()
    }
}

impl Link {
    /// The term, if it holds one.
    pub fn term(&self) -> Option<Term> {
        child(self.syntax())
    }
    /// The rule, if it holds one.
    pub fn rule(&self) -> Option<Rule> {
        child(self.syntax())
    }
    /// The name of a rule, if it holds only that.
    pub fn rule_name(&self) -> Option<SyntaxToken> {
        token(self.syntax(), RULE_ID)
    }
}

impl Refinement {
    /// The chart that refines the shape.
    pub fn by(&self) -> Option<SyntaxToken> {
        token(self.syntax(), GENERIC_ID)
    }
}

impl ChartPath {
    /// The stops, in order.
    pub fn stops(&self) -> Children<PathStop> {
        children(self.syntax())
    }
}

impl PathStop {
    /// The name of a shape.
    pub fn name(&self) -> Option<SyntaxToken> {
        token(self.syntax(), GENERIC_ID)
    }
    /// It is the entering arrow.
    pub fn is_enter(&self) -> bool {
        token(self.syntax(), ENTER_KW).is_some()
    }
    /// It is the exit arrow.
    pub fn is_exit(&self) -> bool {
        token(self.syntax(), EXIT_KW).is_some()
    }
    /// The exit of a guard, or the answer with which a pattern is left: `yes` is true.
    pub fn branch(&self) -> Option<bool> {
        tokens(self.syntax()).find_map(|token| match token.kind() {
            YES_KW => Some(true),
            NO_KW => Some(false),
            _ => None,
        })
    }
}

impl Sequence {
    /// The names, in order.
    pub fn names(&self) -> impl Iterator<Item = SyntaxToken> {
        tokens(self.syntax()).filter(|token| token.kind() == GENERIC_ID)
    }
}

impl Layout {
    /// The name of a machine or system.
    pub fn name(&self) -> Option<SyntaxToken> {
        token(self.syntax(), GENERIC_ID)
    }
    /// The places.
    pub fn placements(&self) -> Children<Placement> {
        children(self.syntax())
    }
}

impl Placement {
    /// The name of the shape.
    pub fn name(&self) -> Option<SyntaxToken> {
        token(self.syntax(), GENERIC_ID)
    }
    /// The centre of the shape in pixels, to the right and down.
    pub fn place(&self) -> Option<(f64, f64)> {
        let mut numbers = children::<Coordinate>(self.syntax()).filter_map(|number| number.value());
        Some((numbers.next()?, numbers.next()?))
    }
}

impl Coordinate {
    /// The number.
    pub fn value(&self) -> Option<f64> {
        let digits = tokens(self.syntax()).find(|token| matches!(token.kind(), INTEGER | REAL))?;
        let value: f64 = digits.text().parse().ok()?;
        Some(if token(self.syntax(), MINUS).is_some() { -value } else { value })
    }
}
