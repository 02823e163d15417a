//! The generated part of a program in the repository is what `groundstate generate cpp` makes of its chart: `make demo` compiles the
//! program before there is a tool. `UPDATE_EXPECT=1` (`make update`) rewrites it.
#![allow(clippy::disallowed_methods, reason = "the test reads what the command has written")]

use std::path::{Path, PathBuf};
use std::process::Command;

use expect_test::expect_file;

/// The sources in a folder, in those within it too, by their paths within it.
fn sources(folder: &Path) -> Vec<PathBuf> {
    let mut found = Vec::new();
    let mut open = vec![folder.to_path_buf()];
    while let Some(within) = open.pop() {
        for entry in std::fs::read_dir(&within).expect("a folder") {
            let path = entry.expect("an entry").path();
            match path.extension().and_then(|ending| ending.to_str()) {
                _ if path.is_dir() => open.push(path),
                Some("hpp" | "cpp") => found.push(path.strip_prefix(folder).expect("it is within").to_path_buf()),
                _ => {}
            }
        }
    }
    found.sort();
    found
}

#[test]
fn generated_sources_are_fresh() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("../..").canonicalize().expect("the repository");
    let study = root.join("examples/visual_servoing");
    // What is generated names the models by paths from where it lies.
    let tree = tempfile::tempdir().expect("a temporary folder");
    let beside = tree.path().join("examples/visual_servoing");
    std::fs::create_dir_all(&beside).expect("a folder");
    std::os::unix::fs::symlink(root.join("library"), tree.path().join("library")).expect("a link");
    for file in ["ControllerSystem.chart", "Guiding.asm", "Servoing.asm", "Arm.asm"] {
        std::fs::copy(study.join(file), beside.join(file)).expect("the file is there");
    }
    let mut command = Command::new(env!("CARGO_BIN_EXE_groundstate"));
    command.args(["generate", "cpp", "ControllerSystem.chart", "-o", "robot"]).current_dir(&beside);
    assert!(command.output().expect("it starts").status.success());
    let generated = beside.join("robot/generated");
    // The runtime is that of cpp/, which is not copied.
    std::fs::remove_dir_all(generated.join("include")).expect("it was written");
    for path in sources(&generated) {
        let text = std::fs::read_to_string(generated.join(&path)).expect("it was written");
        expect_file![study.join("robot/generated").join(&path)].assert_eq(&text);
    }
    assert_eq!(sources(&study.join("robot/generated")), sources(&generated));
}
