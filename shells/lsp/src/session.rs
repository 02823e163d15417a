//! One editor from `initialize` to `exit`: messages in, jobs for the worker out.
//!
//! In: a [`Connection`]. Out: how it ended. The thread that runs this reads messages and keeps the texts that are being edited, no
//! more: all that takes time is done by the worker, or, for formatting, by a thread of its own.

use std::collections::BTreeMap;
use std::panic::{UnwindSafe, catch_unwind};
use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::sync::mpsc::{Sender, channel};

use groundstate::Kind;
use ide::{Edit, Encoding, Lines};
use lsp_server::{Connection, ErrorCode, Message, Notification, Request, RequestId};
use lsp_types::notification::{self, Notification as _};
use lsp_types::*;
use serde_json::{Value, json};
use syntax::{FileId, Severity};

use crate::capabilities::capabilities;
use crate::disk::Folder;
use crate::location::path_of;
use crate::pending::Pending;
use crate::route::Refused;
use crate::settings::Settings;
use crate::worker::{Job, Out, Worker, respond, told};

/// The stack of threads that read trees.
const STACK_BYTES: usize = 256 << 20;

/// How a session ended.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Ended {
    /// As it should.
    AfterShutdown,
    /// The editor went away.
    WithoutShutdown,
}

/// Serves an editor until it ends.
///
/// # Errors
/// The connection broke before the editor could say what it is.
pub fn serve(connection: &Connection) -> Result<Ended, String> {
    serve_files(connection, None)
}

/// The same for an editor that may see the files of one folder alone, and the built-in libraries; the folder's path is without links.
///
/// # Errors
/// As [`serve`].
pub fn serve_within(connection: &Connection, folder: &Path) -> Result<Ended, String> {
    serve_files(connection, Some(folder.to_path_buf()))
}

fn serve_files(connection: &Connection, within: Option<PathBuf>) -> Result<Ended, String> {
    let (id, params) = connection.initialize_start().map_err(|error| error.to_string())?;
    let params: InitializeParams = serde_json::from_value(params).map_err(|error| error.to_string())?;
    let settings = Arc::new(Settings { within, ..Settings::of(&params) });
    let result = json!({
        "capabilities": capabilities(&settings),
        "serverInfo": { "name": "groundstate", "version": env!("CARGO_PKG_VERSION") },
    });
    connection.initialize_finish(id, result).map_err(|error| error.to_string())?;

    let sender = connection.sender.clone();
    // If the editor is gone there is nobody to tell.
    let out: Out = Arc::new(move |message| _ = sender.send(message));
    let pending = Arc::new(Pending::new());
    let (jobs, received) = channel();
    let worker = Worker::new(Arc::clone(&settings), Arc::clone(&pending), Arc::clone(&out));
    let thread = std::thread::Builder::new().name("worker".to_string()).stack_size(STACK_BYTES);
    let thread = thread.spawn(move || worker.work(&received)).map_err(|error| error.to_string())?;
    let mut session = Session {
        folders: settings.folders.iter().filter(|path| settings.shows(path)).cloned().map(whole).collect(),
        settings,
        pending,
        out,
        jobs,
        documents: BTreeMap::new(),
        shut_down: false,
    };
    session.begin();
    let ended = session.run(connection);
    drop(session);
    _ = thread.join();
    Ok(ended)
}

fn whole(path: String) -> Folder {
    Folder { path, whole: true }
}

/// A text that is being edited.
struct Document {
    version: i32,
    lines: Lines,
}

struct Session {
    settings: Arc<Settings>,
    pending: Arc<Pending>,
    out: Out,
    jobs: Sender<Job>,
    documents: BTreeMap<String, Document>,
    folders: Vec<Folder>,
    shut_down: bool,
}

impl Session {
    fn begin(&self) {
        self.job(Job::Folders(self.folders.clone()));
        if self.settings.watches {
            let watchers: Vec<Value> =
                Kind::ENDINGS.iter().map(|ending| json!({ "globPattern": format!("**/*.{ending}") })).collect();
            let registration = json!({ "registrations": [{
                "id": "files", "method": "workspace/didChangeWatchedFiles", "registerOptions": { "watchers": watchers },
            }] });
            let id = RequestId::from("groundstate-files".to_string());
            (self.out)(Message::Request(Request::new(id, "client/registerCapability".to_string(), registration)));
        }
    }

    fn job(&self, job: Job) {
        self.pending.arrived();
        // The worker ends with the session alone.
        _ = self.jobs.send(job);
    }

    fn run(&mut self, connection: &Connection) -> Ended {
        for message in &connection.receiver {
            match message {
                Message::Request(request) => self.request(request),
                Message::Notification(note) if note.method == notification::Exit::METHOD => break,
                Message::Notification(note) => self.notification(note),
                // Nothing that was asked of the editor needs its answer.
                Message::Response(_) => {}
            }
        }
        if self.shut_down { Ended::AfterShutdown } else { Ended::WithoutShutdown }
    }

    fn request(&mut self, request: Request) {
        let Request { id, method, params } = request;
        self.pending.open(&id);
        if self.shut_down {
            let refused = Refused::new(ErrorCode::InvalidRequest, "the server is shut down");
            return respond(&self.pending, &self.out, id, Err(refused));
        }
        match method.as_str() {
            "shutdown" => {
                self.shut_down = true;
                respond(&self.pending, &self.out, id, Ok(Value::Null));
            }
            "textDocument/formatting" => self.format(id, &params, |path, lines| {
                let text = formatted(path, lines.text())?;
                Ok(ide::difference(lines.text(), &text).into_iter().collect())
            }),
            "textDocument/rangeFormatting" => self.format_range(id, params),
            "textDocument/onTypeFormatting" => self.format_typed(id, params),
            _ => {
                let stamp = self.pending.stamp(&crate::route::subject(&params).unwrap_or_default());
                self.job(Job::Request { id, method, params, stamp });
            }
        }
    }

    /// Lays a text out on a thread of its own: a long file holds up nothing else.
    fn format(
        &self,
        id: RequestId,
        params: &Value,
        layout: impl FnOnce(&str, &Lines) -> Result<Vec<Edit>, String> + Send + UnwindSafe + 'static,
    ) {
        let path = crate::route::subject(params).unwrap_or_default();
        let Some(document) = self.documents.get(&path) else {
            let refused = Refused::new(ErrorCode::InvalidParams, "the file is not open");
            return respond(&self.pending, &self.out, id, Err(refused));
        };
        let (lines, encoding) = (document.lines.clone(), self.settings.encoding);
        let (pending, out, stamp) = (Arc::clone(&self.pending), Arc::clone(&self.out), self.pending.stamp(&path));
        let work = move || {
            let (name, own) = (path.clone(), lines.clone());
            let answer = match catch_unwind(move || layout(&name, &own)) {
                Ok(Ok(edits)) => {
                    let at = |offset: u32| {
                        let at = lines.position(offset as usize, encoding);
                        Position::new(at.line, at.column)
                    };
                    let of = |edit: Edit| TextEdit::new(Range::new(at(edit.range.0), at(edit.range.1)), edit.text);
                    Ok(json!(edits.into_iter().map(of).collect::<Vec<TextEdit>>()))
                }
                Ok(Err(reason)) => Err(Refused::new(ErrorCode::RequestFailed, reason)),
                Err(panic) => Err(Refused::new(ErrorCode::InternalError, told(&*panic))),
            };
            let answer = match pending.is_present(&path, stamp, false) {
                true => answer,
                false => Err(Refused::new(ErrorCode::ContentModified, "the text has changed meanwhile")),
            };
            respond(&pending, &out, id, answer);
        };
        let thread = std::thread::Builder::new().name("format".to_string()).stack_size(STACK_BYTES);
        if let Err(error) = thread.spawn(work) {
            eprintln!("groundstate: formatting could not begin: {error}");
        }
    }

    /// Lays out the parts of a text in a range.
    fn format_range(&self, id: RequestId, params: Value) {
        let encoding = self.settings.encoding;
        match serde_json::from_value::<DocumentRangeFormattingParams>(params.clone()) {
            Ok(DocumentRangeFormattingParams { range, .. }) => self.format(id, &params, move |path, lines| {
                let range = (offset(lines, range.start, encoding), offset(lines, range.end, encoding));
                ide::layout_in(path, lines.text(), range)
            }),
            Err(error) => self.wrong_params(id, &error),
        }
    }

    /// Lays out what was typed.
    fn format_typed(&self, id: RequestId, params: Value) {
        let encoding = self.settings.encoding;
        match serde_json::from_value::<DocumentOnTypeFormattingParams>(params.clone()) {
            Ok(DocumentOnTypeFormattingParams { text_document_position: at, ch, .. }) => {
                self.format(id, &params, move |path, lines| {
                    let at = offset(lines, at.position, encoding);
                    // Editors indent a new line before they ask.
                    let begun = lines.text()[..at as usize].trim_end_matches([' ', '\t']).len() as u32;
                    let at = if ch == "\n" { begun } else { at };
                    Ok(ide::layout_typed(path, lines.text(), at))
                });
            }
            Err(error) => self.wrong_params(id, &error),
        }
    }

    fn wrong_params(&self, id: RequestId, error: &serde_json::Error) {
        respond(&self.pending, &self.out, id, Err(Refused::new(ErrorCode::InvalidParams, error.to_string())));
    }

    fn notification(&mut self, note: Notification) {
        let Notification { method, params } = note;
        // A notification has no answer, so what is wrong with one is for the log.
        let wrong = |error: serde_json::Error| eprintln!("groundstate: {method}: {error}");
        match method.as_str() {
            notification::DidOpenTextDocument::METHOD => {
                match serde_json::from_value::<DidOpenTextDocumentParams>(params) {
                    Ok(params) => self.opened(params),
                    Err(error) => wrong(error),
                }
            }
            notification::DidChangeTextDocument::METHOD => {
                match serde_json::from_value::<DidChangeTextDocumentParams>(params) {
                    Ok(params) => self.changed(params),
                    Err(error) => wrong(error),
                }
            }
            notification::DidCloseTextDocument::METHOD => {
                match serde_json::from_value::<DidCloseTextDocumentParams>(params) {
                    Ok(params) => self.closed(&params),
                    Err(error) => wrong(error),
                }
            }
            notification::DidSaveTextDocument::METHOD | notification::DidChangeWatchedFiles::METHOD => {
                self.job(Job::Folders(self.folders.clone()));
            }
            notification::DidChangeWorkspaceFolders::METHOD => {
                match serde_json::from_value::<DidChangeWorkspaceFoldersParams>(params) {
                    Ok(params) => self.folders_changed(&params),
                    Err(error) => wrong(error),
                }
            }
            notification::Cancel::METHOD => match serde_json::from_value::<CancelParams>(params) {
                Ok(params) => {
                    let id = match params.id {
                        NumberOrString::Number(number) => RequestId::from(number),
                        NumberOrString::String(text) => RequestId::from(text),
                    };
                    let refused = Refused::new(ErrorCode::RequestCanceled, "cancelled");
                    self.pending.cancelled(&id);
                    respond(&self.pending, &self.out, id, Err(refused));
                }
                Err(error) => wrong(error),
            },
            // What is not known is no fault of a notification.
            _ => {}
        }
    }

    fn opened(&mut self, params: DidOpenTextDocumentParams) {
        let Some(path) = path_of(&params.text_document.uri) else { return };
        // A file by itself has the files beside it as its project.
        let folder = Path::new(&path).parent().map(|folder| folder.to_string_lossy().into_owned());
        if let Some(folder) = folder
            && !self
                .folders
                .iter()
                .any(|known| known.path == folder || known.whole && Path::new(&folder).starts_with(&known.path))
            && !path.starts_with('<')
            && self.settings.shows(&folder)
        {
            self.folders.push(Folder { path: folder, whole: false });
            self.job(Job::Folders(self.folders.clone()));
        }
        self.replace(path, params.text_document.version, Lines::new(params.text_document.text.into()));
    }

    fn changed(&mut self, params: DidChangeTextDocumentParams) {
        let Some(path) = path_of(&params.text_document.uri) else { return };
        let version = params.text_document.version;
        let Some(document) = self.documents.get(&path) else { return };
        if version < document.version {
            eprintln!("groundstate: {path}: version {version} came after version {}", document.version);
            return;
        }
        let mut lines = document.lines.clone();
        for change in params.content_changes {
            let Some(range) = change.range else {
                lines = Lines::new(change.text.into());
                continue;
            };
            let at = |position: Position| offset(&lines, position, self.settings.encoding);
            let (start, end) = (at(range.start), at(range.end));
            let edit = Edit::new(start..end.max(start), change.text);
            lines = Lines::new(ide::edited(lines.text(), &[edit]).into());
        }
        self.replace(path, version, lines);
    }

    fn replace(&mut self, path: String, version: i32, lines: Lines) {
        let text = Arc::clone(lines.text());
        self.documents.insert(path.clone(), Document { version, lines });
        self.pending.changed(&path);
        self.job(Job::Text { path, version, text });
    }

    fn closed(&mut self, params: &DidCloseTextDocumentParams) {
        let Some(path) = path_of(&params.text_document.uri) else { return };
        self.documents.remove(&path);
        self.pending.changed(&path);
        self.job(Job::Close(path));
    }

    fn folders_changed(&mut self, params: &DidChangeWorkspaceFoldersParams) {
        let removed: Vec<String> = params.event.removed.iter().filter_map(|folder| path_of(&folder.uri)).collect();
        self.folders.retain(|folder| !removed.contains(&folder.path));
        let added = params.event.added.iter().filter_map(|folder| path_of(&folder.uri));
        self.folders.extend(added.filter(|path| self.settings.shows(path)).map(whole));
        self.job(Job::Folders(self.folders.clone()));
    }
}

/// The byte at a position.
fn offset(lines: &Lines, position: Position, encoding: Encoding) -> u32 {
    lines.offset(ide::Position { line: position.line, column: position.character }, encoding) as u32
}

/// A text in its canonical layout.
fn formatted(path: &str, text: &str) -> Result<String, String> {
    let parse = match Kind::of(Path::new(path)) {
        Some(Kind::Model) => syntax::parse_asmetal(FileId(0), text),
        Some(Kind::Scenario) => syntax::parse_avalla(FileId(0), text),
        Some(Kind::Chart) => syntax::parse_chart(FileId(0), text),
        Some(Kind::Report | Kind::Verification | Kind::Coupling) | None => return ide::formatted_text(path, text),
    };
    if parse.diagnostics.iter().any(|fault| fault.severity == Severity::Error) {
        return Err("a text with errors is not formatted".to_string());
    }
    Ok(syntax::format(&parse))
}
