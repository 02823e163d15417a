//! Writes shared terms as SMT-LIB 2.6.
//!
//! A term is written for a *time*, which becomes part of the names of variables, so that one transition relation can be
//! written for many steps. Shared subterms are named by `define-fun`, or by `let` within a quantifier.

use std::fmt::Write;

use rustc_hash::{FxHashMap, FxHashSet};

use super::{Kind, Node, Op, Terms, VariableId};

/// Writes the terms of one time.
#[derive(Debug, Default)]
pub struct Script {
    defined: FxHashSet<Node>,
}

impl Script {
    /// Declares variables at a time, with their bounds.
    pub fn declare(terms: &Terms, variables: &[VariableId], time: usize, out: &mut String) {
        for id in variables {
            let variable = terms.variable_of(*id);
            let name = name(terms, *id, Some(time));
            let _ = writeln!(out, "(declare-const {name} {})", sort(variable.kind));
            if let (Some(low), Some(high)) = variable.bounds {
                let _ = writeln!(out, "(assert (<= {} {name} {}))", integer(low), integer(high));
            }
        }
    }

    /// The text of a term at a time; definitions of its shared subterms are added to `out` once.
    pub fn term(&mut self, terms: &Terms, node: Node, time: usize, out: &mut String) -> String {
        let parts = terms.parts([node]);
        let mut uses: FxHashMap<Node, u32> = FxHashMap::default();
        for part in &parts {
            terms.each_operand(*part, &mut |operand| *uses.entry(operand).or_default() += 1);
        }
        for part in parts {
            if part == node || is_leaf(terms, part) || uses[&part] < 2 || self.defined.contains(&part) {
                continue;
            }
            let text = self.text(terms, part, time);
            let _ = writeln!(out, "(define-fun n{}@{time} () {} {text})", part.0, sort(terms.kind(part)));
            self.defined.insert(part);
        }
        self.text(terms, node, time)
    }

    /// The text of a term, in terms of the defined names.
    fn text(&self, terms: &Terms, node: Node, time: usize) -> String {
        let mut text = String::new();
        let named = |node: Node| self.defined.contains(&node).then(|| format!("n{}@{time}", node.0));
        put(terms, node, Some(time), &named, &mut text);
        text
    }

    /// A term within a quantifier over its variables; shared subterms are bound by `let`.
    pub fn closed(terms: &Terms, node: Node) -> String {
        let parts = terms.parts([node]);
        let mut uses: FxHashMap<Node, u32> = FxHashMap::default();
        for part in &parts {
            terms.each_operand(*part, &mut |operand| *uses.entry(operand).or_default() += 1);
        }
        let (mut text, mut bound, mut open) = (String::new(), FxHashSet::default(), 0);
        for part in parts {
            if part == node || is_leaf(terms, part) || uses[&part] < 2 {
                continue;
            }
            let named = |node: Node| bound.contains(&node).then(|| format!("n{}", node.0));
            let _ = write!(text, "(let ((n{} ", part.0);
            put(terms, part, None, &named, &mut text);
            text.push_str("))\n");
            bound.insert(part);
            open += 1;
        }
        put(terms, node, None, &|node| bound.contains(&node).then(|| format!("n{}", node.0)), &mut text);
        text.extend(std::iter::repeat_n(')', open));
        text
    }

    /// An integer.
    pub fn whole(number: i128) -> String {
        integer(number)
    }

    /// The name of a kind.
    pub fn sort(kind: Kind) -> &'static str {
        sort(kind)
    }

    /// The name of a variable at a time.
    pub fn name(terms: &Terms, id: VariableId, time: usize) -> String {
        name(terms, id, Some(time))
    }

    /// The name of a variable within a quantifier.
    pub fn bound_name(terms: &Terms, id: VariableId) -> String {
        name(terms, id, None)
    }

    /// Declares functions and variables without a time.
    pub fn declare_bound(terms: &Terms, functions: &[VariableId], out: &mut String) {
        for id in functions {
            let function = terms.variable_of(*id);
            let parameters: Vec<&str> = function.parameters.iter().map(|kind| sort(*kind)).collect();
            let parameters = parameters.join(" ");
            let _ = writeln!(out, "(declare-fun {} ({parameters}) {})", name(terms, *id, None), sort(function.kind));
        }
    }

    /// `(name sort)`, as quantifiers bind a variable.
    pub fn binding(terms: &Terms, id: VariableId) -> String {
        format!("({} {})", name(terms, id, None), sort(terms.variable_of(id).kind))
    }
}

/// A variable's name, at a time or within a quantifier.
fn name(terms: &Terms, id: VariableId, time: Option<usize>) -> String {
    let bare = terms.variable_of(id).name.replace(['|', '\\'], "_");
    match time {
        Some(time) => format!("|{bare}.{}@{time}|", id.0),
        None => format!("|{bare}.{}|", id.0),
    }
}

/// The name of a kind.
fn sort(kind: Kind) -> &'static str {
    match kind {
        Kind::Boolean => "Bool",
        Kind::Integer => "Int",
        Kind::Real => "Real",
    }
}

fn is_leaf(terms: &Terms, node: Node) -> bool {
    match terms.op(node) {
        Op::Boolean(_) | Op::Integer(_) | Op::Real(_) | Op::Variable(_) => true,
        Op::Not(inner) => matches!(terms.op(*inner), Op::Variable(_)),
        _ => false,
    }
}

fn put(terms: &Terms, node: Node, time: Option<usize>, named: &dyn Fn(Node) -> Option<String>, out: &mut String) {
    let list = |head: &str, operands: &[Node], out: &mut String| {
        let _ = write!(out, "({head}");
        for operand in operands {
            out.push(' ');
            match named(*operand) {
                Some(name) => out.push_str(&name),
                None => stacker::maybe_grow(64 << 10, 1 << 20, || put(terms, *operand, time, named, out)),
            }
        }
        out.push(')');
    };
    match terms.op(node) {
        Op::Boolean(truth) => _ = write!(out, "{truth}"),
        Op::Integer(number) => out.push_str(&integer(*number)),
        Op::Real(bits) => out.push_str(&exact_real(f64::from_bits(*bits))),
        Op::Variable(id) => out.push_str(&name(terms, *id, time)),
        Op::Apply(id, all) => list(&name(terms, *id, time), all, out),
        Op::Not(a) => list("not", &[*a], out),
        Op::And(all) => list("and", all, out),
        Op::Or(all) => list("or", all, out),
        Op::Equal(a, b) => list("=", &[*a, *b], out),
        Op::Less(a, b) => list("<", &[*a, *b], out),
        Op::If(a, b, c) => list("ite", &[*a, *b, *c], out),
        Op::Add(a, b) => list("+", &[*a, *b], out),
        Op::Subtract(a, b) => list("-", &[*a, *b], out),
        Op::Multiply(a, b) => list("*", &[*a, *b], out),
        Op::Divide(a, b) => list("/", &[*a, *b], out),
        Op::ToReal(a) => list("to_real", &[*a], out),
        Op::Floor(a) => list("to_int", &[*a], out),
        Op::Quotient(a, b) => towards_zero("div", terms, (*a, *b), &list, out),
        Op::Remainder(a, b) => towards_zero("mod", terms, (*a, *b), &list, out),
    }
}

/// SMT-LIB's integer division is Euclidean.
fn towards_zero(
    operation: &str,
    terms: &Terms,
    (a, b): (Node, Node),
    list: &dyn Fn(&str, &[Node], &mut String),
    out: &mut String,
) {
    if terms.bounds(a).0.is_some_and(|low| low >= 0) {
        return list(operation, &[a, b], out);
    }
    out.push_str("(ite ");
    list("<= 0", &[a], out);
    out.push(' ');
    list(operation, &[a, b], out);
    let _ = write!(out, " (- ({operation} ");
    list("-", &[a], out);
    out.push(' ');
    // An operation with a single operand.
    list("+ 0", &[b], out);
    out.push_str(")))");
}

fn integer(number: i128) -> String {
    if number < 0 { format!("(- {})", number.unsigned_abs()) } else { number.to_string() }
}

/// The exact value of a double.
pub fn exact_real(number: f64) -> String {
    let size = number.abs();
    let bits = size.to_bits();
    let (raw, fraction) = ((bits >> 52) as i32, bits & ((1 << 52) - 1));
    let (mut mantissa, mut exponent) = if raw == 0 { (fraction, -1074) } else { (fraction | 1 << 52, raw - 1075) };
    while mantissa != 0 && mantissa % 2 == 0 && exponent < 0 {
        (mantissa, exponent) = (mantissa / 2, exponent + 1);
    }
    let text = match exponent {
        _ if mantissa == 0 => "0.0".to_string(),
        0 => format!("{mantissa}.0"),
        exponent if exponent > 0 => format!("(* {mantissa}.0 {}.0)", power_of_two(exponent as u32)),
        exponent => format!("(/ {mantissa}.0 {}.0)", power_of_two(-exponent as u32)),
    };
    if number < 0.0 { format!("(- {text})") } else { text }
}

fn power_of_two(exponent: u32) -> String {
    let mut digits = vec![1u8];
    for _ in 0..exponent {
        let mut carry = 0;
        for digit in &mut digits {
            let doubled = *digit * 2 + carry;
            (*digit, carry) = (doubled % 10, doubled / 10);
        }
        if carry > 0 {
            digits.push(carry);
        }
    }
    digits.iter().rev().map(|digit| char::from(b'0' + digit)).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn doubles_are_written_as_they_are() {
        let check = |number: f64, text: &str| assert_eq!(exact_real(number), text);
        check(0.0, "0.0");
        check(3.0, "3.0");
        check(-0.5, "(- (/ 1.0 2.0))");
        check(0.1, "(/ 3602879701896397.0 36028797018963968.0)");
        check(2f64.powi(70), "(* 4503599627370496.0 262144.0)");
        check(5e-324, &format!("(/ 1.0 {}.0)", power_of_two(1074)));
    }

    #[test]
    fn what_is_shared_is_named_once() {
        let mut terms = Terms::default();
        let x = terms.variable("x", Kind::Integer, (Some(-3), Some(9)));
        let two = terms.integer(2);
        let rest = terms.remainder(x, two);
        let (zero, one) = (terms.integer(0), terms.integer(1));
        let (even, odd) = (terms.equal(rest, zero), terms.equal(rest, one));
        let either = terms.or([even, odd]);
        let (mut out, mut script) = (String::new(), Script::default());
        let text = script.term(&terms, either, 4, &mut out);
        assert_eq!(text, "(or (= n4@4 0) (= n4@4 1))");
        let expected = "(define-fun n4@4 () Int (ite (<= 0 |x.0@4|) (mod |x.0@4| 2) (- (mod (- |x.0@4|) (+ 0 2)))))\n";
        assert_eq!(out, expected);
        assert_eq!(script.term(&terms, either, 4, &mut String::new()), text);
        let closed = "(let ((n4 (ite (<= 0 |x.0|) (mod |x.0| 2) (- (mod (- |x.0|) (+ 0 2))))))\n\
                      (or (= n4 0) (= n4 1)))";
        assert_eq!(Script::closed(&terms, either), closed);
    }

    #[test]
    fn bounds_decide() {
        let mut terms = Terms::default();
        let x = terms.variable("x", Kind::Integer, (Some(0), Some(3)));
        let one = terms.integer(1);
        let sum = terms.add(x, one);
        let (zero, four) = (terms.integer(0), terms.integer(4));
        assert_eq!(terms.less(zero, sum), Terms::TRUE);
        assert_eq!(terms.less(four, sum), Terms::FALSE);
        assert_eq!(terms.equal(sum, zero), Terms::FALSE);
        let rest = terms.remainder(sum, four);
        assert_eq!(terms.bounds(rest), (Some(0), Some(3)));
        let five = terms.integer(5);
        assert_eq!(terms.remainder(sum, five), sum);
    }
}
