//! The whole question: explores the pairs, decides the game, reports.
//!
//! In: a [`Coupling`] and [`Options`]. Out: a [`Report`]. The search goes breadth-first; a limit ends it, and then only a refutation
//! that needs nothing of what was not looked at is told. So it is where bounds leave out values of inputs. INVARIANT: *refines* is said
//! only if every pair that the answers use was looked at; *does not refine* only if the concrete machine wins whatever was not looked at.

use std::sync::Arc;

use explore::{Unbounded, Widening};
use machine::{Cause, Fault};
use program::PropertyKind;

use crate::behind::{self, is_unclear};
use crate::bounded::of_proof;
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
use crate::side::{Ahead, Ending, Side, Stopped};
use crate::{ABSTRACT, CONCRETE};

/// LIMIT: so many pairs of states are compared to find out whether the relation says anything.
const COMPARED: usize = 1 << 22;

/// Behind so many pairs the game is decided for the first time, and then whenever they have doubled.
const LOOK: usize = 256;

/// Why nothing can be said.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Trouble {
    /// An initial state of a machine cannot be made.
    Fault(usize, Box<Fault>),
    /// The initial states of a machine cannot be gone through.
    Unbounded(usize, Unbounded),
    /// Whoever waits has had enough before the initial states were made.
    Stopped(Cause),
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
    let options = &with_shared_inputs(coupling, options);
    let mut widenings: [Widening; 2] = Default::default();
    loop {
        match attempt(coupling, options, &widenings, watch)? {
            Ok(report) => return Ok(report),
            Err((side, widening)) => widenings[side].merge(&widening),
        }
    }
}

/// Reasons, each once.
#[derive(Default)]
struct Whys(Vec<Why>);

impl Whys {
    fn add(&mut self, why: Why) {
        if !self.0.contains(&why) {
            self.0.push(why);
        }
    }
}

type Attempt = Result<Report, (usize, Widening)>;

/// The initial pairs of both machines, of which nothing has been looked at.
pub(crate) fn product<'c>(coupling: &'c Coupling, options: &Options) -> Result<Product<'c>, Trouble> {
    let mut widenings: [Widening; 2] = Default::default();
    loop {
        match begun(coupling, options, &widenings)? {
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
) -> Result<Result<Product<'c>, (usize, Widening)>, Trouble> {
    let mut sides = Vec::new();
    for side in [ABSTRACT, CONCRETE] {
        let mut made = match Side::new(coupling, side, &options.extents[side], &widenings[side]) {
            Ok(made) => made,
            Err(explore::Trouble::TooNarrow(widening)) => return Ok(Err((side, widening))),
            Err(explore::Trouble::Fault(fault)) => return Err(Trouble::Fault(side, fault)),
            Err(explore::Trouble::Unbounded(unbounded)) => return Err(Trouble::Unbounded(side, unbounded)),
            Err(explore::Trouble::Interrupted(cause)) => return Err(Trouble::Stopped(cause)),
        };
        made.most = options.max_steps;
        sides.push(made);
    }
    let Ok(sides) = <[Side<'c>; 2]>::try_from(sides) else { unreachable!("there are two sides") };
    let judge = Judge::new(coupling, &options.extents[CONCRETE].limits);
    Ok(Ok(Product::new(sides, judge)))
}

fn attempt(
    coupling: &Coupling,
    options: &Options,
    widenings: &[Widening; 2],
    watch: &mut dyn FnMut(&Progress) -> bool,
) -> Result<Attempt, Trouble> {
    let mut product = match begun(coupling, options, widenings)? {
        Ok(product) => product,
        Err(narrow) => return Ok(Err(narrow)),
    };
    let Searched { mut whys, is_lost, next } = match search(&mut product, options, watch) {
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
    let verdict = match said {
        // With other values of inputs there may be initial states.
        Says::Nothing(Vacuous::NoStart(side)) if !product.sides[side].limited.is_empty() => {
            let limited = product.sides[side].limited.keys();
            Verdict::Unknown(limited.map(|input| Why::Bounded(side, *input)).collect())
        }
        // So there may be one that corresponds.
        Says::Nothing(Vacuous::NoInitialPair(_)) if hopeful.won => {
            unclear(&product, &mut whys);
            Verdict::Unknown(whys.0)
        }
        Says::Nothing(vacuous @ (Vacuous::NoStart(_) | Vacuous::NoInitialPair(_))) => Verdict::Vacuous(vacuous),
        // What cannot be answered is a fault, whatever else the coupling says.
        _ if !hopeful.won => Verdict::DoesNot(Box::new(evidence::refutation(&mut product, &hopeful))),
        _ if let Some(broken) = &broken => Verdict::DoesNot(Box::new(evidence::breaks(&mut product, broken))),
        // With other values of inputs there may be states that it tells apart.
        Says::Nothing(_) if !bounded.is_empty() => Verdict::Unknown(bounded),
        Says::Nothing(vacuous) => Verdict::Vacuous(vacuous),
        said @ (Says::Something | Says::Perhaps(_)) => {
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

fn progress_of(product: &Product<'_>, queue: usize) -> Progress {
    Progress {
        pairs: product.pairs.len() as u64,
        queue: queue as u64,
        states: [ABSTRACT, CONCRETE].map(|side| product.sides[side].count() as u64),
        steps: [ABSTRACT, CONCRETE].map(|side| product.sides[side].steps.0),
    }
}

/// How far a search came.
struct Searched {
    /// Why it came no further.
    whys: Whys,
    /// It is lost, whatever comes.
    is_lost: bool,
    /// The first pair that was not looked at.
    next: usize,
}

/// Looks at the pairs, one after the other, until all are known, or it is lost, or a limit is met.
fn search(
    product: &mut Product<'_>,
    options: &Options,
    watch: &mut dyn FnMut(&Progress) -> bool,
) -> Result<Searched, (usize, Widening)> {
    std::thread::scope(|scope| {
        let ahead = Arc::new(Ahead::new());
        let _end = Ending(&ahead);
        let searched = searched(product, options, watch, &mut |product, next| {
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
        searched
    })
}

/// The same; `help` is called when the search has become long.
fn searched<'c>(
    product: &mut Product<'c>,
    options: &Options,
    watch: &mut dyn FnMut(&Progress) -> bool,
    help: &mut dyn FnMut(&mut Product<'c>, usize),
) -> Result<Searched, (usize, Widening)> {
    let mut whys = Whys::default();
    let (mut next, mut look_again, mut is_lost) = (0, LOOK, false);
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
        if next == options.alone && options.workers > 1 && options.max_steps == u64::MAX {
            help(product, next);
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
