//! From the temporal properties of a program to formulas over numbered propositions.
//!
//! In: a lowered program. Out: [`Properties`], or faults with their places. An operator of the CTL or LTL library is a
//! formula's own; so are connectives, conditionals, quantifiers and static functions over formulas, which are written out:
//! a quantifier for each element of its range, a function with its arguments put in. What speaks of one state only is a
//! proposition, whole. INVARIANT: a proposition has no temporal operator in it.

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

/// The temporal properties of a program, and the assumptions on its runs.
#[derive(Debug, Clone, Default)]
pub struct Properties {
    /// What the formulas speak of.
    pub propositions: Vec<Proposition>,
    /// The formulas of CTL.
    pub ctl: CtlFormulas,
    /// The formulas of LTL.
    pub ltl: LtlFormulas,
    /// By its index among the program's properties.
    pub formulas: Vec<(usize, Formula)>,
    /// Propositions that come up again and again.
    pub justice: Vec<usize>,
    /// Pairs of which the second comes up again and again if the first does.
    pub compassion: Vec<(usize, usize)>,
}

/// A formula of one of the logics.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Formula {
    /// Of [`Properties::ctl`].
    Ctl(FormulaId),
    /// Of [`Properties::ltl`].
    Ltl(FormulaId),
}

/// Reads all temporal properties and fairness constraints.
///
/// # Errors
/// Formulas that have no meaning.
pub fn read(program: &Arc<Program>) -> Result<Properties, Vec<Diagnostic>> {
    let (properties, faults) = read_each(program);
    if !faults.is_empty() {
        return Err(faults.into_iter().map(|(_, fault)| fault).collect());
    }
    Ok(properties)
}

/// The same, where those that have no meaning are left out: their faults, by the indices of their properties.
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
        // A formula one of whose parts has a fault may be read in part.
        properties.formulas.extend(formula.filter(|_| found.is_empty()).map(|formula| (index, formula)));
        faults.extend(found.into_iter().map(|fault| (index, fault)));
    }
    (Properties { propositions: reader.finish(), ..properties }, faults)
}
