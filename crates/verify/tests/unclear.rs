//! Assumptions that cannot be evaluated: whether such a step or state counts is not known, so nothing that may depend on it is said.
//!
//! In: random walks whose assumptions are true, false or without a value. INVARIANT: *violated* is what a walk over the same tables meets by
//! steps that count; *holds* is said only where that walk meets nothing of which nobody knows.

use std::collections::BTreeSet;
use std::sync::Arc;

use program::Program;
use syntax::SourceFile;
use testkit::solver::solvers;
use testkit::{Random, sample};
use verify::solver::Method;
use verify::{EngineKind, Options, Outcome, Progress, Report, Request, Subject};

use crate::models::lowered;

const PLACES: u64 = 5;
const MOVES: u64 = 2;

/// What an assumption comes to, as the divisor that says so: 1 divided by it is 1, is another number, or is nothing.
const TRUE: u64 = 1;
const FALSE: u64 = 2;
const UNCLEAR: u64 = 0;

/// Where each move leads from each place (the place after the last one is none: a fault), and what the assumptions about places and about
/// moves come to.
struct Walk {
    leads: Vec<Vec<u64>>,
    of_place: Vec<u64>,
    of_move: Vec<Vec<u64>>,
}

/// What the walk over the tables meets.
struct Met {
    places: BTreeSet<u64>,
    /// Where the first move counts.
    first: BTreeSet<u64>,
    fault: bool,
    unclear: bool,
    /// A step does not count, or leads to a place that does not: a run may end there.
    ends: bool,
    /// Some step counts, or may.
    steps: bool,
}

impl Walk {
    fn random(random: &mut Random) -> Walk {
        let truth = |random: &mut Random, rarely: u64| match random.below(rarely) {
            0 => UNCLEAR,
            1 => FALSE,
            _ => TRUE,
        };
        let rarely = 4 + random.below(12);
        let of_place = (0..PLACES).map(|place| if place == 0 { TRUE } else { truth(random, rarely) }).collect();
        let of_move = (0..PLACES).map(|_| (0..MOVES).map(|_| truth(random, rarely)).collect()).collect();
        let leads = (0..PLACES).map(|_| (0..MOVES).map(|_| random.below(PLACES * 12) / 11).collect()).collect();
        Walk { leads, of_place, of_move }
    }

    fn model(&self) -> String {
        let table = |of: &dyn Fn(usize, usize) -> u64| {
            let rows = (0..PLACES as usize).flat_map(|place| (0..MOVES as usize).map(move |by| (place, by)));
            rows.map(|(place, by)| format!("case ({place}, {by}): {} ", of(place, by))).collect::<String>()
        };
        let (leads, of_move) = (table(&|at, by| self.leads[at][by]), table(&|at, by| self.of_move[at][by]));
        let of_place: String = (0..PLACES as usize).map(|at| format!("case {at}: {} ", self.of_place[at])).collect();
        let never = |place: u64| {
            format!(
                "\tinvariant inv_{place} over place: place != {place}\n\tCTLSPEC ctlSpec_{place}: ag(place != {place})\n\
                 \tLTLSPEC ltlSpec_{place}: g(place != {place})\n\
                 \tLTLSPEC ltlSpec_by_{place}: g(place != {place} or by != 0)\n"
            )
        };
        let never: String = (0..PLACES).map(never).collect();
        format!(
            "asm Walk\nimport StandardLibrary\nimport CTLLibrary\nimport LTLLibrary\nsignature:\n\tdomain Place subsetof Integer\n\
             \tdomain Move subsetof Integer\n\tmonitored by: Move\n\tcontrolled place: Place\n\
             \tstatic leads: Prod(Place, Move) -> Integer\n\tstatic ofMove: Prod(Place, Move) -> Integer\n\tstatic ofPlace: Place -> Integer\n\
             definitions:\n\tdomain Place = {{0 : {}}}\n\tdomain Move = {{0 : {}}}\n\
             \tfunction leads($p in Place, $m in Move) = switch ($p, $m) {leads}endswitch\n\
             \tfunction ofMove($p in Place, $m in Move) = switch ($p, $m) {of_move}endswitch\n\
             \tfunction ofPlace($p in Place) = switch $p {of_place}endswitch\n\
             \tINVAR idiv(1, ofPlace(place)) = 1\n\tINVAR idiv(1, ofMove(place, by)) = 1\n{never}\
             \tmain rule r_Main = place := leads(place, by)\ndefault init s0:\n\tfunction place = 0\n",
            PLACES - 1,
            MOVES - 1
        )
    }

    fn met(&self) -> Met {
        let mut met = Met {
            places: BTreeSet::from([0]),
            first: BTreeSet::new(),
            fault: false,
            unclear: false,
            ends: false,
            steps: false,
        };
        let mut open = vec![0];
        while let Some(at) = open.pop() {
            for by in 0..MOVES as usize {
                let (of_move, to) = (self.of_move[at as usize][by], self.leads[at as usize][by]);
                let truth = match (of_move, to) {
                    (TRUE, to) if to < PLACES => self.of_place[to as usize],
                    (truth, _) => truth,
                };
                met.steps |= truth != FALSE;
                met.ends |= truth == FALSE;
                if by == 0 && truth == TRUE {
                    met.first.insert(at);
                }
                match truth {
                    UNCLEAR => met.unclear = true,
                    FALSE => {}
                    _ if to == PLACES => met.fault = true,
                    _ if met.places.insert(to) => open.push(to),
                    _ => {}
                }
            }
        }
        met
    }
}

/// How often it was said that something holds, that it is violated, and that nothing is known.
type Count = [u64; 3];

/// Holds each verdict of a report to the walk; a search that goes through all states has to say what can be said, and of a step's fault, too.
fn judge(program: &Program, report: &Report, met: &Met, searches: bool, count: &mut Count, told: &str) {
    for verdict in &report.verdicts {
        let violated = match verdict.subject {
            Subject::InDomain => met.fault,
            // An assumption at fault is none of the program.
            Subject::Defined => false,
            Subject::Property(index) => {
                let name = &program.properties[index].name;
                let Some((_, place)) = name.rsplit_once('_') else { continue };
                let met = if name.contains("_by_") { &met.first } else { &met.places };
                met.contains(&place.parse().expect("a number"))
            }
            _ => continue,
        };
        let of_runs =
            matches!(verdict.subject, Subject::Property(index) if !program.properties[index].name.starts_with("inv"));
        match &verdict.outcome {
            Outcome::Holds => assert!(!violated && !met.unclear, "{:?} holds\n{told}", verdict.subject),
            Outcome::Violated(_) => assert!(violated, "{:?} is violated\n{told}", verdict.subject),
            Outcome::Unknown(reasons) => {
                let excuse = met.unclear || !searches || !met.steps || of_runs && (met.fault || met.ends);
                assert!(excuse && (!searches || !violated || of_runs), "{:?}: {reasons:?}\n{told}", verdict.subject);
            }
        }
        let kind = match verdict.outcome {
            Outcome::Holds => 0,
            Outcome::Violated(_) => 1,
            Outcome::Unknown(_) => 2,
        };
        count[kind] += 1;
    }
}

fn ask(program: &Arc<Program>, options: Options, solver: &mut dyn solve::session::Solvers) -> Report {
    let request = Request::of(program, options).build().expect("nothing is in conflict");
    request.verify(solver, &mut |_: &Progress| true).expect("the first place is assumed")
}

#[test]
fn searches_say_what_counts_and_no_more() {
    let mut count = Count::default();
    for seed in sample::seeds(60, 1_500) {
        let walk = Walk::random(&mut Random(seed));
        let (text, met) = (walk.model(), walk.met());
        let program = lowered(SourceFile::new("Walk.asm", text.clone()));
        for options in [
            Options::default(),
            Options { workers: 2, alone: Some(0), ..Options::default() },
            Options { forgetful: true, ..Options::default() },
            Options { steps: machine::EngineChoice::Interpreted, ..Options::default() },
            Options { engine: EngineKind::Symbolic, max_bytes: 8 << 20, ..Options::default() },
        ] {
            let told = format!("seed {seed}, {:?}, {} workers\n{text}", options.engine, options.workers);
            let report = verify::verify(&program, &options, &mut |_| true).expect("the first place is assumed");
            judge(&program, &report, &met, true, &mut count, &told);
        }
    }
    assert!(count.iter().all(|kind| *kind >= 100), "there is something of each: {count:?}");
}

#[test]
fn solvers_say_no_more_than_counts() {
    let mut count = Count::default();
    for seed in sample::seeds(8, 150) {
        let walk = Walk::random(&mut Random(seed));
        let (text, met) = (walk.model(), walk.met());
        let program = lowered(SourceFile::new("Walk.asm", text.clone()));
        for method in [Method::Bounded, Method::Induction, Method::Reachability, Method::Portfolio] {
            let horn = matches!(method, Method::Reachability | Method::Portfolio);
            for solver in &mut solvers(horn) {
                let options = Options { engine: EngineKind::Solver(method), max_depth: 12, ..Options::default() };
                let told = format!("seed {seed}, {method:?}\n{text}");
                judge(&program, &ask(&program, options, solver), &met, false, &mut count, &told);
            }
        }
    }
    assert!(count.iter().all(|kind| *kind >= 20), "there is something of each: {count:?}");
}
