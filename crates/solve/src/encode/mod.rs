//! Encodes a step of the machine for a solver: the next value of each location as a function of the state, the inputs
//! and the choices; and the conditions under which the step fails.
//!
//! In: a program. Out: what `verify` builds a transition relation from. Rules are executed in the machine's order on
//! symbolic values; every branch that may be taken is executed. INVARIANT: for every state and answer, `faults` gives
//! the class of the first fault that the machine meets, and the update set is the machine's; `beyond` holds wherever
//! that is not so. Tests compare the two, and a run that the machine does not make is never reported.
//!
//! Each file owns one part: terms, builtins, numbers, ranges, rules, locations. `free` encodes a condition about an
//! arbitrary state, without a step.

mod builtin;
pub(crate) mod free;
mod location;
mod number;
mod range;
mod rule;
mod set;
mod term;
mod tested;

use std::collections::{BTreeMap, BTreeSet};
use std::sync::Arc;

use machine::{Bounds, Fault, FaultClass, FaultKind, Machine, Value};
use program::{Expression, FunctionId, Program, Slot, TermId};
use rustc_hash::FxHashMap;
use syntax::Span;

use crate::shared::{Node, Terms};
use crate::symbol::{Codes, Open, Shape, Symbol, constant, value_of};
pub use free::Unknown;
pub use location::Place;

/// LIMIT: how many terms and rules are encoded for one step.
const WORK: usize = 2_000_000;
/// LIMIT: shared terms.
const TERMS: usize = 4_000_000;
/// LIMIT: nested calls that are encoded.
const DEPTH: usize = 100;

/// Why something cannot be encoded.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Outside {
    /// What it is, as a noun: "a term of the domain Seq(Integer)".
    pub what: String,
    /// Its place.
    pub span: Span,
}

/// An encoding, or why there is none.
pub type Result<T = Symbol> = std::result::Result<T, Outside>;

/// Something that a step reads from the environment.
#[derive(Debug, Clone)]
pub struct Input {
    /// Its value.
    pub variable: Node,
    /// Its kind.
    pub kind: InputKind,
}

/// The kinds of inputs.
#[derive(Debug, Clone)]
pub enum InputKind {
    /// The value of a monitored location.
    Location(FunctionId, Vec<Value>, Shape),
    /// An index into the candidates of a choice.
    Pick,
    /// A number drawn by a choice.
    Number,
    /// The rounding of a real number.
    Rounding,
}

/// A choice: its candidates with the condition that each is taken.
#[derive(Debug, Clone)]
pub struct Choice {
    /// The condition that the choice is made and has candidates.
    pub made: Node,
    /// For each candidate, the condition that it is taken, and the values of the variables.
    pub candidates: Vec<(Node, Vec<Symbol>)>,
    /// Numbers that are drawn first.
    pub draws: Vec<Symbol>,
}

/// The updates of a unit: for each place, the condition that there is an update, and its value.
type Unit = BTreeMap<usize, (Node, Symbol)>;

/// Encodes a program.
#[derive(Debug)]
pub struct Encoder {
    /// The encoded program.
    pub program: Arc<Program>,
    /// The terms created so far.
    pub terms: Terms,
    /// The codes of values that are only compared.
    pub codes: Codes,
    /// Evaluates terms that do not depend on the state.
    machine: Machine,
    bounds: Bounds,
    /// Whether reals are computed without rounding.
    exact: bool,
    /// Functions whose locations may be undef.
    partial: BTreeSet<FunctionId>,
    /// The locations read or updated so far.
    pub places: Vec<Place>,
    listed: BTreeMap<FunctionId, Arc<location::Rows>>,
    /// The present values of places, and those before the step.
    values: Vec<Symbol>,
    original: Vec<Symbol>,
    before: bool,
    agent: Symbol,
    /// The inputs read so far.
    pub inputs: Vec<Input>,
    /// The values of inputs that were read or given, each with the condition under which to read it is a fault.
    given_inputs: FxHashMap<(FunctionId, Vec<Value>), (Symbol, Node)>,
    /// The choices made so far.
    pub choices: Vec<Choice>,
    /// Facts about inputs.
    pub given: Vec<Node>,
    frame: Vec<Symbol>,
    /// The condition under which the present rule or term is executed.
    path: Node,
    /// The condition that no fault has occurred.
    live: Node,
    faults: [Node; 3],
    overflow: Node,
    /// Conditions under which the machine may do what is not encoded.
    pub beyond: Vec<(Node, Outside)>,
    units: Vec<Unit>,
    /// For each term its free variables, if its value depends on them alone.
    fixed: FxHashMap<TermId, Option<Arc<[Slot]>>>,
    work: usize,
    depth: usize,
    /// Whether a real number was computed.
    pub inexact: bool,
    /// The unknowns, for a condition about an arbitrary state.
    free: Option<free::Free>,
}

/// The progress of an encoding between two parts.
#[derive(Debug, Clone, Copy)]
pub struct Course {
    /// The condition under which the next part is executed.
    pub path: Node,
    /// The condition that no fault has occurred.
    pub live: Node,
    /// For each class, the condition that its fault was the first.
    pub faults: [Node; 3],
    /// The condition that the first fault was a number beyond 64 bits.
    pub overflow: Node,
}

impl Course {
    /// Nothing was executed.
    const NOTHING: Course =
        Course { path: Terms::TRUE, live: Terms::TRUE, faults: [Terms::FALSE; 3], overflow: Terms::FALSE };
}

impl Encoder {
    /// An encoder for the program of a started machine. The machine evaluates what does not depend on the state.
    pub fn new(machine: Machine, bounds: Bounds, exact: bool, partial: BTreeSet<FunctionId>) -> Encoder {
        Encoder {
            program: Arc::clone(machine.program()),
            terms: Terms::default(),
            codes: Codes::default(),
            machine,
            bounds,
            exact,
            partial,
            places: Vec::new(),
            listed: BTreeMap::new(),
            values: Vec::new(),
            original: Vec::new(),
            before: false,
            agent: Symbol::UNDEF,
            inputs: Vec::new(),
            given_inputs: FxHashMap::default(),
            choices: Vec::new(),
            given: Vec::new(),
            frame: Vec::new(),
            path: Terms::TRUE,
            live: Terms::TRUE,
            faults: [Terms::FALSE; 3],
            overflow: Terms::FALSE,
            beyond: Vec::new(),
            units: Vec::new(),
            fixed: FxHashMap::default(),
            work: 0,
            depth: 0,
            inexact: false,
            free: None,
        }
    }

    /// The machine, which knows the contents of domains.
    pub fn machine(&mut self) -> &mut Machine {
        &mut self.machine
    }

    fn outside<T>(&self, what: impl Into<String>, span: Span) -> Result<T> {
        Err(Outside { what: what.into(), span })
    }

    /// Adds the place of the present term or rule if the error has none.
    fn placed<T>(outcome: Result<T>, span: Span) -> Result<T> {
        outcome.map_err(|outside| match outside.span {
            Span { start: 0, end: 0, .. } => Outside { span, ..outside },
            _ => outside,
        })
    }

    /// Counts work against the limits.
    fn count(&mut self, span: Span) -> Result<()> {
        self.work += 1;
        if self.work > WORK || self.terms.count() > TERMS {
            return self.outside("a step that is too large when it is written out", span);
        }
        Ok(())
    }

    /// Executes the main rule as a unit of its own.
    ///
    /// # Errors
    /// It contains something that cannot be encoded; likewise below.
    pub fn step(&mut self) -> Result<()> {
        let main = self.program.main.map(|main| self.program.procedure(main).clone());
        let Some(main) = main else {
            return self.outside("a model without a main rule", Span { file: syntax::FileId(0), start: 0, end: 0 });
        };
        self.units.push(Unit::new());
        self.in_frame(Vec::new(), main.frame, main.span, |this| this.perform(main.body))
    }

    /// The value of a place after [`Encoder::step`], and whether it has changed.
    ///
    /// # Errors
    /// See [`Encoder::step`].
    pub fn next(&mut self, place: usize) -> Result<(Symbol, Node)> {
        let old = self.original[place].clone();
        let Some((guard, value)) = self.units.first().and_then(|unit| unit.get(&place)).cloned() else {
            return Ok((old, Terms::FALSE));
        };
        let same = self.equal(&value, &old)?;
        let differs = self.terms.not(same);
        let changed = self.terms.and([guard, differs]);
        Ok((self.merge(guard, &value, &old)?, changed))
    }

    /// Whether a condition is true in the state before the step, and whether it has a value. It is encoded separately,
    /// so its faults are not the step's.
    ///
    /// # Errors
    /// See [`Encoder::step`].
    pub fn condition(&mut self, expression: &Expression) -> Result<(Node, Node)> {
        let former = self.course();
        self.resume(Course::NOTHING);
        let span = self.program.term_span(expression.body);
        let symbol = self.in_frame(Vec::new(), expression.frame, span, |this| this.evaluate(expression.body));
        let live = self.live;
        self.resume(former);
        let truth = match symbol? {
            Symbol::Known(value) => self.terms.boolean(value == Value::Boolean(true)),
            Symbol::Open(Open { shape: Shape::Boolean, value, defined }) => self.terms.and([value, defined]),
            _ => Terms::FALSE,
        };
        Ok((self.terms.and([truth, live]), live))
    }

    /// The value of a term with these arguments in the state before the step, and the condition that it can be evaluated.
    /// It is encoded separately, so its faults are not the step's.
    ///
    /// # Errors
    /// See [`Encoder::step`].
    pub fn value(&mut self, expression: &Expression, arguments: Vec<Symbol>) -> Result<(Symbol, Node)> {
        let former = self.course();
        self.resume(Course::NOTHING);
        let span = self.program.term_span(expression.body);
        let value = self.in_frame(arguments, expression.frame, span, |this| this.evaluate(expression.body));
        let live = self.live;
        self.resume(former);
        Ok((value?, live))
    }

    /// Gives an input its value, and the condition under which reading it is a fault.
    pub fn give(&mut self, function: FunctionId, arguments: Vec<Value>, value: Symbol, fails: Node) {
        self.given_inputs.insert((function, arguments), (value, fails));
    }

    /// The progress so far.
    pub fn course(&self) -> Course {
        Course { path: self.path, live: self.live, faults: self.faults, overflow: self.overflow }
    }

    /// Continues from there.
    pub fn resume(&mut self, course: Course) {
        let Course { path, live, faults, overflow } = course;
        (self.path, self.live, self.faults, self.overflow) = (path, live, faults, overflow);
    }

    /// Runs `body` under an additional condition; `None` if that can never hold.
    fn under<T>(&mut self, condition: Node, body: impl FnOnce(&mut Self) -> Result<T>) -> Result<Option<T>> {
        let path = self.terms.and([self.path, condition]);
        if path == Terms::FALSE {
            return Ok(None);
        }
        let former = std::mem::replace(&mut self.path, path);
        let outcome = body(self);
        self.path = former;
        outcome.map(Some)
    }

    /// Adds a fault under a condition.
    fn fault(&mut self, class: FaultClass, condition: Node) {
        let here = self.terms.and([self.path, self.live, condition]);
        if here != Terms::FALSE {
            let class = class as usize;
            self.faults[class] = self.terms.or([self.faults[class], here]);
            self.end_where(condition);
        }
    }

    /// Adds the fault of a number beyond 64 bits under a condition.
    fn overflow(&mut self, condition: Node) {
        let here = self.terms.and([self.path, self.live, condition]);
        self.overflow = self.terms.or([self.overflow, here]);
        self.fault(FaultClass::Undefined, condition);
    }

    /// Marks what happens under a condition as not encoded.
    fn beyond(&mut self, condition: Node, what: &str, span: Span) {
        let here = self.terms.and([self.path, self.live, condition]);
        if here != Terms::FALSE {
            self.beyond.push((here, Outside { what: what.to_string(), span }));
            self.end_where(condition);
        }
    }

    fn end_where(&mut self, condition: Node) {
        let here = self.terms.and([self.path, condition]);
        let not = self.terms.not(here);
        self.live = self.terms.and([self.live, not]);
    }

    /// Records the fault that the machine reported instead of a value.
    fn met(&mut self, fault: &Fault) -> Result {
        if let FaultKind::Limit { .. } | FaultKind::Interrupted(_) | FaultKind::Environment { .. } = fault.kind {
            return self.outside("a term that the machine does not evaluate by itself", fault.span);
        }
        self.fault(FaultClass::of(fault), Terms::TRUE);
        Ok(Symbol::UNDEF)
    }

    /// Runs `body` in a new frame.
    fn in_frame<T>(
        &mut self,
        mut arguments: Vec<Symbol>,
        frame: u32,
        span: Span,
        body: impl FnOnce(&mut Self) -> Result<T>,
    ) -> Result<T> {
        if self.depth >= DEPTH {
            return self.outside("calls within each other without an end", span);
        }
        arguments.resize(frame as usize, Symbol::UNDEF);
        let former = std::mem::replace(&mut self.frame, arguments);
        self.depth += 1;
        let outcome = stacker::maybe_grow(1 << 20, 8 << 20, || body(self));
        self.depth -= 1;
        self.frame = former;
        outcome
    }

    fn bind(&mut self, slot: Slot, value: Symbol) {
        self.frame[slot.0 as usize] = value;
    }

    /// A symbol as a scalar term; `None` if it is not a scalar. For undef, the value is that of `like`.
    fn open(&mut self, symbol: &Symbol, like: Option<Open>) -> Option<Open> {
        match symbol {
            Symbol::Open(open) => Some(*open),
            Symbol::Known(Value::Undef) => like.map(|like| Open { defined: Terms::FALSE, ..like }),
            Symbol::Known(value) => {
                let node = constant(&mut self.terms, &mut self.codes, value);
                Some(Open { shape: Shape::of(value), value: node, defined: Terms::TRUE })
            }
            Symbol::Tuple(_) | Symbol::Set(_) => None,
        }
    }

    /// A scalar as a symbol, which is a known value if possible.
    fn symbol(&self, open: Open) -> Symbol {
        if open.defined == Terms::FALSE {
            return Symbol::UNDEF;
        }
        if open.defined == Terms::TRUE
            && let Some(value) = self.constant_value(open.shape, open.value)
        {
            return Symbol::Known(value);
        }
        Symbol::Open(open)
    }

    fn constant_value(&self, shape: Shape, node: Node) -> Option<Value> {
        use crate::session::Constant;
        let constant = self.terms.constant(node)?;
        match (shape, constant) {
            // A code that does not exist yet may be added later.
            (Shape::Coded, Constant::Integer(_))
            | (_, Constant::Boolean(_) | Constant::Integer(_) | Constant::Real(_)) => {
                value_of(&self.codes, shape, constant)
            }
        }
    }

    /// The first symbol if a condition holds, else the second.
    fn merge(&mut self, condition: Node, yes: &Symbol, no: &Symbol) -> Result {
        match self.terms.truth(condition) {
            Some(true) => return Ok(yes.clone()),
            Some(false) => return Ok(no.clone()),
            None if yes == no => return Ok(yes.clone()),
            None => {}
        }
        let span = Span { file: syntax::FileId(0), start: 0, end: 0 };
        if let (Some(a), Some(b)) = (components(yes), components(no))
            && a.len() == b.len()
        {
            let pairs = a.iter().zip(&b);
            return Ok(Symbol::Tuple(pairs.map(|(a, b)| self.merge(condition, a, b)).collect::<Result<_>>()?));
        }
        if let (Some(a), Some(b)) = (elements(yes), elements(no)) {
            return self.merge_sets(condition, a, b);
        }
        let like = match (yes, no) {
            (Symbol::Open(open), _) | (_, Symbol::Open(open)) => Some(*open),
            (Symbol::Known(Value::Undef), other) | (other, _) => self.open(other, None),
        };
        match (self.open(yes, like), self.open(no, like)) {
            (Some(a), Some(b)) if a.shape == b.shape => {
                let value = match (a.defined, b.defined) {
                    (Terms::FALSE, _) => b.value,
                    (_, Terms::FALSE) => a.value,
                    _ => self.terms.choose(condition, a.value, b.value),
                };
                let defined = self.terms.choose(condition, a.defined, b.defined);
                Ok(self.symbol(Open { shape: a.shape, value, defined }))
            }
            _ => self.outside("a value that is of one kind or of another", span),
        }
    }

    /// Equality, which is total.
    ///
    /// # Errors
    /// It is one of collections.
    pub fn equal(&mut self, a: &Symbol, b: &Symbol) -> Result<Node> {
        if let (Symbol::Known(a), Symbol::Known(b)) = (a, b) {
            return Ok(self.terms.boolean(a == b));
        }
        if a == b {
            return Ok(Terms::TRUE);
        }
        if let (Some(a), Some(b)) = (components(a), components(b)) {
            if a.len() != b.len() {
                return Ok(Terms::FALSE);
            }
            let all = a.iter().zip(&b).map(|(a, b)| self.equal(a, b)).collect::<Result<Vec<_>>>()?;
            return Ok(self.terms.and(all));
        }
        let like = match (a, b) {
            (Symbol::Open(open), _) | (_, Symbol::Open(open)) => Some(*open),
            _ => None,
        };
        match (self.open(a, like), self.open(b, like)) {
            (Some(a), Some(b)) => {
                let neither = [self.terms.not(a.defined), self.terms.not(b.defined)];
                let neither = self.terms.and(neither);
                if a.shape != b.shape || a.defined == Terms::FALSE || b.defined == Terms::FALSE {
                    return Ok(neither);
                }
                let same = self.terms.equal(a.value, b.value);
                let both = self.terms.and([a.defined, b.defined, same]);
                Ok(self.terms.or([both, neither]))
            }
            _ if matches!((a, b), (Symbol::Tuple(_) | Symbol::Set(_), Symbol::Known(Value::Undef)))
                || matches!((a, b), (Symbol::Known(Value::Undef), Symbol::Tuple(_) | Symbol::Set(_))) =>
            {
                Ok(Terms::FALSE)
            }
            _ => self.outside("an equality of collections", Span { file: syntax::FileId(0), start: 0, end: 0 }),
        }
    }

    /// The condition that a symbol is not undef.
    fn defined(&self, symbol: &Symbol) -> Node {
        match symbol {
            Symbol::Known(value) => self.terms.boolean(!value.is_undef()),
            Symbol::Open(open) => open.defined,
            Symbol::Tuple(_) | Symbol::Set(_) => Terms::TRUE,
        }
    }
}

/// The components of a tuple.
fn components(symbol: &Symbol) -> Option<Vec<Symbol>> {
    match symbol {
        Symbol::Tuple(components) => Some(components.clone()),
        Symbol::Known(Value::Tuple(components)) => Some(components.iter().cloned().map(Symbol::Known).collect()),
        _ => None,
    }
}

/// The elements of a set.
fn elements(symbol: &Symbol) -> Option<Vec<(Node, Symbol)>> {
    match symbol {
        Symbol::Set(elements) => Some(elements.clone()),
        Symbol::Known(Value::Set(values)) => {
            Some(values.iter().map(|value| (Terms::TRUE, Symbol::Known(value.clone()))).collect())
        }
        _ => None,
    }
}
