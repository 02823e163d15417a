//! The whole question: explores the pairs, decides the game, reports.
//!
//! In: a [`Coupling`] and [`Options`]. Out: a [`Report`]. The search goes breadth-first; a limit ends it, and then only a refutation
//! that needs nothing of what was not looked at is told. So it is where bounds leave out values of inputs. INVARIANT: *refines* is said
//! only if every pair that the answers use was looked at; *does not refine* only if the concrete machine wins whatever was not looked at.

use std::sync::Arc;

use explore::checkpoint::{Keeper, Refusal};
use explore::{Unbounded, Widening};
use machine::{Cause, Fault};
use program::PropertyKind;

use crate::behind::{self, is_unclear};
use crate::bounded::of_proof;
use crate::checkpoint::{Kept, KeptSide, kept};
use crate::coupling::Coupling;
use crate::evidence::{self, Ended, Refutation};
use crate::fair::has_fair_run;
use crate::game::{Parents, Rules, Solution, solve, solve_fairly};
use crate::judge::Judge;
use crate::limited::with_shared_inputs;
use crate::options::Options;
use crate::preserve::preserved;
use crate::product::{Node, NodeId, Product, Unclear};
use crate::report::{Assumed, From, Progress, Report, Vacuous, Verdict, Why};
use crate::search::{Keeping, Searched, Whys, progress_of, search};
use crate::side::{Inputs, Side, Stopped};
use crate::{ABSTRACT, CONCRETE};

/// LIMIT: so many pairs of states are compared to find out whether the relation says anything.
const COMPARED: usize = 1 << 22;

/// Why nothing can be said.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Trouble {
    /// An initial state of a machine cannot be made.
    Fault(usize, Box<Fault>),
    /// The initial states of a machine cannot be gone through.
    Unbounded(usize, Unbounded),
    /// Whoever waits has had enough before the initial states were made.
    Stopped(Cause),
    /// The search cannot go on from its checkpoint.
    Refused(Refusal),
}

/// Whether the concrete machine refines the abstract one. `watch` receives progress and tells whether to go on.
///
/// # Errors
/// A machine has no initial states.
pub fn refine(
    coupling: &Coupling,
    options: &Options,
    watch: &mut dyn FnMut(&Progress) -> bool,
) -> Result<Report, Trouble> {
    refine_kept(coupling, options, None, watch)
}

/// The same; with a keeper, it goes on from its checkpoint, and writes one from time to time, and when a limit ends the search.
///
/// # Errors
/// A machine has no initial states, or the checkpoint does not fit.
pub fn refine_kept(
    coupling: &Coupling,
    options: &Options,
    mut keeper: Option<&mut dyn Keeper>,
    watch: &mut dyn FnMut(&Progress) -> bool,
) -> Result<Report, Trouble> {
    let options = &with_shared_inputs(coupling, options);
    let mut past = match &mut keeper {
        Some(keeper) => kept(*keeper, coupling, options).map_err(Trouble::Refused)?,
        None => None,
    };
    let mut widenings = match &past {
        Some(past) => past.sides.each_ref().map(|side| side.widening.clone()),
        None => Default::default(),
    };
    loop {
        let keeper = keeper.as_mut().map(|keeper| &mut **keeper as &mut dyn Keeper);
        match attempt(coupling, options, &widenings, (keeper, past.take()), watch)? {
            Ok(report) => return Ok(report),
            Err((side, widening)) => widenings[side].merge(&widening),
        }
    }
}

type Attempt = Result<Report, (usize, Widening)>;

/// The initial pairs of both machines, of which nothing has been looked at.
pub(crate) fn product<'c>(coupling: &'c Coupling, options: &Options) -> Result<Product<'c>, Trouble> {
    let mut widenings: [Widening; 2] = Default::default();
    loop {
        match begun(coupling, options, &widenings, None)? {
            Ok(product) => return Ok(product),
            Err((side, widening)) => widenings[side].merge(&widening),
        }
    }
}

/// The same, or the side whose states need more room.
pub(crate) fn begun<'c>(
    coupling: &'c Coupling,
    options: &Options,
    widenings: &[Widening; 2],
    past: Option<Kept>,
) -> Result<Result<Product<'c>, (usize, Widening)>, Trouble> {
    let mut sides = Vec::new();
    for side in [ABSTRACT, CONCRETE] {
        let interner = past.as_ref().map(|past| Arc::clone(&past.sides[side].interner)).unwrap_or_default();
        let mut made = match Side::new(coupling, side, &options.extents[side], (&widenings[side], &interner)) {
            Ok(made) => made,
            Err(explore::Trouble::TooNarrow(widening)) => return Ok(Err((side, widening))),
            Err(explore::Trouble::Fault(fault)) => return Err(Trouble::Fault(side, fault)),
            Err(explore::Trouble::Unbounded(unbounded)) => return Err(Trouble::Unbounded(side, unbounded)),
            Err(explore::Trouble::Interrupted(cause)) => return Err(Trouble::Stopped(cause)),
        };
        made.most = options.max_steps;
        if let Some(past) = &past {
            let KeptSide { states, found, .. } = &past.sides[side];
            made.take_over((states, found), past.inputs.labels()).map_err(Trouble::Refused)?;
        }
        sides.push(made);
    }
    let Ok(sides) = <[Side<'c>; 2]>::try_from(sides) else { unreachable!("there are two sides") };
    let judge = Judge::new(coupling, &options.extents[CONCRETE].limits);
    let Some(Kept { next, inputs, found, .. }) = past else {
        return Ok(Ok(Product::new(sides, judge, Inputs::default())));
    };
    let mut product = Product::new(sides, judge, inputs);
    product.take_over(&found, next).map_err(Trouble::Refused)?;
    Ok(Ok(product))
}

fn attempt<'k>(
    coupling: &Coupling,
    options: &Options,
    widenings: &'k [Widening; 2],
    (keeper, kept): (Option<&'k mut dyn Keeper>, Option<Kept>),
    watch: &mut dyn FnMut(&Progress) -> bool,
) -> Result<Attempt, Trouble> {
    let past = kept.as_ref().map_or(0, |kept| kept.next);
    let mut product = match begun(coupling, options, widenings, kept)? {
        Ok(product) => product,
        Err(narrow) => return Ok(Err(narrow)),
    };
    let mut keeping = Keeping { keeper, past, widenings };
    let Searched { mut whys, is_lost, next } = match search(&mut product, options, &mut keeping, watch) {
        Ok(searched) => searched,
        Err(narrow) => return Ok(Err(narrow)),
    };
    let progress = progress_of(&product, product.pairs.len() - next);
    let mut broken = None;
    if whys.0.is_empty() && !is_lost && is_unclear(&product) {
        match behind::broken(&mut product) {
            Ok(found) => broken = found,
            Err(Stopped::Narrow(side, widening)) => return Ok(Err((side, widening))),
            // What was not looked at is not told.
            Err(Stopped::Many | Stopped::Interrupted) => {}
        }
    }
    for side in &mut product.sides {
        side.ignore_interrupts();
    }
    let is_complete = whys.0.is_empty() && !is_lost;
    let mut diagrams = Default::default();
    // The conditions of fairness that the verdict rests on.
    let mut fair: Vec<usize> = (0..product.fair()).collect();
    let said = says(&mut product, is_complete);
    let parents = Parents::of(&product);
    let hopeful = solve(&product, &parents, Rules::of(&product, true));
    let bounded = of_proof(&product, &options.extents);
    let verdict = match (said, &broken) {
        // With other values of inputs there may be initial states.
        (Says::Nothing(Vacuous::NoStart(side)), _) if !product.sides[side].limited.is_empty() => {
            let limited = product.sides[side].limited.keys();
            Verdict::Unknown(limited.map(|input| Why::Bounded(side, *input)).collect())
        }
        // So there may be one that corresponds.
        (Says::Nothing(Vacuous::NoInitialPair(_)), _) if hopeful.won => {
            unclear(&product, &mut whys);
            Verdict::Unknown(whys.0)
        }
        (Says::Nothing(vacuous @ (Vacuous::NoStart(_) | Vacuous::NoInitialPair(_))), _) => Verdict::Vacuous(vacuous),
        // What cannot be answered is a fault, whatever else the coupling says.
        _ if !hopeful.won => Verdict::DoesNot(Box::new(evidence::refutation(&mut product, &hopeful))),
        (_, Some(broken)) => Verdict::DoesNot(Box::new(evidence::breaks(&mut product, broken))),
        // With other values of inputs there may be states that it tells apart.
        (Says::Nothing(_), None) if !bounded.is_empty() => Verdict::Unknown(bounded),
        (Says::Nothing(vacuous), None) => Verdict::Vacuous(vacuous),
        (said @ (Says::Something | Says::Perhaps(_)), None) => {
            let rules = Rules::of(&product, false);
            // Where all is clear nothing counts for either.
            let sure = match is_complete && !is_unclear(&product) {
                true => Solution { rules, ..hopeful },
                false => solve(&product, &parents, rules),
            };
            bounded.iter().for_each(|why| whys.add(*why));
            if sure.won {
                diagrams = evidence::used(&product, &sure);
                fair = needed(&product, &parents, sure.rules);
            }
            match (sure.won, said) {
                (true, _) if !fair.is_empty() && !has_fair_run(&product, &fair) => Verdict::Vacuous(Vacuous::NoFairRun),
                (true, _) if !bounded.is_empty() => Verdict::Unknown(bounded),
                (true, Says::Perhaps(pairs)) => Verdict::Unknown(vec![Why::Undistinguished(pairs)]),
                (true, _) => Verdict::Refines,
                (false, _) => {
                    unclear(&product, &mut whys);
                    Verdict::Unknown(whys.0)
                }
            }
        }
    };
    let goes_on = |refutation: &Refutation| matches!(refutation.ended, Ended::Waits(_) | Ended::Endless(_));
    match &verdict {
        // What cannot be answered is lost, whatever is fair.
        Verdict::DoesNot(refutation) if !goes_on(refutation) => fair.clear(),
        Verdict::Vacuous(vacuous) if *vacuous != Vacuous::NoFairRun => fair.clear(),
        Verdict::DoesNot(_) | Verdict::Vacuous(_) | Verdict::Refines | Verdict::Unknown(_) => {}
    }
    let mut assumed = Vec::new();
    for side in [ABSTRACT, CONCRETE] {
        let properties = &coupling.programs[side].properties;
        let said = properties.iter().filter(|property| property.kind == PropertyKind::Invar);
        assumed.extend(said.map(|property| Assumed {
            side,
            name: property.name.clone(),
            from: From::Text(property.span),
        }));
        let of_inputs = options.extents[side].assumed.values();
        // What is assumed of the concrete machine's input is told there.
        for (name, file) in of_inputs.filter(|(name, _)| !name.is_empty()) {
            let bound = Assumed { side, name: name.clone(), from: From::File(file.clone()) };
            if !assumed.contains(&bound) {
                assumed.push(bound);
            }
        }
    }
    assumed.extend(fair.into_iter().map(|fair| {
        let (name, span) = coupling.fairness(fair);
        Assumed { side: CONCRETE, name, from: From::Text(span) }
    }));
    let idle = product.sides[ABSTRACT].steps.1 == 0;
    let properties = match verdict {
        Verdict::Refines => preserved(&mut product, &parents),
        _ => Vec::new(),
    };
    let dead_ends = product.sides[CONCRETE].dead_ends();
    Ok(Ok(Report { verdict, progress, diagrams, assumed, idle, dead_ends, properties, proof: None, runs: None }))
}

/// LIMIT: of so many conditions of fairness every choice is tried.
const EVERY: usize = 8;

/// Conditions of fairness of which none can be left out, by which a game is won that is won by all: if there are such, those that some
/// run meets. What the coupling says is left out before what the model says itself.
fn needed(product: &Product<'_>, parents: &Parents, rules: Rules) -> Vec<usize> {
    let mut needed: Vec<usize> = (0..product.fair()).collect();
    if needed.len() > 1 && solve_fairly(product, parents, rules, Vec::new()).won {
        return Vec::new();
    }
    // What the coupling says comes first.
    for fair in 0..product.fair() {
        let others: Vec<usize> = needed.iter().copied().filter(|other| *other != fair).collect();
        if solve_fairly(product, parents, rules, others.clone()).won {
            needed = others;
        }
    }
    if needed.is_empty() || product.fair() > EVERY || has_fair_run(product, &needed) {
        return needed;
    }
    let of = |choice: &u32| (0..product.fair()).filter(|fair| choice >> fair & 1 == 1).collect::<Vec<_>>();
    let mut choices: Vec<u32> = (1..1 << product.fair()).collect();
    choices.sort_by_key(|choice| choice.count_ones());
    let mut met = choices.iter().map(of).filter(|choice| has_fair_run(product, choice));
    met.find(|choice| solve_fairly(product, parents, rules, choice.clone()).won).unwrap_or(needed)
}

/// What was not clear anywhere that matters.
fn unclear(product: &Product<'_>, whys: &mut Whys) {
    let mut seen = vec![false; product.nodes.len()];
    let mut open: Vec<NodeId> = vec![product.root];
    open.extend(product.trees.iter().flatten());
    while let Some(node) = open.pop() {
        if std::mem::replace(&mut seen[node as usize], true) {
            continue;
        }
        let node = &product.nodes[node as usize];
        open.extend(node.behind());
        let unclear = match node {
            Node::Answers(end) => end.unclear,
            Node::Open(unclear) => Some(*unclear),
            Node::Begins(_) | Node::Steps(..) | Node::Inputs(_) | Node::Choice(_) | Node::Fault | Node::Endless => None,
        };
        if let Some(unclear) = unclear {
            whys.add(why_of(product, unclear));
        }
    }
}

/// What was not clear, as a reason.
pub(crate) fn why_of(product: &Product<'_>, unclear: Unclear) -> Why {
    match unclear {
        Unclear::Unbounded(side, unbounded) => Why::Unbounded(side, unbounded),
        Unclear::Long => Why::Long(product.judge.coupling.diagrams.most_concrete()),
        Unclear::Valuations => Why::Valuations,
        Unclear::Bounded(input) => Why::Bounded(ABSTRACT, input),
    }
}

/// Whether an answer says anything.
enum Says {
    Something,
    /// All of so many pairs of states that were compared correspond: it may say nothing.
    Perhaps(usize),
    Nothing(Vacuous),
}

fn says(product: &mut Product<'_>, is_complete: bool) -> Says {
    for (side, none) in [(ABSTRACT, product.initial.is_empty()), (CONCRETE, product.begun.is_empty())] {
        if none {
            return Says::Nothing(Vacuous::NoStart(side));
        }
    }
    if product.pairs.is_empty() {
        return Says::Nothing(Vacuous::NoInitialPair(Box::new(evidence::no_initial_pair(product))));
    }
    if is_complete && product.sides[CONCRETE].steps.0 == 0 {
        return Says::Nothing(Vacuous::NoneLeft);
    }
    if is_complete && product.sides[CONCRETE].steps.1 == 0 {
        return Says::Nothing(Vacuous::NoStep);
    }
    let [one, other] = [ABSTRACT, CONCRETE].map(|side| product.sides[side].count());
    if product.judge.distinguishes {
        return Says::Something;
    }
    if one < 2 || other < 2 {
        // With other values of inputs there may be more states, and all of them may correspond.
        let is_whole = product.sides.iter().all(|side| side.limited_and_read().is_empty());
        return if is_whole { Says::Something } else { Says::Perhaps(one * other) };
    }
    // Without all states no relation is known to hold of every two.
    let nothing = if is_complete { Says::Nothing(Vacuous::Total) } else { Says::Perhaps(one * other) };
    // Where each state corresponds to each, the search may have met all of these pairs.
    if product.pairs.len() == one * other {
        return nothing;
    }
    // States that lie far apart first: they soon differ, unless the coupling says nothing.
    let pairs = (0..other).flat_map(|apart| (0..one).map(move |state| (state, (state + apart + other / 2) % other)));
    for (compared, (state, there)) in pairs.enumerate() {
        if compared == COMPARED {
            return Says::Perhaps(COMPARED);
        }
        if !product.judge.coupled(&mut product.sides, [state as u32, there as u32]) {
            return Says::Something;
        }
    }
    nothing
}
