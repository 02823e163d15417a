//! Pages that show files, commands and answers are transcripts: docs/start.md, docs/refinement.md, docs/mutation.md, and the model in README.md.
//!
//! In: a page. A block of code after a line that ends with "`NAME`:" is the file NAME; a `diff` block there changes
//! that file. The page is cut before each such block; each piece is a transcript for trycmd, run in one folder that all
//! pieces share. A picture that the page shows from its own folder must be the one that the commands draw.
//! `TRYCMD=overwrite` rewrites answers and pictures.

#![allow(clippy::disallowed_methods, reason = "a test reads a page and makes the files on it")]
#![allow(clippy::disallowed_macros, reason = "a test says what it leaves out")]

use std::env;
use std::fs;
use std::path::{Path, PathBuf};

fn root() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../..").canonicalize().expect("the repository")
}

/// What happens to a file before the commands of a piece run.
#[derive(Debug, PartialEq, Eq)]
enum Edit {
    Write(String),
    /// Lines that stand in the file once, and their replacement.
    Change {
        from: String,
        to: String,
    },
}

/// The part of a page from one file to the next: its lines, the number of the first, and the change of the file.
#[derive(Debug)]
struct Piece {
    line: usize,
    text: String,
    edit: Option<(String, Edit)>,
}

/// NAME, of a line that ends with "`NAME`:".
fn file_named(line: &str) -> Option<&str> {
    line.strip_suffix("`:")?.rsplit('`').next()
}

fn joined<'t>(lines: impl Iterator<Item = &'t str>) -> String {
    lines.flat_map(|line| [line, "\n"]).collect()
}

fn edit(info: &str, body: &[&str]) -> Edit {
    if info != "diff" {
        return Edit::Write(joined(body.iter().copied()));
    }
    let with = |mark: char| joined(body.iter().filter_map(|line| line.strip_prefix([' ', mark])));
    Edit::Change { from: with('-'), to: with('+') }
}

fn pieces(page: &str) -> Vec<Piece> {
    let lines: Vec<&str> = page.lines().collect();
    let mut pieces = vec![Piece { line: 1, text: String::new(), edit: None }];
    let mut above = "";
    let mut at = 0;
    while at < lines.len() {
        let Some(info) = lines[at].strip_prefix("```") else {
            above = if lines[at].is_empty() { above } else { lines[at] };
            pieces.last_mut().expect("a piece").text += &format!("{}\n", lines[at]);
            at += 1;
            continue;
        };
        let length = lines[at + 1..].iter().position(|line| line.starts_with("```")).expect("the block ends");
        let block = &lines[at..=at + 1 + length];
        if let Some(name) = file_named(above).filter(|_| info != "console") {
            let edit = edit(info, &block[1..block.len() - 1]);
            pieces.push(Piece { line: at + 1, text: String::new(), edit: Some((name.to_string(), edit)) });
        }
        pieces.last_mut().expect("a piece").text += &format!("{}\n", block.join("\n"));
        above = "";
        at += block.len();
    }
    pieces
}

fn apply(folder: &Path, name: &str, edit: &Edit) {
    let path = folder.join(name);
    match edit {
        Edit::Write(text) => fs::write(&path, text).expect("a file"),
        Edit::Change { from, to } => {
            let text = fs::read_to_string(&path).unwrap_or_else(|error| panic!("{name}: {error}"));
            assert_eq!(text.matches(from.as_str()).count(), 1, "these lines do not stand in {name} once:\n{from}");
            fs::write(&path, text.replace(from.as_str(), to)).expect("a file");
        }
    }
}

/// The path of a program that the page calls by its name.
fn on_the_path(name: &str) -> PathBuf {
    let folders = env::var_os("PATH").expect("a search path");
    let mut found = env::split_paths(&folders).map(|folder| folder.join(name));
    found.find(|path| path.is_file()).unwrap_or_else(|| panic!("{name} is not installed"))
}

fn is_on_the_path(name: &str) -> bool {
    env::var_os("PATH").is_some_and(|folders| env::split_paths(&folders).any(|folder| folder.join(name).is_file()))
}

/// Runs a page; returns its updated text, and the folder of its files.
fn run(page: &str) -> (String, tempfile::TempDir) {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let files = folder.path().join("files");
    fs::create_dir(&files).expect("a folder");
    let mut said = String::new();
    for piece in pieces(page) {
        if let Some((name, edit)) = &piece.edit {
            apply(&files, name, edit);
        }
        // The name tells trycmd the folder, and the reader of its answer the place on the page.
        let transcript = folder.path().join(format!("from-line-{}.md", piece.line));
        let beside = transcript.with_extension("in");
        fs::write(&transcript, &piece.text).expect("a transcript");
        fs::rename(&files, &beside).expect("a folder");
        let cases = trycmd::TestCases::new();
        for line in piece.text.lines().filter_map(|line| line.strip_prefix("$ ")) {
            // trycmd would skip a program that it does not know.
            let name = line.split(' ').next().expect("a word");
            if name != "groundstate" {
                let path = name.strip_prefix("./").map_or_else(|| on_the_path(name), |made| beside.join(made));
                cases.register_bin(name, path.as_path());
            }
        }
        // What solvers say is tested where they are: `make unit` installs them.
        let needs = if piece.text.contains("--method induction") { &["z3", "cvc5"][..] } else { &[] };
        if needs.iter().all(|name| is_on_the_path(name)) {
            cases.case(&transcript).run();
        }
        fs::rename(&beside, &files).expect("a folder");
        said += &fs::read_to_string(&transcript).expect("the transcript");
    }
    fs::rename(files, folder.path().join("at-the-end")).expect("a folder");
    (said, folder)
}

fn check(page: &str) {
    let path = root().join(page);
    let text = fs::read_to_string(&path).expect("a page");
    let (said, folder) = run(&text);
    let overwrite = env::var_os("TRYCMD").is_some_and(|mode| mode == "overwrite");
    if overwrite {
        fs::write(&path, &said).expect("a page");
    } else {
        assert_eq!(said, text, "{page} is not what the commands say");
    }
    for picture in text.split("](").skip(1).filter_map(|rest| rest.split(')').next()) {
        let drawn = folder.path().join("at-the-end").join(picture);
        if drawn.is_file() {
            let shown = path.with_file_name(picture);
            if overwrite {
                fs::copy(&drawn, &shown).expect("a picture");
            }
            let same = fs::read(&drawn).expect("the picture") == fs::read(&shown).unwrap_or_default();
            assert!(same, "{page} shows another {picture} than is drawn: `TRYCMD=overwrite cargo test -p cli start`");
        }
    }
}

#[test]
fn the_first_ten_minutes_go_as_their_page_says() {
    check("docs/start.md");
}

#[test]
fn the_first_system_goes_as_its_page_says() {
    check("docs/your-first-system.md");
}

#[test]
fn refinement_is_taught_as_its_page_says() {
    check("docs/refinement.md");
}

#[test]
fn mutation_is_taught_as_its_page_says() {
    check("docs/mutation.md");
}

#[test]
fn the_model_on_the_readme_is_answered_so() {
    check("README.md");
}

#[test]
fn a_page_is_cut_before_each_file() {
    let page = "Write `a.txt`:\n\n```text\none\ntwo\n```\n\nRun.\n\n```console\n$ x\n```\n\nIn `a.txt`:\n\n```diff\n one\n-two\n+2\n```\n";
    let pieces = pieces(page);
    let edits: Vec<_> = pieces.iter().map(|piece| (piece.line, piece.edit.as_ref())).collect();
    let written = ("a.txt".to_string(), Edit::Write("one\ntwo\n".to_string()));
    let changed = Edit::Change { from: "one\ntwo\n".to_string(), to: "one\n2\n".to_string() };
    assert_eq!(edits, [(1, None), (3, Some(&written)), (16, Some(&("a.txt".to_string(), changed)))]);
    assert_eq!(pieces.iter().map(|piece| piece.text.as_str()).collect::<String>(), page);
}
