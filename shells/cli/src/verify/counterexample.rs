//! Writes counterexamples: as scenarios that fail where they end, as traces to replay, and as pages if there is a
//! report specification beside the model.

use std::io::Write;
use std::path::{Path, PathBuf};
use std::sync::Arc;

use groundstate::Overlay;
use groundstate::simulate::{End, Header, Invariants};
use groundstate::tell::id;
use groundstate::verify::{Outcome, Report, Subject, Trace};
use program::{Program, PropertyKind};
use syntax::Sources;
use wire::Wire;

use crate::failure::Failure;
use crate::files::{Unfinished, relative, write_text};
use crate::report::page_of;
use crate::shell::Shell;
use crate::tracefile::TraceFile;
use crate::verify::tell::Scripts;

/// Writes the first counterexample to a file, or all of them into a folder.
pub fn write(
    shell: &mut Shell,
    path: &Path,
    (model, fingerprint): (&Path, &str),
    asked: &Overlay,
    report: &Report,
) -> Result<(), Failure> {
    let violated = report.verdicts.iter().filter_map(|verdict| match &verdict.outcome {
        Outcome::Violated(trace) => Some((verdict.subject, trace.as_ref())),
        _ => None,
    });
    let Overlay { sources, program, model: checked } = asked;
    let writer = Writer { model, fingerprint, program, sources, properties: checked.properties.len() };
    let mut written: Vec<PathBuf> = Vec::new();
    let mut names: Vec<String> = Vec::new();
    let kind = path.extension().and_then(|extension| extension.to_str());
    for (subject, trace) in violated {
        let name = named(program, subject, &mut names);
        match kind {
            Some("avalla") => {
                writer.scenario(shell, path, trace, subject, &name)?;
                written.push(path.to_path_buf());
                break;
            }
            Some("trace") => {
                writer.trace(shell, path, trace, subject)?;
                written.push(path.to_path_buf());
                break;
            }
            _ => {
                std::fs::create_dir_all(path).map_err(|error| Failure::of_file("write", path, error))?;
                let (scenario, file) = (path.join(format!("{name}.avalla")), path.join(format!("{name}.trace")));
                writer.scenario(shell, &scenario, trace, subject, &name)?;
                writer.trace(shell, &file, trace, subject)?;
                written.extend([scenario, file]);
                let limits = shell.global.limits.uninterrupted();
                let header = writer.header(trace, subject);
                let run =
                    |program: &Arc<Program>| groundstate::counterexample_run(program, limits.clone(), trace, &header);
                if let Some(page) = page_of(shell, asked.clone(), model, &run)? {
                    let file = path.join(format!("{name}.html"));
                    write_text(&file, &page)?;
                    written.push(file);
                }
            }
        }
    }
    if shell.talks() {
        for path in written {
            writeln!(shell.out(), "wrote {}", path.display())?;
        }
    }
    Ok(())
}

/// What is said of a scenario that cannot make its whole run again.
pub fn left_out(path: &Path) -> String {
    format!("{} cannot make the whole run again: comments in it say what no scenario can say", path.display())
}

struct Writer<'a> {
    model: &'a Path,
    fingerprint: &'a str,
    program: &'a Arc<Program>,
    sources: &'a Sources,
    /// How many properties stand in the model itself.
    properties: usize,
}

impl Writer<'_> {
    fn scenario(
        &self,
        shell: &mut Shell,
        path: &Path,
        trace: &Trace,
        subject: Subject,
        name: &str,
    ) -> Result<(), Failure> {
        let folder = path.parent().filter(|folder| !folder.as_os_str().is_empty()).unwrap_or(Path::new("."));
        let model = relative(self.model, folder);
        let text = script(self.program, self.properties, (subject, trace), name, &model);
        let mut file = Unfinished::create(path)?;
        file.write_all(text.as_bytes()).map_err(|error| Failure::of_file("write", path, error))?;
        file.finish()?;
        if groundstate::leaves_out(&text) {
            shell.note(&left_out(path))?;
        }
        Ok(())
    }

    fn header(&self, trace: &Trace, subject: Subject) -> Header {
        // A replay does not know properties from the command line, so the trace ignores invariants then.
        let stops = matches!(subject, Subject::Property(index) if index < self.properties);
        Header {
            model: self.program.name.clone(),
            path: self.model.display().to_string(),
            source: self.fingerprint.to_string(),
            steps: Some(trace.steps.len() as u64),
            invariants: if stops { Invariants::Report } else { Invariants::Ignore },
            ..Header::default()
        }
    }

    fn trace(&self, shell: &Shell, path: &Path, trace: &Trace, subject: Subject) -> Result<(), Failure> {
        let header = self.header(trace, subject);
        let limits = shell.global.limits.uninterrupted();
        let mut run = groundstate::counterexample_run(self.program, limits, trace, &header);
        let mut file = TraceFile::create(path, false)?;
        file.write(&Wire::header(&header))?;
        let wire = Wire { program: self.program, sources: self.sources };
        while let Some(record) = run.advance() {
            file.write(&wire.record(&record, run.steps()))?;
            debug_assert!(!matches!(record, groundstate::simulate::Record::End(End::Interrupted)));
        }
        file.finish()
    }
}

/// The scenario of a counterexample. `properties` of those of the program stand in the model itself; `model` is what it loads.
fn script(
    program: &Program,
    properties: usize,
    (subject, trace): (Subject, &Trace),
    name: &str,
    model: &str,
) -> String {
    let text = groundstate::counterexample_scenario(program, trace, subject, &name.replace('-', "_"), model);
    match subject {
        Subject::Property(index) if index >= properties => {
            let property = &program.properties[index];
            let is_invariant = property.kind == PropertyKind::Invariant;
            if is_invariant { with_invariant(&text, &property.name) } else { text }
        }
        _ => text,
    }
}

/// Writes counterexamples as scenarios beside the model; without a file of the model there are none.
pub fn scripts<'a>(model: &Path, program: &'a Program, properties: usize) -> Option<Box<Scripts<'a>>> {
    let file = model.file_name().filter(|_| model.as_os_str() != "-")?.to_string_lossy().into_owned();
    Some(Box::new(move |subject, trace| {
        let name = named(program, subject, &mut Vec::new());
        Some(script(program, properties, (subject, trace), &name, &file))
    }))
}

/// LIMIT: a file name shows at most this many characters of a formula.
const LONGEST: usize = 60;

/// A file name for a property: the words of its name or formula, joined.
fn file_name(name: &str) -> String {
    let words: Vec<&str> = name.split(|c: char| !c.is_alphanumeric() && c != '_').collect();
    let words: Vec<&str> = words.iter().map(|word| word.trim_matches('_')).filter(|word| !word.is_empty()).collect();
    let mut joined: String = words.join("_").chars().take(LONGEST).collect();
    joined.truncate(joined.trim_end_matches('_').len());
    match joined.chars().next() {
        Some(first) if first.is_alphabetic() => joined,
        Some(_) => format!("property_{joined}"),
        None => "property".to_string(),
    }
}

/// The name of a counterexample: that of its check, with a number if another check has it already.
pub fn named(program: &Program, subject: Subject, names: &mut Vec<String>) -> String {
    let name = match subject {
        Subject::Property(index) => file_name(&program.properties[index].name),
        subject => id(subject).unwrap_or_default().to_string(),
    };
    another(name, names)
}

/// The scenario, with an invariant added that the model does not have.
pub fn with_invariant(text: &str, invariant: &str) -> String {
    match text.match_indices('\n').nth(1) {
        Some((end, _)) => {
            let (head, rest) = text.split_at(end + 1);
            format!("{head}\ninvariant inv_asked: {invariant};\n{rest}")
        }
        None => text.to_string(),
    }
}

/// The name, with a number if another property has it already.
fn another(name: String, names: &mut Vec<String>) -> String {
    let numbered = |n: usize| if n == 1 { name.clone() } else { format!("{name}_{n}") };
    let free = (1..).map(numbered).find(|name| !names.contains(name)).unwrap_or_default();
    names.push(free.clone());
    free
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn files_are_named_by_words() {
        assert_eq!(file_name("inv_sound"), "inv_sound");
        assert_eq!(file_name("g(emergency implies x != extended(RIGHT))"), "g_emergency_implies_x_extended_RIGHT");
        assert_eq!(
            (file_name("__ 1 > 0"), file_name("(()"), file_name("a__")),
            ("property_1_0".into(), "property".into(), "a".into())
        );
        assert!(file_name(&"long ".repeat(40)).len() <= LONGEST);
        let mut names = Vec::new();
        let taken: Vec<String> =
            ["x > 1", "x < 1", "x = 1", "y"].iter().map(|name| another(file_name(name), &mut names)).collect();
        assert_eq!(taken, ["x_1", "x_1_2", "x_1_3", "y"]);
    }
}
