//! What a debugger asks to be launched: a model or a scenario, ready to run.
//!
//! In: the arguments of `launch`, and files. Out: a session that has set the initial state or is about to; or why there is none,
//! with all faults.

use std::path::Path;
use std::sync::Arc;

use groundstate::machine::Limits;
use groundstate::session::{Scene, Session, SessionOptions};
use groundstate::workspace::{Files, NotLoaded};
use groundstate::{Kind, Suite, Workspace, has_errors};
use serde_json::Value;
use syntax::{Diagnostic, Severity, Sources};

/// LIMIT: steps that can be taken back.
const HISTORY: usize = 1_000;

/// LIMIT: what one step may take.
const WORK: u64 = 20_000_000;

/// What is to be launched.
#[derive(Debug)]
pub struct Launch {
    /// The model or the scenario.
    pub program: String,
    /// Draws inputs and choices at random.
    pub seed: Option<u64>,
    /// Whether to stop in the initial state.
    pub stop_on_entry: bool,
    /// Whether nothing is to stop the run.
    pub no_debug: bool,
    /// Inputs, from the beginning on.
    pub inputs: Vec<(String, String)>,
}

/// Why nothing is launched.
#[derive(Debug)]
pub struct NotLaunched {
    /// A sentence.
    pub message: String,
    /// The faults of the texts.
    pub faults: Option<Box<(Sources, Vec<Diagnostic>)>>,
}

impl From<String> for NotLaunched {
    fn from(message: String) -> NotLaunched {
        NotLaunched { message, faults: None }
    }
}

impl Launch {
    /// Reads the arguments.
    ///
    /// # Errors
    /// A sentence: what is missing or wrong.
    pub fn read(arguments: &Value) -> Result<Launch, String> {
        let program = arguments["program"].as_str().filter(|program| !program.is_empty());
        let program = program.ok_or("`program` is the path of a model (.asm) or a scenario (.avalla)")?;
        let seed = match &arguments["seed"] {
            Value::Null => None,
            seed => Some(seed.as_u64().ok_or("`seed` is a whole number from 0")?),
        };
        let flag = |name: &str, otherwise: bool| match &arguments[name] {
            Value::Null => Ok(otherwise),
            Value::Bool(is) => Ok(*is),
            _ => Err(format!("`{name}` is true or false")),
        };
        let mut inputs = Vec::new();
        match &arguments["inputs"] {
            Value::Null => {}
            Value::Object(given) => {
                for (location, value) in given {
                    let value = match value {
                        Value::String(text) => text.clone(),
                        Value::Bool(_) | Value::Number(_) => value.to_string(),
                        _ => return Err(format!("the input `{location}` is a value as AsmetaL writes it, as a text")),
                    };
                    inputs.push((location.clone(), value));
                }
            }
            _ => return Err("`inputs` has values by location, such as { \"pressed\": \"true\" }".to_string()),
        }
        let no_debug = flag("noDebug", false)?;
        let stop_on_entry = flag("stopOnEntry", true)? && !no_debug;
        Ok(Launch { program: program.to_string(), seed, stop_on_entry, no_debug, inputs })
    }

    /// Loads what is to run, and begins.
    ///
    /// # Errors
    /// There is no such file, or it has errors.
    pub fn start<F: Files>(&self, workspace: &mut Workspace<F>) -> Result<Session, NotLaunched> {
        let scene = self.scene(workspace)?;
        if scene.script.is_none() && scene.program.main.is_none() {
            return Err(format!("{} is a module: it has no main rule to run", self.program).into());
        }
        if scene.script.is_some() && !self.inputs.is_empty() {
            return Err("a scenario gives the inputs itself: `inputs` is for models".to_string().into());
        }
        let mut given = Vec::new();
        for (location, value) in &self.inputs {
            given.push(scene.read_input(location, value)?);
        }
        let limits = Limits { work: WORK, ..Limits::default() };
        let options = SessionOptions {
            seed: self.seed,
            history: HISTORY,
            passes_violations: true,
            given,
            recorded: None,
            limits,
            watched: None,
            begins: false,
        };
        Session::open(Arc::new(scene), options).map_err(|error| format!("the run cannot be started: {error}").into())
    }

    fn scene<F: Files>(&self, workspace: &mut Workspace<F>) -> Result<Scene, NotLaunched> {
        let path = self.program.as_str();
        match Kind::of(Path::new(path)) {
            Some(Kind::Model) => match workspace.load(path) {
                Ok(loaded) => Ok(Scene::from(&*loaded)),
                Err(NotLoaded::Absent(absent)) => Err(absent.told(path).into()),
                Err(NotLoaded::Faulty(faulty)) => Err(faulty_texts(path, faulty.sources, faulty.diagnostics)),
            },
            Some(Kind::Scenario) => {
                let source = workspace.text(path).map_err(|absent| absent.told(path))?;
                let staged = Suite::new().stage(source, &mut workspace.texts());
                staged.map_err(|tested| faulty_texts(path, tested.sources, tested.diagnostics))
            }
            Some(Kind::Chart) => {
                Err(format!("{path} is a chart: debug the model that `groundstate chart build` makes of it").into())
            }
            Some(Kind::Report | Kind::Verification | Kind::Coupling) | None => {
                Err(format!("{path} is neither a model (.asm) nor a scenario (.avalla)").into())
            }
        }
    }
}

fn faulty_texts(path: &str, sources: Sources, diagnostics: Vec<Diagnostic>) -> NotLaunched {
    let errors: Vec<Diagnostic> = diagnostics.into_iter().filter(|fault| fault.severity == Severity::Error).collect();
    debug_assert!(has_errors(&errors));
    let first = errors.first().map(|fault| fault.message.clone()).unwrap_or_default();
    let message = match errors.len() {
        1 => format!("{path} cannot be run: {first}"),
        many => format!("{path} cannot be run: it has {many} errors, first: {first}"),
    };
    NotLaunched { message, faults: Some(Box::new((sources, errors))) }
}
