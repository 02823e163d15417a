//! The constructors of [`Terms`], which simplify.
//!
//! Real constants are compared but never computed with: the machine rounds, solvers do not.

use super::{Bounds, Kind, Node, Op, Terms, Variable, VariableId};
use crate::session::Constant;

/// The operands of an extreme result.
type Corner = Option<(i128, i128)>;

impl Terms {
    /// A new variable.
    pub fn variable(&mut self, name: impl Into<String>, kind: Kind, bounds: Bounds) -> Node {
        let id = self.function(name, Vec::new(), kind, bounds);
        self.apply(id, Vec::new())
    }

    /// A new uninterpreted function, of which only the bounds of its values are known.
    pub fn function(
        &mut self,
        name: impl Into<String>,
        parameters: Vec<Kind>,
        kind: Kind,
        bounds: Bounds,
    ) -> VariableId {
        self.variables.push(Variable { name: name.into(), kind, parameters, bounds });
        VariableId(self.variables.len() as u32 - 1)
    }

    /// The value of a function at arguments; without parameters, a variable.
    pub fn apply(&mut self, function: VariableId, arguments: Vec<Node>) -> Node {
        let Variable { kind, bounds, .. } = self.variables[function.0 as usize];
        let op = match arguments.is_empty() {
            true => Op::Variable(function),
            false => Op::Apply(function, arguments.into()),
        };
        self.put(op, kind, bounds)
    }

    /// Gives a variable another name.
    pub fn rename(&mut self, id: VariableId, name: impl Into<String>) {
        self.variables[id.0 as usize].name = name.into();
    }

    /// An existing variable.
    pub fn known(&mut self, id: VariableId) -> Node {
        self.apply(id, Vec::new())
    }

    /// A truth value.
    pub fn boolean(&self, truth: bool) -> Node {
        if truth { Terms::TRUE } else { Terms::FALSE }
    }

    /// An integer.
    pub fn integer(&mut self, number: i128) -> Node {
        self.put(Op::Integer(number), Kind::Integer, (Some(number), Some(number)))
    }

    /// A finite real number.
    pub fn real(&mut self, number: f64) -> Node {
        self.put(Op::Real((number + 0.0).to_bits()), Kind::Real, (None, None))
    }

    /// A constant; a real one must be finite.
    pub fn of_constant(&mut self, constant: Constant) -> Node {
        match constant {
            Constant::Boolean(truth) => self.boolean(truth),
            Constant::Integer(number) => self.integer(number),
            Constant::Real(number) => self.real(number),
        }
    }

    /// The integer that a constant is.
    pub fn whole(&self, node: Node) -> Option<i128> {
        match self.op(node) {
            Op::Integer(number) => Some(*number),
            _ => None,
        }
    }

    fn double(&self, node: Node) -> Option<f64> {
        match self.op(node) {
            Op::Real(bits) => Some(f64::from_bits(*bits)),
            _ => None,
        }
    }

    fn is_constant(&self, node: Node) -> bool {
        matches!(self.op(node), Op::Boolean(_) | Op::Integer(_) | Op::Real(_))
    }

    /// Negation.
    #[allow(clippy::should_implement_trait, reason = "it is no operator of Rust's")]
    pub fn not(&mut self, a: Node) -> Node {
        match self.op(a) {
            Op::Boolean(truth) => self.boolean(!truth),
            Op::Not(inner) => *inner,
            _ => self.put(Op::Not(a), Kind::Boolean, (None, None)),
        }
    }

    /// Conjunction.
    pub fn and(&mut self, all: impl IntoIterator<Item = Node>) -> Node {
        self.joined(all.into_iter().collect(), true)
    }

    /// Disjunction.
    pub fn or(&mut self, all: impl IntoIterator<Item = Node>) -> Node {
        self.joined(all.into_iter().collect(), false)
    }

    fn joined(&mut self, all: Vec<Node>, neutral: bool) -> Node {
        let mut flat = Vec::with_capacity(all.len());
        for node in all {
            match (self.op(node), neutral) {
                (Op::Boolean(truth), _) if *truth == neutral => {}
                (Op::Boolean(truth), _) => return self.boolean(*truth),
                (Op::And(inner), true) | (Op::Or(inner), false) => flat.extend(inner.iter().copied()),
                _ => flat.push(node),
            }
        }
        flat.sort_unstable();
        flat.dedup();
        let contradicts = |node: &Node| match self.op(*node) {
            Op::Not(inner) => flat.binary_search(inner).is_ok(),
            _ => false,
        };
        if flat.iter().any(contradicts) {
            return self.boolean(!neutral);
        }
        match flat[..] {
            [] => self.boolean(neutral),
            [one] => one,
            _ if neutral => self.put(Op::And(flat.into()), Kind::Boolean, (None, None)),
            _ => self.put(Op::Or(flat.into()), Kind::Boolean, (None, None)),
        }
    }

    /// Implication.
    pub fn implies(&mut self, a: Node, b: Node) -> Node {
        let not = self.not(a);
        self.or([not, b])
    }

    /// `yes` if the condition holds, else `no`; both are of one kind.
    pub fn choose(&mut self, condition: Node, yes: Node, no: Node) -> Node {
        if let Op::Not(inner) = self.op(condition) {
            return self.choose(*inner, no, yes);
        }
        match (self.truth(condition), self.truth(yes), self.truth(no)) {
            (Some(true), ..) => return yes,
            (Some(false), ..) => return no,
            _ if yes == no => return yes,
            (_, Some(true), _) => return self.or([condition, no]),
            (_, Some(false), _) => {
                let not = self.not(condition);
                return self.and([not, no]);
            }
            (_, _, Some(true)) => {
                let not = self.not(condition);
                return self.or([not, yes]);
            }
            (_, _, Some(false)) => return self.and([condition, yes]),
            _ => {}
        }
        // Within a branch the condition is known.
        let yes = match self.op(yes) {
            Op::If(inner, first, _) if *inner == condition => *first,
            _ => yes,
        };
        let no = match self.op(no) {
            Op::If(inner, _, second) if *inner == condition => *second,
            _ => no,
        };
        if yes == no {
            return yes;
        }
        let (a, b) = (self.bounds(yes), self.bounds(no));
        let bounds = (a.0.zip(b.0).map(|(a, b)| a.min(b)), a.1.zip(b.1).map(|(a, b)| a.max(b)));
        self.put(Op::If(condition, yes, no), self.kind(yes), bounds)
    }

    /// Equality of two terms of one kind.
    pub fn equal(&mut self, a: Node, b: Node) -> Node {
        let (a, b) = if a <= b { (a, b) } else { (b, a) };
        if a == b {
            return Terms::TRUE;
        }
        if self.is_constant(a) && self.is_constant(b) {
            return Terms::FALSE;
        }
        match (self.truth(a), self.truth(b)) {
            (Some(true), _) => return b,
            (Some(false), _) => return self.not(b),
            (_, Some(true)) => return a,
            (_, Some(false)) => return self.not(a),
            _ => {}
        }
        if self.below(a, b) == Some(true) || self.below(b, a) == Some(true) {
            return Terms::FALSE;
        }
        for (constant, other) in [(a, b), (b, a)] {
            if let (true, Op::If(condition, yes, no)) = (self.is_constant(constant), self.op(other).clone())
                && (self.is_constant(yes) || self.is_constant(no))
            {
                let (yes, no) = (self.equal(constant, yes), self.equal(constant, no));
                return self.choose(condition, yes, no);
            }
        }
        self.put(Op::Equal(a, b), Kind::Boolean, (None, None))
    }

    /// Whether one integer is always (or never) less than another.
    fn below(&self, a: Node, b: Node) -> Option<bool> {
        let (a, b) = (self.bounds(a), self.bounds(b));
        match (a.1.zip(b.0), a.0.zip(b.1)) {
            (Some((high, low)), _) if high < low => Some(true),
            (_, Some((low, high))) if low >= high => Some(false),
            _ => None,
        }
    }

    /// Less than.
    pub fn less(&mut self, a: Node, b: Node) -> Node {
        if a == b {
            return Terms::FALSE;
        }
        if let Some(truth) = self.below(a, b) {
            return self.boolean(truth);
        }
        if let (Some(x), Some(y)) = (self.double(a), self.double(b)) {
            return self.boolean(x < y);
        }
        if let (true, Op::If(condition, yes, no)) = (self.is_constant(b), self.op(a).clone())
            && (self.is_constant(yes) || self.is_constant(no))
        {
            let (yes, no) = (self.less(yes, b), self.less(no, b));
            return self.choose(condition, yes, no);
        }
        if let (true, Op::If(condition, yes, no)) = (self.is_constant(a), self.op(b).clone())
            && (self.is_constant(yes) || self.is_constant(no))
        {
            let (yes, no) = (self.less(a, yes), self.less(a, no));
            return self.choose(condition, yes, no);
        }
        self.put(Op::Less(a, b), Kind::Boolean, (None, None))
    }

    /// Less than or equal.
    pub fn at_most(&mut self, a: Node, b: Node) -> Node {
        let greater = self.less(b, a);
        self.not(greater)
    }

    /// Whether an integer lies within bounds.
    pub fn within(&mut self, a: Node, (low, high): Bounds) -> Node {
        let mut all = Vec::new();
        if let Some(low) = low {
            let low = self.integer(low);
            all.push(self.at_most(low, a));
        }
        if let Some(high) = high {
            let high = self.integer(high);
            all.push(self.at_most(a, high));
        }
        self.and(all)
    }

    /// The bounds of a variable, written out as a condition.
    pub fn bound(&mut self, id: VariableId, (low, high): Bounds) -> Node {
        let variable =
            self.put(Op::Variable(id), self.variables[id.0 as usize].kind, self.variables[id.0 as usize].bounds);
        let mut all = Vec::new();
        for (bound, below) in [(low, true), (high, false)] {
            let Some(bound) = bound else { continue };
            let bound = self.integer(bound);
            // The bounds decide this comparison, so a constructor would simplify it away.
            let (a, b) = if below { (variable, bound) } else { (bound, variable) };
            let beyond = self.put(Op::Less(a, b), Kind::Boolean, (None, None));
            all.push(self.not(beyond));
        }
        self.and(all)
    }

    /// Sum.
    pub fn add(&mut self, a: Node, b: Node) -> Node {
        self.computed(Op::Add(a, b), a, b, i128::checked_add, |a, b| (a.0.zip(b.0), a.1.zip(b.1)))
    }

    /// Difference.
    pub fn subtract(&mut self, a: Node, b: Node) -> Node {
        self.computed(Op::Subtract(a, b), a, b, i128::checked_sub, |a, b| (a.0.zip(b.1), a.1.zip(b.0)))
    }

    fn computed(
        &mut self,
        op: Op,
        a: Node,
        b: Node,
        compute: fn(i128, i128) -> Option<i128>,
        corners: fn(Bounds, Bounds) -> (Corner, Corner),
    ) -> Node {
        let kind = self.kind(a);
        if kind == Kind::Real {
            return self.put(op, kind, (None, None));
        }
        if let (Some(x), Some(y)) = (self.whole(a), self.whole(b))
            && let Some(result) = compute(x, y)
        {
            return self.integer(result);
        }
        if self.whole(b) == Some(0) {
            return a;
        }
        let (low, high) = corners(self.bounds(a), self.bounds(b));
        let at = |corner: Corner| corner.and_then(|(x, y)| compute(x, y));
        self.put(op, kind, (at(low), at(high)))
    }

    /// Product.
    pub fn multiply(&mut self, a: Node, b: Node) -> Node {
        let kind = self.kind(a);
        if kind == Kind::Real {
            return self.put(Op::Multiply(a, b), kind, (None, None));
        }
        match (self.whole(a), self.whole(b)) {
            (Some(0), _) | (_, Some(1)) => return a,
            (_, Some(0)) | (Some(1), _) => return b,
            _ => {}
        }
        let bounds = match (self.bounds(a), self.bounds(b)) {
            ((Some(al), Some(ah)), (Some(bl), Some(bh))) => {
                let corners = [al.checked_mul(bl), al.checked_mul(bh), ah.checked_mul(bl), ah.checked_mul(bh)];
                match corners.iter().copied().collect::<Option<Vec<i128>>>() {
                    Some(corners) => (corners.iter().min().copied(), corners.iter().max().copied()),
                    None => (None, None),
                }
            }
            _ => (None, None),
        };
        match bounds {
            (Some(low), Some(high)) if low == high => self.integer(low),
            _ => self.put(Op::Multiply(a, b), kind, bounds),
        }
    }

    /// Integer quotient, truncated toward zero; the divisor must not be 0.
    pub fn quotient(&mut self, a: Node, b: Node) -> Node {
        if let (Some(x), Some(y)) = (self.whole(a), self.whole(b))
            && let Some(result) = x.checked_div(y)
        {
            return self.integer(result);
        }
        // Its absolute value is at most that of the dividend.
        let most = self.size(a);
        self.put(Op::Quotient(a, b), Kind::Integer, (most.map(|most| -most), most))
    }

    /// Remainder of the truncated quotient.
    pub fn remainder(&mut self, a: Node, b: Node) -> Node {
        if let (Some(x), Some(y)) = (self.whole(a), self.whole(b))
            && let Some(result) = x.checked_rem(y)
        {
            return self.integer(result);
        }
        let (low, high) = self.bounds(a);
        let divisor = self.size(b).map(|size| size - 1);
        let most = divisor.into_iter().chain(self.size(a)).min();
        let low = if low.is_some_and(|low| low >= 0) { Some(0) } else { most.map(|most| -most) };
        let high = if high.is_some_and(|high| high <= 0) { Some(0) } else { most };
        if let (Op::If(condition, yes, no), Some(_)) = (self.op(a).clone(), self.whole(b))
            && (self.is_constant(yes) || self.is_constant(no))
        {
            let (yes, no) = (self.remainder(yes, b), self.remainder(no, b));
            return self.choose(condition, yes, no);
        }
        // A smaller dividend is its own remainder.
        if let (Some(number), (Some(least), Some(greatest))) = (self.whole(b), self.bounds(a))
            && least >= 0
            && greatest < number
        {
            return a;
        }
        self.put(Op::Remainder(a, b), Kind::Integer, (low, high))
    }

    /// The largest absolute value.
    fn size(&self, a: Node) -> Option<i128> {
        let (low, high) = self.bounds(a);
        Some(low?.checked_abs()?.max(high?.checked_abs()?))
    }

    /// Quotient of reals; the divisor must not be 0.
    pub fn divide(&mut self, a: Node, b: Node) -> Node {
        self.put(Op::Divide(a, b), Kind::Real, (None, None))
    }

    /// An integer as a real.
    pub fn to_real(&mut self, a: Node) -> Node {
        match self.whole(a) {
            Some(number) if number.abs() < 1 << 53 => self.real(number as f64),
            _ => self.put(Op::ToReal(a), Kind::Real, (None, None)),
        }
    }

    /// The largest integer that is not greater than a real.
    pub fn floor(&mut self, a: Node) -> Node {
        match self.double(a) {
            Some(number) if number.abs() < 9e15 => self.integer(number.floor() as i128),
            _ => self.put(Op::Floor(a), Kind::Integer, (None, None)),
        }
    }
}
