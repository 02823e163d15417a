//! The pages of `spec/ide`: files with a mark where the cursor is, questions, and their answers.
//!
//! A block `text FILE` is a file; `‸` in it is the cursor and not part of it. The blocks after it, until the next file that comes
//! after an answer, are questions about the cursor, each with the answer that is expected. With `UPDATE_EXPECT` set the answers
//! are written into the pages.

use std::collections::BTreeMap;
use std::fmt::Write;

use ide::{Encoding, Entry, Lines, Place, Project};
use testkit::{Page, repository};

use crate::support::{Texts, project};

const CURSOR: char = '‸';

fn check(name: &str) {
    let page = Page::spec(&format!("ide/{name}"));
    let mut files: BTreeMap<String, String> = BTreeMap::new();
    let mut cursor: Option<(String, u32)> = None;
    let mut asked = false;
    let mut wrong = Vec::new();
    let mut mended = page.text.clone();
    let blocks = page.blocks();
    for block in &blocks {
        if let Some(file) = block.info.strip_prefix("text ") {
            if asked {
                (files, cursor, asked) = (BTreeMap::new(), None, false);
            }
            if let Some(at) = block.text.find(CURSOR) {
                cursor = Some((file.to_string(), at as u32));
            }
            files.insert(file.to_string(), block.text.replace(CURSOR, ""));
            continue;
        }
        asked = true;
        let (file, at) = cursor.clone().unwrap_or_else(|| panic!("{}:{}: no cursor", page.path, block.line));
        let answer = answer(&mut project(&files), block.info, &file, at);
        if answer.trim_end() != block.text.trim_end() {
            wrong.push(format!("{}:{}: {} gives\n{answer}", page.path, block.line, block.info));
            let fence = format!("```{}\n", block.info);
            let start: usize = page.text.split_inclusive('\n').take(block.line).map(str::len).sum();
            assert!(page.text[..start].ends_with(&fence));
            let shift = mended.len() as i64 - page.text.len() as i64;
            let from = (start as i64 + shift) as usize;
            let text = if answer.is_empty() { String::new() } else { format!("{}\n", answer.trim_end()) };
            mended.replace_range(from..from + block.text.len(), &text);
        }
    }
    if std::env::var_os("UPDATE_EXPECT").is_some() {
        std::fs::write(repository::root().join(&page.path), mended).expect("the page is written");
        return;
    }
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}

/// `FILE:LINE:COLUMN-LINE:COLUMN`, counted from 1, with the text that stands there.
fn place(project: &mut Project<Texts>, place: &Place) -> String {
    let Ok(source) = project.text(&place.path) else { return format!("{} is not there", place.path) };
    let lines = Lines::new(source.text.clone());
    let start = lines.position(place.range.0 as usize, Encoding::Utf32);
    let text = &source.text[place.range.0 as usize..place.range.1 as usize];
    format!("{}:{}:{} {}", place.path, start.line + 1, start.column + 1, text.replace('\n', "⏎"))
}

fn answer(project: &mut Project<Texts>, question: &str, file: &str, at: u32) -> String {
    let (question, rest) = question.split_once(' ').unwrap_or((question, ""));
    let mut lines: Vec<String> = Vec::new();
    match question {
        "hover" => {
            return ide::hover(project, file, at).map(|hover| hover.text.replace("```", "~~~")).unwrap_or_default();
        }
        "definition" => {
            for found in ide::definition(project, file, at) {
                lines.push(place(project, &found));
            }
        }
        "implementations" => {
            for found in ide::implementations(project, file, at) {
                lines.push(place(project, &found));
            }
        }
        "references" => {
            for found in ide::references(project, file, at) {
                lines.push(format!("{} ({:?})", place(project, &found.place), found.role));
            }
        }
        "highlights" => {
            for found in ide::highlights(project, file, at) {
                lines.push(format!("{} ({:?})", place(project, &found.place), found.role));
            }
        }
        "links" => {
            for (from, to) in ide::links(project, file) {
                lines.push(format!("{} leads to {to}", place(project, &from)));
            }
        }
        "rename" => match ide::rename(project, file, at, rest) {
            Err(reason) => lines.push(format!("refused: {reason}")),
            Ok(edits) => {
                for (file, edits) in edits {
                    let text = project.text(&file).expect("a file that is edited").text;
                    let after = ide::edited(&text, &edits);
                    let changed = text.lines().zip(after.lines()).filter(|(before, after)| before != after);
                    lines.extend(changed.map(|(_, after)| format!("{file}: {}", after.trim())));
                }
            }
        },
        "completion" => {
            let completion = ide::completion(project, file, at);
            let count: usize = rest.parse().unwrap_or(10);
            for item in completion.items.iter().take(count) {
                lines.push(format!("{} ({:?}) {}", item.label, item.kind, item.detail).trim_end().to_string());
            }
        }
        "signature" => {
            if let Some(found) = ide::signatures(project, file, at) {
                for (index, signature) in found.signatures.iter().enumerate() {
                    let mark = if index == found.active { ">" } else { " " };
                    let parameter = signature
                        .parameters
                        .get(found.parameter)
                        .map(|(start, end)| &signature.label[*start as usize..*end as usize]);
                    lines.push(format!("{mark} {} [{}]", signature.label, parameter.unwrap_or_default()));
                }
            }
        }
        "diagnostics" => {
            for report in ide::reports(project, file).expect("a file") {
                for fault in report.faults {
                    let found = Place { path: report.path.clone(), range: fault.range };
                    let found = place(project, &found);
                    lines.push(format!("{found}: {:?} {} {}", fault.weight, fault.id, fault.message));
                    for (related, text) in fault.related {
                        lines.push(format!("  {}: {text}", place(project, &related)));
                    }
                }
            }
        }
        "fixes" => {
            let all = (0, project.text(file).expect("a file").text.len() as u32);
            for fix in ide::fixes(project, file, all) {
                let text = project.text(file).expect("a file").text;
                let after = ide::edited(&text, &fix.edits);
                lines.push(format!("{}:", fix.title));
                let changed = after.lines().filter(|line| !text.lines().any(|before| before == *line));
                lines.extend(changed.map(|line| format!("    {}", line.trim())));
            }
        }
        "refactorings" => {
            let text = project.text(file).expect("a file").text;
            // What is chosen ends behind the words that the question has.
            let end = if rest.is_empty() { at } else { end_of(&text, at, rest) };
            for found in ide::refactorings(project, file, (at, end)) {
                lines.push(format!("{:?}: {}", found.kind, found.title));
            }
        }
        "refactored" => {
            let (title, rest) = rest.split_once(" | ").unwrap_or((rest, ""));
            let text = project.text(file).expect("a file").text;
            let end = if rest.is_empty() { at } else { end_of(&text, at, rest) };
            let all = ide::refactorings(project, file, (at, end));
            return match all.iter().find(|found| found.title == title) {
                Some(found) => ide::edited(&text, &found.edits),
                None => format!("not offered, but {:?}", all.iter().map(|found| &found.title).collect::<Vec<_>>()),
            };
        }
        "outline" => {
            let found = ide::outline(project, file);
            tell(&found, 0, &mut lines);
        }
        "search" => {
            for (entry, found) in ide::search(project, rest) {
                lines.push(format!("{:?} {}", entry.kind, place(project, &found)));
            }
        }
        "folding" => {
            let text = Lines::new(project.text(file).expect("a file").text.clone());
            for ((start, end), kind) in ide::folding(project, file) {
                let line = |at: u32| text.position(at as usize, Encoding::Utf8).line + 1;
                lines.push(format!("{}-{} {kind:?}", line(start), line(end)));
            }
        }
        "selections" => {
            for (start, end) in ide::selections(project, file, at) {
                lines.push(place(project, &Place { path: file.to_string(), range: (start, end) }));
            }
        }
        "tokens" => {
            for token in ide::tokens(project, file) {
                let text = project.text(file).expect("a file").text;
                let mut line = text[token.range.0 as usize..token.range.1 as usize].to_string();
                _ = write!(line, " {:?}", token.kind);
                for modifier in token.modifiers {
                    _ = write!(line, " {modifier:?}");
                }
                lines.push(line);
            }
        }
        "hints" => {
            let mut text = project.text(file).expect("a file").text.to_string();
            for hint in ide::hints(project, file).iter().rev() {
                text.insert_str(hint.at as usize, &format!("⟨{}⟩", hint.text));
            }
            lines.extend(text.lines().filter(|line| line.contains('⟨')).map(|line| line.trim().to_string()));
        }
        "lenses" => {
            for lens in ide::lenses(project, file) {
                lines.push(format!(
                    "{}: {}",
                    place(project, &Place { path: file.to_string(), range: lens.range }),
                    lens.title
                ));
            }
        }
        "callers" => {
            for caller in ide::callers(project, file, at) {
                lines.push(format!("{} ×{}", place(project, &caller.place), caller.calls.len()));
            }
        }
        "callees" => {
            for called in ide::callees(project, file, at) {
                lines.push(format!("{} ×{}", place(project, &called.place), called.calls.len()));
            }
        }
        "laid-out" => {
            let text = project.text(file).expect("a file").text;
            return match ide::layout_in(file, &text, (at, end_of(&text, at, rest))) {
                Ok(edits) => ide::edited(&text, &edits),
                Err(reason) => format!("refused: {reason}"),
            };
        }
        "typed" => {
            let text = project.text(file).expect("a file").text;
            return ide::edited(&text, &ide::layout_typed(file, &text, at));
        }
        "formatted" => return ide::formatted(project, file).unwrap_or_else(|reason| format!("refused: {reason}")),
        other => panic!("no question is called {other}"),
    }
    lines.join("\n")
}

/// Where words end that stand at or behind an offset.
fn end_of(text: &str, at: u32, words: &str) -> u32 {
    let behind = text[at as usize..].find(words).unwrap_or_else(|| panic!("no `{words}` behind the cursor"));
    at + (behind + words.len()) as u32
}

fn tell(entries: &[Entry], depth: usize, lines: &mut Vec<String>) {
    for entry in entries {
        lines.push(
            format!("{}{} ({:?}) {}", "  ".repeat(depth), entry.name, entry.kind, entry.detail).trim_end().into(),
        );
        tell(&entry.inner, depth + 1, lines);
    }
}

#[test]
fn names() {
    check("names");
}

#[test]
fn rename() {
    check("rename");
}

#[test]
fn completion() {
    check("completion");
}

#[test]
fn diagnostics() {
    check("diagnostics");
}

#[test]
fn structure() {
    check("structure");
}

#[test]
fn refactoring() {
    check("refactoring");
}

#[test]
fn layout() {
    check("layout");
}
