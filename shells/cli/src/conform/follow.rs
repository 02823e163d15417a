//! Reads along while a program writes its recording.
//!
//! The file may come into being later, and grows; it is read where it was left, several times a second. A parting is told
//! as soon as all tasks are known beyond it, and ends the command; so does the end of the recording. A program that was
//! killed writes no end: then Ctrl-C says that it is over, and the verdict is *not known*.

use std::fs::File;
use std::io::{ErrorKind, IsTerminal, Read};
use std::path::Path;
use std::time::Duration;

use ::conform::{Reader, Recording, Session, Verdict};
use indicatif::{ProgressBar, ProgressDrawTarget, ProgressStyle};

use super::{Arguments, refused, session, tell, unreadable};
use crate::exit::Exit;
use crate::failure::Failure;
use crate::interrupt;
use crate::load::load;
use crate::shell::Shell;

/// From one look at the file to the next.
const PAUSE: Duration = Duration::from_millis(50);
/// So much is read before what came is looked at.
const AT_ONCE: u64 = 8 << 20;

pub fn run(shell: &mut Shell, arguments: &Arguments) -> Result<Exit, Failure> {
    let mut loaded = match load(shell, &arguments.model)? {
        Ok(loaded) => Some(loaded),
        Err(exit) => return Ok(exit),
    };
    interrupt::listen();
    let path = &arguments.recording;
    let mut tail = Tail { file: None, read: 0, limit: shell.global.limits.recording() };
    let mut reader = Reader::default();
    let mut replay: Option<Session> = None;
    let status = Status::new(shell.talks());
    loop {
        // Asked before the last look, so that what was written till then is looked at.
        let asked = interrupt::asked();
        let bytes = tail.read(path)?;
        let is_all = (bytes.len() as u64) < AT_ONCE;
        let stops = asked && is_all;
        reader.feed(&bytes).map_err(|malformed| unreadable(path, &malformed))?;
        let recording = reader.recording();
        let more = !reader.has_ended() && !stops;
        // The head stands before the first event.
        if recording.events() > 0 || reader.has_ended() {
            if let Some(loaded) = loaded.take() {
                match session(shell, loaded, path, recording, arguments.untimed)? {
                    Ok(session) => replay = Some(session),
                    Err(exit) => return Ok(exit),
                }
            }
            let Some(session) = &mut replay else { unreachable!("it was begun above") };
            match session.go_on(recording, more) {
                Ok(Some(verdict)) => {
                    status.done();
                    let verdict = if stops { interrupted(verdict) } else { verdict };
                    return tell(shell, session.sources(), recording, &verdict, session.way().words());
                }
                Ok(None) => status.agrees(session, recording),
                Err(refusal) => return refused(shell, path, refusal),
            }
        } else if stops {
            status.done();
            return Err(Failure::usage(format!("{} has no events yet", path.display())));
        } else {
            status.awaits(path);
        }
        if is_all {
            std::thread::sleep(PAUSE);
        }
    }
}

/// Said of a run whose end nobody waited for.
fn interrupted(verdict: Verdict) -> Verdict {
    match verdict {
        Verdict::Unknown { events, .. } => {
            Verdict::Unknown { events, reason: "the run went on when following it was ended".to_string() }
        }
        other => other,
    }
}

/// A file that grows, read where it was left.
struct Tail {
    file: Option<File>,
    read: u64,
    /// The most bytes that are read.
    limit: u64,
}

impl Tail {
    /// What is new; nothing as long as there is no file.
    fn read(&mut self, path: &Path) -> Result<Vec<u8>, Failure> {
        let wrong = |error| Failure::of_file("read", path, error);
        let file = match &mut self.file {
            Some(file) => file,
            none => match File::open(path) {
                Ok(file) => none.insert(file),
                Err(error) if error.kind() == ErrorKind::NotFound => return Ok(Vec::new()),
                Err(error) => return Err(wrong(error)),
            },
        };
        if file.metadata().map_err(wrong)?.len() < self.read {
            return Err(Failure::usage_with_help(
                format!("{} was begun anew while it was followed", path.display()),
                "let each run of the program write a file of its own",
            ));
        }
        let mut bytes = Vec::new();
        // One byte more than allowed tells a file at the limit from one beyond it.
        let left = (self.limit - self.read).saturating_add(1).min(AT_ONCE);
        self.read += file.take(left).read_to_end(&mut bytes).map_err(wrong)? as u64;
        if self.read > self.limit {
            return Err(Failure::TooLarge { path: path.to_path_buf(), limit: self.limit });
        }
        Ok(bytes)
    }
}

/// A line on the terminal that tells how far it is.
struct Status(Option<ProgressBar>);

impl Status {
    fn new(talks: bool) -> Status {
        if !talks || !std::io::stderr().is_terminal() {
            return Status(None);
        }
        let bar = ProgressBar::no_length().with_style(
            ProgressStyle::with_template("{spinner} {msg}").unwrap_or_else(|_| ProgressStyle::default_spinner()),
        );
        bar.set_draw_target(ProgressDrawTarget::stderr_with_hz(10));
        Status(Some(bar))
    }

    fn say(&self, words: String) {
        if let Some(bar) = &self.0 {
            bar.set_message(words);
            bar.tick();
        }
    }

    fn awaits(&self, path: &Path) {
        self.say(format!("waiting for the first events in {}", path.display()));
    }

    /// How far the two agree, and what is waited for where a task is silent.
    fn agrees(&self, session: &Session, recording: &Recording) {
        let seconds = |ns: i64| ns as f64 / 1e9;
        let last = |track: &&::conform::Track| track.events.last().map_or(0, |event| event.time_ns);
        let newest = recording.tracks.iter().map(|track| last(&track)).max().unwrap_or(0);
        let behind = recording.tracks.iter().min_by_key(last);
        let silent = match behind {
            Some(track) if newest - last(&track) > 1_000_000_000 => {
                format!("; {} has been silent since {:.1} s", track.task, seconds(last(&track)))
            }
            _ => String::new(),
        };
        self.say(format!("{} events agree, the run is at {:.1} s{silent}", session.agreed(), seconds(newest)));
    }

    fn done(&self) {
        if let Some(bar) = &self.0 {
            bar.finish_and_clear();
        }
    }
}
