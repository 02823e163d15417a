//! The coupling as formulas over an arbitrary state of each machine.
//!
//! In: a coupling, and both machines as formulas that know what it reads. Out: a [`Related`]: whether the relation holds, where segments
//! end, the variant, the values of inputs. Terms are encoded in the joint model, whose functions are given the values that the machines
//! have. INVARIANT: a part that is undef or cannot be evaluated does not hold, as for [`crate::judge`]; `stray` holds wherever a part was
//! not encoded as the machine evaluates it.

use std::collections::{BTreeMap, BTreeSet};
use std::sync::Arc;

use machine::{Bounds, Limits, Machine, Value};
use program::{Expression, FunctionId, Term};
use solve::Outside;
use solve::encode::Encoder;
use solve::shared::{Node, Terms};
use solve::symbol::{Open, Shape, Symbol};

use super::across::across;
use super::symbolic::{Store, Symbolic, nowhere};
use crate::coupling::{Conjunct, Coupling};
use crate::{ABSTRACT, CONCRETE};

/// LIMIT: so many arguments of a function that a term reads are gone through.
const ROWS: usize = 10_000;

/// Locations of a machine that are read.
pub(crate) type Locations = BTreeSet<(FunctionId, Vec<Value>)>;

/// What the coupling reads of each machine.
#[derive(Default)]
pub(crate) struct Read {
    /// Of its states.
    pub states: [Locations; 2],
    /// Of the concrete machine's steps, with their inputs.
    pub steps: Locations,
}

/// A term over both states.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Measure {
    pub value: Node,
    /// It has a value.
    pub known: Node,
}

/// See the module.
pub(crate) struct Related {
    /// The parts of the relation.
    pub parts: Vec<Node>,
    /// Not all of it was encoded.
    pub stray: Node,
    /// A segment ends in the concrete state.
    pub ends: Node,
    pub ends_stray: Node,
    pub variant: Option<Measure>,
    /// By input of the abstract machine, its value given the concrete state and inputs, as that machine has it.
    pub given: BTreeMap<u32, (Symbol, Node)>,
}

impl Related {
    /// The relation surely holds.
    pub fn surely(&self, terms: &mut Terms) -> Node {
        let encoded = terms.not(self.stray);
        terms.and(self.parts.iter().copied().chain([encoded]))
    }

    /// The relation holds, or not all of it was encoded.
    pub fn perhaps(&self, terms: &mut Terms) -> Node {
        let all = terms.and(self.parts.iter().copied());
        terms.or([all, self.stray])
    }
}

/// The functions of the joint model that a term reads.
fn joint_functions(coupling: &Coupling, formula: &Expression) -> BTreeSet<FunctionId> {
    let program = &coupling.joint.program;
    let mut open = vec![formula.body];
    let mut found = BTreeSet::new();
    while let Some(id) = open.pop() {
        if let Term::Read { function, .. } = program.term(id)
            && coupling.joint.of.contains_key(function)
        {
            found.insert(*function);
        }
        program.each_child_of_term(id, &mut |child| open.push(child));
    }
    found
}

/// The terms of a coupling that are about states.
fn formulas(coupling: &Coupling) -> Vec<&Expression> {
    let parts = coupling.conjuncts.iter().filter_map(|part| match part {
        Conjunct::Term { formula, .. } => Some(formula),
        Conjunct::Same { .. } => None,
    });
    let more = coupling.segment.iter().chain(coupling.variant.iter().map(|(_, formula)| formula));
    parts.chain(more).chain(coupling.given.iter().map(|(_, formula)| formula)).collect()
}

/// All arguments of a function of the joint model.
fn rows(coupling: &Coupling, machine: &mut Machine, function: FunctionId) -> Result<Vec<Vec<Value>>, Outside> {
    let program = &coupling.joint.program;
    let declared = program.function(function);
    let mut rows = vec![Vec::new()];
    for domain in &declared.parameters {
        let elements = machine.elements(*domain).ok().filter(|elements| elements.len() * rows.len() <= ROWS);
        let Some(elements) = elements else {
            let name = &program.domain(*domain).name;
            return Err(nowhere(&format!("a coupling that reads a function over all of {name}")));
        };
        let longer =
            |row: Vec<Value>| elements.iter().map(move |element| [&row[..], std::slice::from_ref(element)].concat());
        rows = rows.into_iter().flat_map(longer).collect();
    }
    Ok(rows)
}

/// What the coupling reads of each machine.
///
/// # Errors
/// It is too much.
pub(crate) fn read(coupling: &Coupling, limits: &Limits) -> Result<Read, Outside> {
    let mut machine = joint_machine(coupling, limits);
    let mut read = Read::default();
    let bridges = &coupling.joint.bridges;
    for part in &coupling.conjuncts {
        let Conjunct::Same { functions, arguments, name } = part else { continue };
        let Some(all) = arguments else {
            return Err(nowhere(&format!("`{name}`, which has values at infinitely many arguments")));
        };
        for (side, function) in functions.iter().enumerate() {
            for row in all {
                let there: Option<Vec<Value>> = row.iter().map(|value| bridges[side].back(value)).collect();
                read.states[side].extend(there.map(|there| (*function, there)));
            }
        }
    }
    let states = formulas(coupling).into_iter().map(|formula| (formula, false));
    let steps = coupling.computed.iter().map(|(_, formula)| (formula, true));
    for (formula, of_step) in states.chain(steps) {
        for function in joint_functions(coupling, formula) {
            let (side, there) = coupling.joint.of[&function];
            let into = if of_step { &mut read.steps } else { &mut read.states[side] };
            for row in rows(coupling, &mut machine, function)? {
                let arguments: Option<Vec<Value>> = row.iter().map(|value| bridges[side].back(value)).collect();
                into.extend(arguments.map(|arguments| (there, arguments)));
            }
        }
    }
    Ok(read)
}

fn joint_machine(coupling: &Coupling, limits: &Limits) -> Machine {
    let mut machine = Machine::new(Arc::new(coupling.joint.program.clone()), limits.clone());
    machine.ignore_interrupts();
    // Nothing in the joint model has an initial value.
    let _ = machine.start(&mut machine::Closed);
    machine
}

/// The coupling as formulas.
///
/// # Errors
/// What cannot be encoded.
pub(crate) fn related(
    coupling: &Coupling,
    limits: &Limits,
    machines: [&Symbolic; 2],
    store: &mut Store,
) -> Result<Related, Outside> {
    let mut encoder = Encoder::new(joint_machine(coupling, limits), Bounds::new(), true, BTreeSet::new());
    let mut listing = joint_machine(coupling, limits);
    let computed = coupling.computed.iter().map(|(_, formula)| formula);
    for formula in formulas(coupling).into_iter().chain(computed) {
        for function in joint_functions(coupling, formula) {
            let (side, _) = coupling.joint.of[&function];
            for row in rows(coupling, &mut listing, function)? {
                let (value, fails) = seen(coupling, machines, store, function, &row, side)?;
                encoder.give(function, row, value, fails);
            }
        }
    }
    let mut stray: Vec<Node> = machines.iter().map(|machine| machine.reads_stray).collect();
    let mut parts = Vec::new();
    for part in &coupling.conjuncts {
        parts.push(match part {
            Conjunct::Term { formula, .. } => {
                let (truth, _) = store.lend(&mut encoder, |encoder| encoder.condition(formula))?;
                stray.extend(encoder.beyond.drain(..).map(|one| one.0));
                truth
            }
            Conjunct::Same { functions, arguments, .. } => {
                let mut all = Vec::new();
                for row in arguments.iter().flatten() {
                    let mut both = Vec::new();
                    for (side, function) in functions.iter().enumerate() {
                        let (value, fails) = seen_of(coupling, machines, store, *function, row, side)?;
                        all.push(store.terms.not(fails));
                        both.push(value);
                    }
                    all.push(store.lend(&mut encoder, |encoder| encoder.equal(&both[0], &both[1]))?);
                }
                store.terms.and(all)
            }
        });
    }
    let (mut ends, mut ends_stray) = (Terms::TRUE, Terms::FALSE);
    if let Some(formula) = &coupling.segment {
        (ends, _) = store.lend(&mut encoder, |encoder| encoder.condition(formula))?;
        let odd: Vec<Node> = encoder.beyond.drain(..).map(|one| one.0).collect();
        ends_stray = store.terms.or(odd.into_iter().chain([machines[CONCRETE].reads_stray]));
    }
    let mut variant = None;
    if let Some((_, formula)) = &coupling.variant {
        let (value, known) = store.lend(&mut encoder, |encoder| encoder.value(formula, Vec::new()))?;
        let odd: Vec<Node> = encoder.beyond.drain(..).map(|one| one.0).collect();
        let odd = store.terms.or(odd.into_iter().chain(machines.iter().map(|machine| machine.reads_stray)));
        let encoded = store.terms.not(odd);
        let value = match value {
            Symbol::Known(Value::Integer(number)) => Some((store.terms.integer(i128::from(number)), Terms::TRUE)),
            Symbol::Open(Open { shape: Shape::Integer, value, defined }) => Some((value, defined)),
            _ => None,
        };
        // A variant without a value is never one that decreases.
        let none = (store.terms.integer(0), Terms::FALSE);
        let (value, defined) = value.unwrap_or(none);
        variant = Some(Measure { value, known: store.terms.and([known, defined, encoded]) });
    }
    let mut given = BTreeMap::new();
    for (input, formula) in coupling.given.iter().chain(&coupling.computed) {
        let (value, live) = store.lend(&mut encoder, |encoder| encoder.value(formula, Vec::new()))?;
        let odd: Vec<Node> = encoder.beyond.drain(..).map(|one| one.0).collect();
        let reads_stray = [machines[CONCRETE].reads_stray, machines[CONCRETE].step_reads_stray];
        let odd = store.terms.or(odd.into_iter().chain(reads_stray));
        let domain = coupling.joint.program.term_domain(formula.body);
        let bridge = &coupling.joint.bridges[ABSTRACT];
        let (value, fails) =
            across(store, &coupling.joint.program, domain, &value, &|value: &Value| bridge.back(value))?;
        let none = store.terms.or([fails, odd]);
        let some = store.terms.not(none);
        given.insert(*input, (value, store.terms.and([live, some])));
    }
    if !encoder.inputs.is_empty() {
        return Err(nowhere("a coupling that reads a function at arguments that cannot be listed"));
    }
    if encoder.inexact {
        return Err(nowhere("real numbers that the coupling computes, and rounds"));
    }
    Ok(Related { parts, stray: store.terms.or(stray), ends, ends_stray, variant, given })
}

/// The value of a function of the joint model, and the condition under which it cannot be read.
fn seen(
    coupling: &Coupling,
    machines: [&Symbolic; 2],
    store: &mut Store,
    function: FunctionId,
    row: &[Value],
    side: usize,
) -> Result<(Symbol, Node), Outside> {
    let (_, there) = coupling.joint.of[&function];
    seen_of(coupling, machines, store, there, row, side)
}

/// The same of a function of a side, at arguments as the joint model has them.
fn seen_of(
    coupling: &Coupling,
    machines: [&Symbolic; 2],
    store: &mut Store,
    function: FunctionId,
    row: &[Value],
    side: usize,
) -> Result<(Symbol, Node), Outside> {
    let bridge = &coupling.joint.bridges[side];
    // What the side does not have as an argument has no value there.
    let arguments: Option<Vec<Value>> = row.iter().map(|value| bridge.back(value)).collect();
    let Some(arguments) = arguments else { return Ok((Symbol::UNDEF, Terms::FALSE)) };
    let (value, fails) = machines[side].reads[&(function, arguments)].clone();
    let program = &coupling.programs[side];
    let domain = program.function(function).codomain;
    let (value, none) = across(store, program, domain, &value, &|value: &Value| bridge.over(value))?;
    Ok((value, store.terms.or([fails, none])))
}
