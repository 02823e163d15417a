//! Selecting one of several cases whose values are known: by one comparison with all of them, and a table where they lie close together.
//!
//! In: a subject and the terms of its cases. Out: a block for each case.

use cranelift_codegen::ir::Block;
use cranelift_frontend::Switch;
use program::{Term, TermId};

use crate::native::shape::{Kind, Operand, Scalar};
use crate::native::translate::Translator;

/// A case whose value is known.
#[derive(Debug, Clone, Copy)]
pub(super) struct Case {
    /// Its place among the cases.
    pub place: usize,
    /// Its value.
    number: i64,
}

impl Translator<'_, '_> {
    /// The subject and its cases, if it is a scalar and all of them are known values of its kind. A value that comes again is left out:
    /// the first case is taken.
    pub fn known_cases(&self, subject: Operand, values: &[TermId]) -> Option<(Scalar, Vec<Case>)> {
        let Operand::Scalar(scalar) = subject else { return None };
        if scalar.kind == Kind::Real {
            return None;
        }
        let mut cases: Vec<Case> = Vec::new();
        for (place, value) in values.iter().enumerate() {
            let number = self.number_of(*value, scalar.kind)?;
            if cases.iter().all(|case| case.number != number) {
                cases.push(Case { place, number });
            }
        }
        Some((scalar, cases))
    }

    /// The number of a constant of a kind.
    fn number_of(&self, term: TermId, kind: Kind) -> Option<i64> {
        match self.program.term(term) {
            Term::Constant(index) => kind.number_of(&self.plan.constants[*index as usize]),
            Term::Read { function, .. } => {
                let declared = self.program.function(*function);
                let element = declared.element?;
                (self.kind(declared.codomain) == Some(kind)).then_some(i64::from(element))
            }
            _ => None,
        }
    }

    /// Goes to the block of the case that the subject has the value of. Gives these blocks, and the one for other values and undef.
    pub fn select_case(&mut self, subject: Scalar, cases: &[Case]) -> (Vec<Block>, Block) {
        let none = self.block();
        if let Some(flag) = subject.flag {
            let defined = self.block();
            self.branch(flag, defined, none);
            self.switch(defined);
        }
        let mut switch = Switch::new();
        let bits = subject.kind.register().bits();
        let arms: Vec<Block> = cases
            .iter()
            .map(|case| {
                let arm = self.block();
                switch.set_entry(u128::from(case.number as u64) & ((1 << bits) - 1), arm);
                arm
            })
            .collect();
        switch.emit(&mut self.builder, subject.value, none);
        (arms, none)
    }
}
