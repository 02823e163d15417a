//! From a chart to its program that runs and is compared with the model: what `groundstate` and CMake do one after the other.
//!
//! In: a chart with a system, and the folder of its C++. Out: stages and lines as they come; while the program runs, what each task does
//! (`followed`); at its end the verdict of `groundstate conform`, word for word. The program is built in `build` of its folder, and is the
//! target with the name of the CMake project. INVARIANT: a program that was stopped has no verdict. LIMIT: seconds of the program, and
//! how much longer it may take to end.

use std::path::Path;
use std::process::Command;
use std::time::{Duration, Instant};

use groundstate::Kind;
use serde_json::{Value, json};

use crate::folder::Folder;
use crate::home::Home;
use crate::job::{LOOK, Process, Task, started};

/// LIMIT: seconds of a program.
const SECONDS: u64 = 60;
/// LIMIT: how much longer a program may take to end than it was told to run.
const PATIENCE: Duration = Duration::from_secs(30);
/// How long the comparison may take to find the end of a recording that has none.
const TRAILING: Duration = Duration::from_secs(3);

/// What is to be built and run.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Plan {
    /// The chart's path without its ending, as the command line takes it.
    stem: String,
    home: Home,
    seconds: u64,
    /// In the model's time: as fast as can be.
    is_virtual: bool,
}

impl Plan {
    /// What a tab asks for.
    ///
    /// # Errors
    /// There is no program of such a file; a sentence.
    pub fn of(path: &str, home: &Home, options: &Value) -> Result<Plan, String> {
        if Kind::of(Path::new(path)) != Some(Kind::Chart) {
            return Err(format!("{path} has no program: a chart with a system has one"));
        }
        let stem = path.rsplit_once('.').map_or(path, |(stem, _)| stem);
        let seconds = options["seconds"].as_u64().unwrap_or(5).clamp(1, SECONDS);
        // A name that begins with `-` is a name.
        let is_virtual = options["pace"] == "virtual";
        Ok(Plan { stem: format!("./{stem}"), home: home.clone(), seconds, is_virtual })
    }

    fn chart(&self) -> String {
        format!("{}.chart", self.stem)
    }

    fn code(&self) -> String {
        format!("./{}", self.home.path)
    }

    fn build(&self) -> String {
        format!("./{}/build", self.home.path)
    }

    fn log(&self) -> String {
        format!("./{}/build/run.mcap", self.home.path)
    }
}

fn words(all: &[&str]) -> Vec<String> {
    all.iter().map(|word| word.to_string()).collect()
}

fn stage(task: &Task, stage: &str) {
    task.say(&json!({ "type": "stage", "stage": stage }));
}

/// Builds and runs it. Out: the code of the comparison, or of what went wrong before; none if it was stopped.
pub fn run(task: &Task, folder: &Folder, plan: &Plan) -> Option<i32> {
    let mut generate = words(&["generate", "cpp", &plan.chart()]);
    generate.extend(plan.home.words());
    for (name, mut all) in [("model", words(&["chart", "build", &plan.chart()])), ("generate", generate)] {
        stage(task, name);
        all.extend(words(&["--within", ".", "--format", "json"]));
        let child = started(&mut task.jobs().command(&all));
        match told(task, child.map(|child| task.follow(child))) {
            Some(0) => {}
            other => return other,
        }
    }
    stage(task, "compile");
    let program = match compiled(task, folder, plan) {
        Ok(Some(program)) => program,
        Ok(None) => return None,
        Err(reason) => {
            if let Some(reason) = reason {
                task.say(&Value::from(reason));
            }
            return Some(2);
        }
    };
    stage(task, "run");
    // A recording that is followed begins anew.
    if let Err(reason) = removed(folder, &plan.log()) {
        task.say(&Value::from(reason));
        return Some(2);
    }
    match compared(task, plan, &program) {
        Ok(code) => code,
        Err(reason) => {
            task.say(&Value::from(reason));
            Some(2)
        }
    }
}

/// A process that could not be started is told of.
fn told(task: &Task, ran: Result<Option<i32>, String>) -> Option<i32> {
    match ran {
        Ok(code) => code,
        Err(reason) => {
            task.say(&Value::from(reason));
            Some(2)
        }
    }
}

/// The program runs and writes; the comparison reads along. Out: its code; none if the tab stopped it.
fn compared(task: &Task, plan: &Plan, program: &str) -> Result<Option<i32>, String> {
    let model = format!("{}.asm", plan.stem);
    let follow = words(&["conform", "--follow", &model, &plan.log(), "--within", ".", "--format", "json"]);
    let mut conform = task.attach(started(&mut task.jobs().command(&follow))?);
    let mut command = Command::new(program);
    let pace = if plan.is_virtual { "--virtual" } else { "--real" };
    command.args([pace, &plan.seconds.to_string(), "--log", &plan.log()]);
    let mut runs = match started(&mut task.jobs().within(command)) {
        Ok(child) => task.attach(child),
        Err(reason) => {
            conform.end();
            waited(&mut conform);
            conform.drain();
            return Err(reason);
        }
    };
    let begun = Instant::now();
    let (mut is_late, mut is_stopped, mut over): (bool, bool, Option<Instant>) = (false, false, None);
    let code = loop {
        is_stopped |= task.is_stopped();
        if is_stopped {
            runs.end();
            conform.end();
        }
        if over.is_none() && runs.ended().is_some() {
            over = Some(Instant::now());
            match runs.code() {
                Some(0) => {}
                Some(code) if !is_stopped => task.say(&Value::from(format!("the program ended with exit code {code}"))),
                None if !is_stopped && !is_late => task.say(&Value::from("the program was ended by a signal")),
                _ => {}
            }
        }
        if over.is_none() && begun.elapsed() > Duration::from_secs(plan.seconds) + PATIENCE {
            if !is_late {
                task.say(&Value::from(format!("the program did not end after {} s: it was ended", plan.seconds)));
            }
            is_late = true;
            runs.end();
        }
        let decided = conform.ended().map(|code| code.or_else(|| conform.code()));
        match (decided, over) {
            (Some(code), Some(_)) => break code,
            // It knows the verdict already: the program need not go on.
            (Some(_), None) => runs.end(),
            // A program that did not end by itself leaves a recording without an end.
            (None, Some(then)) if (is_late || runs.code() != Some(0)) && then.elapsed() > TRAILING => conform.end(),
            (None, _) => {}
        }
        std::thread::sleep(LOOK);
    };
    runs.drain();
    conform.drain();
    Ok(code.filter(|_| !is_stopped))
}

fn waited(process: &mut Process) {
    while process.ended().is_none() {
        process.end();
        std::thread::sleep(LOOK);
    }
}

/// Has CMake make the program. Out: where it is; none if the tab stopped it.
///
/// # Errors
/// It was not made; a sentence, if CMake did not say it.
fn compiled(task: &Task, folder: &Folder, plan: &Plan) -> Result<Option<String>, Option<String>> {
    let cmake = |all: &[&str]| -> Result<Option<()>, Option<String>> {
        let mut cmake = Command::new("cmake");
        cmake.args(all);
        match task.follow(started(&mut task.jobs().within(cmake))?) {
            Some(0) => Ok(Some(())),
            Some(_) => Err(None),
            None => Ok(None),
        }
    };
    let (code, build) = (plan.code(), plan.build());
    forget_other_places(folder, plan)?;
    if cmake(&["-S", &code, "-B", &build])?.is_none() {
        return Ok(None);
    }
    let cache = folder.read(&format!("{}/build/CMakeCache.txt", plan.home.path))?.unwrap_or_default();
    let Some(name) = project_of(&cache) else {
        return Err(Some(format!(
            "CMakeLists.txt of {} has no project: its name is that of the program",
            plan.home.path
        )));
    };
    if cmake(&["--build", &build, "--parallel", "2", "--target", name])?.is_none() {
        return Ok(None);
    }
    let path = format!("{}/build/{name}", plan.home.path);
    match folder.place(&path) {
        Ok(place) if place.is_file() => Ok(Some(place.to_string_lossy().into_owned())),
        _ => Err(Some(format!("CMake has made no {path}: there is the program looked for, with the project's name"))),
    }
}

/// A folder that was moved or copied brings what CMake knows of its former place along; there it would refuse to build.
fn forget_other_places(folder: &Folder, plan: &Plan) -> Result<(), String> {
    let build = format!("{}/build", plan.home.path);
    let file = format!("{build}/CMakeCache.txt");
    let cache = folder.read(&file)?.unwrap_or_default();
    let known = cache.lines().find_map(|line| line.strip_prefix("CMAKE_CACHEFILE_DIR:INTERNAL="));
    let real = |path: &Path| std::fs::canonicalize(path).ok();
    match known {
        Some(known) if real(Path::new(known)) != real(&folder.place(&build)?) => removed(folder, &file),
        _ => Ok(()),
    }
}

/// The name of the project that a build is of.
fn project_of(cache: &str) -> Option<&str> {
    cache.lines().find_map(|line| line.strip_prefix("CMAKE_PROJECT_NAME:STATIC=")).filter(|name| !name.is_empty())
}

fn removed(folder: &Folder, log: &str) -> Result<(), String> {
    let place = folder.place(log.trim_start_matches("./"))?;
    match std::fs::remove_file(&place) {
        Err(error) if error.kind() != std::io::ErrorKind::NotFound => Err(format!("{log} cannot be removed: {error}")),
        _ => Ok(()),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_asked_for_is_bounded() {
        let home = Home { path: "a/arm".to_string(), is_own: true };
        let plan = |options: Value| Plan::of("a/-b.chart", &home, &options).expect("it is a chart");
        let like = |seconds: u64, is_virtual: bool| Plan {
            stem: "./a/-b".to_string(),
            home: home.clone(),
            seconds,
            is_virtual,
        };
        assert_eq!(plan(json!({})), like(5, false));
        let most = plan(json!({ "seconds": 1_000_000, "pace": "virtual", "log": "/etc/passwd" }));
        assert_eq!((&most, most.log()), (&like(60, true), "./a/arm/build/run.mcap".to_string()));
        assert_eq!(plan(json!({ "seconds": 0 })).seconds, 1);
        assert_eq!(
            Plan::of("a.asm", &home, &json!({})),
            Err("a.asm has no program: a chart with a system has one".to_string())
        );
    }

    /// What comes of a program and a comparison that are such scripts: the code, and all lines. Stops the job when a line says so.
    #[cfg(unix)]
    fn outcome(conform: &str, program: &str) -> (Option<i32>, String) {
        use std::os::unix::fs::PermissionsExt;
        use std::sync::Arc;

        use crate::job::Jobs;
        use crate::tell::Out;

        let place = tempfile::tempdir().expect("a folder");
        let script = |name: &str, text: &str| {
            let path = place.path().join(name);
            std::fs::write(&path, format!("#!/bin/sh\n{text}\n")).expect("written");
            std::fs::set_permissions(&path, std::fs::Permissions::from_mode(0o755)).expect("set");
            path
        };
        let jobs = Arc::new(Jobs::new(script("conform", conform), place.path().to_path_buf()));
        let program = script("program", program).to_string_lossy().into_owned();
        let home = Home { path: "a.generated".to_string(), is_own: false };
        let plan = Plan::of("a.chart", &home, &json!({})).expect("it is a chart");
        let (out, mut told) = tokio::sync::mpsc::channel(100);
        let work = move |task: &Task| compared(task, &plan, &program).expect("it begins");
        let number = jobs.start_work(7, out, work).expect("it begins");
        let mut lines = String::new();
        while let Some(Out::Say(message)) = told.blocking_recv() {
            let message: Value = serde_json::from_str(&message).expect("JSON");
            if message["method"] == "studio/done" {
                return (message["params"]["code"].as_i64().map(|code| code as i32), lines);
            }
            if message["params"]["line"] == "stop me" {
                assert!(jobs.stop(7, number));
            }
            lines += &message["params"]["line"].to_string();
        }
        panic!("it ends");
    }

    #[cfg(unix)]
    #[test]
    fn the_end_of_a_program_is_told() {
        let waits = "trap 'echo not known; exit 3' INT; sleep 600 & wait";
        let (code, lines) = outcome("sleep 1; echo conforms", "echo ran $*");
        assert_eq!(code, Some(0));
        assert!(lines.contains("conforms") && lines.contains("ran --real 5 --log"), "{lines}");
        // The comparison knows that they differ while the program goes on.
        let (code, lines) = outcome("echo parts; exit 1", "sleep 600");
        assert_eq!((code, lines.contains("parts")), (Some(1), true), "{lines}");
        // A program that fails writes no end: the comparison is asked what it knows.
        let (code, lines) = outcome(waits, "exit 9");
        assert_eq!(code, Some(3));
        assert!(lines.contains("ended with exit code 9") && lines.contains("not known"), "{lines}");
        let (code, lines) = outcome(waits, "kill -9 $$");
        assert_eq!((code, lines.contains("ended by a signal")), (Some(3), true), "{lines}");
    }

    #[cfg(unix)]
    #[test]
    fn a_program_that_is_stopped_has_no_verdict() {
        // Neither listens, and the comparison says something all the same.
        let (code, _) =
            outcome("trap 'echo conforms; exit 0' INT; sleep 600 & wait", "echo stop me; trap '' INT; sleep 600");
        assert_eq!(code, None);
        let (code, _) = outcome("trap '' INT; sleep 600", "echo stop me; sleep 600");
        assert_eq!(code, None);
    }
}
