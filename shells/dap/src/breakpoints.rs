//! The breakpoints that a debugger has set, and what of it stops the session.
//!
//! In: the lists of `setBreakpoints` and its like, each of which replaces the former one of its kind and file. Out: what is said of
//! each breakpoint, and [`Breaks`] for the session. A breakpoint that is set again as it was keeps its number, and so how often it was
//! reached. LIMIT: so many of one list.

use std::collections::BTreeMap;
use std::sync::Arc;

use groundstate::session::{Break, Breaks, Count, On, Piece};
use program::FunctionKind;
use serde_json::{Value, json};

use crate::message::{Part, parts};
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

/// A breakpoint as it was asked for, and what it came to.
#[derive(Debug)]
struct Made {
    asked: String,
    stop: Break,
    /// Where it is, if that is a place.
    place: Value,
}

/// See the module.
#[derive(Debug, Default)]
pub struct Breakpoints {
    last: u64,
    lines: BTreeMap<String, Vec<Made>>,
    rules: Vec<Made>,
    data: Vec<Made>,
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
        let has = |list: &[Made]| list.iter().any(|one| one.stop.id == id);
        match () {
            () if self.lines.values().any(|list| has(list)) => Some(Kind::Line),
            () if has(&self.rules) => Some(Kind::Rule),
            () if has(&self.data) => Some(Kind::Data),
            () => None,
        }
    }

    /// Where a line's breakpoint is: what stops there.
    pub fn on(&self, id: u64) -> Option<&On> {
        self.made_as(id).map(|one| &one.stop.on)
    }

    /// Where a breakpoint is, as the protocol writes places.
    pub fn place(&self, id: u64) -> Value {
        self.made_as(id).map_or(Value::Null, |one| one.place.clone())
    }

    fn made_as(&self, id: u64) -> Option<&Made> {
        let all = self.lines.values().flatten().chain(&self.rules).chain(&self.data);
        all.into_iter().find(|one| one.stop.id == id)
    }

    /// Sets the breakpoints of a file.
    pub fn set_lines(&mut self, target: &mut Target, path: &str, wanted: &[Value]) -> Vec<Value> {
        let mut former = self.lines.remove(path).unwrap_or_default();
        let mut kept = Vec::new();
        let told = wanted.iter().enumerate().map(|(index, one)| {
            let stop = one["line"].as_u64().and_then(|line| target.stop_at(path, u32::try_from(line).ok()?));
            let Some(stop) = stop.filter(|_| index < MANY) else {
                return self.unverified("nothing that can stop a run is here or below: an update, a rule, a command");
            };
            let place = json!({ "source": { "path": path }, "line": stop.line });
            match self.made(target, stop.on, one, place, &mut former) {
                Ok(made) => {
                    let told = json!({ "id": made.stop.id, "verified": true, "line": stop.line });
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
        let (mut former, mut kept) = (std::mem::take(&mut self.rules), Vec::new());
        let told = wanted.iter().take(MANY).map(|one| {
            let name = one["name"].as_str().unwrap_or_default().trim();
            let Some((on, span)) = target.rule(name) else {
                return self.unverified(&format!("there is no rule `{name}`"));
            };
            let place = target.place(span);
            match self.made(target, on, one, place.clone(), &mut former) {
                Ok(made) => {
                    let mut told = place;
                    (told["id"], told["verified"]) = (json!(made.stop.id), json!(true));
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
        let (mut former, mut kept) = (std::mem::take(&mut self.data), Vec::new());
        let told = wanted.iter().take(MANY).map(|one| {
            let data = one["dataId"].as_str().unwrap_or_default();
            let on = location(target, data);
            let made = on.and_then(|on| self.made(target, on, one, Value::Null, &mut former));
            match made {
                Ok(made) => {
                    let told = json!({ "id": made.stop.id, "verified": true });
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

    /// A breakpoint, with the number that it had if it was there before.
    fn made(
        &mut self,
        target: &mut Target,
        on: On,
        one: &Value,
        place: Value,
        former: &mut Vec<Made>,
    ) -> Result<Made, String> {
        let said = |key: &str| one[key].as_str().map(str::trim).filter(|text| !text.is_empty());
        let condition = said("condition").map(|text| target.session.conditions().condition(text)).transpose()?;
        let count = said("hitCondition").map(Count::read).transpose()?;
        let message = said("logMessage").map(|text| message(target, text)).transpose()?;
        let asked = ["name", "dataId", "condition", "hitCondition", "logMessage"].map(|key| &one[key]);
        let asked = format!("{:?} {asked:?}", place["line"]);
        let id = match former.iter().position(|other| other.asked == asked) {
            Some(index) => former.swap_remove(index).stop.id,
            None => {
                self.last += 1;
                self.last
            }
        };
        Ok(Made { asked, stop: Break { id, on, condition, count, message }, place })
    }

    /// Tells the session what stops it.
    pub fn tell(&self, target: &mut Target) {
        let all = self.lines.values().flatten().chain(&self.rules).chain(&self.data);
        let list = all.map(|one| one.stop.clone()).collect();
        let program = Some(Arc::clone(target.session.conditions().program()));
        let (faults, violations) = (self.faults, self.violations);
        target.session.set_breaks(Breaks { list, program, faults, violations });
    }
}

/// The parts of a log point's message, with its terms read.
fn message(target: &mut Target, text: &str) -> Result<Vec<Piece>, String> {
    let piece = |part: Part| match part {
        Part::Text(text) => Ok(Piece::Text(text)),
        Part::Term(term) => target.session.conditions().term(&term).map(Piece::Term),
    };
    parts(text)?.into_iter().map(piece).collect()
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
