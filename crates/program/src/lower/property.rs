//! Properties and assumptions: formulas over one state, or over runs.

use crate::ir::Property;
use crate::lower::Lowering;

impl Lowering<'_, '_> {
    /// Adds all properties, in order.
    pub(super) fn lower_properties(&mut self) {
        let model = self.model;
        for property in &model.properties {
            let formula = self.lower_expression(&property.variables, &[], &property.formula);
            let conclusion =
                property.conclusion.as_ref().map(|term| self.lower_expression(&property.variables, &[], term));
            let formulas = [Some(&formula), conclusion.as_ref()];
            let reads_monitored = formulas.into_iter().flatten().any(|formula| self.program.reads_monitored(formula));
            self.program.properties.push(Property {
                kind: property.kind,
                name: property.name.clone(),
                formula,
                conclusion,
                reads_monitored,
                span: property.span,
            });
        }
    }
}
