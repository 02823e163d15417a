//! Why a part of the coupling does not hold of two states: what it looked at, with its values.
//!
//! In: a [`Judge`], a part that fails, two states. Out: a [`Part`]. Of a conjunction only what fails is told, and of `forall` only the
//! instances that fail, so many of them at most. INVARIANT: whatever is told was read by something that does not hold.

use machine::{Location, Show, Value};
use program::{Binder, Builtin, Quantifier, Term, TermId};

use crate::coupling::{Conjunct, Coupling};
use crate::judge::{Bound, Judge, Read};
use crate::side::{Side, StateId};
use crate::{ABSTRACT, CONCRETE, SIDES};

/// LIMIT: so many instances, or arguments of a function, are told.
const SHOWN: usize = 4;
/// LIMIT: so many instances are gone through.
const INSTANCES: usize = 1 << 16;

/// A part of the coupling that does not hold.
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub struct Part {
    /// As the coupling says it.
    pub text: String,
    /// What it looks at, with the values, where that fails.
    pub values: Differs,
    /// Instances of a `forall` that do not hold.
    pub instances: Vec<Instance>,
    /// So many more instances, or arguments, are not told.
    pub more: usize,
    /// Why it is neither true nor false.
    pub trouble: Option<String>,
}

/// An instance of a `forall` that does not hold.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Instance {
    /// The variables.
    pub bound: Differs,
    /// What it looks at.
    pub values: Differs,
    /// Why it is neither true nor false.
    pub trouble: Option<String>,
}

/// Names with values.
pub type Differs = Vec<(String, String)>;

/// The part of the coupling with this index, of two states.
pub(crate) fn why<'c>(judge: &mut Judge<'c>, sides: &mut [Side<'c>; 2], index: usize, states: [StateId; 2]) -> Part {
    let coupling = judge.coupling;
    let text = coupling.conjunct(index);
    match &coupling.conjuncts[index] {
        Conjunct::Term { formula, .. } => {
            let names = formula.names.clone();
            let mut telling = Telling {
                judge,
                sides,
                states,
                frame: formula.frame,
                names,
                leaves: Vec::new(),
                more: 0,
                left: INSTANCES,
            };
            telling.explain(formula.body, &[], &[]);
            let Telling { leaves, more, .. } = telling;
            let mut part = Part { text, ..Part::default() };
            match leaves.iter().any(|leaf| !leaf.bound.is_empty()) {
                true => (part.instances, part.more) = (leaves, more),
                false => {
                    for leaf in leaves {
                        let new = leaf.values.into_iter().filter(|value| !part.values.contains(value));
                        part.values.extend(new.collect::<Vec<_>>());
                        part.trouble = part.trouble.or(leaf.trouble);
                    }
                }
            }
            part
        }
        Conjunct::Same { name, .. } => {
            let both = [ABSTRACT, CONCRETE].map(|side| judge.values_of(sides, index, side, states[side]));
            let program = &coupling.joint.program;
            let (mut values, mut count) = (Vec::new(), 0);
            let all: std::collections::BTreeSet<&Vec<Value>> = both.iter().flat_map(|values| values.keys()).collect();
            for arguments in all {
                let of = |side: usize| both[side].get(arguments).cloned().unwrap_or(Value::Undef);
                if of(ABSTRACT) == of(CONCRETE) {
                    continue;
                }
                count += 1;
                if count > SHOWN {
                    continue;
                }
                let listed: Vec<String> = arguments.iter().map(|value| value.show(program).to_string()).collect();
                let listed = if listed.is_empty() { String::new() } else { format!("({})", listed.join(",")) };
                for (side, word) in SIDES.iter().enumerate() {
                    values.push((format!("{word}.{name}{listed}"), of(side).show(program).to_string()));
                }
            }
            Part { text, values, more: count.max(SHOWN) - SHOWN, ..Part::default() }
        }
    }
}

/// A name with the value of what was read.
fn shown(coupling: &Coupling, read: &Read) -> (String, String) {
    let program = &coupling.joint.program;
    let (side, function, arguments, value) = read;
    let name = Location { function: *function, arguments: arguments.clone() }.show(program).to_string();
    let prefix = crate::joint::joint_name(*side, "");
    let plain = name.strip_prefix(&prefix).unwrap_or(&name).to_string();
    (format!("{}.{plain}", SIDES[*side]), value.show(program).to_string())
}

/// What fails of a term, as it is found.
struct Telling<'t, 'c> {
    judge: &'t mut Judge<'c>,
    sides: &'t mut [Side<'c>; 2],
    states: [StateId; 2],
    frame: u32,
    names: Vec<String>,
    leaves: Vec<Instance>,
    more: usize,
    /// So many instances may still be gone through.
    left: usize,
}

impl Telling<'_, '_> {
    fn evaluate(&mut self, term: TermId, bound: &[Bound]) -> (Result<Value, String>, Vec<Read>) {
        self.judge.evaluate_with(self.sides, (term, self.frame), bound, self.states)
    }

    fn fails(&mut self, term: TermId, bound: &[Bound]) -> bool {
        self.evaluate(term, bound).0 != Ok(Value::Boolean(true))
    }

    /// Tells what fails of a term that does not hold. `before` was read on the way to it.
    fn explain(&mut self, term: TermId, bound: &[Bound], before: &[Read]) {
        let program = &self.judge.coupling.joint.program;
        match program.term(term) {
            Term::Builtin { builtin: Builtin::And, arguments } => {
                for operand in program.term_list(*arguments) {
                    if self.fails(*operand, bound) {
                        self.explain(*operand, bound, before);
                    }
                }
            }
            Term::Builtin { builtin: Builtin::Implies, arguments } => {
                let [premise, conclusion] = *program.term_list(*arguments) else { return };
                let (value, reads) = self.evaluate(premise, bound);
                match value {
                    Ok(Value::Boolean(true)) => self.explain(conclusion, bound, &[before, &reads].concat()),
                    _ => self.leaf(term, bound, before),
                }
            }
            Term::Quantified { quantifier: Quantifier::Forall, binders, condition: Some(condition) } => {
                let binders = program.binder_list(*binders);
                if !self.instances(binders, *condition, bound, before) {
                    self.leaf(term, bound, before);
                }
            }
            _ => self.leaf(term, bound, before),
        }
    }

    /// Goes through the values of variables; false if they cannot be listed.
    fn instances(&mut self, binders: &[Binder], condition: TermId, bound: &[Bound], before: &[Read]) -> bool {
        let [binder, rest @ ..] = binders else {
            if self.left > 0 && self.fails(condition, bound) {
                self.explain(condition, bound, before);
            }
            self.left = self.left.saturating_sub(1);
            return true;
        };
        let program = &self.judge.coupling.joint.program;
        let values = match program.term(binder.range) {
            Term::Domain(domain) => self.judge.elements(*domain),
            _ => match self.evaluate(binder.range, bound).0 {
                Ok(Value::Set(values) | Value::Seq(values)) => Some(values.iter().cloned().collect()),
                _ => None,
            },
        };
        let Some(values) = values else { return false };
        for value in values {
            let bound = [bound, &[(binder.slot, value)]].concat();
            if !self.instances(rest, condition, &bound, before) {
                return false;
            }
        }
        true
    }

    /// Tells of a term as a whole.
    fn leaf(&mut self, term: TermId, bound: &[Bound], before: &[Read]) {
        if self.leaves.len() >= SHOWN && !bound.is_empty() {
            self.more += 1;
            return;
        }
        let (value, reads) = self.evaluate(term, bound);
        let coupling = self.judge.coupling;
        let mut values = Differs::new();
        for read in before.iter().chain(&reads) {
            let shown = shown(coupling, read);
            if !values.contains(&shown) {
                values.push(shown);
            }
        }
        let trouble = match value {
            Err(fault) => Some(format!("cannot be evaluated ({fault})")),
            Ok(Value::Undef) => Some("is undef".to_string()),
            Ok(_) => None,
        };
        let named = |(slot, value): &Bound| {
            let name = self.names.get(slot.0 as usize).cloned().unwrap_or_default();
            (name, value.show(&coupling.joint.program).to_string())
        };
        let bound = bound.iter().map(named).collect();
        self.leaves.push(Instance { bound, values, trouble });
    }
}
