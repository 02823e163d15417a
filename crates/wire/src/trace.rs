//! Traces as JSON lines: spec/trace.md.
//!
//! In: the header and records of a run. Out: lines; and back, given a program of the same model. Values and locations
//! are written as in AsmetaL, and read back by the domain of the location. INVARIANT: writing what was read gives the
//! same bytes.

use std::fmt;
use std::marker::PhantomData;

use machine::{Change, Location, Show, TimeUnit, Value};
use program::Program;
use serde::de::{MapAccess, Visitor};
use serde::ser::SerializeMap;
use serde::{Deserialize, Deserializer, Serialize, Serializer};
use simulate::{ChoiceMade, End, Header, Invariants, Record, StepRecord, Violation, read_location, read_value};
use syntax::{FileId, Sources, Span};

/// The version of the written format.
pub const VERSION: u32 = 1;

/// One line.
#[derive(Debug, Clone, Serialize, Deserialize)]
#[serde(tag = "type", rename_all = "lowercase")]
#[cfg_attr(test, derive(schemars::JsonSchema))]
pub enum Line {
    /// The first line: what was run, and how.
    Trace(Head),
    /// The initial state.
    State(State),
    /// A step.
    Step(Step),
    /// A step that was begun but not made: what it read from the environment before a fault or a violation ended the
    /// run.
    Attempt(Step),
    /// The last step is undone; the next step is this one.
    Back {
        /// The next step.
        step: u64,
    },
    /// The last line: why the run ended.
    End(Ending),
    /// An object of a command's output that is not part of the trace; never written.
    #[serde(other, skip_serializing)]
    Other,
}

/// An object whose keys keep their order.
#[derive(Debug, Clone)]
pub struct Pairs<T>(Vec<(String, T)>);

impl<T> Default for Pairs<T> {
    fn default() -> Self {
        Pairs(Vec::new())
    }
}

impl<T> Pairs<T> {
    fn is_empty(&self) -> bool {
        self.0.is_empty()
    }
}

impl<T> FromIterator<(String, T)> for Pairs<T> {
    fn from_iter<I: IntoIterator<Item = (String, T)>>(pairs: I) -> Self {
        Pairs(pairs.into_iter().collect())
    }
}

#[cfg(test)]
impl<T: schemars::JsonSchema> schemars::JsonSchema for Pairs<T> {
    fn schema_name() -> std::borrow::Cow<'static, str> {
        format!("PairsOf{}", T::schema_name()).into()
    }

    fn json_schema(generator: &mut schemars::SchemaGenerator) -> schemars::Schema {
        schemars::json_schema!({ "type": "object", "additionalProperties": generator.subschema_for::<T>() })
    }
}

impl<T: Serialize> Serialize for Pairs<T> {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        let mut map = serializer.serialize_map(Some(self.0.len()))?;
        for (key, value) in &self.0 {
            map.serialize_entry(key, value)?;
        }
        map.end()
    }
}

impl<'de, T: Deserialize<'de>> Deserialize<'de> for Pairs<T> {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        struct Visit<T>(PhantomData<T>);
        impl<'de, T: Deserialize<'de>> Visitor<'de> for Visit<T> {
            type Value = Pairs<T>;

            fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
                f.write_str("an object")
            }

            fn visit_map<A: MapAccess<'de>>(self, mut map: A) -> Result<Pairs<T>, A::Error> {
                let mut pairs = Vec::new();
                while let Some(pair) = map.next_entry()? {
                    pairs.push(pair);
                }
                Ok(Pairs(pairs))
            }
        }
        deserializer.deserialize_map(Visit(PhantomData))
    }
}

/// What was run, and how.
#[derive(Debug, Clone, Serialize, Deserialize)]
#[cfg_attr(test, derive(schemars::JsonSchema))]
pub struct Head {
    version: u32,
    model: String,
    path: String,
    source: String,
    #[serde(skip_serializing_if = "Option::is_none", default)]
    seed: Option<u64>,
    #[serde(skip_serializing_if = "Option::is_none", default)]
    steps: Option<u64>,
    #[serde(skip_serializing_if = "std::ops::Not::not", default)]
    stop_on_empty: bool,
    #[serde(skip_serializing_if = "std::ops::Not::not", default)]
    stop_on_trivial: bool,
    #[serde(skip_serializing_if = "Option::is_none", default)]
    until: Option<String>,
    invariants: Mode,
}

#[derive(Debug, Clone, Copy, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
#[cfg_attr(test, derive(schemars::JsonSchema))]
enum Mode {
    Stop,
    Report,
    Ignore,
}

/// The initial state, and what it was computed from.
#[derive(Debug, Clone, Default, Serialize, Deserialize)]
#[cfg_attr(test, derive(schemars::JsonSchema))]
pub struct State {
    #[serde(skip_serializing_if = "Pairs::is_empty", default)]
    inputs: Pairs<String>,
    #[serde(skip_serializing_if = "Vec::is_empty", default)]
    choices: Vec<Chosen>,
    #[serde(skip_serializing_if = "Vec::is_empty", default)]
    times: Vec<(String, i64)>,
    values: Pairs<String>,
    #[serde(skip_serializing_if = "Vec::is_empty", default)]
    violations: Vec<Broken>,
}

/// A step: what it read and what it changed.
#[derive(Debug, Clone, Serialize, Deserialize)]
#[cfg_attr(test, derive(schemars::JsonSchema))]
pub struct Step {
    pub(crate) step: u64,
    #[serde(skip_serializing_if = "Pairs::is_empty", default)]
    inputs: Pairs<String>,
    #[serde(skip_serializing_if = "Pairs::is_empty", default)]
    writes: Pairs<String>,
    #[serde(skip_serializing_if = "Vec::is_empty", default)]
    choices: Vec<Chosen>,
    #[serde(skip_serializing_if = "Vec::is_empty", default)]
    times: Vec<(String, i64)>,
    #[serde(skip_serializing_if = "Pairs::is_empty", default)]
    changes: Pairs<Changed>,
    #[serde(skip_serializing_if = "is_zero", default)]
    updates: usize,
    #[serde(skip_serializing_if = "std::ops::Not::not", default)]
    changed: bool,
    #[serde(skip_serializing_if = "Vec::is_empty", default)]
    violations: Vec<Broken>,
}

fn is_zero(number: &usize) -> bool {
    *number == 0
}

#[derive(Debug, Clone, Serialize, Deserialize)]
#[cfg_attr(test, derive(schemars::JsonSchema))]
struct Chosen {
    at: String,
    of: usize,
    index: usize,
    values: Vec<String>,
}

#[derive(Debug, Clone, Serialize, Deserialize)]
#[cfg_attr(test, derive(schemars::JsonSchema))]
struct Changed {
    from: String,
    to: String,
    by: String,
}

#[derive(Debug, Clone, Serialize, Deserialize)]
#[cfg_attr(test, derive(schemars::JsonSchema))]
struct Broken {
    invariant: String,
    at: String,
    value: String,
    #[serde(skip_serializing_if = "std::ops::Not::not", default)]
    before: bool,
}

/// Why a run ended.
#[derive(Debug, Clone, Serialize, Deserialize)]
#[cfg_attr(test, derive(schemars::JsonSchema))]
pub struct Ending {
    reason: String,
    steps: u64,
    #[serde(skip_serializing_if = "Option::is_none", default)]
    fault: Option<FaultLine>,
}

#[derive(Debug, Clone, Serialize, Deserialize)]
#[cfg_attr(test, derive(schemars::JsonSchema))]
struct FaultLine {
    id: String,
    message: String,
    at: String,
}

/// Turns records into lines.
#[derive(Debug, Clone, Copy)]
pub struct Wire<'a> {
    /// The program that runs.
    pub program: &'a Program,
    /// The texts that places refer to.
    pub sources: &'a Sources,
}

impl Wire<'_> {
    /// The first line.
    pub fn header(header: &Header) -> Line {
        Line::Trace(Head {
            version: VERSION,
            model: header.model.clone(),
            path: header.path.clone(),
            source: header.source.clone(),
            seed: header.seed,
            steps: header.steps,
            stop_on_empty: header.stop_on_empty,
            stop_on_trivial: header.stop_on_trivial,
            until: header.until.clone(),
            invariants: match header.invariants {
                Invariants::Stop => Mode::Stop,
                Invariants::Report => Mode::Report,
                Invariants::Ignore => Mode::Ignore,
            },
        })
    }

    /// A record as a line, after `steps` steps.
    pub fn record(&self, record: &Record, steps: u64) -> Line {
        match record {
            Record::Initial { inputs, choices, times, values, violations } => Line::State(State {
                inputs: self.pairs(inputs),
                choices: self.choices(choices),
                times: times_out(times),
                values: self.pairs(values),
                violations: self.violations(violations),
            }),
            Record::Step(step) => Line::Step(self.step(step)),
            Record::Attempt(step) => Line::Attempt(self.step(step)),
            Record::Back { step } => Line::Back { step: *step },
            Record::End(end) => Line::End(Ending {
                reason: end.word().to_string(),
                steps,
                fault: match end {
                    End::Fault(fault) => Some(FaultLine {
                        id: fault.kind.id().to_string(),
                        message: fault.show(self.program).to_string(),
                        at: self.sources.position(fault.span),
                    }),
                    _ => None,
                },
            }),
        }
    }

    fn step(&self, step: &StepRecord) -> Step {
        let changed = |change: &Change| {
            let by = self.sources.position(change.span);
            (
                self.location(&change.location),
                Changed { from: self.value(&change.before), to: self.value(&change.after), by },
            )
        };
        Step {
            step: step.step,
            inputs: self.pairs(&step.inputs),
            writes: self.pairs(&step.writes),
            choices: self.choices(&step.choices),
            times: times_out(&step.times),
            changes: Pairs(step.changes.iter().map(changed).collect()),
            updates: step.updates,
            changed: step.changed,
            violations: self.violations(&step.violations),
        }
    }

    fn choices(&self, choices: &[ChoiceMade]) -> Vec<Chosen> {
        let chosen = |choice: &ChoiceMade| Chosen {
            at: self.sources.position(choice.span),
            of: choice.of,
            index: choice.index,
            values: choice.values.iter().map(|value| self.value(value)).collect(),
        };
        choices.iter().map(chosen).collect()
    }

    fn violations(&self, violations: &[Violation]) -> Vec<Broken> {
        let broken = |violation: &Violation| Broken {
            invariant: violation.name.clone(),
            at: self.sources.position(violation.span),
            value: self.value(&violation.value),
            before: violation.before,
        };
        violations.iter().map(broken).collect()
    }

    fn pairs(&self, values: &[(Location, Value)]) -> Pairs<String> {
        Pairs(values.iter().map(|(location, value)| (self.location(location), self.value(value))).collect())
    }

    fn location(&self, location: &Location) -> String {
        location.show(self.program).to_string()
    }

    fn value(&self, value: &Value) -> String {
        value.show(self.program).to_string()
    }
}

fn times_out(times: &[(TimeUnit, i64)]) -> Vec<(String, i64)> {
    let unit = |unit: &TimeUnit| match unit {
        TimeUnit::Nanoseconds => "ns",
        TimeUnit::Milliseconds => "ms",
        TimeUnit::Seconds => "s",
    };
    times.iter().map(|(u, now)| (unit(u).to_string(), *now)).collect()
}

fn times_in(times: &[(String, i64)]) -> Result<Vec<(TimeUnit, i64)>, String> {
    let unit = |unit: &str| match unit {
        "ns" => Ok(TimeUnit::Nanoseconds),
        "ms" => Ok(TimeUnit::Milliseconds),
        "s" => Ok(TimeUnit::Seconds),
        other => Err(format!("`{other}` is not a unit of time")),
    };
    times.iter().map(|(u, now)| Ok((unit(u)?, *now))).collect()
}

/// Reads lines back. Places are not read, because they refer to the text that the trace was made from.
#[derive(Debug, Clone, Copy)]
pub struct Reader<'a> {
    /// A program of the trace's model.
    pub program: &'a Program,
}

fn choices_in(choices: &[Chosen]) -> Vec<ChoiceMade> {
    let made = |chosen: &Chosen| ChoiceMade { span: NOWHERE, of: chosen.of, index: chosen.index, values: Vec::new() };
    choices.iter().map(made).collect()
}

const NOWHERE: Span = Span { file: FileId(0), start: 0, end: 0 };

impl Reader<'_> {
    /// The header.
    ///
    /// # Errors
    /// The line is no header, or its version is not supported.
    pub fn header(line: &Line) -> Result<Header, String> {
        let Line::Trace(head) = line else { return Err("the first line is not the header of a trace".to_string()) };
        if head.version != VERSION {
            return Err(format!("the trace has format version {}, this program reads version {VERSION}", head.version));
        }
        Ok(Header {
            model: head.model.clone(),
            path: head.path.clone(),
            source: head.source.clone(),
            seed: head.seed,
            steps: head.steps,
            stop_on_empty: head.stop_on_empty,
            stop_on_trivial: head.stop_on_trivial,
            until: head.until.clone(),
            invariants: match head.invariants {
                Mode::Stop => Invariants::Stop,
                Mode::Report => Invariants::Report,
                Mode::Ignore => Invariants::Ignore,
            },
        })
    }

    /// A record. A fault is read back only as the fact that there was one.
    ///
    /// # Errors
    /// The line does not fit the program, or is a header.
    pub fn record(&self, line: &Line) -> Result<Record, String> {
        Ok(match line {
            Line::Trace(_) | Line::Other => return Err("a second header".to_string()),
            Line::State(state) => Record::Initial {
                inputs: self.pairs(&state.inputs)?,
                choices: choices_in(&state.choices),
                times: times_in(&state.times)?,
                values: self.pairs(&state.values)?,
                violations: self.violations(&state.violations)?,
            },
            Line::Step(step) => Record::Step(self.step(step)?),
            Line::Attempt(step) => Record::Attempt(self.step(step)?),
            Line::Back { step } => Record::Back { step: *step },
            Line::End(ending) => Record::End(self.end(ending)?),
        })
    }

    fn end(&self, ending: &Ending) -> Result<End, String> {
        Ok(match ending.reason.as_str() {
            "steps" => End::Steps,
            "empty" => End::Empty,
            "trivial" => End::Trivial,
            "until" => End::Until,
            "violation" => End::Violation,
            "interrupted" => End::Interrupted,
            "quit" => End::Quit,
            "fault" => {
                let reason = ending.fault.as_ref().map(|fault| fault.message.clone()).unwrap_or_default();
                let kind = machine::FaultKind::BadOperand { reason };
                End::Fault(Box::new(machine::Fault { kind, span: NOWHERE, calls: Vec::new() }))
            }
            other => return Err(format!("`{other}` is not a reason to end")),
        })
    }

    fn step(&self, step: &Step) -> Result<StepRecord, String> {
        let changes = step.changes.0.iter().map(|(location, changed)| {
            let location = read_location(self.program, location)?;
            let before = self.value(&location, &changed.from)?;
            let after = self.value(&location, &changed.to)?;
            Ok(Change { location, before, after, span: NOWHERE })
        });
        Ok(StepRecord {
            step: step.step,
            inputs: self.pairs(&step.inputs)?,
            writes: self.pairs(&step.writes)?,
            choices: choices_in(&step.choices),
            times: times_in(&step.times)?,
            changes: changes.collect::<Result<_, String>>()?,
            updates: step.updates,
            changed: step.changed,
            violations: self.violations(&step.violations)?,
        })
    }

    fn violations(&self, broken: &[Broken]) -> Result<Vec<Violation>, String> {
        let violation = |broken: &Broken| {
            let value = if broken.value == "false" { Value::Boolean(false) } else { Value::Undef };
            Violation { name: broken.invariant.clone(), span: NOWHERE, value, before: broken.before }
        };
        Ok(broken.iter().map(violation).collect())
    }

    fn pairs(&self, pairs: &Pairs<String>) -> Result<Vec<(Location, Value)>, String> {
        let read = pairs.0.iter().map(|(location, value)| {
            let location = read_location(self.program, location)?;
            let value = self.value(&location, value)?;
            Ok((location, value))
        });
        read.collect()
    }

    fn value(&self, location: &Location, text: &str) -> Result<Value, String> {
        read_value(self.program, self.program.function(location.function).codomain, text)
    }
}
