//! Reads the temporal properties of a program as formulas over numbered propositions.
//!
//! In: a lowered program. Out: [`Properties`], or faults with their places. Operators of the CTL and LTL libraries
//! become operators of formulas. Connectives, conditionals, quantifiers and static functions over formulas are
//! expanded: a quantifier for each element of its range, a function with its arguments substituted. A term about one
//! state becomes a proposition as a whole. INVARIANT: a proposition contains no temporal operator.

mod fault;
mod fixed;
mod proposition;
mod reader;

use std::sync::Arc;

use program::{Program, PropertyKind};
use syntax::Diagnostic;

pub use fault::IDS;
pub use proposition::Proposition;

use crate::temporal::formula::{CtlFormulas, FormulaId, LtlFormulas};
use reader::Reader;

/// The temporal properties of a program, and its assumptions about runs.
#[derive(Debug, Clone, Default)]
pub struct Properties {
    /// The propositions in the formulas.
    pub propositions: Vec<Proposition>,
    /// The formulas of CTL.
    pub ctl: CtlFormulas,
    /// The formulas of LTL.
    pub ltl: LtlFormulas,
    /// The formulas, by index among the program's properties.
    pub formulas: Vec<(usize, Formula)>,
    /// Propositions that hold infinitely often.
    pub justice: Vec<usize>,
    /// Pairs whose second holds infinitely often if the first does.
    pub compassion: Vec<(usize, usize)>,
}

/// A formula of one of the logics.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Formula {
    /// In [`Properties::ctl`].
    Ctl(FormulaId),
    /// In [`Properties::ltl`].
    Ltl(FormulaId),
}

/// Reads all temporal properties and fairness constraints.
///
/// # Errors
/// Formulas without a meaning.
pub fn read(program: &Arc<Program>) -> Result<Properties, Vec<Diagnostic>> {
    let (properties, faults) = read_each(program);
    if !faults.is_empty() {
        return Err(faults.into_iter().map(|(_, fault)| fault).collect());
    }
    Ok(properties)
}

/// Like [`read`], but leaves out those without a meaning, and returns their faults by the index of the property.
pub fn read_each(program: &Arc<Program>) -> (Properties, Vec<(usize, Diagnostic)>) {
    let mut properties = Properties::default();
    let mut reader = Reader::new(program);
    let mut faults = Vec::new();
    for (index, property) in program.properties.iter().enumerate() {
        let formula = match property.kind {
            PropertyKind::Ctl => reader.read(&mut properties.ctl, &property.formula).map(Formula::Ctl),
            PropertyKind::Ltl => reader.read(&mut properties.ltl, &property.formula).map(Formula::Ltl),
            PropertyKind::Justice => {
                properties.justice.push(reader.proposition_of(Proposition::of(&property.formula)));
                None
            }
            PropertyKind::Compassion => {
                let conclusion = property.conclusion.as_ref().unwrap_or(&property.formula);
                let (premise, conclusion) = (Proposition::of(&property.formula), Proposition::of(conclusion));
                properties.compassion.push((reader.proposition_of(premise), reader.proposition_of(conclusion)));
                None
            }
            PropertyKind::Invariant | PropertyKind::Invar => None,
        };
        let found = reader.faults();
        // A formula with a fault in one part may have been read in part.
        properties.formulas.extend(formula.filter(|_| found.is_empty()).map(|formula| (index, formula)));
        faults.extend(found.into_iter().map(|fault| (index, fault)));
    }
    (Properties { propositions: reader.finish(), ..properties }, faults)
}
