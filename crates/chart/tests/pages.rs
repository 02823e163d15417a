//! The pages in spec/ say the truth: the charts of `charts.md` have no faults, what they are built to is what the page
//! shows, passes `check`, and each fault has a page whose example shows it.

#![allow(clippy::disallowed_methods, reason = "a test reads the pages it is about")]

use std::path::PathBuf;

use chart::{Chart, Known, build, probed, read};
use model::{Loader, check};
use syntax::{Diagnostic, FileId, SourceFile, parse_chart};

fn page(name: &str) -> String {
    let path = PathBuf::from(env!("CARGO_MANIFEST_DIR")).join(format!("../../spec/{name}.md"));
    std::fs::read_to_string(&path).unwrap_or_else(|error| panic!("{}: {error}", path.display()))
}

/// The blocks of a page: what they are, and their code.
fn blocks(page: &str) -> Vec<(String, String)> {
    let mut blocks = Vec::new();
    let mut open: Option<(String, String)> = None;
    for line in page.lines() {
        match (line.strip_prefix("```"), &mut open) {
            (Some(info), None) => open = Some((info.to_string(), String::new())),
            (Some(_), Some(_)) => blocks.extend(open.take()),
            (None, Some((_, code))) => *code += &format!("{line}\n"),
            (None, None) => {}
        }
    }
    blocks
}

fn chart(text: &str) -> (Chart, Vec<Diagnostic>) {
    read(FileId(0), &parse_chart(FileId(0), text))
}

/// There is nothing but the built-in libraries.
struct Nothing;

impl smt::Solver for Nothing {
    fn solve(&mut self, _: &str) -> Result<String, String> {
        Err("no solver is there".to_string())
    }
}

impl Loader for Nothing {
    fn load(&mut self, _: &SourceFile, path: &str) -> Result<SourceFile, String> {
        Err(format!("there is no file {path}"))
    }
}

/// The library of patterns, as `patterns/NAME`.
struct Library;

impl Loader for Library {
    fn load(&mut self, _: &SourceFile, path: &str) -> Result<SourceFile, String> {
        let name = path.rsplit('/').next().unwrap_or(path);
        let file = PathBuf::from(env!("CARGO_MANIFEST_DIR")).join(format!("../../library/patterns/{name}.asm"));
        let text = std::fs::read_to_string(&file).map_err(|error| error.to_string())?;
        Ok(SourceFile::new(format!("patterns/{name}.asm"), text))
    }
}

/// What the library of patterns declares.
fn patterns() -> Known {
    let (importing, _) = chart("chart C import patterns/ControlTask");
    Known::imported(&importing, "Imports.asm", &mut Library).expect("the library has no faults")
}

fn built(text: &str) -> String {
    let (chart, faults) = chart(text);
    assert_eq!(faults, [], "{text}");
    build(&chart, &Known::default(), None).expect("there was no file").text
}

#[test]
fn the_charts_of_the_page() {
    let blocks = blocks(&page("charts"));
    for (index, (info, code)) in blocks.iter().enumerate().filter(|(_, (info, _))| info == "chart") {
        if chart(code).0.system.is_some() {
            continue; // it is built over the library, as the examples are
        }
        let text = built(code);
        if let Some((_, shown)) = blocks.get(index + 1).filter(|(info, _)| info == "asmetal built") {
            assert_eq!(&text, shown, "{info}");
        }
        let checked = check(SourceFile::new(format!("{}.asm", chart(code).0.name), text.as_str()), &mut Nothing);
        assert_eq!(checked.diagnostics, [], "{text}");
    }
}

#[test]
fn each_fault_has_a_page_whose_example_shows_it() {
    assert!(chart::FAULT_IDS.is_sorted());
    for id in chart::FAULT_IDS {
        let page = page(&format!("faults/{id}"));
        assert!(page.starts_with(&format!("# {id}\n")), "the page of {id} has another title");
        let blocks = blocks(&page);
        let block = |wanted: &str| blocks.iter().find(|(info, _)| info == wanted).map(|(_, code)| code.as_str());
        if let Some(document) = block("xml fault") {
            let faults = chart::import::scxml(FileId(0), document, "Example").diagnostics;
            assert_eq!(faults.iter().map(|fault| fault.id).collect::<Vec<_>>(), [*id]);
            continue;
        }
        let (drawn, mut faults) = chart(block("chart fault").expect("an example"));
        match (&drawn.system, *id) {
            (Some(system), "not-generated") => faults.extend(chart::generate::ungenerated(system)),
            _ if !faults.is_empty() => {}
            _ => faults.extend(chart::unbuilt(&drawn, &patterns())),
        }
        let before = block("chart before").map(|text| {
            let (before, faults) = chart(text);
            assert_eq!(faults, []);
            build(&before, &patterns(), None).expect("there was no file").text
        });
        if let Some(specification) = block("asmetal").or(before.as_deref()) {
            let probed = probed(&drawn, specification).expect("the specification parses");
            let checked = check(SourceFile::new(format!("{}.asm", drawn.name), probed.text.as_str()), &mut Library);
            faults.extend(chart::check(&drawn, &probed, &checked, &mut Nothing));
        }
        let ids: Vec<_> = faults.iter().map(|fault| fault.id).collect();
        assert_eq!(ids, [*id], "{faults:#?}");
    }
}

#[test]
fn what_is_written_by_hand_stays() {
    let before = page("charts");
    let (_, code) = blocks(&before).into_iter().find(|(_, code)| code.contains("chart Fetch")).expect("the chart");
    let text = built(&code);
    let by_hand = text
        .replace("rule r_reach($c in Crane) = skip", "rule r_reach($c in Crane) =\n\t\tspeed($c) := 3 // slowly")
        .replace("monitored isThere", "controlled speed: Crane -> Integer\n\tmonitored isThere");
    let (mut changed, _) = chart(
        &code
            .replace("\"Reaching\"", "\"Reaching out\"")
            .replace("enter -> reach -> reaching", "state waiting {WAITING}\n\tenter -> reach -> waiting -> reaching"),
    );
    let rebuilt = build(&changed, &Known::default(), Some(&by_hand)).expect("the file has no faults").text;
    assert!(rebuilt.contains("speed($c) := 3 // slowly"), "{rebuilt}");
    assert!(rebuilt.contains("enum domain ArmState = {REACHING | WAITING}"), "{rebuilt}");
    assert!(rebuilt.contains("arm($c) := WAITING"), "{rebuilt}");
    assert_eq!(build(&changed, &Known::default(), Some(&rebuilt)).expect("no faults").text, rebuilt);
    // An unchanged chart changes nothing.
    changed = chart(&code).0;
    assert_eq!(build(&changed, &Known::default(), Some(&text)).expect("no faults").text, text);
}
