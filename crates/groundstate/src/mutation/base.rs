//! The bench: whether models and scenarios accept the model as it is, and which mutants they are to judge.
//!
//! In: what is [`Wanted`], and the texts. Out: a [`Bench`], which all workers share. INVARIANT: a check that does not hold
//! of the model as it is judges nothing; one that a limit left open counts only as far as the search came.

use std::collections::{BTreeMap, BTreeSet};
use std::ops::RangeInclusive;
use std::path::Path;
use std::sync::Arc;

use machine::Interrupt;
use mutate::{Mutant, mutants};
use scenario::Options;
use simulate::SplitMix;
use syntax::{Diagnostic, SourceFile, Sources};
use verify::{NoStart, Report};

use super::ask::{Asked, Counting};
use super::drawn::{self, Drawn, Trouble};
use super::link::{self, Link, Says};
use super::passing::{as_it_is, counting};
use super::{Candidate, Extent, Wanted};
use crate::asked_of_system::draws_system;
use crate::workspace::{Files, NotLoaded, tidy};
use crate::{Faulty, Loaded, SeededChoices, Suite, Workspace, fingerprint, own_files, text_fingerprint};

/// A model or a scenario that cannot judge.
#[derive(Debug)]
pub struct Unfit {
    /// Its path.
    pub path: String,
    /// Why, as a clause after the path.
    pub why: String,
    /// The texts that the faults refer to.
    pub sources: Sources,
    /// The faults.
    pub faults: Vec<Diagnostic>,
}

/// A model that judges.
#[derive(Debug)]
pub(super) struct Judge {
    pub path: String,
    /// If it is the system that a chart draws: the texts of the model that verifies it.
    pub system: Option<Vec<Arc<str>>>,
    /// The paths of its texts.
    pub files: BTreeSet<String>,
    pub beside: Option<SourceFile>,
    /// The model as it is.
    pub asked: Asked,
    pub counting: Counting,
    /// The number of reachable states, if all were visited.
    pub states: Option<u64>,
    /// Places that no step runs: paths and bytes.
    pub never: Vec<(String, std::ops::Range<usize>)>,
    /// A fingerprint of its texts, and of what it counts.
    pub print: String,
}

/// A scenario that judges.
#[derive(Debug)]
pub(super) struct Play {
    pub path: String,
    /// The paths of the texts that it runs.
    pub files: BTreeSet<String>,
    /// A fingerprint of its own text and of these.
    pub print: String,
}

/// The mutants by text, place and what comes there.
type Made = BTreeMap<(String, usize, usize, Vec<String>), Candidate>;

/// The paths of those who judge.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Judging<'b> {
    /// The models, by their properties.
    pub models: Vec<&'b str>,
    /// The scenarios.
    pub scenarios: Vec<&'b str>,
    /// The couplings, if refinements judge.
    pub couplings: Option<Vec<&'b str>>,
}

impl Judging<'_> {
    /// Whether there is nobody.
    pub fn is_empty(&self) -> bool {
        self.models.is_empty() && self.scenarios.is_empty() && self.couplings.as_ref().is_none_or(Vec::is_empty)
    }
}

/// Who judges, and what.
#[derive(Debug)]
pub struct Bench {
    pub(super) wanted: Wanted,
    pub(super) judges: Vec<Judge>,
    pub(super) plays: Vec<Play>,
    pub(super) links: Vec<Link>,
    pub(super) drawn: Vec<Drawn>,
    /// The mutants to judge.
    pub candidates: Vec<Candidate>,
    /// How many mutants there are, of which these may be a sample.
    pub mutants: usize,
    /// Models and scenarios that cannot judge.
    pub unfit: Vec<Unfit>,
}

impl Bench {
    /// Verifies the models and runs the scenarios as they are, and makes the mutants. `say` hears what comes next.
    pub fn new<F: Files>(
        wanted: Wanted,
        workspace: &mut Workspace<F>,
        interrupt: &Interrupt,
        say: &mut dyn FnMut(&str),
    ) -> Bench {
        let mut bench = Bench {
            wanted,
            judges: vec![],
            plays: vec![],
            links: vec![],
            drawn: vec![],
            candidates: vec![],
            mutants: 0,
            unfit: vec![],
        };
        let mut made = Made::new();
        bench.draw_charts(workspace);
        bench.judge_charts(workspace, interrupt, say);
        for path in bench.wanted.models.clone() {
            if interrupt.is_raised() {
                break;
            }
            let loaded = match workspace.load(&path) {
                Ok(loaded) => loaded,
                Err(NotLoaded::Absent(absent)) => {
                    bench.unfit(&path, absent.told(&path), Sources::default(), Vec::new());
                    continue;
                }
                Err(NotLoaded::Faulty(faulty)) => {
                    let Faulty { sources, diagnostics } = *faulty;
                    bench.unfit(&path, "has faults".to_string(), sources, diagnostics);
                    continue;
                }
            };
            if loaded.model.main.is_none() || !bench.concerns(&loaded) {
                continue;
            }
            say(&path);
            if let Some((judge, loaded)) = bench.judge((&path, false), workspace, interrupt) {
                bench.collect(&loaded, Some(bench.judges.len()), &mut made);
                bench.judges.push(judge);
            }
        }
        bench.link(workspace, interrupt, say, &mut made);
        if bench.wanted.test {
            bench.play(workspace, interrupt, say, &mut made);
        }
        bench.collect_charts(workspace, &mut made);
        bench.candidates = made.into_values().collect();
        bench.mutants = bench.candidates.len();
        bench.draw();
        bench
    }

    /// Who judges.
    pub fn judging(&self) -> Judging<'_> {
        Judging {
            models: self.judges.iter().map(|judge| judge.path.as_str()).collect(),
            scenarios: self.plays.iter().map(|play| play.path.as_str()).collect(),
            couplings: self.wanted.refine.then(|| self.links.iter().map(|link| link.path.as_str()).collect()),
        }
    }

    fn unfit(&mut self, path: &str, why: String, sources: Sources, faults: Vec<Diagnostic>) {
        self.unfit.push(Unfit { path: path.to_string(), why, sources, faults });
    }

    /// Whether a text is to be mutated.
    fn is_mutated(&self, name: &str) -> bool {
        self.wanted.mutated.contains(&tidy(name))
    }

    /// Whether a model has a text to be mutated, or that is built of one.
    fn concerns(&self, loaded: &Loaded) -> bool {
        loaded.sources.iter().any(|(_, file)| self.is_mutated(&file.name) || self.is_built(&file.name))
    }

    /// Whether a text is built of a chart to be mutated.
    fn is_built(&self, name: &str) -> bool {
        self.drawn.iter().any(|drawn| drawn.model == tidy(name))
    }

    /// Builds the models of the charts to be mutated. They are the texts of their paths from now on.
    fn draw_charts<F: Files>(&mut self, workspace: &mut Workspace<F>) {
        for path in self.wanted.mutated.clone().into_iter().filter(|path| drawn::is_chart(path)) {
            let is_new = workspace.text(&drawn::model_of(&path)).is_err();
            let drawn = match drawn::built(&path, is_new, workspace) {
                Ok(drawn) => drawn,
                Err(Trouble { why, sources, faults }) => {
                    self.unfit(&path, why, sources, faults);
                    continue;
                }
            };
            if is_new {
                // No text is newer than the first one.
                let _ = workspace.set_text(&drawn.model, 0, drawn.text.as_str());
            } else if workspace.text(&drawn.model).is_ok_and(|there| *there.text != *drawn.text) {
                let why = format!("is not what {} was built of: build it again", drawn.model);
                self.unfit(&path, why, Sources::default(), Vec::new());
                continue;
            }
            self.drawn.push(drawn);
        }
    }

    /// The charts that judge: by their systems, or by the models that are built of them.
    fn judge_charts<F: Files>(
        &mut self,
        workspace: &mut Workspace<F>,
        interrupt: &Interrupt,
        say: &mut dyn FnMut(&str),
    ) {
        for path in self.wanted.charts.clone() {
            let is_mutated = self.drawn.iter().any(|drawn| tidy(&drawn.chart.name) == path);
            if !is_mutated || interrupt.is_raised() {
                continue;
            }
            let draws_system = workspace.text(&path).is_ok_and(|chart| draws_system(&chart));
            let judging = if draws_system { path.clone() } else { drawn::model_of(&path) };
            if !draws_system && workspace.load(&judging).is_ok_and(|loaded| loaded.model.main.is_none()) {
                continue;
            }
            say(&judging);
            if let Some((judge, _)) = self.judge((&judging, draws_system), workspace, interrupt) {
                self.judges.push(judge);
            }
        }
    }

    /// Makes the mutants of charts, and of the machines by which their components decide. They are judged by the chart's system, and by the
    /// models that have the model that is built of it.
    fn collect_charts<F: Files>(&self, workspace: &mut Workspace<F>, made: &mut Made) {
        for drawn in &self.drawn {
            let name = tidy(&drawn.chart.name);
            let shared = Arc::new(SourceFile::new(name.clone(), Arc::clone(&drawn.chart.text)));
            let judges = |judge: &&Judge| {
                if judge.system.is_some() { judge.path == name } else { judge.files.contains(&drawn.model) }
            };
            let models = self.judges.iter().enumerate().filter(|(_, judge)| judges(judge)).map(|(index, _)| index);
            let models: Vec<usize> = models.collect();
            let mutants = mutate::chart_mutants(&drawn.chart.text);
            for mutant in mutants.into_iter().filter(|mutant| self.is_wanted(mutant, &shared)) {
                let new = Candidate {
                    file: Arc::clone(&shared),
                    mutant,
                    models: models.clone(),
                    builds: vec![drawn.model.clone()],
                    components: Vec::new(),
                };
                made.insert(key(&new), new);
            }
            self.collect_machines(drawn, &models, workspace, made);
        }
    }

    /// Makes the mutants of the machines by which the components of a chart decide, whose judges have these numbers.
    fn collect_machines<F: Files>(
        &self,
        drawn: &Drawn,
        models: &[usize],
        workspace: &mut Workspace<F>,
        made: &mut Made,
    ) {
        for (path, components) in &drawn.machines {
            let Ok(loaded) = workspace.load(path) else { continue };
            let own = own_files(&loaded.sources);
            let is_machine = |name: &str| self.wanted.imports || tidy(name) == *path;
            for (id, file) in loaded.sources.iter().filter(|(id, file)| own(*id) && is_machine(&file.name)) {
                let shared = Arc::new(SourceFile::new(tidy(&file.name), Arc::clone(&file.text)));
                let mutants = mutants(&loaded.model, &loaded.sources, id);
                for mutant in mutants.into_iter().filter(|mutant| self.is_wanted(mutant, &shared)) {
                    let file = Arc::clone(&shared);
                    let new = Candidate { file, mutant, models: vec![], builds: vec![], components: vec![] };
                    let candidate = made.entry(key(&new)).or_insert(new);
                    candidate.also(models, &drawn.model, components);
                }
            }
        }
    }

    /// Whether a mutant is by one of the operators, and in one of the lines.
    fn is_wanted(&self, mutant: &Mutant, file: &SourceFile) -> bool {
        let line = file.line_column(mutant.place.start as u32).line;
        let last = file.line_column(mutant.place.end as u32).line;
        let lines = self.wanted.lines.as_ref().map(|lines| lines.get(&file.name).map_or(&[][..], Vec::as_slice));
        let touched = |range: &RangeInclusive<u32>| *range.start() <= last && line <= *range.end();
        self.wanted.operators.contains(&mutant.operator) && lines.is_none_or(|lines| lines.iter().any(touched))
    }

    /// Makes the mutants of a model's texts; if the model judges them, that is its number.
    fn collect(&self, loaded: &Loaded, judge: Option<usize>, made: &mut Made) {
        let own = own_files(&loaded.sources);
        for (id, file) in loaded.sources.iter() {
            let name = tidy(&file.name);
            if !own(id) || !(self.wanted.imports || self.is_mutated(&name)) {
                continue;
            }
            let shared = Arc::new(SourceFile::new(name.clone(), Arc::clone(&file.text)));
            let mutants = mutants(&loaded.model, &loaded.sources, id);
            for mutant in mutants.into_iter().filter(|mutant| self.is_wanted(mutant, &shared)) {
                let file = Arc::clone(&shared);
                let new = Candidate { file, mutant, models: vec![], builds: vec![], components: vec![] };
                made.entry(key(&new)).or_insert(new).models.extend(judge);
            }
        }
    }

    /// Draws a sample.
    fn draw(&mut self) {
        let Some((size, seed)) = self.wanted.sample else { return };
        let mut random = SplitMix::new(seed);
        let mut left = std::mem::take(&mut self.candidates);
        let mut drawn: Vec<usize> = Vec::new();
        let mut numbers: Vec<usize> = (0..left.len()).collect();
        while drawn.len() < size && !numbers.is_empty() {
            drawn.push(numbers.swap_remove(random.below(numbers.len() as u64) as usize));
        }
        drawn.sort_unstable();
        let mut index = 0;
        left.retain(|_| {
            index += 1;
            drawn.binary_search(&(index - 1)).is_ok()
        });
        self.candidates = left;
    }

    /// A model as a judge, or the system of a chart; none if it does not pass itself.
    fn judge<F: Files>(
        &mut self,
        (path, is_system): (&str, bool),
        workspace: &mut Workspace<F>,
        interrupt: &Interrupt,
    ) -> Option<(Judge, Arc<Loaded>)> {
        let spec = Path::new(path).with_extension("verify.yaml");
        let beside = workspace.text(&spec.to_string_lossy()).ok();
        let (loaded, asked) = match asked((path, is_system), beside.as_ref(), workspace) {
            Ok(asked) => asked,
            Err(Trouble { why, sources, faults }) => {
                self.unfit(path, why, sources, faults);
                return None;
            }
        };
        let mut judge = Judge {
            path: path.to_string(),
            system: is_system.then(|| texts_of(&loaded)),
            files: loaded.sources.iter().map(|(_, file)| tidy(&file.name)).collect(),
            beside,
            asked,
            counting: Counting::default(),
            states: None,
            never: Vec::new(),
            print: String::new(),
        };
        if self.wanted.verify {
            match as_it_is(&judge.asked, &self.wanted.extent, interrupt) {
                Ok(report) => match counting(&report, &judge.asked) {
                    Ok(counting) => {
                        judge.note(&report, &loaded, counting);
                    }
                    Err(why) => {
                        self.unfit(path, why, Sources::default(), Vec::new());
                        return None;
                    }
                },
                Err(NoStart::Fault(fault)) => {
                    let fault = crate::diagnose_fault(&fault, judge.asked.program());
                    self.unfit(path, "has no initial state".to_string(), loaded.sources.clone(), vec![fault]);
                    return None;
                }
                Err(NoStart::Stopped(_)) if interrupt.is_raised() => return None,
                Err(_) => {
                    let why = "has initial states that cannot be listed".to_string();
                    self.unfit(path, why, Sources::default(), Vec::new());
                    return None;
                }
            }
        }
        let beside = judge.beside.as_ref().map(|beside| text_fingerprint(&beside.text));
        let texts = fingerprint(&loaded.sources);
        judge.print = format!("{path} {texts} {beside:?} {:?} {:?}", judge.counting, judge.states);
        judge.asked = judge.asked.clone().counting(&judge.counting);
        Some((judge, loaded))
    }

    /// Asks the couplings that are about a text to be mutated, and keeps those that refine.
    fn link<F: Files>(
        &mut self,
        workspace: &mut Workspace<F>,
        interrupt: &Interrupt,
        say: &mut dyn FnMut(&str),
        made: &mut Made,
    ) {
        for path in self.wanted.couplings.clone() {
            if interrupt.is_raised() || !self.wanted.refine {
                break;
            }
            let files = link::files(&path, workspace);
            let concerned = match self.wanted.imports {
                true => self.judges.is_empty() || self.judges.iter().any(|judge| files.contains(&tidy(&judge.path))),
                false => files.is_empty() || files.iter().any(|file| self.is_mutated(file) || self.is_built(file)),
            };
            if !concerned {
                continue;
            }
            say(&path);
            let (link, said) = link::ask(&path, workspace, &self.wanted.extent, interrupt);
            match said {
                Says::Refines => {
                    for model in &link.models {
                        if let Ok(loaded) = workspace.load(model) {
                            self.collect(&loaded, None, made);
                        }
                    }
                    self.links.push(link);
                }
                _ if interrupt.is_raised() => break,
                Says::DoesNot(_) => {
                    let why = "does not pass as it is: it is no refinement".to_string();
                    self.unfit(&path, why, Sources::default(), Vec::new());
                }
                Says::Open(why) => {
                    self.unfit(&path, format!("is not decided as it is: {why}"), Sources::default(), Vec::new());
                }
                Says::Unfit(why, sources, faults) => self.unfit(&path, why, sources, faults),
            }
        }
    }

    /// Runs the scenarios that run a text to be mutated, and keeps those that pass. Makes the mutants of such a text where no
    /// model judges it.
    fn play<F: Files>(
        &mut self,
        workspace: &mut Workspace<F>,
        interrupt: &Interrupt,
        say: &mut dyn FnMut(&str),
        made: &mut Made,
    ) {
        let mut suite = Suite::new();
        for path in self.wanted.scenarios.clone() {
            if interrupt.is_raised() {
                break;
            }
            let source = match workspace.text(&path) {
                Ok(source) => source,
                Err(absent) => {
                    self.unfit(&path, absent.told(&path), Sources::default(), Vec::new());
                    continue;
                }
            };
            say(&path);
            let tested = suite.test(
                source,
                &mut workspace.texts(),
                play_options(&self.wanted.extent, interrupt),
                &mut SeededChoices::new(0),
            );
            let files: BTreeSet<String> = tested.sources.iter().map(|(_, file)| tidy(&file.name)).collect();
            let concerned = match self.wanted.imports {
                true => self.judges.iter().any(|judge| files.contains(&tidy(&judge.path))),
                false => files.iter().any(|file| self.wanted.mutated.contains(file) || self.is_built(file)),
            };
            match (concerned, tested.passed()) {
                (true, true) => {
                    let unjudged = |text: &&String| !self.judges.iter().any(|judge| judge.files.contains(*text));
                    for text in files.iter().filter(|text| self.is_mutated(text)).filter(unjudged) {
                        if let Ok(loaded) = workspace.load(text) {
                            self.collect(&loaded, None, made);
                        }
                    }
                    let print = format!("{path} {}", fingerprint(&tested.sources));
                    self.plays.push(Play { path, files, print });
                }
                (true, false) if interrupt.is_raised() => break,
                (true, false) => {
                    let faults = tested.failures();
                    self.unfit(&path, "fails with the model as it is".to_string(), tested.sources, faults);
                }
                (false, _) => {}
            }
        }
    }
}

/// The texts of a model.
pub(super) fn texts_of(loaded: &Loaded) -> Vec<Arc<str>> {
    loaded.sources.iter().map(|(_, file)| Arc::clone(&file.text)).collect()
}

/// What a model asks, or the system of a chart, by their texts as they are now.
pub(super) fn asked<F: Files>(
    (path, is_system): (&str, bool),
    beside: Option<&SourceFile>,
    workspace: &mut Workspace<F>,
) -> Result<(Arc<Loaded>, Asked), Trouble> {
    if is_system {
        return drawn::system(path, beside, workspace).map(|(loaded, asked)| (Arc::new(loaded), asked));
    }
    let loaded = workspace.load(path).map_err(|not| match not {
        NotLoaded::Absent(absent) => Trouble::plain(absent.told(path)),
        NotLoaded::Faulty(faulty) => {
            let Faulty { sources, diagnostics } = *faulty;
            Trouble { why: "has faults".to_string(), sources, faults: diagnostics }
        }
    })?;
    let asked = Asked::of(&loaded, beside, &mut workspace.texts());
    let trouble = |(sources, faults)| Trouble { why: drawn::BESIDE.to_string(), sources, faults };
    asked.map(|asked| (loaded, asked)).map_err(trouble)
}

/// A mutant's text, place and what comes there.
fn key(candidate: &Candidate) -> (String, usize, usize, Vec<String>) {
    let Candidate { file, mutant, .. } = candidate;
    let texts = mutant.edits.iter().map(|edit| edit.text.clone()).collect();
    (file.name.clone(), mutant.place.start, mutant.place.end, texts)
}

/// How scenarios are run.
pub(super) fn play_options(extent: &Extent, interrupt: &Interrupt) -> Options {
    let mut options = Options { limits: extent.limits.clone(), ..Options::default() };
    options.limits.interrupt = interrupt.clone();
    options
}

impl Judge {
    fn note(&mut self, report: &Report, loaded: &Loaded, counting: Counting) {
        let stopped = report.stop.is_some();
        self.states = (!stopped).then_some(report.progress.states);
        self.counting = counting;
        let place = |span: &syntax::Span| (tidy(&loaded.sources.file(span.file).name), span.range());
        // The list is empty unless every state was visited. A system's rules stand in no text.
        let unreachable = report.unreachable.iter().filter(|_| self.system.is_none());
        self.never = unreachable.map(place).collect();
    }
}
