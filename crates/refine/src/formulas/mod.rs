//! Both machines and their coupling as formulas over one store of terms: what solvers are asked about.
//!
//! In: a coupling, options. Out: [`Formulas`]: an arbitrary state of each machine and a step from there, whether two states correspond, and
//! the initial states, which the machines themselves have made. Whoever asks makes conditions of these: [`crate::induction`] about an
//! arbitrary pair of states, [`crate::bmc`] about runs from the initial ones. INVARIANT: what is not encoded as the machines do it counts
//! against the refinement.

mod across;
pub(crate) mod answers;
pub(crate) mod ask;
pub(crate) mod diagrams;
pub(crate) mod obligation;
pub(crate) mod related;
pub(crate) mod symbolic;
pub(crate) mod values;

use std::collections::BTreeMap;

use explore::{Start, Told, input_values};
use solve::Outside;

use crate::coupling::Coupling;
use crate::options::Options;
use crate::product::{Node, NodeId};
use crate::refine::product;
use crate::side::StateId;
use crate::{ABSTRACT, CONCRETE};
use obligation::Origin;
use related::{Locations, Related, read, related};
use symbolic::{Store, Subject, Symbolic, input_location, nowhere};

/// LIMIT: so many initial states of a machine.
const STARTS: usize = 256;

/// An initial state of the concrete machine with its inputs, and the initial states of the abstract machine that answer it.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(crate) struct Begun {
    pub concrete: usize,
    pub answers: Vec<usize>,
}

/// See the module.
pub(crate) struct Formulas {
    pub store: Store,
    pub machines: [Symbolic; 2],
    pub related: Related,
    /// By side, what each initial state took from outside.
    pub starts: [Vec<Told>; 2],
    pub begun: Vec<Begun>,
}

/// What cannot be encoded, and whose it is.
pub(crate) type Untold = (Origin, Outside);

impl Formulas {
    /// The formulas of a coupling.
    ///
    /// # Errors
    /// What cannot be encoded.
    pub fn of(coupling: &Coupling, options: &Options) -> Result<Formulas, Untold> {
        let (starts, begun) = starts(coupling, options)?;
        let mut store = Store::default();
        let limits = &options.extents[CONCRETE].limits;
        let of_coupling = |outside: Outside| (Origin::Coupling, outside);
        let read = read(coupling, limits).map_err(of_coupling)?;
        let nothing = Locations::default();
        let mut side = |side: usize| -> Result<Symbolic, Untold> {
            let program = &coupling.programs[side];
            let extent = &options.extents[side];
            if let Some(input) = extent.undefined.iter().next() {
                let what = format!("{}, an input that may be undef", program.function(*input).name);
                return Err((Origin::Side(side), nowhere(&what)));
            }
            let of = Subject {
                side,
                program,
                limits: &extent.limits,
                bounds: input_values(program, &extent.bounds, &Default::default()),
                ends_at_overflow: side == CONCRETE && coupling.overflow,
                starts: &starts[side],
                readers: &coupling.readers[side],
                read: &read.states[side],
                read_in_step: if side == CONCRETE { &read.steps } else { &nothing },
            };
            Symbolic::of(&of, &mut store).map_err(|outside| (Origin::Side(side), outside))
        };
        let machines = [side(ABSTRACT)?, side(CONCRETE)?];
        keeps_no_input(&store, &machines[ABSTRACT], &starts[ABSTRACT])?;
        let both = [&machines[ABSTRACT], &machines[CONCRETE]];
        let related = related(coupling, limits, both, &mut store).map_err(of_coupling)?;
        Ok(Formulas { store, machines, related, starts, begun })
    }
}

/// The initial states of both machines, and which correspond; by the machines themselves.
fn starts(coupling: &Coupling, options: &Options) -> Result<([Vec<Told>; 2], Vec<Begun>), Untold> {
    let none = |_| (Origin::Coupling, nowhere("initial states that cannot be made again"));
    let product = product(coupling, options).map_err(none)?;
    let mut numbers: [BTreeMap<StateId, usize>; 2] = Default::default();
    let mut starts: [Vec<Start>; 2] = Default::default();
    for side in [ABSTRACT, CONCRETE] {
        let all = if side == ABSTRACT { &product.initial } else { &product.begun };
        for (_, state, start) in all.clone() {
            if !numbers[side].contains_key(&state) {
                numbers[side].insert(state, starts[side].len());
                starts[side].push(start);
            }
        }
        if starts[side].len() > STARTS {
            let what = format!("more than {STARTS} initial states");
            return Err((Origin::Side(side), nowhere(&what)));
        }
    }
    let mut begun = Vec::new();
    let mut open: Vec<NodeId> = vec![product.root];
    while let Some(node) = open.pop() {
        match &product.nodes[node as usize] {
            Node::Begins(all) | Node::Steps(_, all) | Node::Inputs(all) => open.extend(all.iter().rev()),
            Node::Choice(ways) => open.extend(ways),
            Node::Answers(end) => {
                let of = |pair: u32| numbers[ABSTRACT][&product.pairs[pair as usize].0];
                let answers = end.answers.iter().map(|(pair, _)| of(*pair)).collect();
                let one = Begun { concrete: numbers[CONCRETE][&end.to], answers };
                if !begun.contains(&one) {
                    begun.push(one);
                }
            }
            Node::Fault | Node::Endless | Node::Open(_) => {
                let what = "inputs of initial states that have too many values";
                return Err((Origin::Coupling, nowhere(what)));
            }
        }
    }
    let told = [ABSTRACT, CONCRETE].map(|side| {
        let of = |start: &Start| product.sides[side].stepper.explorer.told_of_start(*start);
        starts[side].iter().map(of).collect()
    });
    Ok((told, begun))
}

/// An input that the abstract machine's initial state has looked at keeps its value in the first step, which no formula says.
fn keeps_no_input(store: &Store, machine: &Symbolic, starts: &[Told]) -> Result<(), Untold> {
    let used = machine.used_inputs(&store.terms);
    let kept = |told: &Told| {
        let mut read = told.inputs.iter().map(|(location, _)| location.function);
        read.any(|function| used.iter().filter_map(input_location).any(|(other, ..)| other == function))
    };
    if starts.iter().any(kept) {
        let what = "an input that the initial state of the abstract machine looks at, and its first step again";
        return Err((Origin::Side(ABSTRACT), nowhere(what)));
    }
    Ok(())
}
