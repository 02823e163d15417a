//! The search: looks at the pairs, one after the other, in the order in which they are found.
//!
//! In: a [`Product`] with its initial pairs, limits, and a checkpoint that it goes on from. Out: the pairs that were looked at, and why no more
//! were. INVARIANT: what was looked at does not depend on how many threads make steps, nor on interruptions.

use std::sync::Arc;

use explore::Widening;
use explore::checkpoint::Keeper;
use machine::Cause;

use crate::checkpoint::keep;
use crate::game::{Parents, Rules, solve};
use crate::options::Options;
use crate::product::Product;
use crate::report::{Progress, Why};
use crate::side::{Ahead, Ending, Stopped};
use crate::{ABSTRACT, CONCRETE};

/// Behind so many pairs the game is decided for the first time, and then whenever they have doubled.
const LOOK: usize = 256;

/// Reasons, each once.
#[derive(Default)]
pub(crate) struct Whys(pub Vec<Why>);

impl Whys {
    pub fn add(&mut self, why: Why) {
        if !self.0.contains(&why) {
            self.0.push(why);
        }
    }
}

/// Where a search is kept.
pub(crate) struct Keeping<'k> {
    pub keeper: Option<&'k mut dyn Keeper>,
    /// So many pairs were looked at when it was kept from which it goes on.
    pub past: usize,
    /// What the states are packed with.
    pub widenings: &'k [Widening; 2],
}

impl Keeping<'_> {
    /// Keeps a search that has looked at so many pairs.
    fn keep(&mut self, product: &Product<'_>, options: &Options, next: usize) {
        if let Some(keeper) = &mut self.keeper {
            keep(*keeper, product, options, self.widenings, next);
        }
    }

    fn is_due(&mut self) -> bool {
        self.keeper.as_mut().is_some_and(|keeper| keeper.is_due())
    }
}

/// How far a search came.
pub(crate) struct Searched {
    /// Why it came no further.
    pub whys: Whys,
    /// It is lost, whatever comes.
    pub is_lost: bool,
    /// The first pair that was not looked at.
    pub next: usize,
}

/// Looks at the pairs, one after the other, until all are known, or it is lost, or a limit is met; keeps it where a limit is met.
pub(crate) fn search(
    product: &mut Product<'_>,
    options: &Options,
    keeping: &mut Keeping<'_>,
    watch: &mut dyn FnMut(&Progress) -> bool,
) -> Result<Searched, (usize, Widening)> {
    std::thread::scope(|scope| {
        let ahead = Arc::new(Ahead::new());
        let _end = Ending(&ahead);
        let searched = searched(product, options, keeping, watch, &mut |product, next| {
            for _ in 1..options.workers {
                let recipes = product.sides.each_ref().map(|side| side.recipe.clone().ended_by(ahead.interrupt()));
                let ahead = Arc::clone(&ahead);
                // Steps may recurse deeply; beyond this, the stack grows on demand. Without a thread the search goes on alone.
                let worker = std::thread::Builder::new().name("steps".to_string()).stack_size(16 << 20);
                let _ = worker.spawn_scoped(scope, move || ahead.work(&recipes));
            }
            product.sides.iter_mut().for_each(|side| side.ahead(Some(&ahead)));
            for (one, other) in &product.pairs[next..] {
                product.sides[ABSTRACT].offer(*one);
                product.sides[CONCRETE].offer(*other);
            }
        });
        product.sides.iter_mut().for_each(|side| side.ahead(None));
        let searched = searched?;
        match searched.whys.0.is_empty() {
            true => keeping.keeper.iter_mut().for_each(|keeper| keeper.remove()),
            false => keeping.keep(product, options, searched.next),
        }
        Ok(searched)
    })
}

/// The same; `help` is called when the search has become long.
fn searched<'c>(
    product: &mut Product<'c>,
    options: &Options,
    keeping: &mut Keeping<'_>,
    watch: &mut dyn FnMut(&Progress) -> bool,
    help: &mut dyn FnMut(&mut Product<'c>, usize),
) -> Result<Searched, (usize, Widening)> {
    let mut whys = Whys::default();
    let (mut next, mut is_lost) = (keeping.past, false);
    // A search whose steps are counted goes on alone.
    let mut has_help = options.workers == 1 || options.max_steps < u64::MAX;
    let mut look_again = LOOK;
    while look_again <= next {
        look_again *= 2;
    }
    while next < product.pairs.len() {
        if next >= look_again {
            // What is lost whatever comes need not wait for the rest of the search, which may have no end.
            is_lost = !solve(product, &Parents::of(product), Rules::of(product, true)).won;
            if is_lost {
                break;
            }
            look_again = next * 2;
        }
        if next as u64 >= options.max_pairs {
            whys.add(Why::Pairs(options.max_pairs));
            break;
        }
        if product.sides.iter().map(|side| side.steps.0).sum::<u64>() >= options.max_steps {
            whys.add(Why::Steps(options.max_steps));
            break;
        }
        if next.is_multiple_of(64) && !watch(&progress_of(product, product.pairs.len() - next)) {
            whys.add(Why::Stopped(Cause::Asked));
            break;
        }
        if !has_help && next >= options.alone {
            has_help = true;
            help(product, next);
        }
        if next > keeping.past && next.is_multiple_of(64) && keeping.is_due() {
            keeping.keep(product, options, next);
        }
        let asked = |side: usize| options.extents[side].interrupt.cause();
        match asked(ABSTRACT).or(asked(CONCRETE)) {
            Some(cause) => {
                whys.add(Why::Stopped(cause));
                break;
            }
            None => match product.explore(next as u32) {
                Ok(()) => next += 1,
                Err(Stopped::Narrow(side, widening)) => return Err((side, widening)),
                Err(Stopped::Many) => {
                    whys.add(Why::Steps(options.max_steps));
                    break;
                }
                Err(Stopped::Interrupted) => {
                    whys.add(Why::Stopped(asked(ABSTRACT).or(asked(CONCRETE)).unwrap_or(Cause::Asked)));
                    break;
                }
            },
        }
    }
    Ok(Searched { whys, is_lost, next })
}

/// How many pairs, states and steps there are.
pub(crate) fn progress_of(product: &Product<'_>, queue: usize) -> Progress {
    Progress {
        pairs: product.pairs.len() as u64,
        queue: queue as u64,
        states: [ABSTRACT, CONCRETE].map(|side| product.sides[side].count() as u64),
        steps: [ABSTRACT, CONCRETE].map(|side| product.sides[side].steps.0),
    }
}
