//! Decides whether an extracted machine can be kept: its written chart has no faults and does what the rule does.
//!
//! In: a machine, and the rule and location that it was made from. Out: the reason if it cannot be kept. Its text is
//! read back and built, and both rules are executed symbolically, as in `chart check`; so an extracted chart always
//! passes that check. No file is needed: the built rule is checked as a fragment of the model.

use model::{FunctionId, Model, Rule, RuleId, RuleKind};
use syntax::ast::{self, AstNode};
use syntax::{FileId, Severity};

use super::origins;
use crate::begin::{self, Otherwise};
use crate::build::machine_rule;
use crate::chart::{Chart, Machine};
use crate::differ::same;
use crate::symbolic::{Depth, Explorer, Guarded, Reason};

/// Judges the machines of one model.
pub(super) struct Judge<'m> {
    model: &'m Model,
    /// The model with the rule of a chart added.
    probed: Model,
}

impl<'m> Judge<'m> {
    pub(super) fn new(model: &'m Model) -> Judge<'m> {
        Judge { model, probed: model.clone() }
    }

    /// Why the machine of a rule over a location cannot be kept.
    pub(super) fn refusal(
        &mut self,
        machine: &Machine,
        rule: RuleId,
        function: FunctionId,
        location: &str,
    ) -> Option<String> {
        let chart = Chart { name: "Extracted".to_string(), machines: vec![machine.clone()], ..Chart::default() };
        let text = crate::write::write(&chart);
        let (back, faults) = crate::read::read(FileId(u32::MAX), &syntax::parse_chart(FileId(u32::MAX), &text));
        if let Some(fault) = faults.iter().find(|fault| fault.severity == Severity::Error) {
            return Some(format!("its chart would have a fault: {}", fault.message));
        }
        let [drawn] = &back.machines[..] else {
            return Some("its chart, as it is written, does not hold it alone".to_string());
        };
        let Some(probe) = self.probe(&back, drawn) else {
            return Some("what it says cannot be written in a chart".to_string());
        };
        // Of a rule that nothing runs, and of a first state that is computed, `chart check` warns.
        if let Some(Otherwise::In { drawn, written, .. }) =
            begin::otherwise(&back, drawn, self.model, rule, Some(function))
        {
            return Some(format!("its chart would begin in {drawn}, and the model begins in {written}"));
        }
        let names: Vec<String> = machine.parameters.iter().map(|parameter| parameter.variable.clone()).collect();
        let origins = origins(self.model, function);
        if origins.is_empty() {
            return Some("there is no control state in which the two could be compared".to_string());
        }
        for origin in origins {
            let done = |model, rule| -> Result<Vec<Guarded>, Reason> {
                Explorer::new(model, function, location.to_string(), origin.clone(), Depth::Full).rule(rule, &names)
            };
            match (done(&self.probed, probe), done(self.model, rule)) {
                (Ok(drawn), Ok(written)) if same(&drawn, &written, location, &origin) => {}
                (Ok(_), Ok(_)) => return Some("its chart would not do the same".to_string()),
                (_, Err(reason)) | (Err(reason), _) => return Some(super::told(reason)),
            }
        }
        None
    }

    /// The rule that is built from a machine, as a rule of the model; `None` if it has faults there.
    fn probe(&mut self, chart: &Chart, machine: &Machine) -> Option<RuleId> {
        let built = machine_rule(chart, machine, "r_probe");
        let (_, body) = built.split_once("=\n")?;
        let binders: Vec<String> =
            machine.parameters.iter().map(|one| format!("{} in {}", one.variable, one.domain)).collect();
        let body = match &binders[..] {
            [] => body.to_string(),
            binders => format!("forall {} with true do {body}", binders.join(", ")),
        };
        let text = format!("module Probe\nsignature:\ndefinitions:\nrule r_probe =\n{body}\n");
        let file = FileId(u32::MAX);
        let parse = syntax::parse_asmetal(file, &text);
        let wrong = |fault: &syntax::Diagnostic| fault.severity == Severity::Error;
        if parse.diagnostics.iter().any(wrong) {
            return None;
        }
        let body = ast::SourceFile::cast(parse.syntax())?.definitions()?.rules().next()?.body()?;
        let fragment = self.probed.check_rule(file, &body);
        if fragment.diagnostics.iter().any(wrong) {
            return None;
        }
        let mut rule: Rule = fragment.into_rule();
        if !machine.parameters.is_empty() {
            let RuleKind::Forall { binders, body, .. } = rule.body.kind else { return None };
            rule.parameters = binders.iter().map(|binder| binder.variable).collect();
            rule.body = *body;
        }
        self.probed.rules.truncate(self.model.rules.len());
        self.probed.rules.push(rule);
        Some(RuleId(self.model.rules.len() as u32))
    }
}
