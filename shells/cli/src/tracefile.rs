//! A trace file being written. It gets its name only when the run has ended. A step that is taken back leaves no line.

use std::path::{Path, PathBuf};
use wire::{Kept, Line};

use crate::failure::Failure;
use crate::files::Unfinished;
use crate::shell::write_object;

/// A trace file.
pub struct TraceFile {
    path: PathBuf,
    file: Unfinished,
    /// At a prompt lines are held back, since their steps may be taken back.
    held: Option<Kept>,
}

impl TraceFile {
    pub fn create(path: &Path, interactive: bool) -> Result<Self, Failure> {
        Ok(TraceFile {
            path: path.to_path_buf(),
            file: Unfinished::create(path)?,
            held: interactive.then(Kept::default),
        })
    }

    pub fn write(&mut self, line: &Line) -> Result<(), Failure> {
        match (&mut self.held, line) {
            (None, line) => put(&mut self.file, &self.path, line),
            (Some(held), line) => {
                held.add(line.clone());
                Ok(())
            }
        }
    }

    pub fn finish(mut self) -> Result<(), Failure> {
        for line in self.held.take().into_iter().flat_map(Kept::into_lines) {
            put(&mut self.file, &self.path, &line)?;
        }
        self.file.finish()
    }
}

fn put(file: &mut Unfinished, path: &Path, line: &Line) -> Result<(), Failure> {
    write_object(file, line).map_err(|failure| match failure {
        Failure::Output(error) => Failure::of_file("write", path, error),
        other => other,
    })
}
