//! No identifier of generated code is a macro of the headers that it includes: the compilers of this machine list all
//! macros that they define.
#![allow(
    clippy::disallowed_methods,
    clippy::disallowed_macros,
    reason = "a test reads folders, runs compilers, and says what it looked at"
)]

use std::io::Write;
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};

/// The macros that a compiler knows after all headers of the runtime; `None` if there is no such compiler.
fn known(compiler: &str, standard: &str) -> Option<Vec<String>> {
    let include = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../cpp/include");
    let mut headers = Vec::new();
    for folder in ["groundstate", "groundstate/machine"] {
        let entries = std::fs::read_dir(include.join(folder)).expect("the runtime's headers");
        headers.extend(entries.flatten().map(|entry| entry.path()).filter(|path| path.extension().is_some()));
    }
    headers.sort();
    let text = |path: &PathBuf| format!("#include \"{}\"\n", path.display());
    let text: String = headers.iter().map(text).collect::<String>() + "#include <iostream>\n#include <cstdio>\n";
    let started = Command::new(compiler)
        .args([standard, "-dM", "-E", "-x", "c++", "-"])
        .stdin(Stdio::piped())
        .stdout(Stdio::piped())
        .spawn();
    let mut running = match started {
        Ok(running) => running,
        Err(error) if error.kind() == std::io::ErrorKind::NotFound => return None,
        Err(error) => panic!("{compiler}: {error}"),
    };
    running.stdin.take().expect("it reads").write_all(text.as_bytes()).expect("it reads all");
    let output = running.wait_with_output().expect("it ends");
    assert!(output.status.success(), "{compiler} {standard}");
    let text = String::from_utf8_lossy(&output.stdout).into_owned();
    let name = |line: &str| Some(line.strip_prefix("#define ")?.split([' ', '(']).next()?.to_string());
    Some(text.lines().filter_map(name).collect())
}

#[test]
fn no_macro_is_an_identifier() {
    let mut looked_at = 0;
    // GNU's variant of the language defines all that the standard does, and more.
    for (compiler, standard) in [("g++", "-std=gnu++20"), ("clang++", "-std=gnu++20")] {
        let Some(macros) = known(compiler, standard) else {
            println!("there is no {compiler} here");
            continue;
        };
        assert!(macros.iter().any(|name| name == "EBUSY"), "{compiler} {standard} told nothing of its headers");
        let missing: Vec<&String> = macros.iter().filter(|name| generate::names::identifier(name) == **name).collect();
        assert!(missing.is_empty(), "{compiler} {standard}: {missing:?}");
        looked_at += 1;
    }
    assert!(looked_at > 0, "no compiler");
}
