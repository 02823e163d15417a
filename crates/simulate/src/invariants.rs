//! The invariants of a run: which ones to evaluate, and their values.
//!
//! In: a machine after a step, or before its commit for those that read inputs. Out: violations. An invariant over the
//! state alone is evaluated only if a step has changed a function that it reads, or a domain has grown: otherwise its
//! value stays the same. In a long run compiled code is asked first whether it holds. INVARIANT: the verdicts are those of evaluating all of them every time.

use std::sync::Arc;

use machine::{Fault, Machine, Value};
use program::{Expression, Program, PropertyKind};

use crate::inputs::Inputs;
use crate::trace::Violation;

/// The invariants of one program.
#[derive(Debug, Default)]
pub(crate) struct Watch {
    /// Those that read inputs, as indices into the program's properties.
    over_inputs: Vec<usize>,
    over_states: Vec<Watched>,
    /// By function: which of `over_states` read it.
    readers: Vec<Vec<usize>>,
}

#[derive(Debug)]
struct Watched {
    property: usize,
    /// Its value depends on more than locations and domains.
    always: bool,
    /// Its value, while nothing that it reads has changed.
    known: Option<Value>,
}

impl Watch {
    /// All invariants of a program.
    pub fn of(program: &Program) -> Watch {
        let mut watch = Watch { readers: vec![Vec::new(); program.functions.len()], ..Watch::default() };
        let properties = program.properties.iter().enumerate();
        for (property, invariant) in properties.filter(|(_, property)| property.kind == PropertyKind::Invariant) {
            if invariant.reads_monitored {
                watch.over_inputs.push(property);
                continue;
            }
            let reads = program.reads(&invariant.formula);
            for function in reads.iter().flatten() {
                watch.readers[function.0 as usize].push(watch.over_states.len());
            }
            watch.over_states.push(Watched { property, always: reads.is_none(), known: None });
        }
        watch
    }

    /// The conditions for the machine to watch, in the order of `over_states`.
    pub fn conditions(&self, program: &Program) -> Arc<[Expression]> {
        self.over_states.iter().map(|watched| program.properties[watched.property].formula.clone()).collect()
    }

    /// Whether there is nothing to evaluate.
    pub fn is_idle(&self) -> bool {
        self.over_inputs.is_empty() && self.over_states.is_empty()
    }

    /// The state may have become any other.
    pub fn forget(&mut self) {
        self.over_states.iter_mut().for_each(|watched| watched.known = None);
    }

    /// A step was committed; a domain may have grown in it.
    pub fn note(&mut self, machine: &Machine, grown: bool) {
        if self.over_states.is_empty() {
            return;
        }
        if grown {
            return self.forget();
        }
        let Watch { over_states, readers, .. } = self;
        machine.each_changed_function(&mut |function| {
            for reader in &readers[function.0 as usize] {
                over_states[*reader].known = None;
            }
        });
    }

    /// Evaluates the invariants that read inputs, before a step's commit. On a fault no violation is added.
    pub fn check_inputs(
        &mut self,
        machine: &mut Machine,
        inputs: &mut Inputs,
        violations: &mut Vec<Violation>,
    ) -> Result<(), Box<Fault>> {
        if self.over_inputs.is_empty() {
            return Ok(());
        }
        let found = violations.len();
        let program = Arc::clone(machine.program());
        for property in &self.over_inputs {
            match machine.evaluate(&program.properties[*property].formula, inputs) {
                Ok(value) => judge(&program, *property, &value, violations),
                Err(fault) => {
                    violations.truncate(found);
                    return Err(Box::new(fault));
                }
            }
        }
        Ok(())
    }

    /// Evaluates the other invariants as far as they may have changed. On a fault no violation is added.
    pub fn check_state(
        &mut self,
        machine: &mut Machine,
        inputs: &mut Inputs,
        violations: &mut Vec<Violation>,
    ) -> Result<(), Box<Fault>> {
        if self.over_states.is_empty() {
            return Ok(());
        }
        let found = violations.len();
        let program = Arc::clone(machine.program());
        for (number, Watched { property, always, known }) in self.over_states.iter_mut().enumerate() {
            let value = match known.take() {
                Some(value) => value,
                None if !*always && machine.surely_holds(number) => Value::Boolean(true),
                None => match machine.evaluate(&program.properties[*property].formula, inputs) {
                    Ok(value) => value,
                    Err(fault) => {
                        violations.truncate(found);
                        return Err(Box::new(fault));
                    }
                },
            };
            judge(&program, *property, &value, violations);
            *known = (!*always).then_some(value);
        }
        Ok(())
    }
}

fn judge(program: &Program, property: usize, value: &Value, violations: &mut Vec<Violation>) {
    if *value != Value::Boolean(true) {
        let property = &program.properties[property];
        violations.push(Violation {
            name: property.name.clone(),
            span: property.span,
            value: value.clone(),
            before: property.reads_monitored,
        });
    }
}
