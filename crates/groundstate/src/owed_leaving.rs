//! Whether a machine that waits can always go on, and which answers the machine in the place of a guard gives.
//!
//! In: the models of a proof, what the file beside the chart assumes, options. Out: a [`Leaving`]. A proof of refinement that takes
//! waiting to end says nothing of a machine whose waiting cannot end, whatever the environment does: that is looked for here, in the
//! block and in each control state that the chart's model can always leave. A block with one exit is not left by the other answer. Where it is
//! never left at all, the chart's machine may only wait where the guard says so, too.
//! INVARIANT: what is told is so in all states that can be reached under the assumptions; what was not looked at is told to be so.

use std::sync::Arc;

use chart::{Block, Only};
use model::{Loader, PropertyKind};
use program::Property;
use syntax::SourceFile;
use verify::{Options, Outcome, Progress, Reason, Subject};

use crate::tell::Verdicts;
use crate::{Loaded, OwedProof, assume, with_libraries};

/// What is known of leaving a block and the states after it.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct Leaving {
    /// Where the machine stays for ever, whatever the environment does.
    pub stuck: Option<Stuck>,
    /// The answers that it never gives.
    pub never: Vec<bool>,
    /// The machine never comes to the block, so the proof is of nothing that it does.
    pub idle: bool,
    /// Something could not be decided, so it may be stuck all the same.
    pub open: bool,
    /// There is a block for each value of a parameter, and whether they can be left was not looked at.
    pub unasked: bool,
}

/// A place that is never left, though the chart's model leaves it.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Stuck {
    /// What it is.
    pub at: StuckAt,
    /// A run to a state in which it stays there, in lines.
    pub run: String,
}

/// What is never left.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum StuckAt {
    /// The block.
    Block,
    /// The block, while the guard has the answer for which there is an exit.
    Asked {
        /// What the guard asks.
        asked: String,
        /// That answer.
        branch: bool,
    },
    /// A control state of a machine.
    State {
        /// The machine.
        machine: String,
        /// Its value.
        value: String,
    },
}

/// Looks at all states of the models. `beside` is the file beside the chart. Only where `waits` is it asked whether machines can go on.
pub fn leaving(
    proof: &OwedProof,
    beside: Option<&SourceFile>,
    waits: bool,
    options: &Options,
    loader: &mut dyn Loader,
    watch: &mut dyn FnMut(&Progress) -> bool,
) -> Leaving {
    let mut found = Leaving { unasked: proof.is_for_each, ..Leaving::default() };
    let mut asking = Asking { beside, options, loader, watch };
    let [given, concrete] = &proof.models;
    let mut questions = Vec::new();
    if let Some(Block { at, left, answer, only: _ }) = &proof.block {
        questions.push((PropertyKind::Ctl, format!("ag({at} implies ef({left}))")));
        for word in answer.iter().flat_map(|answer| [answer.clone(), format!("not {answer}")]) {
            questions.push((PropertyKind::Invariant, format!("not (if {at} and {left} then {word} else false endif)")));
        }
    }
    let of_block = questions.len();
    questions.extend(proof.block.iter().map(|block| (PropertyKind::Invariant, format!("not ({})", block.at))));
    let before_stands = questions.len();
    let stands = if waits { &proof.stands[..] } else { &[] };
    questions.extend(stands.iter().map(|stand| (PropertyKind::Ctl, stand.goes_on())));
    if questions.is_empty() {
        return found;
    }
    let answers = asking.ask(concrete, &questions);
    let mut doubtful = Vec::new();
    for (index, answer) in answers.into_iter().enumerate() {
        match (answer, index.checked_sub(before_stands)) {
            (Answer::Yes, None) if index >= of_block => found.idle = true,
            (Answer::No(run), None) if index == 0 => found.stuck = Some(Stuck { at: StuckAt::Block, run }),
            (Answer::Unknown, None) if index == 0 => found.open = true,
            (Answer::Yes, None) if index > 0 => found.never.push(index == 1),
            (Answer::No(run), Some(stand)) => doubtful.push((&stands[stand], run)),
            (Answer::Unknown, _) => found.open |= waits,
            (Answer::Yes | Answer::No(_), _) => {}
        }
    }
    if found.stuck.is_none()
        && let Some(block) = &proof.block
    {
        asking.exit(concrete, block, &mut found);
    }
    if found.stuck.is_some() || doubtful.is_empty() {
        return found;
    }
    // Where the chart's own model comes to rest, so may the other.
    let questions: Vec<_> = doubtful.iter().map(|(stand, _)| (PropertyKind::Ctl, stand.goes_on())).collect();
    for (answer, (stand, run)) in asking.ask(given, &questions).into_iter().zip(doubtful) {
        match answer {
            Answer::Yes if found.stuck.is_none() => {
                let (machine, value) = (stand.machine.clone(), stand.value.clone());
                found.stuck = Some(Stuck { at: StuckAt::State { machine, value }, run });
            }
            Answer::Yes | Answer::No(_) => {}
            Answer::Unknown => found.open = true,
        }
    }
    found
}

/// What a question came to.
enum Answer {
    Yes,
    /// With a run that shows it, in lines.
    No(String),
    Unknown,
}

/// Asks the search.
struct Asking<'a> {
    beside: Option<&'a SourceFile>,
    options: &'a Options,
    loader: &'a mut dyn Loader,
    watch: &'a mut dyn FnMut(&Progress) -> bool,
}

impl Asking<'_> {
    /// Looks whether a block with one exit can always be left over it. Where it cannot, the chart's machine waits for ever if the guard never
    /// has the answer that leads there, and cannot wait if the guard always has it.
    fn exit(&mut self, concrete: &Loaded, block: &Block, found: &mut Leaving) {
        let (Some(answer), Some(Only { branch, asked })) = (&block.answer, &block.only) else { return };
        let [is, negated] = if *branch { ["", "not "] } else { ["not ", ""] };
        let Block { at, left, .. } = block;
        // The answer is undef before the first one.
        let done = format!("(if {at} and {left} then {is}{answer} else false endif)");
        let questions = [
            format!("ag({at} implies ef({done}))"),
            format!("ag(ef(if {at} then {done} or {negated}({asked}) else true endif))"),
            format!("ag((if {at} then {is}({asked}) else false endif) implies ef({done}))"),
        ];
        let answers = self.ask(concrete, &questions.map(|question| (PropertyKind::Ctl, question)));
        match <[Answer; 3]>::try_from(answers) {
            Ok([Answer::Yes, _, _] | [Answer::No(_), Answer::Yes, Answer::Yes]) => {}
            Ok([_, Answer::No(run), _]) => {
                found.stuck = Some(Stuck { at: StuckAt::Asked { asked: asked.clone(), branch: *branch }, run });
            }
            Ok(_) | Err(_) => found.open = true,
        }
    }

    /// An answer to each question about a model.
    fn ask(&mut self, loaded: &Loaded, questions: &[(PropertyKind, String)]) -> Vec<Answer> {
        let mut answers: Vec<Answer> = questions.iter().map(|_| Answer::Unknown).collect();
        let with = with_libraries(loaded, &["CTLLibrary"], self.loader);
        let Ok(assumed) = assume(with.as_ref().unwrap_or(loaded), self.beside, &[]) else { return answers };
        let mut asked = assumed.model.overlay();
        let given = asked.program.properties.len();
        if !questions.iter().all(|(kind, text)| asked.property(*kind, "<block>", text).is_ok()) {
            return answers;
        }
        let claimed = |property: &Property| {
            matches!(property.kind, PropertyKind::Invariant | PropertyKind::Ctl | PropertyKind::Ltl)
        };
        let program = Arc::make_mut(&mut asked.program);
        let mut index = 0;
        program.properties.retain(|property| {
            index += 1;
            index > given || !claimed(property)
        });
        let first = program.properties.len() - questions.len();
        let options = Options { bounds: assumed.bounds, undefined: assumed.undefined, ..self.options.clone() };
        let Ok(report) = verify::verify(&asked.program, &options, self.watch) else { return answers };
        let words = Verdicts::new(&asked.program, &asked.sources, false);
        for verdict in &report.verdicts {
            let Subject::Property(place) = verdict.subject else { continue };
            let Some(answer) = place.checked_sub(first).and_then(|place| answers.get_mut(place)) else { continue };
            match &verdict.outcome {
                Outcome::Holds => *answer = Answer::Yes,
                Outcome::Violated(trace) => {
                    let told = words.violation(verdict.subject, trace);
                    *answer = Answer::No(told.lines().skip(1).collect::<Vec<_>>().join("\n"));
                }
                // That inputs have only these values is assumed of the whole proof, which says so.
                Outcome::Unknown(reasons) if reasons.iter().all(|reason| matches!(reason, Reason::Bounded(_))) => {
                    *answer = Answer::Yes;
                }
                Outcome::Unknown(_) => {}
            }
        }
        answers
    }
}
