//! Checkpoints: keeps a search while it runs, and continues it later.
//!
//! In: the shards of a search between two rounds. Out: a checkpoint, and shards from one. States are packed as in this process: some values
//! have numbers (those of a location over an infinite domain, or of a growing domain), which depend on the order in which they first
//! appeared. The checkpoint has these values with their numbers, and what the layout was found too narrow for. INVARIANT: a search that
//! continues from a checkpoint ends as it would have without it.

mod identity;

use std::sync::Arc;

use explore::checkpoint::{Keeper, Kind, Known, Reader, Refusal, Words, Writer, layout};
use explore::{Explorer, Interner, Trouble, Unbounded, Widening};
use program::Program;

use crate::checkpoint::identity::question;
use crate::explicit::shard::{Shard, owner};
use crate::explorers::Maker;
use crate::partial_order::{Unreduced, reduction};
use crate::plan::Plan;
use crate::storage::Store;
use crate::target::{Found, Target};

/// What these checkpoints are of.
const KIND: Kind = Kind { name: b"gsverify", version: 6 };

/// A checkpoint that was read but not yet interpreted.
struct Kept {
    question: u64,
    /// What the states are packed with.
    packing: Vec<u64>,
    numbers: Vec<u64>,
    unknown: Vec<u64>,
    unbounded: Vec<u64>,
    executed: Vec<u64>,
    found: Vec<u64>,
    /// For each level.
    states: Vec<Vec<u64>>,
}

/// A search to continue.
pub(crate) struct Resumed {
    pub widening: Widening,
    pub maker: Maker,
    pub explorer: Explorer,
    pub shards: Vec<Shard>,
    pub unreduced: Option<Unreduced>,
}

/// Why a search cannot be continued.
pub(crate) enum Unfit {
    Refused(Refusal),
    Trouble(Trouble),
}

impl From<Refusal> for Unfit {
    fn from(refusal: Refusal) -> Unfit {
        Unfit::Refused(refusal)
    }
}

/// Writes a checkpoint.
pub(crate) fn keep(
    keeper: &mut dyn Keeper,
    program: &Program,
    plan: &Plan,
    explorer: &Explorer,
    (widening, interner): (&Widening, &Interner),
    shards: &[Shard],
) {
    let words = explorer.words();
    let model = keeper.model();
    let mut writer = Writer::begin(keeper, KIND);
    writer.word(model);
    writer.word(question(program, plan));
    let levels = shards[0].levels.len();
    let begin = |shard: &Shard, level: usize| if level == 0 { 0 } else { shard.levels[level - 1] };
    let expanded = match levels {
        0 => 0,
        _ => shards.iter().map(|shard| shard.next - begin(shard, levels - 1)).sum(),
    };
    let transitions: u64 = shards.iter().map(|shard| shard.transitions).sum();
    let blocked: u64 = shards.iter().map(|shard| shard.blocked).sum();
    let mut packing = Vec::new();
    widening.keep(&mut packing);
    interner.keep(&mut packing);
    writer.section(&packing);
    writer.section(&[words as u64, layout(explorer), transitions, blocked, expanded as u64]);
    let unknown: Vec<u64> = shards.iter().flat_map(|shard| &shard.unknown).map(|condition| *condition as u64).collect();
    writer.section(&unknown);
    let unbounded: Vec<u64> = shards.iter().flat_map(|shard| &shard.unbounded).flat_map(Unbounded::words).collect();
    writer.section(&unbounded);
    let rules = program.rules.len();
    let executed: Vec<u64> =
        (0..rules).map(|rule| shards.iter().any(|shard| shard.executed[rule] > 0).into()).collect();
    writer.section(&executed);
    let mut found = Vec::new();
    for one in shards.iter().flat_map(|shard| &shard.found) {
        found.extend(of_target(one.target));
        found.push(one.depth as u64);
        found.extend(&one.state);
    }
    writer.section(&found);
    writer.word(levels as u64 + 1);
    for level in 0..=levels {
        let end = |shard: &Shard| shard.levels.get(level).copied().unwrap_or(shard.store.len());
        // States whose steps were made come first.
        let made = |shard: &Shard| end(shard).min(shard.next.max(begin(shard, level)));
        let count: usize = shards.iter().map(|shard| end(shard) - begin(shard, level)).sum();
        writer.word((count * words) as u64);
        let first = shards.iter().map(|shard| (shard, begin(shard, level)..made(shard)));
        let second = shards.iter().map(|shard| (shard, made(shard)..end(shard)));
        for (shard, places) in first.chain(second) {
            places.flat_map(|place| shard.store.state(place)).for_each(|word| writer.word(*word));
        }
    }
    writer.end();
}

/// Reads the checkpoint, if there is one, and prepares the search to continue.
pub(crate) fn resume(keeper: &mut dyn Keeper, program: &Arc<Program>, plan: &Plan) -> Result<Option<Resumed>, Unfit> {
    let Some(kept) = read(keeper)? else { return Ok(None) };
    if kept.question != question(program, plan) {
        return Err(Refusal::Question.into());
    }
    kept.understood(program, plan).map(Some)
}

fn read(keeper: &mut dyn Keeper) -> Result<Option<Kept>, Refusal> {
    let model = keeper.model();
    let Some(mut reader) = Reader::begin(keeper, KIND)? else { return Ok(None) };
    let of_model = reader.word()?;
    let mut kept = Kept {
        question: reader.word()?,
        packing: reader.section()?,
        numbers: reader.section()?,
        unknown: reader.section()?,
        unbounded: reader.section()?,
        executed: reader.section()?,
        found: reader.section()?,
        states: Vec::new(),
    };
    for _ in 0..reader.word()? {
        kept.states.push(reader.section()?);
    }
    reader.end()?;
    if of_model != model { Err(Refusal::Model) } else { Ok(Some(kept)) }
}

impl Kept {
    fn understood(self, program: &Arc<Program>, plan: &Plan) -> Result<Resumed, Unfit> {
        let [words, fields, transitions, blocked, expanded] = self.numbers[..] else {
            return Err(Refusal::Damaged.into());
        };
        let (mut packing, known) = (Words::new(&self.packing), Known(program));
        let widening = Widening::again(&mut packing, known)?;
        let interner = Arc::new(Interner::again(&mut packing, known)?);
        packing.end()?;
        let mut maker = Maker::new(program, plan, &widening).knowing(interner);
        let mut explorer = match maker.first() {
            Ok(explorer) => explorer,
            Err(Trouble::TooNarrow(_)) => return Err(Refusal::Damaged.into()),
            Err(trouble) => return Err(Unfit::Trouble(trouble)),
        };
        let maker = maker.tireless();
        explorer.ignore_interrupts();
        if explorer.words() as u64 != words || layout(&explorer) != fields {
            return Err(Refusal::Damaged.into());
        }
        let words = words as usize;
        let (reduction, unreduced) = reduction(program, plan, &mut explorer);
        let count = plan.workers.max(1);
        let mut shards: Vec<Shard> =
            (0..count).map(|_| Shard::new(Store::new(words, plan.storage, plan.seed, count), &reduction)).collect();
        let current = self.states.len().checked_sub(2);
        for (level, states) in self.states.iter().enumerate() {
            if current == Some(level) {
                shards.iter_mut().for_each(|shard| shard.next = shard.store.len());
            }
            for (index, state) in states.chunks_exact(words).enumerate() {
                let shard = &mut shards[owner(state, count)];
                shard.store.insert_all(state, &mut |_| {});
                if current == Some(level) && index < expanded as usize {
                    shard.next += 1;
                }
            }
            if level + 1 < self.states.len() {
                shards.iter_mut().for_each(|shard| shard.levels.push(shard.store.len()));
            }
        }
        let shard = &mut shards[0];
        shard.transitions = transitions;
        shard.blocked = blocked;
        shard.unknown.extend(self.unknown.iter().map(|condition| *condition as usize));
        shard.unbounded.extend(
            self.unbounded
                .chunks_exact(5)
                .map(Unbounded::of_words)
                .collect::<Option<Vec<_>>>()
                .ok_or(Refusal::Damaged)?,
        );
        shard.executed = self.executed;
        for found in self.found.chunks_exact(3 + words) {
            let target = to_target(found[0], found[1] as usize).ok_or(Refusal::Damaged)?;
            shard.found.push(Found { target, depth: found[2] as usize, state: found[3..].into() });
        }
        Ok(Resumed { widening, maker, explorer, shards, unreduced })
    }
}

/// An explorer whose initial states fit.
pub(crate) fn made(program: &Arc<Program>, plan: &Plan, widening: &mut Widening) -> Result<(Maker, Explorer), Unfit> {
    loop {
        let mut maker = Maker::new(program, plan, widening);
        match maker.first() {
            Ok(explorer) => return Ok((maker, explorer)),
            Err(Trouble::TooNarrow(more)) => widening.merge(&more),
            Err(trouble) => return Err(Unfit::Trouble(trouble)),
        }
    }
}

fn of_target(target: Target) -> [u64; 2] {
    match target {
        Target::Fault(class) => [0, class as u64],
        Target::Rest => [1, 0],
        Target::Condition(condition) => [2, condition as u64],
        Target::StepCondition(condition) => [3, condition as u64],
    }
}

fn to_target(kind: u64, number: usize) -> Option<Target> {
    Some(match kind {
        0 => Target::Fault(number),
        1 => Target::Rest,
        2 => Target::Condition(number),
        3 => Target::StepCondition(number),
        _ => return None,
    })
}
