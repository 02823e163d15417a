//! Terms with shared subterms, for formulas that are too large as trees, such as a step's effect on a state.
//!
//! Each term is stored once in a [`Terms`] and identified by a [`Node`]; equal terms have equal nodes. Every number has
//! bounds, derived from those of the variables; comparisons that the bounds decide are simplified. INVARIANT: an
//! operand's node is less than its term's; a constructor's result has the meaning of the operation for all values
//! within the bounds.

mod build;
mod value;
mod write;

use rustc_hash::FxHashMap;

pub use value::value_at;
pub use write::{Script, exact_real};

/// Identifies a term.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct Node(pub(crate) u32);

/// The kind of a term's values.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Kind {
    /// Truth values.
    Boolean,
    /// Unbounded integers.
    Integer,
    /// Real numbers.
    Real,
}

/// Inclusive bounds of an integer; `None` for unbounded.
pub type Bounds = (Option<i128>, Option<i128>);

/// A variable, or an uninterpreted function.
#[derive(Debug, Clone, PartialEq)]
pub struct Variable {
    /// Its name, which need not be unique.
    pub name: String,
    /// The kind of its values.
    pub kind: Kind,
    /// The kinds of its arguments, if it is a function.
    pub parameters: Vec<Kind>,
    /// The bounds of its values.
    pub bounds: Bounds,
}

/// Identifies a variable.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct VariableId(pub u32);

/// An operation on its operands.
#[derive(Debug, Clone, PartialEq, Eq, Hash)]
pub enum Op {
    /// A truth value.
    Boolean(bool),
    /// An integer.
    Integer(i128),
    /// A finite real number: the bits of a double.
    Real(u64),
    /// A variable.
    Variable(VariableId),
    /// The value of a function at arguments.
    Apply(VariableId, Box<[Node]>),
    /// Negation.
    Not(Node),
    /// Conjunction.
    And(Box<[Node]>),
    /// Disjunction.
    Or(Box<[Node]>),
    /// Equality.
    Equal(Node, Node),
    /// Less than.
    Less(Node, Node),
    /// The second operand if the first holds, else the third.
    If(Node, Node, Node),
    /// Sum.
    Add(Node, Node),
    /// Difference.
    Subtract(Node, Node),
    /// Product.
    Multiply(Node, Node),
    /// Integer quotient, truncated toward zero.
    Quotient(Node, Node),
    /// Its remainder, with the sign of the first operand.
    Remainder(Node, Node),
    /// Quotient of reals.
    Divide(Node, Node),
    /// An integer as a real.
    ToReal(Node),
    /// The largest integer that is not greater than a real.
    Floor(Node),
}

/// All terms of some formulas.
#[derive(Debug)]
pub struct Terms {
    ops: Vec<Op>,
    kinds: Vec<Kind>,
    bounds: Vec<Bounds>,
    known: FxHashMap<Op, Node>,
    variables: Vec<Variable>,
}

impl Default for Terms {
    fn default() -> Terms {
        let mut terms = Terms {
            ops: Vec::new(),
            kinds: Vec::new(),
            bounds: Vec::new(),
            known: FxHashMap::default(),
            variables: Vec::new(),
        };
        terms.put(Op::Boolean(false), Kind::Boolean, (None, None));
        terms.put(Op::Boolean(true), Kind::Boolean, (None, None));
        terms
    }
}

impl Terms {
    /// `false`
    pub const FALSE: Node = Node(0);
    /// `true`
    pub const TRUE: Node = Node(1);

    /// The number of terms.
    pub fn count(&self) -> usize {
        self.ops.len()
    }

    /// The operation of a term.
    pub fn op(&self, node: Node) -> &Op {
        &self.ops[node.0 as usize]
    }

    /// The kind of a term's values.
    pub fn kind(&self, node: Node) -> Kind {
        self.kinds[node.0 as usize]
    }

    /// The bounds of a term over integers.
    pub fn bounds(&self, node: Node) -> Bounds {
        self.bounds[node.0 as usize]
    }

    /// The variable with this identifier.
    pub fn variable_of(&self, id: VariableId) -> &Variable {
        &self.variables[id.0 as usize]
    }

    /// The truth value of a constant.
    pub fn truth(&self, node: Node) -> Option<bool> {
        match node {
            Terms::FALSE => Some(false),
            Terms::TRUE => Some(true),
            _ => None,
        }
    }

    fn put(&mut self, op: Op, kind: Kind, bounds: Bounds) -> Node {
        if let Some(node) = self.known.get(&op) {
            return *node;
        }
        let node = Node(self.ops.len() as u32);
        self.ops.push(op.clone());
        self.kinds.push(kind);
        self.bounds.push(bounds);
        self.known.insert(op, node);
        node
    }

    /// Calls `visit` with each operand.
    pub fn each_operand(&self, node: Node, visit: &mut dyn FnMut(Node)) {
        match self.op(node) {
            Op::Boolean(_) | Op::Integer(_) | Op::Real(_) | Op::Variable(_) => {}
            Op::Not(a) | Op::ToReal(a) | Op::Floor(a) => visit(*a),
            Op::Apply(_, all) | Op::And(all) | Op::Or(all) => all.iter().copied().for_each(visit),
            Op::If(a, b, c) => [*a, *b, *c].into_iter().for_each(visit),
            Op::Equal(a, b)
            | Op::Less(a, b)
            | Op::Add(a, b)
            | Op::Subtract(a, b)
            | Op::Multiply(a, b)
            | Op::Quotient(a, b)
            | Op::Remainder(a, b)
            | Op::Divide(a, b) => [*a, *b].into_iter().for_each(visit),
        }
    }

    /// All subterms of these terms, including themselves, operands first.
    pub fn parts(&self, roots: impl IntoIterator<Item = Node>) -> Vec<Node> {
        let mut seen = vec![false; self.ops.len()];
        let mut open: Vec<Node> = roots.into_iter().collect();
        while let Some(node) = open.pop() {
            if !std::mem::replace(&mut seen[node.0 as usize], true) {
                self.each_operand(node, &mut |operand| open.push(operand));
            }
        }
        (0..self.ops.len() as u32).map(Node).filter(|node| seen[node.0 as usize]).collect()
    }

    /// The variables in these terms, in order.
    pub fn variables_of(&self, roots: impl IntoIterator<Item = Node>) -> Vec<VariableId> {
        let parts = self.parts(roots);
        let mut found: Vec<VariableId> = parts
            .into_iter()
            .filter_map(|node| match self.op(node) {
                Op::Variable(id) => Some(*id),
                _ => None,
            })
            .collect();
        found.sort_unstable();
        found
    }

    /// A term in which terms replace variables; `made` caches results for the same replacement.
    pub fn replace(
        &mut self,
        node: Node,
        by: &dyn Fn(VariableId) -> Option<Node>,
        made: &mut FxHashMap<Node, Node>,
    ) -> Node {
        for part in self.parts([node]) {
            if made.contains_key(&part) {
                continue;
            }
            let at = |node: &Node| made[node];
            let new = match self.op(part).clone() {
                Op::Variable(id) => by(id).unwrap_or(part),
                Op::Boolean(_) | Op::Integer(_) | Op::Real(_) => part,
                Op::Apply(id, all) => self.apply(id, all.iter().map(at).collect()),
                Op::Not(a) => self.not(at(&a)),
                Op::And(all) => self.and(all.iter().map(at).collect::<Vec<_>>()),
                Op::Or(all) => self.or(all.iter().map(at).collect::<Vec<_>>()),
                Op::Equal(a, b) => self.equal(at(&a), at(&b)),
                Op::Less(a, b) => self.less(at(&a), at(&b)),
                Op::If(a, b, c) => self.choose(at(&a), at(&b), at(&c)),
                Op::Add(a, b) => self.add(at(&a), at(&b)),
                Op::Subtract(a, b) => self.subtract(at(&a), at(&b)),
                Op::Multiply(a, b) => self.multiply(at(&a), at(&b)),
                Op::Quotient(a, b) => self.quotient(at(&a), at(&b)),
                Op::Remainder(a, b) => self.remainder(at(&a), at(&b)),
                Op::Divide(a, b) => self.divide(at(&a), at(&b)),
                Op::ToReal(a) => self.to_real(at(&a)),
                Op::Floor(a) => self.floor(at(&a)),
            };
            made.insert(part, new);
        }
        made[&node]
    }
}
