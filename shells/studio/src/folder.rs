//! What can be reached: the files of one folder.
//!
//! In: paths as a browser names them, relative, with `/`. Out: files of the folder, read or written whole. INVARIANT: neither a name nor a
//! link leads out of the folder; a file that is being written is, at any time, what it was or what it will be. LIMIT: bytes of a file.

use std::fs;
use std::io::{ErrorKind, Read, Write};
use std::path::{Path, PathBuf};

/// LIMIT: bytes of a file that is read or written.
pub const BYTES: u64 = 16 << 20;

/// See the module.
#[derive(Debug)]
pub struct Folder {
    root: PathBuf,
}

impl Folder {
    /// The folder at a path.
    ///
    /// # Errors
    /// There is none; a sentence.
    pub fn at(path: &Path) -> Result<Folder, String> {
        let root = fs::canonicalize(path).map_err(|error| format!("{} cannot be opened: {error}", path.display()))?;
        match root.is_dir() {
            true => Ok(Folder { root }),
            false => Err(format!("{} is no folder", path.display())),
        }
    }

    /// Where it is, without links.
    pub fn root(&self) -> &Path {
        &self.root
    }

    /// A path as browsers name it, of a file whose place on the disk is known.
    pub fn relative(&self, path: &Path) -> Option<String> {
        let rest = path.strip_prefix(&self.root).ok()?.to_str()?.replace('\\', "/");
        (!rest.is_empty()).then_some(rest)
    }

    /// Where a file is or would be.
    ///
    /// # Errors
    /// The name is none of a file in the folder; a sentence.
    pub fn place(&self, name: &str) -> Result<PathBuf, String> {
        let refused = || format!("`{}` is no file of this folder", name.escape_debug());
        let is_part = |part: &str| {
            // `:` begins a drive or a stream on Windows; names that end with a dot or a space are others there.
            let odd = |c: char| c.is_control() || matches!(c, '\\' | ':');
            !matches!(part, "" | "." | "..")
                && !part.contains(odd)
                && !part.ends_with(['.', ' '])
                && !part.starts_with('.')
        };
        if name.len() > 1_024 || !name.split('/').all(is_part) {
            return Err(refused());
        }
        let path = self.root.join(name);
        // What is there already decides where the rest leads.
        let mut there = path.as_path();
        loop {
            match fs::canonicalize(there) {
                Ok(real) if real.starts_with(&self.root) => break,
                Ok(_) => return Err(refused()),
                // A link to nothing is there, though nothing is behind it.
                Err(_) if fs::symlink_metadata(there).is_ok() => return Err(refused()),
                Err(error) if matches!(error.kind(), ErrorKind::NotFound | ErrorKind::NotADirectory) => {
                    there = there.parent().ok_or_else(refused)?;
                }
                Err(_) => return Err(refused()),
            }
        }
        Ok(path)
    }

    /// The text of a file; `None` if it is not there.
    ///
    /// # Errors
    /// It cannot be read, is too large, or is no text; a sentence.
    pub fn read(&self, name: &str) -> Result<Option<String>, String> {
        let path = self.place(name)?;
        let cannot = |error: std::io::Error| format!("{name} cannot be read: {error}");
        let file = match fs::File::open(&path) {
            Ok(file) => file,
            Err(error) if matches!(error.kind(), ErrorKind::NotFound | ErrorKind::NotADirectory) => return Ok(None),
            Err(error) => return Err(cannot(error)),
        };
        if !file.metadata().map_err(cannot)?.is_file() {
            return Err(format!("{name} is no file"));
        }
        let mut bytes = Vec::new();
        file.take(BYTES + 1).read_to_end(&mut bytes).map_err(cannot)?;
        if bytes.len() as u64 > BYTES {
            return Err(format!("{name} has more than {} MB", BYTES >> 20));
        }
        String::from_utf8(bytes)
            .map(Some)
            .map_err(|error| format!("{name} is not text in UTF-8: see byte {}", error.utf8_error().valid_up_to()))
    }

    /// Writes a file, whole: who reads it meanwhile, or after a crash, finds the old text or the new one.
    ///
    /// # Errors
    /// It cannot be written; a sentence.
    pub fn write(&self, name: &str, text: &str) -> Result<(), String> {
        let path = self.place(name)?;
        let cannot = |error: std::io::Error| format!("{name} cannot be written: {error}");
        let parent = path.parent().unwrap_or(&self.root);
        fs::create_dir_all(parent).map_err(cannot)?;
        // A link to a file of the folder stays a link.
        let target = fs::canonicalize(&path).unwrap_or_else(|_| path.clone());
        let place = target.parent().unwrap_or(parent);
        let mut fresh = tempfile::Builder::new().prefix(".groundstate-").tempfile_in(place).map_err(cannot)?;
        fresh.write_all(text.as_bytes()).map_err(cannot)?;
        match fs::metadata(&target) {
            Ok(known) if known.permissions().readonly() => return Err(format!("{name} is write-protected")),
            Ok(known) => fs::set_permissions(fresh.path(), known.permissions()).map_err(cannot)?,
            Err(_) => shared(&fresh).map_err(cannot)?,
        }
        fresh.as_file().sync_all().map_err(cannot)?;
        fresh.persist(&target).map_err(|error| cannot(error.error))?;
        Ok(())
    }

    /// Gives a file another name, which nothing has yet.
    ///
    /// # Errors
    /// Something has it, or the disk refuses; a sentence.
    pub fn rename(&self, name: &str, to: &str) -> Result<(), String> {
        let (old, new) = (self.place(name)?, self.place(to)?);
        let cannot = |error: std::io::Error| match error.kind() {
            ErrorKind::AlreadyExists => format!("{to} is there already"),
            _ => format!("{name} cannot be renamed: {error}"),
        };
        // A second name is never put over a file, as a new one would be; where there are none, it is looked before.
        match fs::hard_link(&old, &new) {
            Ok(()) => fs::remove_file(&old).map_err(cannot),
            Err(error) if matches!(error.kind(), ErrorKind::AlreadyExists | ErrorKind::NotFound) => Err(cannot(error)),
            Err(_) if fs::symlink_metadata(&new).is_ok() => Err(format!("{to} is there already")),
            Err(_) => fs::rename(&old, &new).map_err(cannot),
        }
    }

    /// Deletes a file.
    ///
    /// # Errors
    /// The disk refuses; a sentence.
    pub fn remove(&self, name: &str) -> Result<(), String> {
        fs::remove_file(self.place(name)?).map_err(|error| format!("{name} cannot be deleted: {error}"))
    }
}

/// A new file is as any program would make it; a temporary one is for its owner alone.
#[cfg(unix)]
fn shared(file: &tempfile::NamedTempFile) -> std::io::Result<()> {
    use std::os::unix::fs::PermissionsExt;
    file.as_file().set_permissions(fs::Permissions::from_mode(0o644))
}

#[cfg(not(unix))]
fn shared(_file: &tempfile::NamedTempFile) -> std::io::Result<()> {
    Ok(())
}
