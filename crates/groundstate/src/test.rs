//! Runs scenarios against their models: parse, load the model, resolve, run.
//!
//! A [`Suite`] keeps the models it has loaded, so a folder of scenarios loads each model once. It adds up what the
//! scenarios of a model cover.

use std::collections::BTreeMap;
use std::sync::Arc;

use model::{Loader, Model};
use program::Program;
use scenario::{Blocks, Choices, Counts, Items, Options, Story, Verdict};
use simulate::SplitMix;
use syntax::{Diagnostic, FileId, Severity, SourceFile, Sources};

use crate::fault::scenario::unknown_model;
use crate::session::Scene;
use crate::{Faulty, Loaded, diagnose_failure, has_errors, load};

/// Scenarios that share models and coverage.
#[derive(Debug, Default)]
pub struct Suite {
    models: BTreeMap<String, Result<Loaded, Box<Faulty>>>,
    counts: BTreeMap<String, Counts>,
}

/// The result of one scenario.
#[derive(Debug)]
pub struct Tested {
    /// All texts that places refer to.
    pub sources: Sources,
    /// The scenario's name, or its file's name if it has none.
    pub name: String,
    /// The verdict; `None` if the scenario or its model has errors.
    pub verdict: Option<Verdict>,
    /// Faults of the scenario or its model, warnings included.
    pub diagnostics: Vec<Diagnostic>,
    /// The program that the scenario ran on.
    pub program: Option<Arc<Program>>,
}

impl Tested {
    /// Whether the scenario ended as it should.
    pub fn passed(&self) -> bool {
        self.verdict.as_ref().is_some_and(Verdict::passed)
    }

    /// Why the scenario did not pass.
    pub fn failures(&self) -> Vec<Diagnostic> {
        let (Some(verdict), Some(program)) = (&self.verdict, &self.program) else {
            let errors = self.diagnostics.iter().filter(|diagnostic| diagnostic.severity == Severity::Error);
            return errors.cloned().collect();
        };
        verdict.failures().iter().flat_map(|failure| diagnose_failure(failure, program)).collect()
    }

    /// The run of a scenario that failed, if it was kept.
    pub fn story(&self) -> Option<(&Program, &Story)> {
        let verdict = self.verdict.as_ref().filter(|verdict| !verdict.passed())?;
        Some((self.program.as_deref()?, verdict.story.as_ref()?))
    }
}

/// Random choices from a seed.
#[derive(Debug)]
pub struct SeededChoices(SplitMix);

impl SeededChoices {
    /// Choices from a seed.
    pub fn new(seed: u64) -> Self {
        SeededChoices(SplitMix::new(seed))
    }
}

impl Choices for SeededChoices {
    fn choose(&mut self, candidates: usize) -> usize {
        self.0.below(candidates as u64) as usize
    }
}

/// Finds scenarios whose blocks are called, in the same places as imports.
struct BlockLoader<'a>(&'a mut dyn Loader);

impl Blocks for BlockLoader<'_> {
    fn load(&mut self, importer: &SourceFile, name: &str) -> Result<SourceFile, String> {
        self.0.load(importer, &format!("{name}.avalla"))
    }
}

/// Whether a file is the user's, not one of a built-in library.
pub fn own_files(sources: &Sources) -> impl Fn(FileId) -> bool + '_ {
    |file| {
        let name = &sources.file(file).name;
        !name.starts_with("<std>") && !crate::patterns::is_pattern(name)
    }
}

/// A scenario with the model and the program, both grown by its terms.
struct Staged {
    script: scenario::Script,
    model: Arc<Model>,
    program: Arc<Program>,
}

/// A resolved scenario, or its faults.
struct Ready {
    sources: Sources,
    name: String,
    script: Option<Staged>,
    diagnostics: Vec<Diagnostic>,
    /// The name of the model's root file.
    model: Option<String>,
}

impl Suite {
    /// A suite that has loaded nothing yet.
    pub fn new() -> Self {
        Suite::default()
    }

    /// Checks a scenario and its model without running it.
    pub fn check(&mut self, source: SourceFile, loader: &mut dyn Loader) -> Tested {
        let Ready { sources, name, diagnostics, .. } = self.ready(source, loader);
        Tested { sources, name, verdict: None, diagnostics, program: None }
    }

    /// Prepares a scenario and its model for a session.
    ///
    /// # Errors
    /// The scenario or its model has errors.
    pub fn stage(&mut self, source: SourceFile, loader: &mut dyn Loader) -> Result<Scene, Box<Tested>> {
        let Ready { sources, name, script, diagnostics, .. } = self.ready(source, loader);
        match script {
            Some(Staged { script, model, program }) => {
                Ok(Scene { sources, model, program, script: Some(Arc::new(script)), diagnostics })
            }
            None => Err(Box::new(Tested { sources, name, verdict: None, diagnostics, program: None })),
        }
    }

    /// Runs a scenario.
    pub fn test(
        &mut self,
        source: SourceFile,
        loader: &mut dyn Loader,
        options: Options,
        choices: &mut dyn Choices,
    ) -> Tested {
        let Ready { sources, name, script, diagnostics, model } = self.ready(source, loader);
        let Some(Staged { script, program, .. }) = script else {
            return Tested { sources, name, verdict: None, diagnostics, program: None };
        };
        let covers = options.coverage;
        let (verdict, counts) = scenario::run(&script, Arc::clone(&program), options, choices);
        if let (true, Some(model)) = (covers, model) {
            self.counts.entry(model).or_default().merge(&counts);
        }
        Tested { sources, name, verdict: Some(verdict), diagnostics, program: Some(program) }
    }

    /// What the scenarios covered of each model, by the name of the model's file.
    pub fn coverage(&self) -> impl Iterator<Item = (&str, &Sources, Items)> {
        self.counts.iter().filter_map(|(name, counts)| {
            let loaded = self.models.get(name)?.as_ref().ok()?;
            let items = Items::of(&loaded.model, &own_files(&loaded.sources), counts);
            Some((name.as_str(), &loaded.sources, items))
        })
    }

    /// Takes what the scenarios covered of all models so far. Places are those of the models as they are loaded.
    pub fn take_counts(&mut self) -> Counts {
        let mut all = Counts::default();
        std::mem::take(&mut self.counts).values().for_each(|counts| all.merge(counts));
        all
    }

    fn ready(&mut self, source: SourceFile, loader: &mut dyn Loader) -> Ready {
        let stem = source.name.rsplit(['/', '\\']).next().unwrap_or_default().trim_end_matches(".avalla");
        let name = stem.to_string();
        let mut alone = Sources::default();
        let file = alone.add(source.clone());
        let parsed = scenario::parse(&alone, file);
        let refused =
            |sources, diagnostics| Ready { sources, name: name.clone(), script: None, diagnostics, model: None };
        let Some((path, place)) = &parsed.model else { return refused(alone, parsed.diagnostics) };
        let root = match loader.load(&source, path) {
            Ok(root) => root,
            Err(message) => {
                let mut diagnostics = parsed.diagnostics.clone();
                diagnostics.push(unknown_model(*place, message));
                return refused(alone, diagnostics);
            }
        };
        let model_name = root.name.clone();
        let entry = self.models.entry(model_name.clone());
        let loaded = match entry.or_insert_with(|| load(root, loader)) {
            Ok(loaded) => loaded,
            Err(faulty) => {
                let mut diagnostics = faulty.diagnostics.clone();
                let mut sources = faulty.sources.clone();
                // The scenario's own faults are shown together with those of its model.
                let file = sources.add(source);
                diagnostics.extend(scenario::parse(&sources, file).diagnostics);
                return refused(sources, diagnostics);
            }
        };
        let mut sources = loaded.sources.clone();
        let file = sources.add(source);
        let parsed = scenario::parse(&sources, file);
        let (mut model, mut program) = (Arc::clone(&loaded.model), Arc::clone(&loaded.program));
        let mut blocks = BlockLoader(loader);
        let (asked, extended) = (Arc::make_mut(&mut model), Arc::make_mut(&mut program));
        match scenario::resolve(&parsed, asked, extended, &mut sources, &mut blocks) {
            Ok((script, diagnostics)) => {
                debug_assert!(!has_errors(&diagnostics));
                let name = if script.name.is_empty() { name } else { script.name.clone() };
                let script = Some(Staged { script, model, program });
                Ready { sources, name, script, diagnostics, model: Some(model_name) }
            }
            Err(diagnostics) => refused(sources, diagnostics),
        }
    }
}
