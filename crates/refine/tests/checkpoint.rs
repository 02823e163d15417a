//! A search for a refinement that is interrupted, kept and continued ends like one that is not; a damaged checkpoint is refused.

use std::sync::Arc;

use machine::{Limits, Value};
use program::Program;
use refine::{CONCRETE, Coupling, Options, Refusal, Report, Trouble, refine, refine_kept};
use syntax::SourceFile;
use testkit::memory::{Memory, damaged};
use testkit::{Page, Random};

use crate::naive::{changed, machine_with, rule};
use crate::small::{example, machine};
use crate::workers::counted;

fn coupling(programs: [&Arc<Program>; 2], text: &str) -> Coupling {
    Coupling::new(programs, Some(SourceFile::new("test.refine", text)), &Limits::default()).expect("it is a coupling")
}

fn go_on(coupling: &Coupling, options: &Options, keeper: &mut Memory) -> Result<Report, Trouble> {
    refine_kept(coupling, options, Some(keeper), &mut |_| true)
}

/// Interrupted behind so many pairs again and again, with these numbers of workers in turn, a search ends as it does alone. How many times
/// it was kept.
fn agrees(coupling: &Coupling, pairs: u64, workers: &[usize]) -> usize {
    let whole = refine(coupling, &Options::default(), &mut |_| true).expect("it begins");
    let mut keeper = Memory::default();
    for (index, workers) in workers.iter().copied().cycle().enumerate() {
        let max_pairs = pairs * (index as u64 + 1);
        let options = Options { max_pairs, workers, alone: 0, ..Options::default() };
        let report = go_on(coupling, &options, &mut keeper).expect("it goes on");
        // What was found in a part is found; the search is not at its end for that.
        if keeper.kept.is_none() {
            assert_eq!(format!("{report:?}"), format!("{whole:?}"));
            break;
        }
    }
    keeper.times
}

#[test]
fn random_machines_end_as_without_interruptions() {
    let mut random = Random(23);
    let couplings = [
        "same n;",
        "same n;\nallow waiting;",
        "same n;\ninput abstract.go = not concrete.go;",
        "same n;\nsame h;\ninput abstract.go = concrete.c2 = 0;\nfair concrete.c1 = 0;",
        "couple abstract.n = concrete.n;\nfree abstract.go;\nsegment concrete.c1 != 1;\ndiagrams 0..2:1..3;",
    ];
    let mut times = 0;
    for case in 0..30 {
        let rule = rule(&mut random);
        let other = if random.below(3) == 0 { changed(&mut random, &rule) } else { rule.clone() };
        let programs = [&machine_with(&rule, ""), &counted(&other)];
        let coupling = coupling(programs, couplings[case % couplings.len()]);
        times += agrees(&coupling, 20 + 7 * case as u64, [&[1][..], &[2, 1], &[3]][case % 3]);
    }
    assert!(times > 60, "{times}");
}

#[test]
fn the_examples_of_the_page_end_as_without_interruptions() {
    let page = Page::spec("refine");
    let mut models = [None, None];
    let mut count = 0;
    for block in page.blocks() {
        match block.info.split_whitespace().collect::<Vec<_>>()[..] {
            ["asmetal", "abstract"] => models[0] = Some(example(block.text)),
            ["asmetal", "concrete"] => models[1] = Some(example(block.text)),
            ["refine", "refines" | "does-not-refine" | "unknown"] => {
                let [Some(one), Some(other)] = &models else { panic!("line {}: no models", block.line) };
                count += agrees(&coupling([one, other], block.text), 1, &[1, 2]);
            }
            _ => {}
        }
    }
    assert!(count > 20, "{count}");
}

/// Numbers without bound, texts, sequences that become longer, a domain that grows, an input that both have, bounds that leave values out.
fn growing() -> Arc<Program> {
    machine(
        "dynamic abstract domain Part enum domain Colour = {RED | GREEN} monitored more: Boolean monitored width: Integer\n\
         controlled size: Part -> Integer controlled sum: Integer controlled name: String controlled all: Seq(Prod(Integer, Colour))",
        "main rule r_Main = if sum < 10 then par name := name + toString(sum)\n\
         if more then extend Part with $p do par size($p) := sum sum := sum + 2 endpar\n\
         else choose $c in Colour with true do par sum := sum + width all := append(all, (sum, $c)) endpar endif endpar endif",
        "function sum = 0 function name = \"\" function all = []",
    )
}

fn of_growing() -> (Coupling, Options) {
    let program = growing();
    let coupling = coupling([&program, &program], "same sum;\nsame name;\nsame all;");
    let mut options = Options::default();
    for extent in &mut options.extents {
        let width = program.functions.iter().position(|function| function.name == "width").expect("an input");
        extent.bounds.insert(program::FunctionId(width as u32), vec![Value::Integer(3), Value::Integer(5)]);
    }
    (coupling, options)
}

#[test]
fn values_without_bound_keep_their_numbers() {
    let (coupling, options) = of_growing();
    let whole = refine(&coupling, &options, &mut |_| true).expect("it begins");
    let (mut keeper, mut max_pairs, mut times) = (Memory::every(1), 0, 0);
    loop {
        max_pairs += 40;
        let report =
            go_on(&coupling, &Options { max_pairs, workers: 1 + times % 2, alone: 0, ..options.clone() }, &mut keeper);
        let report = report.expect("it goes on");
        times += 1;
        if keeper.kept.is_none() {
            assert_eq!(format!("{report:?}"), format!("{whole:?}"));
            break;
        }
    }
    assert!(times > 3 && whole.progress.pairs > 150, "{times}: {:?}", whole.progress);
}

/// A checkpoint of a search that is not at its end.
fn kept(coupling: &Coupling, options: &Options) -> Vec<u64> {
    let mut keeper = Memory::of(7, None);
    go_on(coupling, &Options { max_pairs: 20, ..options.clone() }, &mut keeper).expect("it begins");
    keeper.kept.expect("it is kept")
}

fn refused(coupling: &Coupling, options: &Options, kept: Vec<u64>) -> Option<Refusal> {
    let mut keeper = Memory::of(7, Some(kept));
    match go_on(coupling, options, &mut keeper) {
        Err(Trouble::Refused(refusal)) => Some(refusal),
        _ => None,
    }
}

#[test]
fn what_is_damaged_is_refused() {
    let (coupling, options) = of_growing();
    let whole = kept(&coupling, &options);
    for (what, kept) in damaged(&whole) {
        assert!(refused(&coupling, &options, kept).is_some(), "{what}");
    }
    assert_eq!(refused(&coupling, &options, [&whole[..], &[0]].concat()), Some(Refusal::Damaged));
}

#[test]
fn what_is_of_something_else_is_refused() {
    let (coupled, options) = of_growing();
    let whole = kept(&coupled, &options);
    let mut keeper = Memory::of(8, Some(whole.clone()));
    assert_eq!(go_on(&coupled, &options, &mut keeper), Err(Trouble::Refused(Refusal::Model)));
    let program = growing();
    let other = coupling([&program, &program], "same sum;");
    assert_eq!(refused(&other, &options, whole.clone()), Some(Refusal::Question));
    let mut bounded = options.clone();
    bounded.extents[CONCRETE].bounds.clear();
    assert_eq!(refused(&coupled, &bounded, whole.clone()), Some(Refusal::Question));
    // Another number of workers, or another limit, is the same question.
    let more = Options { workers: 2, max_pairs: 25, ..options };
    assert_eq!(refused(&coupled, &more, whole), None);
}
