//! The ends of elaborations at which components' machines make their steps, in the model that the events are held to.
//!
//! In: the model of a system whose components have machines, as `chart build` writes it. Out: the same model, in which an elaboration that
//! ends only tells so in a function of its own. What a machine decides rests on values that a recording gives apart, so `functions` replays
//! it; that the model lets it decide where its elaboration ends, and nowhere else, is held to each step here. All other rules of the model,
//! its main rule among them, stay as they are.

use machine::{Fault, Location, Machine, Value};
use model::{DomainId, Function, FunctionId, FunctionKind, Model, RuleKind, RuleNode, Target, Term, TermKind};
use recording::Kind;

use crate::evidence::Claim;
use crate::vocabulary::Vocabulary;

/// The rule in which machines make their steps, and what the names of the rules that it calls begin with:
/// crates/chart/src/build/system.rs and crates/chart/src/component/compose.rs name them.
pub(crate) const END: &str = "r_endOfElaboration";
pub(crate) const END_OF: &str = "r_end_";

/// The function that tells; no model can declare one of that name.
const TOLD: &str = "the elaboration ended";

/// What it says where no elaboration has ended; the clock is never so.
const NOT: Value = Value::Integer(-1);

/// The phases, elements of this domain, at whose end the model computes something.
pub(crate) fn phases(model: &Model, phase: DomainId) -> Vec<String> {
    let is_phase = |name: &&str| {
        let named = |function: &Function| function.name == **name && function.codomain == phase;
        model.functions.iter().any(|function| function.parameters.is_empty() && named(function))
    };
    let ends = model.rules.iter().filter(|rule| rule.parameters.is_empty());
    ends.filter_map(|rule| rule.name.strip_prefix(END_OF)).filter(is_phase).map(str::to_string).collect()
}

/// Whether the model has the rule in which machines make their steps.
pub(crate) fn has_rule(model: &Model) -> bool {
    model.rules.iter().any(|rule| rule.name == END && rule.parameters.len() == 1)
}

/// Lets ends of elaborations tell instead of compute, in a model of the library, whose clock and phases these are. Returns the function that
/// tells.
pub(crate) fn tell(model: &mut Model, clock: FunctionId, phase: DomainId) -> FunctionId {
    let Function { codomain: time, span, .. } = *model.function(clock);
    let told = FunctionId(model.functions.len() as u32);
    model.functions.push(Function {
        name: TOLD.to_string(),
        kind: FunctionKind::Controlled,
        parameters: vec![phase],
        codomain: time,
        definition: None,
        library: false,
        span,
    });
    if let Some(rule) = model.rules.iter_mut().find(|rule| rule.name == END && rule.parameters.len() == 1) {
        let span = rule.body.span;
        let argument = Term { kind: TermKind::Variable(rule.parameters[0]), domain: phase, span };
        let value = Term { kind: TermKind::Apply { function: clock, arguments: Vec::new() }, domain: time, span };
        let target = Target::Location { function: told, arguments: vec![argument], span };
        rule.body = RuleNode { kind: RuleKind::Update { target, value }, span };
    }
    told
}

/// The ends of a machine that makes the model's steps.
#[derive(Debug, Default)]
pub(crate) struct Ends {
    /// The function that tells; none if nothing is computed at the end of any elaboration.
    told: Option<FunctionId>,
    /// For each, the component, the phase's name and the location that tells.
    all: Vec<(usize, String, Location)>,
}

impl Ends {
    /// Those of these phases, told by this function, in a machine that has just started.
    ///
    /// # Errors
    /// The model does not let it be told.
    pub(crate) fn start(
        told: FunctionId,
        phases: &[String],
        machine: &mut Machine,
        vocabulary: &Vocabulary,
    ) -> Result<Ends, Fault> {
        let mut all = Vec::new();
        for component in 0..vocabulary.components.len() {
            for phase in phases {
                if let Some(value) = vocabulary.phase_named(machine, component, phase) {
                    let location = Location { function: told, arguments: vec![value] };
                    machine.set(&location, NOT)?;
                    all.push((component, phase.clone(), location));
                }
            }
        }
        Ok(Ends { told: Some(told), all })
    }

    /// After a step with these claims: the first component whose elaboration ends without a step of its machine, or the other way
    /// around; what of it is claimed, and why the two differ.
    ///
    /// # Errors
    /// The model does not let it be told.
    pub(crate) fn unlike(
        &self,
        machine: &mut Machine,
        claims: &[(usize, Claim)],
    ) -> Result<Option<(usize, Option<Claim>, String)>, Fault> {
        let mut unlike = None;
        let mut are_told = claims.iter().any(|(_, claim)| claim.event.kind == Kind::Ends);
        machine.each_changed_function(&mut |changed| are_told |= Some(changed) == self.told);
        if !are_told {
            return Ok(None);
        }
        for (component, phase, location) in &self.all {
            let tells = machine.value(location) != NOT;
            if tells {
                machine.set(location, NOT)?;
            }
            let ends = |(of, claim): &&(usize, Claim)| {
                of == component && claim.event.kind == Kind::Ends && *claim.event.object == **phase
            };
            let (claim, reason) = match (claims.iter().find(ends), tells) {
                (Some((_, claim)), false) => {
                    (Some(claim.clone()), format!("the model ends {phase} without what is computed at its end"))
                }
                (None, true) => (None, format!("the model computes what comes at the end of {phase} before it ends")),
                _ => continue,
            };
            unlike = unlike.or(Some((*component, claim, reason)));
        }
        Ok(unlike)
    }
}
