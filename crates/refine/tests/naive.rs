//! On random pairs of small machines the verdict is that of an independent judge.
//!
//! The judge runs a machine on its own, with an odometer for inputs and choices, until it has both graphs whole. It then looks for the
//! largest relation by going over all pairs again and again, until nothing changes: each concrete step must be matched by one step, or by
//! none, of an abstract machine with the same inputs, and it counts how long it may still wait. `GROUNDSTATE_FULL` takes 2000 pairs.

#![allow(clippy::disallowed_methods, reason = "a test reads the environment")]

use std::collections::{BTreeMap, BTreeSet};
use std::sync::Arc;

use machine::{Choice, Environment, Limits, LocationRef, Machine, TimeUnit, Value};
use program::{DomainId, Program};
use refine::{Ended, Vacuous, Verdict};
use testkit::Random;

use crate::small::{program, report};

/// A random machine over `n` in 0..2, which is observed, a hidden flag and an input: the text of its main rule.
pub fn rule(random: &mut Random) -> String {
    let update = |random: &mut Random| -> String {
        match random.below(8) {
            0 => "skip".to_string(),
            1 => "h := not h".to_string(),
            2 => "choose $x in N with true do n := $x".to_string(),
            3 => format!("choose $x in N with $x != {} do n := $x", random.below(3)),
            4 => "par n := (n + 1) mod 3 h := not h endpar".to_string(),
            5 => format!("par n := {} h := true endpar", random.below(3)),
            6 => "n := (n + 1) mod 3".to_string(),
            _ => format!("n := {}", random.below(3)),
        }
    };
    let guard = |random: &mut Random| match random.below(6) {
        0 => "go".to_string(),
        1 => "h".to_string(),
        2 => "go and h".to_string(),
        3 => format!("n = {}", random.below(3)),
        4 => format!("n != {} or go", random.below(3)),
        _ => format!("not h and n < {}", random.below(3)),
    };
    let mut text = update(random);
    for _ in 0..random.below(3) + 1 {
        let (guard, then) = (guard(random), update(random));
        text = format!("if {guard} then {then} else {text} endif");
    }
    text
}

/// The same rule with one word changed: often a refinement still, often just not.
pub fn changed(random: &mut Random, rule: &str) -> String {
    let swaps = [
        ("n := 1", "n := 2"),
        ("go and h", "go"),
        ("not h and", "h and"),
        ("h := true", "h := not h"),
        ("$x != 0", "true"),
        ("with true", "with $x != 1"),
        ("h := not h", "skip"),
        ("if go", "if h"),
        ("mod 3 h := not h", "mod 3 h := false"),
        ("skip", "h := not h"),
    ];
    let (from, to) = swaps[random.below(swaps.len() as u64) as usize];
    rule.replacen(from, to, 1)
}

pub fn machine_of(rule: &str) -> Arc<Program> {
    machine_with(rule, "")
}

/// The same with more definitions before the main rule.
pub fn machine_with(rule: &str, definitions: &str) -> Arc<Program> {
    let text = format!(
        "asm M\nimport StandardLibrary\nsignature:\ndomain N subsetof Integer\nmonitored go: Boolean\ncontrolled n: N\n\
         controlled h: Boolean\ndefinitions:\ndomain N = {{0:2}}\n{definitions}\nmain rule r_Main = {rule}\n\
         default init s0: function n = 0 function h = false\n"
    );
    program("M", &text)
}

/// Gives the answers that it has noted, then the first ones.
#[derive(Default)]
struct Odometer {
    answers: Vec<(usize, usize)>,
    at: usize,
    go: Option<bool>,
}

impl Odometer {
    fn ask(&mut self, of: usize) -> usize {
        if self.at == self.answers.len() {
            self.answers.push((0, of));
        }
        self.at += 1;
        self.answers[self.at - 1].0
    }

    fn next(&mut self) -> bool {
        (self.at, self.go) = (0, None);
        while let Some((taken, of)) = self.answers.pop() {
            if taken + 1 < of {
                self.answers.push((taken + 1, of));
                return true;
            }
        }
        false
    }
}

impl Environment for Odometer {
    fn monitored(&mut self, _: &Program, _: LocationRef<'_>, _: DomainId) -> Result<Value, String> {
        let go = self.ask(2) == 1;
        self.go = Some(go);
        Ok(Value::Boolean(go))
    }

    fn choose(&mut self, _: &Program, choice: &Choice<'_>) -> Result<usize, String> {
        Ok(self.ask(choice.candidates()))
    }

    fn time(&mut self, _: TimeUnit) -> Result<i64, String> {
        Err("no clock".to_string())
    }
}

pub type State = (i64, bool);

/// By state and value of the input, where steps lead.
pub type Graph = BTreeMap<(State, bool), BTreeSet<State>>;

fn state(machine: &Machine) -> State {
    let of = |name: &str| {
        let function = machine.find_function(name, 0).expect("it is declared");
        machine.value(&machine::Location { function, arguments: Vec::new() })
    };
    match (of("n"), of("h")) {
        (Value::Integer(n), Value::Boolean(h)) => (n, h),
        other => panic!("{other:?}"),
    }
}

pub fn graph(program: &Arc<Program>) -> (State, Graph) {
    let mut machine = Machine::new(Arc::clone(program), Limits::default());
    machine.start(&mut machine::Closed).expect("it begins");
    let (first, begun) = (state(&machine), machine.snapshot());
    let mut graph = Graph::new();
    let mut open = vec![(first, begun)];
    let mut seen = BTreeSet::from([first]);
    while let Some((from, snapshot)) = open.pop() {
        let mut odometer = Odometer::default();
        loop {
            machine.restore(&snapshot);
            machine.step(&mut odometer).expect("no step is a fault");
            let to = state(&machine);
            // An input that was not looked at may have had either value.
            let inputs = odometer.go.map_or(vec![false, true], |go| vec![go]);
            for go in inputs {
                graph.entry((from, go)).or_default().insert(to);
            }
            if seen.insert(to) {
                open.push((to, machine.snapshot()));
            }
            if !odometer.next() {
                break;
            }
        }
    }
    (first, graph)
}

/// The states that one or two steps lead to, each with one of these inputs.
fn steps(graph: &Graph, from: State, inputs: &[bool], most: usize) -> BTreeSet<State> {
    let mut last = BTreeSet::from([from]);
    let mut all = BTreeSet::new();
    for _ in 0..most {
        last = last.iter().flat_map(|at| inputs.iter().flat_map(|go| graph[&(*at, *go)].clone())).collect();
        all.extend(last.clone());
    }
    all
}

/// What the abstract machine's input is, given the concrete machine's and its state.
pub type Mapped = fn(bool, State) -> bool;

/// A condition of fairness on a step of the concrete machine: by its input and the state that it is made in.
pub type Fair = fn(bool, State) -> bool;

/// Whether the concrete graph is simulated: one step, or one or two, by at most as many, with finitely many waits between steps; or with
/// as many as you like of which some condition of fairness is true in finitely many steps alone.
fn simulated(one: &(State, Graph), other: &(State, Graph), most: usize, mapped: Mapped, fair: &[Fair]) -> bool {
    let states = |graph: &Graph| graph.keys().map(|(state, _)| *state).collect::<BTreeSet<_>>();
    let mut related: BTreeSet<(State, State)> = BTreeSet::new();
    for a in states(&one.1) {
        related.extend(states(&other.1).into_iter().filter(|c| c.0 == a.0).map(|c| (a, c)));
    }
    loop {
        // Whatever the concrete machine does, the abstract one steps to a related pair; or waits and comes to a pair of the first set, or, if
        // the condition was not met, to one of the second.
        let good = |(a, c): (State, State), waits: &Pairs, avoids: Option<(&Pairs, Fair)>| {
            let ends = |inputs: &[bool], next: State, met: bool| {
                let there = steps(&one.1, a, inputs, most);
                there.into_iter().any(|there| related.contains(&(there, next)))
                    || waits.contains(&(a, next))
                    || avoids.is_some_and(|(pairs, _)| !met && pairs.contains(&(a, next)))
            };
            let meets = |go: bool, state: State| avoids.is_some_and(|(_, fair)| fair(go, state));
            [false, true].into_iter().all(|go| {
                other.1[&(c, go)].iter().all(|next| {
                    let again = |further: bool| {
                        let met = meets(go, c) || meets(further, *next);
                        let mut after = other.1[&(*next, further)].iter();
                        after.all(|last| ends(&[mapped(go, c), mapped(further, *next)], *last, met))
                    };
                    ends(&[mapped(go, c)], *next, meets(go, c)) || (most > 1 && [false, true].into_iter().all(again))
                })
            })
        };
        let mut waits = Pairs::new();
        loop {
            let mut grown = waits.clone();
            grown.extend(related.iter().filter(|pair| good(**pair, &waits, None)));
            for fair in fair {
                let mut avoids = related.clone();
                loop {
                    let kept: Pairs =
                        avoids.iter().copied().filter(|pair| good(*pair, &grown, Some((&avoids, *fair)))).collect();
                    if kept == avoids {
                        break;
                    }
                    avoids = kept;
                }
                grown.extend(avoids);
            }
            if grown == waits {
                break;
            }
            waits = grown;
        }
        if waits == related {
            return related.contains(&(one.0, other.0));
        }
        related = waits;
    }
}

pub type Pairs = BTreeSet<(State, State)>;

/// Whether some round in a graph meets all conditions, wherever it begins.
pub fn has_fair_round(graph: &Graph, fair: &[Fair]) -> bool {
    let states: BTreeSet<State> = graph.keys().map(|(state, _)| *state).collect();
    states.into_iter().any(|first| {
        let mut open = vec![(first, vec![false; fair.len()])];
        let mut seen = BTreeSet::new();
        while let Some((state, met)) = open.pop() {
            for go in [false, true] {
                let met: Vec<bool> = met.iter().zip(fair).map(|(met, fair)| *met || fair(go, state)).collect();
                for next in &graph[&(state, go)] {
                    if *next == first && met.iter().all(|met| *met) {
                        return true;
                    }
                    if seen.insert((*next, met.clone())) {
                        open.push((*next, met.clone()));
                    }
                }
            }
        }
        false
    })
}

/// The conditions of fairness in a coupling.
fn texts_of(coupling: &str) -> impl Iterator<Item = &str> {
    coupling.split(';').filter_map(|statement| statement.trim().strip_prefix("fair "))
}

/// Makes a run again; returns the states that it goes through.
pub fn again(program: &Arc<Program>, run: &refine::Run) -> Vec<State> {
    struct Given<'t>(&'t explore::Told, usize);
    impl Environment for Given<'_> {
        fn monitored(&mut self, _: &Program, at: LocationRef<'_>, _: DomainId) -> Result<Value, String> {
            let found = self.0.inputs.iter().find(|(location, _)| location.borrowed() == at);
            found.map(|(_, value)| value.clone()).ok_or_else(|| "not given".to_string())
        }
        fn choose(&mut self, _: &Program, choice: &Choice<'_>) -> Result<usize, String> {
            let wanted = self.0.choices.get(self.1).ok_or("not made")?;
            self.1 += 1;
            (0..choice.candidates()).find(|at| choice.candidate(*at) == wanted.values).ok_or("none".to_string())
        }
        fn time(&mut self, _: TimeUnit) -> Result<i64, String> {
            Err("no clock".to_string())
        }
    }
    let mut machine = Machine::new(Arc::clone(program), Limits::default());
    machine.start(&mut Given(&run.start, 0)).expect("it begins");
    let mut states = vec![state(&machine)];
    for told in &run.steps {
        machine.step(&mut Given(told, 0)).expect("the step is made again");
        states.push(state(&machine));
    }
    states
}

#[test]
fn the_verdict_is_that_of_a_naive_judge() {
    agree(1, "same n;", |go, _| go, &[]);
}

#[test]
fn so_it_is_where_diagrams_have_two_steps() {
    agree(2, "same n; diagrams 0..2:1..2;", |go, _| go, &[]);
}

#[test]
fn so_it_is_where_an_input_is_computed_from_inputs() {
    agree(1, "same n; input abstract.go = not concrete.go;", |go, _| !go, &[]);
    agree(1, "same n; input abstract.go = concrete.go and concrete.h;", |go, (_, h)| go && h, &[]);
    agree(1, "same n; input abstract.go = (concrete.go or concrete.n = 1);", |go, (n, _)| go || n == 1, &[]);
    let two = "same n; diagrams 0..2:1..2; input abstract.go = (concrete.go iff concrete.h);";
    agree(2, two, |go, (_, h)| go == h, &[]);
}

#[test]
fn so_it_is_where_runs_are_fair() {
    let pressed: Fair = |go, _| go;
    let hidden: Fair = |_, (_, h)| h;
    let shown: Fair = |_, (_, h)| !h;
    let both: Fair = |go, (_, h)| go && h;
    agree(1, "same n; fair concrete.go;", |go, _| go, &[pressed]);
    agree(1, "same n; fair concrete.h;", |go, _| go, &[hidden]);
    agree(1, "same n; fair concrete.h; fair not concrete.h; fair concrete.go;", |go, _| go, &[hidden, shown, pressed]);
    agree(2, "same n; diagrams 0..2:1..2; fair concrete.go and concrete.h;", |go, _| go, &[both]);
    agree(2, "same n; diagrams 0..2:1..2; fair concrete.h; fair not concrete.h;", |go, _| go, &[hidden, shown]);
}

/// Bounds make it not known, or change nothing; and where the input is the same in both, what is refuted stays refuted mostly.
#[test]
fn bounds_change_no_verdict() {
    let cases = if testkit::sample::is_full() { 4000 } else { 400 };
    let couplings = [
        "same n;",
        "same n; free abstract.go;",
        "same n; input abstract.go = concrete.h;",
        "same n; input abstract.go = not concrete.go;",
        "same n; diagrams 0..2:1..2;",
        "same n; diagrams 0..2:1..2; free abstract.go;",
    ];
    let mut counts = [[0; 3]; 2];
    for seed in 0..cases {
        let mut random = Random(seed * 6101 + 5);
        let abstractly = rule(&mut random);
        let concretely = changed(&mut random, &abstractly);
        let programs = [machine_of(&abstractly), machine_of(&concretely)];
        let text = random.pick(&couplings);
        let whole = report(&programs[0], &programs[1], Some(text)).verdict;
        let source = Some(syntax::SourceFile::new("c.refine", text));
        let coupling =
            refine::Coupling::new([&programs[0], &programs[1]], source, &Limits::default()).expect("no faults");
        let mut options = refine::Options::default();
        let sides = random.below(3) + 1;
        for side in (0..2).filter(|side| sides & (1 << side) > 0) {
            let go = programs[side].find_function("go", 0).expect("an input");
            options.extents[side].bounds.insert(go, vec![Value::Boolean(random.below(2) == 0)]);
        }
        let found = refine::refine(&coupling, &options, &mut |_| true).expect("it begins").verdict;
        let of = || {
            format!(
                "seed {seed}: {text}\nabstract {abstractly}\nconcrete {concretely}\n{:?}\n{whole:?}\n{found:?}",
                options.extents
            )
        };
        match (&whole, &found) {
            (Verdict::Refines, Verdict::Refines) => counts[0][0] += 1,
            (Verdict::Refines, Verdict::Unknown(_)) => counts[0][1] += 1,
            (Verdict::DoesNot(_), Verdict::DoesNot(_)) => counts[1][0] += 1,
            (Verdict::DoesNot(_), Verdict::Unknown(_)) => counts[1][1] += 1,
            // What is left may say nothing.
            (_, Verdict::Vacuous(_)) => counts[0][2] += 1,
            (Verdict::Vacuous(_), Verdict::Unknown(_)) => counts[1][2] += 1,
            _ => panic!("{}", of()),
        }
    }
    assert!(counts.iter().all(|of| of[0] * 20 > cases && of[1] * 20 > cases), "{counts:?}");
}

/// With diagrams of at most so many steps.
fn agree(most: usize, coupling: &str, mapped: Mapped, fair: &[Fair]) {
    let cases = if testkit::sample::is_full() { 2000 } else { 150 };
    let (mut counts, mut by_fairness) = ([0; 3], 0);
    for seed in 0..cases {
        let mut random = Random(seed * 7919 + 1);
        let abstractly = rule(&mut random);
        let concretely = match random.below(3) {
            0 => rule(&mut random),
            _ => changed(&mut random, &abstractly),
        };
        // Mostly the concrete machine looks at what the abstract machine's input is computed from: a refinement often enough.
        let concretely = match coupling.split_once("abstract.go = ") {
            Some((_, value)) if random.below(4) > 0 => {
                let value = value.trim_end_matches(';').replace("concrete.", "");
                concretely.replace("go", &format!("({value})"))
            }
            // A machine that waits for something, and then does what the abstract one does.
            None if !fair.is_empty() && random.below(2) > 0 => {
                let guard = random.pick(&["go", "h", "not h", "go and h"]);
                let otherwise = random.pick(&["skip", "h := not h", "h := go"]);
                format!("if {guard} then {abstractly} else {otherwise} endif")
            }
            _ => concretely,
        };
        let (one, other) = (machine_of(&abstractly), machine_of(&concretely));
        let of = |what: &str| format!("seed {seed}: {what}\nabstract {abstractly}\nconcrete {concretely}");
        let (graph_one, graph_other) = (graph(&one), graph(&other));
        let expected = simulated(&graph_one, &graph_other, most, mapped, fair);
        let found = report(&one, &other, Some(coupling));
        match found.verdict {
            Verdict::Refines => {
                assert!(expected, "{}", of("the judge says no"));
                let by = |fair: &[Fair]| simulated(&graph_one, &graph_other, most, mapped, fair);
                let needed: Vec<Fair> = texts_of(coupling)
                    .zip(fair)
                    .filter(|(text, _)| {
                        let told = format!("again and again: {text}");
                        found.assumed.iter().any(|assumed| assumed.name == told)
                    })
                    .map(|(_, fair)| *fair)
                    .collect();
                assert_eq!(needed.len(), found.assumed.len());
                assert!(by(&needed), "{}", of("more fairness is needed"));
                for one in 0..needed.len() {
                    let others = [&needed[..one], &needed[one + 1..]].concat();
                    assert!(!by(&others), "{}", of("less fairness is needed"));
                }
                assert!(needed.is_empty() || has_fair_round(&graph_other.1, &needed), "{}", of("no run is fair"));
                by_fairness += u64::from(!needed.is_empty());
                counts[0] += 1;
            }
            Verdict::DoesNot(refutation) => {
                assert!(!expected, "{}", of("the judge says yes"));
                counts[1] += 1;
                // Both runs are made again, and are equal in `n` where diagrams end.
                let [a, c] = [again(&one, &refutation.runs[0]), again(&other, &refutation.runs[1])];
                let (mut at, mut there) = (0, 0);
                assert_eq!(a[0].0, c[0].0, "{}", of("the beginnings differ"));
                let begins = |run: &refine::Run| run.values.iter().any(|(_, value)| *value == Value::Integer(0));
                assert!(refutation.runs.iter().all(begins), "{}", of("a beginning is not told"));
                for segment in &refutation.segments {
                    (at, there) = (at + segment.m, there + segment.n);
                    assert_eq!(a[at].0, c[there].0, "{}", of("a diagram's ends differ"));
                }
                match refutation.ended {
                    Ended::Unmatched { .. } => {
                        let left = c.len() - 1 - there;
                        assert!((1..=most).contains(&left), "{}", of("one diagram is left"));
                    }
                    Ended::Waits(turn) => {
                        let steps: usize = refutation.segments[..turn].iter().map(|segment| segment.n).sum();
                        assert_eq!(c[steps], c[c.len() - 1], "{}", of("it does not come back"));
                        assert!(refutation.segments[turn..].iter().all(|segment| segment.m == 0), "{}", of("no wait"));
                        let go =
                            |step: &explore::Told| step.inputs.iter().any(|(_, value)| *value == Value::Boolean(true));
                        let round = refutation.runs[1].steps.iter().zip(&c).skip(steps);
                        let met = |fair: &Fair| round.clone().any(|(step, state)| fair(go(step), *state));
                        assert!(fair.iter().all(met), "{}", of("the round is not fair"));
                    }
                    Ended::Fault | Ended::Endless(_) => panic!("{}", of("there is no fault, and no segment")),
                }
            }
            Verdict::Vacuous(Vacuous::NoFairRun) => {
                let by_itself = simulated(&graph_one, &graph_other, most, mapped, &[]);
                assert!(expected && !by_itself && !has_fair_round(&graph_other.1, fair), "{}", of("a run is fair"));
                counts[2] += 1;
            }
            Verdict::Vacuous(_) => counts[2] += 1,
            Verdict::Unknown(why) => panic!("{}", of(&format!("{why:?}"))),
        }
    }
    // A sample in which nothing happens would say nothing.
    let (many, few) = if fair.is_empty() { (5, 20) } else { (8, 75) };
    assert!(counts[0] * many > cases && counts[1] * 10 > cases && counts[2] * 100 < cases * few, "{counts:?}");
    assert!(fair.is_empty() || by_fairness * 40 > cases, "{by_fairness}");
}
