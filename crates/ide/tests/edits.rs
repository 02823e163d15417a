//! What must hold whatever the text: no question panics, and an edited project answers as a fresh one does.
//!
//! A sample of edits by default; with `GROUNDSTATE_FULL` set, many more.

use std::collections::BTreeMap;
use std::path::Path;

use groundstate::Kind;
use ide::{Project, Report};
use syntax::{FileId, Stop, SyntaxKind};
use testkit::repository;

use crate::support::{Texts, project};

/// Numbers that look random and are the same every time.
struct Dice(u64);

impl Dice {
    fn below(&mut self, count: usize) -> usize {
        self.0 = self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        ((self.0 >> 33) as usize) % count.max(1)
    }
}

fn rounds(sample: usize, full: usize) -> usize {
    if testkit::sample::is_full() { full } else { sample }
}

/// The files of some examples, with what they import; with `GROUNDSTATE_FULL` set, of all.
fn examples() -> BTreeMap<String, String> {
    let some = ["examples/coffee_machine", "examples/visual_servoing", "library/patterns", "examples/hanoi"];
    let folders = if rounds(0, 1) == 0 { &some[..] } else { &["examples", "library/patterns"][..] };
    let root = repository::root();
    let mut files = BTreeMap::new();
    for folder in folders {
        for path in repository::files(folder, &["asm", "avalla", "chart", "yaml"]) {
            let name = path.strip_prefix(&root).unwrap_or(&path).to_string_lossy().into_owned();
            if Kind::of(Path::new(&name)).is_some() {
                files.insert(name, std::fs::read_to_string(&path).expect("an example"));
            }
        }
    }
    assert!(files.len() > 20, "the examples are there");
    files
}

/// One edit as people make them: letters typed, a word or a line gone, a line doubled.
fn edit(text: &str, dice: &mut Dice) -> String {
    const TYPED: [&str; 14] =
        ["x", ")", "(", "😀", " := ", "\r\n", "$x", "endpar", "r_", "/*", "\"", "if a then", " = ", "forall $x in "];
    let mut at = dice.below(text.len() + 1);
    while !text.is_char_boundary(at) {
        at -= 1;
    }
    let line_start = text[..at].rfind('\n').map_or(0, |end| end + 1);
    let line_end = text[at..].find('\n').map_or(text.len(), |end| at + end + 1);
    let mut edited = text.to_string();
    match dice.below(4) {
        0 | 1 => edited.insert_str(at, TYPED[dice.below(TYPED.len())]),
        2 => edited.replace_range(line_start..line_end, ""),
        _ => edited.insert_str(line_start, &text[line_start..line_end]),
    }
    edited
}

/// All that can be asked of a place.
fn ask(project: &mut Project<Texts>, path: &str, at: u32) -> String {
    let faults: Vec<Report> = ide::reports(project, path).unwrap_or_default();
    let mut told = format!("{faults:?}");
    told += &format!("{:?}", ide::hover(project, path, at));
    told += &format!("{:?}", ide::definition(project, path, at));
    told += &format!("{:?}", ide::highlights(project, path, at));
    told += &format!("{:?}", ide::completion(project, path, at));
    told += &format!("{:?}", ide::signatures(project, path, at));
    told += &format!("{:?}", ide::outline(project, path));
    told += &format!("{:?}", ide::folding(project, path));
    told += &format!("{:?}", ide::selections(project, path, at));
    told += &format!("{:?}", ide::tokens(project, path).len());
    told += &format!("{:?}", ide::hints(project, path));
    told += &format!("{:?}", ide::links(project, path));
    told += &format!("{:?}", ide::formatted(project, path));
    told += &format!("{:?}", ide::fixes(project, path, (at, at + 20)));
    told += &format!("{:?}", ide::prepare(project, path, at));
    let text = project.text(path).map(|source| source.text).unwrap_or_default();
    if text.is_char_boundary(at as usize) {
        told += &format!("{:?}", ide::layout_in(path, &text, (at, at + 60)));
        told += &format!("{:?}", ide::layout_typed(path, &text, at));
    }
    told += &format!("{:?}", ide::refactorings(project, path, (at, at + 30)));
    told += &format!("{:?}", ide::implementations(project, path, at));
    told += &format!("{:?}", ide::lenses(project, path));
    told += &format!("{:?}", ide::callers(project, path, at));
    told += &format!("{:?}", ide::callees(project, path, at));
    if at.is_multiple_of(4) {
        told += &format!("{:?}", ide::references(project, path, at));
    }
    told
}

/// One question after an edit, so that what is known comes from texts of many ages.
fn ask_one(project: &mut Project<Texts>, path: &str, dice: &mut Dice) {
    let at = dice.below(5_000) as u32;
    match dice.below(12) {
        0 => _ = ide::reports(project, path),
        1 => _ = ide::hover(project, path, at),
        2 => _ = ide::completion(project, path, at),
        3 => _ = ide::tokens(project, path),
        4 => _ = ide::outline(project, path),
        _ => {}
    }
}

/// Makes edits, one after the other, and asks now and then what a project that knows nothing yet is asked, too. Out: how often.
fn edited_is_fresh(seed: u64, edits: usize, most: usize) -> usize {
    let files = examples();
    let names: Vec<&String> = files.keys().collect();
    let mut dice = Dice(seed);
    let mut texts = files.clone();
    let mut edited = project(&files);
    let (mut made, mut compared) = (0, 0);
    while made < edits {
        let mut last = names[0].clone();
        for _ in 0..=dice.below(most) {
            let name = names[dice.below(names.len())].clone();
            let text = edit(&texts[&name], &mut dice);
            edited.set_text(&name, made as i64, text.as_str()).expect("a later version");
            texts.insert(name.clone(), text);
            made += 1;
            if dice.below(6) == 0 {
                // The text of the disk is back.
                edited.close(&name);
                texts.insert(name.clone(), files[&name].clone());
            }
            ask_one(&mut edited, &name, &mut dice);
            last = name;
        }
        // Another file is asked, too: it may import one that changed.
        for path in [&last, names[dice.below(names.len())]] {
            let at = dice.below(texts[path].len() + 1) as u32;
            let mut fresh = project(&texts);
            compared += 1;
            assert_eq!(ask(&mut edited, path, at), ask(&mut fresh, path, at), "{path} at {at}, edit {made}");
        }
    }
    compared
}

#[test]
fn an_edited_project_answers_as_a_fresh_one() {
    // After each edit; then after some of very many.
    assert!(edited_is_fresh(7, rounds(25, 500), 1) >= rounds(50, 1_000));
    let many = rounds(500, 50_000);
    let compared: Vec<usize> = std::thread::scope(|scope| {
        let both = [8, 9].map(|seed| scope.spawn(move || edited_is_fresh(seed, many, 80)));
        both.into_iter().map(|one| one.join().expect("the same answers")).collect()
    });
    assert!(compared.iter().all(|compared| compared * 80 >= many), "{compared:?}");
}

#[test]
fn no_question_panics_on_a_mutant() {
    let files = examples();
    let mut dice = Dice(11);
    for (name, text) in &files {
        for _ in 0..rounds(1, 40) {
            let mut mutant = text.clone();
            for _ in 0..=dice.below(4) {
                mutant = edit(&mutant, &mut dice);
            }
            let mut project = project(&files);
            project.set_text(name, 1, mutant.as_str()).expect("the first version");
            for _ in 0..4 {
                let at = dice.below(mutant.len() + 2) as u32;
                _ = ask(&mut project, name, at);
                _ = ide::rename(&mut project, name, at, "renamed");
                _ = ide::references(&mut project, name, at);
            }
        }
    }
}

#[test]
fn a_renamed_project_has_the_faults_that_it_had() {
    let files = examples();
    let mut dice = Dice(13);
    let faults = |files: &BTreeMap<String, String>| -> Vec<usize> {
        let mut project = project(files);
        let count =
            |path: &String| ide::reports(&mut project, path).map_or(0, |r| r.iter().map(|r| r.faults.len()).sum());
        files.keys().map(count).collect()
    };
    let before = faults(&files);
    let (mut renamed, mut refused) = (0, Vec::new());
    for (name, text) in files.iter().filter(|(name, _)| name.ends_with(".asm")) {
        for _ in 0..rounds(2, 12) {
            let mut project = project(&files);
            let at = dice.below(text.len()) as u32;
            let Ok(place) = ide::prepare(&mut project, name, at) else { continue };
            let old = &text[place.range.0 as usize..place.range.1 as usize];
            let new = if old.chars().all(|c| !c.is_lowercase()) { format!("{old}_NEW") } else { format!("{old}New") };
            match ide::rename(&mut project, name, at, &new) {
                Err(reason) => refused.push(reason),
                Ok(edits) => {
                    let mut after = files.clone();
                    for (file, edits) in edits {
                        let text = ide::edited(&after[&file], &edits);
                        after.insert(file, text);
                    }
                    assert_eq!(faults(&after), before, "{old} of {name} as {new}");
                    renamed += 1;
                }
            }
        }
    }
    assert!(renamed > 5, "{renamed} renamed; {refused:?}");
}

/// A text whose white space is other than it was, and nothing else.
fn spread(text: &str, path: &str, dice: &mut Dice) -> String {
    let tree = match Kind::of(Path::new(path)) {
        Some(Kind::Scenario) => syntax::parse_avalla(FileId(0), text),
        Some(Kind::Chart) => syntax::parse_chart(FileId(0), text),
        _ => syntax::parse_asmetal(FileId(0), text),
    };
    let mut spread = String::new();
    let mut after_line_comment = false;
    for token in tree.syntax().descendants_with_tokens().filter_map(|element| element.into_token()) {
        if token.kind() == SyntaxKind::WHITESPACE && dice.below(3) == 0 {
            const SPACES: [&str; 5] = [" ", "\n", "   ", "\n\t\t\t\t\t", " \n\n  "];
            let space = SPACES[if after_line_comment { 1 + 2 * dice.below(2) } else { dice.below(SPACES.len()) }];
            spread.push_str(if after_line_comment && space == "   " { "\n" } else { space });
        } else {
            spread.push_str(token.text());
        }
        after_line_comment = token.kind() == SyntaxKind::LINE_COMMENT;
    }
    spread
}

#[test]
fn layout_of_a_part_changes_white_space_of_that_part_alone() {
    let mut dice = Dice(17);
    let mut changed = 0;
    for (name, text) in examples().iter().filter(|(name, _)| !name.ends_with("yaml")) {
        for _ in 0..rounds(2, 60) {
            let text = spread(text, name, &mut dice);
            let start = dice.below(text.len());
            let length = if dice.below(2) == 0 { 400 } else { text.len() };
            let end = (start + dice.below(length)).min(text.len());
            if !text.is_char_boundary(start) || !text.is_char_boundary(end) {
                continue;
            }
            let whole = |text: &str| ide::formatted(&mut project(&[(name.clone(), text.to_string())].into()), name);
            let Ok(formatted) = whole(&text) else { continue };
            let part = ide::layout_in(name, &text, (start as u32, end as u32)).expect("no errors");
            let typed = ide::layout_typed(name, &text, start as u32);
            for edits in [part, typed] {
                changed += edits.len();
                let after = ide::edited(&text, &edits);
                let words = |text: &str| text.split_whitespace().collect::<String>();
                assert_eq!(words(&after), words(&text), "{name}");
                assert_eq!(whole(&after).as_ref(), Ok(&formatted), "{name} {start} {end}\n{text}\n====\n{after}");
            }
            let outside = ide::layout_in(name, &text, (start as u32, end as u32)).expect("no errors");
            let inside = |edit: &ide::Edit| start as u32 <= edit.range.0 && edit.range.1 <= end as u32;
            assert!(outside.iter().all(inside), "{name} {start} {end}");
        }
    }
    assert!(changed > 100, "{changed} edits");
}

#[test]
fn a_check_that_is_stopped_leaves_nothing_behind() {
    let files = examples();
    let stop = Stop::new();
    let mut stopped = 0;
    for name in files.keys().filter(|name| name.ends_with(".asm")) {
        let mut edited = project(&files);
        edited.set_stop(stop.clone());
        let whole = ide::reports(&mut edited, name).expect("a file");
        let looks = stop.looks();
        for after in [0, 1, looks / 3, looks / 2, looks - 1] {
            let mut again = project(&files);
            again.set_stop(stop.clone());
            stop.clear();
            stop.ask_after(after);
            assert!(ide::reports(&mut again, name).is_err(), "{name} after {after} of {looks} looks");
            stopped += 1;
            stop.clear();
            assert_eq!(ide::reports(&mut again, name).as_ref(), Ok(&whole), "{name} after {after}");
        }
        stop.clear();
    }
    assert!(stopped > 20, "{stopped}");
}

#[test]
fn a_long_text_is_looked_up_from_often() {
    let stop = Stop::new();
    let looks = |rules: usize| {
        let rule = |index| format!("\trule r_{index} = par n := 1 n := 1 + 1 n := {index} endpar\n");
        let rules: String = (0..rules).map(rule).collect();
        let text =
            format!("asm Long\nsignature:\n\tcontrolled n: Integer\ndefinitions:\n{rules}\tmain rule r_Main = skip\n");
        let mut project = project(&[("Long.asm".to_string(), text)].into());
        stop.clear();
        project.set_stop(stop.clone());
        ide::reports(&mut project, "Long.asm").expect("a file");
        stop.looks()
    };
    // Once for each rule while it is checked, and now and then while it is read: no part of the text is long without a look.
    let (few, many) = (looks(500), looks(5_000));
    assert!(few > 500 && many > 5_000 && many > few + 4_500, "{few}, {many}");
}
