//! The inputs that initial states keep, given to the machine with the state.
//!
//! In: a packed state. Out: a machine whose next step need not ask for them. INVARIANT: an initial state whose inputs an
//! assumption rules out is left out: no run has it.

use std::sync::Arc;

use machine::Value;

use crate::explorer::Explorer;
use crate::packed::kept::is_input;
use crate::packed::words::{Bits, Field};

impl Explorer {
    /// Gives the machine the inputs that a packed state keeps.
    pub(super) fn keep_inputs(&mut self, state: &[u64]) {
        if self.encoding.kept.is_empty() {
            return;
        }
        let Explorer { machine, encoding, view, program, .. } = self;
        for index in &encoding.kept.fields {
            let field = encoding.fields[*index as usize];
            let value = encoding.value(field, state, view);
            if !value.is_undef() {
                machine.give(field.location, field.function, value);
            }
        }
        let Some(field) = encoding.rest.filter(|_| !encoding.kept.in_rest.is_empty()) else { return };
        for (location, value) in &view.rest(encoding.fields[field as usize].code(state) as u32).locations {
            if is_input(program, location) {
                let index = machine.store_mut().number(location.function, &location.arguments);
                machine.give(index, location.function, value.clone());
            }
        }
    }

    /// Leaves out initial states whose inputs an assumption rules out: no run has them.
    pub(super) fn leave_out_starts(&mut self) {
        // Starts that were taken over from another explorer were left out there.
        if self.encoding.kept.is_empty() || Arc::get_mut(&mut self.starts).is_none() {
            return;
        }
        let all = Arc::clone(&self.starts);
        let admitted: Vec<bool> = all.iter().map(|(state, _)| self.admits_inputs(state)).collect();
        drop(all);
        if let Some(starts) = Arc::get_mut(&mut self.starts) {
            starts.retain(&admitted);
        }
    }

    /// Whether no assumption rules out the inputs that a state keeps; one that asks for others is not decided by these.
    fn admits_inputs(&mut self, state: &[u64]) -> bool {
        for index in 0..self.settings.step_conditions.len() {
            let (formula, assumed) = self.settings.step_conditions[index].clone();
            if !assumed {
                continue;
            }
            self.branches.first();
            self.load(state);
            let truth = self.machine.evaluate(&formula, &mut self.branches);
            if self.branches.answers().is_empty() && truth.is_ok_and(|truth| truth != Value::Boolean(true)) {
                return false;
            }
        }
        true
    }

    /// Which of these fields hold an input that initial states keep.
    pub fn are_inputs(&self, fields: &[Bits]) -> Vec<bool> {
        let kept: Vec<Field> =
            self.encoding.kept.fields.iter().map(|index| self.encoding.fields[*index as usize]).collect();
        let is_kept = |bits: &Bits| kept.iter().any(|field| (field.word, field.shift) == (bits.word, bits.shift));
        fields.iter().map(is_kept).collect()
    }

    /// Whether a packed state is an initial one that keeps an input.
    pub fn keeps_inputs(&mut self, state: &[u64]) -> bool {
        let Explorer { encoding, view, program, .. } = self;
        let in_fields = encoding.kept.fields.iter().any(|index| {
            let field = encoding.fields[*index as usize];
            !encoding.value(field, state, view).is_undef()
        });
        let Some(field) = encoding.rest.filter(|_| !encoding.kept.in_rest.is_empty()) else { return in_fields };
        let rest = view.rest(encoding.fields[field as usize].code(state) as u32);
        in_fields || rest.locations.iter().any(|(location, _)| is_input(program, location))
    }
}
