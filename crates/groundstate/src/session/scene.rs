//! What a session runs: a model, or a scenario with the model that it loads.

use std::sync::Arc;

use model::Model;
use program::Program;
use scenario::Script;
use syntax::{Diagnostic, Sources, Span};

use crate::Loaded;

/// See the module.
#[derive(Debug, Clone)]
pub struct Scene {
    /// All texts.
    pub sources: Sources,
    /// The model.
    pub model: Arc<Model>,
    /// The program, with the terms of the scenario.
    pub program: Arc<Program>,
    /// The scenario.
    pub script: Option<Arc<Script>>,
    /// Warnings.
    pub diagnostics: Vec<Diagnostic>,
}

impl From<&Loaded> for Scene {
    fn from(loaded: &Loaded) -> Scene {
        let Loaded { sources, model, program, diagnostics } = loaded;
        Scene {
            sources: sources.clone(),
            model: Arc::clone(model),
            program: Arc::clone(program),
            script: None,
            diagnostics: diagnostics.clone(),
        }
    }
}

impl Scene {
    /// The declared rule that a place is in: its name, and where that is.
    pub fn rule_at(&self, span: Span) -> Option<(&str, Span)> {
        let holds = |body: Span| body.file == span.file && body.start <= span.start && span.end <= body.end;
        let rule = self.model.rules.iter().find(|rule| holds(rule.body.span))?;
        Some((rule.name.as_str(), rule.span))
    }

    /// Where the main rule is.
    pub fn main_place(&self) -> Option<Span> {
        self.model.main.map(|main| self.model.rule(main).span)
    }
}
