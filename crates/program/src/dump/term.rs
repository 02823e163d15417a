//! Terms on one line: operations before their operands, binding constructs in parentheses or braces.

use std::fmt::Write;

use model::{CollectionKind, Literal, Quantifier};

use crate::builtin::Builtin;
use crate::dump::{Dump, Written};
use crate::ir::{BinderList, DomainKind, Term, TermId, TermList};

impl Dump<'_> {
    pub(super) fn term(&mut self, id: TermId) -> Written {
        stacker::maybe_grow(64 * 1024, 1024 * 1024, || self.term_here(id))
    }

    fn term_here(&mut self, id: TermId) -> Written {
        let program = self.program;
        match program.term(id) {
            Term::Constant(index) => self.literal(&program.constants[*index as usize]),
            Term::Slot(slot) => self.slot(*slot),
            Term::Read { function, arguments } | Term::Define { function, arguments } => {
                self.text.push_str(&program.function(*function).name);
                if arguments.len > 0 { self.enclosed("(", *arguments, ")") } else { Ok(()) }
            }
            Term::Builtin { builtin, arguments } => {
                match builtin {
                    Builtin::Temporal(operator) => write!(self.text, "{operator:?}")?,
                    builtin => write!(self.text, "{builtin:?}")?,
                }
                self.enclosed("(", *arguments, ")")
            }
            Term::Domain(domain) => {
                self.text.push_str(&program.domain(*domain).name);
                Ok(())
            }
            Term::Tuple(components) => self.enclosed("(", *components, ")"),
            Term::Project { tuple, index } => {
                self.term(*tuple)?;
                write!(self.text, ".{index}")
            }
            Term::Collection { kind, elements } => {
                self.text.push_str(word(*kind));
                self.enclosed("{", *elements, "}")
            }
            Term::Range { kind, low, high, step } => {
                self.text.push_str(word(*kind));
                self.text.push('{');
                self.term(*low)?;
                self.part(" : ", Some(*high))?;
                self.part(", ", *step)?;
                self.text.push('}');
                Ok(())
            }
            Term::Comprehension { kind, binders, condition, body } => {
                self.text.push_str(word(*kind));
                self.text.push('{');
                self.binders(*binders)?;
                self.part(" | ", *condition)?;
                self.part(" : ", Some(*body))?;
                self.text.push('}');
                Ok(())
            }
            Term::Quantified { quantifier, binders, condition } => {
                self.text.push_str(match quantifier {
                    Quantifier::Forall => "(forall ",
                    Quantifier::Exists => "(exists ",
                    Quantifier::ExistsUnique => "(exists unique ",
                });
                self.binders(*binders)?;
                self.part(" with ", *condition)?;
                self.text.push(')');
                Ok(())
            }
            Term::If { branches, otherwise } => {
                for (index, branch) in program.term_list(*branches).chunks_exact(2).enumerate() {
                    self.part(if index == 0 { "(if " } else { " elseif " }, Some(branch[0]))?;
                    self.part(" then ", Some(branch[1]))?;
                }
                self.part(" else ", *otherwise)?;
                self.text.push(')');
                Ok(())
            }
            Term::Switch { subject, cases, otherwise } => {
                self.part("(switch ", Some(*subject))?;
                for case in program.term_list(*cases).chunks_exact(2) {
                    self.part(" case ", Some(case[0]))?;
                    self.part(": ", Some(case[1]))?;
                }
                self.part(" otherwise ", *otherwise)?;
                self.text.push(')');
                Ok(())
            }
            Term::Let { slot, value, body } => {
                self.text.push_str("(let ");
                self.slot(*slot)?;
                self.part(" = ", Some(*value))?;
                self.part(" in ", Some(*body))?;
                self.text.push(')');
                Ok(())
            }
            Term::Missing(function) => {
                self.text.push_str("missing ");
                self.text.push_str(&self.program.function(*function).name);
                Ok(())
            }
            Term::Unbound => {
                self.text.push_str("unbound");
                Ok(())
            }
            Term::Rule(procedure) => {
                self.text.push_str("<<");
                self.procedure_name(*procedure)?;
                self.text.push_str(">>");
                Ok(())
            }
            Term::Coerce(operand) => {
                self.text.push_str(&program.domain(program.term_domain(id)).name);
                self.part("(", Some(*operand))?;
                self.text.push(')');
                Ok(())
            }
        }
    }

    fn part(&mut self, before: &str, term: Option<TermId>) -> Written {
        let Some(term) = term else { return Ok(()) };
        self.text.push_str(before);
        self.term(term)
    }

    pub(super) fn enclosed(&mut self, open: &str, list: TermList, close: &str) -> Written {
        self.text.push_str(open);
        for (index, term) in self.program.term_list(list).iter().enumerate() {
            self.part(if index == 0 { "" } else { ", " }, Some(*term))?;
        }
        self.text.push_str(close);
        Ok(())
    }

    pub(super) fn binders(&mut self, binders: BinderList) -> Written {
        for (index, binder) in self.program.binder_list(binders).iter().enumerate() {
            self.text.push_str(if index == 0 { "" } else { ", " });
            self.slot(binder.slot)?;
            self.part(" in ", Some(binder.range))?;
        }
        Ok(())
    }

    fn literal(&mut self, literal: &Literal) -> Written {
        match literal {
            Literal::Undef => self.text.write_str("undef"),
            Literal::Boolean(truth) => write!(self.text, "{truth}"),
            Literal::Integer(number) => write!(self.text, "{number}"),
            Literal::Real(number) => write!(self.text, "{number:?}"),
            Literal::Complex(re, im) => write!(self.text, "({re:?} + i{im:?})"),
            Literal::Char(character) => write!(self.text, "{character:?}"),
            Literal::String(text) => write!(self.text, "{text:?}"),
            Literal::Enum(domain, index) => match &self.program.domain(*domain).kind {
                DomainKind::Enum { literals } => self.text.write_str(&literals[*index as usize]),
                _ => self.text.write_str("?"),
            },
        }
    }
}

fn word(kind: CollectionKind) -> &'static str {
    match kind {
        CollectionKind::Set => "Set",
        CollectionKind::Seq => "Seq",
        CollectionKind::Bag => "Bag",
        CollectionKind::Map => "Map",
    }
}
