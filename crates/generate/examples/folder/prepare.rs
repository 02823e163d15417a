//! Reads models, runs them in the machine and generates them, in worker processes.
//!
//! In: paths. Out: the [`Fate`] of each, its code and its run in a folder of its own. A worker is this program again;
//! it reads one path per line and writes one answer per line. So an endless run or a stack overflow does not affect the
//! others: a worker that dies or exceeds the time limit is replaced, and the model's fate says so.

use std::io::{BufRead, BufReader, Write};
use std::path::{Path, PathBuf};
use std::process::{Child, ChildStdin, Command, Stdio};
use std::sync::Mutex;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::sync::mpsc::{Receiver, RecvTimeoutError, channel};
use std::time::Duration;

use syntax::SourceFile;

use crate::compile::{Unit, write};
use crate::run::{Disk, Prepared, read, record};

/// The argument that starts this program as a worker.
pub const WORKER: &str = "--worker";
/// LIMIT: how long reading, running and generating one model may take.
const LIMIT: Duration = Duration::from_secs(120);
/// How many steps a run has.
const STEPS: u64 = 20;

/// A model of the folder.
pub struct Model {
    pub name: String,
    pub fate: Fate,
}

/// The result for a model before compiling.
pub enum Fate {
    /// It has faults, or cannot be read.
    Faulty,
    /// It has no main rule.
    NoMain,
    /// The machine reaches no initial state.
    NoRun,
    /// The machine runs it, but it cannot be generated: why.
    Refused(String),
    /// Its code stands in a folder.
    Ready(Unit),
}

/// Prepares all of them.
pub fn all(work: &Path, paths: &[(String, PathBuf)]) -> Vec<Model> {
    let next = AtomicUsize::new(0);
    let fates: Mutex<Vec<Option<Fate>>> = Mutex::new(paths.iter().map(|_| None).collect());
    std::thread::scope(|scope| {
        for _ in 0..2 {
            scope.spawn(|| {
                let mut worker = None;
                loop {
                    let index = next.fetch_add(1, Ordering::Relaxed);
                    let Some((name, path)) = paths.get(index) else { return };
                    let fate = ask(&mut worker, work, index, path);
                    if let Fate::Refused(why) = &fate {
                        println!("{name}: refused: {why}");
                    }
                    if index % 100 == 99 {
                        println!("prepared {}", index + 1);
                    }
                    fates.lock().expect("unpoisoned")[index] = Some(fate);
                }
            });
        }
    });
    let fates = fates.into_inner().expect("unpoisoned").into_iter().flatten();
    paths.iter().zip(fates).map(|((name, _), fate)| Model { name: name.clone(), fate }).collect()
}

struct Worker {
    child: Child,
    paths: ChildStdin,
    answers: Receiver<String>,
}

impl Worker {
    fn start(work: &Path) -> Worker {
        let program = std::env::current_exe().expect("this program");
        let mut child = Command::new(program)
            .arg(WORKER)
            .arg(work)
            .stdin(Stdio::piped())
            .stdout(Stdio::piped())
            .stderr(Stdio::null())
            .spawn()
            .expect("this program runs");
        let (paths, lines) = (child.stdin.take().expect("piped"), child.stdout.take().expect("piped"));
        let (sender, answers) = channel();
        std::thread::spawn(move || {
            for line in BufReader::new(lines).lines().map_while(Result::ok) {
                if sender.send(line).is_err() {
                    break;
                }
            }
        });
        Worker { child, paths, answers }
    }
}

impl Drop for Worker {
    fn drop(&mut self) {
        let _ = self.child.kill();
        let _ = self.child.wait();
    }
}

/// Asks a worker; a worker that gives no answer is killed.
fn ask(worker: &mut Option<Worker>, work: &Path, index: usize, path: &Path) -> Fate {
    let mut current = worker.take().unwrap_or_else(|| Worker::start(work));
    let sent = writeln!(current.paths, "{index} {}", path.display()).and_then(|()| current.paths.flush());
    let answer = match sent {
        Ok(()) => current.answers.recv_timeout(LIMIT),
        Err(_) => Err(RecvTimeoutError::Disconnected),
    };
    let line = match answer {
        Ok(line) => line,
        Err(RecvTimeoutError::Timeout) => {
            return Fate::Refused(format!("takes more than {} s to be run and generated", LIMIT.as_secs()));
        }
        Err(RecvTimeoutError::Disconnected) => return Fate::Refused("panics, or overflows the stack".to_string()),
    };
    *worker = Some(current);
    let (kind, rest) = line.split_once(' ').unwrap_or((&line, ""));
    match kind {
        "faulty" => Fate::Faulty,
        "no-main" => Fate::NoMain,
        "no-run" => Fate::NoRun,
        "ready" => {
            let (bytes, namespace) = rest.split_once(' ').expect("a number and a name");
            let (name, bytes) = (format!("m{index}"), bytes.parse().expect("a number"));
            let folder = work.join(&name);
            Fate::Ready(Unit { name, namespace: namespace.to_string(), folder, bytes })
        }
        _ => Fate::Refused(rest.to_string()),
    }
}

/// The worker's loop, until its input ends.
pub fn work(folder: &Path) {
    for line in std::io::stdin().lock().lines().map_while(Result::ok) {
        let (index, path) = line.split_once(' ').expect("a number and a path");
        let answer = prepared(&folder.join(format!("m{index}")), Path::new(path));
        println!("{}", answer.replace('\n', " "));
    }
}

fn prepared(folder: &Path, path: &Path) -> String {
    let Ok(bytes) = std::fs::read(path) else { return "faulty".to_string() };
    let text = String::from_utf8_lossy(&bytes).into_owned();
    let subject = match read(SourceFile::new(path.to_string_lossy(), text.clone()), &mut Disk) {
        Ok(Some(subject)) => subject,
        Ok(None) => return "no-main".to_string(),
        Err(_) => return "faulty".to_string(),
    };
    let (script, expected) = record(&subject.program, STEPS, 1);
    // Without an initial state there is nothing to compare.
    if !expected.lines().any(|line| line.starts_with('.')) {
        return "no-run".to_string();
    }
    let generated = match subject.generate() {
        Ok(generated) => generated,
        Err(why) => return format!("refused {why}"),
    };
    let namespace = generated.name.clone();
    match write(folder, &text, &Prepared { generated, script, expected }) {
        Ok(bytes) => format!("ready {bytes} {namespace}"),
        Err(error) => format!("refused {error}"),
    }
}
