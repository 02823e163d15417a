//! Writes a property of the abstract machine as the concrete model would write it, by what the coupling says of its functions.
//!
//! In: a coupling, a property. Out: its text over the concrete machine's functions, or a clause that says what has no counterpart. A
//! function is known if it is the same in both machines, or if a part of the coupling says `abstract.f = TERM` of concrete functions; a
//! term is known if a part says that it is equal to one of concrete functions.
//! INVARIANT: in corresponding states the text has the value that the property has; where that is not certain (a domain with other
//! elements, an argument that the coupling does not compare, an order of elements), nothing is written.

use std::collections::BTreeMap;

use machine::Limits;
use program::{
    Builtin, CollectionKind, DomainId, DomainKind, Effect, FunctionId, FunctionKind, Literal, Program, Property,
    PropertyKind, Quantifier, ShowsOrder, Slot, TemporalOperator, Term, TermId, TermList,
};

use crate::coupling::Coupling;
use crate::determined::{Determined, Equation, Known};
use crate::joint::{described, listed};
use crate::{ABSTRACT, CONCRETE};

/// LIMIT: so many terms are written for one property.
const TERMS: u32 = 1 << 12;
/// LIMIT: terms nest so deeply in one another.
const DEPTH: u32 = 100;

/// How tightly the outermost operator of a text binds; as in the grammar, operands of two logical operators are always enclosed.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
enum Binds {
    Junction,
    Relation,
    Sum,
    Product,
    Operand,
}

#[derive(Debug, Clone)]
struct Text(String, Binds);

impl Text {
    fn operand(text: impl Into<String>) -> Text {
        Text(text.into(), Binds::Operand)
    }

    /// Enclosed if it binds less tightly.
    fn within(self, least: Binds) -> String {
        if self.1 < least { format!("({})", self.0) } else { self.0 }
    }
}

type Written = Result<Text, String>;

/// What a variable stands for.
#[derive(Debug, Clone)]
struct Variable {
    text: String,
    /// The domain that it ranges over, as [`described`].
    domain: Option<String>,
}

type Scope = BTreeMap<Slot, Variable>;

/// Whose terms are written.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Of {
    Abstract,
    Joint,
}

/// See the module.
pub(crate) struct Translation<'c> {
    coupling: &'c Coupling,
    limits: Limits,
    known: Determined,
    /// Where the states are that correspond, if not everywhere.
    segment: Option<Result<String, String>>,
    /// By owner and domain, its name in the concrete model if it has the same elements there.
    domains: BTreeMap<(bool, DomainId), Option<String>>,
    left: u32,
    depth: u32,
}

impl<'c> Translation<'c> {
    /// With `segments` only states in which segments end correspond.
    pub fn new(coupling: &'c Coupling, segments: bool) -> Translation<'c> {
        let limits = Limits::default();
        let (known, domains) = (Determined::by(coupling, &limits), BTreeMap::new());
        let mut translation = Translation { coupling, limits, known, segment: None, domains, left: TERMS, depth: 0 };
        let segment = coupling.segment.as_ref().filter(|_| segments);
        translation.segment = segment.map(|formula| {
            translation.left = TERMS;
            Ok(translation.term(Of::Joint, formula.body, &Scope::new())?.within(Binds::Relation))
        });
        translation
    }

    /// What a property says of the concrete machine.
    pub fn of(&mut self, property: &Property) -> Result<String, String> {
        (self.left, self.depth) = (TERMS, 0);
        let Text(text, binds) = self.term(Of::Abstract, property.formula.body, &Scope::new())?;
        match (&self.segment, property.kind) {
            (Some(segment), PropertyKind::Invariant) => {
                Ok(format!("{} implies {}", segment.clone()?, Text(text, binds).within(Binds::Relation)))
            }
            _ => Ok(text),
        }
    }

    fn program(&self, of: Of) -> &'c Program {
        match of {
            Of::Abstract => &self.coupling.programs[ABSTRACT],
            Of::Joint => &self.coupling.joint.program,
        }
    }

    /// What a term of the abstract machine is equal to by an equation as a whole.
    fn by_equation(&mut self, id: TermId, scope: &Scope) -> Option<Written> {
        for equation in self.known.equations.clone() {
            let mut bound = BTreeMap::new();
            if self.matches(&equation, equation.term, id, scope, &mut bound)
                && equation.variables.iter().all(|slot| bound.contains_key(slot))
            {
                return Some(self.term(Of::Joint, equation.equal, &bound));
            }
        }
        None
    }

    /// Whether a term of the abstract machine is one of the joint model, with these values for the variables of an equation.
    fn matches(&self, equation: &Equation, joint: TermId, own: TermId, scope: &Scope, bound: &mut Scope) -> bool {
        let (coupling, program) = (self.coupling, self.program(Of::Abstract));
        let model = &coupling.joint.program;
        let all = |one: &TermList, other: &TermList| {
            let (one, other) = (model.term_list(*one), program.term_list(*other));
            (one.len() == other.len()).then(|| one.iter().copied().zip(other.iter().copied()).collect::<Vec<_>>())
        };
        match (model.term(joint), program.term(own)) {
            (Term::Constant(one), Term::Constant(other)) => {
                let [one, other] = [(model, one), (program, other)].map(|(program, index)| {
                    let literal = &program.constants[*index as usize];
                    match literal {
                        Literal::Enum(domain, place) => match &program.domain(*domain).kind {
                            DomainKind::Enum { literals } => Err(literals[*place as usize].clone()),
                            _ => Ok(literal.clone()),
                        },
                        _ => Ok(literal.clone()),
                    }
                });
                one == other
            }
            (Term::Builtin { builtin: one, arguments }, Term::Builtin { builtin: other, arguments: own }) => {
                let same = one == other && is_plain(*one);
                let Some(pairs) = all(arguments, own).filter(|_| same) else { return false };
                pairs.into_iter().all(|(joint, own)| self.matches(equation, joint, own, scope, bound))
            }
            (
                Term::Read { function, arguments },
                Term::Read { function: own, arguments: given } | Term::Define { function: own, arguments: given },
            ) => {
                let declared = program.function(*own);
                let Some((ABSTRACT, there)) = coupling.joint.of.get(function) else {
                    return declared.element.is_some() && declared.name == model.function(*function).name;
                };
                let Some(pairs) = all(arguments, given).filter(|_| there == own) else { return false };
                pairs.into_iter().zip(&declared.parameters).all(|((joint, own), domain)| match model.term(joint) {
                    Term::Slot(slot) if equation.variables.contains(slot) => {
                        // A variable stands for one argument, which lies in the domain.
                        let text = match program.term(own) {
                            Term::Slot(slot) => scope.get(slot).cloned(),
                            _ => None,
                        };
                        let inside = self.inside(Of::Abstract, &[own], &[*domain], scope, "").is_ok();
                        let Some(variable) = text.filter(|_| inside) else { return false };
                        bound.entry(*slot).or_insert_with(|| variable.clone()).text == variable.text
                    }
                    _ => self.matches(equation, joint, own, scope, bound),
                })
            }
            _ => false,
        }
    }

    fn term(&mut self, of: Of, id: TermId, scope: &Scope) -> Written {
        self.left = self.left.checked_sub(1).ok_or("its translation is too long")?;
        if self.depth >= DEPTH {
            return Err("it nests too deeply".to_string());
        }
        self.depth += 1;
        let written = self.term_here(of, id, scope);
        self.depth -= 1;
        written
    }

    fn term_here(&mut self, of: Of, id: TermId, scope: &Scope) -> Written {
        if of == Of::Abstract
            && let Some(written) = self.by_equation(id, scope)
        {
            return written;
        }
        let program = self.program(of);
        match program.term(id) {
            Term::Constant(index) => self.literal(program, &program.constants[*index as usize]),
            Term::Slot(slot) => match scope.get(slot) {
                Some(variable) => Ok(Text::operand(&variable.text)),
                None => Err("a variable in it has no value".to_string()),
            },
            Term::Read { function, arguments } | Term::Define { function, arguments } => {
                self.function(of, *function, *arguments, scope)
            }
            Term::Builtin { builtin: Builtin::Temporal(operator), arguments } => {
                self.temporal(*operator, program.term_list(*arguments), scope)
            }
            Term::Builtin { builtin, arguments } => self.builtin(of, *builtin, program.term_list(*arguments), scope),
            Term::Domain(domain) => Ok(Text::operand(self.domain(of, *domain)?)),
            Term::Tuple(components) => {
                Ok(Text::operand(format!("({})", self.list(of, program.term_list(*components), scope)?)))
            }
            Term::Collection { kind: kind @ (CollectionKind::Set | CollectionKind::Seq), elements }
                if elements.len > 0 =>
            {
                let inside = self.list(of, program.term_list(*elements), scope)?;
                Ok(Text::operand(if *kind == CollectionKind::Set {
                    format!("{{{inside}}}")
                } else {
                    format!("[{inside}]")
                }))
            }
            Term::Range { kind: CollectionKind::Set, low, high, step: None } => {
                let [low, high] = [*low, *high].map(|end| self.term(of, end, scope));
                Ok(Text::operand(format!("{{{} : {}}}", low?.0, high?.0)))
            }
            Term::Quantified { quantifier, binders, condition } => {
                let mut inside = scope.clone();
                let mut ranges = Vec::new();
                for binder in program.binder_list(*binders) {
                    let range = self.term(of, binder.range, &inside)?.within(Binds::Sum);
                    let domain = match program.term(binder.range) {
                        Term::Domain(domain) => Some(described(program, &self.limits, *domain)),
                        _ => None,
                    };
                    let text = fresh(&inside);
                    ranges.push(format!("{text} in {range}"));
                    inside.insert(binder.slot, Variable { text, domain });
                }
                let word = match quantifier {
                    Quantifier::Forall => "forall",
                    Quantifier::Exists => "exists",
                    Quantifier::ExistsUnique => "exists unique",
                };
                let condition = match condition {
                    Some(condition) => format!(" with {}", self.term(of, *condition, &inside)?.0),
                    None => String::new(),
                };
                Ok(Text::operand(format!("({word} {}{condition})", ranges.join(", "))))
            }
            Term::If { branches, otherwise } => {
                let mut text = String::new();
                for (index, pair) in program.term_list(*branches).chunks_exact(2).enumerate() {
                    let [guard, then] = [pair[0], pair[1]].map(|part| self.term(of, part, scope));
                    let word = if index == 0 { "if" } else { " elseif" };
                    text.push_str(&format!("{word} {} then {}", guard?.0, then?.0));
                }
                if let Some(otherwise) = otherwise {
                    text.push_str(&format!(" else {}", self.term(of, *otherwise, scope)?.0));
                }
                Ok(Text::operand(text + " endif"))
            }
            Term::Let { slot, value, body } => {
                let value = self.term(of, *value, scope)?.0;
                let mut inside = scope.clone();
                let text = fresh(scope);
                inside.insert(*slot, Variable { text: text.clone(), domain: None });
                let body = self.term(of, *body, &inside)?.0;
                Ok(Text::operand(format!("let ({text} = {value}) in {body} endlet")))
            }
            Term::Coerce(operand) => self.term(of, *operand, scope),
            _ => Err("a kind of term in it is not translated".to_string()),
        }
    }

    fn list(&mut self, of: Of, terms: &[TermId], scope: &Scope) -> Result<String, String> {
        let written: Result<Vec<String>, String> =
            terms.iter().map(|term| self.term(of, *term, scope).map(|text| text.0)).collect();
        Ok(written?.join(", "))
    }

    fn literal(&self, program: &Program, literal: &Literal) -> Written {
        let plain = |text: &str| text.chars().all(|c| c.is_ascii_graphic() && !"\"'\\".contains(c) || c == ' ');
        let text = match literal {
            Literal::Undef => "undef".to_string(),
            Literal::Boolean(truth) => truth.to_string(),
            Literal::Integer(number) if *number < 0 => format!("({number})"),
            Literal::Integer(number) => number.to_string(),
            Literal::Real(number) if !format!("{number:?}").contains(|c: char| c.is_alphabetic()) => {
                format!("({number:?})")
            }
            Literal::String(text) if plain(text) => format!("\"{text}\""),
            Literal::Enum(domain, index) => match &program.domain(*domain).kind {
                DomainKind::Enum { literals } => self.named(&literals[*index as usize])?,
                _ => return Err("a literal in it has no name".to_string()),
            },
            _ => return Err("a literal in it is not translated".to_string()),
        };
        Ok(Text::operand(text))
    }

    /// A literal of an enumeration, which the concrete model must have, too.
    fn named(&self, literal: &str) -> Result<String, String> {
        let has = |domain: &program::Domain| matches!(&domain.kind, DomainKind::Enum { literals } if literals.iter().any(|one| one == literal));
        match self.coupling.programs[CONCRETE].domains.iter().any(has) {
            true => Ok(literal.to_string()),
            false => Err(format!("the concrete model has no {literal}")),
        }
    }

    /// A domain, which must have the same elements in the concrete model.
    fn domain(&mut self, of: Of, id: DomainId) -> Result<String, String> {
        let (program, concrete) = (self.program(of), &*self.coupling.programs[CONCRETE]);
        let name = &program.domain(id).name;
        let known = self.domains.entry((of == Of::Joint, id)).or_insert_with(|| {
            let wanted = described(program, &self.limits, id);
            let fixed = |program: &Program, id: DomainId| match program.domain(id).kind {
                DomainKind::Basic(model::Basic::Boolean) | DomainKind::Enum { .. } => true,
                DomainKind::Abstract { dynamic, .. } => !dynamic,
                DomainKind::Concrete { dynamic, .. } => !dynamic && listed(program, &self.limits, id).is_some(),
                _ => false,
            };
            let mut all = (0..).map(DomainId).zip(&concrete.domains);
            let there = all.find(|(_, domain)| domain.name == *name)?.0;
            let same = fixed(program, id) && fixed(concrete, there);
            (same && described(concrete, &self.limits, there) == wanted).then(|| name.clone())
        });
        known.clone().ok_or_else(|| format!("the concrete model has no domain {name} with the same elements"))
    }

    fn function(&mut self, of: Of, id: FunctionId, arguments: TermList, scope: &Scope) -> Written {
        let coupling = self.coupling;
        let program = self.program(of);
        let declared = program.function(id);
        let arguments = program.term_list(arguments);
        if declared.element.is_some() {
            return self.element(program, id);
        }
        if of == Of::Joint {
            let Some((CONCRETE, there)) = coupling.joint.of.get(&id) else {
                return Err(format!("{} is none of the concrete machine's functions", declared.name));
            };
            return self.call(of, *there, arguments, scope);
        }
        let name = &declared.name;
        match self.known.functions.get(&id).cloned() {
            Some(Known::Same { function, everywhere }) => {
                if !everywhere {
                    self.inside(of, arguments, &declared.parameters, scope, name)?;
                }
                self.call(of, function, arguments, scope)
            }
            Some(Known::Term { parameters, body }) => {
                self.inside(of, arguments, &declared.parameters, scope, name)?;
                let scope = self.bound(of, &parameters, arguments, &declared.parameters, scope)?;
                self.term(Of::Joint, body, &scope)
            }
            None => match &declared.definition {
                Some(definition) => {
                    self.inside(of, arguments, &definition.parameters, scope, name)?;
                    let slots: Vec<Slot> = (0..definition.parameters.len() as u32).map(Slot).collect();
                    let scope = self.bound(of, &slots, arguments, &definition.parameters, scope)?;
                    self.term(of, definition.body, &scope)
                }
                None if declared.kind == FunctionKind::Monitored => {
                    Err(format!("it looks at the input {name}, which belongs to a step and to no state"))
                }
                None => Err(format!("it looks at abstract.{name}, which the coupling does not determine")),
            },
        }
    }

    /// An element with a name, which the concrete model must have in a domain of the same name.
    fn element(&self, program: &Program, id: FunctionId) -> Written {
        let concrete = &*self.coupling.programs[CONCRETE];
        let name = &program.function(id).name;
        let base = |program: &Program, id: FunctionId| {
            program.domain(program.base_domain(program.function(id).codomain)).name.clone()
        };
        let there = concrete.find_function(name, 0).filter(|there| concrete.function(*there).element.is_some());
        match there.filter(|there| base(concrete, *there) == base(program, id)) {
            Some(_) => Ok(Text::operand(name)),
            None => Err(format!("the concrete model has no element {name}")),
        }
    }

    fn call(&mut self, of: Of, function: FunctionId, arguments: &[TermId], scope: &Scope) -> Written {
        let concrete = &self.coupling.programs[CONCRETE];
        let declared = concrete.function(function);
        let name = declared.name.clone();
        let is_alike = |other: &&program::Function| {
            other.name == name && other.parameters.len() == declared.parameters.len() && !other.library
        };
        if concrete.functions.iter().filter(is_alike).count() > 1 {
            return Err(format!("the concrete model has several functions {name}"));
        }
        match arguments {
            [] => Ok(Text::operand(name)),
            _ => Ok(Text::operand(format!("{name}({})", self.list(of, arguments, scope)?))),
        }
    }

    /// Whether all arguments lie in the domains of the parameters, in every state.
    fn inside(
        &self,
        of: Of,
        arguments: &[TermId],
        parameters: &[DomainId],
        scope: &Scope,
        name: &str,
    ) -> Result<(), String> {
        let program = self.program(of);
        let fits = |argument: &TermId, domain: &DomainId| match program.term(*argument) {
            Term::Slot(slot) => {
                let ranges = scope.get(slot).and_then(|variable| variable.domain.clone());
                ranges.is_some_and(|ranges| ranges == described(program, &self.limits, *domain))
            }
            Term::Constant(index) => {
                let literal = &program.constants[*index as usize];
                match (literal, &program.domain(*domain).kind) {
                    (Literal::Undef, _) => false,
                    (Literal::Integer(number), DomainKind::Concrete { .. }) => {
                        listed(program, &self.limits, *domain).is_some_and(|all| all.contains(&number.to_string()))
                    }
                    (_, DomainKind::Concrete { .. }) => false,
                    _ => true,
                }
            }
            Term::Read { function, .. } => {
                let is_element = program.function(*function).element.is_some();
                is_element && program.function(*function).codomain == *domain
            }
            _ => false,
        };
        match arguments.iter().zip(parameters).all(|(argument, domain)| fits(argument, domain)) {
            true => Ok(()),
            false => Err(format!("it looks at abstract.{name} at arguments that are not known to be in its domain")),
        }
    }

    /// The scope of a body whose variables stand for these arguments.
    fn bound(
        &mut self,
        of: Of,
        slots: &[Slot],
        arguments: &[TermId],
        parameters: &[DomainId],
        scope: &Scope,
    ) -> Result<Scope, String> {
        let mut inside = Scope::new();
        for ((slot, argument), domain) in slots.iter().zip(arguments).zip(parameters) {
            let text = self.term(of, *argument, scope)?.within(Binds::Operand);
            let domain = Some(described(self.program(of), &self.limits, *domain));
            inside.insert(*slot, Variable { text, domain });
        }
        Ok(inside)
    }

    fn builtin(&mut self, of: Of, builtin: Builtin, arguments: &[TermId], scope: &Scope) -> Written {
        if !is_plain(builtin) {
            return Err(format!(
                "its value depends on more than the state, or on an order of elements: {}",
                builtin.name()
            ));
        }
        let written: Result<Vec<Text>, String> = arguments.iter().map(|term| self.term(of, *term, scope)).collect();
        let written = written?;
        let name = builtin.name();
        let (binds, operands) = match name {
            "and" | "or" | "xor" | "implies" | "iff" => (Binds::Junction, Binds::Relation),
            "=" | "!=" | "<" | "<=" | ">" | ">=" => (Binds::Relation, Binds::Sum),
            "+" | "-" => (Binds::Sum, Binds::Product),
            "*" | "/" | "mod" => (Binds::Product, Binds::Operand),
            _ => (Binds::Operand, Binds::Junction),
        };
        Ok(match <[Text; 2]>::try_from(written) {
            Ok([left, right]) if binds != Binds::Operand => {
                Text(format!("{} {name} {}", left.within(operands), right.within(operands)), binds)
            }
            Ok(both) => Text::operand(format!("{}({})", called(builtin), both.map(|text| text.0).join(", "))),
            Err(written) => match <[Text; 1]>::try_from(written) {
                Ok([one]) if builtin == Builtin::Not => {
                    Text(format!("not {}", one.within(Binds::Operand)), Binds::Relation)
                }
                Ok([one]) if binds == Binds::Sum => Text(format!("(-{})", one.within(Binds::Operand)), Binds::Operand),
                Ok([one]) => Text::operand(format!("{}({})", called(builtin), one.0)),
                Err(all) => {
                    let all: Vec<String> = all.into_iter().map(|text| text.0).collect();
                    Text::operand(format!("{}({})", called(builtin), all.join(", ")))
                }
            },
        })
    }

    /// A formula about runs; where only ends of segments correspond, about those.
    fn temporal(&mut self, operator: TemporalOperator, arguments: &[TermId], scope: &Scope) -> Written {
        use TemporalOperator::*;
        let written: Result<Vec<Text>, String> =
            arguments.iter().map(|term| self.term(Of::Abstract, *term, scope)).collect();
        let written = written?;
        let name = operator.name();
        let Some(segment) = self.segment.clone().transpose()? else {
            let all: Vec<String> = written.into_iter().map(|text| text.0).collect();
            return Ok(Text::operand(format!("{name}({})", all.join(", "))));
        };
        let always = |text: &Text| format!("{segment} implies {}", text.clone().within(Binds::Relation));
        let once = |text: &Text| format!("{segment} and {}", text.clone().within(Binds::Relation));
        let inside = match (operator, &written[..]) {
            (Ag | Eg | Globally | Historically, [p]) => always(p),
            (Af | Ef | Finally | Once, [p]) => once(p),
            (AbsenceGlobally, [p]) => once(p),
            (Au | Eu | Aw | Ew | Until | Since, [p, q]) => format!("{}, {}", always(p), once(q)),
            (Releases | Triggered, [p, q]) => format!("{}, {}", once(p), always(q)),
            _ => return Err(format!("{name} is not translated to the ends of segments")),
        };
        Ok(Text::operand(format!("{name}({inside})")))
    }
}

/// Whether the value depends on its operands alone, and on no order of elements.
fn is_plain(builtin: Builtin) -> bool {
    let info = builtin.info();
    let ordered = matches!(builtin, Builtin::Lt | Builtin::Le | Builtin::Gt | Builtin::Ge);
    info.effect == Effect::Pure && (ordered || info.shows_order == ShowsOrder::No) && builtin != Builtin::Print
}

/// The name of a library function where it is called.
fn called(builtin: Builtin) -> &'static str {
    builtin.info().declared.first().copied().unwrap_or(builtin.name())
}

/// A variable that no other in scope is called by.
fn fresh(scope: &Scope) -> String {
    let taken = |text: &String| scope.values().any(|variable| variable.text == *text);
    let mut names = ["$x", "$y", "$z"].into_iter().map(str::to_string).chain((1..).map(|number| format!("$x{number}")));
    names.find(|name| !taken(name)).unwrap_or_default()
}
