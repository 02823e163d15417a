//! Evaluates a formula on one lasso, directly by the definition.
//!
//! In: a formula, and which propositions hold where on the lasso. Out: whether it holds at the beginning. It shares
//! nothing with the automaton; every counterexample is checked against it before it is shown. A formula with past
//! operators nested to depth d is stable after d turns (Benedetti, Cimatti, *Bounded model checking for past LTL*,
//! 2003), so the loop is unrolled d + 1 times, and the last copy is repeated.

use crate::temporal::formula::{FormulaId, Ltl, LtlFormulas};

/// Whether a formula holds at the beginning of a lasso of `length` states, whose last one is followed by state number
/// `turn`; `holds` evaluates a proposition in a state.
pub fn holds_on_lasso(
    formulas: &LtlFormulas,
    root: FormulaId,
    length: usize,
    turn: usize,
    holds: impl Fn(u32, usize) -> bool,
) -> bool {
    let nodes = &formulas.nodes()[..=root.index()];
    let around = length - turn;
    let copies = past_depth(nodes)[root.index()] + 1;
    let positions = length + (copies - 1) * around;
    let last_turn = positions - around;
    let place = |position: usize| if position < length { position } else { turn + (position - turn) % around };
    let mut needed = vec![false; nodes.len()];
    needed[root.index()] = true;
    for index in (0..nodes.len()).rev().filter(|index| *index <= root.index()) {
        if needed[index] {
            nodes[index].parts().for_each(|part| needed[part.index()] = true);
        }
    }
    let mut truths: Vec<Vec<bool>> = Vec::with_capacity(nodes.len());
    for (index, node) in nodes.iter().enumerate() {
        let of = |formula: &FormulaId| &truths[formula.index()];
        let truth = match node {
            _ if !needed[index] => Vec::new(),
            Ltl::Constant(truth) => vec![*truth; positions],
            Ltl::Proposition(number) => (0..positions).map(|position| holds(*number, place(position))).collect(),
            Ltl::Not(p) => of(p).iter().map(|truth| !truth).collect(),
            Ltl::And(p, q) => of(p).iter().zip(of(q)).map(|(p, q)| *p && *q).collect(),
            Ltl::Next(p) => (0..positions).map(|i| of(p)[if i + 1 < positions { i + 1 } else { last_turn }]).collect(),
            Ltl::Until(p, q) => until(of(p), of(q), last_turn),
            Ltl::Previous(p) => (0..positions).map(|i| i > 0 && of(p)[i - 1]).collect(),
            Ltl::Since(p, q) => {
                let mut since = false;
                let mut next = |(p, q): (&bool, &bool)| {
                    since = *q || (*p && since);
                    since
                };
                of(p).iter().zip(of(q)).map(&mut next).collect()
            }
        };
        truths.push(truth);
    }
    truths[root.index()][0]
}

/// For each position, whether some later position has q and all before that one have p. From any position of the last
/// turn, the run goes around once; what does not occur by then never does.
fn until(p: &[bool], q: &[bool], last_turn: usize) -> Vec<bool> {
    let mut truth = vec![false; p.len()];
    let mut after = false;
    for position in (last_turn..p.len()).rev() {
        after = q[position] || (p[position] && after);
    }
    for position in (0..p.len()).rev() {
        after = q[position] || (p[position] && after);
        truth[position] = after;
    }
    truth
}

/// For each formula, the nesting depth of past operators.
fn past_depth(nodes: &[Ltl]) -> Vec<usize> {
    let mut depth: Vec<usize> = Vec::with_capacity(nodes.len());
    for node in nodes {
        let parts = node.parts().map(|part| depth[part.index()]).max().unwrap_or(0);
        depth.push(parts + usize::from(matches!(node, Ltl::Previous(_) | Ltl::Since(..))));
    }
    depth
}
