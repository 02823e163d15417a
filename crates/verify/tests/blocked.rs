//! Assumptions that leave no step of a state: the search says of how many states, as a walk over the same tables counts them.
//!
//! What would follow these states is not part of any verdict, so nobody should take *holds* for more than it is.

use std::collections::BTreeSet;
use std::sync::Arc;

use syntax::SourceFile;
use testkit::{Random, sample};
use verify::review::{Meta, MetaOutcome, review};
use verify::{EngineKind, Options, Outcome, Reason, Storage, verify};

use crate::models::lowered;

const PLACES: u64 = 8;
const MOVES: u64 = 3;

/// Where each move leads from each place, which places are assumed, and which moves are assumed at each place.
struct Walk {
    leads: Vec<Vec<u64>>,
    assumed: Vec<bool>,
    allowed: Vec<Vec<bool>>,
}

impl Walk {
    fn random(random: &mut Random) -> Walk {
        let mut one_in = |most: u64| random.below(most) == 0;
        let assumed = (0..PLACES).map(|place| place == 0 || !one_in(3)).collect();
        let allowed = (0..PLACES).map(|_| (0..MOVES).map(|_| !one_in(2)).collect()).collect();
        let leads = (0..PLACES).map(|_| (0..MOVES).map(|_| random.below(PLACES)).collect()).collect();
        Walk { leads, assumed, allowed }
    }

    /// The model: the move is an input, or a choice, of which nothing can be assumed.
    fn model(&self, has_inputs: bool, is_assumed: bool) -> String {
        let table = |of: &dyn Fn(usize, usize) -> String| {
            let rows = (0..PLACES as usize).flat_map(|place| (0..MOVES as usize).map(move |by| (place, by)));
            rows.map(|(place, by)| format!("case ({place}, {by}): {} ", of(place, by))).collect::<String>()
        };
        let (leads, allowed) =
            (table(&|at, by| self.leads[at][by].to_string()), table(&|at, by| self.allowed[at][by].to_string()));
        let places = (0..PLACES).filter(|at| self.assumed[*at as usize]).map(|at| format!("place = {at}"));
        let step = |by: &str| format!("place := leads(place, {by})");
        let (input, rule) = match has_inputs {
            true => ("\tmonitored by: Move\n", step("by")),
            false => ("", format!("choose $m in Move with true do {}", step("$m"))),
        };
        let of_places =
            if is_assumed { format!("\tINVAR {}\n", places.collect::<Vec<_>>().join(" or ")) } else { String::new() };
        let of_steps = if has_inputs { "\tINVAR allowed(place, by)\n" } else { "" };
        format!(
            "asm Walk\nimport StandardLibrary\nsignature:\n\tdomain Place subsetof Integer\n\tdomain Move subsetof Integer\n{input}\
             \tcontrolled place: Place\n\tstatic leads: Prod(Place, Move) -> Place\n\tstatic allowed: Prod(Place, Move) -> Boolean\n\
             definitions:\n\tdomain Place = {{0 : {}}}\n\tdomain Move = {{0 : {}}}\n\
             \tfunction leads($p in Place, $m in Move) = switch ($p, $m) {leads}endswitch\n\
             \tfunction allowed($p in Place, $m in Move) = switch ($p, $m) {allowed}endswitch\n\
             {of_places}{of_steps}\tmain rule r_Main = {rule}\ndefault init s0:\n\tfunction place = 0\n",
            PLACES - 1,
            MOVES - 1
        )
    }

    /// How many states are reached, and in how many nothing goes on.
    fn count(&self, has_inputs: bool, is_assumed: bool) -> (u64, u64) {
        let (mut seen, mut open, mut blocked) = (BTreeSet::from([0]), vec![0], 0);
        while let Some(at) = open.pop() {
            let moves = (0..MOVES as usize).filter(|by| !has_inputs || self.allowed[at as usize][*by]);
            let next: Vec<u64> = moves.map(|by| self.leads[at as usize][by]).collect();
            let admitted = next.into_iter().filter(|to| !is_assumed || self.assumed[*to as usize]).collect::<Vec<_>>();
            blocked += u64::from(admitted.is_empty());
            open.extend(admitted.into_iter().filter(|to| seen.insert(*to)));
        }
        (seen.len() as u64, blocked)
    }
}

#[test]
fn states_of_which_assumptions_leave_no_step_are_counted() {
    let mut all = [0; 2];
    for seed in sample::seeds(40, 1_000) {
        let walk = Walk::random(&mut Random(seed));
        for (has_inputs, is_assumed) in [(true, true), (true, false), (false, true), (false, false)] {
            let program = lowered(SourceFile::new("Walk.asm", walk.model(has_inputs, is_assumed)));
            let (states, blocked) = walk.count(has_inputs, is_assumed);
            for options in [
                Options::default(),
                Options { workers: 2, alone: Some(0), ..Options::default() },
                Options { storage: Storage::Compact, ..Options::default() },
                Options { engine: EngineKind::Symbolic, max_bytes: 8 << 20, ..Options::default() },
            ] {
                let report = verify(&program, &options, &mut |_| true).expect("the first place is assumed");
                let progress = report.progress;
                assert_eq!(
                    (progress.states, progress.blocked),
                    (states, blocked),
                    "seed {seed}: {}",
                    walk.model(has_inputs, is_assumed)
                );
            }
            all[usize::from(blocked > 0)] += 1;
        }
    }
    assert!(all.iter().all(|count| *count >= 10), "there are both kinds: {all:?}");
}

#[test]
fn no_deadlock_says_nothing_of_them() {
    let text = "asm Level\nimport StandardLibrary\nsignature:\n\tdomain Level subsetof Integer\n\tcontrolled level: Level\n\
                definitions:\n\tdomain Level = {0 : 3}\n\tINVAR level < 2\n\tmain rule r_Main = level := level + 1\n\
                default init s0:\n\tfunction level = 0\n";
    let report =
        verify(&lowered(SourceFile::new("Level.asm", text)), &Options::default(), &mut |_| true).expect("it begins");
    assert!(report.verdicts.iter().all(|verdict| verdict.outcome == Outcome::Holds), "{:?}", report.verdicts);
    assert_eq!((report.progress.states, report.progress.blocked), (2, 1));
}

/// Where no step is left at all, nothing but the initial states was looked at, and that nothing is wrong in them says little.
#[test]
fn assumptions_that_leave_no_step() {
    let model = |assumed: &str| {
        format!(
            "asm Level\nimport StandardLibrary\nimport CTLLibrary\nsignature:\n\tdomain Level subsetof Integer\n\tcontrolled level: Level\n\
             \tmonitored go: Boolean\ndefinitions:\n\tdomain Level = {{0 : 3}}\n\tINVAR {assumed}\n\tinvariant inv_low over level: level < 3\n\
             \tCTLSPEC ctlSpec_low: ag(level < 2)\n\tmain rule r_Main = level := 1 - level\ndefault init s0:\n\tfunction level = 0\n"
        )
    };
    let of = |assumed: &str, engine: EngineKind, workers: usize| {
        let options = Options { engine, workers, ..Options::default() };
        let report = verify(&lowered(SourceFile::new("Level.asm", model(assumed))), &options, &mut |_| true);
        report.expect("it begins")
    };
    for (engine, workers) in [(EngineKind::Explicit, 1), (EngineKind::Explicit, 2), (EngineKind::Symbolic, 1)] {
        let report = of("go and not go", engine, workers);
        let stepless = Outcome::Unknown(vec![Reason::Stepless]);
        assert!(report.verdicts.iter().all(|verdict| verdict.outcome == stepless), "{:?}", report.verdicts);
        assert!(report.unreachable.is_empty());
        let report = of("go", engine, workers);
        assert!(report.verdicts.iter().all(|verdict| verdict.outcome == Outcome::Holds), "{:?}", report.verdicts);
    }
}

/// A review would take all for oddities there: that no rule runs, that no value is taken.
#[test]
fn a_review_says_nothing_where_no_step_is_left() {
    let reviewed = |assumed: &str| {
        let text = format!(
            "asm Level\nimport StandardLibrary\nsignature:\n\tdomain Level subsetof Integer\n\tcontrolled level: Level\n\
             \tmonitored go: Boolean\ndefinitions:\n\tdomain Level = {{0 : 1}}\n\tINVAR {assumed}\n\
             \tmain rule r_Main = if go then level := 1 - level endif\ndefault init s0:\n\tfunction level = 0\n"
        );
        let checked = model::check(SourceFile::new("Level.asm", text), &mut testkit::NoFiles);
        let program = Arc::new(program::lower(&checked.model).expect("it is lowered"));
        let options = Options::default();
        review(&checked.model, &program, &options, &Meta::ALL, &|_| true, &mut |_| true).expect("it begins")
    };
    let nothing = reviewed("go and not go");
    assert_eq!((&nothing.findings[..], &nothing.reasons[..]), (&[][..], &[Reason::Stepless][..]));
    assert!(nothing.outcomes.iter().all(|(_, outcome)| *outcome == MetaOutcome::Unknown), "{:?}", nothing.outcomes);
    // A step that leads to no state that counts is none either.
    assert_eq!(reviewed("go\n\tINVAR level = 0").reasons, [Reason::Stepless]);
    let some = reviewed("go");
    assert!(some.reasons.is_empty() && some.outcomes.iter().any(|(_, outcome)| *outcome == MetaOutcome::Holds));
}
