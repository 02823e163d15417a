//! Runs SMT solvers as processes: z3 or cvc5, found on the PATH or named; for one question, or for a session.

use std::io::{BufRead, BufReader, Write};
use std::path::{Path, PathBuf};
use std::process::{Child, Command, Stdio};
use std::sync::mpsc::{Receiver, RecvTimeoutError, Sender, channel};
use std::time::{Duration, Instant};

use solve::session::{Session, Silence, Solvers, is_answer};

/// The time limit for a question that is asked on its own, in seconds.
const SECONDS: u32 = 10;
/// While a solver works, how often the caller is asked whether to go on.
const BETWEEN: Duration = Duration::from_millis(100);

/// Starts a solver for each question or session.
#[derive(Debug)]
pub struct Process {
    /// The solver's program; `None` if there is none.
    program: Option<PathBuf>,
    /// Whether the user named it.
    named: bool,
}

/// The solvers whose options are known.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Make {
    Z3,
    Cvc5,
    Other,
}

impl Process {
    /// The named solver, or none for `none`; without a name, the first one on the PATH.
    pub fn find(named: Option<&Path>) -> Self {
        match named {
            Some(path) if path == Path::new("none") => Process { program: None, named: true },
            Some(path) => Process { program: Some(path.to_path_buf()), named: true },
            None => Process { program: on_path(&["z3", "cvc5"]), named: false },
        }
    }

    /// Both solvers, as far as they are on the PATH.
    pub fn both() -> Vec<Process> {
        let there = ["z3", "cvc5"].into_iter().filter_map(|name| on_path(&[name]));
        there.map(|program| Process { program: Some(program), named: false }).collect()
    }

    fn program(&self) -> Result<&Path, String> {
        self.program.as_deref().ok_or_else(|| match self.named {
            true => "no solver may be asked".to_string(),
            false => "no SMT solver (z3 or cvc5) is on the PATH".to_string(),
        })
    }

    fn make(program: &Path) -> Make {
        let name = program.file_stem().map(|name| name.to_string_lossy().to_lowercase()).unwrap_or_default();
        if name.starts_with("cvc5") {
            Make::Cvc5
        } else if name.starts_with("z3") {
            Make::Z3
        } else {
            Make::Other
        }
    }

    fn spawn(program: &Path, arguments: &[String]) -> Result<Child, String> {
        let mut command = Command::new(program);
        command.args(arguments).stdin(Stdio::piped()).stdout(Stdio::piped()).stderr(Stdio::null());
        command.spawn().map_err(|error| format!("the solver {} does not run: {error}", program.display()))
    }
}

fn on_path(names: &[&str]) -> Option<PathBuf> {
    let folders: Vec<PathBuf> = std::env::split_paths(&std::env::var_os("PATH")?).collect();
    let candidates = names.iter().flat_map(|name| folders.iter().map(move |folder| folder.join(name)));
    candidates.into_iter().find(|path| path.is_file() || path.with_extension("exe").is_file())
}

impl solve::Solver for Process {
    fn solve(&mut self, script: &str) -> Result<String, String> {
        let program = self.program()?;
        let arguments = match Process::make(program) {
            Make::Cvc5 => vec!["--lang=smt2".to_string(), format!("--tlimit={}", SECONDS * 1000)],
            Make::Z3 => vec!["-smt2".to_string(), "-in".to_string(), format!("-T:{SECONDS}")],
            Make::Other => Vec::new(),
        };
        let mut child = Process::spawn(program, &arguments)?;
        if let Some(mut input) = child.stdin.take() {
            // A solver that stops reading has already said all that it will say.
            let _ = input.write_all(script.as_bytes());
        }
        let told = |error: std::io::Error| format!("the solver {} does not run: {error}", program.display());
        let output = child.wait_with_output().map_err(told)?;
        Ok(String::from_utf8_lossy(&output.stdout).into_owned())
    }
}

impl Solvers for Process {
    fn name(&self) -> Result<String, String> {
        let program = self.program()?;
        let output = Command::new(program).arg("--version").stdin(Stdio::null()).output();
        let output = output.map_err(|error| format!("the solver {} does not run: {error}", program.display()))?;
        let text = String::from_utf8_lossy(&output.stdout);
        let version = text.split_whitespace().find(|word| word.starts_with(|letter: char| letter.is_ascii_digit()));
        let name = match Process::make(program) {
            Make::Z3 => "z3".to_string(),
            Make::Cvc5 => "cvc5".to_string(),
            Make::Other => program.display().to_string(),
        };
        Ok(version.map_or(name.clone(), |version| format!("{name} {version}")))
    }

    fn start(&mut self) -> Result<Box<dyn Session>, Silence> {
        let program = self.program().map_err(Silence::Broken)?;
        let arguments: &[&str] = match Process::make(program) {
            Make::Cvc5 => &["--lang=smt2", "--incremental"],
            Make::Z3 => &["-smt2", "-in"],
            Make::Other => &[],
        };
        let arguments: Vec<String> = arguments.iter().map(ToString::to_string).collect();
        let mut child = Process::spawn(program, &arguments).map_err(Silence::Broken)?;
        let (input, output) = (child.stdin.take(), child.stdout.take());
        let (Some(mut input), Some(output)) = (input, output) else {
            return Err(Silence::Broken("the solver has no input or output".to_string()));
        };
        let (commands, texts) = channel::<String>();
        // Writing needs its own thread: a busy solver does not read, and the caller must be able to give up meanwhile.
        std::thread::spawn(move || {
            for text in texts {
                if input.write_all(text.as_bytes()).and_then(|()| input.flush()).is_err() {
                    return;
                }
            }
        });
        let (sender, answers) = channel();
        // The thread ends with the process that it reads from.
        std::thread::spawn(move || {
            let (mut output, mut answer) = (BufReader::new(output), String::new());
            while matches!(output.read_line(&mut answer), Ok(read) if read > 0) {
                if is_answer(&answer) && sender.send(std::mem::take(&mut answer)).is_err() {
                    return;
                }
            }
        });
        Ok(Box::new(Running { child, commands, answers }))
    }
}

/// A running solver.
struct Running {
    child: Child,
    commands: Sender<String>,
    answers: Receiver<String>,
}

impl Drop for Running {
    fn drop(&mut self) {
        let _ = self.child.kill();
        let _ = self.child.wait();
    }
}

impl Session for Running {
    fn ask(&mut self, commands: &str, seconds: u32, go_on: &mut dyn FnMut() -> bool) -> Result<String, Silence> {
        let ended = || Silence::Broken("the solver has ended".to_string());
        self.commands.send(commands.to_string()).map_err(|_| ended())?;
        let start = Instant::now();
        loop {
            if !go_on() {
                return Err(Silence::Stopped);
            }
            match self.answers.recv_timeout(BETWEEN) {
                Ok(answer) => return Ok(answer),
                Err(RecvTimeoutError::Disconnected) => return Err(ended()),
                Err(RecvTimeoutError::Timeout) if start.elapsed() >= Duration::from_secs(u64::from(seconds)) => {
                    return Err(Silence::Late);
                }
                Err(RecvTimeoutError::Timeout) => {}
            }
        }
    }
}
