//! What a coupling says of the environment: the values of inputs, and what is fair.
//!
//! In: the statements `input`, `free` and `fair`, the inputs and the `JUSTICE` of both models. Out: their part of the coupling. INVARIANT:
//! each input of the abstract machine that it reads is shared, given by a term, or free.

use std::collections::BTreeSet;

use program::{FunctionId, FunctionKind, Program, PropertyKind, Term};

use crate::build::Builder;
use crate::coupling::{Fair, FairTerm, start};
use crate::fault::{bad_coupling, input_not_coupled};
use crate::joint::joint_name;
use crate::written::{Mapped, Part, Written};
use crate::{ABSTRACT, CONCRETE};

impl Builder {
    /// `fair TERM;`, and what the concrete model says of it.
    pub(super) fn fairness(&mut self, written: &Written) {
        if let Some(part) = written.fair.first()
            && written.waiting
            && written.segment.is_none()
        {
            let message = "`allow waiting` takes for granted that nothing waits for ever, whether or not that is fair";
            let place = self.place(part);
            return self.fault(bad_coupling(place, message));
        }
        for part in &written.fair {
            let Some(formula) = self.term(part, None) else { continue };
            self.concrete_only(&formula, "fairness is said", "the concrete machine's state and inputs alone");
            let functions = self.functions_of(&formula, CONCRETE);
            if functions.is_empty() {
                let place = self.place(part);
                self.fault(bad_coupling(place, "this looks at nothing of the concrete machine"));
            }
            let in_step = self.reads_inputs(&functions);
            self.coupling.fair.push(Fair { term: FairTerm::Said(part.text.clone(), formula), in_step });
        }
        // Where waiting is allowed, it is still about segments that never end.
        if !written.waiting || written.segment.is_some() {
            let properties = self.coupling.programs[CONCRETE].properties.iter();
            let just = properties.filter(|property| property.kind == PropertyKind::Justice);
            let own =
                just.map(|property| Fair { term: FairTerm::Own(property.clone()), in_step: property.reads_monitored });
            self.coupling.fair.extend(own);
        }
    }

    /// Whether one of these functions of the concrete machine is an input, or depends on one.
    fn reads_inputs(&mut self, functions: &BTreeSet<FunctionId>) -> bool {
        let mut reads = false;
        for function in functions {
            let reader = self.reader(CONCRETE, *function);
            reads |= self.coupling.programs[CONCRETE].reads_monitored(&reader);
        }
        reads
    }

    /// Which inputs of the abstract machine have which values.
    pub(super) fn inputs(&mut self, written: &Written) {
        let [one, other] = self.coupling.programs.clone();
        let mut left: Vec<FunctionId> = (0..)
            .map(FunctionId)
            .zip(&one.functions)
            .filter(|(_, function)| is_input(function))
            .map(|(id, _)| id)
            .collect();
        let mut take = |name: &str| {
            let taken: Vec<FunctionId> = left.iter().copied().filter(|id| one.function(*id).name == name).collect();
            left.retain(|id| !taken.contains(id));
            taken
        };
        for part in &written.free {
            match take(&part.text)[..] {
                [] => self.no_input(part, &one),
                _ => self.coupling.free.push(part.text.clone()),
            }
        }
        for mapped in &written.inputs {
            match take(&mapped.input.text)[..] {
                [input] => self.mapped(mapped, input),
                [] => self.no_input(&mapped.input, &one),
                _ => {
                    let message =
                        format!("there are several inputs `{}`: only `free` can name them", mapped.input.text);
                    let place = self.place(&mapped.input);
                    self.fault(bad_coupling(place, message));
                }
            }
        }
        for id in left {
            let function = one.function(id);
            let (name, arity) = (&function.name, function.parameters.len());
            let there = match self.counterpart(id, is_input) {
                Ok(Some(there)) => Some(there),
                Ok(None) => other.find_function(name, arity).filter(|there| is_input(other.function(*there))),
                Err(fault) => {
                    self.fault(fault);
                    continue;
                }
            };
            let read = one.terms.iter().any(|term| matches!(term, Term::Read { function, .. } if *function == id));
            let Some(there) = there else {
                if read {
                    let fault =
                        input_not_coupled(start(self.coupling.file), name, "is no input of the concrete machine");
                    self.faults.push(fault);
                }
                continue;
            };
            let grows = [(ABSTRACT, id), (CONCRETE, there)];
            if let Some(domain) = grows.into_iter().find_map(|(side, input)| self.grows(side, input, true)) {
                if read {
                    let why = format!("is about elements of {domain} that each machine makes for itself");
                    self.faults.push(input_not_coupled(start(self.coupling.file), name, &why));
                }
                continue;
            }
            if let Some([one, other]) = self.other_domain(id, there) {
                let why = format!("is in {one}, and in the concrete machine in {other}");
                self.faults.push(input_not_coupled(start(self.coupling.file), name, &why));
                continue;
            }
            self.share(id, there);
        }
    }

    fn share(&mut self, input: FunctionId, there: FunctionId) {
        self.coupling.shared[ABSTRACT].entry(input).or_default().push(input.0);
        self.coupling.shared[CONCRETE].entry(there).or_default().push(input.0);
        self.coupling.inputs.push(self.coupling.programs[ABSTRACT].function(input).name.clone());
    }

    fn no_input(&mut self, part: &Part, program: &Program) {
        let place = self.place(part);
        let known: Vec<&str> =
            program.functions.iter().filter(|function| is_input(function)).map(|function| &*function.name).collect();
        let fault = bad_coupling(place, format!("the abstract machine has no input `{}` left to speak of", part.text));
        let help = match known[..] {
            [] => "it has no inputs".to_string(),
            _ => format!("its inputs are: {}; each is said once", known.join(", ")),
        };
        self.faults.push(fault.with_help(help));
    }

    /// `input abstract.f = TERM;`
    fn mapped(&mut self, mapped: &Mapped, input: FunctionId) {
        let [one, other] = self.coupling.programs.clone();
        let arity = one.function(input).parameters.len();
        let renamed = mapped.term.text.strip_prefix("concrete.");
        let renamed = renamed.and_then(|name| other.find_function(name, arity));
        if let Some(there) = renamed.filter(|there| is_input(other.function(*there))) {
            let grows = [(ABSTRACT, input), (CONCRETE, there)];
            if let Some(domain) = grows.into_iter().find_map(|(side, input)| self.grows(side, input, true)) {
                let message =
                    format!("each machine makes elements of {domain} for itself: these inputs are not the same");
                let place = self.place(&mapped.term);
                return self.fault(bad_coupling(place, message));
            }
            match self.other_domain(input, there) {
                None => return self.share(input, there),
                // Of another domain it is a term like others.
                Some(_) if arity == 0 => {}
                Some([one, other]) => {
                    let message = format!("the two inputs have different domains: {one}, and {other}");
                    let place = self.place(&mapped.term);
                    return self.fault(bad_coupling(place, message));
                }
            }
        }
        if arity > 0 {
            let message = "an input with arguments can only be another input: input abstract.f = concrete.g;";
            let place = self.place(&mapped.term);
            return self.fault(bad_coupling(place, message));
        }
        let joint = &self.coupling.joint.program;
        let Some(id) = joint.find_function(&joint_name(ABSTRACT, &mapped.input.text), 0) else { return };
        let domain = joint.function(id).codomain;
        let Some(formula) = self.term(&mapped.term, Some((domain, "the input"))) else { return };
        self.concrete_only(&formula, "the input is given", "the concrete machine alone");
        let functions = self.functions_of(&formula, CONCRETE);
        let reads_inputs = self.reads_inputs(&functions);
        self.coupling.shared[ABSTRACT].entry(input).or_default().push(input.0);
        let known = if reads_inputs { &mut self.coupling.computed } else { &mut self.coupling.given };
        known.push((input.0, formula));
    }
}

fn is_input(function: &program::Function) -> bool {
    !function.library && function.kind == FunctionKind::Monitored
}
