//! `conform` on recordings that are cut, and on models that step otherwise than they are drawn: exit codes and words.

#![allow(clippy::disallowed_methods, reason = "recordings and models are files, and the command is a process")]

use std::path::{Path, PathBuf};
use std::process::Command;

fn systems() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../../cpp/systems").canonicalize().expect("the systems")
}

/// The exit code and all words.
fn conform(model: &Path, log: &Path, more: &[&str]) -> (i32, String) {
    let mut command = Command::new(env!("CARGO_BIN_EXE_groundstate"));
    let output = command.arg("conform").args([model, log]).args(more).output().expect("it starts");
    let words = [output.stdout, output.stderr].concat();
    (output.status.code().unwrap_or(-1), String::from_utf8(words).expect("text"))
}

/// A file without its last bytes, even if they only say again what stands before them, is no whole recording.
#[test]
fn a_recording_that_is_cut_never_conforms() {
    let folder = tempfile::tempdir().expect("a folder");
    let model = systems().join("Contention.asm");
    for (name, more) in [("drawn", &[][..]), ("modelled", &[]), ("modelled", &["--untimed"])] {
        let log = systems().join(format!("logs/contention-{name}.mcap"));
        let (code, words) = conform(&model, &log, more);
        assert!(code == 0 && words.starts_with("conforms "), "{words}");
        let steps =
            if words.contains("tick by tick") { "steps of the model" } else { "steps of single tasks of the model" };
        assert!(words.contains(steps), "{words}");
        let whole = std::fs::read(&log).expect("it is there");
        let cut = folder.path().join("cut.mcap");
        for missing in [1, 8, 9, 30, 300] {
            std::fs::write(&cut, &whole[..whole.len() - missing]).expect("written");
            let (code, words) = conform(&model, &cut, more);
            assert!(code == 3 && words.contains("the recording has no end"), "without {missing} bytes: {words}");
        }
        std::fs::write(&cut, [&whole[..], &whole].concat()).expect("written");
        let (code, words) = conform(&model, &cut, more);
        assert!(code == 2 && words.contains("something follows the end of the file"), "{words}");
    }
}

#[test]
fn the_main_rule_of_the_model_is_looked_at() {
    let text = std::fs::read_to_string(systems().join("Contention.asm")).expect("the model");
    let root = systems().join("../..").canonicalize().expect("the repository");
    let text = text.replace("../../library", &root.join("library").to_string_lossy());
    let folder = tempfile::tempdir().expect("a folder");
    let model = folder.path().join("Contention.asm");
    let log = |name: &str| systems().join(format!("logs/contention-{name}.mcap"));
    let check = |from: &str, to: &str, timed: (i32, &str), by_order: (i32, &str)| {
        assert!(text.contains(from), "{from}");
        std::fs::write(&model, text.replace(from, to)).expect("written");
        for (name, more, (code, expect)) in
            [("modelled", &[][..], timed), ("modelled", &["--untimed"], by_order), ("drawn", &[], by_order)]
        {
            let (found, words) = conform(&model, &log(name), more);
            assert!(found == code && words.contains(expect), "{to}, {name} {more:?}: {words}");
        }
    };
    check("asm Contention", "asm Contention", (0, "conforms"), (0, "conforms"));
    let steps = "forall $c in Scheduler with true do program($c)";
    check(steps, "skip", (1, "the model: nothing"), (2, "its main rule r_Main has no `forall $c in Scheduler`"));
    check("clock := clock + 1", "clock := clock + 2", (1, "parts"), (1, "a step of the model leads its clock"));
}
