//! A debug session: requests in their order, and what the run does between them.
//!
//! In: requests. Out: responses and events, which [`Adapter::take_messages`] hands over. A request that comes at the wrong time, or
//! whose arguments are wrong, is answered by a failure and changes nothing.

use std::sync::Arc;

use groundstate::Workspace;
use groundstate::machine::{Location, Show, Value as Term};
use groundstate::session::{Moment, Waits};
use groundstate::workspace::Files;
use ide::{Encoding, Lines};
use serde_json::{Value, json};
use syntax::{Diagnostic, Sources};

use crate::breakpoints::{self, Breakpoints};
use crate::console::{Typed, typed};
use crate::launch::{Launch, NotLaunched};
use crate::say::{TOLD, asks_for, whole};
use crate::stack::frames;
use crate::target::{Counting, Target};
use crate::variables::{Variables, candidate};

/// How far a debug session has come.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub(crate) enum Phase {
    New,
    Initialized,
    Launched,
    Configured,
    Terminated,
    Ended,
}

/// Why the run goes on, which says why it stops.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Going {
    Entry,
    Step,
    On,
    Back,
    Rewind,
}

/// What will be given when the run goes on.
#[derive(Debug)]
enum Answer {
    Input(Location, Term, String),
    Choice(usize, String),
}

impl Answer {
    fn text(&self) -> &str {
        match self {
            Answer::Input(_, _, text) | Answer::Choice(_, text) => text,
        }
    }
}

/// See the module.
#[derive(Debug)]
pub struct Adapter<F> {
    workspace: Workspace<F>,
    pub(crate) phase: Phase,
    counting: Counting,
    pub(crate) launch: Option<Launch>,
    pub(crate) target: Option<Target>,
    pub(crate) breakpoints: Breakpoints,
    variables: Variables,
    /// The debugger can be told that variables have changed.
    hears_invalidated: bool,
    /// Why it runs; none while it stops.
    pub(crate) going: Option<Going>,
    pub(crate) paused: bool,
    answer: Option<Answer>,
    /// The moment whose changes were written out last.
    pub(crate) told: Option<Arc<Moment>>,
    messages: Vec<Value>,
    sequence: u64,
    answered: u64,
}

/// The body of a response, or why there is none.
type Response = Result<Value, String>;

impl<F: Files> Adapter<F> {
    /// An adapter that has heard nothing yet.
    pub fn new(files: F) -> Adapter<F> {
        Adapter {
            workspace: Workspace::new(files),
            phase: Phase::New,
            counting: Counting::default(),
            launch: None,
            target: None,
            breakpoints: Breakpoints::new(),
            variables: Variables::default(),
            hears_invalidated: false,
            going: None,
            paused: false,
            answer: None,
            told: None,
            messages: Vec::new(),
            sequence: 0,
            answered: 0,
        }
    }

    /// Whether something may happen without a request.
    pub fn is_running(&self) -> bool {
        self.going.is_some() && self.phase == Phase::Configured
    }

    /// Whether the debugger has said that it ends.
    pub fn has_ended(&self) -> bool {
        self.phase == Phase::Ended
    }

    /// How many requests were answered.
    pub fn answered(&self) -> u64 {
        self.answered
    }

    /// What is to be sent.
    pub fn take_messages(&mut self) -> Vec<Value> {
        std::mem::take(&mut self.messages)
    }

    /// Says something of the adapter itself.
    pub fn log(&mut self, text: &str) {
        self.output("stderr", text, Value::Null);
    }

    fn send(&mut self, mut message: Value) {
        self.sequence += 1;
        message["seq"] = json!(self.sequence);
        self.messages.push(message);
    }

    pub(crate) fn event(&mut self, event: &str, body: Value) {
        self.send(json!({ "type": "event", "event": event, "body": body }));
    }

    pub(crate) fn output(&mut self, category: &str, text: &str, place: Value) {
        let mut body = json!({ "category": category, "output": format!("{text}\n") });
        for key in ["source", "line", "column"] {
            if let Some(value) = place.get(key) {
                body[key] = value.clone();
            }
        }
        self.event("output", body);
    }

    /// Answers a request by a failure.
    pub fn fail(&mut self, message: &Value, reason: &str) {
        self.answered += 1;
        let error = json!({ "id": 1, "format": reason.replace('{', "(").replace('}', ")"), "showUser": true });
        self.send(json!({
            "type": "response", "request_seq": message["seq"], "command": message["command"], "success": false,
            "message": reason, "body": { "error": error },
        }));
    }

    /// Answers a request.
    pub fn request(&mut self, message: &Value) {
        let (Some("request"), Some(command)) = (message["type"].as_str(), message["command"].as_str()) else {
            self.log("a message that is no request was not heeded");
            return;
        };
        match self.response(command, &message["arguments"]) {
            Ok(body) => {
                self.answered += 1;
                let mut response = json!({
                    "type": "response", "request_seq": message["seq"], "command": command, "success": true,
                });
                if !body.is_null() {
                    response["body"] = body;
                }
                // Events that the request led to come after its response.
                let events = std::mem::take(&mut self.messages);
                self.sequence -= events.len() as u64;
                self.send(response);
                events.into_iter().for_each(|event| self.send(event));
                self.follow(command);
            }
            Err(reason) => self.fail(message, &reason),
        }
    }

    /// What comes after a response.
    fn follow(&mut self, command: &str) {
        match command {
            "launch" => self.event("initialized", json!({})),
            "terminate" => self.terminated(),
            _ => {}
        }
    }

    fn response(&mut self, command: &str, arguments: &Value) -> Response {
        let needed = match command {
            "initialize" => return self.initialize(arguments),
            "disconnect" => {
                if let Some(target) = &self.target {
                    target.session.cancel();
                }
                self.phase = Phase::Ended;
                return Ok(Value::Null);
            }
            "launch" | "attach" => Phase::Initialized,
            "setBreakpoints"
            | "setFunctionBreakpoints"
            | "setDataBreakpoints"
            | "setExceptionBreakpoints"
            | "dataBreakpointInfo"
            | "breakpointLocations"
            | "configurationDone"
            | "threads"
            | "source"
            | "terminate" => Phase::Launched,
            "continue" | "next" | "stepIn" | "stepOut" | "stepBack" | "reverseContinue" | "pause" | "stackTrace"
            | "scopes" | "variables" | "setVariable" | "setExpression" | "evaluate" | "exceptionInfo" => {
                Phase::Configured
            }
            _ => return Err(format!("`{command}` is not supported")),
        };
        if self.phase < needed {
            let first = match self.phase {
                Phase::New => "initialize",
                Phase::Initialized => "launch",
                _ => "configurationDone",
            };
            return Err(format!("`{command}` comes too early: `{first}` comes first"));
        }
        let empty = Vec::new();
        let list = |name: &str| arguments[name].as_array().unwrap_or(&empty).clone();
        match command {
            "launch" => self.launch(arguments),
            "attach" => Err("there is nothing to attach to: launch a model or a scenario".to_string()),
            "configurationDone" => self.configured(),
            "threads" => {
                let target = self.target()?;
                let name = target.scene.script.as_ref().map_or(&target.scene.program.name, |script| &script.name);
                Ok(json!({ "threads": [{ "id": 1, "name": name }] }))
            }
            "setBreakpoints" => {
                let path = arguments["source"]["path"].as_str().unwrap_or_default().to_string();
                let wanted = match &arguments["breakpoints"] {
                    Value::Array(wanted) => wanted.clone(),
                    _ => list("lines").into_iter().map(|line| json!({ "line": line })).collect(),
                };
                let (target, breakpoints) = self.parts()?;
                Ok(json!({ "breakpoints": breakpoints.set_lines(target, &path, &wanted) }))
            }
            "setFunctionBreakpoints" => {
                let (target, breakpoints) = self.parts()?;
                Ok(json!({ "breakpoints": breakpoints.set_rules(target, &list("breakpoints")) }))
            }
            "setDataBreakpoints" => {
                let (target, breakpoints) = self.parts()?;
                Ok(json!({ "breakpoints": breakpoints.set_data(target, &list("breakpoints")) }))
            }
            "setExceptionBreakpoints" => {
                let mut filters = list("filters");
                filters.extend(list("filterOptions"));
                let (target, breakpoints) = self.parts()?;
                match breakpoints.set_filters(target, &filters) {
                    true => Ok(Value::Null),
                    false => Err("the filters are `faults` and `violations`".to_string()),
                }
            }
            "dataBreakpointInfo" => {
                let name = arguments["name"].as_str().unwrap_or_default();
                Ok(match breakpoints::location(self.target()?, name) {
                    Ok(_) => json!({
                        "dataId": name, "description": format!("{name} changes"), "accessTypes": ["write"],
                        "canPersist": true,
                    }),
                    Err(reason) => json!({ "dataId": null, "description": reason }),
                })
            }
            "breakpointLocations" => {
                let path = arguments["source"]["path"].as_str().unwrap_or_default();
                let number = |name: &str| arguments[name].as_u64().and_then(|line| u32::try_from(line).ok());
                let first = number("line").ok_or("`line` is a number")?;
                let last = number("endLine").unwrap_or(first);
                let lines = self.target()?.stops_between(path, first, last);
                Ok(json!({ "breakpoints": lines.iter().map(|line| json!({ "line": line })).collect::<Vec<_>>() }))
            }
            "continue" => {
                self.go(Going::On)?;
                Ok(json!({ "allThreadsContinued": true }))
            }
            "next" | "stepIn" | "stepOut" => self.go(Going::Step).map(|()| Value::Null),
            "stepBack" => self.go(Going::Back).map(|()| Value::Null),
            "reverseContinue" => self.go(Going::Rewind).map(|()| Value::Null),
            "pause" => {
                if self.going.is_some() {
                    self.paused = true;
                    self.parts()?.0.session.pause();
                }
                Ok(Value::Null)
            }
            "terminate" => {
                self.target()?.session.cancel();
                Ok(Value::Null)
            }
            "stackTrace" => {
                self.is_stopped()?;
                let target = self.target()?;
                let all = frames(target, target.session.moment().as_deref(), &self.breakpoints);
                let number = |name: &str| arguments[name].as_u64().and_then(|n| usize::try_from(n).ok()).unwrap_or(0);
                let (start, levels) = (number("startFrame"), number("levels"));
                let total = all.len();
                let levels = if levels == 0 { total } else { levels };
                let some: Vec<Value> = all.into_iter().skip(start).take(levels).collect();
                Ok(json!({ "stackFrames": some, "totalFrames": total }))
            }
            "scopes" => {
                self.is_stopped()?;
                let target = self.target.as_ref().ok_or("nothing is launched")?;
                Ok(json!({ "scopes": self.variables.scopes(target) }))
            }
            "variables" => {
                self.is_stopped()?;
                let reference = arguments["variablesReference"].as_u64().ok_or("`variablesReference` is a number")?;
                let target = self.target.as_mut().ok_or("nothing is launched")?;
                let answer = self.answer.as_ref().map(Answer::text);
                let all = self.variables.of(target, reference, answer)?;
                let number = |name: &str| arguments[name].as_u64().and_then(|n| usize::try_from(n).ok());
                let count = number("count").filter(|count| *count > 0).unwrap_or(usize::MAX);
                let some: Vec<Value> = all.into_iter().skip(number("start").unwrap_or(0)).take(count).collect();
                Ok(json!({ "variables": some }))
            }
            "setVariable" | "setExpression" => {
                self.is_stopped()?;
                let key = if command == "setVariable" { "name" } else { "expression" };
                let name = arguments[key].as_str().ok_or("what is to be set has a name")?;
                let value = arguments["value"].as_str().ok_or("`value` is a text")?;
                match name {
                    "choice" => self.choose(value),
                    _ => self.set(name, value),
                }
            }
            "evaluate" => self.evaluate(arguments),
            "exceptionInfo" => {
                let moment = self.target()?.session.moment();
                let fault = moment.as_ref().and_then(|moment| moment.faults.first());
                let fault = fault.ok_or("nothing is wrong here")?;
                Ok(json!({
                    "exceptionId": fault.id, "description": whole(fault), "breakMode": "always",
                    "details": { "message": whole(fault), "typeName": fault.id },
                }))
            }
            "source" => {
                let reference = arguments["sourceReference"].as_u64().unwrap_or_default();
                let text = self.target()?.text(reference).ok_or("there is no such source")?;
                Ok(json!({ "content": text }))
            }
            _ => Err(format!("`{command}` is not supported")),
        }
    }

    pub(crate) fn target(&self) -> Result<&Target, String> {
        self.target.as_ref().ok_or_else(|| "nothing is launched".to_string())
    }

    fn parts(&mut self) -> Result<(&mut Target, &mut Breakpoints), String> {
        let target = self.target.as_mut().ok_or("nothing is launched")?;
        Ok((target, &mut self.breakpoints))
    }

    fn is_stopped(&self) -> Result<(), String> {
        match self.going {
            Some(_) => Err("it is running: pause it first".to_string()),
            None if self.phase == Phase::Terminated => Err("the run has ended".to_string()),
            None => Ok(()),
        }
    }

    fn initialize(&mut self, arguments: &Value) -> Response {
        if self.phase != Phase::New {
            return Err("`initialize` comes once".to_string());
        }
        let from = |name: &str| u32::from(arguments[name].as_bool().unwrap_or(true));
        self.counting = Counting { lines: from("linesStartAt1"), columns: from("columnsStartAt1") };
        self.hears_invalidated = arguments["supportsInvalidatedEvent"] == true;
        self.phase = Phase::Initialized;
        Ok(json!({
            "supportsConfigurationDoneRequest": true,
            "supportsFunctionBreakpoints": true,
            "supportsConditionalBreakpoints": true,
            "supportsHitConditionalBreakpoints": true,
            "supportsLogPoints": true,
            "supportsDataBreakpoints": true,
            "supportsBreakpointLocationsRequest": true,
            "supportsExceptionInfoRequest": true,
            "exceptionBreakpointFilters": breakpoints::filters(),
            "supportsEvaluateForHovers": true,
            "supportsStepBack": true,
            "supportsSetVariable": true,
            "supportsSetExpression": true,
            "supportsTerminateRequest": true,
        }))
    }

    fn launch(&mut self, arguments: &Value) -> Response {
        if self.phase != Phase::Initialized {
            return Err("something is launched already".to_string());
        }
        let launch = Launch::read(arguments)?;
        let session = match launch.start(&mut self.workspace) {
            Ok(session) => session,
            Err(NotLaunched { message, faults }) => {
                if let Some(faults) = faults {
                    self.tell_faults(&faults.0, &faults.1);
                }
                return Err(message);
            }
        };
        let mut target = Target::new(session, self.counting);
        if launch.no_debug {
            self.breakpoints = Breakpoints::default();
        }
        self.breakpoints.tell(&mut target);
        (self.target, self.launch) = (Some(target), Some(launch));
        self.phase = Phase::Launched;
        Ok(Value::Null)
    }

    /// Writes out the faults of texts that cannot be run.
    fn tell_faults(&mut self, sources: &Sources, faults: &[Diagnostic]) {
        for fault in faults.iter().take(TOLD) {
            let source = sources.file(fault.primary.span.file);
            let at = Lines::new(Arc::clone(&source.text)).position(fault.primary.span.start as usize, Encoding::Utf16);
            let line = at.line + 1;
            let place = json!({
                "source": { "name": source.name, "path": source.name },
                "line": at.line + self.counting.lines, "column": at.column + self.counting.columns,
            });
            self.output("stderr", &format!("{}:{line}: {}", source.name, whole(fault)), place);
        }
    }

    fn configured(&mut self) -> Response {
        if self.phase != Phase::Launched {
            return Err("`configurationDone` comes once".to_string());
        }
        self.phase = Phase::Configured;
        // The initial state is being set; then it stops there, or goes on.
        self.going = Some(Going::Entry);
        Ok(Value::Null)
    }

    /// Lets the run go on, or back.
    pub(crate) fn go(&mut self, going: Going) -> Result<(), String> {
        self.is_stopped()?;
        let answer = self.answer.take();
        let target = self.target.as_mut().ok_or("nothing is launched")?;
        let session = &mut target.session;
        let begun = match going {
            Going::Back => session.back(),
            Going::Rewind => session.rewind(),
            Going::Entry | Going::Step | Going::On if session.is_asking() => {
                if answer.is_some() {
                    session.then(going == Going::On);
                }
                match answer {
                    Some(Answer::Input(location, value, _)) => session.set(location, Some(value)).map(|_| ()),
                    Some(Answer::Choice(candidate, _)) => session.choose(candidate),
                    None => Err(asks_for(target)),
                }
            }
            Going::Entry | Going::Step | Going::On if *session.waits() == Waits::End => {
                self.phase = Phase::Terminated;
                self.event("terminated", json!({}));
                return Ok(());
            }
            Going::Entry | Going::Step => session.step(1),
            Going::On => session.resume(),
        };
        begun?;
        self.going = Some(going);
        self.paused = false;
        self.variables.forget();
        Ok(())
    }

    fn set(&mut self, name: &str, value: &str) -> Response {
        let target = self.target.as_mut().ok_or("nothing is launched")?;
        let program = Arc::clone(&target.scene.program);
        let given = (value != "?").then_some(value);
        let (location, value) = target.session.read_input(name, given)?;
        let text = value.as_ref().map_or("?".to_string(), |value| value.show(&program).to_string());
        let is_asked = matches!(target.session.waits(), Waits::Input { location: asked, .. } if *asked == location);
        match value {
            // The step goes on when it is told to.
            Some(value) if is_asked => self.answer = Some(Answer::Input(location, value, text.clone())),
            None if is_asked => self.answer = None,
            value => _ = target.session.set(location, value)?,
        }
        self.variables.look_again();
        Ok(json!({ "value": text, "variablesReference": 0 }))
    }

    fn choose(&mut self, text: &str) -> Response {
        let target = self.target()?;
        let Waits::Choice { candidates, .. } = target.session.waits() else {
            return Err("no choice is asked for".to_string());
        };
        let numbered = || text.strip_prefix('#')?.parse::<usize>().ok()?.checked_sub(1);
        let named = candidates.iter().position(|values| candidate(target, values) == text.trim());
        let index = named.or_else(numbered).filter(|index| *index < candidates.len());
        let Some(index) = index else { return Err(asks_for(target)) };
        let text = candidate(target, &candidates[index]);
        self.answer = Some(Answer::Choice(index, text.clone()));
        Ok(json!({ "value": text, "variablesReference": 0 }))
    }

    fn evaluate(&mut self, arguments: &Value) -> Response {
        let text = arguments["expression"].as_str().ok_or("`expression` is a text")?;
        self.is_stopped()?;
        let result = |mut told: Value| {
            let value = told.as_object_mut().and_then(|told| told.remove("value"));
            told["result"] = value.unwrap_or_default();
            told
        };
        if arguments["context"] == "repl" {
            match typed(text) {
                Typed::Set(location, value) => {
                    let told = self.set(location, value).map(result)?;
                    if self.hears_invalidated {
                        self.event("invalidated", json!({ "areas": ["variables"] }));
                    }
                    return Ok(told);
                }
                Typed::Choose(candidate) => return self.choose(candidate).map(result),
                Typed::Term(_) => {}
            }
        }
        let text = text.trim().trim_end_matches(';');
        let target = self.target.as_mut().ok_or("nothing is launched")?;
        let value = target.session.evaluate(text)?;
        Ok(result(self.variables.told(target, Ok(value))))
    }

    /// The run is over.
    pub(crate) fn terminated(&mut self) {
        self.going = None;
        if self.phase < Phase::Terminated {
            self.phase = Phase::Terminated;
            self.event("terminated", json!({}));
        }
    }
}
