//! SMT solvers as processes: z3 or cvc5, found on the PATH or named, given a script and a limit of time.

use std::io::Write;
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};

/// How long a solver may think about one question, in seconds.
const SECONDS: u32 = 10;

/// A solver that is started anew for each question.
#[derive(Debug)]
pub struct Process {
    /// The program; none where there is none.
    program: Option<PathBuf>,
    /// It was named by the user.
    named: bool,
}

impl Process {
    /// The solver named, `none` for none; else the first one on the PATH.
    pub fn find(named: Option<&Path>) -> Self {
        match named {
            Some(path) if path == Path::new("none") => Process { program: None, named: true },
            Some(path) => Process { program: Some(path.to_path_buf()), named: true },
            None => Process { program: on_path(&["z3", "cvc5"]), named: false },
        }
    }
}

fn on_path(names: &[&str]) -> Option<PathBuf> {
    let folders: Vec<PathBuf> = std::env::split_paths(&std::env::var_os("PATH")?).collect();
    let candidates = names.iter().flat_map(|name| folders.iter().map(move |folder| folder.join(name)));
    candidates.into_iter().find(|path| path.is_file() || path.with_extension("exe").is_file())
}

impl smt::Solver for Process {
    fn solve(&mut self, script: &str) -> Result<String, String> {
        let Some(program) = &self.program else {
            return Err(match self.named {
                true => "no solver is to be asked".to_string(),
                false => "no SMT solver (z3 or cvc5) is on the PATH".to_string(),
            });
        };
        let told = |error: std::io::Error| format!("the solver {} does not run: {error}", program.display());
        let mut command = Command::new(program);
        let name = program.file_stem().map(|name| name.to_string_lossy().to_lowercase()).unwrap_or_default();
        if name.starts_with("cvc5") {
            command.args(["--lang=smt2", &format!("--tlimit={}", SECONDS * 1000)]);
        } else if name.starts_with("z3") {
            command.args(["-smt2", "-in", &format!("-T:{SECONDS}")]);
        }
        command.stdin(Stdio::piped()).stdout(Stdio::piped()).stderr(Stdio::null());
        let mut child = command.spawn().map_err(told)?;
        if let Some(mut input) = child.stdin.take() {
            // A solver that stops reading has said what it has to say.
            let _ = input.write_all(script.as_bytes());
        }
        let output = child.wait_with_output().map_err(told)?;
        Ok(String::from_utf8_lossy(&output.stdout).into_owned())
    }
}
