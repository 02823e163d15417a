//! The diagrams from an arbitrary pair of states that corresponds: what the concrete machine may do step by step, and whether the abstract
//! machine has an answer.
//!
//! In: both machines and the coupling as formulas. Out: [`Diagrams`], which goes on by one concrete step at a time. Each step has inputs of
//! its own, about which nothing is known but their domains: they stand for all. INVARIANT: an input of the abstract machine is offered the
//! values that it has at the concrete steps of the diagram, as by the search.

use machine::Value;
use program::FunctionId;
use rustc_hash::FxHashMap;
use solve::Outside;
use solve::encode::Input;
use solve::shared::{Node, Terms, VariableId};
use solve::symbol::{Open, Shape, Symbol, constant};

use super::across::across;
use super::answers::{Offered, runs};
use super::related::Related;
use super::symbolic::{Replacement, Store, Symbolic, input_location, nowhere};
use crate::coupling::Coupling;
use crate::{ABSTRACT, CONCRETE};

/// An answer of the abstract machine.
#[derive(Debug, Clone)]
pub(crate) struct Answer {
    pub m: u32,
    /// Its steps can be made.
    pub made: Node,
    /// The parts of the relation, behind it.
    pub parts: Vec<Node>,
    /// It is an answer.
    pub holds: Node,
}

/// A concrete step.
pub(crate) struct Step {
    /// Facts about its inputs.
    pub facts: Node,
    /// The kinds of faults.
    pub faults: Vec<(&'static str, Node)>,
    /// What is not encoded.
    pub strays: Vec<(Node, Outside)>,
    /// It is made, to a state that the assumptions admit.
    pub goes: Node,
    pub changed: Node,
    /// A segment ends behind it; and that is not encoded.
    pub ends: Node,
    pub ends_stray: Node,
    /// The inputs' own variables.
    pub inputs: Vec<(Input, VariableId)>,
    /// What this step offers to inputs of the abstract machine.
    pub offered: Offered,
    /// The values of the state's variables before and behind it.
    pub from: Vec<Node>,
    pub to: Vec<Node>,
}

/// See the module.
pub(crate) struct Diagrams<'d> {
    pub coupling: &'d Coupling,
    pub machines: [&'d Symbolic; 2],
    pub related: &'d Related,
    /// The concrete state reached.
    state: Vec<Node>,
    /// What inputs of the abstract machine may be.
    pub offered: Offered,
    steps: u32,
}

impl<'d> Diagrams<'d> {
    /// No step is made.
    pub fn new(
        coupling: &'d Coupling,
        machines: [&'d Symbolic; 2],
        related: &'d Related,
        store: &mut Store,
    ) -> Diagrams<'d> {
        let state = machines[CONCRETE].here(&mut store.terms);
        Diagrams::from(coupling, machines, related, state)
    }

    /// No step is made from a state of the concrete machine.
    pub fn from(
        coupling: &'d Coupling,
        machines: [&'d Symbolic; 2],
        related: &'d Related,
        state: Vec<Node>,
    ) -> Diagrams<'d> {
        Diagrams { coupling, machines, related, state, offered: Offered::default(), steps: 0 }
    }

    /// The next concrete step.
    ///
    /// # Errors
    /// An input of the abstract machine cannot be encoded.
    pub fn step(&mut self, store: &mut Store) -> Result<Step, Outside> {
        self.steps += 1;
        let machine = self.machines[CONCRETE];
        let from = self.state.clone();
        let mut of: FxHashMap<VariableId, Node> = machine.state.iter().copied().zip(from.iter().copied()).collect();
        let mut inputs = Vec::new();
        for input in &machine.inputs {
            let Some(id) = store.variable(input.variable) else { continue };
            let (name, kind, bounds) = {
                let variable = store.terms.variable_of(id);
                (format!("{} in step {}", variable.name, self.steps), variable.kind, variable.bounds)
            };
            let own = store.terms.variable(name, kind, bounds);
            of.insert(id, own);
            inputs.extend(store.variable(own).map(|own| (input.clone(), own)));
        }
        let mut by = Replacement::new(of);
        let mut facts: Vec<Node> = machine.given.iter().map(|node| store.replaced(*node, &mut by)).collect();
        let faults = machine.faults.iter().map(|(words, node)| (*words, store.replaced(*node, &mut by))).collect();
        let strays = machine.strays.iter().map(|(node, outside)| (store.replaced(*node, &mut by), outside.clone()));
        let strays = strays.collect();
        let goes = store.replaced(machine.goes, &mut by);
        let changed = store.replaced(machine.changed, &mut by);
        let to: Vec<Node> = machine.next.iter().map(|node| store.replaced(*node, &mut by)).collect();
        let mut offered = Offered::default();
        facts.extend(self.offer(store, &mut by, &inputs, &mut offered)?);
        add(&mut self.offered, &offered);
        let mut there = Replacement::new(machine.state.iter().copied().zip(to.iter().copied()));
        let admitted = store.replaced(machine.perhaps, &mut there);
        let ends = store.replaced(self.related.ends, &mut there);
        let ends_stray = store.replaced(self.related.ends_stray, &mut there);
        self.state.clone_from(&to);
        Ok(Step {
            facts: store.terms.and(facts),
            faults,
            strays,
            goes: store.terms.and([goes, admitted]),
            changed,
            ends,
            ends_stray,
            inputs,
            offered,
            from,
            to,
        })
    }

    /// Offers the values that this step gives to inputs of the abstract machine; returns facts about those at which the concrete machine
    /// does not look.
    fn offer(
        &self,
        store: &mut Store,
        by: &mut Replacement,
        inputs: &[(Input, VariableId)],
        offered: &mut Offered,
    ) -> Result<Vec<Node>, Outside> {
        let coupling = self.coupling;
        let mut facts = Vec::new();
        let mut unread: FxHashMap<(FunctionId, Vec<Value>), (Shape, Node)> = FxHashMap::default();
        for input in self.machines[ABSTRACT].used_inputs(&store.terms) {
            let Some((function, arguments, shape)) = input_location(&input) else { continue };
            let Some(id) = store.variable(input.variable) else { continue };
            if !coupling.shared[ABSTRACT].contains_key(&function) {
                continue;
            }
            let (symbol, valid) = if let Some((symbol, valid)) = self.related.given.get(&function.0) {
                let (symbol, valid) = (symbol.clone(), *valid);
                (replaced_symbol(store, &symbol, by), store.replaced(valid, by))
            } else {
                let there = coupling.shared[CONCRETE].iter().find(|(_, named)| named.contains(&function.0));
                let Some((there, _)) = there else { return Err(nowhere("an input without a counterpart")) };
                let bridges = &coupling.joint.bridges;
                let over: Option<Vec<Value>> = arguments.iter().map(|value| bridges[ABSTRACT].over(value)).collect();
                let back = over.and_then(|over| {
                    over.iter().map(|value| bridges[CONCRETE].back(value)).collect::<Option<Vec<Value>>>()
                });
                let read = inputs.iter().find(|(input, _)| {
                    let location = input_location(input);
                    location.is_some_and(|(function, row, _)| function == *there && back.as_deref() == Some(row))
                });
                match read {
                    Some((input, own)) => self.taken_over(store, function, *there, input, *own)?,
                    None => {
                        let key = (*there, arguments.to_vec());
                        let known = unread.get(&key).copied();
                        let value = match known {
                            Some((other, value)) if other == shape => value,
                            Some(_) => return Err(nowhere("an input that stands for two of different kinds")),
                            None => {
                                let variable = store.terms.variable_of(id);
                                let name = format!("{} in step {}", variable.name, self.steps);
                                let (kind, bounds) = (variable.kind, variable.bounds);
                                let value = store.terms.variable(name, kind, bounds);
                                facts.extend(self.known_of(store, id, value));
                                unread.insert(key, (shape, value));
                                value
                            }
                        };
                        (Symbol::Open(Open { shape, value, defined: Terms::TRUE }), Terms::TRUE)
                    }
                }
            };
            let offered = offered.entry(id).or_default();
            let open = match symbol {
                Symbol::Open(open) if open.shape == shape => open,
                Symbol::Known(ref value) if Shape::of(value) == shape && !value.is_undef() => {
                    let value = constant(&mut store.terms, &mut store.codes, value);
                    Open { shape, value, defined: Terms::TRUE }
                }
                // It has no such value.
                _ => continue,
            };
            let bounds = store.terms.variable_of(id).bounds;
            let within = match bounds {
                (None, None) => Terms::TRUE,
                bounds => store.terms.within(open.value, bounds),
            };
            let value = (open.value, store.terms.and([valid, open.defined, within]));
            if !offered.contains(&value) {
                offered.push(value);
            }
        }
        Ok(facts)
    }

    /// An input of the concrete machine as one of the abstract machine.
    fn taken_over(
        &self,
        store: &mut Store,
        function: FunctionId,
        there: FunctionId,
        input: &Input,
        own: VariableId,
    ) -> Result<(Symbol, Node), Outside> {
        let coupling = self.coupling;
        let Some((_, _, shape)) = input_location(input) else { return Err(nowhere("an input of no location")) };
        let value = store.terms.known(own);
        let symbol = Symbol::Open(Open { shape, value, defined: Terms::TRUE });
        let bridges = &coupling.joint.bridges;
        let program = &coupling.programs[CONCRETE];
        let domain = program.function(there).codomain;
        let over = |value: &Value| bridges[CONCRETE].over(value);
        let (symbol, none) = across(store, program, domain, &symbol, &over)?;
        let joint = &coupling.joint.program;
        let Some(named) = coupling.joint.with_domains_of[ABSTRACT].get(&function).copied() else {
            return Err(nowhere("an input whose domains both machines have, and no coupling"));
        };
        let back = |value: &Value| bridges[ABSTRACT].back(value);
        let (symbol, more) = across(store, joint, joint.function(named).codomain, &symbol, &back)?;
        let none = store.terms.or([none, more]);
        Ok((symbol, store.terms.not(none)))
    }

    /// What is known of an input of the abstract machine, of a value that stands for it.
    fn known_of(&self, store: &mut Store, id: VariableId, value: Node) -> Vec<Node> {
        let alone = |node: &Node| store.terms.variables_of([*node]) == [id];
        let known: Vec<Node> = self.machines[ABSTRACT].given.iter().copied().filter(alone).collect();
        let mut by = Replacement::new([(id, value)]);
        known.into_iter().map(|node| store.replaced(node, &mut by)).collect()
    }

    /// The answers to the steps made so far, those first that are taken first.
    ///
    /// # Errors
    /// They cannot be written out.
    pub fn answers(&self, store: &mut Store) -> Result<Vec<Answer>, Outside> {
        let coupling = self.coupling;
        let n = self.steps;
        let Some(most) = coupling.diagrams.most_abstract(n) else { return Ok(Vec::new()) };
        let program = &coupling.programs[ABSTRACT];
        let names = |function: FunctionId| program.function(function).name.clone();
        let mut answers = Vec::new();
        for m in (1..=most).filter(|m| coupling.diagrams.allows(*m, n)) {
            for run in runs(self.machines[ABSTRACT], store, &names, &self.offered, m)? {
                answers.push(self.answer(store, m, run.made, &run.state, Terms::TRUE));
            }
        }
        if coupling.diagrams.allows(0, n) {
            let stays = self.machines[ABSTRACT].here(&mut store.terms);
            let goes_down = self.goes_down(store);
            answers.push(self.answer(store, 0, Terms::TRUE, &stays, goes_down));
        }
        Ok(answers)
    }

    fn answer(&self, store: &mut Store, m: u32, made: Node, state: &[Node], more: Node) -> Answer {
        let one = self.machines[ABSTRACT].state.iter().copied().zip(state.iter().copied());
        let other = self.machines[CONCRETE].state.iter().copied().zip(self.state.iter().copied());
        let mut by = Replacement::new(one.chain(other));
        let parts: Vec<Node> = self.related.parts.iter().map(|part| store.replaced(*part, &mut by)).collect();
        let stray = store.replaced(self.related.stray, &mut by);
        let encoded = store.terms.not(stray);
        let holds = store.terms.and(parts.iter().copied().chain([made, encoded, more]));
        Answer { m, made, parts, holds }
    }

    /// A diagram without an abstract step may be made: the variant decreases, or nobody asks.
    fn goes_down(&self, store: &mut Store) -> Node {
        if self.coupling.waiting {
            return Terms::TRUE;
        }
        let Some(before) = self.related.variant else { return Terms::FALSE };
        let other = self.machines[CONCRETE].state.iter().copied().zip(self.state.iter().copied());
        let mut by = Replacement::new(other);
        let (value, known) = (store.replaced(before.value, &mut by), store.replaced(before.known, &mut by));
        let zero = store.terms.integer(0);
        let (positive, less) = (store.terms.at_most(zero, before.value), store.terms.less(value, before.value));
        store.terms.and([before.known, known, positive, less])
    }
}

/// Adds what a step offers to what was offered before.
pub(crate) fn add(offered: &mut Offered, more: &Offered) {
    for (id, values) in more {
        let all = offered.entry(*id).or_default();
        values.iter().for_each(|value| {
            if !all.contains(value) {
                all.push(*value);
            }
        });
    }
}

/// A symbol in which terms stand for variables.
fn replaced_symbol(store: &mut Store, symbol: &Symbol, by: &mut Replacement) -> Symbol {
    match symbol {
        Symbol::Open(open) => {
            let (value, defined) = (store.replaced(open.value, by), store.replaced(open.defined, by));
            Symbol::Open(Open { shape: open.shape, value, defined })
        }
        Symbol::Tuple(parts) => Symbol::Tuple(parts.iter().map(|part| replaced_symbol(store, part, by)).collect()),
        Symbol::Set(elements) => {
            let elements = elements.iter();
            Symbol::Set(
                elements.map(|(here, part)| (store.replaced(*here, by), replaced_symbol(store, part, by))).collect(),
            )
        }
        Symbol::Known(value) => Symbol::Known(value.clone()),
    }
}
