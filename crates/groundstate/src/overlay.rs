//! Questions to a model that its texts do not hold: a term to stop at, a property to verify, what a report shows.
//!
//! In: a [`Loaded`], which stays as it is, and texts. Out: terms and properties of a program of the overlay's own. What is not
//! added to is shared, so that an overlay costs nothing until it is asked.

use std::sync::Arc;

use model::{Model, PropertyKind};
use program::{Expression, Program, Property};
use syntax::ast::{AstNode, Term, TermFile};
use syntax::{Diagnostic, FileId, SourceFile, Sources};

use crate::{Loaded, fault, has_errors};

/// See the module.
#[derive(Debug, Clone)]
pub struct Overlay {
    /// The model's texts, and those that were added.
    pub sources: Sources,
    /// The model, with the domains that the questions brought.
    pub model: Arc<Model>,
    /// The program, with the terms and properties of the questions.
    pub program: Arc<Program>,
}

impl Loaded {
    /// The model, ready to be asked.
    pub fn overlay(&self) -> Overlay {
        let Loaded { sources, model, program, .. } = self;
        Overlay { sources: sources.clone(), model: Arc::clone(model), program: Arc::clone(program) }
    }
}

impl Overlay {
    /// Adds a text that questions stand in.
    pub fn add(&mut self, file: SourceFile) -> FileId {
        self.sources.add(file)
    }

    /// A condition over the model, such as that of `--until`; `name` is what its text is shown under.
    ///
    /// # Errors
    /// The faults of the text.
    pub fn ask(&mut self, name: &str, text: &str) -> Result<Expression, Vec<Diagnostic>> {
        let (file, term) = self.term(name, text)?;
        let fragment = Arc::make_mut(&mut self.model).check_condition(file, &term, name);
        if has_errors(&fragment.diagnostics) {
            return Err(fragment.diagnostics);
        }
        program::lower_term(Arc::make_mut(&mut self.program), &self.model, &fragment.item, &fragment.variables)
    }

    /// Adds a property as if it stood in the model; `name` is what its text is shown under.
    ///
    /// # Errors
    /// The faults of the text.
    pub fn property(&mut self, kind: PropertyKind, name: &str, text: &str) -> Result<(), Vec<Diagnostic>> {
        let formula = self.ask(name, text).map_err(|mut faults| {
            faults.iter_mut().for_each(|fault| model::missing_operator(fault, kind));
            faults
        })?;
        let span = self.program.term_span(formula.body);
        let reads_monitored = self.program.reads_monitored(&formula);
        let name = text.trim().to_string();
        let property = Property { kind, name, formula, conclusion: None, reads_monitored, span };
        Arc::make_mut(&mut self.program).properties.push(property);
        if matches!(kind, PropertyKind::Ctl | PropertyKind::Ltl) {
            verify::temporal::read::read(&self.program)?;
        }
        Ok(())
    }

    /// The term that a text is.
    fn term(&mut self, name: &str, text: &str) -> Result<(FileId, Term), Vec<Diagnostic>> {
        let file = self.add(SourceFile::new(name, text));
        let parsed = syntax::parse_term(file, text);
        if has_errors(&parsed.diagnostics) {
            return Err(parsed.diagnostics);
        }
        match TermFile::cast(parsed.syntax()).and_then(|file| file.term()) {
            Some(term) => Ok((file, term)),
            None => Err(vec![fault::no_term(file)]),
        }
    }
}
