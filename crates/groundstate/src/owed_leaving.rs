//! Whether the machine in the place of a shape that was to be refined can always be left, and which answers it gives.
//!
//! In: the model with the block, what the file beside the chart assumes, options. Out: a [`Leaving`]. A proof of refinement that takes
//! waiting to end says nothing of a machine whose waiting cannot end, whatever the environment does: that is looked for here.
//! INVARIANT: what is told is so in all states that can be reached under the assumptions; what was not looked at is not told.

use std::sync::Arc;

use chart::Block;
use model::{Loader, PropertyKind};
use program::Property;
use syntax::SourceFile;
use verify::{Options, Outcome, Progress, Subject};

use crate::tell::Verdicts;
use crate::{Loaded, assume, with_libraries};

/// What is known of leaving a block.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct Leaving {
    /// A run to a state of the block from which it is never left, in lines.
    pub stuck: Option<String>,
    /// The answers that it never gives.
    pub never: Vec<bool>,
}

/// Looks at all states of a model. `beside` is the file beside the chart.
pub fn leaving(
    loaded: &Loaded,
    block: &Block,
    beside: Option<&SourceFile>,
    options: Options,
    loader: &mut dyn Loader,
    watch: &mut dyn FnMut(&Progress) -> bool,
) -> Leaving {
    let mut found = Leaving::default();
    let with = with_libraries(loaded, &["CTLLibrary"], loader);
    let Ok(assumed) = assume(with.as_ref().unwrap_or(loaded), beside, &[]) else { return found };
    let mut asked = assumed.model.overlay();
    let given = asked.program.properties.len();
    let Block { at, left, answer } = block;
    let mut questions = vec![(PropertyKind::Ctl, format!("ag({at} implies ef({left}))"))];
    for word in answer.iter().flat_map(|answer| [answer.clone(), format!("not {answer}")]) {
        questions.push((PropertyKind::Invariant, format!("not (if {at} and {left} then {word} else false endif)")));
    }
    if !questions.iter().all(|(kind, text)| asked.property(*kind, "<block>", text).is_ok()) {
        return found;
    }
    let claimed =
        |property: &Property| matches!(property.kind, PropertyKind::Invariant | PropertyKind::Ctl | PropertyKind::Ltl);
    let program = Arc::make_mut(&mut asked.program);
    let mut index = 0;
    program.properties.retain(|property| {
        index += 1;
        index > given || !claimed(property)
    });
    let first = program.properties.len() - questions.len();
    let options = Options { bounds: assumed.bounds, undefined: assumed.undefined, ..options };
    let Ok(report) = verify::verify(&asked.program, &options, watch) else { return found };
    let words = Verdicts::new(&asked.program, &asked.sources, false);
    for verdict in &report.verdicts {
        let Subject::Property(place) = verdict.subject else { continue };
        match (place.checked_sub(first), &verdict.outcome) {
            (Some(0), Outcome::Violated(trace)) => {
                let told = words.violation(verdict.subject, trace);
                found.stuck = Some(told.lines().skip(1).collect::<Vec<_>>().join("\n"));
            }
            (Some(answer @ 1..), Outcome::Holds) => found.never.push(answer == 1),
            _ => {}
        }
    }
    found
}
