//! `cargo xtask keystrokes`: how soon the language server tells faults after a keystroke.
//!
//! In: the program, built as users have it. Out: for a model of 1 000 and one of 10 000 lines, with an import, the time from the
//! message of a letter that is typed to the message of the faults, p50 and p95; the time to start; the memory with all examples
//! open. It prints, and judges nothing.

use std::io::{BufRead, BufReader, Read, Write};
use std::path::{Path, PathBuf};
use std::process::{Child, ChildStdin, ChildStdout, Command, Stdio};
use std::time::{Duration, Instant};

use serde_json::{Value, json};

use crate::arguments::Arguments;
use crate::{Failure, Outcome, repository};

/// Letters that are typed into each model.
const LETTERS: usize = 60;

/// Runs the command.
pub fn run(words: &[String]) -> Result<Outcome, Failure> {
    let arguments = Arguments::read(words, &["--binary"], &[])?;
    let root = repository::root();
    let binary = arguments.option("--binary").map_or_else(|| root.join("target/release/groundstate"), PathBuf::from);
    if !binary.exists() {
        return Err(format!("{} is not there: cargo build --release --package cli", binary.display()));
    }
    let folder = tempfile::tempdir().map_err(|error| error.to_string())?;
    let begun = Instant::now();
    let mut server = Server::start(&binary, folder.path())?;
    println!("started in {}", shown(begun.elapsed()));
    std::fs::write(folder.path().join("Part.asm"), PART).map_err(|error| error.to_string())?;
    for lines in [1_000, 10_000] {
        let name = format!("Model{lines}");
        let mut times = server.type_letters(folder.path(), &name, &model(&name, lines))?;
        times.sort();
        let at = |percent: usize| shown(times[(times.len() - 1) * percent / 100]);
        println!("{lines} lines: p50 {}, p95 {}, longest {}", at(50), at(95), at(100));
    }
    let mut server = Server::start(&binary, &root)?;
    let mut texts = Vec::new();
    for path in repository::files()? {
        let kind = groundstate::Kind::of(Path::new(&path));
        if kind.is_some() && path.starts_with("examples/") {
            texts.push(path);
        }
    }
    for path in &texts {
        let text = std::fs::read_to_string(root.join(path)).map_err(|error| format!("{path}: {error}"))?;
        server.open(&root.join(path), &text)?;
        server.faults(&root.join(path), 1)?;
    }
    println!("{} examples open: {} MB", texts.len(), server.memory_kb()? / 1024);
    Ok(Outcome::Good)
}

fn shown(time: Duration) -> String {
    format!("{:.1} ms", time.as_secs_f64() * 1e3)
}

const PART: &str = "module Part\nimport StandardLibrary\nexport *\nsignature:\n\tenum domain Mode = {IDLE | BUSY}\n\tcontrolled mode: Integer -> Mode\ndefinitions:\n";

/// A model of so many lines that uses what it imports.
fn model(name: &str, lines: usize) -> String {
    let rules = (lines - 14) / 7;
    let mut text = format!(
        "asm {name}\nimport StandardLibrary\nimport Part\nsignature:\n\tcontrolled level: Integer -> Integer\n\tmonitored pressed: Boolean\ndefinitions:\n"
    );
    for rule in 0..rules {
        text += &format!(
            "\trule r_{rule}($n in Integer) =\n\t\tif pressed and level($n) < {rule} then\n\t\t\tlevel($n) := level($n) + 1\n\t\telse\n\t\t\tmode($n) := BUSY\n\t\tendif\n"
        );
    }
    text += "\tmain rule r_Main =\n\t\tpar\n";
    for rule in 0..rules {
        text += &format!("\t\t\tr_{rule}[{rule}]\n");
    }
    text += "\t\tendpar\ndefault init s0:\n";
    text + "\tfunction level($n in Integer) = 0\n"
}

struct Server {
    process: Child,
    input: ChildStdin,
    output: BufReader<ChildStdout>,
}

impl Drop for Server {
    fn drop(&mut self) {
        _ = self.process.kill();
        _ = self.process.wait();
    }
}

impl Server {
    fn start(binary: &Path, folder: &Path) -> Result<Server, Failure> {
        let mut process = Command::new(binary)
            .arg("lsp")
            .stdin(Stdio::piped())
            .stdout(Stdio::piped())
            .spawn()
            .map_err(|error| format!("{}: {error}", binary.display()))?;
        let (input, output) = (process.stdin.take(), process.stdout.take());
        let (Some(input), Some(output)) = (input, output) else { return Err("no pipes".to_string()) };
        let mut server = Server { process, input, output: BufReader::new(output) };
        let folders = json!([{ "uri": uri(folder), "name": "folder" }]);
        let params = json!({ "processId": null, "capabilities": {}, "workspaceFolders": folders });
        server.send(&json!({ "jsonrpc": "2.0", "id": 1, "method": "initialize", "params": params }))?;
        while server.receive()?["id"] != 1 {}
        server.send(&json!({ "jsonrpc": "2.0", "method": "initialized", "params": {} }))?;
        Ok(server)
    }

    fn send(&mut self, message: &Value) -> Result<(), Failure> {
        let text = message.to_string();
        let sent = write!(self.input, "Content-Length: {}\r\n\r\n{text}", text.len()).and_then(|()| self.input.flush());
        sent.map_err(|error| error.to_string())
    }

    fn receive(&mut self) -> Result<Value, Failure> {
        let mut length = 0;
        loop {
            let mut line = String::new();
            if self.output.read_line(&mut line).map_err(|error| error.to_string())? == 0 {
                return Err("the server ended".to_string());
            }
            match line.trim().strip_prefix("Content-Length: ") {
                Some(number) => length = number.parse().map_err(|_| line.clone())?,
                None if line.trim().is_empty() => break,
                None => {}
            }
        }
        let mut text = vec![0; length];
        self.output.read_exact(&mut text).map_err(|error| error.to_string())?;
        serde_json::from_slice(&text).map_err(|error| error.to_string())
    }

    fn open(&mut self, path: &Path, text: &str) -> Result<(), Failure> {
        let document = json!({ "uri": uri(path), "languageId": "asmetal", "version": 1, "text": text });
        let params = json!({ "textDocument": document });
        self.send(&json!({ "jsonrpc": "2.0", "method": "textDocument/didOpen", "params": params }))
    }

    /// Waits for the faults of a version of a file.
    fn faults(&mut self, path: &Path, version: usize) -> Result<Value, Failure> {
        loop {
            let message = self.receive()?;
            let params = &message["params"];
            if params["uri"] == uri(path).as_str() && params["version"] == version {
                return Ok(params["diagnostics"].clone());
            }
        }
    }

    /// Types letters into a rule in the middle, one after the other has been checked; every second one is a fault.
    fn type_letters(&mut self, folder: &Path, name: &str, text: &str) -> Result<Vec<Duration>, Failure> {
        let path = folder.join(format!("{name}.asm"));
        std::fs::write(&path, text).map_err(|error| error.to_string())?;
        self.open(&path, text)?;
        self.faults(&path, 1)?;
        let line = 7 + text.lines().count() / 14 * 6 + 2;
        let mut times = Vec::new();
        for version in 2..2 + LETTERS {
            let (end, letter) = if version % 2 == 0 { (3, "x") } else { (4, "") };
            let range = json!({
                "start": { "line": line, "character": 3 }, "end": { "line": line, "character": end },
            });
            let params = json!({
                "textDocument": { "uri": uri(&path), "version": version },
                "contentChanges": [{ "range": range, "text": letter }],
            });
            let begun = Instant::now();
            self.send(&json!({ "jsonrpc": "2.0", "method": "textDocument/didChange", "params": params }))?;
            let faults = self.faults(&path, version)?;
            times.push(begun.elapsed());
            let errors = faults
                .as_array()
                .map_or(0, |faults| faults.iter().filter(|fault| fault["code"] == "unknown-function").count());
            if errors != usize::from(version % 2 == 0) {
                return Err(format!("version {version} has {errors} faults"));
            }
        }
        Ok(times)
    }

    fn memory_kb(&self) -> Result<u64, Failure> {
        let path = format!("/proc/{}/status", self.process.id());
        let status = std::fs::read_to_string(&path).map_err(|error| format!("{path}: {error}"))?;
        let line = status.lines().find(|line| line.starts_with("VmHWM:"));
        let number = line.and_then(|line| line.split_whitespace().nth(1)).and_then(|word| word.parse().ok());
        number.ok_or_else(|| format!("{path} tells no memory"))
    }
}

fn uri(path: &Path) -> String {
    format!("file://{}", path.display())
}
