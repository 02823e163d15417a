//! Checks that a system and its model mean the same.
//!
//! In: a system, the text that it is built to, and its model's text. Out: a fault for each difference, in the system's
//! terms, with both places. The two texts are compared as tables ([`Ground`]): for each element the value of each
//! function. A consequence of a reported difference (a budget of a phase's time, the order at a lock of a period) is
//! not reported again. INVARIANT: if nothing is reported, building would change neither an element, an initial value,
//! the main rule, the program of the agents, nor the rule and the invariants that every system has. Rules of elaborations
//! are not compared, since they are written by hand; but none of them updates what belongs to a component's machine.

use std::collections::BTreeSet;

use syntax::{Diagnostic, FileId, Span};

use super::ground::{Given, Ground, plain};
use crate::chart::Chart;
use crate::fault;
use crate::system::{Action, Component, System, length};

/// The differences between a chart's system and the model in a file.
pub(super) fn compare(chart: &Chart, system: &System, file: FileId, text: &str) -> Vec<Diagnostic> {
    let built = Ground::read(FileId(u32::MAX), &crate::build::fresh(chart));
    let model = Ground::read(file, text);
    let mut comparison = Comparison { system, built, model, faults: Vec::new(), told: BTreeSet::new() };
    comparison.imports(chart);
    comparison.elements();
    comparison.values();
    comparison.texts();
    comparison.intruders();
    comparison.faults
}

struct Comparison<'c> {
    system: &'c System,
    built: Ground,
    model: Ground,
    faults: Vec<Diagnostic>,
    /// The reported differences: a function or a domain, and the element.
    told: BTreeSet<(String, String)>,
}

/// Values that are computed from others, which are compared first.
const DERIVED: [&str; 5] = ["indexRead", "nextPhase", "scheduler_currentPhase", "sem_users", "task_timeForElaboration"];

impl Comparison<'_> {
    fn tell(&mut self, place: Span, message: String, model: Option<(Span, &str)>) {
        self.faults.push(fault::system_differs(place, message, model));
    }

    /// The place to report when a part of the model is missing.
    fn nowhere(&self) -> Option<(Span, &'static str)> {
        self.model.name.map(|name| (name, "the model"))
    }

    fn imports(&mut self, chart: &Chart) {
        for (path, place) in chart.imports.iter().zip(&chart.places) {
            if !self.model.imports.contains(&plain(path)) {
                let nowhere = self.nowhere();
                self.tell(*place, format!("the model does not import {path}"), nowhere);
            }
        }
    }

    fn elements(&mut self) {
        for (name, (domain, _)) in self.built.elements.clone() {
            let (who, place) = self.who(&name);
            match self.model.elements.get(&name).cloned() {
                Some((other, _)) if other == domain => {}
                Some((other, span)) => {
                    self.told.insert(("element".to_string(), name.clone()));
                    // The lock of a buffer belongs to the buffer.
                    if domain != "Semaphore" {
                        let message =
                            format!("{who} is a {} in the chart, a {} in the model", bare(&domain), bare(&other));
                        self.tell(place, message, Some((span, "the model's")));
                    }
                }
                None => {
                    self.told.insert(("element".to_string(), name.clone()));
                    let owner =
                        name.strip_suffix("_task").or(name.strip_suffix("_wait")).or(name.strip_suffix("_lock"));
                    let follows = owner.is_some_and(|owner| {
                        self.built.elements.contains_key(owner)
                            && !matches!(self.model.elements.get(owner), Some((other, _)) if *other == self.built.elements[owner].0)
                    });
                    if !follows {
                        let nowhere = self.nowhere();
                        self.tell(place, format!("{who} is not in the model"), nowhere);
                    }
                }
            }
        }
        for domain in crate::build::OWNED {
            let all = self.model.elements.iter().filter(|(name, (of, _))| {
                of == domain && !self.built.elements.contains_key(*name) && !self.comes_with_another(name)
            });
            let all: Vec<(String, Span)> = all.map(|(name, (_, span))| (name.clone(), *span)).collect();
            let Some((_, first)) = all.first().cloned() else { continue };
            let names: Vec<String> = all.iter().map(|(name, _)| format!("`{name}`")).collect();
            let (what, place) = (bare(domain), self.system.span);
            let message = format!("the model has the {what} {}, the chart does not", names.join(", "));
            self.tell(place, message, Some((first, "the model's")));
        }
    }

    /// Whether an element is the task, lock or waiting phase of an element that is reported itself.
    fn comes_with_another(&self, name: &str) -> bool {
        let ends = ["_task", "_lock", "_wait"].iter().find_map(|end| name.strip_suffix(end));
        ends.is_some_and(|owner| {
            let (drawn, written) = (self.built.elements.get(owner), self.model.elements.get(owner));
            written.is_some() && drawn.map(|(domain, _)| domain) != written.map(|(domain, _)| domain)
        })
    }

    fn values(&mut self) {
        let mut functions: Vec<String> = self.built.given.keys().chain(self.model.given.keys()).cloned().collect();
        functions.sort_by_key(|name| (DERIVED.contains(&name.as_str()), name.clone()));
        functions.dedup();
        for function in functions {
            self.function(&function);
        }
    }

    fn function(&mut self, function: &str) {
        let span = self.system.span;
        let (drawn, written) = (self.built.given.get(function), self.model.given.get(function));
        let domain = drawn.or(written).and_then(|given| match &given.domains[..] {
            [one] => Some(one.clone()),
            _ => None,
        });
        let owned = domain.filter(|domain| crate::build::OWNED.contains(&domain.as_str()));
        match (drawn, written, owned) {
            (None, Some(written), None) => {
                let place = (written.span, "the model's");
                self.tell(
                    span,
                    format!("the model gives `{function}` an initial value, the chart does not"),
                    Some(place),
                );
            }
            (Some(_), None, None) => {
                let nowhere = self.nowhere();
                self.tell(span, format!("the model gives `{function}` no initial value, the chart does"), nowhere);
            }
            (Some(drawn), Some(written), None) => {
                let text = |given: &Given| given.otherwise.as_ref().map(|(text, _)| text.clone()).unwrap_or_default();
                if text(drawn) != text(written) || drawn.domains != written.domains {
                    let message =
                        format!("`{function}` is {} in the chart, {} in the model", text(drawn), text(written));
                    let place = (written.span, "the model's");
                    self.tell(span, message, Some(place));
                }
            }
            (_, Some(written), Some(_)) if !written.is_table || written.domains.len() != 1 => {
                let place = (written.span, "this is not a table of values");
                let message = format!("the model gives `{function}` in a form that cannot be compared");
                self.tell(span, message, Some(place));
            }
            (drawn, written, Some(domain)) => {
                let elements = self.built.elements.iter().filter(|(_, (of, _))| *of == domain);
                let mut rows = Vec::new();
                for (element, _) in elements {
                    let (in_chart, in_model) = (
                        drawn.map_or("undef", |given| given.at(element).0).to_string(),
                        written.map(|given| given.at(element)).map(|(text, span)| (text.to_string(), span)),
                    );
                    let (in_model, place) =
                        in_model.map_or(("undef".to_string(), None), |(text, span)| (text, Some(span)));
                    if in_chart != in_model && !self.told.contains(&("element".to_string(), element.clone())) {
                        rows.push((element.clone(), in_chart, in_model, place));
                    }
                }
                for (element, in_chart, in_model, place) in rows {
                    self.row(function, &element, (&in_chart, &in_model), place);
                }
            }
            (None, None, None) => {}
        }
    }

    /// Reports a function with two values for one element.
    fn row(&mut self, function: &str, element: &str, values: (&str, &str), model: Option<Span>) {
        if self.follows(function, element) {
            return;
        }
        self.told.insert((function.to_string(), element.to_string()));
        let (who, place) = self.who(element);
        let (in_chart, in_model) = values;
        let shown = |value: &str| self.shown(function, value);
        let offsets = (self.offset(&self.built, element), self.offset(&self.model, element));
        let message = match function {
            "task_periodStart" if offsets.0.is_some() && offsets.1.is_some() => {
                let shown = |offset: Option<i64>| length(offset.unwrap_or_default(), self.system.tick_ns);
                format!("{who}: the offset is {} in the chart, {} in the model", shown(offsets.0), shown(offsets.1))
            }
            "task_kind" => format!("{who} is {} in the chart, {} in the model", shown(in_chart), shown(in_model)),
            _ => format!(
                "{who}: {} is {} in the chart, {} in the model",
                what(function),
                shown(in_chart),
                shown(in_model)
            ),
        };
        let model = model.map(|span| (span, "the model's")).or(self.nowhere());
        self.tell(place, message, model);
    }

    /// Whether a difference is only a consequence of a reported one.
    fn follows(&self, function: &str, element: &str) -> bool {
        let told = |function: &str, element: &str| self.told.contains(&(function.to_string(), element.to_string()));
        let missing = |element: &str| told("element", element);
        let channel = |name: &str| self.system.channels.iter().find(|channel| channel.name == name);
        let owner = self.owner(element);
        match function {
            "task_periodStart" => {
                let drawn = self.offset(&self.built, element);
                drawn.is_some() && drawn == self.offset(&self.model, element)
            }
            "task_timeForElaboration" => owner.is_some_and(|component| {
                let phases = component
                    .phases
                    .iter()
                    .any(|phase| told("time", &phase.name) || missing(&phase.name) || told("action", &phase.name));
                let used =
                    component.phases.iter().any(|phase| missing(&phase.subject) || told("sb_master", &phase.subject));
                phases || used || told("task_kind", element) || told("task_jitter", element)
            }),
            "task_period" | "task_jitter" => told("task_kind", element),
            "nextPhase" | "scheduler_currentPhase" => owner.is_some_and(|component| {
                component.phases.iter().any(|phase| missing(&phase.name))
                    || function == "nextPhase" && self.model_has_more_phases()
            }),
            "indexRead" => told("dimension", element),
            "sem_users" => element.strip_suffix("_lock").and_then(channel).is_some_and(|channel| {
                [channel.from, channel.to].into_iter().map(|end| &self.system.components[end]).any(|end| {
                    let task = format!("{}_task", end.name);
                    missing(&task) || told("task_period", &task) || told("task_kind", &task)
                })
            }),
            _ => false,
        }
    }

    /// When the first cycle of a task begins: its initial period starts one period before that.
    fn offset(&self, ground: &Ground, task: &str) -> Option<i64> {
        let number = |function: &str| number(ground.given.get(function)?.at(task).0);
        Some(number("task_periodStart")? + number("task_period")?)
    }

    fn model_has_more_phases(&self) -> bool {
        let phases = self.model.elements.iter().filter(|(_, (domain, _))| domain == "SchedulePhase");
        phases.into_iter().any(|(name, _)| !self.built.elements.contains_key(name))
    }

    /// The rules of elaborations.
    fn elaborations(&self) -> BTreeSet<&str> {
        let phases = self.system.components.iter().flat_map(|component| &component.phases);
        phases
            .filter_map(|phase| match &phase.action {
                Action::Elaborate(link) => link.as_ref().map(|link| link.name.as_str()),
                Action::Read(_) | Action::Write(_) => None,
            })
            .collect()
    }

    /// Rules written by hand that update what belongs to a component's machine: what is proved and replayed of the machine alone would not
    /// be what the model does.
    fn intruders(&mut self) {
        let elaborations = self.elaborations();
        let is_built = |rule: &str| self.built.texts.contains_key(rule) && !elaborations.contains(rule);
        let made = &self.system.computing.declarations;
        let by_hand = self.model.updates.iter().filter(|(rule, _)| !is_built(rule));
        let found: Vec<_> =
            by_hand.filter(|(_, (name, _))| made.iter().any(|one| one.name == *name)).cloned().collect();
        for (rule, (function, place)) in found {
            let message = format!("`{rule}` updates `{function}`, which is for the machines of components alone");
            self.tell(self.system.span, message, Some((place, "the model's")));
        }
    }

    fn texts(&mut self) {
        let elaborations = self.elaborations();
        let mut found = Vec::new();
        for (name, (text, _)) in self.built.texts.iter().filter(|(name, _)| !elaborations.contains(name.as_str())) {
            match self.model.texts.get(name) {
                None => found.push((format!("the model has no `{name}`"), self.nowhere())),
                Some((other, _)) if other == text => {}
                Some((_, span)) => {
                    found.push((
                        format!("`{name}` differs from what the chart is built to"),
                        Some((*span, "the model's")),
                    ));
                }
            }
        }
        let agents = |ground: &Ground| -> BTreeSet<String> {
            ground.texts.keys().filter(|name| name.starts_with("agent ")).cloned().collect()
        };
        for name in agents(&self.model).difference(&agents(&self.built)) {
            let span = self.model.texts[name].1;
            found.push((format!("the model has `{name}`, the chart does not"), Some((span, "the model's"))));
        }
        for (message, model) in found {
            self.tell(self.system.span, message, model);
        }
    }

    /// The component of a phase, or of an element that is named after a component.
    fn owner(&self, element: &str) -> Option<&Component> {
        let made = |component: &Component| {
            [component.name.clone(), format!("{}_task", component.name), format!("{}_wait", component.name)]
                .iter()
                .any(|name| name == element)
        };
        self.system
            .components
            .iter()
            .find(|component| made(component) || component.phases.iter().any(|phase| phase.name == element))
    }

    /// What an element is in the chart, and its place.
    fn who(&self, element: &str) -> (String, Span) {
        if let Some(component) = self.owner(element) {
            return match component.phases.iter().find(|phase| phase.name == element) {
                Some(phase) => (format!("the phase `{element}` of the component `{}`", component.name), phase.span),
                None if element.ends_with("_wait") && component.name != element => {
                    (format!("the waiting phase of the component `{}`", component.name), component.span)
                }
                None => (format!("the component `{}`", component.name), component.span),
            };
        }
        let number = element.strip_prefix("bound").and_then(|rest| rest.split('_').next()?.parse::<usize>().ok());
        if let Some(bound) = number.and_then(|number| self.system.bounds.get(number.checked_sub(1)?)) {
            return (format!("the age bound from `{}` to `{}`", bound.from.text, bound.to.text), bound.span);
        }
        let bare = element.strip_suffix("_lock").unwrap_or(element);
        let channels = || self.system.channels.iter();
        match channels().find(|channel| channel.name == element).or(channels().find(|channel| channel.name == bare)) {
            Some(channel) if channel.name == element => (format!("the channel `{element}`"), channel.span),
            Some(channel) => (format!("the lock of the channel `{}`", channel.name), channel.span),
            None => (format!("`{element}`"), self.system.span),
        }
    }

    /// A value in the system's terms.
    fn shown(&self, function: &str, value: &str) -> String {
        let ticks = [
            "task_period",
            "task_deadline",
            "task_timeForElaboration",
            "task_jitter",
            "task_periodStart",
            "time",
            "timeAtLeast",
            "way_limit",
        ];
        if value == "undef" {
            return "none".to_string();
        }
        if let (true, Some(ticks)) = (ticks.contains(&function), number(value)) {
            return length(ticks, self.system.tick_ns);
        }
        match function {
            "sb_master" => match self.owner(value) {
                Some(component) => format!("`{}`", component.name),
                None => format!("the task of `{value}`"),
            },
            "task_kind" => value.to_lowercase(),
            "action" => match value {
                "ELABORATING" => "to elaborate",
                "WAITING_TRIGGER" => "to wait",
                "READING_FROM_SB" => "to read a swinging buffer",
                "WRITING_ON_SB" => "to write a swinging buffer",
                "SENDING" => "to send to a queue",
                "RECEIVING" => "to take from a queue",
                "STORING" => "to write a shared value",
                "LOADING" => "to read a shared value",
                other => other,
            }
            .to_string(),
            "elaborationRule" => {
                let name = value.split([' ', '(']).find(|word| word.starts_with("r_"));
                format!("`{}`", name.unwrap_or(value))
            }
            _ if number(value).is_some() => value.replace(' ', ""),
            _ => format!("`{}`", value.replace(" ( ", "(").replace(" ) ", ")")),
        }
    }
}

/// The meaning of a function in the system's terms.
fn what(function: &str) -> String {
    match function {
        "task_period" => "the period",
        "task_deadline" => "the deadline",
        "task_jitter" => "the jitter",
        "task_timeForElaboration" => "the time of a cycle without waiting",
        "task_periodStart" => "the beginning of its first period",
        "time" => "its time",
        "timeAtLeast" => "its shortest time, where it varies,",
        "nextPhase" => "the next phase",
        "action" => "what it does",
        "sharedMemory" | "messageQueue" | "sharedValue" => "its channel",
        "elaborationRule" => "its rule",
        "awaited" => "the readings that it awaits",
        "awaitsAll" => "whether it awaits all of them",
        "dimension" => "the number of arrays",
        "sb_master" => "the master",
        "indexRead" => "the array that is read first",
        "mq_capacity" => "the number of messages",
        "sem_users" => "the order at the lock",
        "scheduler_currentPhase" => "the phase it begins in",
        "way_limit" => "the age that is allowed",
        other => return format!("`{other}`"),
    }
    .to_string()
}

/// The word for an element of a domain.
fn bare(domain: &str) -> &'static str {
    match domain {
        "Scheduler" => "component",
        "Task" => "task",
        "SwingingBuffer" => "swinging buffer",
        "MessageQueue" => "queue",
        "SharedValue" => "shared value",
        "Semaphore" => "lock",
        "SchedulePhase" => "phase",
        "AgeHop" => "hop",
        "AgeWay" => "way",
        "FreshReading" => "reading",
        _ => "element",
    }
}

/// A whole number, with or without a space after its sign.
fn number(text: &str) -> Option<i64> {
    text.replace(' ', "").parse().ok()
}
