//! The requests that begin with `studio/`: files, jobs, what is there (docs/studio.md).
//!
//! In: a method and parameters as JSON. Out: the answer as JSON, or a sentence for the user. It may wait for the disk.

use std::path::Path;
use std::sync::Arc;

use groundstate::Kind;
use ide::library_text;
use lsp::{Folder as Part, project_files, uri_of};
use serde_json::{Value, json};
use tokio::sync::mpsc::Sender;

use crate::folder::Folder;
use crate::home::Home;
use crate::program::{self, Plan};
use crate::studio::Studio;
use crate::tell::Out;
use crate::{generated, inputs, job, machines, model, names, sources};

/// The version of these requests. A change that would mislead a front end raises it.
const VERSION: u32 = 1;

/// What `new` makes folders from, with the words for the user.
const TEMPLATES: [(&str, &str); 3] = [
    ("machine", "A control-state machine with inputs"),
    ("system", "Tasks at several rates, and channels between them"),
    ("robot", "A vision-based robot: a system with a camera, and its C++ program"),
];

/// Answers a request of a tab.
///
/// # Errors
/// It is refused; a sentence.
pub fn answer(
    studio: &Arc<Studio>,
    tab: u64,
    out: &Sender<Out>,
    method: &str,
    params: &Value,
) -> Result<Value, String> {
    let text = |key: &str| params[key].as_str().ok_or_else(|| format!("`{key}` is a text"));
    match method {
        "studio/hello" => Ok(hello(&studio.folder, studio.read_only)),
        "studio/read" => match params["uri"].as_str() {
            Some(uri) => Ok(json!({ "text": library(uri)? })),
            None => {
                let path = text("path")?;
                known(path)?;
                let (text, hash) =
                    studio.store().read(&studio.folder, path)?.ok_or_else(|| format!("there is no {path}"))?;
                Ok(json!({ "text": text, "hash": hash }))
            }
        },
        "studio/write" => {
            writable(studio)?;
            let (path, content) = (text("path")?, text("text")?);
            known(path)?;
            let base = match &params["base"] {
                Value::Null => None,
                Value::String(hash) => Some(hash.as_str()),
                _ => return Err("`base` is a hash or null".to_string()),
            };
            // Others are told in the order of the writing.
            let mut store = studio.store();
            let wrote = store.write(&studio.folder, path, content, base)?;
            match &wrote {
                crate::store::Wrote::As(hash) => {
                    changed(studio, path, Some((content.to_string(), hash.clone())), Some(tab));
                }
                crate::store::Wrote::Merged(hash, text) => {
                    changed(studio, path, Some((text.clone(), hash.clone())), Some(tab));
                }
                crate::store::Wrote::Not { .. } => {}
            }
            drop(store);
            if base.is_none() {
                studio.tell("studio/files", &json!({ "files": files(&studio.folder) }), None);
            }
            Ok(wrote.json())
        }
        "studio/names" => names::of(&studio.folder, text("path")?, &paths(&studio.folder)),
        "studio/machine" => machines::of(&studio.folder, text("path")?, text("name")?, &paths(&studio.folder)),
        "studio/rename" => {
            writable(studio)?;
            rename(studio, tab, &params["files"])
        }
        "studio/delete" => {
            writable(studio)?;
            let path = text("path")?;
            known(path)?;
            let mut store = studio.store();
            let held = store.remove(&studio.folder, path)?;
            changed(studio, path, None, Some(tab));
            drop(store);
            studio.tell("studio/files", &json!({ "files": files(&studio.folder) }), None);
            Ok(json!({ "text": held }))
        }
        "studio/generated" => match params["file"].as_str() {
            Some(file) => generated::text(&studio.folder, text("path")?, file),
            None => generated::list(&studio.folder, text("path")?),
        },
        "studio/inputs" => match params["file"].as_str() {
            Some(file) => inputs::text(&studio.folder, file),
            None => inputs::list(&studio.folder, text("path")?),
        },
        "studio/new" => {
            writable(studio)?;
            create(studio, text("template")?, text("name")?)
        }
        "studio/extract" => extract(studio, text("path")?),
        "studio/model" => model::agreement(studio, text("path")?),
        "studio/job" => start(studio, tab, out, params),
        "studio/stop" => {
            let number = params["job"].as_u64().ok_or("`job` is the number of one")?;
            match studio.jobs.stop(tab, number) {
                true => Ok(json!({})),
                false => Err(format!("no job {number} of this tab runs")),
            }
        }
        _ => Err(format!("{method} is not known")),
    }
}

/// Starts a job. Out: its number, the texts that it looks at, and of scenarios the models that they load.
fn start(studio: &Arc<Studio>, tab: u64, out: &Sender<Out>, params: &Value) -> Result<Value, String> {
    let job = params["job"].as_str().ok_or("`job` is a text")?;
    let (path, chart) = (params["path"].as_str().unwrap_or_default(), params["chart"].as_str());
    for path in [path].into_iter().filter(|path| !path.is_empty()).chain(chart) {
        studio.folder.place(path)?;
    }
    if matches!(job, "build" | "generate" | "program") {
        writable(studio)?;
    }
    let home = match job {
        "generate" | "program" => Some(Home::of(&studio.folder, path)?),
        _ => None,
    };
    home.iter().try_for_each(|home| generated::may_be_written(&studio.folder, home))?;
    let is_model = Kind::of(Path::new(path)) == Some(Kind::Model);
    let scenarios = match job {
        "test" | "mutate" if is_model => inputs::scenarios(&studio.folder, path)?,
        _ => Vec::new(),
    };
    // What they are is known before the job reads them: what is changed meanwhile is told as a change.
    let begun = |number: u64, texts: Value| {
        let loads = if job == "test" { sources::loads(&studio.folder, &scenarios) } else { json!([]) };
        json!({ "job": number, "texts": texts, "loads": loads, "folder": home.as_ref().map(|home| &home.path) })
    };
    let texts = || sources::known(studio, &sources::of_job(&studio.folder, job, path, &scenarios, chart));
    if let ("program", Some(home)) = (job, &home) {
        let plan = Plan::of(path, home, &params["options"])?;
        let texts = texts()?;
        let own = Arc::clone(studio);
        let work = move |task: &job::Task| program::run(task, &own.folder, &plan);
        return Ok(begun(studio.jobs.start_work(tab, out.clone(), work)?, texts));
    }
    let mut words = job::words(job, path, &params["options"])?;
    words.extend(home.iter().flat_map(Home::words));
    if job == "test" && is_model {
        if scenarios.is_empty() {
            return Err(format!("there are no scenarios beside {path}"));
        }
        job::of_scenarios(&mut words, &scenarios);
    }
    let texts = if path.is_empty() { json!([]) } else { texts()? };
    Ok(begun(studio.jobs.start(tab, &words, out.clone())?, texts))
}

/// Gives files other names, and tells the other tabs. Out: what they are called now.
fn rename(studio: &Studio, tab: u64, files: &Value) -> Result<Value, String> {
    let of = |file: &'_ Value| Some((file["path"].as_str()?.to_string(), file["to"].as_str()?.to_string()));
    let moves: Option<Vec<_>> = files.as_array().and_then(|files| files.iter().map(of).collect());
    let moves = moves.ok_or("`files` has `path` and `to` of each")?;
    let moves: Vec<_> = moves.iter().map(|(path, to)| (path.as_str(), to.as_str())).collect();
    for (path, to) in &moves {
        known(path)?;
        if kind(path) != kind(to) {
            return Err(format!("{path} and `{}` are not of one kind", to.escape_debug()));
        }
    }
    let mut store = studio.store();
    store.rename(&studio.folder, &moves)?;
    let file = |(path, to): &(&str, &str)| {
        let uri = studio.folder.place(to).ok().and_then(|place| uri_of(&place.to_string_lossy()));
        json!({ "path": path, "to": to, "uri": uri.map(|uri| uri.as_str().to_string()) })
    };
    let renamed = json!({ "files": moves.iter().map(file).collect::<Vec<_>>() });
    // In the order of the writing, as texts are.
    studio.tell("studio/renamed", &renamed, Some(tab));
    drop(store);
    studio.tell("studio/files", &json!({ "files": self::files(&studio.folder) }), None);
    Ok(renamed)
}

/// Tells other tabs what a file is now.
pub fn changed(studio: &Studio, path: &str, now: Option<(String, String)>, but: Option<u64>) {
    let (text, hash) = now.unzip();
    studio.tell("studio/changed", &json!({ "path": path, "hash": hash, "text": text }), but);
}

fn writable(studio: &Studio) -> Result<(), String> {
    match studio.read_only {
        true => Err("this studio was started with --read-only".to_string()),
        false => Ok(()),
    }
}

/// Only files of the project's kinds are edited; nothing else of the folder is shown or touched.
fn known(path: &str) -> Result<(), String> {
    match Kind::of(std::path::Path::new(path)) {
        Some(_) => Ok(()),
        None => Err(format!("`{}` is no model, chart, scenario or specification", path.escape_debug())),
    }
}

/// The text of a built-in library.
///
/// # Errors
/// It is none; a sentence.
pub fn library(uri: &str) -> Result<String, String> {
    let path = uri.parse().ok().and_then(|uri| lsp::path_of(&uri)).unwrap_or_default();
    let library = library_text(&path).ok_or_else(|| format!("{uri} is no file of a library"))?;
    Ok(library.text.to_string())
}

/// What a front end is told first.
pub fn hello(folder: &Folder, is_read_only: bool) -> Value {
    let root = folder.root();
    let library = ide::library_names();
    let library = library.iter().filter_map(|name| {
        let uri = uri_of(name)?;
        Some(json!({ "path": name, "uri": uri.as_str(), "kind": kind(name)? }))
    });
    json!({
        "version": VERSION,
        "program": env!("CARGO_PKG_VERSION"),
        "name": root.file_name().and_then(|name| name.to_str()).unwrap_or("/"),
        "root": uri_of(&root.to_string_lossy()).map(|uri| uri.as_str().to_string()),
        "readOnly": is_read_only,
        "files": files(folder),
        "library": library.collect::<Vec<_>>(),
        "templates": TEMPLATES.map(|(name, title)| json!({ "name": name, "title": title })),
    })
}

/// The files of the folder, in order.
pub fn files(folder: &Folder) -> Vec<Value> {
    let root = folder.root().to_string_lossy().into_owned();
    let found = project_files(&[Part { path: root, whole: true }]);
    let of = |path: &String| {
        let uri = uri_of(path)?;
        let name = folder.relative(std::path::Path::new(path))?;
        Some(json!({ "path": name, "uri": uri.as_str(), "kind": kind(&name)? }))
    };
    found.iter().filter_map(of).collect()
}

fn paths(folder: &Folder) -> Vec<String> {
    files(folder).iter().filter_map(|file| file["path"].as_str().map(str::to_string)).collect()
}

fn kind(path: &str) -> Option<&'static str> {
    Some(match Kind::of(std::path::Path::new(path))? {
        Kind::Model => "model",
        Kind::Scenario => "scenario",
        Kind::Chart => "chart",
        Kind::Report => "report",
        Kind::Verification => "verification",
        Kind::Coupling => "coupling",
    })
}

/// The chart of a model's rules, as `groundstate chart extract` writes it.
fn extract(studio: &Studio, path: &str) -> Result<Value, String> {
    if kind(path) != Some("model") {
        return Err(format!("`{}` is no model", path.escape_debug()));
    }
    studio.folder.place(path)?;
    let made = studio.jobs.at_once(&["chart", "extract", &format!("./{path}"), "--quiet"])?;
    match made.status.success() {
        true => Ok(json!({ "text": String::from_utf8_lossy(&made.stdout) })),
        false => {
            let told = String::from_utf8_lossy(&made.stderr);
            let reason = told.lines().find(|line| !line.trim().is_empty()).unwrap_or_default();
            // A fault comes with its name, the reason why there is no chart without one.
            let reason =
                reason.split_once(": ").filter(|(word, _)| word.starts_with("error")).map_or(reason, |(_, it)| it);
            Err(format!("{path} has no chart: {reason}"))
        }
    }
}

/// A folder from a template, made by `groundstate new`.
fn create(studio: &Studio, template: &str, name: &str) -> Result<Value, String> {
    if !TEMPLATES.iter().any(|(known, _)| *known == template) {
        return Err(format!("`{}` is no template", template.escape_debug()));
    }
    // A folder of this one, not of another.
    if name.contains('/') {
        return Err(format!("`{}` is no name for a folder", name.escape_debug()));
    }
    studio.folder.place(name)?;
    let words = ["new", &format!("./{name}"), "--template", template, "--quiet"];
    let made = studio.jobs.at_once(&words)?;
    if !made.status.success() {
        let told = String::from_utf8_lossy(&made.stderr);
        return Err(told.trim().trim_start_matches("error: ").to_string());
    }
    let files = files(&studio.folder);
    studio.tell("studio/files", &json!({ "files": files }), None);
    let inside = format!("{name}/");
    let mut paths = files.iter().filter_map(|file| file["path"].as_str()).filter(|path| path.starts_with(&inside));
    let open = paths.clone().find(|path| path.ends_with(".chart")).or_else(|| paths.next());
    Ok(json!({ "open": open }))
}
