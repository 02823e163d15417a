//! The breakpoints that a debugger has set, and what of it stops the session.
//!
//! In: the lists of `setBreakpoints` and its like, each of which replaces the former one of its kind and file. Out: what is said of
//! each breakpoint, and [`Breaks`] for the session. LIMIT: so many of one list.

use std::collections::BTreeMap;
use std::sync::Arc;

use groundstate::session::{Break, Breaks, On};
use program::FunctionKind;
use serde_json::{Value, json};

use crate::target::Target;

/// LIMIT: breakpoints of a list; others are not verified.
const MANY: usize = 1_000;

/// What a breakpoint was set by.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Kind {
    /// A line.
    Line,
    /// The name of a rule.
    Rule,
    /// A location.
    Data,
}

/// See the module.
#[derive(Debug, Default)]
pub struct Breakpoints {
    last: u64,
    lines: BTreeMap<String, Vec<Break>>,
    rules: Vec<Break>,
    data: Vec<Break>,
    faults: bool,
    violations: bool,
}

/// The filters of exceptions, as they are offered.
pub fn filters() -> Value {
    json!([
        { "filter": "faults", "label": "Faults and failed checks", "default": true,
          "description": "Stops where a step cannot be made, or a scenario fails." },
        { "filter": "violations", "label": "Violated invariants", "default": true,
          "description": "Stops after the step that violates an invariant." },
    ])
}

impl Breakpoints {
    /// Nothing but faults and violations stops the run.
    pub fn new() -> Breakpoints {
        Breakpoints { faults: true, violations: true, ..Breakpoints::default() }
    }

    /// What a breakpoint was set by.
    pub fn kind(&self, id: u64) -> Option<Kind> {
        let has = |list: &[Break]| list.iter().any(|one| one.id == id);
        match () {
            () if self.lines.values().any(|list| has(list)) => Some(Kind::Line),
            () if has(&self.rules) => Some(Kind::Rule),
            () if has(&self.data) => Some(Kind::Data),
            () => None,
        }
    }

    /// Where a line's breakpoint is: what stops there.
    pub fn on(&self, id: u64) -> Option<&On> {
        let all = self.lines.values().flatten().chain(&self.rules).chain(&self.data);
        all.into_iter().find(|one| one.id == id).map(|one| &one.on)
    }

    /// Sets the breakpoints of a file.
    pub fn set_lines(&mut self, target: &mut Target, path: &str, wanted: &[Value]) -> Vec<Value> {
        let mut kept = Vec::new();
        let told = wanted.iter().enumerate().map(|(index, one)| {
            let stop = one["line"].as_u64().and_then(|line| target.stop_at(path, u32::try_from(line).ok()?));
            let Some(stop) = stop.filter(|_| index < MANY) else {
                return self.unverified("nothing that can stop a run is here or below: an update, a rule, a command");
            };
            match self.made(target, stop.on, &one["condition"]) {
                Ok(made) => {
                    let told = json!({ "id": made.id, "verified": true, "line": stop.line });
                    kept.push(made);
                    told
                }
                Err(reason) => self.unverified(&reason),
            }
        });
        let told = told.collect();
        self.lines.insert(path.to_string(), kept);
        self.tell(target);
        told
    }

    /// Sets the breakpoints of rules.
    pub fn set_rules(&mut self, target: &mut Target, wanted: &[Value]) -> Vec<Value> {
        let mut kept = Vec::new();
        let told = wanted.iter().take(MANY).map(|one| {
            let name = one["name"].as_str().unwrap_or_default().trim();
            let Some((on, span)) = target.rule(name) else {
                return self.unverified(&format!("there is no rule `{name}`"));
            };
            match self.made(target, on, &one["condition"]) {
                Ok(made) => {
                    let mut told = target.place(span);
                    (told["id"], told["verified"]) = (json!(made.id), json!(true));
                    kept.push(made);
                    told
                }
                Err(reason) => self.unverified(&reason),
            }
        });
        let told = told.collect();
        self.rules = kept;
        self.tell(target);
        told
    }

    /// Sets the breakpoints of locations.
    pub fn set_data(&mut self, target: &mut Target, wanted: &[Value]) -> Vec<Value> {
        let mut kept = Vec::new();
        let told = wanted.iter().take(MANY).map(|one| {
            let data = one["dataId"].as_str().unwrap_or_default();
            let made = location(target, data).and_then(|on| self.made(target, on, &one["condition"]));
            match made {
                Ok(made) => {
                    let told = json!({ "id": made.id, "verified": true });
                    kept.push(made);
                    told
                }
                Err(reason) => self.unverified(&reason),
            }
        });
        let told = told.collect();
        self.data = kept;
        self.tell(target);
        told
    }

    /// Sets which faults stop the run; false if one of the filters is not known.
    pub fn set_filters(&mut self, target: &mut Target, filters: &[Value]) -> bool {
        let has = |name: &str| filters.iter().any(|filter| filter == name || filter["filterId"] == name);
        (self.faults, self.violations) = (has("faults"), has("violations"));
        self.tell(target);
        let known = |filter: &Value| {
            let name = filter.as_str().or(filter["filterId"].as_str()).unwrap_or_default();
            matches!(name, "faults" | "violations")
        };
        filters.iter().all(known)
    }

    fn unverified(&mut self, reason: &str) -> Value {
        self.last += 1;
        json!({ "id": self.last, "verified": false, "message": reason })
    }

    fn made(&mut self, target: &mut Target, on: On, condition: &Value) -> Result<Break, String> {
        let condition = match condition.as_str().map(str::trim).filter(|text| !text.is_empty()) {
            Some(text) => Some(target.session.conditions().condition(text)?),
            None => None,
        };
        self.last += 1;
        Ok(Break { id: self.last, on, condition })
    }

    /// Tells the session what stops it.
    pub fn tell(&self, target: &mut Target) {
        let list = self.lines.values().flatten().chain(&self.rules).chain(&self.data).cloned().collect();
        let program = Some(Arc::clone(target.session.conditions().program()));
        let (faults, violations) = (self.faults, self.violations);
        target.session.set_breaks(Breaks { list, program, faults, violations });
    }
}

/// A location that the machine writes, or all of a function.
pub fn location(target: &Target, text: &str) -> Result<On, String> {
    let program = &target.scene.program;
    let named = |(_, function): &(u32, &program::Function)| function.name == text && !function.library;
    let kinds =
        |kind: FunctionKind| !matches!(kind, FunctionKind::Static | FunctionKind::Derived | FunctionKind::Monitored);
    let function = (0..).zip(&program.functions).filter(named).find(|(_, function)| kinds(function.kind));
    if let Some((index, _)) = function {
        return Ok(On::Function(program::FunctionId(index)));
    }
    let location = groundstate::simulate::read_location(program, text)?;
    if !kinds(program.function(location.function).kind) {
        return Err(format!("`{text}` is an input: no rule writes it"));
    }
    Ok(On::Location(location))
}
