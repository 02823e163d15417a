//! Failures of the world and of usage: a closed set, each with a sentence.

use std::fmt;
use std::io;
use std::path::{Path, PathBuf};

/// A failure that is not the model's fault.
#[derive(Debug)]
pub enum Failure {
    /// There is no such file.
    Missing(PathBuf),
    /// A folder where a file is needed.
    Folder(PathBuf),
    /// The file is not UTF-8.
    NotUtf8 {
        /// The file.
        path: PathBuf,
        /// The number of bytes before the first wrong one.
        offset: usize,
    },
    /// The file is larger than `--max-file-size`.
    TooLarge {
        /// The file.
        path: PathBuf,
        /// The limit in bytes.
        limit: u64,
    },
    /// Any other trouble with a file.
    File {
        /// The failed operation: `read`, `write`.
        verb: &'static str,
        /// The file.
        path: PathBuf,
        /// The system's error.
        error: io::Error,
    },
    /// The command's output cannot be written.
    Output(io::Error),
    /// The arguments do not fit together, or do not fit the model.
    Usage {
        /// What is wrong.
        message: String,
        /// What to do.
        help: Option<String>,
    },
}

impl Failure {
    /// Wrong usage.
    pub fn usage(message: impl Into<String>) -> Self {
        Failure::Usage { message: message.into(), help: None }
    }

    /// Wrong usage, and what to do.
    pub fn usage_with_help(message: impl Into<String>, help: impl Into<String>) -> Self {
        Failure::Usage { message: message.into(), help: Some(help.into()) }
    }

    /// Classifies a system error about a file.
    pub fn of_file(verb: &'static str, path: &Path, error: io::Error) -> Self {
        let path = path.to_path_buf();
        match error.kind() {
            io::ErrorKind::NotFound if verb == "read" => Failure::Missing(path),
            io::ErrorKind::IsADirectory => Failure::Folder(path),
            _ => Failure::File { verb, path, error },
        }
    }

    /// What to do about it.
    pub fn help(&self) -> Option<String> {
        match self {
            Failure::Usage { help, .. } => help.clone(),
            Failure::TooLarge { .. } => Some("raise the limit with --max-file-size BYTES".to_string()),
            Failure::NotUtf8 { .. } => Some("save it as UTF-8".to_string()),
            Failure::Missing(path) => ["asm", "avalla", "chart"]
                .map(|extension| path.with_extension(extension))
                .into_iter()
                .find(|other| path.extension().is_none() && other.is_file())
                .map(|other| format!("is {} meant?", other.display())),
            _ => None,
        }
    }

    /// The kebab-case name, for JSON.
    pub fn id(&self) -> &'static str {
        match self {
            Failure::Missing(_) => "file-missing",
            Failure::Folder(_) => "file-is-folder",
            Failure::NotUtf8 { .. } => "file-not-utf8",
            Failure::TooLarge { .. } => "file-too-large",
            Failure::File { .. } => "file-trouble",
            Failure::Output(_) => "output-trouble",
            Failure::Usage { .. } => "usage",
        }
    }
}

impl From<io::Error> for Failure {
    fn from(error: io::Error) -> Self {
        Failure::Output(error)
    }
}

impl fmt::Display for Failure {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Failure::Missing(path) => write!(f, "there is no file {}", path.display()),
            Failure::Folder(path) => write!(f, "{} is a folder; a file is needed", path.display()),
            Failure::NotUtf8 { path, offset } => {
                write!(f, "{} is not UTF-8 text: byte {offset} does not belong to a character", path.display())
            }
            Failure::TooLarge { path, limit } => write!(f, "{} is larger than {limit} bytes", path.display()),
            Failure::File { verb, path, error } => write!(f, "cannot {verb} {}: {}", path.display(), reason(error)),
            Failure::Output(error) => write!(f, "cannot write the output: {}", reason(error)),
            Failure::Usage { message, .. } => f.write_str(message),
        }
    }
}

/// The system's words without the error number, which differs between systems.
fn reason(error: &io::Error) -> String {
    let text = error.to_string();
    text.split(" (os error").next().unwrap_or_default().to_lowercase()
}
