//! How nobody's words are lost: a text is written only over the text that its writer knew.
//!
//! In: a text, and the hash of the one that it was made from. Out: written; or merged with what others wrote meanwhile, line by line;
//! or, where both changed the same lines, a conflict, and nothing is written. LIMIT: bytes of former texts that are kept for merging;
//! what is not kept any more is a conflict.

use std::collections::{BTreeMap, VecDeque};
use std::sync::Arc;
use std::time::Duration;

use serde_json::{Value, json};
use sha1::{Digest, Sha1};

use crate::folder::Folder;

/// LIMIT: bytes of former texts.
const KEPT: usize = 64 << 20;

/// LIMIT: how often, and how long after each other, a file that has become empty is looked at again.
const LOOKS: (usize, Duration) = (50, Duration::from_millis(20));

/// See the module.
#[derive(Debug, Default)]
pub struct Store {
    former: BTreeMap<String, Arc<str>>,
    order: VecDeque<String>,
    bytes: usize,
    /// The hash of each file that somebody asked for, as all browsers were told of it last. INVARIANT: whoever reads a file that was
    /// changed meanwhile keeps the news from nobody else.
    told: BTreeMap<String, Option<String>>,
    /// What files that got another name are called now.
    renamed: BTreeMap<String, String>,
}

/// What became of a text.
#[derive(Debug, PartialEq, Eq)]
pub enum Wrote {
    /// It is on the disk; its hash.
    As(String),
    /// It and what others had written are on the disk; hash and text.
    Merged(String, String),
    /// Nothing was written: what the file holds, its hash, and both in one text with marks around what differs.
    Not { hash: String, theirs: String, merged: String },
}

impl Wrote {
    /// As a browser gets it.
    pub fn json(&self) -> Value {
        match self {
            Wrote::As(hash) => json!({ "hash": hash }),
            Wrote::Merged(hash, text) => json!({ "hash": hash, "text": text }),
            Wrote::Not { hash, theirs, merged } => {
                json!({ "conflict": { "hash": hash, "theirs": theirs, "merged": merged } })
            }
        }
    }
}

/// The hash by which a text is known.
pub fn hash(text: &str) -> String {
    Sha1::digest(text.as_bytes()).iter().map(|byte| format!("{byte:02x}")).collect()
}

impl Store {
    /// The text of a file and its hash; `None` if it is not there. From now on [`Store::changed`] knows of it.
    ///
    /// # Errors
    /// As [`Folder::read`].
    pub fn read(&mut self, folder: &Folder, path: &str) -> Result<Option<(String, String)>, String> {
        let present = self.whole(folder, path)?.map(|text| (self.know(&text), text));
        self.told.entry(path.to_string()).or_insert_with(|| present.as_ref().map(|(hash, _)| hash.clone()));
        Ok(present.map(|(hash, text)| (text, hash)))
    }

    /// Writes a text that was made from the one with the hash `base`; without one, it is a new file.
    ///
    /// # Errors
    /// A new file is there already, or the disk refuses; a sentence.
    pub fn write(&mut self, folder: &Folder, path: &str, text: &str, base: Option<&str>) -> Result<Wrote, String> {
        let there = self.whole(folder, path)?;
        let Some(base) = base else {
            return match there {
                Some(_) => Err(format!("{path} is there already")),
                None => self.put(folder, path, text).map(Wrote::As),
            };
        };
        let Some(theirs) = there else {
            // Who writes it has not heard yet that it has another name.
            if let Some(to) = self.renamed.get(path) {
                return Err(format!("{path} is called {to} now"));
            }
            // A file that somebody took away is made again: its text is in the browser alone.
            return self.put(folder, path, text).map(Wrote::As);
        };
        let hash = self.know(&theirs);
        if hash == base || theirs == text {
            return self.put(folder, path, text).map(Wrote::As);
        }
        let known = self.former.get(base).cloned();
        let merged = match &known {
            Some(known) => diffy::merge(known, text, &theirs),
            None => diffy::merge("", text, &theirs),
        };
        match (merged, known) {
            (Ok(merged), Some(_)) => {
                let hash = self.put(folder, path, &merged)?;
                Ok(Wrote::Merged(hash, merged))
            }
            (Ok(merged) | Err(merged), _) => Ok(Wrote::Not { hash, theirs, merged }),
        }
    }

    /// The text of a file. Most programs empty a file before they write it: one that was not empty is looked at again for a while, so that
    /// nothing is merged with a text that nobody wrote.
    fn whole(&self, folder: &Folder, path: &str) -> Result<Option<String>, String> {
        let was_empty = self.told.get(path).is_none_or(|told| told.as_ref().is_none_or(|told| *told == hash("")));
        let mut text = folder.read(path)?;
        for _ in 0..LOOKS.0 {
            if was_empty || text.as_deref() != Some("") {
                break;
            }
            std::thread::sleep(LOOKS.1);
            text = folder.read(path)?;
        }
        Ok(text)
    }

    /// Whoever writes a text tells it the others.
    fn put(&mut self, folder: &Folder, path: &str, text: &str) -> Result<String, String> {
        folder.write(path, text)?;
        self.renamed.remove(path);
        let hash = self.know(text);
        self.told.insert(path.to_string(), Some(hash.clone()));
        Ok(hash)
    }

    /// Gives files other names: all, or none. Whoever has them renamed tells it the others.
    ///
    /// # Errors
    /// A file is not there, a name is taken, or the disk refuses; a sentence.
    pub fn rename(&mut self, folder: &Folder, moves: &[(&str, &str)]) -> Result<(), String> {
        for (done, (path, to)) in moves.iter().enumerate() {
            let text = folder.read(path).and_then(|text| text.ok_or_else(|| format!("there is no {path}")));
            match text.and_then(|text| folder.rename(path, to).map(|()| text)) {
                Ok(text) => {
                    let hash = self.know(&text);
                    self.told.remove(*path);
                    self.told.insert(to.to_string(), Some(hash));
                    self.renamed.remove(*to);
                    self.renamed.insert(path.to_string(), to.to_string());
                }
                Err(reason) => {
                    let back: Vec<_> = moves[..done].iter().rev().map(|(path, to)| (*to, *path)).collect();
                    self.rename(folder, &back)?;
                    return Err(reason);
                }
            }
        }
        Ok(())
    }

    /// Deletes a file. Out: what it held. Whoever deletes it tells it the others.
    ///
    /// # Errors
    /// It is not there, is no text, or the disk refuses; a sentence.
    pub fn remove(&mut self, folder: &Folder, path: &str) -> Result<String, String> {
        let text = folder.read(path)?.ok_or_else(|| format!("there is no {path}"))?;
        self.know(&text);
        folder.remove(path)?;
        self.told.insert(path.to_string(), None);
        Ok(text)
    }

    /// Keeps a text, so that what is made from it can be merged.
    fn know(&mut self, text: &str) -> String {
        let hash = hash(text);
        if !self.former.contains_key(&hash) {
            self.former.insert(hash.clone(), text.into());
            self.order.push_back(hash.clone());
            self.bytes += text.len();
            while self.bytes > KEPT
                && self.order.len() > 1
                && let Some(oldest) = self.order.pop_front()
            {
                self.bytes -= self.former.remove(&oldest).map_or(0, |text| text.len());
            }
        }
        hash
    }

    /// The files that are not what browsers were told, with what they are now: to be told all of them.
    pub fn changed(&mut self, folder: &Folder) -> Vec<(String, Option<(String, String)>)> {
        let mut news = Vec::new();
        for (path, known) in self.told.clone() {
            // What cannot be read now is looked at again.
            let Ok(text) = self.whole(folder, &path) else { continue };
            let present = text.as_ref().map(|text| hash(text));
            if present != known {
                if let Some(text) = &text {
                    self.know(text);
                }
                self.told.insert(path.clone(), present.clone());
                news.push((path, text.zip(present)));
            }
        }
        news
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_reader_keeps_no_news_from_others() {
        let place = tempfile::tempdir().expect("a folder");
        let folder = Folder::at(place.path()).expect("it is one");
        let mut store = Store::default();
        let outside = |text: &str| std::fs::write(place.path().join("a.asm"), text).expect("written");
        let now = |text: &str| (text.to_string(), hash(text));
        outside("1\n");
        let first = store.read(&folder, "a.asm").expect("read").expect("there");
        assert_eq!(first, now("1\n"));
        // Another one reads it before the watcher has looked.
        outside("2\n");
        assert_eq!(store.read(&folder, "a.asm").expect("read"), Some(now("2\n")));
        assert_eq!(store.changed(&folder), [("a.asm".to_string(), Some(now("2\n")))]);
        assert_eq!(store.changed(&folder), []);
        // Another one's text is refused for it.
        outside("3\n");
        let refused = store.write(&folder, "a.asm", "4\n", Some(&first.1)).expect("told");
        assert!(matches!(refused, Wrote::Not { .. }), "{refused:?}");
        assert_eq!(store.changed(&folder), [("a.asm".to_string(), Some(now("3\n")))]);
        // It goes while somebody asks for it.
        std::fs::remove_file(place.path().join("a.asm")).expect("removed");
        assert_eq!(store.read(&folder, "a.asm").expect("read"), None);
        assert_eq!(store.changed(&folder), [("a.asm".to_string(), None)]);
    }

    #[test]
    fn files_are_renamed_and_deleted_and_nothing_lies_under_another_name() {
        let place = tempfile::tempdir().expect("a folder");
        let folder = Folder::at(place.path()).expect("it is one");
        let mut store = Store::default();
        let Ok(Wrote::As(base)) = store.write(&folder, "a.asm", "1\n", None) else { panic!("it is new") };
        store.write(&folder, "b.asm", "2\n", None).expect("written");
        let there = |name: &str| folder.read(name).expect("read");
        // Over another file nothing is renamed; of several, all are or none.
        assert_eq!(store.rename(&folder, &[("a.asm", "b.asm")]), Err("b.asm is there already".to_string()));
        let several = [("a.asm", "c.asm"), ("none.asm", "d.asm")];
        assert_eq!(store.rename(&folder, &several), Err("there is no none.asm".to_string()));
        assert_eq!((there("a.asm").as_deref(), there("c.asm")), (Some("1\n"), None));
        assert!(store.rename(&folder, &[("a.asm", "../c.asm")]).is_err());
        assert_eq!(store.rename(&folder, &[("a.asm", "c.asm"), ("b.asm", "a.asm")]), Ok(()));
        assert_eq!(
            (there("a.asm").as_deref(), there("b.asm"), there("c.asm").as_deref()),
            (Some("2\n"), None, Some("1\n"))
        );
        assert_eq!(store.changed(&folder), []);
        // What is written meanwhile under the former name makes no second file.
        assert_eq!(store.rename(&folder, &[("c.asm", "d.asm")]), Ok(()));
        let late = store.write(&folder, "c.asm", "3\n", Some(&base));
        assert_eq!(late, Err("c.asm is called d.asm now".to_string()));
        assert_eq!(store.write(&folder, "d.asm", "3\n", Some(&base)), Ok(Wrote::As(hash("3\n"))));
        assert!(matches!(store.write(&folder, "c.asm", "4\n", None), Ok(Wrote::As(_))));
        assert_eq!(store.remove(&folder, "c.asm"), Ok("4\n".to_string()));
        assert_eq!((there("c.asm"), store.changed(&folder)), (None, Vec::new()));
        assert!(store.remove(&folder, "c.asm").is_err() && store.remove(&folder, "../x.asm").is_err());
    }

    #[test]
    fn a_file_that_is_being_written_is_not_taken_for_an_empty_one() {
        let place = tempfile::tempdir().expect("a folder");
        let folder = Folder::at(place.path()).expect("it is one");
        let mut store = Store::default();
        let Ok(Wrote::As(base)) = store.write(&folder, "a.asm", "a\nb\nc\n", None) else { panic!("it is new") };
        let file = place.path().join("a.asm");
        let written = |text: &'static str| {
            std::fs::write(&file, "").expect("emptied");
            let file = file.clone();
            std::thread::spawn(move || {
                std::thread::sleep(Duration::from_millis(60));
                std::fs::write(file, text).expect("written");
            })
        };
        let writer = written("a\nb\nc\nd\n");
        let news = store.changed(&folder);
        assert_eq!(news, [("a.asm".to_string(), Some(("a\nb\nc\nd\n".to_string(), hash("a\nb\nc\nd\n"))))]);
        writer.join().expect("it ends");
        let writer = written("a\nb\nc\nD\n");
        let merged = store.write(&folder, "a.asm", "A\nb\nc\n", Some(&base)).expect("merged");
        writer.join().expect("it ends");
        assert!(matches!(&merged, Wrote::Merged(_, text) if text == "A\nb\nc\nD\n"), "{merged:?}");
        // Who empties a file is believed.
        std::fs::write(&file, "").expect("emptied");
        assert_eq!(store.changed(&folder), [("a.asm".to_string(), Some((String::new(), hash(""))))]);
    }

    #[test]
    fn nobodys_words_are_lost() {
        let place = tempfile::tempdir().expect("a folder");
        let folder = Folder::at(place.path()).expect("it is one");
        let mut store = Store::default();
        let base = "a\nb\nc\nd\ne\n";
        let Ok(Wrote::As(first)) = store.write(&folder, "x/a.asm", base, None) else { panic!("it is new") };
        assert!(store.write(&folder, "x/a.asm", "again", None).is_err());
        // Another program changes the end, the browser the beginning.
        std::fs::write(place.path().join("x/a.asm"), "a\nb\nc\nd\nE\n").expect("written");
        assert_eq!(store.changed(&folder).len(), 1);
        assert_eq!(store.changed(&folder), []);
        let merged = store.write(&folder, "x/a.asm", "A\nb\nc\nd\ne\n", Some(&first)).expect("merged");
        let Wrote::Merged(second, text) = merged else { panic!("{merged:?}") };
        assert_eq!(text, "A\nb\nc\nd\nE\n");
        assert_eq!(folder.read("x/a.asm").expect("read").as_deref(), Some(&*text));
        // Both change the same line: nothing is written.
        std::fs::write(place.path().join("x/a.asm"), "1\nb\nc\nd\nE\n").expect("written");
        let refused = store.write(&folder, "x/a.asm", "2\nb\nc\nd\nE\n", Some(&second)).expect("told");
        let Wrote::Not { hash, theirs, merged } = refused else { panic!("{refused:?}") };
        assert_eq!(theirs, "1\nb\nc\nd\nE\n");
        assert!(merged.contains("<<<<<<<") && merged.contains("1\n") && merged.contains("2\n"), "{merged}");
        assert_eq!(folder.read("x/a.asm").expect("read"), Some(theirs));
        // The user decides.
        let decided = store.write(&folder, "x/a.asm", "2\nb\n", Some(&hash)).expect("written");
        assert_eq!(decided, Wrote::As(super::hash("2\nb\n")));
        // From a text that nobody knows any more nothing is merged.
        let unknown = store.write(&folder, "x/a.asm", "3\n", Some("0000")).expect("told");
        assert!(matches!(unknown, Wrote::Not { .. }), "{unknown:?}");
    }
}
