//! How the functions of a machine are read in terms over both machines.
//!
//! In: a function of a side. Out: a term that has its value at its parameters. INVARIANT: at an element that only the other machine has
//! the value is undef, whatever the function's definition or initial value would make of it.

use std::sync::Arc;

use machine::Machine;
use program::{Builtin, DomainId, DomainKind, Expression, FunctionId, Program, Slot, Term, TermList};

use crate::build::Builder;

impl Builder {
    /// The parameters of a side's function, by number, whose domain has more elements in the other machine.
    fn widened(&self, side: usize, function: FunctionId) -> Vec<usize> {
        let joint = &self.coupling.joint;
        let Some(common) = joint.with_domains_of[side].get(&function) else { return Vec::new() };
        let (own, common) =
            (self.coupling.programs[side].function(function), joint.program.function(*common).parameters.clone());
        let pairs = own.parameters.iter().zip(common).enumerate();
        let is_widened = |(own, common): (DomainId, DomainId)| {
            let program = &self.coupling.programs[side];
            let DomainKind::Concrete { contents: Some(_), .. } = program.domain(own).kind else { return false };
            let of = |program: &Program, domain| {
                let mut machine = Machine::new(Arc::new(program.clone()), self.limits.clone());
                machine.elements(domain).map(|elements| elements.len()).ok()
            };
            let (here, there) = (of(program, own), of(&joint.program, common));
            here.zip(there).is_some_and(|(here, there)| here < there)
        };
        pairs.filter(|(_, (own, common))| is_widened((**own, *common))).map(|(number, _)| number).collect()
    }

    /// A term of the program that reads a function at its parameters: undef at elements that the machine does not have.
    pub(super) fn reader(&mut self, side: usize, function: FunctionId) -> Expression {
        if let Some(known) = self.coupling.readers[side].get(&function) {
            return known.clone();
        }
        let widened = self.widened(side, function);
        let program = Arc::make_mut(&mut self.coupling.programs[side]);
        let declared = program.function(function).clone();
        let push = |program: &mut Program, term: Term, domain| {
            program.terms.push(term);
            program.term_domains.push(domain);
            program.term_spans.push(declared.span);
            program::TermId(program.terms.len() as u32 - 1)
        };
        let mut slots = Vec::new();
        for (slot, domain) in declared.parameters.iter().enumerate() {
            slots.push(push(program, Term::Slot(Slot(slot as u32)), *domain));
        }
        let arguments = TermList { start: program.term_lists.len() as u32, len: slots.len() as u32 };
        program.term_lists.extend(slots.iter().copied());
        let slots_of = slots;
        let term = match declared.definition {
            Some(_) => Term::Define { function, arguments },
            None => Term::Read { function, arguments },
        };
        let mut body = push(program, term, declared.codomain);
        let boolean = program.domains.iter().position(|one| one.kind == DomainKind::Basic(model::Basic::Boolean));
        let boolean = boolean.map_or(declared.codomain, |index| DomainId(index as u32));
        for number in widened {
            let of = declared.parameters[number];
            let domain = match &program.domain(of).kind {
                DomainKind::Concrete { contents: Some(contents), .. } if contents.frame == 0 => contents.body,
                _ => push(program, Term::Domain(of), of),
            };
            let operands = TermList { start: program.term_lists.len() as u32, len: 2 };
            program.term_lists.extend([domain, slots_of[number]]);
            let within = Term::Builtin { builtin: Builtin::SetContains, arguments: operands };
            let within = push(program, within, boolean);
            let branches = TermList { start: program.term_lists.len() as u32, len: 2 };
            program.term_lists.extend([within, body]);
            body = push(program, Term::If { branches, otherwise: None }, declared.codomain);
        }
        let names = (0..declared.parameters.len()).map(|slot| format!("${slot}")).collect();
        let frame = declared.parameters.len() as u32;
        let reader = Expression { parameters: declared.parameters, frame, names, body };
        self.coupling.readers[side].insert(function, reader.clone());
        reader
    }
}
