//! Proves a property of a chart's system on a part of it that is enough, whatever the rest does.
//!
//! In: a question about machines, and a search of all states of a model. Out: the part that the property holds of, if there is one. A part
//! has few states where the whole has too many. INVARIANT: only invariants and formulas of LTL are proved so, and only if they speak of
//! nothing but what the part keeps: then each run of the system is one of the part. What is violated in a part says nothing of the system.

use std::collections::BTreeSet;
use std::sync::Arc;

use model::Loader;
use program::{FunctionKind, Program, PropertyKind, Term};
use syntax::SourceFile;
use verify::{Outcome, Report, Subject, Verdict};

use crate::asked_of_system::words;
use crate::overlay::{Overlay, Said};
use crate::verified_system::{ReducedSystem, reduced_system, verified_system};

/// LIMIT: how many times a part is widened.
const WIDENINGS: usize = 16;

/// What is asked of a system.
#[derive(Debug, Clone)]
pub struct PartQuestion<'a> {
    /// An invariant or a formula of LTL: nothing else is proved on parts.
    pub kind: PropertyKind,
    /// The name under which messages show it.
    pub shown: &'static str,
    /// The formula.
    pub text: &'a str,
    /// All assumptions about the system.
    pub assumptions: Vec<Said<'a>>,
    /// The inputs that may be undef.
    pub undefined: Vec<String>,
}

/// The part that a property holds of.
#[derive(Debug)]
pub struct ProofOnPart {
    /// The components whose machines are a part of it.
    pub components: Vec<String>,
    /// The model that was searched, with the property.
    pub asked: Overlay,
    /// What was found of the property, and nothing else.
    pub report: Report,
}

/// A model of a part, to be searched for the last of its properties.
#[derive(Debug)]
pub struct PartSearch<'a> {
    /// The model with what is assumed and asked.
    pub asked: &'a Overlay,
    /// The inputs that may be undef.
    pub undefined: Vec<String>,
}

/// A chart whose system has parts.
#[derive(Debug)]
pub struct SystemParts {
    root: SourceFile,
    /// The names of tasks, phases, channels and patterns: a part has not all of them, so what speaks of them is asked of the whole.
    timing: BTreeSet<String>,
}

impl SystemParts {
    /// Those of the system of a chart; none if the chart has faults, which are told when it is loaded.
    pub fn of(root: SourceFile, loader: &mut dyn Loader) -> Option<SystemParts> {
        let bare = verified_system(root.clone(), &[], &|_| false, loader).ok()?.loaded;
        let is_timing = |span: syntax::Span| !bare.sources.file(span.file).name.starts_with("<std>");
        let functions = bare.model.functions.iter().filter(|function| !function.library && is_timing(function.span));
        let mut timing: BTreeSet<String> = functions.map(|function| function.name.clone()).collect();
        let domains = bare.model.domains.iter().filter(|(_, domain)| domain.span.is_some_and(is_timing));
        timing.extend(domains.filter_map(|(_, domain)| domain.name.clone()));
        // A part has fewer agents, too.
        timing.insert("Agent".to_string());
        Some(SystemParts { root, timing })
    }

    /// Looks for a part that a property holds of: the smallest first, then wider ones as long as a search of one ends. `search` explores a model
    /// and returns what it found; none if the model cannot be searched.
    ///
    /// # Errors
    /// Those of `search`.
    pub fn prove<E>(
        &self,
        question: &PartQuestion<'_>,
        loader: &mut dyn Loader,
        search: &mut dyn FnMut(PartSearch<'_>) -> Result<Option<Report>, E>,
    ) -> Result<Option<ProofOnPart>, E> {
        let libraries: &[&str] = match question.kind {
            PropertyKind::Invariant => &[],
            PropertyKind::Ltl => &["LTLLibrary"],
            PropertyKind::Ctl | PropertyKind::Invar | PropertyKind::Justice | PropertyKind::Compassion => {
                return Ok(None);
            }
        };
        let spoken: BTreeSet<&str> = words(question.text).collect();
        if spoken.iter().any(|word| self.timing.contains(*word)) {
            return Ok(None);
        }
        for widenings in 0..=WIDENINGS {
            let part = reduced_system(self.root.clone(), libraries, &|name| spoken.contains(name), widenings, loader);
            let Ok(Some(part)) = part else { return Ok(None) };
            let mut is_searched = false;
            for loaded in part.system.general.iter().chain([&part.system.loaded]) {
                let Some((asked, index)) = self.asked(question, &part, loaded.overlay()) else { return Ok(None) };
                let undefined = undefined(question, &part, &asked.program);
                let Some(mut report) = search(PartSearch { asked: &asked, undefined })? else { return Ok(None) };
                report.verdicts.retain(|verdict: &Verdict| verdict.subject == Subject::Property(index));
                report.unreachable.clear();
                match report.verdicts.first().map(|verdict| &verdict.outcome) {
                    Some(Outcome::Holds) => {
                        return Ok(Some(ProofOnPart { components: part.components, asked, report }));
                    }
                    // It is violated, or has no truth value, in a part in which more happens than in the system.
                    Some(_) => is_searched |= report.complete,
                    None => {}
                }
            }
            // A wider part is larger.
            if !is_searched {
                return Ok(None);
            }
        }
        Ok(None)
    }

    /// The model of a part with what is assumed and asked, and the place of the property; none if the part has no words for it.
    fn asked(&self, question: &PartQuestion<'_>, part: &ReducedSystem, bare: Overlay) -> Option<(Overlay, usize)> {
        let mut asked = bare;
        // What is the system's own is asked of the whole; that tasks do not work for ever is assumed here, too.
        let own = [PropertyKind::Invariant, PropertyKind::Ctl, PropertyKind::Ltl];
        Arc::make_mut(&mut asked.program).properties.retain(|property| !own.contains(&property.kind));
        // Without an assumption that speaks of more than the part keeps, more is proved.
        for assumption in &question.assumptions {
            let mut tried = asked.clone();
            if !words(assumption.text()).any(|word| self.timing.contains(word))
                && tried.property(PropertyKind::Invar, "--assume", *assumption).is_ok()
                && tried.program.properties.last().is_some_and(|last| is_within(&tried.program, &last.formula, part))
            {
                asked = tried;
            }
        }
        let index = asked.program.properties.len();
        asked.property(question.kind, question.shown, question.text).ok()?;
        is_within(&asked.program, &asked.program.properties[index].formula, part).then_some((asked, index))
    }
}

/// The inputs of a part that may be undef.
fn undefined(question: &PartQuestion<'_>, part: &ReducedSystem, program: &Program) -> Vec<String> {
    let is_there = |name: &&String| program.functions.iter().any(|function| function.name == **name);
    part.undefined.iter().chain(&question.undefined).filter(is_there).cloned().collect()
}

/// Whether a term reads nothing but what a part keeps.
fn is_within(program: &Program, expression: &program::Expression, part: &ReducedSystem) -> bool {
    let mut open = vec![expression.body];
    let mut entered = BTreeSet::new();
    while let Some(id) = open.pop() {
        if let Term::Read { function, .. } | Term::Define { function, .. } = program.term(id) {
            let declared = program.function(*function);
            let is = |name: &String| *name == declared.name;
            match &declared.definition {
                _ if part.free.iter().any(is) => return false,
                _ if part.system.data.iter().any(is) => {}
                Some(definition) => {
                    if entered.insert(*function) {
                        open.push(definition.body);
                    }
                }
                None if declared.kind == FunctionKind::Static => {}
                None => return false,
            }
        }
        program.each_child_of_term(id, &mut |child| open.push(child));
    }
    true
}
