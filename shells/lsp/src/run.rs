//! The state at the cursor: sessions that run models and scenarios for an editor, by requests of their own (docs/editors.md).
//!
//! In: `groundstate/session/…` with parameters as JSON. Out: [`SessionState`] as JSON. A session has the texts that it was opened
//! with, whatever is typed since. LIMIT: so many sessions, steps of a request, and steps that can be taken back; a step that is
//! longer than [`WORK`] is a fault.

use std::collections::BTreeMap;
use std::path::Path;
use std::sync::Arc;
use std::time::Duration;

use groundstate::machine::{Limits, Show, Value as ModelValue};
use groundstate::report::{LivePart, render_timeline};
use groundstate::reporting::Watched;
use groundstate::session::{Heard, Scene, Session, SessionOptions, Waits};
use groundstate::{Kind, Overlay};
use ide::{Encoding, Lines};
use lsp_server::ErrorCode;
use lsp_types::{Position, Range};
use serde_json::Value;
use syntax::{Span, Stop};
use wire::{Named, SESSION_VERSION, SessionState, Waiting, Written, Wrong, written_state};

use crate::answer::Answers;
use crate::location::{path_of, uri_of};
use crate::route::Refused;

/// LIMIT: sessions that are open at a time.
const SESSIONS: usize = 16;

/// LIMIT: steps of one request.
const STEPS: u64 = 10_000;

/// LIMIT: steps that can be taken back.
const HISTORY: usize = 1_000;

/// LIMIT: what one step may take.
const WORK: u64 = 20_000_000;

/// LIMIT: so many candidates of a choice are shown; others can be chosen by their number.
const OFFERED: usize = 100;

/// How often a request that waits looks whether it was cancelled.
const LOOK: Duration = Duration::from_millis(20);

/// The beginning of the methods.
pub const PREFIX: &str = "groundstate/session/";

type Place = lsp_types::Location;
type State = SessionState<Place>;

/// The sessions that are open.
#[derive(Debug, Default)]
pub struct Sessions {
    last: u64,
    open: BTreeMap<u64, Open>,
}

#[derive(Debug)]
struct Open {
    session: Session,
    texts: Texts,
    /// What stops [`Open::resume`] when it becomes true.
    breaks: Vec<String>,
    refused: Option<String>,
    /// Why there is no timeline.
    unwatched: Option<String>,
}

/// The texts that a session was opened with, and how columns are counted.
#[derive(Debug)]
struct Texts {
    lines: BTreeMap<String, Lines>,
    /// The one that is in no file.
    unsaved: Option<String>,
    encoding: Encoding,
}

/// LIMIT: terms of one request.
const TERMS: usize = 1_000;

/// The texts of terms.
fn terms(params: &Value) -> Result<Vec<String>, Refused> {
    let list = params["terms"].as_array().ok_or_else(|| wrong("`terms` is a list of texts"))?;
    match list.len() > TERMS {
        true => Err(wrong(format!("at most {TERMS} terms at a time"))),
        false => Ok(list.iter().filter_map(Value::as_str).map(str::to_string).collect()),
    }
}

fn wrong(message: impl Into<String>) -> Refused {
    Refused::new(ErrorCode::InvalidParams, message)
}

fn failed(message: impl Into<String>) -> Refused {
    Refused::new(ErrorCode::RequestFailed, message)
}

/// Answers a request of a session.
///
/// # Errors
/// There is no such session or method, the model cannot run, or parameters are missing.
pub fn answer(
    sessions: &mut Sessions,
    answers: &mut Answers,
    method: &str,
    params: &Value,
    stop: &Stop,
) -> Result<Value, Refused> {
    let id = match method {
        "open" => sessions.open(answers, params)?,
        _ => params["session"].as_u64().ok_or_else(|| wrong("`session` is the number of one"))?,
    };
    if method == "close" {
        sessions.open.remove(&id);
        return Ok(Value::Null);
    }
    let mut open = sessions.open.remove(&id).ok_or_else(|| wrong(format!("there is no session {id}")))?;
    if let "evaluate" | "timeline" | "scenario" = method {
        let told = match method {
            "evaluate" => open.values(params),
            "timeline" => open.timeline(),
            _ => open.scenario(params),
        };
        sessions.open.insert(id, open);
        return told;
    }
    open.refused = None;
    let kept = open.carry_out(method, params, stop);
    let stale = open
        .texts
        .lines
        .iter()
        .filter(|(path, _)| open.texts.unsaved.as_ref() != Some(path))
        .any(|(path, lines)| answers.project.text(path).map_or(true, |source| source.text != *lines.text()));
    let told = serde_json::to_value(State { session: id, stale, ..open.told() });
    if kept? {
        sessions.open.insert(id, open);
    }
    told.map_err(|error| Refused::new(ErrorCode::InternalError, error.to_string()))
}

impl Sessions {
    /// Opens a session on a model or a scenario.
    fn open(&mut self, answers: &mut Answers, params: &Value) -> Result<u64, Refused> {
        let uri = params.pointer("/textDocument/uri").and_then(Value::as_str).and_then(|uri| uri.parse().ok());
        let no_text = || wrong("`textDocument.uri` is a model or a scenario");
        let path = uri.as_ref().and_then(path_of).ok_or_else(no_text)?;
        if self.open.len() >= SESSIONS {
            return Err(failed(format!("{SESSIONS} sessions are open: close one first")));
        }
        let unsaved = params["scenario"].as_str();
        let scene = match (unsaved, Kind::of(Path::new(&path))) {
            (Some(text), _) => answers.project.stage_text(&beside(&path), text).map_err(failed)?,
            (None, Some(Kind::Scenario)) => answers.project.stage(&path).map_err(failed)?,
            (None, _) => Scene::from(&*answers.project.load(&path).map_err(failed)?),
        };
        if scene.script.is_none() && scene.program.main.is_none() {
            return Err(failed("a module has no main rule to run"));
        }
        let seed = params["seed"].as_u64();
        let recorded = recorded(&scene, &params["inputs"], seed.unwrap_or(0))?;
        let (scene, watched) = watched(answers, scene);
        let files = scene
            .sources
            .iter()
            .filter(|(_, source)| ide::library_text(&source.name).is_none() && !source.name.starts_with('<'));
        let of = unsaved.map(|_| beside(&path));
        let lines = files.map(|(_, source)| (source.name.clone(), Lines::new(Arc::clone(&source.text)))).collect();
        let texts = Texts { lines, unsaved: of, encoding: answers.settings.encoding };
        let options = SessionOptions {
            seed,
            history: HISTORY,
            passes_violations: false,
            given: Vec::new(),
            recorded,
            limits: Limits { work: WORK, ..Limits::default() },
            watched: watched.as_ref().ok().map(Arc::clone),
            begins: params["begins"].as_bool().unwrap_or(false),
        };
        let session = Session::open(Arc::new(scene), options).map_err(|error| failed(error.to_string()))?;
        self.last += 1;
        let unwatched = watched.err();
        self.open.insert(self.last, Open { session, texts, breaks: Vec::new(), refused: None, unwatched });
        Ok(self.last)
    }
}

/// The name of a scenario that is in no file: it loads what lies beside this model.
fn beside(model: &str) -> String {
    let folder = model.rfind('/').map_or("", |end| &model[..=end]);
    format!("{folder}<unsaved>.avalla")
}

/// Inputs by step, from the text of a file; what it leaves to chance is drawn by the seed.
fn recorded(scene: &Scene, file: &Value, seed: u64) -> Result<Option<Arc<simulate::Named>>, Refused> {
    if file.is_null() {
        return Ok(None);
    }
    let (Some(name), Some(text)) = (file["name"].as_str(), file["text"].as_str()) else {
        return Err(wrong("`inputs` has the `name` and the `text` of a file"));
    };
    if scene.script.is_some() {
        return Err(failed("the scenario gives the inputs: change its text"));
    }
    let form = inputs::Form::of(Path::new(name)).ok_or_else(|| failed(format!("{name} is neither YAML nor CSV")))?;
    let lines = Lines::new(Arc::from(text));
    let first = |faults: Vec<syntax::Diagnostic>| {
        let Some(fault) = faults.first() else { return failed(name.to_string()) };
        let at = lines.position(fault.primary.span.start as usize, Encoding::Utf16);
        failed(format!("{name}:{}: {}", at.line + 1, fault.message))
    };
    let named = inputs::named(&scene.program, form, syntax::FileId(0), text);
    named.map(|named| Some(Arc::new(named.seeded(seed)))).map_err(first)
}

/// What the timeline of a scene shows, with its terms in the scene; or why there is no timeline.
fn watched(answers: &mut Answers, scene: Scene) -> (Scene, Result<Arc<Watched>, String>) {
    let Some(place) = scene.main_place() else { return (scene, Err("there is no main rule".to_string())) };
    let model = scene.sources.file(place.file).name.clone();
    let mut asked = scene.overlay();
    let watched = answers.project.specification(&model, &scene.program).and_then(|specification| {
        let name = specification.name.clone();
        Watched::new(&mut asked, specification).map_err(|faults| {
            let fault = faults.first().map_or_else(String::new, |fault| fault.message.clone());
            format!("{name}: {fault}")
        })
    });
    match watched {
        Ok(watched) => {
            let Overlay { sources, model, program } = asked;
            (Scene { sources, model, program, ..scene }, Ok(Arc::new(watched)))
        }
        Err(reason) => (scene, Err(reason)),
    }
}

impl Open {
    /// The value of each term; none where there is none now.
    fn values(&mut self, params: &Value) -> Result<Value, Refused> {
        let terms = terms(params)?;
        let program = Arc::clone(&self.session.scene().program);
        let shown = |term: &String| {
            let value = self.session.evaluate(term).ok()?;
            Some(value.show(&program).briefly().to_string())
        };
        let values: Vec<Option<String>> = terms.iter().map(shown).collect();
        Ok(serde_json::json!({ "values": values }))
    }

    /// The run so far as a scenario.
    fn scenario(&self, params: &Value) -> Result<Value, Refused> {
        let (Some(name), Some(model)) = (params["name"].as_str(), params["model"].as_str()) else {
            return Err(wrong("`name` and `model` are texts"));
        };
        let text = self.session.scenario(name, model).map_err(failed)?;
        Ok(serde_json::json!({ "text": text }))
    }

    /// The lanes of the run so far, as the page of a report has them.
    fn timeline(&self) -> Result<Value, Refused> {
        if let Some(reason) = &self.unwatched {
            return Err(failed(reason.as_str()));
        }
        let Some(report) = self.session.timeline() else { return Ok(Value::Null) };
        let LivePart { markup, run, style } = render_timeline(&report);
        let run: Value =
            serde_json::from_str(&run).map_err(|error| Refused::new(ErrorCode::InternalError, error.to_string()))?;
        let (steps, first) = (report.steps(), u64::from(!report.from_initial));
        Ok(serde_json::json!({
            "steps": steps, "first": first, "empty": !report.has_lanes(), "markup": markup, "run": run, "style": style
        }))
    }

    /// Makes steps until a term of the breaks becomes true, the run waits for something or ends, or so many are made. Out: whether the
    /// session goes on.
    fn resume(&mut self, steps: u64, stop: &Stop) -> Result<bool, Refused> {
        let mut before = self.broken();
        for _ in 0..steps {
            if let Err(reason) = self.session.step(1) {
                self.refused = Some(reason);
                return Ok(true);
            }
            if !self.wait(false, stop)? {
                return Ok(false);
            }
            let is_done = self.refused.is_some() || !matches!(self.session.waits(), Waits::Step | Waits::Runs);
            let now = self.broken();
            let is_hit = now.iter().zip(&before).any(|(now, before)| *now && !before);
            let is_wrong = self.session.moment().is_some_and(|moment| !moment.faults.is_empty());
            if is_done || is_hit || is_wrong {
                break;
            }
            before = now;
        }
        Ok(true)
    }

    /// Which breaks are true. What cannot be evaluated is: whoever wrote it wants to know.
    fn broken(&mut self) -> Vec<bool> {
        let breaks = self.breaks.clone();
        breaks.iter().map(|term| !matches!(self.session.evaluate(term), Ok(ModelValue::Boolean(false)))).collect()
    }

    /// Carries out a request. Out: whether the session goes on.
    fn carry_out(&mut self, method: &str, params: &Value, stop: &Stop) -> Result<bool, Refused> {
        let is_asking = self.session.is_asking();
        let value = |value: &Value| match value {
            Value::Null => Ok(None),
            Value::String(text) => Ok(Some(text.clone())),
            _ => Err(wrong("`value` is a text, as AsmetaL writes it, or null")),
        };
        let session = &mut self.session;
        let begun = match method {
            "open" => Ok(()),
            "step" => session.step(params["steps"].as_u64().unwrap_or(1).clamp(1, STEPS)),
            "back" => session.back(),
            "set" => {
                let location = params["location"].as_str().ok_or_else(|| wrong("`location` is a text"))?;
                let value = value(&params["value"])?;
                let read = session.read_input(location, value.as_deref());
                match read.and_then(|(location, value)| session.set(location, value)) {
                    Ok(true) => Ok(()),
                    Ok(false) => return Ok(true),
                    Err(reason) => Err(reason),
                }
            }
            "answer" => session.answer(&value(&params["value"])?.ok_or_else(|| wrong("`value` is a text"))?),
            "choose" => {
                let candidate = params["candidate"].as_u64().ok_or_else(|| wrong("`candidate` is a number from 0"))?;
                session.choose(usize::try_from(candidate).unwrap_or(usize::MAX))
            }
            "breaks" => {
                self.breaks = terms(params)?;
                return Ok(true);
            }
            "resume" => return self.resume(params["steps"].as_u64().unwrap_or(STEPS).clamp(1, STEPS), stop),
            "state" => return Ok(true),
            other => return Err(Refused::new(ErrorCode::MethodNotFound, format!("{PREFIX}{other} is not known"))),
        };
        match begun {
            Ok(()) => self.wait(is_asking && method != "back", stop),
            Err(reason) => {
                self.refused = Some(reason);
                Ok(true)
            }
        }
    }

    /// Waits until the run waits. Where it was asking, a refusal leaves it as it was. Out: whether the session goes on.
    fn wait(&mut self, is_asking: bool, stop: &Stop) -> Result<bool, Refused> {
        loop {
            match self.session.hear(LOOK) {
                Heard::Waits => return Ok(true),
                Heard::Refused(reason) => {
                    self.refused = Some(reason);
                    if is_asking {
                        return Ok(true);
                    }
                }
                Heard::Nothing if stop.is_asked() => {
                    self.session.cancel();
                    return Ok(false);
                }
                // Breaks of these sessions say nothing.
                Heard::Nothing | Heard::Said(..) => {}
                Heard::Gone => return Err(Refused::new(ErrorCode::InternalError, "the run is gone")),
            }
        }
    }

    /// What is told of the session.
    fn told(&mut self) -> State {
        let scene = Arc::clone(self.session.scene());
        let program = &scene.program;
        let state = written_state(&self.session.state(), program);
        let place = |span| self.texts.place(&scene, span);
        let moment = self.session.moment();
        let ended = moment.as_ref().and_then(|moment| moment.end);
        let mut bounds = None;
        let (waiting, word, offered, at) = match self.session.waits() {
            Waits::Input { location, values, bounds: ends } => {
                bounds = ends.map(|(least, most)| [least, most]);
                let offered = values.iter().map(|value| value.show(program).to_string()).collect();
                (Waiting::Input, Some(location.show(program).to_string()), offered, None)
            }
            Waits::Choice { span, candidates } => {
                let shown = |values: &Vec<ModelValue>| {
                    values.iter().map(|value| value.show(program).briefly().to_string()).collect::<Vec<_>>().join(", ")
                };
                (Waiting::Choice, None, candidates.iter().take(OFFERED).map(shown).collect(), place(*span))
            }
            Waits::End => (Waiting::Nothing, ended.map(str::to_string), Vec::new(), None),
            Waits::Step | Waits::Runs => (Waiting::Step, None, Vec::new(), None),
        };
        let mut told = State {
            version: SESSION_VERSION,
            session: 0,
            step: 0,
            waiting,
            word,
            offered,
            bounds,
            at,
            state,
            updates: Vec::new(),
            unchanged: Vec::new(),
            rules: Vec::new(),
            faults: Vec::new(),
            next: None,
            refused: self.refused.clone(),
            stale: false,
        };
        let Some(moment) = moment else { return told };
        told.step = moment.step;
        told.next = moment.next.and_then(place);
        told.updates = moment
            .changes
            .iter()
            .filter_map(|change| Some(Written::new(change, program, place(change.span)?)))
            .collect();
        told.unchanged = moment.idle.iter().filter_map(|span| place(*span)).collect();
        for rule in &moment.ran {
            let Some((name, span)) = scene.rule_at(program.rule_span(*rule)) else { continue };
            let Some(at) = place(span) else { continue };
            let named = Named { name: name.to_string(), at };
            if !told.rules.contains(&named) {
                told.rules.push(named);
            }
        }
        told.faults = moment.faults.iter().filter_map(|fault| Wrong::new(fault, &place)).collect();
        told
    }
}

impl Texts {
    /// A place of the texts; none in a library.
    fn place(&self, scene: &Scene, span: Span) -> Option<Place> {
        let path = &scene.sources.file(span.file).name;
        let lines = self.lines.get(path)?;
        let at = |offset: u32| {
            let at = lines.position(offset as usize, self.encoding);
            Position::new(at.line, at.column)
        };
        Some(Place { uri: uri_of(path)?, range: Range::new(at(span.start), at(span.end)) })
    }
}
