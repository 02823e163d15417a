//! By-name arguments: decides which can be passed by value, and gives the others a canonical form.
//!
//! A macro call substitutes its arguments in the rule's body (Börger & Stärk 2003, section 2.4.4). An argument is
//! passed by value if that has the same effect as substitution: its value is the same wherever the body may evaluate
//! it, and its evaluation cannot fail. Any other argument becomes an [`Argument`]: the term as written, and the meaning
//! of its variables. The slots that it needs from the caller are numbered from 0 in order of occurrence. INVARIANT:
//! arguments with the same text of [`Lowering::intern`] differ only in places of the source, so equal calls share a
//! procedure. LIMIT: the shared terms have the place of the first of equal arguments.

use std::collections::BTreeMap;
use std::fmt::Write;
use std::rc::Rc;

use model::{Binder, FunctionKind, RuleId, Term, TermKind, VariableId};

use crate::ir::{ArgumentId, Slot};
use crate::lower::environment::{Binding, Environment};
use crate::lower::meaning::Meaning;
use crate::lower::{Lowering, RED_ZONE, STACK_PIECE};

/// A by-name argument.
#[derive(Debug)]
pub(super) struct Argument<'m> {
    /// The term as written.
    pub term: &'m Term,
    /// What its free variables stand for; the slots are numbers into the list of slots of a [`Binding::ByName`].
    pub environment: Environment<'m>,
}

impl<'m> Lowering<'m, '_> {
    /// Whether an argument may be passed by value.
    pub(super) fn is_simple(&mut self, term: &Term) -> bool {
        match &term.kind {
            TermKind::Literal(_) | TermKind::Rule(_) | TermKind::Error => true,
            TermKind::Variable(variable) => {
                matches!(self.environment.bindings.get(variable), Some(Binding::Slot(_)) | None)
            }
            TermKind::Tuple(parts) | TermKind::Collection { elements: parts, .. } => {
                parts.iter().all(|part| self.is_simple(part))
            }
            TermKind::Coerce(operand) => self.is_simple(operand),
            TermKind::Apply { .. } => self.is_constant(term),
            _ => false,
        }
    }

    /// Whether a term without variables always has the same value: a literal, an element, a static constant.
    fn is_constant(&mut self, term: &Term) -> bool {
        if self.folded(term).is_some() {
            return true;
        }
        let model = self.model;
        let mut term = term;
        // A chain of constants longer than this, or a ring of them, counts as not constant.
        for _ in 0..8 {
            let TermKind::Apply { function, arguments } = &term.kind else { return self.folded(term).is_some() };
            let declared = model.function(*function);
            if !arguments.is_empty() || declared.kind != FunctionKind::Static {
                return self.folded(term).is_some();
            }
            match (self.meaning(*function), &declared.definition) {
                (Meaning::Read, _) => return true,
                (Meaning::Define, Some(definition)) => term = &definition.body,
                _ => return false,
            }
        }
        false
    }

    /// Lowers something with the variables of an argument, which stand for these slots of the current frame.
    pub(super) fn within_argument<T>(
        &mut self,
        argument: ArgumentId,
        slots: &[Slot],
        lower: impl FnOnce(&mut Self, &'m Term) -> T,
    ) -> T {
        let argument = self.arguments.get(&argument).expect("an interned argument").clone();
        let actual = |number: &Slot| slots[number.0 as usize];
        let bindings = argument.environment.bindings.iter().map(|(variable, binding)| {
            let binding = match binding {
                Binding::Slot(number) => Binding::Slot(actual(number)),
                Binding::ByName { argument, slots } => {
                    Binding::ByName { argument: *argument, slots: slots.iter().map(actual).collect() }
                }
            };
            (*variable, binding)
        });
        let inner = Environment { variables: argument.environment.variables, bindings: bindings.collect() };
        let outer = std::mem::replace(&mut self.environment, inner);
        let result = lower(self, argument.term);
        self.environment = outer;
        result
    }

    /// A term of the current environment as an argument, and the slots it needs.
    pub(super) fn intern(&mut self, term: &'m Term) -> (ArgumentId, Vec<Slot>) {
        let mut canonical = Canonical::new(&self.environment);
        canonical.write_term(term);
        let Canonical { text, slots, free, .. } = canonical;
        let known = &mut self.program.specialisations.arguments;
        let next = known.len() as ArgumentId;
        let id = *known.entry(text).or_insert(next);
        let environment = Environment { variables: self.environment.variables, bindings: free };
        self.arguments.entry(id).or_insert_with(|| Rc::new(Argument { term, environment }));
        (id, slots)
    }
}

/// Writes a term as a text that is the same for equal terms only: variables bound within are numbered by place,
/// free slots by occurrence.
struct Canonical<'a, 'm> {
    environment: &'a Environment<'m>,
    text: String,
    slots: Vec<Slot>,
    /// What the free variables stand for, with slots numbered.
    free: BTreeMap<VariableId, Binding>,
    bound: BTreeMap<VariableId, u32>,
}

impl<'a, 'm> Canonical<'a, 'm> {
    fn new(environment: &'a Environment<'m>) -> Self {
        Canonical { environment, text: String::new(), slots: Vec::new(), free: BTreeMap::new(), bound: BTreeMap::new() }
    }

    fn write(&mut self, text: std::fmt::Arguments<'_>) {
        self.text.write_fmt(text).expect("a string takes any text");
    }

    /// `(kind part part …)domain`
    fn write_term(&mut self, term: &Term) {
        stacker::maybe_grow(RED_ZONE, STACK_PIECE, || {
            self.text.push('(');
            self.write_kind(&term.kind);
            self.write(format_args!("){}", term.domain.0));
        });
    }

    fn write_terms<'t>(&mut self, terms: impl IntoIterator<Item = &'t Term>) {
        terms.into_iter().for_each(|term| self.write_term(term));
    }

    fn write_kind(&mut self, kind: &TermKind) {
        match kind {
            TermKind::Literal(literal) => self.write(format_args!("{literal:?}")),
            TermKind::Variable(variable) => self.write_variable(*variable),
            TermKind::Apply { function, arguments } => {
                self.write(format_args!("f{}", function.0));
                self.write_terms(arguments);
            }
            TermKind::Domain(domain) => self.write(format_args!("D{}", domain.0)),
            TermKind::Tuple(components) => {
                self.text.push('t');
                self.write_terms(components);
            }
            TermKind::Project { tuple, index } => {
                self.write(format_args!("p{index}"));
                self.write_term(tuple);
            }
            TermKind::Collection { kind, elements } => {
                self.write(format_args!("c{kind:?}"));
                self.write_terms(elements);
            }
            TermKind::Range { kind, low, high, step } => {
                self.write(format_args!("r{kind:?}"));
                self.write_terms([&**low, &**high]);
                self.write_terms(step.as_deref());
            }
            TermKind::Comprehension { kind, binders, condition, body } => {
                self.write(format_args!("C{kind:?}"));
                self.write_binders(binders);
                self.write_optional(condition.as_deref());
                self.write_term(body);
            }
            TermKind::Quantified { quantifier, binders, condition } => {
                self.write(format_args!("q{quantifier:?}"));
                self.write_binders(binders);
                self.write_optional(condition.as_deref());
            }
            TermKind::If { branches, otherwise } => {
                self.text.push('i');
                self.write_terms(branches.iter().flat_map(|(guard, term)| [guard, term]));
                self.write_optional(otherwise.as_deref());
            }
            TermKind::Switch { subject, cases, otherwise } => {
                self.text.push('s');
                self.write_term(subject);
                self.write_terms(cases.iter().flat_map(|(value, term)| [value, term]));
                self.write_optional(otherwise.as_deref());
            }
            TermKind::Let { bindings, body } => {
                self.text.push('l');
                for (variable, value) in bindings {
                    self.write_term(value);
                    self.bind(*variable);
                }
                self.write_term(body);
            }
            TermKind::Rule(RuleId(rule)) => self.write(format_args!("R{rule}")),
            TermKind::Coerce(operand) => {
                self.text.push('n');
                self.write_term(operand);
            }
            TermKind::Unbound(_) => self.text.push('u'),
            TermKind::Error => self.text.push('e'),
        }
    }

    /// An absent part differs from a present one.
    fn write_optional(&mut self, term: Option<&Term>) {
        self.text.push(if term.is_some() { '+' } else { '-' });
        self.write_terms(term);
    }

    fn write_binders(&mut self, binders: &[Binder]) {
        for binder in binders {
            self.write_term(&binder.range);
            self.bind(binder.variable);
            self.text.push('b');
        }
    }

    fn bind(&mut self, variable: VariableId) {
        let number = self.bound.len() as u32;
        self.bound.insert(variable, number);
    }

    fn write_variable(&mut self, variable: VariableId) {
        if let Some(number) = self.bound.get(&variable) {
            let number = *number;
            return self.write(format_args!("b{number}"));
        }
        let binding = match self.environment.bindings.get(&variable) {
            Some(Binding::Slot(slot)) => {
                let number = self.number(*slot);
                self.write(format_args!("v{}", number.0));
                Binding::Slot(number)
            }
            Some(Binding::ByName { argument, slots }) => {
                let numbers: Vec<Slot> = slots.iter().map(|slot| self.number(*slot)).collect();
                self.write(format_args!("a{argument}"));
                numbers.iter().for_each(|number| self.write(format_args!(":{}", number.0)));
                Binding::ByName { argument: *argument, slots: numbers }
            }
            None => return self.text.push('e'),
        };
        self.free.insert(variable, binding);
    }

    /// The number of a slot among those the argument needs.
    fn number(&mut self, slot: Slot) -> Slot {
        let known = self.slots.iter().position(|other| *other == slot);
        Slot(known.unwrap_or_else(|| {
            self.slots.push(slot);
            self.slots.len() - 1
        }) as u32)
    }
}
