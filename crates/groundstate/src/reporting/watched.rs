//! What a session watches for its timeline: a report specification whose terms were added to the session's program.
//!
//! In: an [`Overlay`], and the specification. Out: the lanes and the lowered terms. Pictures of charts are left out: who shows a session
//! has them already.

use std::sync::Arc;

use program::Expression;
use report::{ReportBuilder, Spec, read_specification};
use syntax::{Diagnostic, SourceFile};

use crate::Overlay;
use crate::reporting::watch::Watch;

/// See the module.
#[derive(Debug, Clone)]
pub struct Watched {
    /// The lanes.
    pub(crate) spec: Spec,
    /// The terms, in the order of [`ReportBuilder::terms`].
    pub(crate) terms: Vec<Expression>,
}

impl Watched {
    /// Adds the terms of a specification.
    ///
    /// # Errors
    /// The faults of the specification.
    pub fn new(asked: &mut Overlay, specification: SourceFile) -> Result<Watched, Vec<Diagnostic>> {
        let text = Arc::clone(&specification.text);
        let file = asked.add(specification);
        let wanted = read_specification(file, &text)?;
        let builder = ReportBuilder::new(wanted.spec.clone());
        let watch = Watch::new(asked, builder.terms(), &wanted.places)?;
        Ok(Watched { spec: wanted.spec, terms: watch.into_terms() })
    }
}
