//! Plans the C++ form of each domain, function and procedure: names, types, storage of locations.
//!
//! In: a program, and a machine that has made its initial state and so knows the contents of static domains. Out: a
//! [`Plan`], the same for every run. It decides nothing about rules and terms.

use std::cell::Cell;
use std::collections::{BTreeMap, BTreeSet};

use model::Basic;
use program::{DomainId, DomainKind, FunctionId, FunctionKind, ProcedureId, Program};

use crate::names::{Scope, identifier, namespace, snake};

use crate::model::interval::Interval;
use crate::model::types::{Type, result_type, type_of};

/// LIMIT: functions with more locations than this have no array.
const DENSE_LIMIT: u64 = 1 << 18;
/// How many elements of a growing domain an array covers beyond the initial ones.
const WINDOW: u64 = 64;

/// The role of a function at run time.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Role {
    /// Part of the library, or never used: nothing is generated.
    None,
    /// A named element of an abstract domain.
    Element(u32),
    /// Controlled and out functions.
    State,
    /// Local functions.
    Local,
    /// Monitored functions.
    Input,
    /// Shared functions.
    Shared,
    /// Static and derived functions.
    Definition,
    /// `self`, which no rule updates.
    Agent,
}

/// One dimension of a function's array.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(crate) struct Dimension {
    /// Template arguments of the class: `Below<Colour, 3>`.
    pub text: String,
    /// How many values it covers; 0 if none.
    pub size: u64,
    /// Whether it covers every value of the parameter.
    pub whole: bool,
    /// The integers that it covers.
    pub bounds: Option<Interval>,
}

/// The plan of a function.
#[derive(Debug, Clone)]
pub(crate) struct FunctionPlan {
    pub role: Role,
    pub ty: Type,
    /// The name of its accessor or definition.
    pub name: String,
    /// The member that holds its locations.
    pub member: String,
    pub dimensions: Vec<Dimension>,
    /// The index of its initial value in the program.
    pub initial: Option<usize>,
}

/// The plan of a domain.
#[derive(Debug, Clone)]
pub(crate) struct DomainPlan {
    /// See [`DomainPlan::name`].
    name: String,
    /// Whether the code names the type, so that it must be declared.
    named: Cell<bool>,
    /// Identifiers of an enum's literals.
    pub literals: Vec<String>,
    /// The contents of a concrete domain that never grows.
    pub contents: Option<Vec<machine::Value>>,
    /// The initial elements of a growing subset, as numbers in its base.
    pub initial: Vec<u32>,
    /// The member that holds a growing domain.
    pub carrier: Option<String>,
}

/// The plan of a model.
#[derive(Debug, Clone)]
pub(crate) struct Plan {
    /// The namespace and the stem of the files' names.
    pub namespace: String,
    pub domains: Vec<DomainPlan>,
    pub functions: Vec<FunctionPlan>,
    /// The name of each procedure.
    pub procedures: Vec<String>,
    /// Names that variables must not have.
    pub members: Scope,
}

/// Makes the plan.
pub(crate) fn plan(program: &Program, started: &mut machine::Machine) -> Plan {
    let mut types = Scope::default();
    let mut members = Scope::default();
    for kept in [
        "Machine",
        "Environment",
        "Next",
        "Start",
        "at_start",
        "in_initial_state",
        "swap_start",
        "started",
        "started_",
        "next",
        "ReplayEnvironment",
        "Value",
        "Maybe",
        "start",
        "step",
        "environment",
        "each_location",
        "commit",
    ] {
        types.keep(kept);
        members.keep(kept);
    }
    let domains: Vec<DomainPlan> = (0..program.domains.len())
        .map(|index| plan_domain(program, DomainId(index as u32), started, &mut types, &mut members))
        .collect();
    let initials: BTreeMap<FunctionId, usize> =
        program.initials.iter().enumerate().map(|(index, initial)| (initial.function, index)).collect();
    let used = used_functions(program);
    let functions = (0..program.functions.len())
        .map(|index| {
            let id = FunctionId(index as u32);
            let function = program.function(id);
            let role = role(program, id, used.contains(&id));
            let (name, member) = match role {
                Role::None => (String::new(), String::new()),
                _ => {
                    let name = members.take(&function.name);
                    let member = format!("{name}_");
                    members.keep(&member);
                    (name, member)
                }
            };
            let initial = initials.get(&id).copied();
            let ty = match role {
                Role::State | Role::Local | Role::Definition => result_type(program, function.codomain),
                _ => type_of(program, function.codomain),
            };
            let ty = if ty == Type::Undef { Type::Value } else { ty };
            let dimensions = dimensions(program, &domains, id, initial.is_some());
            FunctionPlan { role, ty, name, member, dimensions, initial }
        })
        .collect();
    let procedures = program.procedures.iter().map(|procedure| members.take(&procedure.name)).collect();
    // The class can see these types, so its members must not have their names.
    for domain in &domains {
        members.keep(&domain.name);
    }
    Plan { namespace: namespace(&program.name), domains, functions, procedures, members }
}

fn role(program: &Program, id: FunctionId, used: bool) -> Role {
    let function = program.function(id);
    if Some(id) == program.self_function {
        return Role::Agent;
    }
    if let Some(element) = function.element {
        return Role::Element(element);
    }
    match function.kind {
        FunctionKind::Static | FunctionKind::Derived if function.definition.is_some() && used => Role::Definition,
        FunctionKind::Static | FunctionKind::Derived => Role::None,
        _ if function.library && !used => Role::None,
        FunctionKind::Monitored => Role::Input,
        FunctionKind::Shared => Role::Shared,
        FunctionKind::Local => Role::Local,
        FunctionKind::Controlled | FunctionKind::Out => Role::State,
    }
}

/// The functions that the main rule, the agents' programs, rule values and initial values reach.
fn used_functions(program: &Program) -> BTreeSet<FunctionId> {
    let mut used = BTreeSet::new();
    for term in &program.terms {
        if let program::Term::Read { function, .. } | program::Term::Define { function, .. } = term {
            used.insert(*function);
        }
    }
    for rule in &program.rules {
        if let program::Rule::Update { function, .. } | program::Rule::Return { function, .. } = rule {
            used.insert(*function);
        }
    }
    used.extend(program.initials.iter().map(|initial| initial.function));
    used
}

fn plan_domain(
    program: &Program,
    id: DomainId,
    started: &mut machine::Machine,
    types: &mut Scope,
    members: &mut Scope,
) -> DomainPlan {
    let domain = program.domain(id);
    let mut plan = DomainPlan {
        name: String::new(),
        named: Cell::new(false),
        literals: Vec::new(),
        contents: None,
        initial: Vec::new(),
        carrier: None,
    };
    match &domain.kind {
        DomainKind::Enum { literals } => {
            plan.name = types.take(&domain.name);
            let mut scope = Scope::default();
            plan.literals = literals.iter().map(|literal| scope.take(literal)).collect();
        }
        DomainKind::Abstract { dynamic, .. } => {
            plan.name = types.take(&domain.name);
            plan.carrier = dynamic.then(|| member(members, &domain.name));
        }
        DomainKind::Concrete { base, dynamic, .. } => {
            plan.name = identifier(&domain.name);
            let grows = *dynamic && matches!(program.domain(*base).kind, DomainKind::Abstract { .. });
            let elements = started.elements(id).ok();
            if grows {
                plan.carrier = Some(member(members, &domain.name));
                plan.initial = elements
                    .unwrap_or_default()
                    .iter()
                    .filter_map(|element| match element {
                        machine::Value::Element(_, number) => Some(*number),
                        _ => None,
                    })
                    .collect();
            } else {
                plan.contents = elements;
            }
        }
        _ => {}
    }
    plan
}

fn member(members: &mut Scope, name: &str) -> String {
    let stem = members.take(&format!("{}_elements", snake(name)));
    let member = format!("{stem}_");
    members.keep(&member);
    member
}

fn dimensions(program: &Program, domains: &[DomainPlan], id: FunctionId, initial: bool) -> Vec<Dimension> {
    let parameters = &program.function(id).parameters;
    let few = parameters.len() == 1;
    let dimensions: Vec<Dimension> =
        parameters.iter().map(|domain| dimension(program, domains, *domain, initial, few)).collect();
    let size = dimensions
        .iter()
        .fold(1u64, |size, dimension| size.saturating_mul(dimension.size.max(u64::from(dimension.whole))));
    if (1..=DENSE_LIMIT).contains(&size) {
        return dimensions;
    }
    parameters.iter().map(|domain| anywhere(program, domains, *domain)).collect()
}

fn anywhere(program: &Program, domains: &[DomainPlan], domain: DomainId) -> Dimension {
    let ty = cpp_type(domains, type_of(program, domain));
    Dimension { text: format!("gs::Anywhere<{ty}>"), size: 0, whole: false, bounds: None }
}

fn dimension(program: &Program, domains: &[DomainPlan], domain: DomainId, initial: bool, few: bool) -> Dimension {
    let anywhere = || anywhere(program, domains, domain);
    let name = |domain: DomainId| &domains[domain.0 as usize].name;
    let below = |domain: DomainId, size: u64, whole: bool| match size {
        0 if !whole => anywhere(),
        _ => Dimension { text: format!("gs::Below<{}, {size}>", name(domain)), size, whole, bounds: None },
    };
    let between = |low: i64, high: i64| {
        let size = (i128::from(high) - i128::from(low) + 1).min(i128::from(u32::MAX)) as u64;
        let text = format!("gs::Between<{}, {}>", integer(low), integer(high));
        Dimension { text, size, whole: false, bounds: Some(Interval { low, high }) }
    };
    match &program.domain(domain).kind {
        DomainKind::Basic(Basic::Boolean) => {
            Dimension { text: "gs::Below<bool, 2>".into(), size: 2, whole: true, bounds: None }
        }
        DomainKind::Enum { literals } => below(domain, literals.len() as u64, true),
        DomainKind::Abstract { elements, dynamic: false } => below(domain, elements.len() as u64, true),
        DomainKind::Abstract { elements, .. } => {
            below(domain, elements.len() as u64 + if initial || !few { 0 } else { WINDOW }, false)
        }
        // Initial values were computed for the domain's elements at the start; an array needs them for all its places.
        DomainKind::Concrete { base, .. } => {
            match (&program.domain(*base).kind, &domains[domain.0 as usize].contents) {
                (DomainKind::Basic(Basic::Integer | Basic::Natural), Some(contents)) => {
                    match compact(contents, initial) {
                        Some((low, high)) => between(low, high),
                        None => anywhere(),
                    }
                }
                (DomainKind::Enum { .. } | DomainKind::Abstract { dynamic: false, .. }, contents)
                    if !initial || contents.as_ref().is_some_and(|contents| covers(program, *base, contents)) =>
                {
                    dimension(program, domains, *base, initial, few)
                }
                _ => anywhere(),
            }
        }
        DomainKind::Basic(Basic::Integer) if few && !initial => between(-4, 251),
        DomainKind::Basic(Basic::Natural) if few && !initial => between(0, 255),
        _ => anywhere(),
    }
}

/// Whether these are all elements of an enum domain, or of an abstract one that does not grow.
pub(crate) fn covers(program: &Program, domain: DomainId, contents: &[machine::Value]) -> bool {
    match &program.domain(domain).kind {
        DomainKind::Enum { literals: all } | DomainKind::Abstract { elements: all, dynamic: false } => {
            contents.len() == all.len()
        }
        _ => false,
    }
}

/// The interval of integers in ascending order, if they have no gaps.
pub(crate) fn gapless(contents: &[machine::Value]) -> Option<Interval> {
    let (low, high) = compact(contents, true)?;
    Some(Interval { low, high })
}

/// The least and the greatest of some integers, if they have no, or few, gaps.
fn compact(contents: &[machine::Value], gapless: bool) -> Option<(i64, i64)> {
    let number = |value: &machine::Value| if let machine::Value::Integer(n) = value { Some(*n) } else { None };
    let (low, high) = (number(contents.first()?)?, number(contents.last()?)?);
    let size = i128::from(high) - i128::from(low) + 1;
    let fits = if gapless { size == contents.len() as i128 } else { size <= 4 * contents.len() as i128 + 16 };
    fits.then_some((low, high))
}

/// An integer literal.
pub(crate) fn integer(number: i64) -> String {
    match number {
        i64::MIN => "(-9223372036854775807 - 1)".to_string(),
        number => number.to_string(),
    }
}

/// The type of a defined value.
fn cpp_type(domains: &[DomainPlan], ty: Type) -> String {
    match ty {
        Type::Boolean => "bool".into(),
        Type::Integer => "std::int64_t".into(),
        Type::Real => "double".into(),
        Type::Char => "char32_t".into(),
        Type::Enum(domain) | Type::Element(domain) => domains[domain.0 as usize].name.clone(),
        Type::List(domain) => format!("gs::List<{}>", domains[domain.0 as usize].name),
        Type::Value | Type::Undef => "gs::Value".into(),
    }
}

impl DomainPlan {
    /// The C++ type of an enum or abstract domain, for code that needs its declaration.
    pub fn name(&self) -> &str {
        self.named.set(true);
        &self.name
    }

    /// The same name, as the stem of other names.
    pub fn stem(&self) -> &str {
        &self.name
    }

    /// Whether code has named the type since [`Plan::begin`].
    pub fn is_named(&self) -> bool {
        self.named.get()
    }
}

impl Plan {
    /// Forgets which types were named, before code is generated again.
    pub fn begin(&self) {
        self.domains.iter().for_each(|domain| domain.named.set(false));
    }

    pub fn function(&self, id: FunctionId) -> &FunctionPlan {
        &self.functions[id.0 as usize]
    }

    pub fn domain(&self, id: DomainId) -> &DomainPlan {
        &self.domains[id.0 as usize]
    }

    pub fn procedure(&self, id: ProcedureId) -> &str {
        &self.procedures[id.0 as usize]
    }

    /// The C++ type of values of a type, defined or not.
    pub fn cpp(&self, ty: Type, defined: bool) -> String {
        if let Type::Enum(domain) | Type::Element(domain) | Type::List(domain) = ty {
            self.domain(domain).named.set(true);
        }
        let plain = cpp_type(&self.domains, ty);
        if defined || plain == "gs::Value" { plain } else { format!("gs::Maybe<{plain}>") }
    }
}
