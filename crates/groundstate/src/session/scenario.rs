//! The thread that plays a scenario for a session, command by command.
//!
//! In: commands, at the desk. Out: a moment after each move. Choices that no `pick` makes are drawn from a seed, or are the first
//! candidate; a move that is taken back and made again makes the same.

use std::cell::RefCell;
use std::collections::VecDeque;
use std::rc::Rc;
use std::sync::Arc;

use machine::{Fault, FaultKind, Interrupt, Limits, Location, Value};
use scenario::{Choices, FailureKind, Judgement, Play, Saved, Script, judged};
use simulate::SplitMix;
use syntax::Diagnostic;

use crate::diagnose_failure;
use crate::job::desk::{Desk, Do, Turn};
use crate::session::SessionOptions;
use crate::session::breaks::Happened;
use crate::session::evaluate::Player;
use crate::session::moment::{Moment, Ran};
use crate::session::scene::Scene;
use crate::session::shared::Shared;
use crate::session::tape::Recorder;

/// Choices whose state can be kept.
#[derive(Debug, Clone)]
struct Kept(Rc<RefCell<Option<SplitMix>>>);

impl Choices for Kept {
    fn choose(&mut self, candidates: usize) -> usize {
        match &mut *self.0.borrow_mut() {
            Some(random) => random.below(candidates as u64) as usize,
            None => 0,
        }
    }
}

/// Plays the scenario until it is stopped.
pub(crate) fn run(
    scene: &Scene,
    script: &Script,
    options: &SessionOptions,
    desk: &Rc<RefCell<Desk>>,
    interrupt: Interrupt,
    shared: &Shared,
) {
    let random = Rc::new(RefCell::new(options.seed.map(SplitMix::new)));
    let mut choices = Kept(Rc::clone(&random));
    let limits = Limits { interrupt: interrupt.clone(), ..options.limits.clone() };
    let played = scenario::Options { limits, coverage: true, ..scenario::Options::default() };
    let mut play = Play::new(script, Arc::clone(&scene.program), played, &mut choices);
    play.keep_moves();
    let (mut ran, mut player) = (Ran::default(), Player::new(options.limits.clone()));
    let mut past: VecDeque<(Saved, Option<SplitMix>, Moment)> = VecDeque::new();
    let mut moment = Moment::new(play.machine().snapshot());
    moment.next = play.next_place();
    if options.begins {
        play.advance();
        if interrupt.cause().is_some() {
            return;
        }
        let unset = std::mem::replace(&mut moment, Moment::new(play.machine().snapshot()));
        take_in(&mut moment, &unset, &play, script, &mut ran);
    }
    let recorder = options.watched.as_ref();
    let mut recorder =
        recorder.map(|watched| Recorder::new(watched, &scene.program, Player::new(options.limits.clone())));
    // What the scenario gives before its first step is given for the initial state.
    let mut initial = Vec::new();
    let mut show = |moment: &Moment| {
        if moment.step == 0 {
            initial.clone_from(&moment.inputs);
        }
        if let (Some(recorder), false) = (&mut recorder, moment.next == Some(script.span)) {
            recorder.note(&shared.tape, moment, &initial);
        }
        shared.set_moment(moment.clone());
    };
    show(&moment);
    loop {
        let what = desk.borrow_mut().next();
        let forth = match what {
            Do::Step => {
                let before = (play.save(), random.borrow().clone(), moment.clone());
                if !play.advance() {
                    desk.borrow_mut().refuse("the scenario has ended");
                    continue;
                }
                if interrupt.cause().is_some() {
                    return;
                }
                if past.len() == options.history {
                    past.pop_front();
                }
                past.push_back(before);
                let former = std::mem::replace(&mut moment, Moment::new(play.machine().snapshot()));
                take_in(&mut moment, &former, &play, script, &mut ran);
                moment.reached = former.reached;
                true
            }
            Do::Back => {
                let Some((saved, choices, former)) = past.pop_back() else {
                    desk.borrow_mut().is_at_the_beginning();
                    continue;
                };
                play.restore(&saved);
                random.replace(choices);
                moment = former;
                ran.since(play.machine().coverage());
                false
            }
            Do::Stop => return,
        };
        let said = judge(&mut moment, shared, &mut player, forth);
        said.into_iter().for_each(|(id, text)| desk.borrow_mut().say(id, text));
        if moment.hit.is_some() || moment.end.is_some() {
            desk.borrow_mut().turn = Turn::Steps(0);
        }
        show(&moment);
    }
}

/// What the last move came to.
fn take_in(moment: &mut Moment, former: &Moment, play: &Play<'_>, script: &Script, ran: &mut Ran) {
    let program = play.machine().program();
    moment.step = play.steps();
    moment.checks = play.checks();
    moment.inputs = play.inputs().iter().map(|(of, value): (&Location, &Value)| (of.clone(), value.clone())).collect();
    moment.next = play.next_place();
    let now = ran.since(play.machine().coverage());
    let moved = play.moved();
    moment.ran_now = moved.ran;
    if moved.ran {
        moment.changes.clone_from(&moved.changes);
        moment.choices = moved.choices.iter().map(|made| (made.span, made.values.clone())).collect();
        moment.note_ran(program, now);
        if moved.failed {
            moment.idle.clear();
        }
    } else {
        // What the last step did is of interest until the next one.
        moment.changes.clone_from(&former.changes);
        moment.choices.clone_from(&former.choices);
        moment.idle.clone_from(&former.idle);
        moment.ran.clone_from(&former.ran);
    }
    let known = former.faults.len();
    let all: Vec<Diagnostic> = play.failures().iter().flat_map(|failure| diagnose_failure(failure, program)).collect();
    moment.faults = all;
    debug_assert!(moment.faults.len() >= known);
    if moment.next.is_none() {
        let judgement = judged(script, play);
        moment.end = Some(match &judgement {
            Judgement::Passed => "passed",
            Judgement::FailedAsExpected(_) => "failed-as-expected",
            Judgement::Failed(_) => "failed",
        });
        moment.faults = match &judgement {
            Judgement::Passed | Judgement::FailedAsExpected(_) => Vec::new(),
            Judgement::Failed(failures) => {
                failures.iter().flat_map(|failure| diagnose_failure(failure, program)).collect()
            }
        };
        let bounded = |fault: &Fault| matches!(fault.kind, FaultKind::Interrupted(_));
        let is_bound = |kind: &FailureKind| matches!(kind, FailureKind::Fault { fault, .. } if bounded(fault));
        if play.failures().iter().any(|failure| is_bound(&failure.kind)) {
            moment.end = Some("interrupted");
        }
    }
}

/// What stops the run here. Out: what is said.
fn judge(moment: &mut Moment, shared: &Shared, player: &mut Player, forth: bool) -> Vec<(u64, String)> {
    let breaks = shared.breaks();
    let program = breaks.program.clone();
    let violated = |fault: &&Diagnostic| fault.id == "invariant-violated";
    let violations = moment.faults.iter().filter(violated).count();
    let mut reached = std::mem::take(&mut moment.reached);
    let happened = Happened {
        ran: if moment.ran_now { &moment.ran } else { &[] },
        changes: if moment.ran_now { &moment.changes } else { &[] },
        next: moment.next,
        faults: moment.faults.len() > violations,
        violations: violations > 0,
        forth,
    };
    let judged = breaks.judge(happened, &mut reached, &mut |term| {
        let program = program.as_ref().ok_or_else(String::new)?;
        player.value(program, term, moment, &[])
    });
    (moment.hit, moment.reached) = (judged.hit, reached);
    judged.said
}
