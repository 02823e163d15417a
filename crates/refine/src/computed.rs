//! Inputs of the abstract machine, and conditions of fairness, that are terms over a step of the concrete one: its state and its inputs.
//!
//! In: a step of the concrete machine that can be made. Out: the values of these terms in it, as the joint model has them. The terms are
//! evaluated in the joint model ([`crate::joint`]), whose functions are read in the step, one after the other as they are needed.
//! INVARIANT: an input at which a term looks is one at which the step looks, so that each of its values is tried; a term that cannot be
//! evaluated has a value that no input has.

use std::sync::Arc;

use explore::Reading;
use machine::{Choice, Environment, Fault, Limits, LocationRef, Machine, TimeUnit, Value};
use program::{DomainId, Expression, FunctionId, Program};
use rustc_hash::FxHashMap;

use crate::CONCRETE;
use crate::coupling::{Coupling, Fair, FairTerm, number_of_fair};
use crate::joint::Bridge;

/// By input of the abstract machine its value, or why there is none.
pub(crate) type Values = Vec<(u32, Result<Value, String>)>;

/// See the module.
pub(crate) struct Computed {
    terms: Vec<(u32, Expression)>,
    /// Conditions of the concrete model itself.
    own: Vec<(u32, Expression)>,
    /// A machine of the joint model.
    machine: Machine,
    joint: Arc<Program>,
    concrete: Arc<Program>,
    /// By function of the joint model, the term that reads it in the concrete machine.
    readers: FxHashMap<FunctionId, Expression>,
}

impl Computed {
    /// Those of a coupling; none if it has no such inputs.
    pub fn of(coupling: &Coupling, limits: &Limits) -> Option<Computed> {
        let (mut terms, mut own) = (coupling.computed.clone(), Vec::new());
        for (index, Fair { term, .. }) in coupling.fair.iter().enumerate().filter(|(_, fair)| fair.in_step) {
            match term {
                FairTerm::Said(_, formula) => terms.push((number_of_fair(index), formula.clone())),
                FairTerm::Own(justice) => own.push((number_of_fair(index), justice.formula.clone())),
            }
        }
        if terms.is_empty() && own.is_empty() {
            return None;
        }
        let joint = Arc::new(coupling.joint.program.clone());
        let mut machine = Machine::new(Arc::clone(&joint), limits.clone());
        machine.ignore_interrupts();
        // Nothing in the joint model has an initial value.
        let _ = machine.start(&mut machine::Closed);
        let of = coupling.joint.of.iter().filter(|(_, (side, _))| *side == CONCRETE);
        let readers = of.filter_map(|(id, (_, there))| Some((*id, coupling.readers[CONCRETE].get(there)?.clone())));
        let (readers, concrete) = (readers.collect(), Arc::clone(&coupling.programs[CONCRETE]));
        Some(Computed { terms, own, machine, joint, concrete, readers })
    }

    /// What may be read in a step.
    pub fn readers(&self) -> Vec<Expression> {
        self.readers.values().chain(self.own.iter().map(|(_, formula)| formula)).cloned().collect()
    }

    /// The values in a step.
    ///
    /// # Errors
    /// The step cannot be gone through.
    pub fn values(&mut self, step: &mut Reading<'_>, bridge: &Bridge) -> Result<Values, Fault> {
        let Computed { terms, own, machine, joint, concrete, readers } = self;
        machine.forget_inputs();
        let mut values = Values::new();
        for (input, term) in terms {
            let mut within = Within { readers, concrete, step, bridge, trouble: None };
            let value = machine.evaluate(term, &mut within);
            if let Some(trouble) = within.trouble {
                return Err(trouble);
            }
            values.push((*input, value.map_err(|fault| fault.show(joint).to_string())));
        }
        for (number, formula) in own {
            let value = match step.value(formula, &[]) {
                Err(fault) if !fault.kind.is_of_the_model() => return Err(fault),
                value => value.map_err(|fault| fault.show(concrete).to_string()),
            };
            values.push((*number, value));
        }
        Ok(values)
    }
}

/// A step, as the joint model sees it.
struct Within<'w, 'r> {
    readers: &'w FxHashMap<FunctionId, Expression>,
    concrete: &'w Program,
    step: &'w mut Reading<'r>,
    bridge: &'w Bridge,
    /// Why the step cannot be gone through.
    trouble: Option<Fault>,
}

impl Environment for Within<'_, '_> {
    fn monitored(&mut self, _: &Program, location: LocationRef<'_>, _: DomainId) -> Result<Value, String> {
        let Some(reader) = self.readers.get(&location.function) else {
            return Err("a function of another machine".to_string());
        };
        let arguments: Option<Vec<Value>> = location.arguments.iter().map(|value| self.bridge.back(value)).collect();
        // What the machine does not have as an argument has no value there.
        let Some(arguments) = arguments else { return Ok(Value::Undef) };
        match self.step.value(reader, &arguments) {
            Ok(value) => self
                .bridge
                .over(&value)
                .ok_or("an element without a name, which the other machine does not have".into()),
            Err(fault) => {
                let told = fault.show(self.concrete).to_string();
                if !fault.kind.is_of_the_model() {
                    self.trouble.get_or_insert(fault);
                }
                Err(told)
            }
        }
    }

    fn choose(&mut self, _: &Program, _: &Choice<'_>) -> Result<usize, String> {
        Err("a coupling does not choose".to_string())
    }

    fn time(&mut self, _: TimeUnit) -> Result<i64, String> {
        Err("a coupling does not read the clock".to_string())
    }
}
