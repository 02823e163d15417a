//! Follows a recording while a program writes it.
//!
//! The file may not exist yet. It grows, and is read on several times a second. A difference is reported once all tasks
//! have recorded events after it; it ends the command. So does the end of the recording. A program that was killed
//! writes no end: then Ctrl-C ends the command, and the verdict is *not known*.

use std::fs::File;
use std::io::{ErrorKind, IsTerminal, Read};
use std::path::{Path, PathBuf};
use std::time::{Duration, Instant};

use groundstate::job::{self, Cancel, ConformEvent, ConformRequest, Events, NotConformed, Piece};
use indicatif::{ProgressBar, ProgressDrawTarget, ProgressStyle};
use wire::FollowedTold;

use super::{Arguments, not_started, refused, say, unreadable};
use crate::exit::Exit;
use crate::failure::Failure;
use crate::interrupt;
use crate::load::load;
use crate::shell::Shell;
use crate::within;

/// How often the file is looked at.
const PAUSE: Duration = Duration::from_millis(50);
/// How long it is silent at least between two objects that tell how far it is.
const APART: Duration = Duration::from_millis(100);
/// The most bytes that are read before they are compared.
const AT_ONCE: u64 = 8 << 20;

pub fn run(shell: &mut Shell, arguments: &Arguments) -> Result<Exit, Failure> {
    let loaded = match load(shell, &arguments.model)? {
        Ok(loaded) => loaded,
        Err(exit) => return Ok(exit),
    };
    interrupt::listen();
    let path = &arguments.recording;
    let limit = shell.global.limits.recording();
    let tail = Tail { path: path.clone(), file: None, read: 0, limit, waits: false };
    let limits = shell.global.limits.uninterrupted();
    let request = ConformRequest { loaded, events: Events::Coming(tail), limits, by_order: arguments.untimed };
    let job = job::conform(request, Cancel::from(interrupt::request().clone())).map_err(not_started)?;
    let status = Status::new(shell.talks());
    let mut told: Option<(Instant, i64)> = None;
    while let Some(event) = job.next_event() {
        match event {
            ConformEvent::Awaits => status.say(format!("waiting for the first events in {}", path.display())),
            ConformEvent::Agrees(agreed) if shell.json() => {
                if told.is_none_or(|(then, _)| then.elapsed() >= APART) {
                    let before_ns = told.map_or(-1, |(_, time_ns)| time_ns);
                    told = Some((Instant::now(), agreed.time_ns));
                    shell.object(&FollowedTold::new(agreed, before_ns))?;
                    shell.flush()?;
                }
            }
            ConformEvent::Agrees(agreed) => status.say(agreed.words),
        }
    }
    status.done();
    match job.finish().unwrap_or_else(|crashed| panic!("{}", crashed.0)) {
        Ok(conformed) => say(shell, &conformed),
        Err(NotConformed::Unread(failure)) => Err(failure),
        Err(NotConformed::Malformed(malformed)) => Err(unreadable(path, &malformed)),
        Err(NotConformed::Refused(refusal)) => refused(shell, path, refusal),
        Err(NotConformed::NoEvents) => Err(Failure::usage(format!("{} has no events yet", path.display()))),
    }
}

/// A growing file, read on from where the last look ended.
struct Tail {
    path: PathBuf,
    file: Option<File>,
    read: u64,
    /// The largest number of bytes that are read.
    limit: u64,
    /// Whether the last look reached the present end of the file.
    waits: bool,
}

impl job::Tail for Tail {
    type Trouble = Failure;

    fn next(&mut self) -> Result<Piece, Failure> {
        if self.waits {
            std::thread::sleep(PAUSE);
        }
        let bytes = self.read()?;
        self.waits = (bytes.len() as u64) < AT_ONCE;
        Ok(Piece { bytes, is_all: self.waits })
    }
}

impl Tail {
    /// Reads what is new; nothing if the file does not exist yet.
    fn read(&mut self) -> Result<Vec<u8>, Failure> {
        let path: &Path = &self.path;
        let wrong = |error| Failure::of_file("read", path, error);
        let file = match &mut self.file {
            Some(file) => file,
            none => match within::may_read(path).map(|()| File::open(path))? {
                Ok(file) => none.insert(file),
                Err(error) if error.kind() == ErrorKind::NotFound => return Ok(Vec::new()),
                Err(error) => return Err(wrong(error)),
            },
        };
        if file.metadata().map_err(wrong)?.len() < self.read {
            return Err(Failure::usage_with_help(
                format!("{} was restarted while it was being followed", path.display()),
                "let each run of the program write its own file",
            ));
        }
        let mut bytes = Vec::new();
        // Reading one byte more than allowed shows that the file exceeds the limit.
        let left = (self.limit - self.read).saturating_add(1).min(AT_ONCE);
        self.read += file.take(left).read_to_end(&mut bytes).map_err(wrong)? as u64;
        if self.read > self.limit {
            return Err(Failure::TooLarge { path: path.to_path_buf(), limit: self.limit });
        }
        Ok(bytes)
    }
}

/// A status line on the terminal.
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

    fn done(&self) {
        if let Some(bar) = &self.0 {
            bar.finish_and_clear();
        }
    }
}
