//! z3 and cvc5 as processes, and a missing solver.
//!
//! In: only the search path of programs. Out: sessions. A solver that is not installed is left out, and stderr says so;
//! the test then has nothing to ask. `make unit` installs both.

use std::io::{BufRead, BufReader, Write};
use std::process::{Child, ChildStdin, ChildStdout, Command, Stdio};

use solve::session::{Session, Silence, Solvers, is_answer};

/// A solver that answers nothing: everything must be decided without one.
#[derive(Debug, Clone, Copy)]
pub struct NoSolver;

impl solve::Solver for NoSolver {
    fn solve(&mut self, _script: &str) -> Result<String, String> {
        Err("there is no solver".to_string())
    }
}

/// A solver by its name on the path.
#[derive(Debug, Clone)]
pub struct Installed {
    name: &'static str,
    version: String,
}

/// The solver of a name, if it is there.
fn installed(name: &'static str) -> Option<Installed> {
    let output = Command::new(name).arg("--version").output().ok()?;
    let text = String::from_utf8_lossy(&output.stdout).into_owned();
    let version = text.split_whitespace().find(|word| word.starts_with(|c: char| c.is_ascii_digit()))?;
    Some(Installed { name, version: version.to_string() })
}

/// The solvers that are installed: z3, and cvc5 unless Horn clauses must be solved. Says on stderr which one is
/// missing.
pub fn solvers(horn: bool) -> Vec<Installed> {
    let names: &[&'static str] = if horn { &["z3"] } else { &["z3", "cvc5"] };
    let mut found = Vec::new();
    for name in names {
        match installed(name) {
            Some(solver) => found.push(solver),
            None => eprintln!("{name} is not on the path: not tested"),
        }
    }
    found
}

struct Process {
    child: Child,
    input: ChildStdin,
    output: BufReader<ChildStdout>,
}

impl Drop for Process {
    fn drop(&mut self) {
        let _ = self.child.kill();
        let _ = self.child.wait();
    }
}

impl Solvers for Installed {
    fn name(&self) -> Result<String, String> {
        Ok(format!("{} {}", self.name, self.version))
    }

    fn start(&mut self) -> Result<Box<dyn Session>, Silence> {
        let arguments: &[&str] = match self.name {
            "z3" => &["-smt2", "-in", "-t:20000"],
            _ => &["--lang=smt2", "--incremental", "--tlimit-per=20000"],
        };
        let started = Command::new(self.name)
            .args(arguments)
            .stdin(Stdio::piped())
            .stdout(Stdio::piped())
            .stderr(Stdio::null())
            .spawn();
        let mut child = started.map_err(|error| Silence::Broken(error.to_string()))?;
        let (input, output) = (child.stdin.take(), child.stdout.take());
        let (Some(input), Some(output)) = (input, output) else { return Err(Silence::Late) };
        Ok(Box::new(Process { child, input, output: BufReader::new(output) }))
    }
}

impl Session for Process {
    fn ask(&mut self, commands: &str, _: u32, go_on: &mut dyn FnMut() -> bool) -> Result<String, Silence> {
        if !go_on() {
            return Err(Silence::Stopped);
        }
        let broken = |error: std::io::Error| Silence::Broken(error.to_string());
        self.input.write_all(commands.as_bytes()).and_then(|()| self.input.flush()).map_err(broken)?;
        let mut answer = String::new();
        while !is_answer(&answer) {
            if self.output.read_line(&mut answer).map_err(broken)? == 0 {
                return Err(Silence::Broken("it has ended".to_string()));
            }
        }
        Ok(answer)
    }
}
