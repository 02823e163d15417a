//! A model in which terms over two machines have a meaning: the domains of both, and each function of both as an input that the state of
//! its machine answers.
//!
//! In: two programs. Out: a [`Joint`] with the checked model, and a [`Bridge`] for each side, by which values go over. Enumerations that
//! share a literal are one, whose literals are those of all; so are domains with the same name. INVARIANT: equal names are equal values;
//! what only one side has is a value that the other side never has. A function whose domains cannot be written is left out, and a term
//! that names it is a fault. It must not know states.

use std::collections::{BTreeMap, BTreeSet};
use std::fmt::Write;

use machine::{Limits, Machine, Show, Value};
use model::{Checked, Loader, Model};
use program::{DomainId, DomainKind, FunctionId, FunctionKind, Program};
use rustc_hash::FxHashMap;
use syntax::{SourceFile, Sources};

use crate::{ABSTRACT, CONCRETE, SIDES};

/// LIMIT: so many elements of a domain are written one by one.
const ELEMENTS: usize = 1 << 12;

/// How a name of one side is written in the joint model. As long as `abstract.f`, so that places stay what they are.
pub(crate) fn joint_name(side: usize, name: &str) -> String {
    format!("{}_{name}", SIDES[side])
}

/// The model of both.
pub(crate) struct Joint {
    pub model: Model,
    pub program: Program,
    pub sources: Sources,
    pub bridges: [Bridge; 2],
    /// By function of the joint program: the side and the function there.
    pub of: FxHashMap<FunctionId, (usize, FunctionId)>,
    /// By side and function: the one of the joint program that has its domains. Where a side has several functions with one name and the same
    /// domains, which an export list can hide from each other, all have the one that stands for the last.
    pub with_domains_of: [FxHashMap<FunctionId, FunctionId>; 2],
    /// Domains of which a machine makes elements: the joint model does not have these.
    growing: BTreeSet<String>,
}

impl Joint {
    /// The domain, or a part of it, of which a machine makes elements.
    pub fn growing(&self, domain: DomainId) -> Option<&str> {
        let described = self.program.domain(domain);
        match &described.kind {
            DomainKind::Abstract { .. } | DomainKind::Concrete { .. } => {
                self.growing.get(&described.name).map(String::as_str)
            }
            DomainKind::Seq(part) | DomainKind::Powerset(part) | DomainKind::Bag(part) => self.growing(*part),
            DomainKind::Map(from, to) => self.growing(*from).or_else(|| self.growing(*to)),
            DomainKind::Prod(parts) => parts.iter().find_map(|part| self.growing(*part)),
            DomainKind::Basic(_)
            | DomainKind::Enum { .. }
            | DomainKind::Error
            | DomainKind::Any
            | DomainKind::Rule(_) => None,
        }
    }
}

/// The domains of a program that differ between states; of a domain that is made of others, these.
pub(crate) fn growing(program: &Program, domain: DomainId) -> Option<&str> {
    let constant = program.constant_domains();
    let mut open = vec![domain];
    while let Some(id) = open.pop() {
        if constant[id.0 as usize] {
            continue;
        }
        match &program.domain(id).kind {
            DomainKind::Seq(part) | DomainKind::Powerset(part) | DomainKind::Bag(part) => open.push(*part),
            DomainKind::Map(from, to) => open.extend([*from, *to]),
            DomainKind::Prod(parts) => open.extend(parts),
            _ => return Some(&program.domain(id).name),
        }
    }
    None
}

/// A domain as both sides have it.
#[derive(Default)]
struct Shape {
    /// The type domain of a concrete one.
    base: Option<String>,
    /// In order.
    elements: Vec<String>,
    kind: Option<&'static str>,
}

impl Shape {
    fn add(&mut self, element: String) {
        if !self.elements.contains(&element) {
            self.elements.push(element);
        }
    }
}

/// What is known of the domains of both sides.
#[derive(Default)]
struct Shapes {
    /// In order of declaration.
    names: Vec<String>,
    shapes: BTreeMap<String, Shape>,
    /// What a domain of a side is called.
    called: [BTreeMap<String, String>; 2],
    /// Elements with a name of their own, with the domain that declares them.
    statics: BTreeMap<String, String>,
}

/// Whether the standard library declares a domain, which every model has.
fn is_standard(name: &str) -> bool {
    matches!(name, "Agent" | "Reserve")
}

/// The elements of a domain as a model would write them; none if they are not fixed or too many.
fn written_elements(program: &Program, machine: &mut Machine, domain: DomainId) -> Option<Vec<String>> {
    let elements = machine.elements(domain).ok()?;
    (elements.len() <= ELEMENTS).then(|| elements.iter().map(|value| value.show(program).to_string()).collect())
}

impl Shapes {
    fn shape(&mut self, name: &str) -> &mut Shape {
        if !self.shapes.contains_key(name) {
            self.names.push(name.to_string());
        }
        self.shapes.entry(name.to_string()).or_default()
    }

    /// The enumeration that has one of these literals already.
    fn with_literal(&self, literals: &[String]) -> Option<String> {
        let has = |shape: &Shape| shape.kind == Some("enum") && literals.iter().any(|one| shape.elements.contains(one));
        self.names.iter().find(|name| has(&self.shapes[*name])).cloned()
    }

    fn add(&mut self, side: usize, program: &Program, limits: &Limits) {
        let mut machine = Machine::new(std::sync::Arc::new(program.clone()), limits.clone());
        for (index, domain) in program.domains.iter().enumerate() {
            let id = DomainId(index as u32);
            match &domain.kind {
                DomainKind::Enum { literals } => {
                    let name =
                        self.with_literal(literals).unwrap_or_else(|| self.free(side, &domain.name, "enum", None));
                    self.called[side].insert(domain.name.clone(), name.clone());
                    let shape = self.shape(&name);
                    shape.kind = Some("enum");
                    literals.iter().for_each(|literal| shape.add(literal.clone()));
                }
                DomainKind::Abstract { .. } => {
                    let name = self.free(side, &domain.name, "abstract", None);
                    self.called[side].insert(domain.name.clone(), name.clone());
                    if !is_standard(&name) {
                        self.shape(&name).kind = Some("abstract");
                    }
                }
                DomainKind::Concrete { base, dynamic: false, elements, contents } => {
                    let Some(base) = self.written(side, program, *base) else { continue };
                    let listed = match contents {
                        Some(_) => written_elements(program, &mut machine, id),
                        None if !elements.is_empty() => Some(Vec::new()),
                        None => None,
                    };
                    let Some(listed) = listed else { continue };
                    let name = self.free(side, &domain.name, "concrete", Some(&base));
                    self.called[side].insert(domain.name.clone(), name.clone());
                    let shape = self.shape(&name);
                    (shape.kind, shape.base) = (Some("concrete"), Some(base));
                    listed.into_iter().for_each(|element| shape.add(element));
                }
                _ => {}
            }
        }
        for function in program.functions.iter().filter(|function| function.element.is_some()) {
            if let Some(domain) = self.written(side, program, function.codomain) {
                self.statics.entry(function.name.clone()).or_insert(domain);
            }
        }
    }

    /// The name of a side's domain: its own, unless another kind of domain has it.
    fn free(&self, side: usize, name: &str, kind: &str, base: Option<&str>) -> String {
        let fits = |shape: &Shape| shape.kind == Some(kind) && shape.base.as_deref() == base;
        match self.shapes.get(name) {
            Some(shape) if !fits(shape) => format!("{}_{name}", ["Abstract", "Concrete"][side]),
            _ => name.to_string(),
        }
    }

    /// A domain as the joint model writes it; none if it cannot.
    fn written(&self, side: usize, program: &Program, domain: DomainId) -> Option<String> {
        let all = |domains: &[DomainId]| -> Option<String> {
            let written: Option<Vec<String>> = domains.iter().map(|one| self.written(side, program, *one)).collect();
            Some(written?.join(", "))
        };
        let described = program.domain(domain);
        match &described.kind {
            DomainKind::Basic(_) => Some(described.name.clone()),
            DomainKind::Enum { .. } | DomainKind::Abstract { .. } => self.called[side].get(&described.name).cloned(),
            // What has elements that are not fixed is written as the domain that they are of.
            DomainKind::Concrete { base, .. } => {
                let called = self.called[side].get(&described.name).cloned();
                called.or_else(|| self.written(side, program, *base))
            }
            DomainKind::Prod(parts) => Some(format!("Prod({})", all(parts)?)),
            DomainKind::Seq(of) => Some(format!("Seq({})", all(&[*of])?)),
            DomainKind::Powerset(of) => Some(format!("Powerset({})", all(&[*of])?)),
            DomainKind::Bag(of) => Some(format!("Bag({})", all(&[*of])?)),
            DomainKind::Map(key, value) => Some(format!("Map({})", all(&[*key, *value])?)),
            DomainKind::Error | DomainKind::Any | DomainKind::Rule(_) => None,
        }
    }

    /// The model; and by side and name in it, in the order of their declaration, the functions with each name. Those that are declared as one are
    /// listed from the last.
    fn text(&self, programs: [&Program; 2]) -> (String, BTreeMap<String, Vec<Vec<FunctionId>>>) {
        let mut text = String::from("asm Coupling\nimport StandardLibrary\nsignature:\n");
        let mut defined = String::new();
        for name in &self.names {
            let shape = &self.shapes[name];
            let _ = match (shape.kind, &shape.base) {
                (Some("enum"), _) => writeln!(text, "\tenum domain {name} = {{{}}}", shape.elements.join(" | ")),
                (Some("concrete"), Some(base)) => {
                    if !shape.elements.is_empty() {
                        let _ = writeln!(defined, "\tdomain {name} = {{{}}}", shape.elements.join(", "));
                    }
                    writeln!(text, "\tdomain {name} subsetof {base}")
                }
                _ => writeln!(text, "\tabstract domain {name}"),
            };
        }
        for (name, domain) in &self.statics {
            let _ = writeln!(text, "\tstatic {name}: {domain}");
        }
        let mut named: BTreeMap<String, Vec<Vec<FunctionId>>> = BTreeMap::new();
        for (side, program) in programs.into_iter().enumerate() {
            // By name and parameters, the place among those of that name.
            let mut declared = BTreeMap::new();
            // Of those with the same domains the last counts.
            for (index, function) in program.functions.iter().enumerate().rev().filter(|(_, one)| is_named(one)) {
                let id = FunctionId(index as u32);
                let parameters: Option<Vec<String>> =
                    function.parameters.iter().map(|domain| self.written(side, program, *domain)).collect();
                let codomain = self.written(side, program, function.codomain);
                let (Some(parameters), Some(codomain)) = (parameters, codomain) else { continue };
                let name = joint_name(side, &function.name);
                let of_name = named.entry(name.clone()).or_default();
                let place = *declared.entry((&function.name, parameters.clone())).or_insert(of_name.len());
                if place < of_name.len() {
                    of_name[place].push(id);
                    continue;
                }
                of_name.push(vec![id]);
                let _ = match &parameters[..] {
                    [] => writeln!(text, "\tmonitored {name}: {codomain}"),
                    [one] => writeln!(text, "\tmonitored {name}: {one} -> {codomain}"),
                    many => writeln!(text, "\tmonitored {name}: Prod({}) -> {codomain}", many.join(", ")),
                };
            }
        }
        text.push_str("definitions:\n");
        text.push_str(&defined);
        text.push_str("\tmain rule r_Main = skip\n");
        (text, named)
    }
}

/// Whether a coupling may name a function.
fn is_named(function: &program::Function) -> bool {
    !function.library && !function.name.starts_with('$') && function.kind != FunctionKind::Local
}

/// Takes values from one side to the joint model and back.
#[derive(Debug, Default)]
pub(crate) struct Bridge {
    over: FxHashMap<Value, Value>,
    back: FxHashMap<Value, Value>,
}

/// By name, the literals and the named elements of a program.
fn atoms(program: &Program) -> BTreeMap<String, Value> {
    let mut found = BTreeMap::new();
    for (index, domain) in program.domains.iter().enumerate() {
        if let DomainKind::Enum { literals } = &domain.kind {
            for (place, literal) in literals.iter().enumerate() {
                found.insert(literal.clone(), Value::Enum(DomainId(index as u32), place as u32));
            }
        }
    }
    for function in &program.functions {
        if let Some(number) = function.element {
            let base = program.base_domain(function.codomain);
            found.insert(function.name.clone(), Value::Element(base, number));
        }
    }
    found
}

impl Bridge {
    fn new(side: &Program, joint: &BTreeMap<String, Value>) -> Bridge {
        let mut bridge = Bridge::default();
        for (name, value) in atoms(side) {
            if let Some(there) = joint.get(&name) {
                bridge.over.insert(value.clone(), there.clone());
                bridge.back.insert(there.clone(), value);
            }
        }
        bridge
    }

    /// A value of the side in the joint model; none if it has no name there.
    pub fn over(&self, value: &Value) -> Option<Value> {
        through(&self.over, value)
    }

    /// A value of the joint model in the side; none if the side has no such value.
    pub fn back(&self, value: &Value) -> Option<Value> {
        through(&self.back, value)
    }
}

fn through(atoms: &FxHashMap<Value, Value>, value: &Value) -> Option<Value> {
    let all = |items: &[Value]| -> Option<Vec<Value>> { items.iter().map(|item| through(atoms, item)).collect() };
    Some(match value {
        Value::Enum(..) | Value::Element(..) => atoms.get(value)?.clone(),
        Value::Rule(_) => return None,
        Value::Tuple(items) => Value::tuple(all(items)?),
        Value::Seq(items) => Value::seq(all(items)?),
        Value::Set(items) => Value::set(all(items)?),
        Value::Bag(counts) => {
            let mut elements = Vec::new();
            for (element, count) in counts.iter() {
                let element = through(atoms, element)?;
                elements.extend((0..*count).map(|_| element.clone()));
            }
            Value::bag(elements)
        }
        Value::Map(entries) => {
            let entries: Option<Vec<(Value, Value)>> =
                entries.iter().map(|(key, value)| Some((through(atoms, key)?, through(atoms, value)?))).collect();
            Value::map(entries?)
        }
        Value::Undef
        | Value::Boolean(_)
        | Value::Integer(_)
        | Value::Real(_)
        | Value::Char(_)
        | Value::Complex(_)
        | Value::String(_) => value.clone(),
    })
}

/// Finds no file: the joint model imports the standard library alone.
struct NoFiles;

impl Loader for NoFiles {
    fn load(&mut self, _importer: &SourceFile, path: &str) -> Result<SourceFile, String> {
        Err(format!("there is no file {path}"))
    }
}

/// The joint model of two programs.
///
/// # Errors
/// What keeps them apart: a sentence for the user.
pub(crate) fn join(programs: [&Program; 2], limits: &Limits) -> Result<Joint, String> {
    let mut shapes = Shapes::default();
    shapes.add(ABSTRACT, programs[ABSTRACT], limits);
    shapes.add(CONCRETE, programs[CONCRETE], limits);
    let (text, named) = shapes.text(programs);
    let Checked { model, sources, diagnostics } = model::check(SourceFile::new("<coupling>", text), &mut NoFiles);
    let fault = |faults: &[syntax::Diagnostic]| {
        let first = faults.iter().find(|fault| fault.severity == syntax::Severity::Error);
        first.map(|fault| format!("the two models cannot be taken together: {}", fault.message))
    };
    if let Some(message) = fault(&diagnostics) {
        return Err(message);
    }
    let program = program::lower(&model).map_err(|faults| fault(&faults).unwrap_or_default())?;
    let joint = atoms(&program);
    let bridges = [ABSTRACT, CONCRETE].map(|side| Bridge::new(programs[side], &joint));
    let (mut of, mut with_domains_of) = (FxHashMap::default(), [FxHashMap::default(), FxHashMap::default()]);
    for (name, all) in &named {
        let side = usize::from(!name.starts_with(&joint_name(ABSTRACT, "")));
        let joint = (0..).map(FunctionId).zip(&program.functions).filter(|(_, function)| function.name == *name);
        for ((joint, _), functions) in joint.zip(all) {
            of.insert(joint, (side, functions[0]));
            with_domains_of[side].extend(functions.iter().map(|function| (*function, joint)));
        }
    }
    let mut growing = BTreeSet::new();
    for (side, program) in programs.into_iter().enumerate() {
        let constant = program.constant_domains();
        let differing = program.domains.iter().zip(constant).filter(|(_, constant)| !constant);
        growing.extend(differing.filter_map(|(domain, _)| shapes.called[side].get(&domain.name).cloned()));
    }
    Ok(Joint { model, program, sources, bridges, of, with_domains_of, growing })
}

/// The elements of a domain as a model writes them, if they are fixed and can all be written.
pub(crate) fn listed(program: &Program, limits: &Limits, domain: DomainId) -> Option<Vec<String>> {
    let mut machine = Machine::new(std::sync::Arc::new(program.clone()), limits.clone());
    written_elements(program, &mut machine, domain)
}

/// What a domain is, for comparing it with one of another program: equal texts are equal domains. Literals and elements are what their
/// names say, in whatever order.
pub(crate) fn described(program: &Program, limits: &Limits, domain: DomainId) -> String {
    let parts = |domains: &[DomainId]| {
        let parts: Vec<String> = domains.iter().map(|part| described(program, limits, *part)).collect();
        parts.join(",")
    };
    let kind = program.domain(domain);
    let sorted = |names: &[String]| {
        let names: BTreeSet<&str> = names.iter().map(String::as_str).collect();
        names.into_iter().collect::<Vec<_>>().join(" | ")
    };
    match &kind.kind {
        DomainKind::Enum { literals: names } | DomainKind::Abstract { elements: names, .. } => {
            format!("{} {{{}}}", kind.name, sorted(names))
        }
        DomainKind::Concrete { base, .. } => {
            let mut machine = Machine::new(std::sync::Arc::new(program.clone()), limits.clone());
            let elements = written_elements(program, &mut machine, domain).unwrap_or_default();
            format!("{} {{{}}} of {}", kind.name, sorted(&elements), described(program, limits, *base))
        }
        DomainKind::Prod(of) => format!("Prod({})", parts(of)),
        DomainKind::Seq(of) => format!("Seq({})", parts(&[*of])),
        DomainKind::Powerset(of) => format!("Powerset({})", parts(&[*of])),
        DomainKind::Bag(of) => format!("Bag({})", parts(&[*of])),
        DomainKind::Map(key, value) => format!("Map({})", parts(&[*key, *value])),
        DomainKind::Basic(_) | DomainKind::Error | DomainKind::Any | DomainKind::Rule(_) => kind.name.clone(),
    }
}
