//! Plays a script move by move: groups one after the other, each with its sets, checks and step.
//!
//! INVARIANT: within a group the strict checks come first (they see the inputs of the step just made), then all sets,
//! then checks and execs in the order of the text, then the step. After a failed check the others of its group are
//! made, then the play ends; any other failure ends it at once. The sets before the first step are part of the first
//! move, which sets the initial state.

use std::collections::BTreeMap;
use std::sync::Arc;

use machine::{Location, Machine, Snapshot, Value};
use program::Program;
use syntax::Span;

use crate::environment::{Choices, Picked};
use crate::script::{Action, Group, Script, StepKind};
use crate::stage::{Going, Moved, Options, Stage, Stopped};
use crate::verdict::{Failure, Judgement, Remark, Verdict};

/// Where in the script a play stands: what comes next.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
struct Cursor {
    group: usize,
    part: Part,
}

#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Part {
    /// The initial state.
    Start,
    /// The strict check that this action is.
    Strict(usize),
    /// This set.
    Set(usize),
    /// This action, unless it was a strict check.
    Action(usize),
    /// This pick.
    Pick(usize),
    /// The step that ends the group; so many were made.
    Step(u64),
    /// Nothing.
    Over,
}

/// A script that is being played.
#[derive(Debug)]
pub struct Play<'a> {
    stage: Stage<'a>,
    script: &'a Script,
    bound: u64,
    cursor: Cursor,
    /// A rule was executed in this group.
    executed: bool,
}

/// A moment of a play, to go back to.
#[derive(Debug, Clone)]
pub struct Saved {
    snapshot: Snapshot,
    inputs: BTreeMap<Location, Value>,
    picks: Vec<Picked>,
    seconds: i64,
    cursor: Cursor,
    executed: bool,
    picked: Vec<Picked>,
    moved: Moved,
    steps: u64,
    checks: (u64, u64),
    failures: Vec<Failure>,
    remarks: Vec<Remark>,
}

impl<'a> Play<'a> {
    /// A play that has not begun.
    pub fn new(script: &'a Script, program: Arc<Program>, options: Options, choices: &'a mut dyn Choices) -> Play<'a> {
        Play {
            stage: Stage::new(script, program, &options, choices),
            script,
            bound: options.bound,
            cursor: Cursor { group: 0, part: Part::Start },
            executed: false,
        }
    }

    /// Keeps what each move does: see [`Play::moved`].
    pub fn keep_moves(&mut self) {
        self.stage.keeps = true;
        self.stage.environment.made = Some(Vec::new());
    }

    /// Makes the next move; false if there is none.
    pub fn advance(&mut self) -> bool {
        if self.cursor.part == Part::Over {
            return false;
        }
        self.stage.moved = Moved::default();
        let going = self.perform();
        if going.and_then(|()| self.settle()).is_err() {
            self.cursor.part = Part::Over;
        }
        true
    }

    /// The command that comes next; before the first move the scenario's name; none at the end.
    pub fn next_place(&self) -> Option<Span> {
        let script = self.script;
        let group = script.groups.get(self.cursor.group)?;
        Some(match self.cursor.part {
            Part::Start => script.span,
            Part::Strict(at) | Part::Action(at) => group.parts.actions[at].span(),
            Part::Set(at) => group.parts.sets[at].span,
            Part::Pick(at) => group.parts.picks[at].span,
            Part::Step(_) => self.span_of(group),
            Part::Over => return None,
        })
    }

    /// The machine in its present state.
    pub fn machine(&self) -> &Machine {
        &self.stage.machine
    }

    /// How many steps have been made.
    pub fn steps(&self) -> u64 {
        self.stage.steps
    }

    /// Checks that held, and checks that did not.
    pub fn checks(&self) -> (u64, u64) {
        self.stage.checks
    }

    /// What went wrong up to now.
    pub fn failures(&self) -> &[Failure] {
        &self.stage.failures
    }

    /// The inputs that are set.
    pub fn inputs(&self) -> &BTreeMap<Location, Value> {
        &self.stage.environment.inputs
    }

    /// What the last move did.
    pub fn moved(&self) -> &Moved {
        &self.stage.moved
    }

    /// The present moment.
    pub fn save(&self) -> Saved {
        Saved {
            snapshot: self.stage.machine.snapshot(),
            inputs: self.stage.environment.inputs.clone(),
            picks: self.stage.environment.picks.clone(),
            seconds: self.stage.environment.seconds,
            cursor: self.cursor,
            executed: self.executed,
            picked: self.stage.picked.clone(),
            moved: self.stage.moved.clone(),
            steps: self.stage.steps,
            checks: self.stage.checks,
            failures: self.stage.failures.clone(),
            remarks: self.stage.remarks.clone(),
        }
    }

    /// Goes back to a moment of this play. Who makes the choices must go back, too; the story does not.
    pub fn restore(&mut self, saved: &Saved) {
        self.stage.machine.restore(&saved.snapshot);
        self.stage.environment.inputs.clone_from(&saved.inputs);
        self.stage.environment.picks.clone_from(&saved.picks);
        self.stage.environment.seconds = saved.seconds;
        (self.cursor, self.executed) = (saved.cursor, saved.executed);
        self.stage.picked.clone_from(&saved.picked);
        self.stage.moved = saved.moved.clone();
        (self.stage.steps, self.stage.checks) = (saved.steps, saved.checks);
        self.stage.failures.clone_from(&saved.failures);
        self.stage.remarks.clone_from(&saved.remarks);
    }

    /// The verdict of a play that is over.
    pub(crate) fn verdict(self, judge: &dyn Fn(u64, Vec<Failure>) -> Judgement) -> Verdict {
        let Stage { script, steps, checks, failures, remarks, story, .. } = self.stage;
        Verdict { name: script.name.clone(), judgement: judge(steps, failures), steps, checks, remarks, story }
    }

    /// Makes the move that the cursor is at, and advances the cursor.
    fn perform(&mut self) -> Going {
        let script = self.script;
        let Cursor { group: index, part } = self.cursor;
        let Some(group) = script.groups.get(index) else { return Err(Stopped) };
        let (parts, first) = (&group.parts, index == 0);
        match part {
            Part::Start => {
                self.stage.start()?;
                if let Some(story) = &mut self.stage.story {
                    story.begin(&self.stage.machine);
                }
                self.stage.invariants(false, script.span)?;
                self.cursor.part = Part::Strict(0);
            }
            Part::Strict(at) => {
                if let Action::Check { formula, span, .. } = &parts.actions[at] {
                    self.stage.check(formula, *span)?;
                }
                self.cursor.part = Part::Strict(at + 1);
            }
            Part::Set(at) => {
                self.stage.sets(&parts.sets[at..=at])?;
                self.cursor.part = Part::Set(at + 1);
            }
            Part::Action(at) => {
                match &parts.actions[at] {
                    Action::Check { strict, formula, span } if first || !strict => self.stage.check(formula, *span)?,
                    Action::Check { .. } => {}
                    Action::Exec { procedure, span } => {
                        self.stage.exec(*procedure, *span)?;
                        self.executed = true;
                    }
                }
                self.cursor.part = Part::Action(at + 1);
            }
            Part::Pick(at) => {
                self.stage.pick(&parts.picks[at])?;
                self.cursor.part = Part::Pick(at + 1);
            }
            Part::Step(made) => {
                if made == 0 {
                    self.stage.environment.picks = std::mem::take(&mut self.stage.picked);
                }
                self.step_of(&group.step, made)?;
            }
            Part::Over => {}
        }
        Ok(())
    }

    /// One of the steps that end a group.
    fn step_of(&mut self, step: &StepKind, made: u64) -> Going {
        let more = match step {
            StepKind::Steps { count, span } => {
                if made > 0 {
                    self.stage.machine.forget_inputs();
                }
                self.stage.step(*span)?;
                made + 1 < *count
            }
            StepKind::Until { condition, bound, span } => {
                let bound = bound.unwrap_or(self.bound);
                // Whether it holds after a step is asked at the end of that step's move.
                if made > 0 || !self.stage.is_reached(condition, bound == 0, bound, *span)? {
                    self.stage.step(*span)?;
                    self.stage.machine.forget_inputs();
                    !self.stage.is_reached(condition, made + 1 == bound, bound, *span)?
                } else {
                    false
                }
            }
            StepKind::Trouble { expected, span } => {
                self.stage.trouble(*expected, *span)?;
                false
            }
            StepKind::End => false,
        };
        match more {
            true => self.cursor.part = Part::Step(made + 1),
            false => self.next_group(),
        }
        Ok(())
    }

    fn next_group(&mut self) {
        self.stage.report_unused_picks();
        self.executed = false;
        self.cursor = Cursor { group: self.cursor.group + 1, part: Part::Strict(0) };
    }

    /// Goes on to the next move, past what is no move by itself.
    fn settle(&mut self) -> Going {
        let script = self.script;
        loop {
            let Some(group) = script.groups.get(self.cursor.group) else { return Err(Stopped) };
            let (parts, first) = (&group.parts, self.cursor.group == 0);
            self.cursor.part = match self.cursor.part {
                Part::Strict(at) if at < parts.actions.len() => {
                    if !first && matches!(parts.actions[at], Action::Check { strict: true, .. }) {
                        return Ok(());
                    }
                    Part::Strict(at + 1)
                }
                Part::Strict(_) if first => Part::Action(0),
                Part::Strict(_) => {
                    // The clock has gone on.
                    self.stage.machine.forget_inputs();
                    Part::Set(0)
                }
                Part::Set(at) if at < parts.sets.len() => return Ok(()),
                Part::Set(_) => Part::Action(0),
                Part::Action(at) if at < parts.actions.len() => {
                    if first || !matches!(parts.actions[at], Action::Check { strict: true, .. }) {
                        return Ok(());
                    }
                    Part::Action(at + 1)
                }
                Part::Action(_) if !self.stage.failures.is_empty() => return Err(Stopped),
                Part::Action(_) => Part::Pick(0),
                Part::Pick(at) if at < parts.picks.len() => return Ok(()),
                Part::Pick(_) => match &group.step {
                    StepKind::End => return self.finish(group),
                    StepKind::Steps { count: 0, .. } => {
                        self.stage.environment.picks = std::mem::take(&mut self.stage.picked);
                        self.next_group();
                        continue;
                    }
                    _ => Part::Step(0),
                },
                Part::Start | Part::Step(_) | Part::Over => return Ok(()),
            };
        }
    }

    /// The scenario's end.
    fn finish(&mut self, group: &Group) -> Going {
        let span = self.span_of(group);
        self.stage.environment.picks = std::mem::take(&mut self.stage.picked);
        if self.executed {
            self.stage.invariants(false, span)?;
        }
        self.stage.invariants(true, span)?;
        self.stage.report_unused_picks();
        Err(Stopped)
    }

    /// Where a broken invariant is noticed: the step, or at the end the last command.
    fn span_of(&self, group: &Group) -> Span {
        match &group.step {
            StepKind::Steps { span, .. } | StepKind::Until { span, .. } | StepKind::Trouble { span, .. } => *span,
            StepKind::End => {
                let last = group.parts.actions.last().map(|action| match action {
                    Action::Check { span, .. } | Action::Exec { span, .. } => *span,
                });
                last.or(group.parts.sets.last().map(|set| set.span)).unwrap_or(self.script.span)
            }
        }
    }
}
