//! Encodes conditions about an arbitrary state: each function of the state is unknown, so a solver may choose it.
//!
//! In: a program and a condition over it; an `exist` at its top binds variables that are unknown as well. Out: the term
//! that the condition is true, including that its evaluation does not fault. A location counts as defined unless the
//! condition asks whether it is (`isDef`, `isUndef`, `= undef`). A domain that may have elements besides its named ones
//! is open: a dynamic one, one of a module, `Agent`. Such a domain cannot be enumerated, and its values may be unnamed.
//! LIMIT: arguments of a location count as defined.

use std::collections::{BTreeMap, BTreeSet};
use std::sync::Arc;

use model::Basic;
use program::{
    Binder, Builtin, DomainId, DomainKind, Effect, Expression, FunctionId, Program, Quantifier, Term, TermId,
};
use syntax::Span;

use super::number::INTEGERS;
use super::tested::tested;
use super::{Encoder, Result};
use crate::session::Constant;
use crate::shared::{Bounds, Kind, Node, Op, Terms, VariableId};
use crate::symbol::{Open, Shape, Symbol, constant};

/// LIMIT: larger domains are not listed.
const VALUES: usize = 10_000;

/// The sort of a value: its shape, and the type domain that names it.
pub type Sort = (Shape, DomainId);

/// A function of the state, or a variable, of which only the domain is known.
#[derive(Debug, Clone)]
pub struct Unknown {
    /// The name; for a definedness test, the function's name.
    pub name: String,
    /// Whether it is the test that the function of this name is defined.
    pub definedness: bool,
    /// The sorts of its arguments.
    pub parameters: Vec<Sort>,
    /// The sort of its values.
    pub sort: Sort,
    /// Its possible values, if they are listed.
    pub values: Option<Vec<Constant>>,
}

/// The unknowns of a condition.
#[derive(Debug, Default)]
pub(super) struct Free {
    /// Functions whose definedness is tested.
    tested: BTreeSet<FunctionId>,
    /// The symbols of each function's value and definedness.
    functions: BTreeMap<(FunctionId, bool), VariableId>,
    unknowns: BTreeMap<VariableId, Unknown>,
}

impl Encoder {
    /// The term that a condition holds in an arbitrary state.
    ///
    /// # Errors
    /// It contains something that cannot be encoded.
    pub fn condition_of_any_state(&mut self, condition: &Expression) -> Result<Node> {
        self.free = Some(Free { tested: tested(&self.program, condition), ..Free::default() });
        let program = Arc::clone(&self.program);
        let span = program.term_span(condition.body);
        let truth = self.in_frame(Vec::new(), condition.frame, span, |this| match program.term(condition.body) {
            Term::Quantified { quantifier: Quantifier::Exists, binders, condition: inner } => {
                for binder in program.binder_list(*binders) {
                    this.leave_open(binder, &condition.names[binder.slot.0 as usize])?;
                }
                inner.map_or(Ok(Terms::TRUE), |inner| this.holds(inner))
            }
            _ => this.holds(condition.body),
        })?;
        if let Some((_, outside)) = self.beyond.first() {
            return Err(outside.clone());
        }
        let condition = self.terms.and([truth, self.live]);
        self.tell_texts_apart(condition);
        Ok(condition)
    }

    /// The unknowns of a condition, keyed by their symbols.
    pub fn unknowns(&mut self) -> BTreeMap<VariableId, Unknown> {
        self.free.take().unwrap_or_default().unknowns
    }

    /// Binds a variable to any value of its domain.
    fn leave_open(&mut self, binder: &Binder, name: &str) -> Result<()> {
        let Term::Domain(domain) = *self.program.term(binder.range) else {
            let span = self.program.term_span(binder.range);
            return self.outside("a variable over something that is no domain", span);
        };
        let sort = self.sort_of(domain, self.program.term_span(binder.range))?;
        let id = self.unknown(name.to_string(), None, Vec::new(), sort, domain);
        let value = self.location(id, Vec::new());
        self.bind(binder.slot, Symbol::Open(Open { shape: sort.0, value, defined: Terms::TRUE }));
        Ok(())
    }

    fn sort_of(&self, domain: DomainId, span: Span) -> Result<Sort> {
        match self.shape_of(domain, span) {
            Ok(shape) => Ok((shape, self.program.base_domain(domain))),
            Err(_) => self.outside(format!("a term of the domain {}", self.program.domain(domain).name), span),
        }
    }

    /// A new symbol for values of a domain, or with `tests` for the definedness of a function.
    fn unknown(
        &mut self,
        name: String,
        tests: Option<FunctionId>,
        parameters: Vec<Sort>,
        sort: Sort,
        domain: DomainId,
    ) -> VariableId {
        let definedness = tests.is_some();
        let kinds: Vec<Kind> = parameters.iter().map(|(shape, _)| shape.kind()).collect();
        let ((shape, _), values, bounds) = match definedness {
            true => ((Shape::Boolean, sort.1), None, (None, None)),
            false => {
                let values = self.values_of_sort(domain, sort);
                let bounds = self.bounds_of_sort(sort, values.as_deref());
                (sort, values, bounds)
            }
        };
        let called = if definedness { format!("isDef {name}") } else { name.clone() };
        let id = self.terms.function(called, kinds, shape.kind(), bounds);
        let unknown = Unknown { name, definedness, parameters, sort: (shape, sort.1), values };
        if let Some(free) = &mut self.free {
            free.unknowns.insert(id, unknown);
        }
        id
    }

    fn values_of_sort(&mut self, domain: DomainId, (shape, _): Sort) -> Option<Vec<Constant>> {
        if shape == Shape::Boolean {
            return None;
        }
        let values = self.elements_of(domain)?;
        let mut constants = Vec::with_capacity(values.len());
        for value in values.iter().filter(|value| !value.is_undef()) {
            if Shape::of(value) != shape {
                return None;
            }
            let node = constant(&mut self.terms, &mut self.codes, value);
            constants.extend(self.terms.constant(node));
        }
        Some(constants)
    }

    fn bounds_of_sort(&self, (shape, base): Sort, values: Option<&[Constant]>) -> Bounds {
        let whole = |constant: &Constant| match constant {
            Constant::Integer(number) => Some(*number),
            Constant::Boolean(_) | Constant::Real(_) => None,
        };
        let numbers = || values.into_iter().flatten().filter_map(whole);
        match shape {
            Shape::Boolean | Shape::Real => (None, None),
            _ if numbers().next().is_some() => (numbers().min(), numbers().max()),
            Shape::Integer => match self.program.domain(base).kind {
                DomainKind::Basic(Basic::Natural) => (Some(0), INTEGERS.1),
                _ => INTEGERS,
            },
            Shape::Enum(_) | Shape::Element(_) | Shape::Coded => (Some(0), Some(1 << 32)),
        }
    }

    /// The value of a symbol at arguments; records what its domain says about it.
    fn location(&mut self, id: VariableId, arguments: Vec<Node>) -> Node {
        let node = self.terms.apply(id, arguments);
        let values = self.free.as_ref().and_then(|free| free.unknowns.get(&id)?.values.clone());
        if let Some(values) = values {
            let nodes: Vec<Node> = values.into_iter().map(|value| self.terms.of_constant(value)).collect();
            let within = self.one_of(node, &nodes);
            if within != Terms::TRUE && !self.given.contains(&within) {
                self.given.push(within);
            }
        }
        node
    }

    /// The value of a location.
    pub(super) fn read_free(&mut self, function: FunctionId, arguments: &[Symbol], span: Span) -> Result {
        let program = Arc::clone(&self.program);
        let declared = program.function(function);
        let (mut nodes, mut parameters) = (Vec::new(), Vec::new());
        for (argument, parameter) in arguments.iter().zip(&declared.parameters) {
            self.need(argument);
            if *argument == Symbol::UNDEF {
                return Ok(Symbol::UNDEF);
            }
            let sort = self.sort_of(*parameter, span)?;
            match self.open(argument, None) {
                Some(open) if open.shape == sort.0 => nodes.push(open.value),
                _ => {
                    let what = format!("an argument of the domain {}", program.domain(*parameter).name);
                    return self.outside(what, span);
                }
            }
            parameters.push(sort);
        }
        let sort = self.sort_of(declared.codomain, span)?;
        let symbol = |this: &mut Self, definedness: bool| {
            let known = this.free.as_ref().and_then(|free| free.functions.get(&(function, definedness)).copied());
            let id = known.unwrap_or_else(|| {
                let tests = definedness.then_some(function);
                this.unknown(declared.name.clone(), tests, parameters.clone(), sort, declared.codomain)
            });
            if let Some(free) = &mut this.free {
                free.functions.insert((function, definedness), id);
            }
            this.location(id, nodes.clone())
        };
        let value = symbol(self, false);
        let asked = self.free.as_ref().is_some_and(|free| free.tested.contains(&function));
        let defined = if asked { symbol(self, true) } else { Terms::TRUE };
        Ok(self.symbol(Open { shape: sort.0, value, defined }))
    }

    /// Whether an element is in a collection that is written out by its elements or its ends; `None` if it is not
    /// written out. The element is evaluated first, in reading order: here the order of faults does not matter.
    pub(super) fn is_written_in(&mut self, collection: TermId, element: TermId) -> Result<Option<Symbol>> {
        let program = Arc::clone(&self.program);
        match program.term(collection) {
            Term::Collection { elements, .. } => {
                let mut any = Vec::new();
                let element = self.evaluate(element)?;
                let elements = self.evaluate_all(*elements)?;
                for other in &elements {
                    any.push(self.equal(&element, other)?);
                }
                Ok(Some(Symbol::boolean(self.terms.or(any))))
            }
            Term::Range { low, high, step: None, .. } => {
                let span = program.term_span(collection);
                let element = self.evaluate(element)?;
                let (low, high) = (self.evaluate(*low)?, self.evaluate(*high)?);
                let (low, high) = (self.integer_operand(&low, span)?, self.integer_operand(&high, span)?);
                if element == Symbol::UNDEF {
                    return Ok(Some(Symbol::boolean(Terms::FALSE)));
                }
                match self.open(&element, None) {
                    Some(Open { shape: Shape::Integer, value, defined }) => {
                        let ends = [self.terms.at_most(low, value), self.terms.at_most(value, high)];
                        Ok(Some(Symbol::boolean(self.terms.and([defined, ends[0], ends[1]]))))
                    }
                    _ => self.outside("a range that is not of integers", span),
                }
            }
            _ => Ok(None),
        }
    }

    /// Whether a domain may have unknown elements.
    pub(super) fn is_open(&mut self, domain: DomainId) -> bool {
        let program = Arc::clone(&self.program);
        match &program.domain(domain).kind {
            DomainKind::Abstract { elements, dynamic } => *dynamic || program.main.is_none() || elements.is_empty(),
            DomainKind::Concrete { dynamic: true, .. } => true,
            DomainKind::Concrete { contents: Some(contents), .. } => !self.is_settled(contents.body),
            DomainKind::Concrete { base, .. } => self.is_open(*base),
            DomainKind::Prod(parts) => parts.iter().any(|part| self.is_open(*part)),
            DomainKind::Seq(of) | DomainKind::Powerset(of) | DomainKind::Bag(of) => self.is_open(*of),
            DomainKind::Map(key, value) => self.is_open(*key) || self.is_open(*value),
            DomainKind::Enum { .. } | DomainKind::Basic(_) => false,
            DomainKind::Error | DomainKind::Any | DomainKind::Rule(_) => true,
        }
    }

    /// All elements of a domain that is not open.
    pub(super) fn elements_if_closed(&mut self, domain: DomainId) -> Option<Vec<machine::Value>> {
        // A domain whose contents depend on themselves has none, so the recursion ends.
        let known = self.machine.elements(domain).ok().filter(|known| known.len() <= VALUES)?;
        (!self.is_open(domain)).then_some(known)
    }

    /// Whether a term has the same value in every state, except for its variables.
    pub(super) fn is_settled(&mut self, id: TermId) -> bool {
        let program = Arc::clone(&self.program);
        let (mut open, mut entered) = (vec![id], BTreeSet::new());
        while let Some(id) = open.pop() {
            let settled = match program.term(id) {
                Term::Read { function, .. } => program.function(*function).element.is_some(),
                Term::Define { function, .. } => {
                    if entered.insert(*function) {
                        open.extend(program.function(*function).definition.as_ref().map(|definition| definition.body));
                    }
                    true
                }
                Term::Builtin { builtin, .. } => builtin.info().effect.is_none(),
                Term::Domain(domain) => self.elements_if_closed(*domain).is_some(),
                // A long range is not listed; its ends are compared.
                Term::Range { .. } => true,
                Term::Missing(_) | Term::Unbound | Term::Rule(_) => false,
                Term::Constant(_)
                | Term::Slot(_)
                | Term::Tuple(_)
                | Term::Project { .. }
                | Term::Collection { .. }
                | Term::Comprehension { .. }
                | Term::Quantified { .. }
                | Term::If { .. }
                | Term::Switch { .. }
                | Term::Let { .. }
                | Term::Coerce(_) => true,
            };
            if !settled {
                return false;
            }
            program.each_child_of_term(id, &mut |child| open.push(child));
        }
        true
    }

    /// States that a String is no Char, although both are encoded by codes.
    fn tell_texts_apart(&mut self, condition: Node) {
        let program = Arc::clone(&self.program);
        for node in self.terms.parts([condition]) {
            let id = match self.terms.op(node) {
                Op::Variable(id) | Op::Apply(id, _) => *id,
                _ => continue,
            };
            let unknown = self.free.as_ref().and_then(|free| free.unknowns.get(&id));
            let Some(Unknown { sort: (Shape::Coded, domain), values: None, .. }) = unknown else { continue };
            let domain = *domain;
            for (code, value) in self.codes.values().to_vec().iter().enumerate() {
                if !is_text_of(&program, domain, value) {
                    let code = self.terms.integer(code as i128);
                    let same = self.terms.equal(node, code);
                    let differs = self.terms.not(same);
                    self.given.push(differs);
                }
            }
        }
    }
}

/// Whether an encoded value belongs to a domain.
pub(crate) fn is_text_of(program: &Program, domain: DomainId, value: &machine::Value) -> bool {
    match program.domain(domain).kind {
        DomainKind::Basic(Basic::Char) => matches!(value, machine::Value::Char(_)),
        _ => matches!(value, machine::Value::String(_)),
    }
}

/// Whether a builtin depends on more than its operands.
pub(super) fn depends_on_more(builtin: Builtin) -> bool {
    match builtin.info().effect {
        Effect::Pure => false,
        Effect::ReadsAgents | Effect::ReadsBefore | Effect::Chooses | Effect::ReadsClock | Effect::SpeaksOfRuns => true,
    }
}
