//! Steps and starts told: what was found is made once more, and all there is to say of it is noted.

use std::ops::ControlFlow;

use machine::{EngineChoice, Fault, Interrupt, Machine};

use crate::alternatives::branches::Branches;
use crate::alternatives::told::Told;
use crate::explorer::Explorer;
use crate::explorer::paths::Reading;
use crate::starts::{Start, each_start};

impl Explorer {
    /// Tells of the step that these answers lead to.
    pub fn tell(&mut self, state: &[u64], picks: &[u32]) -> Told {
        self.tell_read(state, picks, &mut |_| Ok(()))
    }

    /// The same where more is read in the step than it does itself.
    pub fn tell_read(
        &mut self,
        state: &[u64],
        picks: &[u32],
        read: &mut dyn FnMut(&mut Reading<'_>) -> Result<(), Fault>,
    ) -> Told {
        self.load(state);
        self.branches.follow(picks);
        let mut told = Told::default();
        let prepared = self.machine.prepare(&mut self.branches);
        // Conditions may ask for more inputs; of a step that has a fault only assumptions are evaluated.
        for check in self.settings.checks_of_steps() {
            if check.assumed || prepared.is_ok() {
                let _ = self.machine.evaluate(check.formula, &mut self.branches);
            }
        }
        if prepared.is_ok() {
            let Explorer { machine, branches, .. } = self;
            let _ = read(&mut Reading { machine, branches });
        }
        told.inputs = self.machine.inputs();
        match prepared {
            Ok(()) => {
                self.machine.commit();
                told.changes = self.machine.changes();
            }
            Err(fault) => told.fault = Some(Box::new(fault)),
        }
        told.choices = std::mem::take(&mut self.branches.chosen);
        self.is_loaded = false;
        told
    }

    /// What an initial state took from outside.
    pub fn told_of_start(&self, start: Start) -> Told {
        let mut machine = Machine::new(self.program.clone(), self.settings.limits.clone());
        machine.use_engine(EngineChoice::Interpreted);
        machine.ignore_interrupts();
        machine.explore();
        let blank = machine.snapshot();
        let mut branches = Branches::new(self.settings.bounds.clone());
        let (answers, mut left) = self.starts.way_to(start);
        branches.follow(answers);
        // The starts were made before without a fault.
        let _ = each_start(&mut machine, &blank, &mut branches, &Interrupt::default(), &mut |_, _| {
            left = left.wrapping_sub(1);
            Ok(if left == usize::MAX { ControlFlow::Break(()) } else { ControlFlow::Continue(()) })
        });
        // A start that goes on from another one tells only of what it asks for itself.
        let answers: Vec<u32> = branches.answers().iter().map(|asked| asked.taken).collect();
        branches.follow(&answers);
        let _ = machine.start_from(&blank, &mut branches);
        Told { inputs: machine.inputs(), choices: std::mem::take(&mut branches.chosen), ..Told::default() }
    }
}
