//! A refactored model means what it meant: it has the same faults, and runs through the same states.
//!
//! All rules of the examples and of the pattern library are chosen, and all their words are a cursor, a sample by default.

use std::sync::Arc;

use groundstate::model::Loader;
use groundstate::simulate::{Bounds, Choices, Inputs, Invariants, Options, RandomSource, Record, Run};
use ide::{Project, Refactoring};
use syntax::ast::{self, AstNode, trimmed_range};
use syntax::{FileId, SourceFile, SyntaxKind};
use testkit::repository;

use crate::support::Folder;

/// Every refactoring that is offered somewhere in a text, each once.
fn offered(project: &mut Project<Folder>, path: &str, text: &str, every: usize) -> Vec<Refactoring> {
    let tree = syntax::parse_asmetal(FileId(0), text).syntax();
    let mut ranges: Vec<(u32, u32)> = Vec::new();
    for node in tree.descendants() {
        if ast::Rule::cast(node.clone()).is_none() {
            continue;
        }
        let range = trimmed_range(&node);
        let (start, end): (u32, u32) = (range.start().into(), range.end().into());
        ranges.extend([(start, end), (start, start)]);
        // With the neighbour behind it.
        if let Some(next) = node.next_sibling() {
            ranges.push((start, trimmed_range(&next).end().into()));
        }
    }
    let mut found: Vec<Refactoring> = Vec::new();
    for range in ranges.into_iter().step_by(every) {
        for refactoring in ide::refactorings(project, path, range) {
            if !found.contains(&refactoring) {
                found.push(refactoring);
            }
        }
    }
    found
}

/// The states of a run, change by change; none where the model cannot run.
fn states(path: &str, text: &str) -> Option<Vec<String>> {
    let loader: &mut dyn Loader = &mut testkit::Disk;
    let loaded = groundstate::load(SourceFile::new(path, text), loader).ok()?;
    loaded.program.main?;
    let seed = 5;
    let inputs = Inputs::new().with(RandomSource::new(seed, Bounds::default())).choosing(Choices::random(seed));
    let options = Options { steps: Some(12), invariants: Invariants::Ignore, ..Options::default() };
    let mut run = Run::new(Arc::clone(&loaded.program), groundstate::machine::Limits::default(), inputs, options);
    let mut found = Vec::new();
    while let Some(record) = run.advance() {
        found.push(match record {
            Record::Initial { inputs, values, .. } => format!("{inputs:?} {values:?}"),
            Record::Step(step) => {
                // Where a change is written may be another place.
                let changes: Vec<_> = step.changes.iter().map(|change| (&change.location, &change.after)).collect();
                format!("{:?} {:?} {changes:?}", step.inputs, step.writes)
            }
            Record::Attempt(_) => "attempt".to_string(),
            Record::Back { .. } => "back".to_string(),
            Record::End(end) => end.word().to_string(),
        });
    }
    Some(found)
}

/// The comments of a text, each once: a rule with comments may be written at several calls.
fn comments(text: &str) -> std::collections::BTreeSet<String> {
    let tree = syntax::parse_asmetal(FileId(0), text).syntax();
    let tokens = tree.descendants_with_tokens().filter_map(|element| element.into_token());
    let comments = tokens.filter(|token| matches!(token.kind(), SyntaxKind::LINE_COMMENT | SyntaxKind::BLOCK_COMMENT));
    comments.map(|token| token.text().trim_end().to_string()).collect()
}

#[test]
fn a_refactored_model_means_what_it_meant() {
    let full = testkit::sample::is_full();
    let folders = ["examples", "library"].map(|folder| repository::files(folder, &["asm"])).concat();
    let (mut by_kind, mut ran) = (std::collections::BTreeMap::<String, usize>::new(), 0);
    for path in folders {
        let path = path.to_string_lossy().into_owned();
        let text = std::fs::read_to_string(&path).expect("a model");
        let mut project = Project::new(Folder);
        let every = if full { 1 } else { 10 + text.len() / 220 };
        let before = states(&path, &text);
        for (index, refactoring) in offered(&mut project, &path, &text, every).iter().enumerate() {
            let after = ide::edited(&text, &refactoring.edits);
            let parse = syntax::parse_asmetal(FileId(0), &after);
            assert!(parse.diagnostics.len() <= syntax::parse_asmetal(FileId(0), &text).diagnostics.len(), "{after}");
            // Comments are what nobody checks: all of them are there.
            assert_eq!(comments(&after), comments(&text), "{path}: {}", refactoring.title);
            let title: String = refactoring.title.split('`').step_by(2).collect();
            let title = title.chars().filter(|letter| !letter.is_ascii_digit()).collect();
            *by_kind.entry(title).or_default() += 1;
            if before.is_some() && (full || index % 3 == 0) {
                ran += 1;
                assert_eq!(states(&path, &after), before, "{path}: {}\n{after}", refactoring.title);
            }
        }
    }
    assert!(ran > 20, "{ran} ran; {by_kind:?}");
    assert!(by_kind.len() >= 6 && by_kind.values().sum::<usize>() > 100, "{by_kind:?}");
}
