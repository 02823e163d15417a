//! Evaluates terms, given the values of their variables.

use super::{Node, Op, Terms, VariableId};
use crate::session::Constant;

impl Terms {
    /// The value of a constant.
    pub fn constant(&self, node: Node) -> Option<Constant> {
        match self.op(node) {
            Op::Boolean(truth) => Some(Constant::Boolean(*truth)),
            Op::Integer(number) => Some(Constant::Integer(*number)),
            Op::Real(bits) => Some(Constant::Real(f64::from_bits(*bits))),
            _ => None,
        }
    }

    /// All constants, including those that simplification has removed from terms.
    pub(crate) fn constants(&self) -> Vec<Constant> {
        (0..self.count()).filter_map(|index| self.constant(Node(index as u32))).collect()
    }

    /// The values of all terms, indexed by node; `None` for terms without a value, such as a quotient by zero. Reals
    /// are computed as doubles.
    pub fn values(&self, variable: &dyn Fn(VariableId) -> Option<Constant>) -> Vec<Option<Constant>> {
        let mut values: Vec<Option<Constant>> = Vec::with_capacity(self.count());
        for index in 0..self.count() {
            let node = Node(index as u32);
            let value = match self.op(node) {
                Op::Variable(id) => variable(*id),
                _ => self.value_by(node, &|operand| values[operand.0 as usize]),
            };
            values.push(value);
        }
        values
    }

    /// The value of an operation, given those of its operands; `None` for a variable or function.
    pub(crate) fn value_by(&self, node: Node, of: &dyn Fn(Node) -> Option<Constant>) -> Option<Constant> {
        use Constant::{Boolean, Integer, Real};
        let at = |node: &Node| of(*node);
        let truth = |node: &Node| match at(node) {
            Some(Boolean(truth)) => Some(truth),
            _ => None,
        };
        let all = |nodes: &[Node], deciding: bool| {
            let decided = nodes.iter().any(|node| truth(node) == Some(deciding));
            let known = nodes.iter().all(|node| truth(node).is_some());
            (decided || known).then_some(Boolean(decided == deciding))
        };
        let computed = |a: &Node, b: &Node, whole: fn(i128, i128) -> Option<i128>, real: fn(f64, f64) -> f64| match (
            at(a)?,
            at(b)?,
        ) {
            (Integer(a), Integer(b)) => whole(a, b).map(Integer),
            (Real(a), Real(b)) => Some(Real(real(a, b))),
            _ => None,
        };
        match self.op(node) {
            Op::Boolean(_) | Op::Integer(_) | Op::Real(_) => self.constant(node),
            Op::Variable(_) | Op::Apply(..) => None,
            Op::Not(a) => truth(a).map(|truth| Boolean(!truth)),
            Op::And(nodes) => all(nodes, false),
            Op::Or(nodes) => all(nodes, true),
            Op::Equal(a, b) => Some(Boolean(at(a)? == at(b)?)),
            Op::Less(a, b) => match (at(a)?, at(b)?) {
                (Integer(a), Integer(b)) => Some(Boolean(a < b)),
                (Real(a), Real(b)) => Some(Boolean(a < b)),
                _ => None,
            },
            Op::If(condition, yes, no) => at(if truth(condition)? { yes } else { no }),
            Op::Add(a, b) => computed(a, b, i128::checked_add, |a, b| a + b),
            Op::Subtract(a, b) => computed(a, b, i128::checked_sub, |a, b| a - b),
            Op::Multiply(a, b) => computed(a, b, i128::checked_mul, |a, b| a * b),
            Op::Divide(a, b) => computed(a, b, |_, _| None, |a, b| a / b),
            Op::Quotient(a, b) => computed(a, b, i128::checked_div, |_, _| f64::NAN),
            Op::Remainder(a, b) => computed(a, b, i128::checked_rem, |_, _| f64::NAN),
            Op::ToReal(a) => match at(a)? {
                Integer(number) => Some(Real(number as f64)),
                _ => None,
            },
            Op::Floor(a) => match at(a)? {
                Real(number) if number.is_finite() => Some(Integer(number.floor() as i128)),
                _ => None,
            },
        }
    }
}

/// The value of a term, looked up in the values of all terms.
pub fn value_at(values: &[Option<Constant>], node: Node) -> Option<Constant> {
    values[node.0 as usize]
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::shared::Kind;

    #[test]
    fn what_decides_is_enough() {
        let mut terms = Terms::default();
        let p = terms.variable("p", Kind::Boolean, (None, None));
        let x = terms.variable("x", Kind::Integer, (None, None));
        let (seven, zero) = (terms.integer(-7), terms.integer(0));
        let rest = terms.remainder(seven, x);
        let none = terms.equal(rest, zero);
        let either = terms.or([p, none]);
        let at = |p: bool, x: i128| {
            let values = terms.values(&|id| Some(if id.0 == 0 { Constant::Boolean(p) } else { Constant::Integer(x) }));
            (value_at(&values, either), value_at(&values, rest))
        };
        assert_eq!(at(true, 0), (Some(Constant::Boolean(true)), None));
        assert_eq!(at(false, 0), (None, None));
        assert_eq!(at(false, 2), (Some(Constant::Boolean(false)), Some(Constant::Integer(-1))));
    }
}
