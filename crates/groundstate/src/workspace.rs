//! The texts of a project, with edited texts in front of those on the disk, and the faults of each.
//!
//! In: texts as an editor sends them, and [`Files`] for the rest. Out: faults of models, scenarios, charts and
//! specifications, and models that are ready to run. A text that did not change is not parsed again; everything else is
//! checked anew, which takes milliseconds.
//! INVARIANT: what [`Workspace::check`] reports depends on the texts alone, not on the edits that led to them.

use std::collections::BTreeMap;
use std::fmt::Display;
use std::path::{Component, Path, PathBuf};
use std::sync::Arc;

use model::{Checked, Loader};
use syntax::{Diagnostic, FileId, Parse, SourceFile, Stop};

use crate::{
    BuiltChart, Faulty, Kind, Loaded, Located, Suite, build_chart, check, check_coupling, check_specification, load,
    model_of, patterns,
};

/// Reads texts by their path.
pub trait Files {
    /// The text at a path, with the path as its name.
    ///
    /// # Errors
    /// There is no text, or it cannot be read.
    fn read(&mut self, path: &str) -> Result<SourceFile, Absent>;
}

/// Why there is no text.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Absent {
    /// There is no file.
    Missing,
    /// It cannot be read; a sentence for the user.
    Unreadable(String),
}

/// What is said of a text whose check was stopped.
pub const STOPPED: &str = "the check was stopped";

impl Absent {
    /// The reason as a sentence.
    pub fn told(self, path: &str) -> String {
        match self {
            Absent::Missing => format!("there is no file {path}"),
            Absent::Unreadable(reason) => reason,
        }
    }
}

/// The text that was sent is older than the present one.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Outdated {
    /// The version of the present text.
    pub present: i64,
}

/// LIMIT: so many bytes of texts are kept parsed, and the text parsed last in any case.
const PARSED_BYTES: usize = 2 << 20;

/// What was read: each path that was asked for, with the text that was there, or none.
pub type Reads = BTreeMap<String, Option<Arc<str>>>;

/// Edited texts over files.
#[derive(Debug)]
pub struct Workspace<F> {
    files: F,
    /// Texts that are being edited, by their path.
    open: BTreeMap<String, (i64, SourceFile)>,
    parsed: Parsed,
    /// What is read, if anybody wants to know.
    reads: Option<Reads>,
    stop: Stop,
}

/// The result of checking a path.
#[derive(Debug, Clone, Default)]
pub struct Findings {
    /// The faults, grouped by the texts that they refer to.
    pub faults: Vec<Located>,
    /// What could not be checked, as a clause. If set, having no faults does not mean *no faults*.
    pub open: Option<String>,
}

impl Findings {
    /// Nothing was checked, for this reason.
    pub fn not_checked(reason: impl Display) -> Findings {
        Findings { faults: Vec::new(), open: Some(format!("not checked: {reason}")) }
    }

    /// The faults of a model.
    pub fn of(checked: Checked) -> Findings {
        Findings { faults: vec![(checked.sources, checked.diagnostics)], open: None }
    }

    /// All faults.
    pub fn diagnostics(&self) -> impl Iterator<Item = &Diagnostic> {
        self.faults.iter().flat_map(|(_, faults)| faults)
    }

    /// Whether everything was checked and nothing was found, not even a warning.
    pub fn is_clean(&self) -> bool {
        self.open.is_none() && self.diagnostics().next().is_none()
    }
}

impl<F: Files> Workspace<F> {
    /// A workspace in which nothing is being edited.
    pub fn new(files: F) -> Workspace<F> {
        Workspace { files, open: BTreeMap::new(), parsed: Parsed::default(), reads: None, stop: Stop::default() }
    }

    /// Replaces the text at a path until it is closed, whatever the disk has.
    ///
    /// # Errors
    /// The present text has a later version.
    pub fn set_text(&mut self, path: &str, version: i64, text: impl Into<Arc<str>>) -> Result<(), Outdated> {
        let path = tidy(path);
        match self.open.get(&path) {
            Some((present, _)) if *present > version => Err(Outdated { present: *present }),
            _ => {
                self.open.insert(path.clone(), (version, SourceFile::new(path, text)));
                Ok(())
            }
        }
    }

    /// Reads the text at a path from the disk again.
    pub fn close(&mut self, path: &str) {
        self.open.remove(&tidy(path));
    }

    /// From now on this can stop reading and checking. What is given while it is asked is to be thrown away.
    pub fn set_stop(&mut self, stop: Stop) {
        self.stop = stop;
    }

    /// What can stop reading and checking.
    pub fn stop(&self) -> &Stop {
        &self.stop
    }

    /// The files that are not being edited.
    pub fn files(&mut self) -> &mut F {
        &mut self.files
    }

    /// The paths of texts that are being edited, in order.
    pub fn open(&self) -> impl Iterator<Item = &str> {
        self.open.keys().map(String::as_str)
    }

    /// Does some work, and tells which texts it read: as long as these are what they were, it would come to the same.
    pub fn reading<T>(&mut self, work: impl FnOnce(&mut Self) -> T) -> (T, Reads) {
        let outer = self.reads.replace(Reads::new());
        let result = work(self);
        let reads = std::mem::replace(&mut self.reads, outer).unwrap_or_default();
        if let Some(outer) = &mut self.reads {
            outer.extend(reads.iter().map(|(path, text)| (path.clone(), text.clone())));
        }
        (result, reads)
    }

    /// Whether texts are still what they were.
    pub fn are_unchanged(&mut self, reads: &Reads) -> bool {
        reads.iter().all(|(path, former)| match (self.text(path), former) {
            (Ok(present), Some(former)) => Arc::ptr_eq(&present.text, former) || present.text == *former,
            (Err(_), None) => true,
            (Ok(_), None) | (Err(_), Some(_)) => false,
        })
    }

    /// The text at a path, as it is being edited or as it is on the disk.
    ///
    /// # Errors
    /// There is none.
    pub fn text(&mut self, path: &str) -> Result<SourceFile, Absent> {
        self.texts().read(&tidy(path))
    }

    /// Checks the file at a path: a model (`.asm`), a scenario (`.avalla`), a chart (`.chart`), a report specification
    /// (`.report.yaml`), a verification specification (`.verify.yaml`) or a coupling (`.refine`).
    ///
    /// # Errors
    /// There is no such file.
    pub fn check(&mut self, path: &str) -> Result<Findings, Absent> {
        let root = self.text(path)?;
        let loader = &mut self.texts();
        Ok(match Kind::of(Path::new(path)) {
            Some(Kind::Scenario) => {
                let tested = Suite::new().check(root, loader);
                Findings { faults: vec![(tested.sources, tested.diagnostics)], open: None }
            }
            Some(Kind::Chart) => {
                let model = Path::new(&root.name).with_extension("asm").to_string_lossy().into_owned();
                let present = match loader.read(&model) {
                    Ok(source) => Some(source.text),
                    Err(Absent::Missing) => None,
                    // Nothing can be built into a text that cannot be read.
                    Err(Absent::Unreadable(reason)) => return Ok(Findings::not_checked(reason)),
                };
                let BuiltChart { faults, .. } = build_chart(root, &model, present.as_deref(), loader);
                Findings { faults, open: None }
            }
            Some(Kind::Model) => Findings::of(check(root, loader)),
            Some(Kind::Report | Kind::Verification) => specification(&root, loader),
            Some(Kind::Coupling) => check_coupling(&root, loader),
            None => {
                let ending = path.rsplit('.').next().unwrap_or_default();
                Findings::not_checked(format!("the ending .{ending} is unknown"))
            }
        })
    }

    /// The model at a path, whatever is wrong with it: what could be understood, and all faults.
    ///
    /// # Errors
    /// There is no such file.
    pub fn checked(&mut self, path: &str) -> Result<Checked, Absent> {
        let root = self.text(path)?;
        Ok(check(root, &mut self.texts()))
    }

    /// The model at a path, ready to run.
    ///
    /// # Errors
    /// There is no such file, or it has errors.
    pub fn load(&mut self, path: &str) -> Result<Arc<Loaded>, NotLoaded> {
        let root = self.text(path).map_err(NotLoaded::Absent)?;
        load(root, &mut self.texts()).map(Arc::new).map_err(NotLoaded::Faulty)
    }

    /// Reads texts and what they import. The workspace cannot be edited meanwhile.
    pub fn texts(&mut self) -> Texts<'_, F> {
        Texts {
            files: &mut self.files,
            open: &self.open,
            parsed: &mut self.parsed,
            reads: &mut self.reads,
            stop: &self.stop,
        }
    }
}

fn specification<F: Files>(root: &SourceFile, texts: &mut Texts<'_, F>) -> Findings {
    let name = model_of(Path::new(&root.name)).to_string_lossy().into_owned();
    let model = match texts.read(&name) {
        Ok(model) => Some(model),
        Err(Absent::Missing) => None,
        Err(Absent::Unreadable(reason)) => return Findings::not_checked(reason),
    };
    check_specification(root, model, texts)
}

/// Why a model could not be loaded.
#[derive(Debug)]
pub enum NotLoaded {
    /// There is no file.
    Absent(Absent),
    /// It has errors.
    Faulty(Box<Faulty>),
}

/// The texts of a workspace as a [`Loader`].
#[derive(Debug)]
pub struct Texts<'w, F> {
    files: &'w mut F,
    open: &'w BTreeMap<String, (i64, SourceFile)>,
    parsed: &'w mut Parsed,
    reads: &'w mut Option<Reads>,
    stop: &'w Stop,
}

impl<F: Files> Files for Texts<'_, F> {
    fn read(&mut self, path: &str) -> Result<SourceFile, Absent> {
        // A text is found by the same paths whether it is being edited or on the disk.
        let path = tidy(path);
        let found = match self.open.get(&path) {
            Some((_, source)) => Ok(source.clone()),
            None => self.files.read(&path),
        };
        if let Some(reads) = self.reads {
            reads.insert(path, found.as_ref().ok().map(|source| Arc::clone(&source.text)));
        }
        found
    }
}

impl<F: Files> Loader for Texts<'_, F> {
    fn load(&mut self, importer: &SourceFile, path: &str) -> Result<SourceFile, String> {
        imported(self, importer, path)
    }

    fn parse(&mut self, file: FileId, source: &SourceFile) -> Parse {
        self.parsed.of(file, &source.text, self.stop)
    }

    fn stop(&self) -> Stop {
        self.stop.clone()
    }
}

/// Finds the text that an import names: beside the importing file, then in the working folder, then in the built-in
/// library. The library's own modules import only each other, whatever lies in the working folder.
///
/// # Errors
/// There is none; a sentence for the user.
pub fn imported(files: &mut impl Files, importer: &SourceFile, path: &str) -> Result<SourceFile, String> {
    let written = path.replace('\\', "/");
    if patterns::is_pattern(&importer.name) {
        return patterns::pattern(&importer.name, &written).ok_or_else(|| format!("{path} is not in the library"));
    }
    let complete = [".asm", ".avalla", ".chart"].iter().any(|ending| written.ends_with(ending));
    let written = if complete { written } else { written + ".asm" };
    let folder = Path::new(&importer.name).parent().unwrap_or(Path::new(""));
    let beside = tidy(&folder.join(&written).to_string_lossy());
    // Both tidied alike: a folder on the way that is not there must not make a difference.
    for place in [&beside, &tidy(&written)] {
        match files.read(place) {
            Ok(source) => return Ok(source),
            Err(Absent::Missing) => {}
            Err(Absent::Unreadable(reason)) => return Err(reason),
        }
    }
    patterns::pattern(&importer.name, &written).ok_or_else(|| {
        let missing = format!("there is no file {beside}");
        match patterns::meant(&written) {
            Some(import) => format!("{missing}; `import {import}` takes the built-in library"),
            None => missing,
        }
    })
}

/// Normalises `a/b/../c` to `a/c`, so that a file has one name however it is reached.
pub fn tidy(path: &str) -> String {
    let mut tidied = PathBuf::new();
    for component in Path::new(path).components() {
        match component {
            Component::CurDir => {}
            Component::ParentDir if matches!(tidied.components().next_back(), Some(Component::Normal(_))) => {
                tidied.pop();
            }
            other => tidied.push(other),
        }
    }
    tidied.to_string_lossy().into_owned()
}

/// Parsed texts, by their content.
#[derive(Debug, Default)]
struct Parsed {
    /// Each with when it was last asked for.
    trees: BTreeMap<Arc<str>, (u64, Parse)>,
    bytes: usize,
    now: u64,
}

impl Parsed {
    fn of(&mut self, file: FileId, text: &Arc<str>, stop: &Stop) -> Parse {
        self.now += 1;
        if let Some((used, parse)) = self.trees.get_mut(text) {
            *used = self.now;
            return parse.clone().in_file(file);
        }
        let parse = syntax::parse_asmetal_unless(stop, file, text);
        if stop.is_asked() {
            return parse;
        }
        self.bytes += text.len();
        while self.bytes > PARSED_BYTES {
            let oldest = self.trees.iter().min_by_key(|(_, (used, _))| *used).map(|(text, _)| Arc::clone(text));
            let Some(oldest) = oldest else { break };
            self.trees.remove(&oldest);
            self.bytes -= oldest.len();
        }
        self.trees.insert(Arc::clone(text), (self.now, parse.clone()));
        parse
    }
}
