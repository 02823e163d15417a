//! A project as an editor sees it: texts that change, and what is known of each of them.
//!
//! In: texts and the names of the project's files. Out: an [`Analysis`] for a file, made when it is asked for and kept as long
//! as every text that it was made of is what it was. INVARIANT: an answer depends on the texts alone, not on the edits that led
//! to them or on what was asked before.

use std::collections::{BTreeMap, BTreeSet};
use std::path::Path;
use std::sync::Arc;

use groundstate::program::Program;
use groundstate::refine::Coupling;
use groundstate::reporting::specification_beside;
use groundstate::session::Scene;
use groundstate::workspace::{Absent, Files, Findings, NotLoaded, Outdated, Reads, STOPPED, imported, tidy};
use groundstate::{Kind, Loaded, Suite, Workspace, chart_of, coupling_of, model_of, patterns, verified_system};
use model::{Checked, Loader, Model};
use syntax::ast::{AstNode, ScenarioFile};
use syntax::{FileId, Severity, SourceFile, Sources, Stop, SyntaxNode};

use crate::analysis::{Analysis, Base};

/// LIMIT: so many files that are not being edited are kept analysed.
const KEPT: usize = 64;

/// LIMIT: so many analyses that do not hold any more wait to be taken out of memory.
const RETIRED: usize = 8;

/// See the module.
#[derive(Debug)]
pub struct Project<F> {
    workspace: Workspace<F>,
    /// The files of the project, by their tidied paths.
    files: BTreeSet<String>,
    analyses: BTreeMap<String, Kept<Analysis>>,
    findings: BTreeMap<String, Kept<Findings>>,
    /// Grows whenever a text may have changed.
    revision: u64,
    /// What does not hold any more; see [`Project::rest`].
    retired: Vec<Arc<Analysis>>,
}

/// Something made of texts.
#[derive(Debug)]
struct Kept<T> {
    made: Arc<T>,
    of: Reads,
    /// When it was last seen that it still holds.
    seen: u64,
}

impl<F: Files> Project<F> {
    /// A project in which nothing is being edited and no file is known.
    pub fn new(files: F) -> Project<F> {
        Project {
            workspace: Workspace::new(files),
            files: BTreeSet::new(),
            analyses: BTreeMap::new(),
            findings: BTreeMap::new(),
            revision: 0,
            retired: Vec::new(),
        }
    }

    /// From now on this is the text at a path, whatever the disk has.
    ///
    /// # Errors
    /// A text of a later version is there.
    pub fn set_text(&mut self, path: &str, version: i64, text: impl Into<Arc<str>>) -> Result<(), Outdated> {
        self.revision += 1;
        self.workspace.set_text(path, version, text)
    }

    /// From now on the text at a path is that of the disk again.
    pub fn close(&mut self, path: &str) {
        self.revision += 1;
        self.workspace.close(path);
        self.retired.extend(self.analyses.remove(&tidy(path)).map(|kept| kept.made));
        self.findings.remove(&tidy(path));
    }

    /// Nothing is to be answered now: takes what does not hold any more out of memory, which takes a while for a long text.
    pub fn rest(&mut self) {
        self.retired.clear();
    }

    /// From now on this stops what is being made of texts. While it is asked, there is no analysis and there are no findings; nothing of
    /// what was stopped is kept.
    pub fn set_stop(&mut self, stop: Stop) {
        self.workspace.set_stop(stop);
    }

    fn not_stopped(&self) -> Result<(), Absent> {
        match self.workspace.stop().is_asked() {
            true => Err(Absent::Unreadable(STOPPED.to_string())),
            false => Ok(()),
        }
    }

    /// The paths that were read for what is known of a file.
    pub fn read_for(&self, path: &str) -> BTreeSet<String> {
        let path = tidy(path);
        let of_findings = self.findings.get(&path).into_iter().flat_map(|kept| kept.of.keys());
        let of_analysis = self.analyses.get(&path).into_iter().flat_map(|kept| kept.of.keys());
        of_findings.chain(of_analysis).cloned().collect()
    }

    /// Files on the disk may have changed.
    pub fn changed(&mut self) {
        self.revision += 1;
    }

    /// From now on these are the files of the project.
    pub fn set_files(&mut self, files: impl IntoIterator<Item = String>) {
        self.revision += 1;
        self.files = files.into_iter().map(|path| tidy(&path)).collect();
    }

    /// The files of the project and those that are being edited, in order.
    pub fn all_files(&self) -> Vec<String> {
        self.files.iter().cloned().chain(self.open()).collect::<BTreeSet<_>>().into_iter().collect()
    }

    /// The files that are being edited, in order.
    pub fn open(&self) -> Vec<String> {
        self.workspace.open().map(str::to_string).collect()
    }

    /// The disk.
    pub fn disk(&mut self) -> &mut F {
        self.workspace.files()
    }

    /// The text at a path; that of a library for a name that faults and places give one.
    ///
    /// # Errors
    /// There is none.
    pub fn text(&mut self, path: &str) -> Result<SourceFile, Absent> {
        match library_text(path) {
            Some(source) => Ok(source),
            None => self.workspace.text(path),
        }
    }

    /// What is wrong with a file.
    ///
    /// # Errors
    /// There is no such file.
    pub fn findings(&mut self, path: &str) -> Result<Arc<Findings>, Absent> {
        let path = tidy(path);
        if let Some(Kind::Model) = Kind::of(Path::new(&path)) {
            return self.analysis(&path).map(|analysis| Arc::clone(&analysis.findings));
        }
        if let Some(kept) = self.findings.get_mut(&path)
            && still_holds(kept, self.revision, &mut self.workspace)
        {
            return Ok(Arc::clone(&kept.made));
        }
        let (made, of) = self.workspace.reading(|workspace| workspace.check(&path));
        self.not_stopped()?;
        let made = Arc::new(made?);
        self.findings.insert(path, Kept { made: Arc::clone(&made), of, seen: self.revision });
        Ok(made)
    }

    /// The model at a path, ready to run.
    ///
    /// # Errors
    /// There is none, or it has errors; a sentence.
    pub fn load(&mut self, path: &str) -> Result<Arc<Loaded>, String> {
        let loaded = self.workspace.load(path);
        self.not_stopped().map_err(|absent| absent.told(path))?;
        loaded.map_err(|reason| match reason {
            NotLoaded::Absent(absent) => absent.told(path),
            NotLoaded::Faulty(_) => format!("{path} has errors: mend them first"),
        })
    }

    /// The scenario at a path, with its model, ready for a session.
    ///
    /// # Errors
    /// There is none, or one of them has errors; a sentence.
    pub fn stage(&mut self, path: &str) -> Result<Scene, String> {
        let source = self.text(path).map_err(|absent| absent.told(path))?;
        let staged = Suite::new().stage(source, &mut self.workspace.texts());
        self.not_stopped().map_err(|absent| absent.told(path))?;
        staged.map_err(|_| format!("{path} or its model has errors: mend them first"))
    }

    /// The text of a scenario that is in no file, for a session; `path` is where it would lie.
    ///
    /// # Errors
    /// It or its model has errors; a sentence with the first of them.
    pub fn stage_text(&mut self, path: &str, text: &str) -> Result<Scene, String> {
        let staged = Suite::new().stage(SourceFile::new(path, text), &mut self.workspace.texts());
        self.not_stopped().map_err(|absent| absent.told(path))?;
        staged.map_err(|tested| {
            let fault = tested.diagnostics.iter().find(|fault| fault.severity == Severity::Error);
            let told = fault.map_or("it cannot be played", |fault| fault.message.as_str());
            format!("the scenario or its model has errors: {told}")
        })
    }

    /// What a run of the model at a path is to show: the report specification beside it, or what its chart or the model says.
    ///
    /// # Errors
    /// It is there and cannot be read; a sentence.
    pub fn specification(&mut self, model: &str, program: &Arc<Program>) -> Result<SourceFile, String> {
        let beside = specification_beside(model, program, &mut self.workspace.texts());
        beside.map_err(|(path, absent)| absent.told(&path))
    }

    /// The chart at a path with the patterns that it imports, as whole as its text allows.
    ///
    /// # Errors
    /// There is none.
    pub fn chart(&mut self, path: &str) -> Result<chart::Loaded, String> {
        let source = self.text(path).map_err(|absent| absent.told(path))?;
        let loaded = chart::load(source, &mut self.workspace.texts());
        self.not_stopped().map_err(|absent| absent.told(path))?;
        Ok(loaded)
    }

    /// What a coupling says of the two models that it names; none if one of the three has faults.
    pub(crate) fn coupling(&mut self, path: &str) -> Option<Coupling> {
        let source = self.text(path).ok()?;
        coupling_of(&source, &mut self.workspace.texts()).ok()
    }

    /// The tree of a file, whatever it means.
    pub fn tree(&mut self, path: &str) -> Option<SyntaxNode> {
        let source = self.text(path).ok()?;
        Some(match Kind::of(Path::new(path))? {
            Kind::Model => self.workspace.texts().parse(FileId(0), &source).syntax(),
            Kind::Scenario => syntax::parse_avalla(FileId(0), &source.text).syntax(),
            Kind::Chart => syntax::parse_chart(FileId(0), &source.text).syntax(),
            Kind::Report | Kind::Verification | Kind::Coupling => return None,
        })
    }

    /// What is known of a file.
    ///
    /// # Errors
    /// There is no such file.
    pub fn analysis(&mut self, path: &str) -> Result<Arc<Analysis>, Absent> {
        let path = tidy(path);
        if let Some(kept) = self.analyses.get_mut(&path)
            && still_holds(kept, self.revision, &mut self.workspace)
        {
            return Ok(Arc::clone(&kept.made));
        }
        self.forget();
        let source = self.text(&path)?;
        let kind = Kind::of(Path::new(&path));
        let (made, of) = match kind {
            Some(Kind::Scenario) => {
                let tree = ScenarioFile::cast(syntax::parse_avalla(FileId(0), &source.text).syntax());
                self.over_model(source, tree.and_then(|tree| tree.model_path()))
            }
            Some(Kind::Chart) => {
                let model = Path::new(&source.name).with_extension("asm");
                self.over_model(source, model.file_name().map(|name| name.to_string_lossy().into_owned()))
            }
            Some(Kind::Model) => self.workspace.reading(|workspace| {
                let checked = match library_text(&path) {
                    Some(library) => groundstate::check(library, &mut workspace.texts()),
                    None => workspace.checked(&path).unwrap_or_else(|_| nothing(source.clone())),
                };
                let parse = workspace.texts().parse(FileId(0), &source);
                Analysis::of_model(checked, Some(parse))
            }),
            Some(kind @ (Kind::Report | Kind::Verification)) => {
                let model = model_of(Path::new(&source.name));
                let is_built = self.text(&model.to_string_lossy()).is_ok();
                if kind == Kind::Verification && !is_built {
                    self.over_system(source)
                } else {
                    self.over_model(source, model.file_name().map(|name| name.to_string_lossy().into_owned()))
                }
            }
            // A coupling's names are those of two models: they are looked up when somebody asks.
            Some(Kind::Coupling) | None => {
                self.workspace.reading(|workspace| {
                    // The text is what the answers depend on.
                    _ = workspace.text(&path);
                    Analysis::of_text(source)
                })
            }
        };
        self.not_stopped()?;
        let made = Arc::new(made);
        let kept = Kept { made: Arc::clone(&made), of, seen: self.revision };
        self.retired.extend(self.analyses.insert(path, kept).map(|former| former.made));
        Ok(made)
    }

    /// A scenario, a chart or a specification: its names are those of a model.
    fn over_model(&mut self, source: SourceFile, model: Option<String>) -> (Analysis, Reads) {
        let (root, mut reads) = self.workspace.reading(|workspace| {
            let texts = &mut workspace.texts();
            // The file itself is read so that a change of it is seen.
            _ = texts.read(&source.name);
            model.and_then(|path| imported(texts, &source, &path).ok())
        });
        let base = root.and_then(|root| {
            let analysis = self.analysis(&root.name).ok()?;
            if let Some(kept) = self.analyses.get(&tidy(&root.name)) {
                reads.extend(kept.of.iter().map(|(path, text)| (path.clone(), text.clone())));
            }
            Some(Base { sources: analysis.sources.clone(), model: Model::clone(&analysis.model) })
        });
        let base = base.unwrap_or_else(|| {
            let Checked { sources, model, .. } = nothing(SourceFile::new("", ""));
            Base { sources, model }
        });
        (Analysis::over(source, base), reads)
    }

    /// What is asked of a chart's system that no model was built of yet: its names are those of the model that would be.
    fn over_system(&mut self, source: SourceFile) -> (Analysis, Reads) {
        self.workspace.reading(|workspace| {
            let texts = &mut workspace.texts();
            _ = texts.read(&source.name);
            // Whether there is a model now counts, too.
            _ = texts.read(&model_of(Path::new(&source.name)).to_string_lossy());
            let chart = texts.read(&chart_of(Path::new(&source.name)).to_string_lossy()).ok();
            let system = chart.and_then(|chart| verified_system(chart, &["LTLLibrary"], &|_| true, texts).ok());
            let base = match system {
                Some(system) => {
                    let Loaded { sources, model, .. } = system.ground;
                    Base { sources, model: Model::clone(&model) }
                }
                None => {
                    let Checked { sources, model, .. } = nothing(SourceFile::new("", ""));
                    Base { sources, model }
                }
            };
            Analysis::over(source, base)
        })
    }

    /// Drops what is not being edited where there is much of it.
    fn forget(&mut self) {
        if self.retired.len() > RETIRED {
            self.retired.clear();
        }
        if self.analyses.len() > KEPT {
            let open: BTreeSet<String> = self.open().into_iter().collect();
            self.analyses.retain(|path, _| open.contains(path));
            self.findings.retain(|path, _| open.contains(path));
        }
    }

    /// The file that a path in an import, a `load` or an `include` of a file leads to.
    pub fn target(&mut self, importer: &SourceFile, path: &str) -> Option<String> {
        if let Some(library) = model::library(path) {
            return Some(library.name);
        }
        imported(&mut self.workspace.texts(), importer, path).ok().map(|source| source.name)
    }
}

/// The texts of a project as the files of another, in which edits are tried.
#[derive(Debug)]
pub(crate) struct Overlaid<'p, F> {
    pub project: &'p mut Project<F>,
}

impl<F: Files> Files for Overlaid<'_, F> {
    fn read(&mut self, path: &str) -> Result<SourceFile, Absent> {
        self.project.text(path)
    }
}

fn still_holds<T, F: Files>(kept: &mut Kept<T>, revision: u64, workspace: &mut Workspace<F>) -> bool {
    if kept.seen != revision && !workspace.are_unchanged(&kept.of) {
        return false;
    }
    kept.seen = revision;
    true
}

/// What checking gives of a text that is not there.
fn nothing(source: SourceFile) -> Checked {
    let mut sources = Sources::default();
    let root = sources.add(source);
    Checked { sources, model: Model::empty(root), diagnostics: Vec::new() }
}

/// The text of a library that is built in, by the name that it has among the texts of a model.
pub fn library_text(name: &str) -> Option<SourceFile> {
    if let Some(path) = name.strip_prefix("<std>/") {
        return model::library(path).filter(|found| found.name == name);
    }
    patterns::is_pattern(name).then(|| patterns::pattern(name, name.rsplit('/').next()?)).flatten()
}

/// The names of the libraries that are built in, in order.
pub fn library_names() -> Vec<String> {
    patterns::names().chain(model::libraries().map(|name| format!("<std>/{name}.asm"))).collect()
}
