//! Random graphs, fairness and formulas, from a seed.

use program::TemporalOperator;
use verify::graph::{Builder, Graph, Label, StateSet};
use verify::temporal::fairness::{AgentFairness, Fairness};
use verify::temporal::formula::{FormulaId, Logic};

pub const PROPOSITIONS: usize = 2;

/// A small random number generator.
pub struct Random(u64);

impl Random {
    pub fn new(seed: u64) -> Random {
        Random(seed.wrapping_mul(0x9E37_79B9_7F4A_7C15) | 1)
    }

    pub fn below(&mut self, bound: usize) -> usize {
        self.0 ^= self.0 << 13;
        self.0 ^= self.0 >> 7;
        self.0 ^= self.0 << 17;
        (self.0 >> 24) as usize % bound
    }

    pub fn chance(&mut self, one_in: usize) -> bool {
        self.below(one_in) == 0
    }
}

pub struct Sample {
    pub states: usize,
    pub initial: Vec<bool>,
    /// From, to, which agent.
    pub edges: Vec<(u32, u32, u32)>,
    /// By proposition and state.
    pub holds: Vec<Vec<bool>>,
}

/// A graph with at most this many states; each has a successor.
pub fn sample(random: &mut Random, most: usize, degree: usize) -> Sample {
    let states = 1 + random.below(most);
    let mut initial: Vec<bool> = (0..states).map(|_| random.chance(4)).collect();
    initial[0] = true;
    let mut edges = Vec::new();
    for from in 0..states as u32 {
        for _ in 0..1 + random.below(degree) {
            edges.push((from, random.below(states) as u32, random.below(2) as u32));
        }
    }
    let holds = (0..PROPOSITIONS).map(|_| (0..states).map(|_| random.chance(2)).collect()).collect();
    Sample { states, initial, edges, holds }
}

impl Sample {
    /// The graph; states marked `unexplored` have no edges.
    pub fn graph(&self, unexplored: &[bool]) -> Graph {
        let mut builder = Builder::new(self.holds.len());
        for state in 0..self.states {
            if self.initial[state] {
                builder.initial();
            }
            let truths: Vec<bool> = self.holds.iter().map(|column| column[state]).collect();
            if unexplored.get(state) == Some(&true) {
                builder.unexplored_state(truths);
                continue;
            }
            for (_, to, agent) in self.edges.iter().filter(|(from, ..)| *from as usize == state) {
                builder.edge(*to, Label(*agent));
            }
            builder.state(truths);
        }
        builder.finish()
    }
}

/// A fairness constraint, in terms of states and agents.
#[derive(Debug, Clone)]
pub enum Constraint {
    Justice(Vec<bool>),
    Compassion(Vec<bool>, Vec<bool>),
    Agent(u32, AgentFairness),
}

pub fn constraints(random: &mut Random, states: usize) -> Vec<Constraint> {
    let set = |random: &mut Random| (0..states).map(|_| random.chance(2)).collect::<Vec<bool>>();
    let kinds = [AgentFairness::Weak, AgentFairness::Strong];
    let number = random.below(4);
    let mut constraints = Vec::new();
    for _ in 0..number {
        constraints.push(match random.below(4) {
            0 => Constraint::Justice(set(random)),
            1 | 2 => Constraint::Compassion(set(random), set(random)),
            _ => Constraint::Agent(random.below(2) as u32, kinds[random.below(2)]),
        });
    }
    constraints
}

fn bits(set: &[bool]) -> StateSet {
    let mut bits = StateSet::none(set.len());
    set.iter().enumerate().filter(|(_, inside)| **inside).for_each(|(index, _)| {
        bits.insert(index as u32);
    });
    bits
}

pub fn fairness(graph: &Graph, constraints: &[Constraint]) -> Fairness {
    let mut fairness = Fairness::none();
    for constraint in constraints {
        match constraint {
            Constraint::Justice(set) => fairness.add_justice(graph, &bits(set)),
            Constraint::Compassion(first, second) => fairness.add_compassion(graph, &bits(first), &bits(second)),
            Constraint::Agent(agent, kind) => fairness.add_agent(graph, *kind, |state, edge| {
                graph.label(edge) == Label(*agent) && graph.target(edge) != state
            }),
        }
    }
    fairness
}

const CTL: [(TemporalOperator, usize); 17] = {
    use TemporalOperator::*;
    [
        (Ex, 1),
        (Ef, 1),
        (Eg, 1),
        (Ax, 1),
        (Af, 1),
        (Ag, 1),
        (Eu, 2),
        (Au, 2),
        (Ew, 2),
        (Aw, 2),
        (AbsenceGlobally, 1),
        (AbsenceBefore, 2),
        (AbsenceAfter, 2),
        (AbsenceBetween, 3),
        (AbsenceAfterUntil, 3),
        (Precedence, 2),
        (PrecedenceBefore, 3),
    ]
};

const FUTURE: [(TemporalOperator, usize); 5] = {
    use TemporalOperator::*;
    [(Next, 1), (Globally, 1), (Finally, 1), (Until, 2), (Releases, 2)]
};

const PAST: [(TemporalOperator, usize); 6] = {
    use TemporalOperator::*;
    [(Previous, 1), (WeakPrevious, 1), (Historically, 1), (Once, 1), (Since, 2), (Triggered, 2)]
};

#[derive(Clone, Copy)]
pub enum Operators {
    Ctl,
    Future,
    All,
}

pub fn formula<L: Logic>(random: &mut Random, table: &mut L, operators: Operators, depth: usize) -> FormulaId {
    if depth == 0 || random.chance(8) {
        return match random.below(9) {
            0 => table.constant(true),
            _ => table.proposition(random.below(PROPOSITIONS) as u32),
        };
    }
    let part = |random: &mut Random, table: &mut L| formula(random, table, operators, depth - 1);
    match random.below(10) {
        0 | 1 => {
            let inner = part(random, table);
            table.not(inner)
        }
        2 => {
            let (left, right) = (part(random, table), part(random, table));
            table.and(left, right)
        }
        3 => {
            let (left, right) = (part(random, table), part(random, table));
            table.or(left, right)
        }
        4 => {
            let (left, right) = (part(random, table), part(random, table));
            table.implies(left, right)
        }
        _ => {
            let (operator, arity) = match operators {
                Operators::Ctl => CTL[random.below(CTL.len())],
                Operators::Future => FUTURE[random.below(FUTURE.len())],
                Operators::All if random.chance(2) => PAST[random.below(PAST.len())],
                Operators::All => FUTURE[random.below(FUTURE.len())],
            };
            let parts: Vec<FormulaId> = (0..arity).map(|_| part(random, table)).collect();
            table.operator(operator, &parts).expect("an operator of the logic")
        }
    }
}
