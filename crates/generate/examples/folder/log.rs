//! The log: one verdict per line, so that an interrupted campaign continues where it stopped.
//!
//! In: a file, if any. Out: the verdicts of an earlier campaign by key, and lines for new ones. A key is the hash of
//! everything that a verdict depends on: see `judge`.

use std::collections::BTreeMap;
use std::fs::File;
use std::io::Write;
use std::path::Path;

/// The result for a model's code.
#[derive(Clone, PartialEq, Eq)]
pub enum Verdict {
    Agrees,
    /// It compiles but behaves differently: how.
    Differs(String),
    /// What the compiler said.
    DoesNotCompile(String),
}

/// Verdicts by key.
pub struct Log {
    known: BTreeMap<u64, Verdict>,
    file: Option<File>,
}

impl Log {
    /// Reads the log; new lines are appended.
    pub fn open(path: Option<&Path>) -> Log {
        let Some(path) = path else { return Log { known: BTreeMap::new(), file: None } };
        let text = std::fs::read_to_string(path).unwrap_or_default();
        let known = text.lines().filter_map(verdict).collect();
        let file = File::options().create(true).append(true).open(path).expect("the log can be written");
        Log { known, file: Some(file) }
    }

    /// The verdict of this campaign or an earlier one.
    pub fn known(&self, key: u64) -> Option<&Verdict> {
        self.known.get(&key)
    }

    /// Logs a verdict.
    pub fn note(&mut self, key: u64, name: &str, verdict: &Verdict) {
        let (word, why) = match verdict {
            Verdict::Agrees => ("agrees", ""),
            Verdict::Differs(why) => ("differs", why.as_str()),
            Verdict::DoesNotCompile(why) => ("does-not-compile", why.as_str()),
        };
        if let Some(file) = &mut self.file {
            let line = format!("{key:016x}\t{word}\t{name}\t{}\n", why.replace('\n', " ¶ "));
            file.write_all(line.as_bytes()).expect("the log can be written");
        }
        self.known.insert(key, verdict.clone());
    }
}

fn verdict(line: &str) -> Option<(u64, Verdict)> {
    let mut words = line.splitn(4, '\t');
    let key = u64::from_str_radix(words.next()?, 16).ok()?;
    let (word, _, why) = (words.next()?, words.next()?, words.next()?.replace(" ¶ ", "\n"));
    let verdict = match word {
        "agrees" => Verdict::Agrees,
        "differs" => Verdict::Differs(why),
        "does-not-compile" => Verdict::DoesNotCompile(why),
        _ => return None,
    };
    Some((key, verdict))
}
