//! Where the files of a project name one of them: what has to follow when it gets another name, and what breaks when it goes.
//!
//! In: the path of a file. Out: places, each the part of a path that is the file's own name. A place `follows` if the new name can be
//! written there: an import, a `load`, a machine of a phase, a path in a specification, the name in the file's own first line. What else
//! has its name, as a comment does, is told. INVARIANT: a path that leads to another file of the same name is no place.

use std::collections::BTreeSet;
use std::ops::Range;
use std::path::Path;

use groundstate::Kind;
use groundstate::syntax::ast::{AstNode, ChartFile, ExecBlockCommand, ScenarioFile, SourceFile};
use groundstate::syntax::{FileId, parse_asmetal, parse_avalla, parse_chart};
use groundstate::workspace::tidy;
use ide::{Encoding, Lines, Project, links};
use serde_json::{Value, json};

use crate::folder::Folder;
use crate::home::Home;
use crate::sources::Inside;

/// The places that name a file; and the folder of its C++, if there is one.
///
/// # Errors
/// It is no file of a project; a sentence.
pub fn of(folder: &Folder, path: &str, files: &[String]) -> Result<Value, String> {
    folder.place(path)?;
    let stem = stem(path).ok_or_else(|| format!("`{}` is no file of a project", path.escape_debug()))?;
    let mut project = Project::new(Inside(folder));
    let mut found = Vec::new();
    for file in files {
        // What cannot be read names nothing that could be told.
        let Ok(Some(text)) = folder.read(file) else { continue };
        if !text.contains(stem) {
            continue;
        }
        let led = links(&mut project, file).into_iter().filter(|(_, target)| tidy(target) == path);
        let words: Vec<Range<usize>> = led
            .map(|(place, _)| place.range.0 as usize..place.range.1 as usize)
            .chain(blocks(folder, file, &text, path))
            .collect();
        let is_data = matches!(Kind::of(Path::new(file)), Some(Kind::Report | Kind::Verification));
        let mut ranges: BTreeSet<(usize, usize, bool)> = BTreeSet::new();
        ranges.extend(words.iter().map(|word| match last_part(&text, word, stem) {
            Some(part) => (part.start, part.end, true),
            None => (word.start, word.end, false),
        }));
        for part in written(file, &text, path) {
            if !words.iter().any(|word| word.start <= part.start && part.end <= word.end) {
                ranges.insert((part.start, part.start + stem.len(), is_data));
            }
        }
        ranges.extend(own_name(file, &text, path, stem).map(|part| (part.start, part.end, true)));
        let lines = Lines::new(text.into());
        let at = |offset: usize| {
            let at = lines.position(offset, Encoding::Utf16);
            json!({ "line": at.line, "character": at.column })
        };
        found.extend(ranges.into_iter().map(|(start, end, follows)| {
            json!({ "path": file, "range": { "start": at(start), "end": at(end) }, "follows": follows })
        }));
    }
    let home = Home::of(folder, path).ok().filter(|home| folder.place(&home.path).is_ok_and(|place| place.is_dir()));
    let home = home.map(|home| json!({ "path": home.path, "isOwn": home.is_own }));
    Ok(json!({ "places": found, "program": home }))
}

/// The name of a file without its folder and its ending.
fn stem(path: &str) -> Option<&str> {
    Kind::of(Path::new(path))?;
    let name = path.rsplit('/').next()?;
    Kind::ENDINGS.iter().find_map(|ending| name.strip_suffix(ending)?.strip_suffix('.'))
}

/// The part of a path in a text that is the file's own name.
fn last_part(text: &str, word: &Range<usize>, stem: &str) -> Option<Range<usize>> {
    let inner = text[word.clone()].trim_end_matches('"');
    let at = word.start + inner.rfind(['/', '\\', '"']).map_or(0, |at| at + 1);
    let rest = text[at..word.start + inner.len()].strip_prefix(stem)?;
    matches!(rest, "" | ".asm" | ".avalla" | ".chart").then(|| at..at + stem.len())
}

/// The names of scenarios before the colon of blocks that are played, where they are this file.
fn blocks(folder: &Folder, file: &str, text: &str, path: &str) -> Vec<Range<usize>> {
    if Kind::of(Path::new(file)) != Some(Kind::Scenario) {
        return Vec::new();
    }
    let tree = parse_avalla(FileId(0), text).syntax();
    let calls = tree.descendants().filter_map(ExecBlockCommand::cast).filter_map(|call| call.file());
    let leads = |name: &str| beside(file, &format!("{name}.avalla")) == path && folder.read(path).is_ok();
    calls.filter(|name| leads(name.text())).map(|name| name.text_range().into()).collect()
}

/// Where a text has the file's name with its ending, as a path that leads to it.
fn written(file: &str, text: &str, path: &str) -> Vec<Range<usize>> {
    let name = path.rsplit('/').next().unwrap_or(path);
    let is_part = |c: char| c.is_alphanumeric() || matches!(c, '_' | '-' | '.' | '/');
    let found = text.match_indices(name).map(|(at, _)| at..at + name.len());
    let leads = |range: &Range<usize>| {
        let before = text[..range.start].rfind(|c: char| !is_part(c));
        let from = before.map_or(0, |at| at + text[at..].chars().next().map_or(1, char::len_utf8));
        let ends = !text[range.end..].starts_with(|c: char| c.is_alphanumeric() || matches!(c, '_' | '-'));
        let whole = &text[from..range.end];
        ends && (beside(file, whole) == path || (whole.contains('/') && tidy(whole) == path))
    };
    found.filter(leads).collect()
}

/// The name in the first line of the file itself, if it is the file's.
fn own_name(file: &str, text: &str, path: &str, stem: &str) -> Option<Range<usize>> {
    if file != path {
        return None;
    }
    let name = match Kind::of(Path::new(path))? {
        Kind::Model => SourceFile::cast(parse_asmetal(FileId(0), text).syntax())?.machine_name()?.name(),
        Kind::Chart => ChartFile::cast(parse_chart(FileId(0), text).syntax())?.name(),
        Kind::Scenario => ScenarioFile::cast(parse_avalla(FileId(0), text).syntax())?.name(),
        Kind::Report | Kind::Verification | Kind::Coupling => None,
    }?;
    (name.text() == stem).then(|| name.text_range().into())
}

/// Where a path leads from a file.
pub fn beside(file: &str, path: &str) -> String {
    tidy(&Path::new(file).parent().unwrap_or(Path::new("")).join(path).to_string_lossy())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_names_a_file_is_found() {
        let place = tempfile::tempdir().expect("a folder");
        let module = "module Kinds\n// Kinds.asm is small\nsignature:\ndefinitions:\n";
        let importer = |path: &str| format!("asm A\nimport {path}\nsignature:\ndefinitions:\n\tmain rule r_m = skip\n");
        let files = [
            ("Kinds.asm", module.to_string()),
            ("A.asm", importer("Kinds")),
            ("sub/B.asm", importer("../Kinds.asm")),
            ("sub/Kinds.asm", module.to_string()),
            ("sub/C.asm", importer("Kinds")),
            ("A.chart", "chart A\nimport \"Kinds.asm\"\n// Kinds\n".to_string()),
            ("A.avalla", "scenario A\nload A.asm\nexecblock Begin:first\n// A.asm\n".to_string()),
            ("Begin.avalla", "scenario Begin\nload A.asm\nbegin first\nstep\nend\n".to_string()),
            ("A.report.yaml", "charts:\n  A.chart: {}\n  sub/A.chart: {}\n".to_string()),
            ("A.refine", "refinement of A\nabstract \"A.asm\";\nconcrete \"sub/B.asm\";\n".to_string()),
            ("arm/CMakeLists.txt", "# The arm of A.chart.\n".to_string()),
        ];
        for (name, text) in &files {
            let file = place.path().join(name);
            std::fs::create_dir_all(file.parent().expect("it has one")).expect("made");
            std::fs::write(file, text).expect("written");
        }
        let folder = Folder::at(place.path()).expect("it is one");
        let known: Vec<String> = files.iter().map(|(name, _)| name.to_string()).collect();
        let check = |path: &str, expected: &str| {
            let found = of(&folder, path, &known).expect("a file of the project");
            let told: Vec<String> = found["places"]
                .as_array()
                .expect("places")
                .iter()
                .map(|place| {
                    let (start, end) = (&place["range"]["start"], &place["range"]["end"]);
                    let sign = if place["follows"] == true { ' ' } else { '?' };
                    let file = place["path"].as_str().expect("a path");
                    format!("{file}{sign}{}:{}-{}", start["line"], start["character"], end["character"])
                })
                .collect();
            assert_eq!(told.join("\n"), expected, "{path}");
        };
        check("Kinds.asm", "Kinds.asm 0:7-12\nKinds.asm?1:3-8\nA.asm 1:7-12\nsub/B.asm 1:10-15\nA.chart 1:8-13");
        check("sub/Kinds.asm", "sub/Kinds.asm 0:7-12\nsub/Kinds.asm?1:3-8\nsub/C.asm 1:7-12");
        check("A.asm", "A.asm 0:4-5\nA.avalla 1:5-6\nA.avalla?3:3-4\nBegin.avalla 1:5-6\nA.refine 1:10-11");
        check("A.chart", "A.chart 0:6-7\nA.report.yaml 1:2-3");
        check("Begin.avalla", "A.avalla 2:10-15\nBegin.avalla 0:9-14");
        let program = of(&folder, "A.chart", &known).expect("a chart")["program"].clone();
        assert_eq!(program, json!({ "path": "arm", "isOwn": true }));
        assert!(of(&folder, "arm/CMakeLists.txt", &known).is_err());
        assert!(of(&folder, "../A.chart", &known).is_err());
    }
}
