//! The page of couplings says the truth: each block `refine WORD` is a coupling of the two models above it, with this verdict or fault.

use refine::{Coupling, Options, Verdict, refine};
use syntax::SourceFile;
use testkit::Page;

use crate::bmc::{one_of, sought};
use crate::induction::coupled;
use crate::small::example;

#[test]
fn the_examples_of_the_page_have_their_verdicts() {
    let page = Page::spec("refine");
    let mut models = [None, None];
    let mut count = 0;
    for block in page.blocks() {
        match block.info.split_whitespace().collect::<Vec<_>>()[..] {
            ["asmetal", "abstract"] => models[0] = Some(example(block.text)),
            ["asmetal", "concrete"] => models[1] = Some(example(block.text)),
            ["refine", expected] => {
                let [Some(one), Some(other)] = &models else { panic!("line {}: no models", block.line) };
                let text = Some(SourceFile::new("example.refine", block.text));
                let found = match Coupling::new([one, other], text, &machine::Limits::default()) {
                    Err(faulty) => faulty.faults[0].id,
                    Ok(coupling) => {
                        let report = refine(&coupling, &Options::default(), &mut |_| true).expect("it begins");
                        match report.verdict {
                            Verdict::Refines => "refines",
                            Verdict::DoesNot(_) => "does-not-refine",
                            Verdict::Unknown(_) => "unknown",
                            Verdict::Vacuous(_) => "vacuous-refinement",
                        }
                    }
                };
                assert_eq!(found, expected, "line {}", block.line);
                count += 1;
            }
            ["refine", "bmc", steps] => {
                let [Some(one), Some(other)] = &models else { panic!("line {}: no models", block.line) };
                let coupling = coupled(one, other, block.text);
                let Some(by) = one_of(0) else { continue };
                let runs = sought(by, &coupling, 0, 5).runs.expect("runs");
                let found = runs.found.map_or("none".to_string(), |(steps, _)| steps.to_string());
                assert_eq!(found, steps, "line {}", block.line);
            }
            ["ebnf"] => {}
            _ => panic!("line {}: a block of an unknown kind: {}", block.line, block.info),
        }
    }
    assert_eq!(count, 20);
}
