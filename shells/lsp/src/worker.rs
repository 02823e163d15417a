//! The thread that has the project: it answers requests in their order, checks what is open when there is nothing to answer, and the
//! other files of the folders when there is nothing else to do.
//!
//! In: [`Job`]s. Out: responses and diagnostics. What has been cancelled, or is about a text that has changed, is not begun, and
//! stopped if it had. LIMIT: a text of more than [`BYTES`] is not checked as it is typed. A
//! panic is an error of the request that it happened in; the project is made anew from the texts that are being edited, since
//! what was kept may be half made.

use std::collections::BTreeMap;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::sync::Arc;
use std::sync::mpsc::{Receiver, RecvTimeoutError, TryRecvError};
use std::time::Duration;

use ide::{Fault, Report, Weight};
use lsp_server::{ErrorCode, Message, Notification, RequestId, Response};
use lsp_types::PublishDiagnosticsParams;
use serde_json::Value;

use crate::answer::Answers;
use crate::background::Background;
use crate::chart_view;
use crate::disk::{Folder, project_files};
use crate::location::uri_of;
use crate::pending::{Pending, Stamp, Work};
use crate::publish::{Published, diagnostic};
use crate::route::{self, Refused};
use crate::run::{self, Sessions};
use crate::settings::Settings;

/// How long nothing has to come before files are checked: letters that are typed at once are checked once.
const REST: Duration = Duration::from_millis(2);

/// LIMIT: bytes of a text that is checked as it is typed, and of which questions are answered.
const BYTES: usize = 16 << 20;

/// What the thread is to do.
#[derive(Debug)]
pub enum Job {
    /// This is the text at a path.
    Text {
        /// The path.
        path: String,
        /// The editor's number of it.
        version: i32,
        /// The text.
        text: Arc<str>,
    },
    /// The text at a path is that of the disk.
    Close(String),
    /// These are the folders that are open, or what is in them has changed.
    Folders(Vec<Folder>),
    /// A request.
    Request {
        /// Its id.
        id: RequestId,
        /// Its method.
        method: String,
        /// Its parameters.
        params: Value,
        /// When it was asked.
        stamp: Stamp,
    },
}

/// Where messages to the editor go.
pub type Out = Arc<dyn Fn(Message) + Send + Sync>;

/// See the module.
pub struct Worker {
    answers: Answers,
    settings: Arc<Settings>,
    pending: Arc<Pending>,
    out: Out,
    published: Published,
    texts: BTreeMap<String, (i32, Arc<str>)>,
    folders: Vec<Folder>,
    /// Files to be checked, the one that was edited last at the end.
    unchecked: Vec<String>,
    background: Background,
    /// The models that run.
    sessions: Sessions,
    /// How many changes of texts have been taken in.
    changes: u64,
}

impl Worker {
    /// A worker that knows nothing yet.
    pub fn new(settings: Arc<Settings>, pending: Arc<Pending>, out: Out) -> Worker {
        Worker {
            answers: Answers::new(Arc::clone(&settings), pending.stop()),
            settings,
            pending,
            out,
            published: Published::default(),
            texts: BTreeMap::new(),
            folders: Vec::new(),
            unchecked: Vec::new(),
            background: Background::default(),
            sessions: Sessions::default(),
            changes: 0,
        }
    }

    /// Works until nobody sends jobs any more.
    pub fn work(mut self, jobs: &Receiver<Job>) {
        loop {
            let job = if self.unchecked.is_empty() && self.background.is_done() {
                jobs.recv().map_err(|_| RecvTimeoutError::Disconnected)
            } else {
                jobs.recv_timeout(REST)
            };
            // Requests and checks catch what happens in them; this is for all between.
            let done = catch_unwind(AssertUnwindSafe(|| {
                match job {
                    Ok(job) => self.job(job),
                    Err(RecvTimeoutError::Timeout) if self.unchecked.is_empty() => self.check_in_background(),
                    Err(RecvTimeoutError::Timeout) => self.check(jobs),
                    Err(RecvTimeoutError::Disconnected) => return false,
                }
                true
            }));
            match done {
                Ok(true) => {}
                Ok(false) => return,
                Err(_) => self.begin_anew(),
            }
        }
    }

    fn job(&mut self, job: Job) {
        self.answers.begin();
        match job {
            Job::Text { path, version, text } => {
                self.changes += 1;
                self.background.changed(&path);
                self.published.changed(&path);
                self.texts.insert(path.clone(), (version, Arc::clone(&text)));
                self.answers.versions.insert(path.clone(), version);
                // The thread that reads messages has seen to the order of versions.
                self.answers.project.close(&path);
                _ = self.answers.project.set_text(&path, i64::from(version), text);
                self.check_all(Some(path));
            }
            Job::Close(path) => {
                self.changes += 1;
                self.background.changed(&path);
                self.texts.remove(&path);
                self.answers.versions.remove(&path);
                self.answers.project.close(&path);
                self.published.closed(&path);
                self.unchecked.retain(|other| *other != path);
                self.check_all(None);
                self.publish();
            }
            Job::Folders(folders) => {
                self.folders = folders;
                self.answers.look_again(&self.folders);
                self.look_in_folders();
                self.check_all(None);
            }
            Job::Request { id, method, params, stamp } => self.request(id, &method, params, stamp),
        }
    }

    /// All that is open is to be checked: any of it may import what has changed.
    fn check_all(&mut self, last: Option<String>) {
        self.unchecked = self.texts.keys().filter(|path| Some(*path) != last.as_ref()).cloned().collect();
        self.unchecked.extend(last);
    }

    /// Checks files until something else is to be done.
    fn check(&mut self, jobs: &Receiver<Job>) {
        while let Some(path) = self.unchecked.pop() {
            let answers = &mut self.answers;
            answers.begin();
            let length = self.texts.get(&path).map_or(0, |(_, text)| text.len());
            self.pending.begin(Work::Check, self.changes);
            let checked = catch_unwind(AssertUnwindSafe(|| match length > BYTES {
                true => Ok(vec![too_large(&path, length)]),
                false => ide::reports(&mut answers.project, &path),
            }));
            if self.pending.end() && checked.is_ok() {
                // What stopped it is the next job.
                self.unchecked.push(path);
                return;
            }
            match checked {
                Ok(Ok(reports)) => self.published.checked(&path, reports),
                Ok(Err(_)) => self.published.closed(&path),
                Err(_) => self.begin_anew(),
            }
            self.publish();
            match jobs.try_recv() {
                Ok(job) => {
                    self.job(job);
                    return;
                }
                Err(TryRecvError::Disconnected) => return,
                Err(TryRecvError::Empty) => {}
            }
        }
        self.answers.project.rest();
    }

    /// Which files are there besides those that are open.
    fn look_in_folders(&mut self) {
        let whole: Vec<Folder> = self.folders.iter().filter(|folder| folder.whole).cloned().collect();
        let files = if self.settings.checks_folders { project_files(&whole) } else { Vec::new() };
        let gone = self.background.set_files(files);
        for path in gone.iter().filter(|path| !self.texts.contains_key(*path)) {
            self.published.closed(path);
        }
        self.publish();
    }

    /// Checks one file that is not open, unless something else comes.
    fn check_in_background(&mut self) {
        let texts = &self.texts;
        let Some(path) = self.background.next(|path| texts.contains_key(path)) else {
            self.answers.project.rest();
            return;
        };
        self.answers.begin();
        self.pending.begin(Work::Background, self.changes);
        let answers = &mut self.answers;
        let checked = catch_unwind(AssertUnwindSafe(|| ide::reports(&mut answers.project, &path)));
        if self.pending.end() && checked.is_ok() {
            self.background.stopped(path);
            return;
        }
        let read = self.answers.project.read_for(&path);
        match checked {
            Ok(Ok(mut reports)) => {
                // The others are checked themselves. What is of no use is shown faded where it stands; nobody looks there.
                reports.truncate(1);
                for report in &mut reports {
                    report.faults.retain(|fault| fault.weight != Weight::Unused);
                }
                self.published.checked(&path, reports);
            }
            Ok(Err(_)) => self.published.closed(&path),
            Err(_) => self.begin_anew(),
        }
        self.background.checked(path, read);
        self.publish();
    }

    fn publish(&mut self) {
        let versions = self.answers.versions.clone();
        for (path, faults) in self.published.news(|path| versions.get(path).copied()) {
            let Some(uri) = uri_of(&path) else { continue };
            let diagnostics = faults.iter().map(|fault| diagnostic(&mut self.answers, &path, fault)).collect();
            let version = versions.get(&path).copied();
            let params = PublishDiagnosticsParams { uri, diagnostics, version };
            let method = "textDocument/publishDiagnostics".to_string();
            (self.out)(Message::Notification(Notification::new(method, params)));
        }
    }

    fn request(&mut self, id: RequestId, method: &str, params: Value, stamp: Stamp) {
        if !self.pending.is_open(&id) {
            return;
        }
        let path = route::subject(&params).unwrap_or_default();
        let about_all = route::is_about_all(method);
        let outdated = Refused::new(ErrorCode::ContentModified, "the text has changed meanwhile");
        let mut answer = Err(outdated.clone());
        if self.texts.get(&path).is_some_and(|(_, text)| text.len() > BYTES) {
            answer = Ok(Value::Null);
        } else if self.pending.is_present(&path, stamp, about_all) {
            let answers = &mut self.answers;
            self.pending.begin(Work::Request { id: id.clone(), path: path.clone(), about_all }, self.changes);
            let (sessions, stop) = (&mut self.sessions, self.pending.stop());
            let answered = catch_unwind(AssertUnwindSafe(|| {
                if let Some(method) = method.strip_prefix(run::PREFIX) {
                    run::answer(sessions, answers, method, &params, &stop)
                } else if let Some(method) = method.strip_prefix(chart_view::PREFIX) {
                    chart_view::answer(answers, method, &params)
                } else {
                    route::answer(answers, method, params)
                }
            }));
            let stopped = self.pending.end();
            answer = answered.unwrap_or_else(|panic| {
                self.begin_anew();
                Err(Refused::new(ErrorCode::InternalError, format!("{method} failed: {}", told(&*panic))))
            });
            // What was stopped half-way has failed for no reason that is worth telling.
            let is_half = |answer: &Refused| stopped && answer.code == ErrorCode::RequestFailed as i32;
            let is_present = self.pending.is_present(&path, stamp, about_all);
            if answer.as_ref().map_or_else(is_half, |_| !is_present) {
                answer = Err(outdated);
            }
        }
        respond(&self.pending, &self.out, id, answer);
    }

    /// After a panic what is kept may be half made.
    fn begin_anew(&mut self) {
        self.answers = Answers::new(Arc::clone(&self.settings), self.pending.stop());
        for (path, (version, text)) in &self.texts {
            self.answers.versions.insert(path.clone(), *version);
            _ = self.answers.project.set_text(path, i64::from(*version), Arc::clone(text));
        }
        self.answers.look_again(&self.folders);
    }
}

/// What is said of a text that is not checked as it is typed.
fn too_large(path: &str, length: usize) -> Report {
    let message =
        format!("this text has {} MB: beyond {} MB it is not checked as it is typed", length >> 20, BYTES >> 20);
    let help = Some("`groundstate check` checks it".to_string());
    let fault = Fault { range: (0, 0), weight: Weight::Note, id: "", message, help, related: Vec::new() };
    Report { path: path.to_string(), faults: vec![fault] }
}

/// Answers a request that has not been answered yet.
pub fn respond(pending: &Pending, out: &Out, id: RequestId, answer: Result<Value, Refused>) {
    if !pending.take(&id) {
        return;
    }
    out(Message::Response(match answer {
        Ok(value) => Response::new_ok(id, value),
        Err(Refused { code, message }) => Response::new_err(id, code, message),
    }));
}

/// What a panic said.
pub fn told(panic: &(dyn std::any::Any + Send)) -> String {
    let text = panic.downcast_ref::<&str>().map(|text| text.to_string());
    text.or_else(|| panic.downcast_ref::<String>().cloned()).unwrap_or_else(|| "it panicked".to_string())
}
