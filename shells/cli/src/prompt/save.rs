//! Writes the run so far as a scenario, and plays it once, to say whether it repeats the run.
//!
//! In: what was noted of the run, and a path. Out: a sentence. A scenario can say neither what a term chooses nor what the clock shows, so
//! not every run is repeated; whoever saves one is told at once.

use std::path::{Path, PathBuf};

use groundstate::session::Notes;
use groundstate::{SeededChoices, Suite};
use machine::Limits;
use program::Program;

use crate::files::{Disk, relative, rewrite_text, write_text};

/// What saving takes besides the run.
#[derive(Debug, Clone)]
pub struct Saver {
    /// The model that runs.
    pub model: PathBuf,
    /// The limits of the machine that plays the scenario.
    pub limits: Limits,
    /// The largest allowed size of a file, in bytes.
    pub max_file_size: u64,
}

impl Saver {
    /// Writes the run to a file, which may exist only if it `replaces` it.
    ///
    /// # Errors
    /// A sentence: nothing was written.
    pub fn save(&self, program: &Program, notes: &Notes, path: &str, replaces: bool) -> Result<String, String> {
        let mut path = PathBuf::from(path);
        match path.extension().and_then(|ending| ending.to_str()) {
            None => _ = path.set_extension("avalla"),
            Some("avalla") => {}
            Some(other) => return Err(format!("a scenario's name ends in .avalla, not in .{other}")),
        }
        let shown = path.display().to_string();
        if path.exists() && !replaces {
            return Err(format!("{shown} exists: choose another name, or replace it by `:save! {shown}`"));
        }
        let folder = path.parent().filter(|folder| !folder.as_os_str().is_empty()).unwrap_or(Path::new("."));
        if !folder.is_dir() {
            return Err(format!("there is no folder {}", folder.display()));
        }
        let text = notes.scenario(program, &name(&path), &relative(&self.model, folder))?;
        // It may have been read when it was saved before.
        let write = if replaces { rewrite_text } else { write_text };
        write(&path, &text).map_err(|failure| failure.to_string())?;
        let steps = text.lines().filter(|line| *line == "step").count();
        let checks = text.lines().filter(|line| line.starts_with("check ")).count();
        let wrote = format!("wrote {shown}: steps {steps}, checks {checks}");
        Ok(match self.played(&path)? {
            None => format!("{wrote}; `groundstate test {shown}` passes"),
            Some(reason) => format!("{wrote}; but `groundstate test {shown}` fails: {reason}"),
        })
    }

    /// Why the scenario does not pass, as `groundstate test` runs it.
    fn played(&self, path: &Path) -> Result<Option<String>, String> {
        let mut disk = Disk { limit: self.max_file_size };
        let source = disk.root(path).map_err(|failure| failure.to_string())?;
        let options = groundstate::scenario::Options { limits: self.limits.clone(), ..Default::default() };
        let tested = Suite::new().test(source, &mut disk, options, &mut SeededChoices::new(0));
        if tested.passed() {
            return Ok(None);
        }
        let why = tested.failures().first().map(|fault| fault.message.clone());
        Ok(Some(why.unwrap_or_else(|| "it cannot be run".to_string())))
    }
}

/// The name of a file as one of a scenario.
fn name(path: &Path) -> String {
    let stem = path.file_stem().unwrap_or_default().to_string_lossy();
    let name: String = stem.chars().map(|c| if c.is_ascii_alphanumeric() { c } else { '_' }).collect();
    if name.starts_with(|c: char| c.is_ascii_alphabetic()) { name } else { format!("run{name}") }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn any_file_gives_a_name() {
        let named = |path: &str| name(Path::new(path));
        assert_eq!((named("a/first.avalla"), named("2-ways.avalla")), ("first".to_string(), "run2_ways".to_string()));
        assert_eq!(named("_x y.avalla"), "run_x_y");
    }
}
