//! Checked term → formula.
//!
//! In: a model and a condition over it; an `exist` at its top binds variables that the formula leaves open. Out: the formula
//! that the condition is true, which includes that evaluating it meets no fault: no overflow of 64 bits, no division by
//! zero, no undef where a value is needed. Definitions are written out. What has no place in formulas is [`Outside`].
//!
//! A location is taken to be defined, unless the condition asks whether it is (`isDef`, `isUndef`, `= undef`).
//! LIMIT: arguments of a location are taken to be defined.

mod domain;
mod operation;
mod undef;

use std::collections::{BTreeMap, BTreeSet};
use std::rc::Rc;

use model::{Binder, Definition, FunctionId, FunctionKind, Literal, Model, Quantifier, TermKind, Variable};
use syntax::Span;

use crate::formula::{Carrier, Formula, Sort, Symbol, SymbolId, Term, Value};

/// How deep definitions are written out.
const MAX_DEPTH: usize = 24;
/// How large a formula may become, in terms made.
const MAX_TERMS: usize = 200_000;

/// Why a term has no formula.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Outside {
    /// What it is, as a noun: "a term of the domain Seq(Integer)".
    pub what: String,
    /// Where it stands.
    pub span: Span,
}

/// What a term comes to.
#[derive(Debug, Clone)]
struct Partial {
    /// Its value, where it is defined and safe.
    value: Term,
    /// It is not undef.
    defined: Term,
    /// Evaluating it meets no fault.
    safe: Term,
}

type Result<T = Partial> = std::result::Result<T, Outside>;

/// The formula that a condition holds.
///
/// # Errors
/// The condition holds something that formulas have no place for.
pub fn translate(
    model: &Model,
    condition: &model::Term,
    variables: &[Variable],
) -> std::result::Result<Formula, Outside> {
    let mut translator = Translator {
        model,
        formula: Formula { carriers: Vec::new(), symbols: Vec::new(), condition: Term::TRUE },
        tested: undef::tested(model, condition),
        carriers: BTreeMap::new(),
        symbols: BTreeMap::new(),
        made: 0,
    };
    let mut frame = vec![None; variables.len()];
    let mut inner = Some(condition);
    if let TermKind::Quantified { quantifier: Quantifier::Exists, binders, condition } = &condition.kind {
        for binder in binders {
            let name = variables[binder.variable.0 as usize].name.clone();
            translator.opened(binder, name, &mut frame)?;
        }
        inner = condition.as_deref();
    }
    if let Some(inner) = inner {
        let all = translator.term(inner, &Rc::new(frame), 0)?;
        translator.formula.condition = Term::and([all.safe, all.defined, all.value]);
    }
    Ok(translator.formula)
}

/// What stands in the place of each variable.
type Frame = Rc<Vec<Option<Partial>>>;

struct Translator<'m> {
    model: &'m Model,
    formula: Formula,
    /// Functions that are asked whether they are defined.
    tested: BTreeSet<FunctionId>,
    /// The carrier of each domain.
    carriers: BTreeMap<model::DomainId, usize>,
    /// The symbol of each function, and that of its definedness.
    symbols: BTreeMap<(FunctionId, bool), SymbolId>,
    made: usize,
}

impl Translator<'_> {
    fn outside<T>(&self, what: impl Into<String>, span: Span) -> Result<T> {
        Err(Outside { what: what.into(), span })
    }

    /// A variable of the outermost `exist`, as a symbol.
    fn opened(&mut self, binder: &Binder, name: String, frame: &mut [Option<Partial>]) -> Result<()> {
        let TermKind::Domain(domain) = binder.range.kind else {
            return self.outside("a variable over something that is no domain", binder.range.span);
        };
        let sort = self.sort(domain, binder.range.span)?;
        let values = self.values(domain);
        let symbol = Symbol { name, definedness: false, parameters: Vec::new(), sort, values };
        self.formula.symbols.push(symbol);
        let value = Term::Apply(SymbolId(self.formula.symbols.len() - 1), Vec::new());
        frame[binder.variable.0 as usize] = Some(sure(value));
        Ok(())
    }

    fn term(&mut self, term: &model::Term, frame: &Frame, depth: usize) -> Result {
        self.made += 1;
        if depth > MAX_DEPTH * 8 || self.made > MAX_TERMS {
            return self.outside("a term that is too large when its definitions are written out", term.span);
        }
        stacker::maybe_grow(128 << 10, 2 << 20, || self.term_here(term, frame, depth + 1))
    }

    fn term_here(&mut self, term: &model::Term, frame: &Frame, depth: usize) -> Result {
        match &term.kind {
            TermKind::Literal(literal) => self.literal(literal, term),
            TermKind::Variable(id) => match &frame[id.0 as usize] {
                Some(bound) => Ok(bound.clone()),
                None => self.outside("a variable that is not bound", term.span),
            },
            TermKind::Apply { function, arguments } => self.apply(*function, arguments, term, frame, depth),
            TermKind::Quantified { quantifier, binders, condition } => {
                self.quantified(*quantifier, binders, condition.as_deref(), term, frame, depth)
            }
            TermKind::If { branches, otherwise } => {
                let mut result = match otherwise {
                    Some(term) => Some(self.term(term, frame, depth)?),
                    None => None,
                };
                for (guard, value) in branches.iter().rev() {
                    let (guard, value) = (self.term(guard, frame, depth)?, self.term(value, frame, depth)?);
                    let result_here = result.take().unwrap_or_else(|| undefined(&value));
                    let chosen = chosen(&guard.value, value, result_here);
                    result = Some(Partial { safe: Term::and([guard.safe, guard.defined, chosen.safe]), ..chosen });
                }
                result.map_or_else(|| self.outside("an empty `if`", term.span), Ok)
            }
            TermKind::Switch { subject, cases, otherwise } => {
                let subject = self.term(subject, frame, depth)?;
                let mut result = match otherwise {
                    Some(term) => Some(self.term(term, frame, depth)?),
                    None => None,
                };
                for (case, value) in cases.iter().rev() {
                    let (case, value) = (self.term(case, frame, depth)?, self.term(value, frame, depth)?);
                    let equal = equal(&subject, &case);
                    let result_here = result.take().unwrap_or_else(|| undefined(&value));
                    let chosen = chosen(&equal.value, value, result_here);
                    result = Some(Partial { safe: Term::and([equal.safe, chosen.safe]), ..chosen });
                }
                result.map_or_else(|| self.outside("an empty `switch`", term.span), Ok)
            }
            TermKind::Let { bindings, body } => {
                let mut inside = Rc::clone(frame);
                for (variable, value) in bindings {
                    let value = self.term(value, &inside, depth)?;
                    Rc::make_mut(&mut inside)[variable.0 as usize] = Some(value);
                }
                self.term(body, &inside, depth)
            }
            TermKind::Coerce(inner) => {
                let operand = self.term(inner, frame, depth)?;
                match (self.formula.sort(&operand.value), self.sort(term.domain, term.span)?) {
                    (Sort::Integer, Sort::Real) => Ok(Partial { value: to_real(operand.value), ..operand }),
                    (from, to) if from == to => Ok(operand),
                    _ => self.outside("a conversion of numbers", term.span),
                }
            }
            TermKind::Domain(_)
            | TermKind::Tuple(_)
            | TermKind::Project { .. }
            | TermKind::Collection { .. }
            | TermKind::Range { .. }
            | TermKind::Comprehension { .. } => {
                let domain = self.model.domains.display(term.domain);
                self.outside(format!("a term of the domain {domain}"), term.span)
            }
            TermKind::Unbound(_) | TermKind::Rule(_) | TermKind::Error => {
                self.outside("a term that is no value", term.span)
            }
        }
    }

    fn literal(&mut self, literal: &Literal, term: &model::Term) -> Result {
        let value = match literal {
            Literal::Undef => {
                return Ok(Partial { value: Term::FALSE, defined: Term::FALSE, safe: Term::TRUE });
            }
            Literal::Boolean(truth) => Value::Boolean(*truth),
            Literal::Integer(number) => Value::Integer(*number),
            Literal::Real(number) => Value::Real(*number),
            Literal::Enum(domain, index) => Value::Element(self.carrier(*domain), *index as usize),
            Literal::String(text) => self.text(term.domain, format!("{text:?}")),
            Literal::Char(letter) => self.text(term.domain, format!("{letter:?}")),
            Literal::Complex(..) => return self.outside("a complex number", term.span),
        };
        Ok(sure(Term::Constant(value)))
    }

    fn apply(
        &mut self,
        function: FunctionId,
        arguments: &[model::Term],
        term: &model::Term,
        frame: &Frame,
        depth: usize,
    ) -> Result {
        let declared = self.model.function(function);
        let defined = match declared.kind {
            FunctionKind::Static | FunctionKind::Derived => declared.definition.as_ref(),
            _ => None,
        };
        if let Some(definition) = defined {
            return self.definition(definition, arguments, frame, depth + 7);
        }
        if declared.library && declared.kind == FunctionKind::Static {
            return self.operation(&declared.name, arguments, term, frame, depth);
        }
        if declared.kind == FunctionKind::Static && declared.parameters.is_empty() {
            let carrier = self.carrier(self.model.domains.type_domain(declared.codomain));
            let elements = &self.formula.carriers[carrier].elements;
            if let Some(index) = elements.iter().position(|name| *name == declared.name) {
                return Ok(sure(Term::Constant(Value::Element(carrier, index))));
            }
        }
        let mut safe = Vec::new();
        let mut values = Vec::new();
        for argument in arguments {
            let argument = self.term(argument, frame, depth)?;
            safe.extend([argument.safe, argument.defined]);
            values.push(argument.value);
        }
        let id = self.symbol(function, false, &values, term.span)?;
        let mut defined = Term::TRUE;
        if self.tested.contains(&function) {
            defined = Term::Apply(self.symbol(function, true, &values, term.span)?, values.clone());
        }
        let value = Term::Apply(id, values);
        if self.is_natural(declared.codomain) {
            safe.push(Term::compare(crate::Order::LessEqual, Term::integer(0), value.clone()));
        }
        Ok(Partial { value, defined, safe: Term::and(safe) })
    }

    fn definition(
        &mut self,
        definition: &Definition,
        arguments: &[model::Term],
        frame: &Frame,
        depth: usize,
    ) -> Result {
        let mut inside = vec![None; definition.variables.len()];
        let mut safe = Vec::new();
        for (parameter, argument) in definition.parameters.iter().zip(arguments) {
            let argument = self.term(argument, frame, depth)?;
            safe.push(argument.safe.clone());
            inside[parameter.0 as usize] = Some(Partial { safe: Term::TRUE, ..argument });
        }
        let body = self.term(&definition.body, &Rc::new(inside), depth)?;
        Ok(Partial { safe: Term::and(safe.into_iter().chain([body.safe])), ..body })
    }

    fn symbol(&mut self, function: FunctionId, definedness: bool, arguments: &[Term], span: Span) -> Result<SymbolId> {
        if let Some(id) = self.symbols.get(&(function, definedness)) {
            return Ok(*id);
        }
        let declared = self.model.function(function);
        let sort = if definedness { Sort::Boolean } else { self.sort(declared.codomain, span)? };
        let symbol = Symbol {
            name: declared.name.clone(),
            definedness,
            parameters: arguments.iter().map(|argument| self.formula.sort(argument)).collect(),
            sort,
            values: if definedness { None } else { self.values(declared.codomain) },
        };
        self.formula.symbols.push(symbol);
        let id = SymbolId(self.formula.symbols.len() - 1);
        self.symbols.insert((function, definedness), id);
        Ok(id)
    }

    /// A quantifier over few enough elements, each written out.
    fn quantified(
        &mut self,
        quantifier: Quantifier,
        binders: &[Binder],
        condition: Option<&model::Term>,
        term: &model::Term,
        frame: &Frame,
        depth: usize,
    ) -> Result {
        let [binder, rest @ ..] = binders else {
            return match condition {
                Some(condition) => {
                    let inner = self.term(condition, frame, depth)?;
                    Ok(Partial { safe: Term::and([inner.safe, inner.defined]), defined: Term::TRUE, ..inner })
                }
                None => Ok(sure(Term::TRUE)),
            };
        };
        if quantifier == Quantifier::ExistsUnique {
            return self.outside("a quantifier `exist unique`", term.span);
        }
        let Some(values) = self.enumerated(&binder.range) else {
            return self.outside("a quantifier over what cannot be listed", binder.range.span);
        };
        let mut all = Vec::new();
        for value in values {
            let mut inside = Rc::clone(frame);
            Rc::make_mut(&mut inside)[binder.variable.0 as usize] = Some(sure(Term::Constant(value)));
            all.push(self.quantified(quantifier, rest, condition, term, &inside, depth)?);
        }
        // One that decides ends it, so that the rest need not be safe.
        let (mut value, mut safe) = (Term::Constant(Value::Boolean(quantifier == Quantifier::Forall)), Term::TRUE);
        for one in all.into_iter().rev() {
            match quantifier {
                Quantifier::Forall => {
                    safe = Term::and([one.safe, Term::or([one.value.clone().not(), safe])]);
                    value = Term::and([one.value, value]);
                }
                _ => {
                    safe = Term::and([one.safe, Term::or([one.value.clone(), safe])]);
                    value = Term::or([one.value, value]);
                }
            }
        }
        Ok(Partial { value, defined: Term::TRUE, safe })
    }
}

/// A term that is defined and meets no fault.
fn sure(value: Term) -> Partial {
    Partial { value, defined: Term::TRUE, safe: Term::TRUE }
}

/// Undef, where a value like this one could stand.
fn undefined(like: &Partial) -> Partial {
    Partial { value: like.value.clone(), defined: Term::FALSE, safe: Term::TRUE }
}

fn chosen(condition: &Term, yes: Partial, no: Partial) -> Partial {
    let either = |yes, no| Term::choose(condition.clone(), yes, no);
    // The value of undef is none; it must not stand beside one of another sort.
    let value = match (yes.defined.truth(), no.defined.truth()) {
        (Some(false), _) => no.value,
        (_, Some(false)) => yes.value,
        _ => either(yes.value, no.value),
    };
    Partial { value, defined: either(yes.defined, no.defined), safe: either(yes.safe, no.safe) }
}

/// Equality is total: undef equals itself and nothing else.
fn equal(a: &Partial, b: &Partial) -> Partial {
    let both = || Term::and([a.defined.clone(), b.defined.clone(), Term::equal(a.value.clone(), b.value.clone())]);
    let neither = Term::and([a.defined.clone().not(), b.defined.clone().not()]);
    let value = match (a.defined.truth(), b.defined.truth()) {
        (Some(false), _) | (_, Some(false)) => neither,
        _ => Term::or([both(), neither]),
    };
    Partial { value, defined: Term::TRUE, safe: Term::and([a.safe.clone(), b.safe.clone()]) }
}

fn to_real(term: Term) -> Term {
    match term {
        Term::Constant(Value::Integer(number)) => Term::Constant(Value::Real(number as f64)),
        other => Term::ToReal(Box::new(other)),
    }
}

impl Translator<'_> {
    /// Adds a carrier.
    fn add_carrier(&mut self, domain: model::DomainId, carrier: Carrier) -> usize {
        self.formula.carriers.push(carrier);
        let index = self.formula.carriers.len() - 1;
        self.carriers.insert(domain, index);
        index
    }
}
