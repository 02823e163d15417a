//! The systems whose logs are changed: generated, compiled and run here.
//!
//! In: charts of this repository. Out: for each a model, its chart, and logs of short runs: in the model's time, in drawn
//! time, and in real time, with locks and without. It must not know what is done with them.

use std::path::{Path, PathBuf};
use std::process::Command;

use chart::Chart;
use generate::system::{Form, Generated, generate, ungenerated};
use groundstate::Loaded;
use recording::Recording;

use crate::Failure;
use crate::corpus::Checkout;
use crate::repository::root;

/// A system of this repository.
#[derive(Debug, Clone, Copy)]
pub struct Subject {
    pub name: &'static str,
    /// Its chart, without the ending.
    path: &'static str,
    /// Its model, if that is not the one beside the chart.
    model: Option<&'static str>,
    /// A folder with hooks of its own.
    hooks: Option<&'static str>,
    /// How long its logs are.
    milliseconds: f64,
}

pub const SUBJECTS: &[Subject] = &[
    // The program without the machines of its components: the model that is written by hand has none.
    Subject {
        name: "controller",
        path: "examples/visual_servoing/ControllerSystem",
        model: Some("examples/visual_servoing/CompleteController"),
        hooks: None,
        milliseconds: 12.0,
    },
    Subject {
        name: "contention",
        path: "cpp/systems/Contention",
        model: None,
        hooks: Some("cpp/systems/contention"),
        milliseconds: 12.0,
    },
    Subject { name: "conveyor", path: "cpp/systems/Conveyor", model: None, hooks: None, milliseconds: 25.0 },
    Subject { name: "fusion", path: "cpp/systems/Fusion", model: None, hooks: None, milliseconds: 25.0 },
    Subject { name: "classifier", path: "cpp/systems/Classifier", model: None, hooks: None, milliseconds: 40.0 },
];

/// A log of a system.
#[derive(Debug)]
pub struct Log {
    /// By which it is told from the others.
    pub name: String,
    pub recording: Recording,
}

impl Subject {
    /// The chart.
    ///
    /// # Errors
    /// It cannot be read.
    pub fn chart(&self) -> Result<Chart, Failure> {
        let path = root().join(self.path).with_extension("chart");
        let text = std::fs::read_to_string(&path).map_err(|error| format!("{}: {error}", path.display()))?;
        let mut sources = syntax::Sources::default();
        let file = sources.add(syntax::SourceFile::new(self.path, text.as_str()));
        let (chart, faults) = chart::read(file, &syntax::parse_chart(file, &text));
        match faults.first() {
            Some(fault) => Err(format!("{}: {}", path.display(), fault.message)),
            None => Ok(chart),
        }
    }

    /// The model.
    ///
    /// # Errors
    /// It has faults.
    pub fn model(&self) -> Result<Loaded, Failure> {
        let mut checkout = Checkout { root: root() };
        let source = checkout.source(&format!("{}.asm", self.model.unwrap_or(self.path)))?;
        groundstate::load(source, &mut checkout).map_err(|faulty| match faulty.diagnostics.first() {
            Some(fault) => format!("{}: {}", self.path, fault.message),
            None => format!("{} cannot be loaded", self.path),
        })
    }

    /// Makes the program, and lets it write its logs below that folder.
    ///
    /// # Errors
    /// It does not compile, or does not run.
    pub fn logs(&self, below: &Path) -> Result<Vec<Log>, Failure> {
        let chart = self.chart()?;
        let mut logs = Vec::new();
        for wait_free in [false, true] {
            let form = if wait_free { "wait-free" } else { "locked" };
            let folder = below.join(self.name).join(form);
            let program = self.compile(&chart, &folder, wait_free)?;
            let seconds = (self.milliseconds / 1e3).to_string();
            let runs: [(&str, &[&str]); 4] = [
                ("modelled", &["--virtual", &seconds]),
                ("drawn 1", &["--virtual", &seconds, "--seed", "1"]),
                ("drawn 2", &["--virtual", &seconds, "--seed", "2"]),
                ("real", &["--real", &seconds]),
            ];
            for (pace, words) in runs {
                let log = folder.join(format!("{}.mcap", pace.replace(' ', "-")));
                let mut command = Command::new(&program);
                command.args(words).arg("--log").arg(&log);
                if pace == "modelled" {
                    command.env("HOOK", "none");
                }
                run(&mut command)?;
                let bytes = std::fs::read(&log).map_err(|error| format!("{}: {error}", log.display()))?;
                let recording =
                    Recording::read(&bytes).map_err(|malformed| format!("{}: {}", log.display(), malformed.0))?;
                logs.push(Log { name: format!("{}, {form}, {pace}", self.name), recording });
            }
        }
        Ok(logs)
    }

    fn compile(&self, chart: &Chart, folder: &Path, wait_free: bool) -> Result<PathBuf, Failure> {
        let system = chart.system.as_ref().ok_or(format!("{} has no system", self.path))?;
        if let Some(fault) = ungenerated(system).first() {
            return Err(format!("{}: {}", self.path, fault.message));
        }
        let Generated { decided, once, .. } =
            generate(system, self.path, &Form { wait_free, namespace: None, ..Form::default() });
        for (path, text) in decided.iter().chain(&once) {
            let own = self.hooks.map(|hooks| root().join(hooks).join(path)).filter(|own| own.is_file());
            let path = folder.join(path);
            let wrong = |error| format!("{}: {error}", path.display());
            std::fs::create_dir_all(path.parent().unwrap_or(folder)).map_err(wrong)?;
            match own {
                Some(own) => std::fs::copy(own, &path).map(|_| ()).map_err(wrong)?,
                None => std::fs::write(&path, text).map_err(wrong)?,
            }
        }
        let program = folder.join("program");
        let mut command = Command::new("g++");
        command.args(["-std=c++20", "-O1", "-pthread", "-I"]).arg(folder).arg("-I").arg(root().join("cpp/include"));
        run(command.arg(folder.join("main.cpp")).arg("-o").arg(&program))?;
        Ok(program)
    }
}

fn run(command: &mut Command) -> Result<(), Failure> {
    let name = command.get_program().to_string_lossy().into_owned();
    let output = command.output().map_err(|error| format!("{name} cannot be run: {error}"))?;
    match output.status.success() {
        true => Ok(()),
        false => Err(format!("{name}: {}", String::from_utf8_lossy(&output.stderr).trim())),
    }
}
