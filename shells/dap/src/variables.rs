//! What can be looked at in a stop: the functions by their kinds, the last updates, what is asked for.
//!
//! In: the session at a stop. Out: scopes and variables. A reference is good until the run goes on. LIMIT: so many variables of one
//! list; a derived function with arguments is shown
//! for the first elements of its domains.

use std::collections::BTreeMap;

use groundstate::machine::{Location, Show, Value as Term};
use groundstate::session::Waits;
use program::{DomainId, FunctionId, FunctionKind};
use serde_json::{Value, json};

use crate::target::Target;

/// LIMIT: variables of a list.
const MANY: usize = 10_000;

/// LIMIT: arguments that a derived function is shown for.
const TUPLES: usize = 100;

/// LIMIT: characters of a value.
const LETTERS: usize = 2_000;

/// What has variables.
#[derive(Debug, Clone)]
enum Handle {
    /// What is asked for.
    Asked,
    /// What the last step changed.
    Updates,
    /// The functions of a kind.
    Kind(FunctionKind),
    /// The locations of a function.
    Function(FunctionId),
    /// The elements of a value.
    Elements(Term),
}

/// See the module.
#[derive(Debug, Default)]
pub struct Variables {
    handles: Vec<Handle>,
    state: Option<BTreeMap<Location, Term>>,
}

/// The kinds that are shown, with their titles.
const KINDS: [(FunctionKind, &str); 6] = [
    (FunctionKind::Monitored, "Monitored"),
    (FunctionKind::Controlled, "Controlled"),
    (FunctionKind::Shared, "Shared"),
    (FunctionKind::Out, "Out"),
    (FunctionKind::Derived, "Derived"),
    (FunctionKind::Static, "Static"),
];

impl Variables {
    /// The run goes on: nothing that was told holds any more.
    pub fn forget(&mut self) {
        *self = Variables::default();
    }

    /// A value has changed.
    pub fn look_again(&mut self) {
        self.state = None;
    }

    fn reference(&mut self, handle: Handle) -> usize {
        self.handles.push(handle);
        self.handles.len()
    }

    /// The scopes of every frame: there is one state.
    pub fn scopes(&mut self, target: &Target) -> Vec<Value> {
        let mut scopes = Vec::new();
        if target.session.is_asking() {
            let reference = self.reference(Handle::Asked);
            scopes.push(json!({ "name": "Asked for", "variablesReference": reference, "expensive": false }));
        }
        let reference = self.reference(Handle::Updates);
        scopes.push(json!({ "name": "Last updates", "variablesReference": reference, "expensive": false }));
        for (kind, name) in KINDS {
            if functions(target, kind).next().is_some() {
                let reference = self.reference(Handle::Kind(kind));
                let expensive = kind == FunctionKind::Static;
                scopes.push(json!({ "name": name, "variablesReference": reference, "expensive": expensive }));
            }
        }
        scopes
    }

    /// The variables of a reference.
    ///
    /// # Errors
    /// A sentence: there is none.
    pub fn of(&mut self, target: &mut Target, reference: u64, answer: Option<&str>) -> Result<Vec<Value>, String> {
        let index = usize::try_from(reference).unwrap_or(usize::MAX).wrapping_sub(1);
        let handle = self.handles.get(index).cloned();
        let handle = handle.ok_or("there are no such variables any more: the run has gone on")?;
        Ok(match handle {
            Handle::Asked => asked(target, answer),
            Handle::Updates => updates(target),
            Handle::Kind(kind) => {
                let of: Vec<FunctionId> = functions(target, kind).take(MANY).collect();
                of.into_iter().map(|function| self.function(target, function, kind)).collect()
            }
            Handle::Function(function) => self.locations(target, function),
            Handle::Elements(value) => self.elements(target, &value),
        })
    }

    fn state(&mut self, target: &mut Target) -> &BTreeMap<Location, Term> {
        self.state.get_or_insert_with(|| {
            let mut state: BTreeMap<Location, Term> = target.session.state().into_iter().collect();
            // Inputs that are set hold from now on.
            state.extend(target.session.given().iter().map(|(location, value)| (location.clone(), value.clone())));
            state
        })
    }

    fn function(&mut self, target: &mut Target, id: FunctionId, kind: FunctionKind) -> Value {
        let program = target.scene.program.clone();
        let function = program.function(id);
        if function.parameters.is_empty() {
            let value = match kind {
                FunctionKind::Derived | FunctionKind::Static => target.session.evaluate(&function.name),
                _ => {
                    let location = Location { function: id, arguments: Vec::new() };
                    self.read(target, &location, kind)
                }
            };
            return self.variable(target, &function.name, value, kind);
        }
        let reference = self.reference(Handle::Function(id));
        let domains: Vec<&str> =
            function.parameters.iter().map(|domain| program.domain(*domain).name.as_str()).collect();
        json!({
            "name": function.name, "value": format!("({}) → {}", domains.join(", "), program.domain(function.codomain).name),
            "variablesReference": reference, "presentationHint": { "attributes": ["readOnly"] },
        })
    }

    fn locations(&mut self, target: &mut Target, id: FunctionId) -> Vec<Value> {
        let program = target.scene.program.clone();
        let function = program.function(id);
        let kind = function.kind;
        let computed = matches!(kind, FunctionKind::Derived | FunctionKind::Static);
        let mut shown: Vec<Location> = Vec::new();
        if !computed {
            shown = self.state(target).keys().filter(|location| location.function == id).take(MANY).cloned().collect();
        }
        // Inputs can be set before they are asked for.
        if computed || kind == FunctionKind::Monitored {
            let tuples = tuples(target, &function.parameters);
            let locations = tuples.into_iter().map(|arguments| Location { function: id, arguments });
            shown.extend(locations);
            shown.sort();
            shown.dedup();
        }
        let mut told = Vec::new();
        for location in shown {
            let name = location.show(&program).to_string();
            let value = match computed {
                true => target.session.evaluate(&name),
                false => self.read(target, &location, kind),
            };
            told.push(self.variable(target, &name, value, kind));
        }
        told
    }

    /// The value of a location; an input that nobody gave has none.
    fn read(&mut self, target: &mut Target, location: &Location, kind: FunctionKind) -> Result<Term, String> {
        match self.state(target).get(location) {
            Some(value) => Ok(value.clone()),
            None if kind == FunctionKind::Monitored => Err("?".to_string()),
            None => Ok(Term::Undef),
        }
    }

    fn variable(&mut self, target: &Target, name: &str, value: Result<Term, String>, kind: FunctionKind) -> Value {
        let is_input = matches!(kind, FunctionKind::Monitored | FunctionKind::Shared) && target.scene.script.is_none();
        let mut told = self.told(target, value);
        told["name"] = json!(name);
        told["evaluateName"] = json!(name);
        if !is_input {
            told["presentationHint"] = json!({ "attributes": ["readOnly"] });
        }
        told
    }

    /// A value, or why there is none, as the protocol writes it.
    pub fn told(&mut self, target: &Target, value: Result<Term, String>) -> Value {
        match value {
            Ok(value) => {
                let has_elements = match &value {
                    Term::Tuple(items) => !items.is_empty(),
                    Term::Seq(items) | Term::Set(items) => !items.is_empty(),
                    Term::Map(entries) => !entries.is_empty(),
                    _ => false,
                };
                let text = shortened(&value.show(&target.scene.program).to_string());
                let reference = if has_elements { self.reference(Handle::Elements(value)) } else { 0 };
                json!({ "value": text, "variablesReference": reference })
            }
            Err(reason) if reason == "?" => json!({ "value": "?", "variablesReference": 0 }),
            Err(reason) => json!({ "value": format!("({reason})"), "variablesReference": 0 }),
        }
    }

    fn elements(&mut self, target: &Target, value: &Term) -> Vec<Value> {
        let named: Vec<(String, Term)> = match value {
            Term::Tuple(items) => (1..)
                .zip(items.iter())
                .map(|(at, item): (usize, &Term)| (at.to_string(), item.clone()))
                .take(MANY)
                .collect(),
            Term::Seq(items) | Term::Set(items) => (0..)
                .zip(items.iter())
                .map(|(at, item): (usize, &Term)| (at.to_string(), item.clone()))
                .take(MANY)
                .collect(),
            Term::Map(entries) => entries
                .iter()
                .map(|(key, item)| (key.show(&target.scene.program).to_string(), item.clone()))
                .take(MANY)
                .collect(),
            _ => Vec::new(),
        };
        named
            .into_iter()
            .map(|(name, item)| {
                let mut told = self.told(target, Ok(item));
                told["name"] = json!(name);
                told["presentationHint"] = json!({ "attributes": ["readOnly"] });
                told
            })
            .collect()
    }
}

/// The first arguments that domains have elements for.
fn tuples(target: &mut Target, domains: &[DomainId]) -> Vec<Vec<Term>> {
    let mut tuples: Vec<Vec<Term>> = vec![Vec::new()];
    for domain in domains {
        let Ok(elements) = target.session.elements(*domain) else { return Vec::new() };
        let longer = |tuple: &Vec<Term>| {
            let with = |element: &Term| [tuple.as_slice(), std::slice::from_ref(element)].concat();
            elements.iter().take(TUPLES).map(with).collect::<Vec<_>>()
        };
        tuples = tuples.iter().flat_map(longer).take(TUPLES).collect();
    }
    tuples
}

/// The user's functions of a kind.
fn functions(target: &Target, kind: FunctionKind) -> impl Iterator<Item = FunctionId> + '_ {
    let program = &target.scene.program;
    let own = groundstate::own_files(&target.scene.sources);
    (0..).zip(&program.functions).filter_map(move |(index, function)| {
        let shown = function.kind == kind && !function.library && function.element.is_none() && own(function.span.file);
        shown.then_some(FunctionId(index))
    })
}

fn asked(target: &Target, answer: Option<&str>) -> Vec<Value> {
    let program = &target.scene.program;
    match target.session.waits() {
        Waits::Input { location, values, .. } => {
            let name = location.show(program).to_string();
            let offered: Vec<String> = values.iter().map(|value| value.show(program).to_string()).collect();
            let kind = match offered.is_empty() {
                true => program.domain(program.function(location.function).codomain).name.clone(),
                false => offered.join(" | "),
            };
            vec![
                json!({ "name": name, "evaluateName": name, "value": answer.unwrap_or("?"), "type": kind, "variablesReference": 0 }),
            ]
        }
        Waits::Choice { candidates, .. } => {
            let offered: Vec<String> = candidates.iter().take(TUPLES).map(|values| candidate(target, values)).collect();
            vec![
                json!({ "name": "choice", "value": answer.unwrap_or("?"), "type": offered.join(" | "), "variablesReference": 0 }),
            ]
        }
        Waits::Runs | Waits::Step | Waits::End => Vec::new(),
    }
}

/// A candidate of a choice as it is shown and given.
pub fn candidate(target: &Target, values: &[Term]) -> String {
    let shown = values.iter().map(|value| value.show(&target.scene.program).to_string());
    shown.collect::<Vec<_>>().join(", ")
}

fn updates(target: &Target) -> Vec<Value> {
    let Some(moment) = target.session.moment() else { return Vec::new() };
    let program = &target.scene.program;
    let changes = moment.changes.iter().take(MANY);
    let told = changes.map(|change| {
        let (before, after) = (change.before.show(program).briefly(), change.after.show(program).briefly());
        let name = change.location.show(program).to_string();
        let value = shortened(&format!("{before} → {after}"));
        json!({
            "name": name, "evaluateName": name, "value": value, "variablesReference": 0,
            "presentationHint": { "attributes": ["readOnly"] },
        })
    });
    told.collect()
}

/// LIMIT: a long value is cut.
pub fn shortened(text: &str) -> String {
    match text.char_indices().nth(LETTERS) {
        Some((at, _)) => format!("{}…", &text[..at]),
        None => text.to_string(),
    }
}
