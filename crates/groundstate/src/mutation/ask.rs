//! Asks of a model what it and its `.verify.yaml` ask, with only those checks that count.
//!
//! In: a loaded model and the text beside it. Out: what a verification needs. The same text asks the same of a mutant, but for age
//! bounds of a system that hold by its times alone: those of a mutant may be others.

use std::collections::{BTreeMap, BTreeSet};
use std::sync::Arc;

use inputs::bound;
use inputs::verification::{self, Verification};
use machine::Bounds;
use program::{Expression, FunctionId, Program, PropertyKind};
use solve::session::Solvers;
use syntax::{Diagnostic, SourceFile};
use verify::temporal::fairness::AgentFairness;
use verify::{EngineKind, NoSolvers, NoStart, Options, Progress, Report, Request};

use super::Extent;
use crate::{Loaded, Overlay, with_libraries};

/// What is asked of a model.
#[derive(Debug, Clone)]
pub(super) struct Asked {
    pub overlay: Overlay,
    pub bounds: Bounds,
    pub undefined: BTreeSet<FunctionId>,
    terminal: Option<Expression>,
    fair: Option<AgentFairness>,
}

/// Which checks count, and how far.
#[derive(Debug, Clone, Default)]
pub(super) struct Counting {
    /// The properties that are left out.
    pub left_out: BTreeSet<Key>,
    /// A state without a step is no violation.
    pub may_rest: bool,
    /// The most steps of a run.
    pub depth: Option<u64>,
}

/// A property of a model and of its mutants: its name, and how many before it are called so.
pub(super) type Key = (String, usize);

/// The keys of a program's properties.
pub(super) fn keys(program: &Program) -> Vec<Key> {
    let mut called: BTreeMap<&str, usize> = BTreeMap::new();
    let mut keys = Vec::with_capacity(program.properties.len());
    for property in &program.properties {
        let before = called.entry(&property.name).or_default();
        keys.push((property.name.clone(), *before));
        *before += 1;
    }
    keys
}

impl Asked {
    /// What a model and the file beside it ask.
    pub fn of(
        loaded: &Loaded,
        beside: Option<&SourceFile>,
        loader: &mut dyn model::Loader,
    ) -> Result<Asked, (syntax::Sources, Vec<Diagnostic>)> {
        let mut overlay = loaded.overlay();
        let mut said = Verification::default();
        if let Some(beside) = beside {
            let file = overlay.add(beside.clone());
            match verification::read(file, &beside.text) {
                Ok(read) => said = read,
                Err(fault) => return Err((overlay.sources, vec![*fault])),
            }
            let faults = said.faults(&loaded.program);
            if !faults.is_empty() {
                return Err((overlay.sources, faults));
            }
            let [_, ctl, ltl] = &said.properties;
            let wanted = [("CTLLibrary", !ctl.is_empty()), ("LTLLibrary", !ltl.is_empty())];
            let libraries: Vec<&str> = wanted.iter().filter(|(_, wanted)| *wanted).map(|(name, _)| *name).collect();
            if let Some(grown) = with_libraries(loaded, &libraries, loader) {
                overlay = grown.overlay();
            }
        }
        let kinds = [PropertyKind::Invariant, PropertyKind::Ctl, PropertyKind::Ltl];
        let properties = kinds.into_iter().zip(&said.properties);
        let properties = properties.flat_map(|(kind, texts)| texts.iter().map(move |text| (kind, text)));
        let assumed = said.assumptions.iter().map(|text| (PropertyKind::Invar, text));
        let name = beside.map_or("", |beside| beside.name.as_str());
        for (kind, text) in assumed.chain(properties) {
            if let Err(faults) = overlay.property(kind, name, text) {
                return Err((overlay.sources, faults));
            }
        }
        let terminal = said.terminal.as_ref().map(|text| overlay.ask(name, text)).transpose();
        let terminal = terminal.map_err(|faults| (overlay.sources.clone(), faults))?;
        let fair = said.fair.as_deref().map(|fair| match fair {
            "strong" => AgentFairness::Strong,
            _ => AgentFairness::Weak,
        });
        // Both fit the program: that was asked above.
        let bounds = bound::read(&overlay.program, &said.bounds).unwrap_or_default();
        let undefined = bound::undefined(&overlay.program, &said.undefined).unwrap_or_default();
        Ok(Asked { overlay, bounds, undefined, terminal, fair })
    }

    /// Leaves out what does not count.
    pub fn counting(mut self, counting: &Counting) -> Asked {
        let mut keys = keys(&self.overlay.program).into_iter();
        let program = Arc::make_mut(&mut self.overlay.program);
        program.properties.retain(|_| keys.next().is_none_or(|key| !counting.left_out.contains(&key)));
        if counting.may_rest {
            self.terminal = self.overlay.ask("", "true").ok();
        }
        self
    }

    /// The program with its properties.
    pub fn program(&self) -> &Arc<Program> {
        &self.overlay.program
    }

    /// Explores the states one by one; `first` ends with the first violation.
    pub fn verified(
        &self,
        extent: &Extent,
        (depth, first): (Option<u64>, bool),
        interrupt: &machine::Interrupt,
    ) -> Result<Report, NoStart> {
        let options = Options {
            limits: extent.limits.clone(),
            engine: EngineKind::Explicit,
            first,
            max_states: extent.max_states,
            max_depth: depth.unwrap_or(u64::MAX),
            max_bytes: extent.max_bytes,
            bounds: self.bounds.clone(),
            undefined: self.undefined.clone(),
            terminal: self.terminal.clone(),
            interrupt: interrupt.clone(),
            ..Options::default()
        };
        let request = Request::of(self.program(), options).fair(self.fair).build();
        let request = request.expect("explicit search has a first violation");
        let solvers: &mut dyn Solvers = &mut NoSolvers;
        request.verify(solvers, &mut |_: &Progress| !interrupt.is_raised())
    }

    /// A term that has the values of a function for all its arguments; none if they cannot be listed, or depend on inputs.
    pub fn values_of(&mut self, name: &str, parameters: &[String]) -> Option<Expression> {
        let names: Vec<String> = (0..parameters.len()).map(|index| format!("$mutated{index}")).collect();
        let binders: Vec<String> =
            names.iter().zip(parameters).map(|(name, domain)| format!("{name} in {domain}")).collect();
        let term = match names.is_empty() {
            true => name.to_string(),
            false => format!("[{} | true : {name}({})]", binders.join(", "), names.join(", ")),
        };
        let value = self.overlay.value("", &term).ok()?;
        (!self.overlay.program.reads_monitored(&value)).then_some(value)
    }
}
