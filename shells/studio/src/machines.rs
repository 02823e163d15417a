//! The name of a machine of a chart: where it stands, so that it gets another one everywhere, or is found before the machine goes.
//!
//! In: a chart, and the name of a machine, a pattern or a system in it. Out: its places: its head, its layout, blocks and refinements that
//! name it, here and in charts that import this one, and the machines of report specifications; what it shows; the lines that go with it;
//! names that nothing may have beside it. INVARIANT: a name that means another machine is no place.

use std::collections::BTreeSet;
use std::ops::Range;
use std::path::Path;

use groundstate::Kind;
use groundstate::chart::WORDS;
use groundstate::report::read_specification;
use groundstate::syntax::ast::{AstNode, ChartFile, Layout, PatternInstance, Refinement};
use groundstate::syntax::{FileId, SyntaxKind, SyntaxNode, SyntaxToken, parse_chart};
use groundstate::workspace::tidy;
use ide::{Encoding, Lines, Project, links};
use serde_json::{Value, json};

use crate::folder::Folder;
use crate::names::beside;
use crate::sources::Inside;

/// What is to be known before a machine gets another name, or goes.
///
/// # Errors
/// There is no such machine; a sentence.
pub fn of(folder: &Folder, path: &str, name: &str, files: &[String]) -> Result<Value, String> {
    let (chart, text) = chart(folder, path).ok_or_else(|| format!("`{}` is no chart", path.escape_debug()))?;
    let own = sections(&chart).find(|section| head(section).is_some_and(|token| token.text() == name));
    let (own, named) = own
        .and_then(|own| Some((head(&own)?, own)).map(|(named, own)| (own, named)))
        .ok_or_else(|| format!("there is no machine `{}` in {path}", name.escape_debug()))?;
    let layouts: Vec<Layout> = chart.layouts().filter(|layout| is(layout.name(), name)).collect();
    let mut project = Project::new(Inside(folder));
    let mut taken: BTreeSet<String> = sections(&chart).filter_map(|section| head(&section)).map(word).collect();
    for (_, target) in links(&mut project, path) {
        let imported = self::chart(folder, &target).into_iter().flat_map(|(other, _)| patterns(&other));
        taken.extend(imported);
    }
    let lines = Lines::new(text.as_str().into());
    let mut places = Vec::new();
    let declared = [&named].into_iter().cloned().chain(layouts.iter().filter_map(Layout::name));
    for token in declared {
        places.push(place(path, &lines, token.text_range().into(), true));
    }
    places.extend(uses(&chart, name).map(|token| place(path, &lines, token.text_range().into(), false)));
    for file in files.iter().filter(|file| *file != path) {
        match Kind::of(Path::new(file)) {
            Some(Kind::Chart) if links(&mut project, file).iter().any(|(_, target)| tidy(target) == path) => {
                let Some((other, text)) = self::chart(folder, file) else { continue };
                let heads: Vec<String> = sections(&other).filter_map(|section| head(&section)).map(word).collect();
                if !heads.iter().any(|head| head == name) {
                    let lines = Lines::new(text.into());
                    places
                        .extend(uses(&other, name).map(|token| place(file, &lines, token.text_range().into(), false)));
                }
                taken.extend(heads);
            }
            Some(Kind::Report) => places.extend(shown(folder, file, path, name)),
            _ => {}
        }
    }
    taken.remove(name);
    taken.extend(WORDS.map(str::to_string));
    let title = title(&text, &own, &named);
    let going = std::iter::once(own.text_range()).chain(layouts.iter().map(|layout| layout.syntax().text_range()));
    let going = whole_lines(&text, going.map(Range::from)).into_iter();
    let going: Vec<Value> = going.map(|range| at(&lines, range)).collect();
    Ok(json!({ "places": places, "title": at(&lines, title), "lines": going, "taken": taken }))
}

fn chart(folder: &Folder, path: &str) -> Option<(ChartFile, String)> {
    if Kind::of(Path::new(path)) != Some(Kind::Chart) {
        return None;
    }
    folder.place(path).ok()?;
    let text = folder.read(path).ok()??;
    Some((ChartFile::cast(parse_chart(FileId(0), &text).syntax())?, text))
}

/// Machines, patterns and systems.
fn sections(chart: &ChartFile) -> impl Iterator<Item = SyntaxNode> + use<> {
    let kinds = [SyntaxKind::MACHINE_CHART, SyntaxKind::SYSTEM_CHART];
    chart.syntax().children().filter(move |node| kinds.contains(&node.kind()))
}

fn head(section: &SyntaxNode) -> Option<SyntaxToken> {
    let mut tokens = section.children_with_tokens().filter_map(|element| element.into_token());
    tokens.find(|token| token.kind() == SyntaxKind::GENERIC_ID)
}

fn word(token: SyntaxToken) -> String {
    token.text().to_string()
}

fn is(token: Option<SyntaxToken>, name: &str) -> bool {
    token.is_some_and(|token| token.text() == name)
}

fn patterns(chart: &ChartFile) -> Vec<String> {
    let patterns = chart.machines().filter(|machine| machine.is_pattern());
    patterns.filter_map(|machine| machine.name()).map(word).collect()
}

/// Blocks of a pattern, and shapes that it refines.
fn uses(chart: &ChartFile, name: &str) -> impl Iterator<Item = SyntaxToken> {
    let named = |node: SyntaxNode| match node.kind() {
        SyntaxKind::PATTERN_INSTANCE => PatternInstance::cast(node)?.pattern(),
        SyntaxKind::REFINEMENT => Refinement::cast(node)?.by(),
        _ => None,
    };
    chart.syntax().descendants().filter_map(named).filter(move |token| token.text() == name)
}

/// Where a report specification shows the machine.
fn shown(folder: &Folder, file: &str, path: &str, name: &str) -> Vec<Value> {
    let Ok(Some(text)) = folder.read(file) else { return Vec::new() };
    let Ok(specification) = read_specification(FileId(0), &text) else { return Vec::new() };
    let lines = Lines::new(text.as_str().into());
    let charts = specification.charts.iter().filter(|wanted| beside(file, &wanted.file) == path);
    let machines = charts.flat_map(|wanted| &wanted.machines).filter(|machine| machine.name == name);
    let range = |machine: &groundstate::report::WantedMachine| {
        let written = machine.span.range();
        // A key may be in quotation marks.
        let from = written.start + text[written.clone()].find(name)?;
        Some(place(file, &lines, from..from + name.len(), false))
    };
    machines.filter_map(range).collect()
}

/// The text that a machine shows, from behind the name and the parameters on; without one, the place there.
fn title(text: &str, section: &SyntaxNode, named: &SyntaxToken) -> Range<usize> {
    let parameters = section.children().find(|child| child.kind() == SyntaxKind::PARAMETER_LIST);
    let before: usize = parameters.map_or(named.text_range(), |list| list.text_range()).end().into();
    let mut tokens = section.children_with_tokens().filter_map(|element| element.into_token());
    let shown = tokens.find(|token| token.kind() == SyntaxKind::STRING).map(|token| Range::from(token.text_range()));
    match shown {
        Some(shown) if text[before..shown.start].trim().is_empty() => before..shown.end,
        // A comment between the two stays.
        Some(shown) => shown,
        None => before..before,
    }
}

/// The lines that sections stand in, with the blank ones behind them; at the end of the text, with those before.
fn whole_lines(text: &str, sections: impl Iterator<Item = Range<usize>>) -> Vec<Range<usize>> {
    let mut sections: Vec<Range<usize>> = sections.collect();
    sections.sort_by_key(|section| section.start);
    let mut found: Vec<Range<usize>> = Vec::new();
    for section in sections {
        let line = text[..section.start].rfind('\n').map_or(0, |at| at + 1);
        let start = if text[line..section.start].trim().is_empty() { line } else { section.start };
        let blank = text[section.end..].split_inclusive('\n').take_while(|line| line.trim().is_empty());
        let end = section.end + blank.map(str::len).sum::<usize>();
        match found.last_mut() {
            Some(last) if last.end >= start => last.end = end,
            _ => found.push(start..end),
        }
    }
    if let Some(last) = found.last_mut().filter(|last| last.end == text.len()) {
        let kept = text[..last.start].trim_end().len();
        last.start = kept + text[kept..last.start].find('\n').map_or(last.start - kept, |at| at + 1);
    }
    found
}

fn at(lines: &Lines, range: Range<usize>) -> Value {
    let position = |offset: usize| {
        let at = lines.position(offset, Encoding::Utf16);
        json!({ "line": at.line, "character": at.column })
    };
    json!({ "start": position(range.start), "end": position(range.end) })
}

fn place(path: &str, lines: &Lines, range: Range<usize>, is_own: bool) -> Value {
    json!({ "path": path, "range": at(lines, range), "isOwn": is_own })
}

#[cfg(test)]
mod tests {
    use super::*;

    const PARTS: &str = "chart Parts // grip\nimport \"Tools.chart\"\n\nmachine arm ($a in Arm) \"grip\"\n\tcontrol {arm($a)}\n\tinitial state up\n\tinstance g of grip\n\taction held {skip} to refine by grip\n\tup -> g -> up\nendmachine\n\npattern grip\n\taction grip\n\tenter -> grip -> exit\nendpattern\n\nlayout grip\n\tgrip at 1, 2\nendlayout\n";
    const OTHER: &str =
        "chart Other\nimport \"Parts.chart\"\npattern wave\n\tinstance g of grip\n\tenter -> g -> exit\nendpattern\n";
    // It has a pattern of that name itself.
    const APART: &str =
        "chart Apart\nimport \"Parts.chart\"\npattern grip\n\tinstance g of grip\n\tenter -> g -> exit\nendpattern\n";
    const TOOLS: &str = "chart Tools\npattern press\n\tenter -> exit\nendpattern\nmachine lone\nendmachine\n";

    fn asked(path: &str, name: &str) -> Result<(Value, Folder, tempfile::TempDir), String> {
        let place = tempfile::tempdir().expect("a folder");
        let report = "charts:\n  Parts.chart:\n    machines:\n      arm: {}\n      grip: {}\n";
        let files = [
            ("Parts.chart", PARTS),
            ("sub/Parts.chart", PARTS),
            ("Other.chart", OTHER),
            ("Apart.chart", APART),
            ("Tools.chart", TOOLS),
            ("Parts.report.yaml", report),
        ];
        for (name, text) in files {
            let file = place.path().join(name);
            std::fs::create_dir_all(file.parent().expect("it has one")).expect("made");
            std::fs::write(file, text).expect("written");
        }
        let folder = Folder::at(place.path()).expect("it is one");
        let known: Vec<String> = files.iter().map(|(name, _)| name.to_string()).collect();
        Ok((of(&folder, path, name, &known)?, folder, place))
    }

    /// The text of a range, and where it begins.
    fn cut(text: &str, range: &Value) -> String {
        let lines: Vec<&str> = text.split_inclusive('\n').collect();
        let offset = |at: &Value| {
            let line = at["line"].as_u64().expect("a line") as usize;
            lines[..line].iter().map(|line| line.len()).sum::<usize>()
                + at["character"].as_u64().expect("a column") as usize
        };
        text[offset(&range["start"])..offset(&range["end"])].to_string()
    }

    #[test]
    fn what_names_a_machine_is_found() {
        let check = |name: &str, expected: &[&str]| {
            let (found, folder, _place) = asked("Parts.chart", name).expect("a machine");
            let told = found["places"].as_array().expect("places").iter().map(|place| {
                let file = place["path"].as_str().expect("a path");
                let text = folder.read(file).expect("read").expect("a text");
                assert_eq!(cut(&text, &place["range"]), name);
                let sign = if place["isOwn"] == true { "" } else { "?" };
                format!("{file}:{}{sign}", place["range"]["start"]["line"])
            });
            assert_eq!(told.collect::<Vec<_>>(), expected, "{name}");
        };
        check(
            "grip",
            &[
                "Parts.chart:11",
                "Parts.chart:16",
                "Parts.chart:6?",
                "Parts.chart:7?",
                "Other.chart:3?",
                "Parts.report.yaml:4?",
            ],
        );
        check("arm", &["Parts.chart:3", "Parts.report.yaml:3?"]);
        assert!(asked("Parts.chart", "held").is_err_and(|told| told == "there is no machine `held` in Parts.chart"));
        assert!(asked("Parts.report.yaml", "arm").is_err());
        assert!(asked("../Parts.chart", "arm").is_err());
    }

    #[test]
    fn a_name_is_taken_by_what_would_be_mistaken_for_it() {
        let (found, ..) = asked("Parts.chart", "grip").expect("a machine");
        let taken: Vec<&str> = found["taken"].as_array().expect("names").iter().filter_map(Value::as_str).collect();
        let check = |name: &str, is_taken: bool| assert_eq!(taken.contains(&name), is_taken, "{name}");
        ["arm", "press", "wave", "endmachine"].into_iter().for_each(|name| check(name, true));
        ["grip", "lone", "held"].into_iter().for_each(|name| check(name, false));
    }

    #[test]
    fn a_machine_goes_with_its_layout() {
        let check = |name: &str, title: &str, going: &[&str]| {
            let (found, ..) = asked("Parts.chart", name).expect("a machine");
            assert_eq!(cut(PARTS, &found["title"]), title);
            let lines = found["lines"].as_array().expect("ranges").iter().map(|range| cut(PARTS, range));
            let ends: Vec<String> = lines
                .map(|text| {
                    format!("{}…{}", text.lines().next().unwrap_or_default(), text.len() - text.trim_end().len())
                })
                .collect();
            assert_eq!(ends, going);
        };
        check("arm", " \"grip\"", &["machine arm ($a in Arm) \"grip\"…2"]);
        check("grip", "", &["…1"]);
    }
}
