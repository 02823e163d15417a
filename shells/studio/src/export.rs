//! A project as a site that any static server shows, read only: its texts, charts, a run of each model, verdicts.
//!
//! In: a folder. Out: the studio's front end beside one file, `project.json`, that answers what it asks: the same requests, answered
//! once. Nothing in it tells where the folder lay. LIMIT: steps of a run, seconds of a verification.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

use lsp_server::{Connection, Message, Notification, Request};
use serde_json::{Value, json};

use crate::asset::Front;
use crate::folder::Folder;
use crate::job::{Jobs, words};
use crate::request::{hello, library};

/// LIMIT: steps of a recorded run.
const STEPS: usize = 60;
/// LIMIT: guards whose values are in it.
const GUARDS: usize = 200;
/// LIMIT: seconds of a verification.
const SECONDS: u64 = 20;
/// Where the folder is said to lie.
const ROOT: &str = "file:///project";

/// What an export is told.
#[derive(Debug, Clone)]
pub struct Export {
    /// The project.
    pub folder: PathBuf,
    /// Where the site goes: a folder that is empty or is made.
    pub site: PathBuf,
    /// This program, for verdicts.
    pub program: PathBuf,
}

/// Writes the site. Out: the number of files of the project in it. `tell` hears what is being done.
///
/// # Errors
/// The folder cannot be read, the site cannot be written, or is not empty; a sentence.
pub fn export(export: &Export, mut tell: impl FnMut(&str)) -> Result<usize, String> {
    let Some(page) = Front::get("index.html") else {
        return Err("this program was built without the studio's pages: build it by `make studio`".to_string());
    };
    let folder = Folder::at(&export.folder)?;
    let cannot = |error: std::io::Error| format!("{} cannot be written: {error}", export.site.display());
    let is_empty = std::fs::read_dir(&export.site).map(|mut entries| entries.next().is_none());
    match is_empty {
        Ok(true) => {}
        Ok(false) => return Err(format!("{} is not empty: nothing was written", export.site.display())),
        Err(_) => std::fs::create_dir_all(&export.site).map_err(cannot)?,
    }
    let jobs = Jobs::new(export.program.clone(), folder.root().to_path_buf());
    let (project, count) = project(&folder, &jobs, &mut tell)?;
    for name in Front::iter() {
        let Some(file) = Front::get(&name) else { continue };
        let path = export.site.join(name.as_ref());
        std::fs::create_dir_all(path.parent().unwrap_or(&export.site)).map_err(cannot)?;
        std::fs::write(path, &file.data).map_err(cannot)?;
    }
    let page = String::from_utf8_lossy(&page.data)
        .replace("<head>", "<head>\n    <meta name=\"groundstate-project\" content=\"project.json\" />");
    std::fs::write(export.site.join("index.html"), page).map_err(cannot)?;
    std::fs::write(export.site.join("project.json"), project).map_err(cannot)?;
    Ok(count)
}

/// What the front end asks, answered: as JSON, and how many files it is about.
fn project(folder: &Folder, jobs: &Jobs, tell: &mut impl FnMut(&str)) -> Result<(String, usize), String> {
    let mut server = Server::start(folder.root())?;
    let hello = hello(folder, true);
    let (mut texts, mut pictures, mut runs, mut results) =
        (BTreeMap::new(), BTreeMap::new(), BTreeMap::new(), BTreeMap::new());
    let files: Vec<Value> = hello["files"].as_array().cloned().unwrap_or_default();
    for file in &files {
        let of = |key: &str| file[key].as_str().unwrap_or_default().to_string();
        let (path, uri, kind) = (of("path"), of("uri"), of("kind"));
        // What is no text in UTF-8 is left out of the texts, not of the list.
        let Ok(Some(text)) = folder.read(&path) else { continue };
        tell(&path);
        texts.insert(path.clone(), text);
        if kind == "chart"
            && let Ok(picture) = server.ask("groundstate/chart/picture", json!({ "textDocument": { "uri": uri } }))
        {
            pictures.insert(uri.clone(), picture);
        }
        if matches!(kind.as_str(), "model" | "scenario")
            && let Some(run) = server.run(&uri, &files)
        {
            runs.insert(uri.clone(), run);
        }
        let wanted: &[&str] = match kind.as_str() {
            "chart" | "model" => &["verify"],
            "scenario" => &["test"],
            _ => &[],
        };
        for job in wanted {
            let words = words(job, &path, &json!({ "time": SECONDS }))?;
            let words: Vec<&str> = words.iter().map(String::as_str).collect();
            let made = jobs.at_once(&words)?;
            let said = String::from_utf8_lossy(&made.stdout);
            let lines: Vec<Value> = said.lines().filter_map(|line| serde_json::from_str(line).ok()).collect();
            results.insert(format!("{job} {path}"), json!({ "lines": lines, "code": made.status.code() }));
        }
    }
    for file in hello["library"].as_array().into_iter().flatten() {
        let Some(uri) = file["uri"].as_str() else { continue };
        if let Ok(text) = library(uri) {
            texts.insert(uri.to_string(), text);
        }
        if file["kind"] == "chart"
            && let Ok(picture) = server.ask("groundstate/chart/picture", json!({ "textDocument": { "uri": uri } }))
        {
            pictures.insert(uri.to_string(), picture);
        }
    }
    let made = json!({
        "version": 1, "hello": hello, "texts": texts, "pictures": pictures, "runs": runs, "results": results,
    });
    let mut text = made.to_string();
    // Nobody is told where the folder and the libraries lay.
    let own = hello["root"].as_str().unwrap_or_default();
    text = text.replace(own, ROOT).replace(&*folder.root().to_string_lossy(), "/project");
    if let Some(library) = hello["library"][0]["uri"].as_str()
        && let Some((cache, _)) = library.split_once("/groundstate/library/")
    {
        text = text.replace(cache, "file:///library");
    }
    Ok((text, files.len()))
}

/// A language server in memory, asked one thing after the other.
struct Server {
    connection: Connection,
    last: i32,
}

impl Server {
    fn start(root: &Path) -> Result<Server, String> {
        let (connection, its) = Connection::memory();
        let within = root.to_path_buf();
        std::thread::spawn(move || lsp::serve_within(&its, &within));
        let mut server = Server { connection, last: 0 };
        let uri = lsp::uri_of(&root.to_string_lossy()).map(|uri| uri.as_str().to_string());
        let options = json!({ "checkFolders": false });
        server.ask(
            "initialize",
            json!({ "processId": null, "rootUri": uri, "capabilities": {}, "initializationOptions": options }),
        )?;
        let ready = Notification::new("initialized".to_string(), json!({}));
        server.connection.sender.send(Message::Notification(ready)).map_err(|error| error.to_string())?;
        Ok(server)
    }

    fn ask(&mut self, method: &str, params: Value) -> Result<Value, String> {
        self.last += 1;
        let request = Request::new(self.last.into(), method.to_string(), params);
        self.connection.sender.send(Message::Request(request)).map_err(|error| error.to_string())?;
        for message in &self.connection.receiver {
            let Message::Response(response) = message else { continue };
            if response.id == self.last.into() {
                let refused = |error: lsp_server::ResponseError| error.message;
                let response = response.response_result.map_err(refused)?;
                return Ok(response);
            }
        }
        Err("the language server has ended".to_string())
    }

    /// The states of a run, drawn at random by a fixed seed, each with the values of the guards of the chart beside the model; none of
    /// what cannot run.
    fn run(&mut self, uri: &str, files: &[Value]) -> Option<Value> {
        let chart = uri.strip_suffix(".asm").map(|stem| format!("{stem}.chart"));
        let chart = chart.filter(|chart| files.iter().any(|file| file["uri"] == chart.as_str()));
        let guards = chart.map(|chart| self.guards(&chart)).unwrap_or_default();
        let params = json!({ "textDocument": { "uri": uri }, "seed": 1, "begins": true });
        let opened = self.ask("groundstate/session/open", params).ok()?;
        let session = opened["session"].clone();
        let mut states = vec![opened];
        loop {
            let last = states.last_mut()?;
            if !guards.is_empty()
                && let Ok(told) =
                    self.ask("groundstate/session/evaluate", json!({ "session": session, "terms": guards }))
                && let Some(values) = told["values"].as_array()
            {
                let of = guards.iter().cloned().zip(values.iter().cloned());
                last["values"] = Value::Object(of.filter(|(_, value)| !value.is_null()).collect());
            }
            if states.len() > STEPS || states.last()?["waiting"] != "step" {
                break;
            }
            match self.ask("groundstate/session/step", json!({ "session": session })) {
                Ok(state) => states.push(state),
                Err(_) => break,
            }
        }
        _ = self.ask("groundstate/session/close", json!({ "session": session }));
        Some(json!(states))
    }

    /// The terms that the guards of a chart stand for, as the front end asks for them. LIMIT: those that speak of an agent are left out,
    /// and so are more than can be asked for at once.
    fn guards(&mut self, chart: &str) -> Vec<String> {
        let Ok(told) = self.ask("groundstate/chart/picture", json!({ "textDocument": { "uri": chart } })) else {
            return Vec::new();
        };
        let mut terms = Vec::new();
        for drawing in told["drawings"].as_array().into_iter().flatten() {
            let for_agents = drawing["lights"][0]["term"].as_str().is_none_or(|term| term.contains('$'));
            for one in drawing["picture"]["boxes"].as_array().into_iter().flatten() {
                let link = one["link"].as_str().filter(|link| !link.is_empty());
                let term = match link {
                    Some(link) => Some(link).filter(|link| !link.contains('$')),
                    None => one["id"].as_str().filter(|_| !for_agents),
                };
                if let Some(term) = term.filter(|_| one["figure"] == "hexagon").map(str::to_string)
                    && !terms.contains(&term)
                {
                    terms.push(term);
                }
            }
        }
        terms.truncate(GUARDS);
        terms
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_exported_answers_and_tells_no_place() {
        let place = tempfile::tempdir().expect("a folder");
        let model = "asm A\nimport StandardLibrary\nsignature:\n\tcontrolled x: Integer\ndefinitions:\n\tmain rule r_m = x := x + 1\n\
                     default init s0:\n\tfunction x = 0\n";
        let chart = "chart B\n\nmachine b\n\tcontrol c\n\tinitial state s\n\tguard g\n\ts -> g yes -> s\nendmachine\n";
        std::fs::write(place.path().join("A.asm"), model).expect("written");
        std::fs::write(place.path().join("B.chart"), chart).expect("written");
        let guarded = "chart D\n\nmachine d\n\tcontrol c\n\tinitial state s\n\tguard g {x > 1}\n\tguard gone\n\ts -> g yes -> s\n\tg no -> gone yes -> s\nendmachine\n";
        std::fs::write(place.path().join("D.asm"), model.replace("asm A", "asm D")).expect("written");
        std::fs::write(place.path().join("D.chart"), guarded).expect("written");
        let folder = Folder::at(place.path()).expect("it is one");
        let jobs = Jobs::new(PathBuf::from("/bin/echo"), folder.root().to_path_buf());
        let (text, count) = project(&folder, &jobs, &mut |_| {}).expect("exported");
        assert_eq!(count, 4);
        assert!(!text.contains(&*folder.root().to_string_lossy()), "{text}");
        let project: Value = serde_json::from_str(&text).expect("JSON");
        assert_eq!(project["hello"]["readOnly"], true);
        assert_eq!(project["texts"]["A.asm"], model);
        assert_eq!(project["pictures"]["file:///project/B.chart"]["drawings"][0]["name"], "b");
        let run = project["runs"]["file:///project/A.asm"].as_array().expect("a run");
        assert_eq!((run.len(), run[60]["state"]["x"].as_str()), (61, Some("60")));
        assert_eq!(project["results"]["verify A.asm"]["code"], 0);
        // The guards of the chart beside a model have values; of one that is not there nothing is said.
        let run = project["runs"]["file:///project/D.asm"].as_array().expect("a run");
        let told: Vec<&Value> = run.iter().take(3).map(|state| &state["values"]["x > 1"]).collect();
        assert_eq!(told, ["false", "false", "true"]);
        assert!(run[0]["values"]["gone"].is_null() && run[0]["values"]["x > 1"].is_string());
    }
}
