//! On random pairs of small machines, of which segments end where a flag is not set, the verdict is that of an independent judge.
//!
//! It goes over all pairs again and again until nothing changes, follows each way of the concrete machine to the end of its segment, and
//! asks of one that is longer than a diagram whether a circle without an end can be reached. `GROUNDSTATE_FULL` takes 2000 pairs.

#![allow(clippy::disallowed_methods, reason = "a test reads the environment")]

use std::collections::BTreeSet;

use refine::{ABSTRACT, CONCRETE, Ended, Verdict, Why};
use testkit::Random;

use crate::naive::{Fair, Graph, Pairs, State, again, changed, graph, has_fair_round, machine_of, rule};
use crate::small::{COUNTER, counter, lamp, machine, program, refuted, report};

/// A diagram has one abstract step and so many concrete ones.
const LONGEST: usize = 4;

/// The steps between states within a segment that can be reached from one.
fn within(graph: &Graph, from: State) -> Graph {
    let mut reached = BTreeSet::from([from]);
    let mut open = vec![from];
    while let Some(state) = open.pop() {
        let next = [false, true].into_iter().flat_map(|go| graph[&(state, go)].iter().copied());
        open.extend(next.filter(|next| next.1).filter(|next| reached.insert(*next)));
    }
    let inside = |to: &BTreeSet<State>| to.iter().copied().filter(|next| next.1).collect();
    let own = graph.iter().filter(|((state, _), _)| reached.contains(state));
    own.map(|(from, to)| (*from, inside(to))).collect()
}

struct Judge<'g> {
    graphs: [&'g Graph; 2],
    fair: &'g [Fair],
    /// A segment that is too long counts as answered, if it ends.
    hopeful: bool,
    related: Pairs,
}

impl Judge<'_> {
    /// Whether each way from here to the end of the segment is answered, where these inputs came before.
    fn answers(&self, from: State, at: State, before: &[bool]) -> bool {
        [false, true].into_iter().all(|go| {
            let inputs = [before, &[go]].concat();
            self.graphs[CONCRETE][&(at, go)].iter().all(|next| match next.1 {
                false => {
                    let mut there = inputs.iter().flat_map(|go| &self.graphs[ABSTRACT][&(from, *go)]);
                    there.any(|there| self.related.contains(&(*there, *next)))
                }
                true if inputs.len() == LONGEST => {
                    self.hopeful && !has_fair_round(&within(self.graphs[CONCRETE], *next), self.fair)
                }
                true => self.answers(from, *next, &inputs),
            })
        })
    }

    fn refines(mut self, begun: (State, State)) -> bool {
        let states = |graph: &Graph| graph.keys().map(|(state, _)| *state).collect::<BTreeSet<State>>();
        for one in states(self.graphs[ABSTRACT]) {
            let ends = states(self.graphs[CONCRETE]).into_iter().filter(|other| !other.1 && other.0 == one.0);
            self.related.extend(ends.map(|other| (one, other)));
        }
        loop {
            let kept: Pairs =
                self.related.iter().copied().filter(|(one, other)| self.answers(*one, *other, &[])).collect();
            if kept == self.related {
                return kept.contains(&begun);
            }
            self.related = kept;
        }
    }
}

fn agree(coupling: &str, fair: &[Fair], some_are_endless: bool) {
    let full = testkit::sample::is_full();
    let pairs = if full { 2000 } else { 150 };
    let [mut refines, mut refuted, mut endless, mut unknown] = [0; 4];
    for seed in 0..pairs {
        let mut random = Random(seed * 6007 + 11);
        let one = rule(&mut random);
        let other = match random.below(3) {
            0 => rule(&mut random),
            1 => changed(&mut random, &one),
            _ => format!("if h then {} else {one} endif", rule(&mut random)),
        };
        let programs = [machine_of(&one), machine_of(&other)];
        let [first, second] = [graph(&programs[0]), graph(&programs[1])];
        let judge = |hopeful: bool| Judge { graphs: [&first.1, &second.1], fair, hopeful, related: Pairs::new() };
        let begun = (first.0, second.0);
        let found = report(&programs[0], &programs[1], Some(coupling));
        let of = || format!("seed {seed}\n{one}\n{other}\n{found:#?}");
        match &found.verdict {
            Verdict::Vacuous(_) => {}
            Verdict::Refines => {
                refines += 1;
                assert!(judge(false).refines(begun), "{}", of());
            }
            Verdict::Unknown(whys) => {
                unknown += 1;
                assert_eq!(whys[..], [Why::Long(LONGEST as u32)], "{}", of());
                assert!(judge(true).refines(begun) && !judge(false).refines(begun), "{}", of());
            }
            Verdict::DoesNot(refutation) => {
                refuted += 1;
                assert!(!judge(true).refines(begun), "{}", of());
                let states = again(&programs[CONCRETE], &refutation.runs[CONCRETE]);
                if let Ended::Endless(turn) = refutation.ended {
                    endless += 1;
                    assert_eq!(states.last(), Some(&states[turn]), "{}", of());
                    let begun: usize = refutation.segments.iter().map(|segment| segment.n).sum();
                    assert!(begun <= turn && states[begun + 1..].iter().all(|state| state.1), "{}", of());
                }
            }
        }
    }
    assert!(
        refines > 5 && refuted > 5 && (endless > 1) == some_are_endless,
        "{coupling}: {refines} {refuted} {endless} {unknown}"
    );
}

#[test]
fn segments_that_never_end_are_those_of_a_naive_judge() {
    agree("same n; segment not concrete.h; diagrams 1:1..4;", &[], true);
}

#[test]
fn so_it_is_where_runs_are_fair() {
    agree("same n; segment not concrete.h; diagrams 1:1..4; fair concrete.go;", &[|go, _| go], true);
    let coupling = "same n; segment not concrete.h; diagrams 1:1..4; fair concrete.go; fair concrete.n != 0;";
    agree(coupling, &[|go, _| go, |_, (n, _)| n != 0], true);
    // Within a segment the flag is set.
    agree("same n; segment not concrete.h; diagrams 1:1..4; fair not concrete.h;", &[|_, (_, h)| !h], false);
}

/// A model's own fairness is about its segments, also where waiting is allowed.
#[test]
fn a_segment_that_ends_in_fair_runs_is_not_refuted() {
    let coupled = |said: &str, more: &str| {
        let text = |said: &str, rule: &str| {
            format!(
                "asm M\nimport StandardLibrary\nimport CTLLibrary\nsignature:\nmonitored ready: Boolean\ncontrolled on: Boolean\n\
                 controlled busy: Boolean\ndefinitions:\n{said}\nmain rule r_Main = {rule}\ndefault init s0:\n\
                 function on = false\nfunction busy = false\n"
            )
        };
        let one = program("M", &text("", "on := not on"));
        let other =
            "if not busy then busy := true else if ready then par busy := false on := not on endpar endif endif";
        let other = program("M", &text(said, other));
        let coupling = format!("same on; segment not concrete.busy; diagrams 0..1:1..3; allow waiting; {more}");
        report(&one, &other, Some(&coupling))
    };
    let waits = |said: &str| coupled(said, "");
    assert_eq!(coupled("", "fair concrete.ready;").verdict, Verdict::Unknown(vec![Why::Long(3)]));
    assert_eq!(refuted(waits("")).ended, Ended::Endless(1));
    assert_eq!(waits("JUSTICE ready").verdict, Verdict::Unknown(vec![Why::Long(3)]));
    let unfair = waits("JUSTICE not ready");
    assert_eq!(unfair.assumed.len(), 1);
    assert_eq!(refuted(unfair).ended, Ended::Endless(1));
}

/// An answer that a diagram allows is told, also where one that none allows comes to the same state.
#[test]
fn the_answer_that_is_allowed_is_told() {
    let one = machine("controlled on: Boolean", "main rule r_Main = on := not on", "function on = false");
    let signature = "domain K subsetof Integer controlled on: Boolean controlled k: K";
    let rule = "domain K = {0:2} main rule r_Main = if k < 2 then k := k + 1 else par k := 0 on := true endpar endif";
    let other = machine(signature, rule, "function on = false function k = 0");
    let refutation = refuted(report(&one, &other, Some("same on; segment concrete.k = 0; diagrams 2:3;")));
    let Ended::Unmatched { tried, .. } = refutation.ended else { panic!() };
    assert!(tried.iter().any(|tried| tried.steps.len() == 2 && !tried.parts.is_empty()), "{tried:#?}");
}

#[test]
fn a_segment_that_no_diagram_has_is_refuted() {
    let one = counter("n := (n + 1) mod 4");
    let refutation = refuted(report(&one, &one, Some("same n; segment true; diagrams 1:2;")));
    assert!(matches!(refutation.ended, Ended::Unmatched { .. }), "{:?}", refutation.ended);
}

#[test]
fn a_segment_that_never_ends_is_refuted_by_its_circle() {
    let one = counter("n := (n + 1) mod 4");
    let refutation = refuted(report(&one, &one, Some("same n; segment concrete.n = 7;")));
    assert_eq!((refutation.ended, refutation.runs[CONCRETE].steps.len()), (Ended::Endless(0), 4));
    // A long one may end in a longer diagram.
    let two = machine(COUNTER, "domain N = {0:40}\nmain rule r_Main = n := (n + 1) mod 41", "function n = 0");
    let found = report(&two, &two, Some("same n; segment concrete.n = 0;"));
    assert_eq!(found.verdict, Verdict::Unknown(vec![refine::Why::Long(16)]));
    // Where it ends in each fair run, and maybe late, it is not known.
    let waits = |fair: &str| {
        let other = lamp("if pressed then on := not on endif");
        let coupling = format!("same on; segment concrete.on; diagrams 0..1:1..3; {fair}");
        report(&lamp("choose $x in {true, false} with true do on := $x"), &other, Some(&coupling))
    };
    assert_eq!(refuted(waits("")).ended, Ended::Endless(0));
    assert!(matches!(waits("fair concrete.on;").verdict, Verdict::Unknown(_)));
    let of = waits("fair concrete.pressed or not concrete.on;");
    assert_eq!(of.assumed.len(), 1, "the round meets what is fair");
    assert_eq!(refuted(of).ended, Ended::Endless(0));
}
