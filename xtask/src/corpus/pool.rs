//! Jobs over worker processes.
//!
//! In: jobs. Out: their answers, in the same order. Each worker is this program again, reading one job a line and
//! writing one answer a line, so that neither a stack overflow nor an endless run takes the others with it: a worker
//! that dies or takes longer than the limit is replaced.

use std::io::{BufRead, BufReader, Write};
use std::path::Path;
use std::process::{Child, ChildStdin, Command, Stdio};
use std::sync::Mutex;
use std::sync::mpsc::{Receiver, RecvTimeoutError, channel};
use std::time::Duration;

use super::job::{Answer, Job};
use crate::Failure;

/// How many workers run beside each other.
const WORKERS: usize = 2;
/// LIMIT: how long one job may take.
const TIME_LIMIT: Duration = Duration::from_secs(240);

/// Does all jobs.
///
/// # Errors
/// A worker cannot be started.
pub fn run(checkout: &Path, jobs: &[Job]) -> Result<Vec<Answer>, Failure> {
    let answers: Mutex<Vec<Option<Answer>>> = Mutex::new(vec![None; jobs.len()]);
    let next = Mutex::new(0);
    let failures: Mutex<Vec<Failure>> = Mutex::new(Vec::new());
    std::thread::scope(|scope| {
        for _ in 0..WORKERS {
            scope.spawn(|| {
                let mut worker = None;
                loop {
                    let index = {
                        let mut next = locked(&next);
                        *next += 1;
                        *next - 1
                    };
                    let Some(job) = jobs.get(index) else { break };
                    match ask(&mut worker, checkout, job) {
                        Ok(answer) => locked(&answers)[index] = Some(answer),
                        Err(failure) => {
                            locked(&failures).push(failure);
                            break;
                        }
                    }
                }
            });
        }
    });
    if let Some(failure) = failures.into_inner().unwrap_or_default().pop() {
        return Err(failure);
    }
    Ok(answers.into_inner().unwrap_or_default().into_iter().flatten().collect())
}

fn locked<T>(mutex: &Mutex<T>) -> std::sync::MutexGuard<'_, T> {
    mutex.lock().unwrap_or_else(std::sync::PoisonError::into_inner)
}

struct Worker {
    child: Child,
    jobs: ChildStdin,
    answers: Receiver<String>,
}

impl Worker {
    fn start(checkout: &Path) -> Result<Worker, Failure> {
        let wrap = |error: std::io::Error| format!("a worker cannot be started: {error}");
        let program = std::env::current_exe().map_err(wrap)?;
        let mut child = Command::new(program)
            .arg(super::WORKER)
            .arg(checkout)
            .stdin(Stdio::piped())
            .stdout(Stdio::piped())
            .stderr(Stdio::null())
            .spawn()
            .map_err(wrap)?;
        let (Some(jobs), Some(lines)) = (child.stdin.take(), child.stdout.take()) else {
            return Err("a worker has no pipes".to_string());
        };
        let (sender, answers) = channel();
        std::thread::spawn(move || {
            for line in BufReader::new(lines).lines().map_while(Result::ok) {
                if sender.send(line).is_err() {
                    break;
                }
            }
        });
        Ok(Worker { child, jobs, answers })
    }
}

impl Drop for Worker {
    fn drop(&mut self) {
        let _ = self.child.kill();
        let _ = self.child.wait();
    }
}

fn ask(worker: &mut Option<Worker>, checkout: &Path, job: &Job) -> Result<Answer, Failure> {
    let mut current = match worker.take() {
        Some(worker) => worker,
        None => Worker::start(checkout)?,
    };
    let line = serde_json::to_string(job).map_err(|error| error.to_string())?;
    let sent = writeln!(current.jobs, "{line}").and_then(|()| current.jobs.flush());
    if sent.is_err() {
        return Ok(Answer::Panic { detail: "the worker died before it was asked".to_string() });
    }
    match current.answers.recv_timeout(TIME_LIMIT) {
        Ok(line) => {
            *worker = Some(current);
            serde_json::from_str(&line).map_err(|error| format!("a worker's answer cannot be read: {error}: {line}"))
        }
        Err(RecvTimeoutError::Timeout) => Ok(Answer::Timeout),
        Err(RecvTimeoutError::Disconnected) => {
            Ok(Answer::Panic { detail: "the process died (stack overflow or out of memory)".to_string() })
        }
    }
}
