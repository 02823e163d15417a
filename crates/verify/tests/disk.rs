//! States in files when memory is full: the same verdicts, counts and runs as in memory; nothing holds if a file fails.

#![allow(clippy::disallowed_methods, reason = "a test reads the repository's own models")]

use std::sync::atomic::{AtomicI64, AtomicUsize, Ordering};
use std::sync::{Arc, Mutex};

use program::{Program, PropertyKind};
use syntax::SourceFile;
use testkit::repository;
use verify::{EngineKind, Options, Outcome, Reason, Report, Stop, Subject, Tape, verify};

use crate::models::lowered;

fn program(name: &str) -> Arc<Program> {
    let path = repository::root().join(format!("bench/models/verify/{name}.asm"));
    lowered(crate::models::Disk::read(&path).expect("the model is there"))
}

/// The files of a search: how many more words may be written or read, and how many files there are.
#[derive(Debug)]
struct Files {
    left: Arc<AtomicI64>,
    open: Arc<AtomicUsize>,
    made: AtomicUsize,
}

#[derive(Debug)]
struct File {
    words: Mutex<Vec<u64>>,
    left: Arc<AtomicI64>,
    open: Arc<AtomicUsize>,
}

impl Files {
    fn new(left: i64) -> Arc<Files> {
        Arc::new(Files { left: Arc::new(AtomicI64::new(left)), open: Arc::default(), made: AtomicUsize::new(0) })
    }
}

impl verify::Disk for Files {
    fn tape(&self) -> Option<Box<dyn Tape>> {
        self.made.fetch_add(1, Ordering::Relaxed);
        self.open.fetch_add(1, Ordering::Relaxed);
        Some(Box::new(File { words: Mutex::default(), left: Arc::clone(&self.left), open: Arc::clone(&self.open) }))
    }
}

impl File {
    fn takes(&self, words: usize) -> bool {
        self.left.fetch_sub(words as i64, Ordering::Relaxed) >= words as i64
    }
}

impl Tape for File {
    fn write(&mut self, words: &[u64]) -> bool {
        self.words.lock().expect("no test panics while it writes").extend_from_slice(words);
        self.takes(words.len())
    }

    fn read(&mut self, at: u64, words: &mut [u64]) -> bool {
        let all = self.words.lock().expect("no test panics while it writes");
        let Some(found) = all.get(at as usize..at as usize + words.len()) else { return false };
        words.copy_from_slice(found);
        self.takes(words.len())
    }
}

impl Drop for File {
    fn drop(&mut self) {
        self.open.fetch_sub(1, Ordering::Relaxed);
    }
}

fn check(program: &Arc<Program>, options: &Options) -> Report {
    verify(program, options, &mut |_| true).expect("there is an initial state")
}

/// The whole result of a search except its cost; the graph for temporal properties uses no files.
fn told(program: &Program, report: &Report) -> String {
    let progress = verify::Progress { bytes: 0, spilled: 0, ..report.progress };
    let is_temporal = |verdict: &&verify::Verdict| match verdict.subject {
        Subject::Property(index) => matches!(program.properties[index].kind, PropertyKind::Ctl | PropertyKind::Ltl),
        _ => false,
    };
    let verdicts: Vec<_> = report.verdicts.iter().filter(|verdict| !is_temporal(verdict)).collect();
    format!("{verdicts:?} {progress:?} {:?} {} {:?}", report.stop, report.complete, report.unreachable)
}

/// Searches with so little memory that states go to files, with several numbers of workers; returns the number of
/// files.
fn agrees(program: &Arc<Program>, options: &Options, bytes: u64) -> usize {
    let options = Options { engine: EngineKind::Explicit, ..options.clone() };
    let whole = check(program, &options);
    let mut least = usize::MAX;
    for workers in [1, 2, 3] {
        let files = Files::new(i64::MAX);
        let spilled = check(
            program,
            &Options {
                disk: Some(Arc::clone(&files) as Arc<_>),
                max_bytes: bytes,
                workers,
                alone: Some(0),
                ..options.clone()
            },
        );
        assert_eq!(told(program, &spilled), told(program, &whole));
        assert_eq!(files.open.load(Ordering::Relaxed), 0, "files are gone at the end");
        least = least.min(files.made.load(Ordering::Relaxed));
    }
    least
}

#[test]
fn the_reference_systems_come_to_the_same() {
    for name in ["Swing", "SwingLive", "SwingUnlocked"] {
        // Nothing fits, so every level goes to files.
        assert!(agrees(&program(name), &Options::default(), 0) > 2, "{name}");
    }
    for (name, bytes) in [("ChainXS", 300_000), ("ChainXS", 700_000), ("Phil12", 3 << 20)] {
        assert!(agrees(&program(name), &Options::default(), bytes) > 2, "{name}");
    }
    let roomy = agrees(&program("ChainXS"), &Options::default(), 64 << 20);
    assert_eq!(roomy, 0, "there are no files where memory is enough");
}

#[test]
fn limits_and_the_first_violation_end_it_alike() {
    let program = program("SwingUnlocked");
    for options in [
        Options { first: true, ..Options::default() },
        Options { max_depth: 9, ..Options::default() },
        Options { partial_order: true, ..Options::default() },
    ] {
        agrees(&program, &options, 0);
    }
    // How much of a level is discovered by then depends on the number of workers.
    for workers in [1, 2, 3] {
        let disk = Some(Files::new(i64::MAX) as Arc<_>);
        let options = Options {
            max_states: 100,
            max_bytes: 0,
            engine: EngineKind::Explicit,
            workers,
            alone: Some(0),
            disk,
            ..Options::default()
        };
        let report = check(&program, &options);
        assert_eq!(report.stop, Some(Stop::States));
        assert!((100..110).contains(&report.progress.states), "{}", report.progress.states);
    }
}

/// States of several words, assumptions, and numbered values that appear during the search.
#[test]
fn wide_states_and_numbered_values_come_to_the_same() {
    let text = "asm Walk\nimport StandardLibrary\nsignature:\n domain Place subsetof Integer\n monitored push: Boolean\n \
                controlled place: Place -> Integer\n controlled visited: Powerset(Place)\n controlled last: Integer\n\
                definitions:\n domain Place = {0 : 4}\n INVAR place(3) < 3\n \
                invariant inv_last over last: last < 9\n invariant inv_push over push: push implies place(0) != 3\n \
                main rule r_Main = choose $p in Place with place($p) < 4 do par place($p) := place($p) + 1 \
                visited := including(visited, $p) last := place($p) * 3 endpar\n\
                default init s0:\n function place($p in Place) = 0\n function visited = {}\n function last = 0\n";
    let program = lowered(SourceFile::new("Walk.asm", text));
    // With several workers the numbering varies, so the order in files does, too; the result is the same.
    assert!(agrees(&program, &Options { terminal: None, ..Options::default() }, 0) > 2);
}

#[test]
fn trouble_with_files_leaves_unknown_what_was_not_found() {
    let program = program("SwingUnlocked");
    let options = Options { engine: EngineKind::Explicit, max_bytes: 0, ..Options::default() };
    let mut kept = 0;
    for left in (0..200_000).step_by(2_500) {
        for workers in [1, 2] {
            let files = Files::new(left);
            let report = check(
                &program,
                &Options { disk: Some(Arc::clone(&files) as Arc<_>), workers, alone: Some(0), ..options.clone() },
            );
            assert_eq!(files.open.load(Ordering::Relaxed), 0);
            let trouble = files.left.load(Ordering::Relaxed) < 0;
            assert_eq!(report.stop, trouble.then_some(Stop::Disk));
            kept += usize::from(!trouble);
            for verdict in &report.verdicts {
                match &verdict.outcome {
                    Outcome::Holds => assert!(!trouble, "nothing holds where a file failed"),
                    Outcome::Unknown(reasons) => assert_eq!(*reasons, [Reason::Stopped(Stop::Disk)]),
                    Outcome::Violated(trace) => assert_eq!(trace.steps.len(), 12),
                }
            }
        }
    }
    assert!(kept > 0, "the files were enough for none");
}
