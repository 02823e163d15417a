//! A listing has the states and steps that a search counts, whole or with the reason why not.

#![allow(clippy::disallowed_methods, reason = "a test reads the repository's own models")]

use std::collections::BTreeSet;
use std::sync::Arc;

use program::Program;
use syntax::SourceFile;
use testkit::repository;
use verify::listing::{Leads, Listing, list};
use verify::{Options, Stop, verify};

use crate::models::{Disk, lowered};

fn program(name: &str) -> Arc<Program> {
    let path = repository::root().join(format!("bench/models/verify/{name}.asm"));
    lowered(Disk::read(&path).expect("the model is there"))
}

fn listed(program: &Arc<Program>, options: &Options) -> Listing {
    list(program, options, &[], &mut |_| true).expect("there is an initial state")
}

/// How many states its steps reach from the initial ones.
fn reached(listing: &Listing) -> usize {
    let initial = (0..listing.states.len()).filter(|state| listing.states[*state].is_initial);
    let mut seen: BTreeSet<usize> = initial.collect();
    let mut next: Vec<usize> = seen.iter().copied().collect();
    while let Some(state) = next.pop() {
        for step in &listing.states[state].steps {
            if let Leads::To(to) = step.leads
                && seen.insert(to)
            {
                next.push(to);
            }
        }
    }
    seen.len()
}

#[test]
fn it_has_as_many_states_as_a_search() {
    let models = std::fs::read_dir(repository::root().join("bench/models/verify")).expect("there are models");
    let names = models.filter_map(|entry| entry.ok()?.file_name().to_str()?.strip_suffix(".asm").map(str::to_string));
    let mut compared = 0;
    for name in names.collect::<BTreeSet<_>>() {
        let program = program(&name);
        if program.main.is_none() {
            continue;
        }
        let bounded = Options { max_states: 3_000, ..Options::default() };
        let Ok(report) = verify(&program, &bounded, &mut |_| true) else { continue };
        if !report.complete || report.progress.states > 2_000 {
            continue;
        }
        let listing = listed(&program, &Options { max_states: 2_000, ..Options::default() });
        assert!(listing.is_complete(), "{name}: {:?}", listing.stop);
        assert_eq!(listing.states.len() as u64, report.progress.states, "{name}");
        assert_eq!(reached(&listing), listing.states.len(), "{name}");
        // The same with as much room as it needs, and not with less.
        let count = listing.states.len() as u64;
        assert_eq!(listed(&program, &Options { max_states: count, ..Options::default() }), listing, "{name}");
        if count > 1 {
            let less = listed(&program, &Options { max_states: count - 1, ..Options::default() });
            assert_eq!((less.is_complete(), less.stop), (false, Some(Stop::States)), "{name}");
            assert!(less.states.iter().any(|state| !state.is_whole), "{name}");
        }
        compared += 1;
    }
    assert!(compared >= 3, "{compared}");
}

const COUNTER: &str = "asm Counter
import StandardLibrary
signature:
	domain Small subsetof Integer
	controlled count: Small
	monitored up: Boolean
definitions:
	domain Small = { 0 : 3 }
	invariant inv_low over count: count < 3
	main rule r_Main = choose $d in { 1, 2 } with true do if up then count := count + $d endif
default init s0:
	function count = 0
";

#[test]
fn steps_say_where_they_lead_and_how() {
    let program = lowered(SourceFile::new("Counter.asm", COUNTER));
    let low = program.properties[0].formula.clone();
    let listing = list(&program, &Options::default(), &[low], &mut |_| true).expect("there is an initial state");
    assert_eq!(listing.states.len(), 4);
    let leads = |state: usize| -> Vec<Option<usize>> {
        let steps = listing.states[state].steps.iter();
        steps.map(|step| if let Leads::To(to) = step.leads { Some(to) } else { None }).collect()
    };
    // States are numbered by distance; from 2 on a step may leave the domain.
    let depths: Vec<u64> = listing.states.iter().map(|state| state.depth).collect();
    assert_eq!(depths, [0, 1, 1, 2]);
    assert_eq!(leads(0), [Some(0), Some(1), Some(2)]);
    assert!(leads(3).contains(&None) && leads(3).contains(&Some(3)));
    // Not pressed, each choice leads back to the state itself.
    let rests = listing.states[0].steps.iter().find(|step| step.leads == Leads::To(0)).expect("it may rest");
    assert_eq!((rests.ways, rests.inputs.len(), rests.choices.len()), (2, 1, 1));
    let violated: Vec<usize> = listing.states.iter().map(|state| state.violated.len()).collect();
    assert_eq!(violated, [0, 0, 0, 1]);
    let holds: Vec<Option<bool>> = listing.states.iter().map(|state| state.holds[0]).collect();
    assert_eq!(holds, [Some(true), Some(true), Some(true), Some(false)]);
    assert!(listing.is_complete());
}

#[test]
fn what_ends_it_is_told() {
    let program = lowered(SourceFile::new("Counter.asm", COUNTER));
    let shallow = listed(&program, &Options { max_depth: 1, ..Options::default() });
    assert_eq!((shallow.states.len(), shallow.stop), (3, Some(Stop::Depth)));
    assert!(!shallow.is_complete() && shallow.states[0].is_whole && !shallow.states[1].is_whole);
    let mut looks = 0;
    let stopped = list(&program, &Options::default(), &[], &mut |_| {
        looks += 1;
        looks < 2
    });
    let stopped = stopped.expect("there is an initial state");
    assert_eq!((stopped.stop, stopped.is_complete()), (Some(Stop::Asked), false));
}

#[test]
fn what_is_assumed_leaves_out_states_and_steps() {
    let assumed = COUNTER.replace("invariant inv_low over count: count < 3", "INVAR count < 2 INVAR up or count = 0");
    let listing = listed(&lowered(SourceFile::new("Counter.asm", assumed)), &Options::default());
    assert_eq!(listing.states.len(), 2);
    assert_eq!(listing.states[1].steps, []);
}
