//! Reads and writes files: bounded, text only, never half written.

use std::fs::File;
use std::io::{self, BufWriter, Read, Write};
use std::path::{Component, Path, PathBuf};

use groundstate::has_ending;
use groundstate::workspace::{Absent, Files, imported};
use syntax::{NotText, SourceFile};

use crate::failure::Failure;
use crate::overwrite;
use crate::sink::Sink;
use crate::within;

/// Reads a text file of at most `limit` bytes.
pub fn read_text(path: &Path, limit: u64) -> Result<String, Failure> {
    text_of(path, read_bytes(path, limit)?)
}

/// Reads a model or a scenario of at most `limit` bytes, as UTF-8 or else as Windows-1252.
pub fn read_source(path: &Path, limit: u64) -> Result<SourceFile, Failure> {
    decode(path, read_bytes(path, limit)?, limit)
}

/// Decodes the bytes of a model or a scenario, at most `limit` of them.
pub fn decode(path: &Path, bytes: Vec<u8>, limit: u64) -> Result<SourceFile, Failure> {
    let path = path.to_path_buf();
    if bytes.len() as u64 > limit {
        return Err(Failure::TooLarge { path, limit });
    }
    SourceFile::decode(path.display().to_string(), bytes)
        .map_err(|NotText { offset }| Failure::NotUtf8 { path, offset })
}

/// The present text of a file that is to be updated; `None` if there is no such file.
pub fn present_text(path: &Path, limit: u64) -> Result<Option<String>, Failure> {
    match bytes_of(path, limit).and_then(|bytes| text_of(path, bytes)) {
        Ok(text) => Ok(Some(text)),
        Err(Failure::Missing(_)) => Ok(None),
        Err(failure) => Err(failure),
    }
}

/// Reads a file of at most `limit` bytes.
pub fn read_bytes(path: &Path, limit: u64) -> Result<Vec<u8>, Failure> {
    let bytes = bytes_of(path, limit)?;
    overwrite::note(path);
    Ok(bytes)
}

fn text_of(path: &Path, bytes: Vec<u8>) -> Result<String, Failure> {
    String::from_utf8(bytes)
        .map_err(|error| Failure::NotUtf8 { path: path.to_path_buf(), offset: error.utf8_error().valid_up_to() })
}

fn bytes_of(path: &Path, limit: u64) -> Result<Vec<u8>, Failure> {
    within::may_read(path)?;
    let wrap = |error| Failure::of_file("read", path, error);
    let file = File::open(path).map_err(wrap)?;
    if file.metadata().map_err(wrap)?.is_dir() {
        return Err(Failure::Folder(path.to_path_buf()));
    }
    let mut bytes = Vec::new();
    // Reading one byte more than allowed shows that a file exceeds the limit, whatever length it claims.
    file.take(limit.saturating_add(1)).read_to_end(&mut bytes).map_err(wrap)?;
    if bytes.len() as u64 > limit {
        return Err(Failure::TooLarge { path: path.to_path_buf(), limit });
    }
    Ok(bytes)
}

/// Reads a file piece by piece, up to a limit.
#[derive(Debug)]
pub struct Bounded {
    path: PathBuf,
    file: io::Take<File>,
    limit: u64,
    piece: Vec<u8>,
}

impl Bounded {
    /// Opens a file of at most `limit` bytes.
    pub fn open(path: &Path, limit: u64) -> Result<Self, Failure> {
        within::may_read(path)?;
        let wrap = |error| Failure::of_file("read", path, error);
        let file = File::open(path).map_err(wrap)?;
        if file.metadata().map_err(wrap)?.is_dir() {
            return Err(Failure::Folder(path.to_path_buf()));
        }
        overwrite::note(path);
        // One byte more than allowed, as for a file that is read whole.
        let file = file.take(limit.saturating_add(1));
        Ok(Bounded { path: path.to_path_buf(), file, limit, piece: vec![0; 1 << 20] })
    }

    /// The next piece; `None` at the end.
    pub fn piece(&mut self) -> Result<Option<&[u8]>, Failure> {
        let read = loop {
            match self.file.read(&mut self.piece) {
                Err(error) if error.kind() == io::ErrorKind::Interrupted => {}
                read => break read.map_err(|error| Failure::of_file("read", &self.path, error))?,
            }
        };
        if self.file.limit() == 0 {
            return Err(Failure::TooLarge { path: self.path.clone(), limit: self.limit });
        }
        Ok((read > 0).then(|| &self.piece[..read]))
    }
}

/// Finds imported files on the disk, relative to the importing file, then to the working folder; else in the built-in
/// pattern library.
#[derive(Debug)]
pub struct Disk {
    /// The largest allowed size of a file, in bytes.
    pub limit: u64,
}

impl Disk {
    /// The root file, under the name it was given.
    pub fn root(&self, path: &Path) -> Result<SourceFile, Failure> {
        read_source(path, self.limit)
    }
}

impl Files for Disk {
    fn read(&mut self, path: &str) -> Result<SourceFile, Absent> {
        match read_source(Path::new(path), self.limit) {
            Ok(source) => Ok(source),
            Err(Failure::Missing(_)) => Err(Absent::Missing),
            Err(failure) => Err(Absent::Unreadable(failure.to_string())),
        }
    }
}

impl model::Loader for Disk {
    fn load(&mut self, importer: &SourceFile, path: &str) -> Result<SourceFile, String> {
        imported(self, importer, path)
    }
}

/// A file being written. It appears under its name only when it is complete. What is not an ordinary file (a pipe,
/// `/dev/stdout`) is written directly, never replaced.
#[derive(Debug)]
pub struct Unfinished {
    path: PathBuf,
    target: Target,
}

#[derive(Debug)]
enum Target {
    Renamed(BufWriter<tempfile::NamedTempFile>),
    Direct(BufWriter<Sink<File>>),
}

impl Unfinished {
    /// Begins a new file. Fails if the command has read that file.
    pub fn create(path: &Path) -> Result<Self, Failure> {
        overwrite::refuse(path)?;
        Unfinished::replace(path)
    }

    /// Begins a file that may replace one that the command has read.
    pub fn replace(path: &Path) -> Result<Self, Failure> {
        within::may_write(path)?;
        let wrap = |error| Failure::of_file("write", path, error);
        let special = path.starts_with("/dev") || path.starts_with("/proc");
        let path = match std::fs::metadata(path) {
            Ok(found) if found.is_dir() => return Err(Failure::Folder(path.to_path_buf())),
            Ok(found) if special || !found.is_file() => {
                let file = File::options().write(true).open(path).map_err(wrap)?;
                return Ok(Unfinished {
                    path: path.to_path_buf(),
                    target: Target::Direct(BufWriter::new(Sink::new(file))),
                });
            }
            // A link stays; its target is replaced.
            Ok(_) => std::fs::canonicalize(path).map_err(wrap)?,
            Err(_) => path.to_path_buf(),
        };
        let folder = match path.parent() {
            Some(folder) if folder != Path::new("") => folder,
            _ => Path::new("."),
        };
        let file = tempfile::Builder::new()
            .prefix(".groundstate-")
            .tempfile_in(folder)
            .map_err(|error| Failure::of_file("write", &path, error))?;
        Ok(Unfinished { path, target: Target::Renamed(BufWriter::new(file)) })
    }

    /// Gives the file its name.
    pub fn finish(self) -> Result<(), Failure> {
        let Unfinished { path, target } = self;
        let wrap = |error| Failure::of_file("write", &path, error);
        match target {
            Target::Direct(mut writer) => writer.flush().map_err(wrap),
            Target::Renamed(writer) => {
                let file = writer.into_inner().map_err(|error| wrap(error.into_error()))?;
                match std::fs::metadata(&path) {
                    Ok(replaced) => file.as_file().set_permissions(replaced.permissions()).map_err(wrap)?,
                    Err(_) => allow_reading(file.as_file()).map_err(wrap)?,
                }
                file.persist(&path).map(|_| ()).map_err(|error| wrap(error.error))
            }
        }
    }
}

/// Temporary files are private; a finished file gets ordinary permissions.
#[cfg(unix)]
fn allow_reading(file: &File) -> io::Result<()> {
    use std::os::unix::fs::PermissionsExt;
    file.set_permissions(std::fs::Permissions::from_mode(0o644))
}

#[cfg(not(unix))]
fn allow_reading(_file: &File) -> io::Result<()> {
    Ok(())
}

impl Write for Unfinished {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        match &mut self.target {
            Target::Renamed(writer) => writer.write(bytes),
            Target::Direct(writer) => writer.write(bytes),
        }
    }

    fn flush(&mut self) -> io::Result<()> {
        match &mut self.target {
            Target::Renamed(writer) => writer.flush(),
            Target::Direct(writer) => writer.flush(),
        }
    }
}

/// Writes a whole text file.
pub fn write_text(path: &Path, text: &str) -> Result<(), Failure> {
    write_bytes(path, text.as_bytes())
}

/// Writes a whole text file, which may be one that the command has read.
pub fn rewrite_text(path: &Path, text: &str) -> Result<(), Failure> {
    write_all(path, text.as_bytes(), Unfinished::replace(path)?)
}

/// Writes a whole file.
pub fn write_bytes(path: &Path, bytes: &[u8]) -> Result<(), Failure> {
    write_all(path, bytes, Unfinished::create(path)?)
}

fn write_all(path: &Path, bytes: &[u8], mut file: Unfinished) -> Result<(), Failure> {
    file.write_all(bytes).map_err(|error| Failure::of_file("write", path, error))?;
    file.finish()
}

/// The path of a file relative to a folder, as a scenario writes it.
pub fn relative(file: &Path, folder: &Path) -> String {
    let whole = |path: &Path| path.canonicalize().unwrap_or_else(|_| path.to_path_buf());
    let (file, folder) = (whole(file), whole(folder));
    let (to, from): (Vec<Component>, Vec<Component>) = (file.components().collect(), folder.components().collect());
    let shared = to.iter().zip(&from).take_while(|(a, b)| a == b).count();
    let up = from[shared..].iter().map(|_| "..".to_string());
    let down = to[shared..].iter().map(|part| part.as_os_str().to_string_lossy().into_owned());
    up.chain(down).collect::<Vec<_>>().join("/")
}

/// The files that paths mean: a file stands for itself, a folder for all files below it with one of the endings, by
/// name.
pub fn collect(paths: &[PathBuf], extensions: &[&str]) -> Result<Vec<PathBuf>, Failure> {
    let mut files = Vec::new();
    for path in paths {
        if path.is_dir() {
            let before = files.len();
            collect_folder(path, extensions, &mut files)?;
            if files.len() == before {
                let wanted: Vec<_> = extensions.iter().map(|extension| format!("*.{extension}")).collect();
                return Err(Failure::usage(format!("{} holds no {}", path.display(), wanted.join(" nor "))));
            }
        } else {
            files.push(path.clone());
        }
    }
    Ok(files)
}

fn collect_folder(folder: &Path, extensions: &[&str], files: &mut Vec<PathBuf>) -> Result<(), Failure> {
    let wrap = |error| Failure::of_file("read", folder, error);
    let entries = std::fs::read_dir(folder).map_err(wrap)?;
    let mut paths =
        entries.map(|entry| entry.map(|entry| entry.path())).collect::<io::Result<Vec<_>>>().map_err(wrap)?;
    paths.sort();
    for path in paths {
        // A link to a folder may lead back here.
        if path.is_dir() && !path.is_symlink() {
            collect_folder(&path, extensions, files)?;
        } else if extensions.iter().any(|extension| has_ending(&path, extension)) {
            files.push(path);
        }
    }
    Ok(())
}
