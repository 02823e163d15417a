//! Finds which location each field of a packed state stores.
//!
//! In: an explorer. Out: for each field, the location whose value changes with it. This is found by experiment: a field
//! gets another code, and the values of the state are compared. LIMIT: fields that contain numbers of values are not
//! located.

use explore::{Bits, Explorer};
use machine::{Location, Value};

/// Fields with more bits contain numbers of values.
const LISTED: u8 = 16;

/// The location of each field.
pub(crate) fn located(explorer: &mut Explorer) -> Vec<Option<Location>> {
    let fields = explorer.fields();
    let Some(state) = explorer.initial().first().map(Box::<[u64]>::from) else {
        return vec![None; fields.len()];
    };
    let base = explorer.values_and_inputs(&state);
    fields.iter().map(|field| locate(explorer, *field, &state, &base)).collect()
}

fn locate(explorer: &mut Explorer, field: Bits, state: &[u64], base: &[(Location, Value)]) -> Option<Location> {
    let Bits { word, shift, bits } = field;
    if bits > LISTED {
        return None;
    }
    let code = state[word as usize] >> shift & ((1 << bits) - 1);
    (0..1u64 << bits).filter(|other| *other != code).find_map(|other| {
        let mut changed: Box<[u64]> = state.into();
        changed[word as usize] ^= (code ^ other) << shift;
        let values = explorer.values_and_inputs(&changed);
        let gone = base.iter().filter(|pair| !values.contains(pair));
        let come = values.iter().filter(|pair| !base.contains(pair));
        let mut differing = gone.chain(come).map(|(location, _)| location);
        let first = differing.next()?;
        differing.all(|location| location == first).then(|| first.clone())
    })
}
