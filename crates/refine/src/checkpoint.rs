//! Checkpoints: what a search keeps while it runs, so that it goes on later.
//!
//! In: the pairs of a search, of which so many were looked at. Out: a checkpoint; of one, the steps of both machines that were made and the
//! pairs, with the numbers that everything has. What a comparison came to is found again. INVARIANT: a search that goes on ends as it would
//! have without the interruption.

use std::sync::Arc;

use explore::checkpoint::{Keeper, Kind, Known, Reader, Refusal, Words, Writer, hash, of_program};
use explore::{Interner, Widening};

use crate::coupling::Coupling;
use crate::options::{Extent, Options};
use crate::product::Product;
use crate::side::Inputs;
use crate::{ABSTRACT, CONCRETE};

/// What these checkpoints are of.
const KIND: Kind = Kind { name: b"gsrefine", version: 1 };

/// A search that goes on.
pub(crate) struct Kept {
    /// So many pairs were looked at.
    pub next: usize,
    pub sides: [KeptSide; 2],
    pub inputs: Inputs,
    /// What was found of the pairs: see [`Product::keep`].
    pub found: Vec<u64>,
}

/// What was kept of one of the machines.
pub(crate) struct KeptSide {
    pub widening: Widening,
    pub interner: Arc<Interner>,
    /// The states, one after the other.
    pub states: Vec<u64>,
    /// What was found of them: see [`crate::side::Side::keep`].
    pub found: Vec<u64>,
}

/// The number of what is asked. How far the search may go is no part of it, nor who makes the steps.
fn question(coupling: &Coupling, options: &Options) -> u64 {
    let text = &coupling.sources().file(coupling.file).text;
    let extents = options.extents.each_ref().map(|extent| {
        let Extent { limits, bounds, undefined, assumed, interrupt: _ } = extent;
        (limits, bounds, undefined, assumed)
    });
    hash(&[&coupling.programs.each_ref().map(|program| of_program(program)), text, &extents])
}

/// Writes a checkpoint of a search that has looked at so many pairs.
pub(crate) fn keep(
    keeper: &mut dyn Keeper,
    product: &Product<'_>,
    options: &Options,
    widenings: &[Widening; 2],
    next: usize,
) {
    let model = keeper.model();
    let mut writer = Writer::begin(keeper, KIND);
    writer.word(model);
    writer.word(question(product.judge.coupling, options));
    writer.word(next as u64);
    let mut words = Vec::new();
    for (side, widening) in product.sides.iter().zip(widenings) {
        widening.keep(&mut words);
        side.recipe.interner().keep(&mut words);
        writer.section(&words);
        writer.section(side.states());
        words.clear();
        side.keep(&mut words);
        writer.section(&words);
        words.clear();
    }
    product.inputs.keep(&mut words);
    writer.section(&words);
    words.clear();
    product.keep(&mut words);
    writer.section(&words);
    writer.end();
}

/// Reads the checkpoint, if there is one.
///
/// # Errors
/// It is not of this question, or damaged.
pub(crate) fn kept(keeper: &mut dyn Keeper, coupling: &Coupling, options: &Options) -> Result<Option<Kept>, Refusal> {
    let model = keeper.model();
    let Some(mut reader) = Reader::begin(keeper, KIND)? else { return Ok(None) };
    let (of_model, asked, next) = (reader.word()?, reader.word()?, reader.word()?);
    let mut sections = Vec::new();
    for _ in 0..8 {
        sections.push(reader.section()?);
    }
    reader.end()?;
    if of_model != model {
        return Err(Refusal::Model);
    }
    if asked != question(coupling, options) {
        return Err(Refusal::Question);
    }
    let mut sections = sections.into_iter();
    let mut section = || sections.next().ok_or(Refusal::Damaged);
    let mut side = |side: usize| {
        let (packing, states, found) = (section()?, section()?, section()?);
        let (mut words, known) = (Words::new(&packing), Known(&coupling.programs[side]));
        let widening = Widening::again(&mut words, known)?;
        let interner = Arc::new(Interner::again(&mut words, known)?);
        words.end()?;
        Ok(KeptSide { widening, interner, states, found })
    };
    let sides = [side(ABSTRACT)?, side(CONCRETE)?];
    let (inputs, found) = (section()?, section()?);
    let mut words = Words::new(&inputs);
    let inputs = Inputs::again(&mut words, coupling)?;
    words.end()?;
    Ok(Some(Kept { next: usize::try_from(next).map_err(|_| Refusal::Damaged)?, sides, inputs, found }))
}
