//! Adds terms and properties to a model from outside its texts: a stop condition, a property to verify, what a report
//! shows.
//!
//! In: a [`Loaded`], which never changes, and texts. Out: terms and properties in a program that the overlay owns. The
//! model and the program are shared with the [`Loaded`] until something is added. A fault in a text that comes from a
//! file is reported at its place in that file.

use std::sync::Arc;

use inputs::Scalar;
use model::{Model, PropertyKind};
use program::{Expression, Program, Property};
use syntax::ast::{AstNode, Term, TermFile};
use syntax::{Diagnostic, FileId, SourceFile, Sources};

use crate::{Loaded, fault, has_errors};

/// A model with added terms and properties.
#[derive(Debug, Clone)]
pub struct Overlay {
    /// The model's texts and the added ones.
    pub sources: Sources,
    /// The model, with the domains that the added terms need.
    pub model: Arc<Model>,
    /// The program, with the added terms and properties.
    pub program: Arc<Program>,
}

/// The text of an added term.
#[derive(Debug, Clone, Copy)]
pub struct Said<'t> {
    text: &'t str,
    /// Its place, if it comes from a file.
    scalar: Option<&'t Scalar>,
}

impl<'t> Said<'t> {
    /// The text.
    pub fn text(self) -> &'t str {
        self.text
    }

    /// Moves faults of the text, which was parsed as a file of its own, to their places.
    fn placed(self, faults: Vec<Diagnostic>, read_as: FileId) -> Vec<Diagnostic> {
        match self.scalar {
            Some(scalar) => scalar.placed(faults, read_as),
            None => faults,
        }
    }
}

impl<'t> From<&'t str> for Said<'t> {
    fn from(text: &'t str) -> Said<'t> {
        Said { text, scalar: None }
    }
}

impl<'t> From<&'t String> for Said<'t> {
    fn from(text: &'t String) -> Said<'t> {
        Said { text, scalar: None }
    }
}

impl<'t> From<&'t Scalar> for Said<'t> {
    fn from(scalar: &'t Scalar) -> Said<'t> {
        Said { text: scalar, scalar: Some(scalar) }
    }
}

impl Loaded {
    /// An overlay of this model, with nothing added yet.
    pub fn overlay(&self) -> Overlay {
        let Loaded { sources, model, program, .. } = self;
        Overlay { sources: sources.clone(), model: Arc::clone(model), program: Arc::clone(program) }
    }
}

impl Overlay {
    /// Adds a text that terms come from.
    pub fn add(&mut self, file: SourceFile) -> FileId {
        self.sources.add(file)
    }

    /// Adds a condition over the model, such as that of `--until`; messages show its text under `name`.
    ///
    /// # Errors
    /// The faults of the text.
    pub fn ask<'t>(&mut self, name: &str, text: impl Into<Said<'t>>) -> Result<Expression, Vec<Diagnostic>> {
        let said = text.into();
        let file = self.add(SourceFile::new(name, said.text));
        self.condition(file, name, said).map_err(|faults| said.placed(faults, file))
    }

    /// Adds a property as if it stood in the model; messages show its text under `name`.
    ///
    /// # Errors
    /// The faults of the text.
    pub fn property<'t>(
        &mut self,
        kind: PropertyKind,
        name: &str,
        text: impl Into<Said<'t>>,
    ) -> Result<(), Vec<Diagnostic>> {
        let said = text.into();
        let file = self.add(SourceFile::new(name, said.text));
        self.add_property(kind, file, name, said).map_err(|faults| said.placed(faults, file))
    }

    fn add_property(
        &mut self,
        kind: PropertyKind,
        file: FileId,
        name: &str,
        said: Said<'_>,
    ) -> Result<(), Vec<Diagnostic>> {
        let formula = self.condition(file, name, said).map_err(|mut faults| {
            faults.iter_mut().for_each(|fault| model::missing_operator(fault, kind));
            faults
        })?;
        let span = said.scalar.map_or_else(|| self.program.term_span(formula.body), Scalar::span);
        let reads_monitored = self.program.reads_monitored(&formula);
        let name = said.text.trim().to_string();
        let property = Property { kind, name, formula, conclusion: None, reads_monitored, span };
        Arc::make_mut(&mut self.program).properties.push(property);
        if matches!(kind, PropertyKind::Ctl | PropertyKind::Ltl) {
            verify::temporal::read::read(&self.program)?;
        }
        Ok(())
    }

    /// Adds a term of any domain; messages show its text under `name`.
    ///
    /// # Errors
    /// The faults of the text.
    pub fn value(&mut self, name: &str, text: &str) -> Result<Expression, Vec<Diagnostic>> {
        let file = self.add(SourceFile::new(name, text));
        let fragment = Arc::make_mut(&mut self.model).check_term(file, &term(file, text)?);
        if has_errors(&fragment.diagnostics) {
            return Err(fragment.diagnostics);
        }
        program::lower_term(Arc::make_mut(&mut self.program), &self.model, &fragment.item, &fragment.variables)
    }

    fn condition(&mut self, file: FileId, name: &str, said: Said<'_>) -> Result<Expression, Vec<Diagnostic>> {
        let term = term(file, said.text)?;
        let fragment = Arc::make_mut(&mut self.model).check_condition(file, &term, name);
        if has_errors(&fragment.diagnostics) {
            return Err(fragment.diagnostics);
        }
        program::lower_term(Arc::make_mut(&mut self.program), &self.model, &fragment.item, &fragment.variables)
    }
}

/// Parses a text as a term.
fn term(file: FileId, text: &str) -> Result<Term, Vec<Diagnostic>> {
    let parsed = syntax::parse_term(file, text);
    if has_errors(&parsed.diagnostics) {
        return Err(parsed.diagnostics);
    }
    TermFile::cast(parsed.syntax()).and_then(|file| file.term()).ok_or_else(|| vec![fault::no_term(file)])
}
