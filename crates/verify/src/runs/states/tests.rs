//! Holds the graph that a search has walked to the one that is explored for itself.
//!
//! In: random models, and one with faults and states that an assumption leaves out; one, two and three workers. INVARIANT: states,
//! their numbers, their edges and what was not explored are the same. `GROUNDSTATE_CASES` sets how many models.

use std::panic::{AssertUnwindSafe, catch_unwind};

use machine::Limits;
use syntax::SourceFile;
use testkit::{NoFiles, sample};

use super::*;
use crate::explicit::search::Search;
use crate::heed::Heed;
use crate::plan::Plan;

fn lowered(text: &str) -> Option<Arc<Program>> {
    let checked = model::check(SourceFile::new("Model.asm", text), &mut NoFiles);
    let faults = checked.diagnostics.iter().any(|found| found.severity == syntax::Severity::Error);
    program::lower(&checked.model).ok().filter(|_| !faults).map(Arc::new)
}

/// What a search of these settings has walked.
fn walk(program: &Arc<Program>, source: &Source, workers: usize) -> Option<Walk> {
    let plan = Plan {
        settings: source.settings.clone(),
        assumed: source.assumed.clone(),
        workers,
        max_states: source.max_states,
        max_depth: source.max_depth,
        max_bytes: source.max_bytes,
        edges: true,
        ..Plan::default()
    };
    let mut heed = Heed { listener: &mut |_: &Progress| true, subjects: BTreeMap::new(), told: BTreeMap::new() };
    Search::run(program, &plan, None, &mut heed).ok()?.walk()
}

/// By state: its edges, and whether it counts as unexplored.
fn told(explored: &Exploration<'_>) -> (Vec<u64>, usize, Vec<Option<Vec<Row>>>) {
    let starts = std::iter::once(0).chain(explored.ends.iter().copied());
    let of = |(start, (end, cut)): (usize, (&usize, &bool))| (!cut).then(|| explored.rows[start..*end].to_vec());
    let mut rows: Vec<_> = starts.zip(explored.ends.iter().zip(&explored.cut)).map(of).collect();
    rows.resize(explored.states.len(), None);
    (explored.states.words().to_vec(), explored.initial, rows)
}

/// Holds the graph that a search has walked, alone and by several workers, to the one that is explored for itself; gives how
/// many edges were compared.
fn compare(text: &str, program: &Arc<Program>, settings: Settings, assumed: Vec<usize>) -> usize {
    let whole = u64::MAX;
    let source = |max_states| Source {
        program: Arc::clone(program),
        settings: settings.clone(),
        assumed: assumed.clone(),
        propositions: Vec::new(),
        inputs: BTreeSet::new(),
        scheduler: None,
        max_states,
        max_depth: whole,
        max_bytes: whole,
    };
    // A random model may have states without end.
    let few = source(100);
    let mut compared = 0;
    for workers in 1..4 {
        let Some(walked) = walk(program, &few, workers) else { return compared };
        let ended = walked.stop.is_none();
        assert!(ended || workers == 1, "{text}");
        let (interner, widening) = (Arc::clone(&walked.maker.interner), walked.maker.widening().clone());
        let Some(walked) = Exploration::walked(&few, walked) else {
            assert!(!ended, "{text}");
            return compared;
        };
        let walked = told(&walked);
        // Numbers of values are those of one interner.
        let explorer = Explorer::new(program, settings.clone(), &widening, &interner).expect("it has begun before");
        let words = explorer.words();
        let all = source(if ended { whole } else { (walked.0.len() / words) as u64 });
        let mut explored = Exploration::new(&all, explorer);
        explored.prepare();
        let mut next = 0;
        while next < explored.states.len() && next * words < walked.0.len() {
            explored.expand(next).expect("it has fitted before");
            next += 1;
        }
        let explored = told(&explored);
        assert_eq!(walked.1, explored.1, "initial states, {workers} workers: {text}");
        for (number, rows) in walked.2.iter().enumerate() {
            let is_there = rows.is_some() || ended;
            assert!(!is_there || *rows == explored.2[number], "edges of {number}, {workers} workers: {text}");
            compared += rows.as_ref().map_or(0, Vec::len);
        }
        let met = walked.0.len().min(explored.0.len());
        assert_eq!(walked.0[..met], explored.0[..met], "states, {workers} workers: {text}");
        assert!(!ended || walked.0 == explored.0, "states, {workers} workers: {text}");
    }
    compared
}

/// Functions of which each takes 32 bits of a state, so that states have several words.
const WIDE: &str = "controlled wideA: Integer controlled wideB: Integer controlled wideC: Integer\n";

#[test]
fn what_a_search_has_walked_is_what_is_explored() {
    // LIMIT: the model of seed 464 has a step with more alternatives than anybody waits for.
    let seeds = sample::seeds(150, 450);
    let cases = seeds.end - seeds.start;
    let (mut models, mut edges) = (0, 0);
    for seed in seeds {
        let text = oracle::generate::model(seed, 1).to_string();
        let Some(program) = lowered(&text) else { continue };
        let limits = Limits {
            iterations: 50,
            call_depth: 50,
            collection: 50,
            updates: 500,
            locations: 500,
            ..Limits::default()
        };
        let settings = Settings { limits, ..Settings::default() };
        let attempt = AssertUnwindSafe(|| compare(&text, &program, settings, Vec::new()));
        match catch_unwind(attempt) {
            Ok(compared) => edges += compared,
            Err(panic) => panic!("seed {seed}: {}", panic.downcast_ref::<String>().map_or("", String::as_str)),
        }
        models += 1;
    }
    assert!(models > cases / 3 && edges > 100, "{models} models, {edges} edges");
}

#[test]
fn states_left_out_and_faults_are_walked_past() {
    let text = format!(
        "asm Model import StandardLibrary signature: domain Small subsetof Integer\n{WIDE}\
         controlled x: Small controlled y: Small monitored m: Small monitored early: Boolean\n\
         definitions: domain Small = {{0 : 9}}\n invariant inv_x over x: x + y < 9\n\
         main rule r_Main = if early then x := m else if x = 7 then y := 1 mod (x - 7) else\n\
         par x := (x + m) mod 10 y := (y + 1) mod 10 wideA := x mod 1 wideB := x mod 1 wideC := x mod 1 endpar endif endif\n\
         default init s0: function x = 0 function y = 0 function wideA = 0 function wideB = 0 function wideC = 0"
    );
    let program = lowered(&text).expect("a model");
    let plain = compare(&text, &program, Settings::default(), Vec::new());
    let condition = program.properties[0].formula.clone();
    let settings = Settings { conditions: vec![condition], ..Settings::default() };
    let fewer = compare(&text, &program, settings, vec![0]);
    assert!(plain > fewer && fewer > 100, "{plain} edges, {fewer} where some states are left out");
}
