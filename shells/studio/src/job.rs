//! What takes long: commands of this program, each a process of its own, for a tab.
//!
//! In: which command, on which file. Out: its lines as they come, and its exit code. A process can be stopped whatever it does, and what it
//! takes too much is its own. The words of a command are made here: a browser names no options. LIMIT: processes at a time, seconds
//! and lines of each; what is beyond is told.

use std::collections::BTreeMap;
use std::io::{BufReader, Read};
use std::path::{Path, PathBuf};
use std::process::{Child, Command, Output, Stdio};
use std::sync::atomic::{AtomicU64, Ordering};
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};
use std::thread::JoinHandle;
use std::time::{Duration, Instant};

use groundstate::Kind;
use serde_json::{Value, json};
use tokio::sync::mpsc::Sender;

use crate::line;
use crate::tell::{Out, notification};

/// LIMIT: processes at a time.
const AT_A_TIME: usize = 4;
/// LIMIT: seconds of a process.
const SECONDS: u64 = 3_600;
/// LIMIT: lines of a process that are handed on.
const LINES: usize = 20_000;
/// LIMIT: terms of a job, and bytes of each.
const TERMS: usize = 8;
const TERM: usize = 10_000;
/// How often it is looked whether a process has ended.
pub const LOOK: Duration = Duration::from_millis(10);
/// How long a process may take to end by itself.
const GRACE: Duration = Duration::from_secs(2);

/// The processes that run.
#[derive(Debug)]
pub struct Jobs {
    program: PathBuf,
    folder: PathBuf,
    last: AtomicU64,
    open: Mutex<BTreeMap<u64, Running>>,
}

#[derive(Debug)]
struct Running {
    tab: u64,
    is_stopped: bool,
}

impl Jobs {
    /// None yet; those to come are of this program, in this folder.
    pub fn new(program: PathBuf, folder: PathBuf) -> Jobs {
        Jobs { program, folder, last: AtomicU64::new(0), open: Mutex::default() }
    }

    /// The output of a command that is over in a moment.
    ///
    /// # Errors
    /// The program cannot be started; a sentence.
    pub fn at_once(&self, words: &[&str]) -> Result<Output, String> {
        let mut command = Command::new(&self.program);
        command.args(words).current_dir(&self.folder).env("NO_COLOR", "1").stdin(Stdio::null());
        command.output().map_err(|error| format!("the program cannot be started: {error}"))
    }

    fn open(&self) -> MutexGuard<'_, BTreeMap<u64, Running>> {
        self.open.lock().unwrap_or_else(PoisonError::into_inner)
    }

    /// Stops a job of a tab. Out: whether there is one.
    pub fn stop(&self, tab: u64, job: u64) -> bool {
        let mut open = self.open();
        let found = open.get_mut(&job).filter(|running| running.tab == tab);
        found.map(|running| running.is_stopped = true).is_some()
    }

    /// Stops what a tab has started.
    pub fn stop_of(&self, tab: u64) {
        self.open().values_mut().filter(|running| running.tab == tab).for_each(|running| running.is_stopped = true);
    }

    /// Stops all.
    pub fn stop_all(&self) {
        self.open().values_mut().for_each(|running| running.is_stopped = true);
    }

    /// Starts a command for a tab; its lines and its end are told to the tab alone. Out: its number.
    ///
    /// # Errors
    /// Too many run, or the program cannot be started; a sentence.
    pub fn start(self: &Arc<Jobs>, tab: u64, words: &[String], out: Sender<Out>) -> Result<u64, String> {
        let number = self.begin(tab)?;
        match started(&mut self.command(words)) {
            Ok(child) => {
                self.work(number, out, move |task| task.follow(child));
                Ok(number)
            }
            Err(reason) => {
                self.open().remove(&number);
                Err(reason)
            }
        }
    }

    /// Starts work of several processes for a tab. Out: its number.
    ///
    /// # Errors
    /// Too many run; a sentence.
    pub fn start_work(
        self: &Arc<Jobs>,
        tab: u64,
        out: Sender<Out>,
        work: impl FnOnce(&Task) -> Option<i32> + Send + 'static,
    ) -> Result<u64, String> {
        let number = self.begin(tab)?;
        self.work(number, out, work);
        Ok(number)
    }

    fn begin(&self, tab: u64) -> Result<u64, String> {
        let number = self.last.fetch_add(1, Ordering::Relaxed) + 1;
        let mut open = self.open();
        if open.len() >= AT_A_TIME {
            return Err(format!("{AT_A_TIME} jobs run already: stop one first"));
        }
        open.insert(number, Running { tab, is_stopped: false });
        Ok(number)
    }

    fn work(self: &Arc<Jobs>, number: u64, out: Sender<Out>, work: impl FnOnce(&Task) -> Option<i32> + Send + 'static) {
        let task = Task { jobs: Arc::clone(self), number, out, left: Arc::new(AtomicU64::new(LINES as u64)) };
        std::thread::spawn(move || {
            let code = work(&task);
            task.jobs.open().remove(&number);
            _ = task.out.blocking_send(notification("studio/done", &json!({ "job": number, "code": code })));
        });
    }

    /// A command of this program in the folder.
    pub fn command(&self, words: &[String]) -> Command {
        let mut command = Command::new(&self.program);
        command.args(words);
        self.within(command)
    }

    /// A command in the folder.
    pub fn within(&self, mut command: Command) -> Command {
        command.current_dir(&self.folder).env("NO_COLOR", "1");
        command
    }

    /// Whether none runs.
    pub fn is_idle(&self) -> bool {
        self.open().is_empty()
    }
}

/// The words of a command.
///
/// # Errors
/// There is no such job, or it is not for such a file; a sentence.
pub fn words(job: &str, path: &str, options: &Value) -> Result<Vec<String>, String> {
    let kind = Kind::of(Path::new(path));
    let is_chart = kind == Some(Kind::Chart);
    let command: &[&str] = match job {
        "verify" if is_chart || kind == Some(Kind::Model) => &["verify"],
        "test" if path.is_empty() || matches!(kind, Some(Kind::Scenario | Kind::Model)) => &["test"],
        "check" if is_chart => &["chart", "check"],
        "times" if is_chart => &["chart", "times"],
        "check" => &["check"],
        "build" if is_chart => &["chart", "build"],
        "generate" if is_chart || kind == Some(Kind::Model) => &["generate", "cpp"],
        "review" if kind == Some(Kind::Model) => &["review"],
        "mutate" if is_chart || kind == Some(Kind::Model) => &["mutate"],
        "graph" if kind == Some(Kind::Model) => &["graph"],
        "refine" if kind == Some(Kind::Coupling) => &["refine"],
        "verify" | "test" | "build" | "generate" | "review" | "times" | "mutate" | "graph" | "refine" => {
            let what = match job {
                "times" => "time",
                "graph" => "draw a state graph of",
                _ => job,
            };
            return Err(format!("there is nothing to {what} in {path}"));
        }
        _ => return Err(format!("`{}` is no job", job.escape_debug())),
    };
    let mut words: Vec<String> = command.iter().map(|word| word.to_string()).collect();
    // A name that begins with `-` is a name.
    words.push(if path.is_empty() { "./".to_string() } else { format!("./{path}") });
    match job {
        "verify" => {
            if let Some(seconds) = options["time"].as_u64() {
                words.extend(["--time".to_string(), seconds.min(SECONDS).to_string()]);
            }
            if options["first"].as_bool() == Some(true) {
                words.push("--first".to_string());
            }
        }
        "graph" => {
            let terms = options["where"].as_array().map(Vec::as_slice).unwrap_or_default();
            let terms = terms.iter().filter_map(Value::as_str).filter(|term| term.len() <= TERM);
            // One word: what begins with `-` is a term.
            words.extend(terms.take(TERMS).map(|term| format!("--where={term}")));
        }
        // What shows where it fails comes with it.
        "refine" => words.extend(["--page", "-"].map(str::to_string)),
        "test" if options["coverage"].as_bool() == Some(true) => words.push("--coverage".to_string()),
        _ => {}
    }
    // What a model imports may lie anywhere; the studio shows one folder.
    words.extend(["--within", ".", "--format", "json"].map(str::to_string));
    Ok(words)
}

/// The same of a model whose scenarios are played: these are named, not the model.
pub fn of_scenarios(words: &mut Vec<String>, scenarios: &[String]) {
    words.splice(1..2, scenarios.iter().map(|path| format!("./{path}")));
}

/// Starts a process whose output is read here.
///
/// # Errors
/// It cannot be started; a sentence.
pub fn started(command: &mut Command) -> Result<Child, String> {
    command.stdin(Stdio::null()).stdout(Stdio::piped()).stderr(Stdio::piped());
    // What it starts itself, a solver, ends with it.
    #[cfg(unix)]
    std::os::unix::process::CommandExt::process_group(command, 0);
    let name = command.get_program().to_string_lossy().into_owned();
    command.spawn().map_err(|error| match error.kind() {
        std::io::ErrorKind::NotFound => format!("{name} is not installed"),
        _ => format!("{name} cannot be started: {error}"),
    })
}

/// Work that is done for a tab, on a thread of its own.
#[derive(Debug)]
pub struct Task {
    jobs: Arc<Jobs>,
    number: u64,
    out: Sender<Out>,
    /// How many lines may still be handed on.
    left: Arc<AtomicU64>,
}

/// A process whose lines are handed on.
#[derive(Debug)]
pub struct Process {
    child: Child,
    readers: Vec<JoinHandle<()>>,
    asked: Option<Instant>,
}

impl Process {
    /// Its code once it has ended; none within if it was asked to end.
    pub fn ended(&mut self) -> Option<Option<i32>> {
        match self.child.try_wait() {
            Ok(Some(status)) => Some(status.code().filter(|_| self.asked.is_none())),
            Ok(None) => None,
            Err(_) => Some(None),
        }
    }

    /// Its code once it has ended, also if it was asked to.
    pub fn code(&mut self) -> Option<i32> {
        self.child.try_wait().ok().flatten().and_then(|status| status.code())
    }

    /// Asks it to end, and ends it if it does not.
    pub fn end(&mut self) {
        match self.asked {
            None => {
                end(&mut self.child, End::Asked);
                self.asked = Some(Instant::now());
            }
            Some(then) if then.elapsed() > GRACE => end(&mut self.child, End::Killed),
            Some(_) => {}
        }
    }

    /// Waits for all that it has written.
    pub fn drain(mut self) {
        if self.asked.is_some() {
            // What it left behind would keep its output open.
            end(&mut self.child, End::Killed);
        }
        self.readers.drain(..).for_each(|reader| _ = reader.join());
    }
}

impl Task {
    /// Who starts processes.
    pub fn jobs(&self) -> &Jobs {
        &self.jobs
    }

    /// Whether the tab wants no more of it.
    pub fn is_stopped(&self) -> bool {
        let is_stopped = self.jobs.open().get(&self.number).is_none_or(|running| running.is_stopped);
        is_stopped || self.out.is_closed()
    }

    /// Tells the tab something.
    pub fn say(&self, line: &Value) {
        _ = self.out.blocking_send(notification("studio/line", &json!({ "job": self.number, "line": line })));
    }

    /// Hands on what a process writes.
    pub fn attach(&self, mut child: Child) -> Process {
        let mut readers = Vec::new();
        let mut read = |from: Box<dyn Read + Send>| {
            let (number, out, left) = (self.number, self.out.clone(), Arc::clone(&self.left));
            readers.push(std::thread::spawn(move || hand_on(number, from, &out, &left)));
        };
        child.stdout.take().into_iter().for_each(|stdout| read(Box::new(stdout)));
        child.stderr.take().into_iter().for_each(|stderr| read(Box::new(stderr)));
        Process { child, readers, asked: None }
    }

    /// Hands on what a process writes until it ends. Out: its code; none if it was stopped.
    pub fn follow(&self, child: Child) -> Option<i32> {
        let mut process = self.attach(child);
        let begun = Instant::now();
        let code = loop {
            if let Some(code) = process.ended() {
                break code;
            }
            if self.is_stopped() || begun.elapsed() > Duration::from_secs(SECONDS) {
                process.end();
            }
            std::thread::sleep(LOOK);
        };
        process.drain();
        code
    }
}

/// How a process is to end.
#[derive(Debug, Clone, Copy)]
enum End {
    /// As by Ctrl-C: it may still say what it knows.
    Asked,
    /// At once.
    Killed,
}

/// Ends a process and what it has started.
#[cfg(unix)]
fn end(child: &mut Child, how: End) {
    use rustix::process::{Pid, Signal, kill_process_group};
    let signal = match how {
        End::Asked => Signal::INT,
        End::Killed => Signal::KILL,
    };
    if let Some(group) = Pid::from_raw(child.id() as i32) {
        // It may have ended already.
        _ = kill_process_group(group, signal);
    }
}

#[cfg(not(unix))]
fn end(child: &mut Child, _how: End) {
    _ = child.kill();
}

/// Sends each line as it comes.
fn hand_on(number: u64, from: impl Read, out: &Sender<Out>, left: &AtomicU64) {
    let (mut from, mut line) = (BufReader::new(from), Vec::new());
    while let Some(length) = line::next(&mut from, &mut line) {
        let before = left.fetch_update(Ordering::Relaxed, Ordering::Relaxed, |left| Some(left.saturating_sub(1)));
        let said = line::said(&line, length);
        let said = match before.unwrap_or_default() {
            // Read on, so that the process does not wait.
            0 if !line::is_outcome(&said) => continue,
            1 if !line::is_outcome(&said) => Value::from(format!("more than {LINES} lines: the rest is not shown")),
            _ => said,
        };
        let message = notification("studio/line", &json!({ "job": number, "line": said }));
        // If nobody listens, the process is stopped by who watches it.
        _ = out.blocking_send(message);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_browser_names_no_options() {
        let check = |job: &str, path: &str, options: Value| words(job, path, &options).map(|words| words.join(" "));
        assert_eq!(check("verify", "a/-b.chart", json!({})), Ok("verify ./a/-b.chart --within . --format json".into()));
        assert_eq!(
            check("verify", "a.asm", json!({ "time": 5, "first": true, "counterexample": "/etc/x" })),
            Ok("verify ./a.asm --time 5 --first --within . --format json".into())
        );
        assert_eq!(
            check("build", "--help.chart", json!({})),
            Ok("chart build ./--help.chart --within . --format json".into())
        );
        assert_eq!(check("times", "a.chart", json!({})), Ok("chart times ./a.chart --within . --format json".into()));
        assert_eq!(check("times", "a.asm", json!({})), Err("there is nothing to time in a.asm".into()));
        assert_eq!(check("test", "", json!({})), Ok("test ./ --within . --format json".into()));
        assert_eq!(
            check("refine", "A.refine", json!({ "page": "/etc/x" })),
            Ok("refine ./A.refine --page - --within . --format json".into())
        );
        assert_eq!(check("refine", "a.asm", json!({})), Err("there is nothing to refine in a.asm".into()));
        assert_eq!(
            check("graph", "a.asm", json!({ "where": ["-x > 1", 3, "--help"], "max": 9 })),
            Ok("graph ./a.asm --where=-x > 1 --where=--help --within . --format json".into())
        );
        assert_eq!(
            check("test", "a.asm", json!({ "coverage": true, "junit": "/etc/x" })),
            Ok("test ./a.asm --coverage --within . --format json".into())
        );
        assert_eq!(check("test", "a/b.avalla", json!({})), Ok("test ./a/b.avalla --within . --format json".into()));
        let mut played = words("test", "b/a.asm", &json!({})).expect("a model");
        of_scenarios(&mut played, &["b/-x.avalla".to_string(), "b/y.avalla".to_string()]);
        assert_eq!(played.join(" "), "test ./b/-x.avalla ./b/y.avalla --within . --format json");
        assert_eq!(check("mutate", "a.asm", json!({})), Ok("mutate ./a.asm --within . --format json".into()));
        assert_eq!(check("mutate", "a.chart", json!({})), Ok("mutate ./a.chart --within . --format json".into()));
        assert_eq!(
            check("graph", "a.chart", json!({})),
            Err("there is nothing to draw a state graph of in a.chart".into())
        );
        assert_eq!(check("build", "a.asm", json!({})), Err("there is nothing to build in a.asm".into()));
        assert_eq!(check("rm -rf", "a.asm", json!({})), Err("`rm -rf` is no job".into()));
    }
}
