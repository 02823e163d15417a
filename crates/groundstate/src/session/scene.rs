//! What a session runs: a model, or a scenario with the model that it loads.

use std::sync::Arc;

use machine::{Location, Value};
use model::Model;
use program::{Function, FunctionKind, Program};
use scenario::Script;
use simulate::{read_location, read_value};
use syntax::{Diagnostic, Sources, Span};

use crate::{Loaded, Overlay};

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
    /// An overlay of this scene, with nothing added yet.
    pub fn overlay(&self) -> Overlay {
        let Scene { sources, model, program, .. } = self;
        Overlay { sources: sources.clone(), model: Arc::clone(model), program: Arc::clone(program) }
    }

    /// Reads an input and its value.
    ///
    /// # Errors
    /// A sentence: there is no such input or no such value.
    pub fn read_input(&self, location: &str, value: &str) -> Result<(Location, Value), String> {
        let location = self.input(location)?;
        let value = read_value(&self.program, self.program.function(location.function).codomain, value)?;
        Ok((location, value))
    }

    /// Reads a location that takes inputs.
    ///
    /// # Errors
    /// A sentence: it is none.
    pub(crate) fn input(&self, text: &str) -> Result<Location, String> {
        let location = read_location(&self.program, text)?;
        let Function { name, kind, .. } = self.program.function(location.function);
        match kind {
            FunctionKind::Monitored | FunctionKind::Shared => Ok(location),
            _ => Err(format!("`{name}` is written by the machine: only monitored and shared functions take inputs")),
        }
    }

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
