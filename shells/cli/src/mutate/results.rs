//! The file of `--results`: outcomes that are kept from one analysis to the next.
//!
//! In: the path. Out: what is kept there; each new outcome as a line, as soon as it is known. INVARIANT: a file that is something
//! else is never written to. What a crash has left of a last line is written over.

use std::collections::BTreeMap;
use std::fs::{File, OpenOptions};
use std::io::Write;
use std::path::Path;
use std::sync::{Arc, Mutex, PoisonError};

use groundstate::mutation::{Ledger, Outcome};
use wire::{Became, KeptOutcome, ResultsHead};

use crate::failure::Failure;

/// Kept outcomes, and the file that gets new ones.
#[derive(Debug)]
pub struct Results {
    known: BTreeMap<String, Outcome>,
    file: File,
    trouble: Trouble,
}

/// Why the file could not be written, if it could not.
pub type Trouble = Arc<Mutex<Option<std::io::Error>>>;

impl Results {
    /// Reads what is kept, or begins a file.
    pub fn open(path: &Path) -> Result<(Results, Trouble), Failure> {
        let unread = |error| Failure::of_file("read", path, error);
        let written = |error| Failure::of_file("write", path, error);
        let text = match std::fs::read(path) {
            Ok(bytes) => String::from_utf8(bytes).map_err(|_| foreign(path))?,
            Err(error) if error.kind() == std::io::ErrorKind::NotFound => String::new(),
            Err(error) => return Err(unread(error)),
        };
        let (known, whole) = read(&text).ok_or_else(|| foreign(path))?;
        // Lines of two analyses at a time come one after the other.
        let mut file = OpenOptions::new().create(true).append(true).open(path).map_err(written)?;
        file.set_len(whole as u64).map_err(written)?;
        if whole == 0 {
            line(&mut file, &ResultsHead::default()).map_err(written)?;
        }
        let trouble = Trouble::default();
        Ok((Results { known, file, trouble: Arc::clone(&trouble) }, trouble))
    }
}

impl Ledger for Results {
    fn known(&self, key: &str) -> Option<Outcome> {
        self.known.get(key).cloned()
    }

    fn keep(&mut self, key: &str, outcome: &Outcome) {
        let kept = KeptOutcome { key: key.to_string(), became: Became::of(outcome) };
        if let Err(error) = line(&mut self.file, &kept) {
            self.trouble.lock().unwrap_or_else(PoisonError::into_inner).get_or_insert(error);
        }
    }
}

/// What a trouble says, told once.
pub fn failed(path: &Path, trouble: &Trouble) -> Option<Failure> {
    let error = trouble.lock().unwrap_or_else(PoisonError::into_inner).take();
    error.map(|error| Failure::of_file("write", path, error))
}

fn line(file: &mut File, object: &impl serde::Serialize) -> std::io::Result<()> {
    let mut text = serde_json::to_string(object)?;
    text.push('\n');
    file.write_all(text.as_bytes())
}

/// The outcomes, and up to which byte the text is whole lines; none if it is no such text.
fn read(text: &str) -> Option<(BTreeMap<String, Outcome>, usize)> {
    let whole = text.rfind('\n').map_or(0, |end| end + 1);
    let mut lines = text[..whole].lines();
    let mut known = BTreeMap::new();
    let Some(head) = lines.next() else {
        // Nothing, or what was left of a first line.
        let head = serde_json::to_string(&ResultsHead::default()).ok()?;
        return head.starts_with(text).then_some((known, 0));
    };
    if serde_json::from_str::<ResultsHead>(head).ok()? != ResultsHead::default() {
        return None;
    }
    for line in lines {
        let KeptOutcome { key, became } = serde_json::from_str(line).ok()?;
        known.insert(key, became.outcome()?);
    }
    Some((known, whole))
}

fn foreign(path: &Path) -> Failure {
    let help = "name another file, or a new one";
    Failure::usage_with_help(format!("{} has no results of `groundstate mutate`", path.display()), help)
}

#[cfg(test)]
mod tests {
    use super::*;

    const HEAD: &str = r#"{"type":"mutation-results","version":1}"#;
    const LINE: &str = r#"{"key":"k","outcome":"equivalent","why":"same-steps"}"#;

    #[test]
    fn what_is_whole_is_kept() {
        let read = |text: &str| read(text).map(|(known, whole)| (known.len(), whole));
        assert_eq!(read(""), Some((0, 0)));
        assert_eq!(read(&format!("{HEAD}\n{LINE}\n")), Some((1, HEAD.len() + LINE.len() + 2)));
        // A crash while a line was written.
        assert_eq!(read(&HEAD[..10]), Some((0, 0)));
        assert_eq!(read(&format!("{HEAD}\n{LINE}\n{}", &LINE[..20])), Some((1, HEAD.len() + LINE.len() + 2)));
        assert_eq!(read("asm Light\n"), None);
        assert_eq!(read("asm Light"), None);
        assert_eq!(read(&format!("{HEAD}\nasm Light\n")), None);
        assert_eq!(read(&format!("{}\n", HEAD.replace('1', "2"))), None);
    }
}
