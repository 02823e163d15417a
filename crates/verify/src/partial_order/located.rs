//! Which location each field of a packed state holds.
//!
//! In: an explorer. Out: by field, the location whose value changes with it. Found out by trying: a field is given another code,
//! and the values of the state are looked at. LIMIT: fields that hold numbers of values are not located.

use explore::{Bits, Explorer};
use machine::{Location, Value};

/// Fields of more bits hold numbers of values.
const LISTED: u8 = 16;

/// See the module.
pub(crate) fn located(explorer: &mut Explorer) -> Vec<Option<Location>> {
    let fields = explorer.fields();
    let Some(state) = explorer.initial().first().map(|(state, _)| state.clone()) else {
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
