//! Numeric forms: if the operands of an operation differ in form, the narrower one is coerced.
//!
//! The checker makes a coercion explicit where an argument's domain differs from the parameter's. Two cases remain:
//! library functions over different numbers, such as `eq: Prod(Real, Integer)`, and equality over a domain variable.
//! The machine only compares values of the same form.

use model::{Basic, DomainId, DomainKind, Term};

use crate::builtin::{Builtin, Operands};
use crate::lower::Lowering;

/// The machine's form of a number, from the narrowest to the widest.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub(super) enum Form {
    /// Integer and Natural.
    Integer,
    Real,
    Complex,
}

impl Lowering<'_, '_> {
    /// The form of a domain's values, if they are numbers.
    pub(super) fn form(&self, domain: DomainId) -> Option<Form> {
        let domains = &self.model.domains;
        match domains.kind(domains.type_domain(domain)) {
            DomainKind::Basic(Basic::Natural | Basic::Integer) => Some(Form::Integer),
            DomainKind::Basic(Basic::Real) => Some(Form::Real),
            DomainKind::Basic(Basic::Complex) => Some(Form::Complex),
            _ => None,
        }
    }

    /// The form to which the operands of an operation are coerced: its own, or the widest of theirs.
    pub(super) fn common_form(&self, builtin: Builtin, operands: &[Term]) -> Option<Form> {
        match builtin.info().operands {
            Operands::Alike | Operands::Ordered => {
                operands.iter().filter_map(|operand| self.form(operand.domain)).max()
            }
            Operands::Reals(_) => Some(Form::Real),
            Operands::Complexes(_) => Some(Form::Complex),
            Operands::Values(_)
            | Operands::OneOrMore
            | Operands::Integers(_)
            | Operands::Of(_)
            | Operands::OneOf(_)
            | Operands::Own => None,
        }
    }
}
