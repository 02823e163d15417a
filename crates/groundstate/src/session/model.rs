//! The thread that runs a model for a session.
//!
//! In: commands, at the desk. Out: a moment after each step, and questions. The machine is watched, so every step is interpreted.
//! INVARIANT: when the desk says that the run waits, the moment is there.

use std::cell::RefCell;
use std::collections::VecDeque;
use std::rc::Rc;
use std::sync::Arc;

use machine::{Interrupt, Limits, Location, Snapshot, Value};
use program::Program;
use simulate::{Bounds, Choices, End, Inputs, Invariants, Named, Options, RandomSource, Record, Run, StepRecord};

use crate::diagnose_record;
use crate::job::desk::{Asking, Desk, Do, Given, Turn};
use crate::session::SessionOptions;
use crate::session::breaks::Happened;
use crate::session::evaluate::Player;
use crate::session::moment::{Moment, Ran};
use crate::session::scene::Scene;
use crate::session::shared::Shared;
use crate::session::tape::Recorder;

/// Runs the model until it is stopped.
pub(crate) fn run(
    scene: &Scene,
    options: &SessionOptions,
    desk: &Rc<RefCell<Desk>>,
    interrupt: Interrupt,
    shared: &Shared,
) {
    desk.borrow_mut().begin_session(&options.given);
    let inputs = Inputs::new().with(Given(Rc::clone(desk)));
    let inputs = match &options.recorded {
        Some(recorded) => inputs.with(Named::clone(recorded)),
        None => inputs,
    };
    let inputs = match options.seed {
        Some(seed) => inputs.with(RandomSource::new(seed, Bounds::default())).choosing(Choices::random(seed)),
        None => inputs.with(Asking::at(desk)).choosing(Choices::asked(Asking::at(desk))),
    };
    let limits = Limits { interrupt, ..options.limits.clone() };
    let invariants = if options.passes_violations { Invariants::Report } else { Invariants::Stop };
    let run_options = Options { steps: None, history: options.history, invariants, ..Options::default() };
    let mut run = Run::new(Arc::clone(&scene.program), limits, inputs, run_options);
    run.machine_mut().enable_coverage();
    let player = Player::new(options.limits.clone());
    let first = Arc::new(run.machine().snapshot());
    let (ran, past) = (Ran::default(), VecDeque::new());
    let recorder = options.watched.as_ref();
    let recorder = recorder.map(|watched| Recorder::new(watched, &scene.program, Player::new(options.limits.clone())));
    let (history, initial, said) = (options.history, Vec::new(), Vec::new());
    let program = Arc::clone(&scene.program);
    let mut thread = Thread { shared, history, ran, past, first, initial, player, recorder, program, said };
    let mut initial = true;
    loop {
        // The initial state is made before the first pause.
        let what = if std::mem::take(&mut initial) { Do::Step } else { desk.borrow_mut().next() };
        let record = match what {
            Do::Step => run.advance(),
            Do::Back => {
                let back = run.take_back();
                if back.is_none() {
                    desk.borrow_mut().is_at_the_beginning();
                    continue;
                }
                thread.past.pop_back();
                back
            }
            Do::Stop => return,
        };
        let Some(record) = record else {
            desk.borrow_mut().refuse("the run has ended");
            continue;
        };
        if let Record::End(End::Quit | End::Interrupted) = record {
            return;
        }
        let stops = thread.take_in(record, &mut run);
        let mut desk = desk.borrow_mut();
        thread.said.drain(..).for_each(|(id, text)| desk.say(id, text));
        if stops {
            desk.turn = Turn::Steps(0);
        }
    }
}

struct Thread<'a> {
    shared: &'a Shared,
    /// How many steps can be taken back.
    history: usize,
    ran: Ran,
    /// The moments of the steps that can be taken back, the present one last.
    past: VecDeque<Moment>,
    /// Stands for the states of past moments, which the run keeps.
    first: Arc<Snapshot>,
    initial: Vec<(Location, Value)>,
    player: Player,
    recorder: Option<Recorder>,
    program: Arc<Program>,
    /// What breaks have said.
    said: Vec<(u64, String)>,
}

impl Thread<'_> {
    /// Takes in what happened. Out: whether the run is to wait.
    fn take_in(&mut self, record: Record, run: &mut Run) -> bool {
        let mut faults = diagnose_record(&record, run);
        let mut violated = false;
        let (mut moment, stops) = match record {
            Record::Initial { inputs, choices, violations, .. } => {
                violated = !violations.is_empty();
                self.initial.clone_from(&inputs);
                let mut moment = Moment::new(run.machine().snapshot());
                moment.inputs = inputs;
                moment.choices = choices.into_iter().map(|choice| (choice.span, choice.values)).collect();
                self.ran.since(run.machine().coverage());
                (moment, false)
            }
            Record::Step(step) => {
                violated = !step.violations.is_empty();
                (self.made(step, run), false)
            }
            Record::Attempt(step) => {
                violated = !step.violations.is_empty();
                let mut moment = self.made(step, run);
                moment.idle.clear();
                // Why it was not made comes next.
                if let Some(end) = run.advance() {
                    faults.extend(diagnose_record(&end, run));
                    moment.end = word(&end);
                }
                (moment, true)
            }
            Record::Back { .. } => {
                let former = self.past.back().cloned();
                let mut moment = former.unwrap_or_else(|| Moment::new(run.machine().snapshot()));
                (moment.step, moment.snapshot) = (run.steps(), Arc::new(run.machine().snapshot()));
                self.ran.since(run.machine().coverage());
                self.judge(&mut moment, false, false);
                let stops = moment.hit.is_some();
                self.show(moment);
                return stops;
            }
            Record::End(_) => {
                let mut moment = self.past.back().cloned().unwrap_or_else(|| Moment::new(run.machine().snapshot()));
                moment.snapshot = Arc::new(run.machine().snapshot());
                moment.end = word(&record);
                (moment, true)
            }
        };
        moment.step = run.steps();
        moment.reached = self.past.back().map(|former| former.reached.clone()).unwrap_or_default();
        let is_attempt = moment.end.is_some();
        moment.faults.extend(faults);
        self.judge(&mut moment, violated, true);
        let stops = stops || moment.hit.is_some();
        if !is_attempt {
            if self.past.len() > self.history {
                self.past.pop_front();
            }
            let mut kept = moment.clone();
            (kept.hit, kept.snapshot) = (None, Arc::clone(&self.first));
            self.past.push_back(kept);
        }
        self.show(moment);
        stops
    }

    /// From now on this is the present moment.
    fn show(&mut self, moment: Moment) {
        // What could not be made is no step of a scenario.
        if moment.end.is_none() {
            self.shared.notes.note(&self.program, &moment);
        }
        if let Some(recorder) = &mut self.recorder {
            recorder.note(&self.shared.tape, &moment, &self.initial);
        }
        self.shared.set_moment(moment);
    }

    fn made(&mut self, step: StepRecord, run: &Run) -> Moment {
        let mut moment = Moment::new(run.machine().snapshot());
        moment.changes = step.changes;
        moment.inputs = step.inputs;
        moment.choices = step.choices.into_iter().map(|choice| (choice.span, choice.values)).collect();
        let ran = self.ran.since(run.machine().coverage());
        moment.note_ran(run.machine().program(), ran);
        moment
    }

    /// What stops the run here, and what is said.
    fn judge(&mut self, moment: &mut Moment, violated: bool, forth: bool) {
        let breaks = self.shared.breaks();
        let program = breaks.program.clone();
        let mut reached = std::mem::take(&mut moment.reached);
        let happened = Happened {
            ran: &moment.ran,
            changes: &moment.changes,
            next: None,
            faults: !moment.faults.is_empty() && !violated,
            violations: violated,
            forth,
        };
        let (player, initial) = (&mut self.player, &self.initial);
        let judged = breaks.judge(happened, &mut reached, &mut |term| {
            let program = program.as_ref().ok_or_else(String::new)?;
            player.value(program, term, moment, initial)
        });
        (moment.hit, moment.reached) = (judged.hit, reached);
        self.said.extend(judged.said);
    }
}

fn word(record: &Record) -> Option<&'static str> {
    match record {
        Record::End(end) => Some(end.word()),
        Record::Initial { .. } | Record::Step(_) | Record::Attempt(_) | Record::Back { .. } => None,
    }
}
