//! Builds the rule of a machine: for each control state what its paths do, with guards as nested `if` and actions in
//! `par`.
//!
//! In: a machine without errors. Out: the unformatted text of its rule. The form is that of the paper's Listing 2: an
//! `if` for the entering arrow, then one for each control state, all in parallel.

use std::fmt::Write;

use super::spelling::{call, control_location, inner_control, instance_call, state_value};
use crate::chart::{Chart, End, Machine, ShapeId, ShapeKind};
use crate::flow::{Origin, is_beside, is_block, origins};

/// The rule of a machine, with this name.
pub(crate) fn machine_rule(chart: &Chart, machine: &Machine, name: &str) -> String {
    let parameters: Vec<String> =
        machine.parameters.iter().map(|parameter| format!("{} in {}", parameter.variable, parameter.domain)).collect();
    let parameters = if parameters.is_empty() { String::new() } else { format!("({})", parameters.join(", ")) };
    let machine = machine.flat();
    let writer = Writer { chart, machine };
    let mut rules: Vec<String> = Vec::new();
    for (id, shape) in machine.numbered().filter(|(id, _)| is_beside(machine, *id)) {
        if !machine.sequences.iter().flatten().any(|member| *member == id) {
            rules.push(format!("// {}\n{}", shape.text, writer.instance(id)));
        }
    }
    for sequence in machine.sequences.iter().filter(|sequence| sequence.iter().all(|id| is_beside(machine, *id))) {
        let calls: Vec<String> = sequence.iter().map(|id| writer.instance(*id)).collect();
        rules.push(format!("seq\n{}\nendseq", calls.join("\n")));
    }
    for origin in origins(chart, machine) {
        rules.extend(writer.origin(origin));
    }
    format!("rule {name}{parameters} =\n{}\n", par(&rules))
}

/// The condition on control variables at an origin; `None` if there is none.
pub(crate) fn origin_condition(chart: &Chart, machine: &Machine, origin: Origin) -> Option<String> {
    Writer { chart, machine }.condition(origin)
}

/// Rules in parallel; a single rule stands alone.
fn par(rules: &[String]) -> String {
    match rules {
        [] => "skip".to_string(),
        [one] => one.clone(),
        several => format!("par\n{}\nendpar", several.join("\n")),
    }
}

struct Writer<'c> {
    chart: &'c Chart,
    machine: &'c Machine,
}

impl Writer<'_> {
    /// What is done from one origin; `None` if no path starts there.
    fn origin(&self, origin: Origin) -> Option<String> {
        let machine = self.machine;
        let start = match origin {
            Origin::Enter => End::Enter,
            Origin::State(id) | Origin::Left(id) => End::Shape(id),
        };
        let paths: Vec<String> =
            machine.out_of(start).map(|arrow| par(&self.from(arrow.to, &mut Vec::new()))).collect();
        match origin {
            Origin::Enter if !machine.takes_steps() => paths.first().cloned(),
            _ if paths.is_empty() && !matches!(origin, Origin::Left(_)) => None,
            Origin::Enter => {
                let at = self.condition(origin).unwrap_or_default();
                Some(format!("// entering\nif {at} then\n{}\nendif", par(&paths)))
            }
            Origin::State(id) => {
                let note = machine.shape(id).text.replace('\n', " ");
                let at = self.condition(origin).unwrap_or_default();
                Some(format!("// {note}\nif {at} then\n{}\nendif", par(&paths)))
            }
            Origin::Left(id) => Some(self.block(id, &paths)),
        }
    }

    /// The condition on control variables at an origin; `None` if there is none.
    fn condition(&self, origin: Origin) -> Option<String> {
        let control = control_location(self.machine)?;
        Some(match origin {
            Origin::Enter => format!("isUndef({control})"),
            Origin::State(id) => format!("{control} = {}", self.value(id)),
            Origin::Left(id) => format!("{control} = {} and isUndef({})", self.value(id), self.inner_control(id)),
        })
    }

    /// In a block its pattern continues; once it has been left, the paths after it start.
    fn block(&self, id: ShapeId, paths: &[String]) -> String {
        let note = self.machine.shape(id).text.replace('\n', " ");
        let (control, value) = (self.control(), self.value(id));
        let inner = self.inner_control(id);
        let call = self.instance(id);
        let left = par(paths);
        format!("// {note}\nif {control} = {value} then\nif isUndef({inner}) then\n{left}\nelse\n{call}\nendif\nendif")
    }

    fn inner_control(&self, id: ShapeId) -> String {
        inner_control(self.chart, self.machine.shape(id)).unwrap_or_else(|| "undef".to_string())
    }

    fn control(&self) -> String {
        control_location(self.machine).unwrap_or_default()
    }

    fn value(&self, id: ShapeId) -> String {
        state_value(self.chart, self.machine, id)
    }

    fn instance(&self, id: ShapeId) -> String {
        instance_call(self.chart, self.machine.shape(id))
    }

    /// The rules of the paths from an end to the end of the step; `chain` contains the actions so far.
    fn from(&self, end: End, chain: &mut Vec<(ShapeId, String)>) -> Vec<String> {
        let last = |rule: String, chain: &[(ShapeId, String)]| {
            let mut rules = self.chained(chain);
            rules.push(rule);
            rules
        };
        let id = match end {
            End::Shape(id) => id,
            _ if !self.machine.takes_steps() => return self.chained(chain),
            _ => return last(format!("{} := undef // exit", self.control()), chain),
        };
        let go_to = format!("{} := {}", self.control(), self.value(id));
        match self.machine.shape(id).kind {
            ShapeKind::State { .. } | ShapeKind::Composite(_) => last(go_to, chain),
            ShapeKind::Instance(_) if is_block(self.chart, self.machine, id) => {
                chain.push((id, self.instance(id)));
                last(go_to, chain)
            }
            ShapeKind::Guard => {
                let mut rules = self.chained(chain);
                rules.extend(self.guard(id));
                rules
            }
            ShapeKind::Action | ShapeKind::Instance(_) => {
                let rule = match self.machine.shape(id).kind {
                    ShapeKind::Action => self.action(id),
                    _ => self.instance(id),
                };
                chain.push((id, rule));
                match self.machine.out_of(end).next() {
                    Some(arrow) => self.from(arrow.to, chain),
                    None => self.chained(chain),
                }
            }
        }
    }

    fn action(&self, id: ShapeId) -> String {
        call(self.machine, self.machine.shape(id))
    }

    fn guard(&self, id: ShapeId) -> Option<String> {
        let exit = |branch| {
            let arrow = self.machine.branch(id, branch)?;
            Some(par(&self.from(arrow.to, &mut Vec::new())))
        };
        let condition = call(self.machine, self.machine.shape(id));
        let mut text = String::new();
        match (exit(true), exit(false)) {
            (Some(yes), Some(no)) => {
                let _ = write!(text, "if {condition} then\n{yes}\nelse\n{no}\nendif");
            }
            (Some(yes), None) => _ = write!(text, "if {condition} then\n{yes}\nendif"),
            (None, Some(no)) => _ = write!(text, "if not ({condition}) then\n{no}\nendif"),
            (None, None) => return None,
        }
        Some(text)
    }

    /// The actions of a path: in parallel, except those that the chart puts in sequence.
    fn chained(&self, chain: &[(ShapeId, String)]) -> Vec<String> {
        let mut rules = Vec::new();
        let mut rest = chain;
        while let [(id, rule), behind @ ..] = rest {
            let sequence = self.machine.sequences.iter().find(|sequence| sequence.contains(id));
            let count = sequence.map_or(1, |sequence| rest.iter().take_while(|(id, _)| sequence.contains(id)).count());
            if count > 1 {
                let parts: Vec<&str> = rest[..count].iter().map(|(_, rule)| rule.as_str()).collect();
                rules.push(format!("seq\n{}\nendseq", parts.join("\n")));
                rest = &rest[count..];
            } else {
                rules.push(rule.clone());
                rest = behind;
            }
        }
        rules
    }
}
