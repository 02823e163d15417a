//! Every command in the documentation works: it runs in a copy of the repository, in the page's folder or the root,
//! with the files that it names or shows. Slow commands are shortened: a search makes one step, and scenarios, which other tests
//! run, are only checked.

#![allow(clippy::disallowed_methods, reason = "a test reads pages and works on files")]

use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};

use testkit::solver::solvers;

fn root() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../..").canonicalize().expect("the repository")
}

/// The pages whose commands are run.
fn pages() -> Vec<PathBuf> {
    let mut pages: Vec<PathBuf> =
        ["README.md", "docs/patterns.md", "docs/generated-code.md", "spec/charts.md"].map(PathBuf::from).to_vec();
    for folder in ["library", "examples"] {
        let entries = fs::read_dir(root().join(folder)).expect("a folder");
        let names = entries.map(|entry| Path::new(folder).join(entry.expect("an entry").file_name()).join("README.md"));
        pages.extend(names.filter(|page| root().join(page).is_file()));
    }
    pages.sort();
    pages
}

/// The commands of a page: lines that are indented or begin with a prompt, and code in backquotes that names a file.
fn commands(text: &str) -> Vec<Vec<String>> {
    let mut found = Vec::new();
    for line in text.lines() {
        let shown = line.strip_prefix("    ").or(line.strip_prefix("$ ")).map(str::trim_start);
        let whole = shown.filter(|line| line.starts_with("groundstate "));
        let parts: Vec<&str> = match whole {
            Some(line) => vec![line.split(" #").next().unwrap_or(line)],
            // A backquote that is not closed on its line begins code that continues on the next; it is skipped.
            None => {
                let closed = line.matches('`').count() / 2;
                line.split('`')
                    .skip(1)
                    .step_by(2)
                    .take(closed)
                    .filter(|part| part.starts_with("groundstate "))
                    .collect()
            }
        };
        for part in parts {
            let words: Vec<String> =
                part.split_whitespace().skip(1).map(|word| word.trim_matches('\'').to_string()).collect();
            // Placeholders, and commands that continue in a shell.
            let open = |word: &String| {
                word.chars().any(|c| "<>…|\"$".contains(c))
                    || word.len() > 1 && word.chars().all(|c| c.is_ascii_uppercase())
            };
            if words.iter().any(|word| word.contains('.')) && !words.iter().any(open) {
                found.push(words);
            }
        }
    }
    found
}

/// The files that a page shows: blocks of code after a line that ends with "`NAME`:".
fn files(text: &str) -> Vec<(&str, &str)> {
    let parts: Vec<&str> = text.split("\n```").collect();
    let pairs = parts.chunks_exact(2).filter_map(|pair| {
        let name = pair[0].lines().rfind(|line| !line.is_empty())?.strip_suffix("`:")?.rsplit('`').next()?;
        Some((name, pair[1].split_once('\n')?.1))
    });
    pairs.collect()
}

/// A command that ends soon, and its good exit codes.
fn shortened(mut words: Vec<String>) -> (Vec<String>, &'static [i32]) {
    match words[0].as_str() {
        "verify" => {
            words.extend(["--max-states".to_string(), "10".to_string()]);
            (words, &[0, 1, 3])
        }
        "test" => {
            words[0] = "check".to_string();
            words.retain(|word| !word.starts_with("--"));
            (words, &[0])
        }
        "run" => {
            if let Some(at) = words.iter().position(|word| word == "--steps") {
                words[at + 1] = "20".to_string();
            }
            // Nobody is at the terminal.
            if !words.iter().any(|word| word == "--random") {
                words.push("--random".to_string());
            }
            (words, &[0, 3])
        }
        _ => (words, &[0]),
    }
}

fn copy(from: &Path, to: &Path) {
    fs::create_dir_all(to).expect("a folder");
    for entry in fs::read_dir(from).expect("a folder") {
        let path = entry.expect("an entry").path();
        let target = to.join(path.file_name().expect("a name"));
        if path.is_dir() {
            copy(&path, &target);
        } else {
            fs::copy(&path, &target).expect("a file");
        }
    }
}

#[test]
fn the_commands_of_the_pages_work() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    for part in ["library", "examples", "bench/models"] {
        copy(&root().join(part), &folder.path().join(part));
    }
    // A proof by induction takes both of them.
    let provers = solvers(false).len() == 2;
    let mut ran = 0;
    for page in pages() {
        let text = fs::read_to_string(root().join(&page)).expect("a page");
        let beside = page.parent().filter(|parent| folder.path().join(parent).is_dir()).unwrap_or(Path::new(""));
        for (name, text) in files(&text) {
            let path = folder.path().join(beside).join(name);
            if !path.exists() {
                fs::write(path, text).expect("a file");
            }
        }
        for words in commands(&text) {
            // Paths are relative to the page's folder or to the root.
            let files = words.iter().filter(|word| word.contains('/') && !word.starts_with("out/"));
            let at_root = files.clone().any(|file| !file.starts_with("..") && folder.path().join(file).exists());
            let place = folder.path().join(if at_root { Path::new("") } else { beside });
            let (words, good) = shortened(words);
            if words.iter().any(|word| word == "run.json" || word == "run.mcap") {
                continue; // what a program wrote
            }
            if words.iter().any(|word| word == "induction") && !provers {
                continue;
            }
            let output = Command::new(env!("CARGO_BIN_EXE_groundstate"))
                .args(&words)
                .current_dir(&place)
                .stdin(Stdio::null())
                .output()
                .expect("it starts");
            let code = output.status.code().unwrap_or(-1);
            let told = String::from_utf8_lossy(&output.stderr);
            let told: String = told.chars().take(2_000).collect();
            assert!(
                good.contains(&code),
                "{}: `groundstate {}` ends with {code}:\n{told}",
                page.display(),
                words.join(" ")
            );
            ran += 1;
        }
    }
    assert!(ran > 40, "{ran} commands were found");
}

/// The pages say that this chart can be built and runs. All charts of the library and the examples check as well.
#[test]
fn the_charts_can_be_built() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    for part in ["library/patterns", "library/std", "library/verification", "examples/visual_servoing"] {
        copy(&root().join(part), &folder.path().join(part));
    }
    let groundstate = |arguments: &[&str]| {
        let mut command = Command::new(env!("CARGO_BIN_EXE_groundstate"));
        let output =
            command.args(arguments).current_dir(folder.path()).stdin(Stdio::null()).output().expect("it starts");
        (output.status.code(), String::from_utf8_lossy(&output.stderr).to_string())
    };
    let chart = "library/patterns/DataProducer.chart";
    assert_eq!(groundstate(&["chart", "build", chart, "-o", "DataProducer.asm"]), (Some(0), String::new()));
    assert_eq!(groundstate(&["check", "--strict", "DataProducer.asm"]), (Some(0), String::new()));
    let run = ["run", "DataProducer.asm", "--random", "--steps", "50", "--show", "none"];
    assert_eq!(groundstate(&run), (Some(0), String::new()));
    // All files of the case study, including its charts and reports; and a system that imports no patterns.
    let case = "examples/visual_servoing";
    for file in ["VisionSystem.chart", "VisualServoing.report.yaml", "verification/VisualServoingInTicks.verify.yaml"] {
        assert_eq!(groundstate(&["check", &format!("{case}/{file}")]), (Some(0), String::new()), "{file}");
    }
    assert_eq!(groundstate(&["chart", "check", &format!("{case}/VisionSystem.chart")]), (Some(0), String::new()));
    let system = fs::read_to_string(folder.path().join(case).join("VisionSystem.chart")).expect("the chart");
    let lines = system.lines().filter(|line| !line.starts_with("import "));
    let alone = lines.collect::<Vec<_>>().join("\n").replace("chart VisionSystem", "chart Alone");
    fs::write(folder.path().join("library/Alone.chart"), alone).expect("a file");
    assert_eq!(groundstate(&["chart", "build", "library/Alone.chart"]), (Some(0), String::new()));
    assert_eq!(groundstate(&["chart", "check", "library/Alone.chart"]), (Some(0), String::new()));
    // With a period of 40 ms instead of 10 it is another robot.
    let slower = system.replace("synchronous period 10 ms", "synchronous period 40 ms");
    fs::write(folder.path().join(case).join("VisionSystem.chart"), slower).expect("a file");
    let (code, told) = groundstate(&["chart", "check", &format!("{case}/VisionSystem.chart")]);
    assert_eq!(code, Some(1), "{told}");
    assert!(told.contains("the period is 40 ms in the chart, 10 ms in the model"), "{told}");
}
