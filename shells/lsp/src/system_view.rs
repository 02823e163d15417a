//! What the text says of a system's parts, with the place of each property, and the times that follow (docs/editors.md).
//!
//! In: the tree of a chart. Out: for `groundstate/chart/picture`, periods, phases and channels as they are written; for
//! `groundstate/chart/times`, the object of `groundstate chart times`; operations that set properties. Nothing is computed here: the
//! table is the analysis' own.

use std::collections::BTreeMap;

use chart::times::{Platform, times as analysed, told as warnings};
use ide::{Operation, Property};
use serde_json::{Map, Value, json};
use syntax::ast::{AstNode, ChartFile, Component, PhaseKind, SystemChart};
use syntax::{Parse, SyntaxKind, SyntaxNode, SyntaxToken};
use wire::TimesTold;

use crate::answer::Answers;
use crate::route::Refused;

/// The times of a chart's system as its text is now; null if it has none.
pub fn times(answers: &mut Answers, path: &str) -> Result<Value, Refused> {
    let loaded = answers.project.chart(path).map_err(Refused::failed)?;
    // What cannot be read right is not told of.
    if let Some(fault) = loaded.diagnostics.iter().find(|fault| fault.severity == syntax::Severity::Error) {
        return Err(Refused::failed(fault.message.clone()));
    }
    let Some(system) = &loaded.chart.system else { return Ok(Value::Null) };
    let times = analysed(system, Platform::of(system));
    let mut told =
        serde_json::to_value(TimesTold::of(system, &times)).map_err(|error| Refused::failed(error.to_string()))?;
    // If the chart says how many processors there are, these are faults of the chart.
    let wrong = if system.processors.is_none() { warnings(system, &times, system.span) } else { Vec::new() };
    told["told"] = wrong.iter().map(|fault| Value::from(fault.message.clone())).collect();
    Ok(told)
}

/// What the text says of each system, by its name.
pub fn systems(answers: &mut Answers, path: &str, parse: &Parse) -> BTreeMap<String, Value> {
    let Some(file) = ChartFile::cast(parse.syntax()) else { return BTreeMap::new() };
    let mut view = Properties { answers, path };
    let named = |system: SystemChart| Some((system.name()?.text().to_string(), view.system(&system)));
    file.systems().filter_map(named).collect()
}

struct Properties<'a> {
    answers: &'a mut Answers,
    path: &'a str,
}

fn text(token: Option<SyntaxToken>) -> Option<String> {
    token.map(|token| token.text().to_string())
}

impl Properties<'_> {
    fn at(&mut self, text: String, bytes: (u32, u32)) -> Value {
        json!({ "text": text, "range": self.answers.range(self.path, bytes) })
    }

    /// A property that is a node.
    fn node(&mut self, node: Option<&SyntaxNode>) -> Value {
        let Some(node) = node else { return Value::Null };
        let bytes = syntax::ast::trimmed_range(node);
        let whole = node.text_range().start();
        let text = node.text().slice(bytes - whole).to_string();
        self.at(text, (bytes.start().into(), bytes.end().into()))
    }

    /// A property that is a word.
    fn word(&mut self, token: Option<SyntaxToken>) -> Value {
        let Some(token) = token else { return Value::Null };
        let bytes = token.text_range();
        self.at(token.text().to_string(), (bytes.start().into(), bytes.end().into()))
    }

    fn system(&mut self, system: &SystemChart) -> Value {
        let mut parts = Map::new();
        for component in system.components() {
            let Some(name) = text(component.name()) else { continue };
            parts.insert(name, self.component(&component));
        }
        for channel in system.channels() {
            let Some(name) = text(channel.name()) else { continue };
            let kind = channel.kind();
            let made = kind.as_ref().map(|kind| match (kind.is_buffer(), kind.is_queue()) {
                (true, _) => "swinging buffer",
                (_, true) => "queue",
                _ => "shared value",
            });
            let told = json!({
                "part": "channel",
                "made": made,
                "size": self.word(kind.as_ref().and_then(|kind| kind.size())),
                "master": self.word(kind.as_ref().and_then(|kind| kind.master())),
                "domain": self.node(channel.message().as_ref().map(AstNode::syntax)),
                "from": text(channel.from()),
                "readers": channel.readers().map(|name| name.text().to_string()).collect::<Vec<_>>(),
            });
            parts.insert(name, told);
        }
        for device in system.devices() {
            let Some(name) = text(device.name()) else { continue };
            let domain = self.node(device.message().as_ref().map(AstNode::syntax));
            parts.insert(name, json!({ "part": "device", "domain": domain }));
        }
        let ages: Vec<Value> = system
            .age_bounds()
            .map(|bound| {
                let limit = self.node(bound.quantity().as_ref().map(AstNode::syntax));
                json!({ "from": text(bound.from()), "to": text(bound.to()), "limit": limit })
            })
            .collect();
        let tick = system.ticks().next().and_then(|tick| tick.quantity());
        json!({
            "tick": self.node(tick.as_ref().map(AstNode::syntax)),
            "processors": self.word(system.processors().next().and_then(|some| some.number())),
            "ages": ages,
            "parts": parts,
        })
    }

    fn component(&mut self, component: &Component) -> Value {
        let kind = component.kind();
        let is_synchronous = kind.as_ref().map(|kind| kind.is_synchronous());
        let mut quantity = |word: SyntaxKind| {
            let found = kind.as_ref().and_then(|kind| kind.quantity(word));
            self.node(found.as_ref().map(AstNode::syntax))
        };
        let (period, offset) = (quantity(SyntaxKind::PERIOD_KW), quantity(SyntaxKind::OFFSET_KW));
        let (jitter, deadline) = (quantity(SyntaxKind::JITTER_KW), quantity(SyntaxKind::DEADLINE_KW));
        // `1 of 20`, without the word before.
        let missed = kind.as_ref().and_then(|kind| kind.tolerance());
        let mut missed = self.node(missed.as_ref().map(AstNode::syntax));
        if let Some(text) = missed["text"].as_str() {
            missed["text"] = text.trim_start_matches("misses").trim().into();
        }
        // `all frames, poses`, without the word before.
        let awaits = kind.and_then(|kind| kind.awaits());
        let mut awaits = self.node(awaits.as_ref().map(AstNode::syntax));
        if let Some(text) = awaits["text"].as_str() {
            awaits["text"] = text.trim_start_matches("awaits").trim().into();
        }
        let phases: Vec<Value> = component
            .phases()
            .map(|phase| {
                let verb = phase.kind().map(|kind| match kind {
                    PhaseKind::Read => "read",
                    PhaseKind::Elaborate => "elaborate",
                    PhaseKind::Write => "write",
                });
                json!({
                    "verb": verb,
                    "subject": text(phase.subject()),
                    "name": self.word(phase.name()),
                    "time": self.node(phase.time().as_ref().map(AstNode::syntax)),
                    "fresh": self.node(phase.fresh().and_then(|bound| bound.quantity()).as_ref().map(AstNode::syntax)),
                    "machine": self.word(phase.machine()),
                    "range": self.node(Some(phase.syntax()))["range"],
                })
            })
            .collect();
        json!({
            "part": "component",
            "synchronous": is_synchronous,
            "period": period,
            "jitter": jitter,
            "offset": offset,
            "deadline": deadline,
            "misses": missed,
            "awaits": awaits,
            "phases": phases,
        })
    }
}

/// Operations on systems; none for those of other kinds.
///
/// # Errors
/// Something is missing, or is of another kind.
pub fn operation_of(value: &Value) -> Result<Option<Operation>, Refused> {
    let needed = |key: &str| {
        let text = value[key].as_str().map(str::to_string);
        text.ok_or_else(|| Refused::wrong(format!("`{key}` is a text")))
    };
    let number = |key: &str| {
        let number = value[key].as_u64().and_then(|number| usize::try_from(number).ok());
        number.ok_or_else(|| Refused::wrong(format!("`{key}` is a number from 0")))
    };
    Ok(Some(match value["kind"].as_str().unwrap_or_default() {
        "set" => {
            let property = match needed("property")?.as_str() {
                "timing" => Property::Timing,
                "period" => Property::Period,
                "jitter" => Property::Jitter,
                "offset" => Property::Offset,
                "deadline" => Property::Deadline,
                "misses" => Property::Misses,
                "awaits" => Property::Awaits,
                "made" => Property::Kind,
                "size" => Property::Size,
                "master" => Property::Master,
                "domain" => Property::Domain,
                "tick" => Property::Tick,
                "processors" => Property::Processors,
                "age" => Property::Age(number("at")?),
                "writer" => Property::Writer,
                "phaseSubject" => Property::PhaseSubject(number("at")?),
                "phaseTime" => Property::PhaseTime(number("at")?),
                "phaseName" => Property::PhaseName(number("at")?),
                "phaseFresh" => Property::PhaseFresh(number("at")?),
                "phaseMachine" => Property::PhaseMachine(number("at")?),
                other => return Err(Refused::wrong(format!("`{other}` is no property"))),
            };
            let set = value["value"].as_str().map(str::to_string);
            Operation::Set(needed("id")?, property, set.filter(|text| !text.trim().is_empty()))
        }
        "addPhase" => {
            let kind = match needed("verb")?.as_str() {
                "read" => PhaseKind::Read,
                "elaborate" => PhaseKind::Elaborate,
                "write" => PhaseKind::Write,
                other => return Err(Refused::wrong(format!("a phase does not `{other}`"))),
            };
            Operation::AddPhase(needed("id")?, kind, needed("subject")?)
        }
        "removePhase" => Operation::RemovePhase(needed("id")?, number("at")?),
        "movePhase" => Operation::MovePhase(needed("id")?, number("at")?, number("to")?),
        "addAge" => Operation::AddAge { from: needed("from")?, to: needed("to")?, limit: needed("limit")? },
        _ => return Ok(None),
    }))
}
