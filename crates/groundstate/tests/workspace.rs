//! For edited texts a workspace reports the same as a fresh check of the same texts.

#![allow(clippy::disallowed_methods, reason = "a test reads the repository's own models")]

use std::collections::BTreeMap;
use std::path::Path;

use groundstate::Workspace;
use groundstate::workspace::{Absent, Files, Findings, NotLoaded, Outdated, tidy};
use simulate::SplitMix;
use syntax::SourceFile;

/// Texts in memory.
#[derive(Debug, Clone, Default)]
struct Memory(BTreeMap<String, String>);

impl Files for Memory {
    fn read(&mut self, path: &str) -> Result<SourceFile, Absent> {
        self.0.get(path).map(|text| SourceFile::new(path, text.as_str())).ok_or(Absent::Missing)
    }
}

impl Memory {
    fn of(files: &[(&str, &str)]) -> Memory {
        Memory(files.iter().map(|(path, text)| ((*path).to_string(), (*text).to_string())).collect())
    }

    fn folder(folder: &str) -> Memory {
        let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("../..").join(folder);
        let mut files = BTreeMap::new();
        for entry in std::fs::read_dir(root).expect("the folder") {
            let path = entry.expect("an entry").path();
            if let (Ok(text), Some(name)) = (std::fs::read_to_string(&path), path.file_name()) {
                files.insert(name.to_string_lossy().into_owned(), text);
            }
        }
        Memory(files)
    }
}

/// Each fault in a line.
fn lines(findings: &Findings) -> Vec<String> {
    let mut lines: Vec<String> = findings.open.iter().cloned().collect();
    for (sources, faults) in &findings.faults {
        lines.extend(faults.iter().map(|fault| {
            let places = fault.secondary.iter().map(|label| sources.position(label.span));
            let places: Vec<String> = places.collect();
            format!("{} {} {} {places:?}", sources.position(fault.primary.span), fault.id, fault.message)
        }));
    }
    lines
}

const LAMP: &str = "asm Lamp\nimport Parts\nsignature:\n\tcontrolled on: Boolean\ndefinitions:\n\
                    \tmain rule r_Main = r_flip[]\ndefault init s0:\n\tfunction on = false\n";
const PARTS: &str = "module Parts\nimport StandardLibrary\nexport *\nsignature:\ndefinitions:\n\trule r_flip = skip\n";

#[test]
fn an_edit_is_seen_in_the_file_and_in_those_that_import_it() {
    let mut workspace = Workspace::new(Memory::of(&[("Lamp.asm", LAMP), ("Parts.asm", PARTS)]));
    let check = |workspace: &mut Workspace<Memory>, path| lines(&workspace.check(path).expect("it is there"));
    assert_eq!(check(&mut workspace, "Lamp.asm"), [""; 0]);
    workspace.set_text("./Parts.asm", 1, PARTS.replace("r_flip", "r_flop")).expect("the first");
    let faults = check(&mut workspace, "Lamp.asm");
    assert!(faults.len() == 1 && faults[0].starts_with("Lamp.asm:6:21 "), "{faults:?}");
    // An older version does not replace a newer one.
    assert_eq!(workspace.set_text("Parts.asm", 0, PARTS), Err(Outdated { present: 1 }));
    assert_eq!(check(&mut workspace, "Lamp.asm"), faults);
    assert!(matches!(workspace.load("Lamp.asm"), Err(NotLoaded::Faulty(_))));
    workspace.close("Parts.asm");
    assert_eq!(check(&mut workspace, "Lamp.asm"), [""; 0]);
    assert!(workspace.load("Lamp.asm").is_ok());
}

#[test]
fn scenarios_charts_and_what_is_not_known_are_looked_at() {
    let mut workspace = Workspace::new(Memory::of(&[("Lamp.asm", LAMP), ("Parts.asm", PARTS)]));
    assert!(matches!(workspace.check("Lamp.avalla"), Err(Absent::Missing)));
    workspace.set_text("Lamp.avalla", 1, "scenario lamp\nload Lamp.asm\ncheck of;\n").expect("the first");
    let faults = lines(&workspace.check("Lamp.avalla").expect("it is open"));
    assert!(faults.iter().any(|fault| fault.starts_with("Lamp.avalla:3:7 ")), "{faults:?}");
    workspace.set_text("Empty.chart", 1, "chart Empty\n").expect("the first");
    assert!(!lines(&workspace.check("Empty.chart").expect("it is open")).is_empty());
    workspace.set_text("notes.txt", 1, "anything").expect("the first");
    assert!(!workspace.check("notes.txt").expect("it is open").is_clean(), "nothing was looked at");
}

/// The faults of a file with this name and text beside the lamp.
fn beside_the_lamp(name: &str, text: &str) -> Vec<String> {
    let mut workspace = Workspace::new(Memory::of(&[("Lamp.asm", LAMP), ("Parts.asm", PARTS)]));
    workspace.set_text(name, 1, text).expect("the first");
    lines(&workspace.check(name).expect("it is open"))
}

#[test]
fn what_a_report_shows_is_looked_at() {
    let check = |text, expected: &[&str]| assert_eq!(beside_the_lamp("Lamp.report.yaml", text), expected, "{text}");
    check("series: { Light: { value: if on then 1 else 0 endif } }\n", &[]);
    check(
        "series:\n  Light: { value: of }\n",
        &["Lamp.report.yaml:2:19 unknown-function there is no function `of` []"],
    );
    check("serie: {}\n", &["Lamp.report.yaml:1:1 bad-report-specification nothing here is called `serie` []"]);
    check(
        "charts: { Lamp.chart: {} }\n",
        &["Lamp.report.yaml:1:11 bad-report-specification there is no file Lamp.chart []"],
    );
    assert_eq!(beside_the_lamp("Lump.report.yaml", "serie: {}\n"), ["not checked: there is no model Lump.asm"]);
}

#[test]
fn what_is_to_be_verified_is_looked_at() {
    let check = |text, expected: &[&str]| assert_eq!(beside_the_lamp("Lamp.verify.yaml", text), expected, "{text}");
    check("invariants: [on or not on]\nfair: weak\n", &[]);
    for (text, place) in [
        ("ctl: [on]\ninvariants: [on or of]\n", "2:20"),
        ("invariants:\n  - on\n    or of\n", "3:8"),
        ("terminal: 'on or of'\n", "1:18"),
        ("ltl: \"on or\\x20of\"\n", "1:16"),
        ("assume:\n- >-\n  on\n  or of\n", "4:6"),
        ("invariants:\n- |\n  on\n    or\n  of\n", "5:3"),
    ] {
        check(text, &[&format!("Lamp.verify.yaml:{place} unknown-function there is no function `of` []")]);
    }
    let bad = |place: &str, message: &str| format!("Lamp.verify.yaml:{place} bad-verification-file {message} []");
    check("fair: weakly\n", &[&bad("1:7", "`fair` is neither weak nor strong")]);
    let unknown = "bound off=true: `off` is no monitored or shared function";
    check("bounds:\n  off: 'true'\n", &[&bad("2:3", unknown)]);
    check("limit: 10\n", &["Lamp.verify.yaml:1:1 bad-verification-file `limit` says nothing here []"]);
    assert_eq!(beside_the_lamp("a/Lump.verify.yaml", "limit: 10\n"), ["not checked: there is no model a/Lump.asm"]);
}

#[test]
fn a_chart_that_is_being_edited_counts_for_the_report_that_shows_it() {
    let mut workspace = Workspace::new(Memory::of(&[("Lamp.asm", LAMP), ("Parts.asm", PARTS)]));
    workspace.set_text("a/Lamp.report.yaml", 1, "charts: { ../Lamp.chart: {} }\n").expect("the first");
    workspace.set_text("a/Lamp.asm", 1, LAMP.replace("Parts", "../Parts")).expect("the first");
    let check = |workspace: &mut Workspace<Memory>| lines(&workspace.check("a/Lamp.report.yaml").expect("it is open"));
    assert!(check(&mut workspace)[0].contains("there is no file a/../Lamp.chart"));
    workspace.set_text("Lamp.chart", 1, "chart Lamp\n").expect("the first");
    assert!(check(&mut workspace).iter().all(|fault| fault.starts_with("Lamp.chart:")));
}

#[test]
fn after_any_edits_it_says_what_a_fresh_one_says() {
    let mut files = Memory::folder("library/patterns");
    let mut edited = Workspace::new(files.clone());
    let mut random = SplitMix::new(7);
    let names: Vec<String> = files.0.keys().filter(|name| !name.ends_with(".md")).cloned().collect();
    let rounds = if testkit::sample::is_full() { 2_000 } else { 40 };
    for version in 0..rounds {
        let name = &names[random.below(names.len() as u64) as usize];
        let text = files.0.get_mut(name).expect("it is there");
        let chars: Vec<char> = text.chars().collect();
        let at = random.below(chars.len() as u64) as usize;
        let length = random.below(30.min(chars.len() as u64 - at as u64)) as usize;
        // A piece is removed, moved elsewhere, or doubled.
        let (before, piece, after) = (&chars[..at], &chars[at..at + length], &chars[at + length..]);
        *text = match random.below(3) {
            0 => [before, after].concat().into_iter().collect(),
            1 => [before, piece, piece, after].concat().into_iter().collect(),
            _ => [piece, before, after].concat().into_iter().collect(),
        };
        edited.set_text(name, version, text.as_str()).expect("the next version");
        let checked = if random.below(2) == 0 { "ControlTask.asm" } else { name };
        let mut fresh = Workspace::new(files.clone());
        let expected = lines(&fresh.check(checked).expect("it is there"));
        assert_eq!(lines(&edited.check(checked).expect("it is there")), expected, "round {version}, {checked}");
    }
}

#[test]
fn an_import_leads_to_a_file_whether_it_is_being_edited_or_not() {
    // Beside the model there is no such file; from the working folder it is named by way of a folder that is not there.
    let lamp = LAMP.replace("import Parts", "import none../../parts/Parts");
    let files = Memory::of(&[("lamps/Lamp.asm", &lamp), ("parts/Parts.asm", PARTS)]);
    let mut workspace = Workspace::new(files);
    let closed = lines(&workspace.check("lamps/Lamp.asm").expect("it is there"));
    workspace.set_text("parts/Parts.asm", 1, PARTS).expect("the first");
    let open = lines(&workspace.check("lamps/Lamp.asm").expect("it is there"));
    assert_eq!(closed, open);
}

#[test]
fn one_file_has_one_name() {
    for (path, expect) in [("a/b/../c.asm", "a/c.asm"), ("./c.asm", "c.asm"), ("../c.asm", "../c.asm")] {
        assert_eq!(tidy(path), expect);
    }
}

#[test]
fn a_chart_whose_model_cannot_be_read_is_not_called_clean() {
    struct Locked(Memory);
    impl Files for Locked {
        fn read(&mut self, path: &str) -> Result<SourceFile, Absent> {
            if path.ends_with(".asm") {
                Err(Absent::Unreadable(format!("{path} is locked")))
            } else {
                self.0.read(path)
            }
        }
    }
    let mut workspace = Workspace::new(Locked(Memory::folder("library/patterns")));
    let findings = workspace.check("DataProducer.chart").expect("it is there");
    assert!(!findings.is_clean() && findings.open.is_some_and(|open| open.contains("DataProducer.asm is locked")));
}

const TICKER: &str = "chart Ticker
system ticker
	tick 1 ms
	component counter synchronous period 5 ms
		elaborate count 1 ms by Clock
		write ticks 1 ms
	endcomponent
	component watcher synchronous period 10 ms
		read ticks 1 ms
		elaborate look 1 ms
	endcomponent
	channel ticks : Boolean from counter to watcher swinging buffer 2
endsystem
";
const CLOCK: &str = "asm Clock
import StandardLibrary
signature:
	out ticks: Boolean
definitions:
	main rule r_Main = ticks := not ticks
default init s0: function ticks = false
";

#[test]
fn what_is_to_be_verified_of_a_system_is_looked_at_in_its_chart() {
    let files = [("Ticker.chart", TICKER), ("Clock.asm", CLOCK)];
    let check = |text: &str, expected: &[&str]| {
        let mut workspace = Workspace::new(Memory::of(&files));
        workspace.set_text("Ticker.verify.yaml", 1, text).expect("the first");
        let found = lines(&workspace.check("Ticker.verify.yaml").expect("it is open"));
        assert_eq!(found, expected, "{text}");
    };
    check("invariants: [counter_ticks or not counter_ticks]\nltl: g(isDef(counter_ticks))\n", &[]);
    let at = |place: &str, what: &str| format!("Ticker.verify.yaml:{place} {what} []");
    check("invariants: [counter_tocks]\n", &[&at("1:14", "unknown-function there is no function `counter_tocks`")]);
    let unkept = "bad-verification-file this reads clock, which is not kept from tick to tick";
    check("ctl: [isDef(clock)]\n", &[&at("1:7", unkept)]);
    check("terminal: clock = 0\n", &[&at("1:11", unkept)]);
    check("assume: clock >= 0\n", &[&at("1:9", unkept)]);
    check("limits: 1\n", &[&at("1:1", "bad-verification-file `limits` says nothing here")]);
    // Without the chart's system there is nothing that the file could be about, whatever else is there.
    let mut workspace = Workspace::new(Memory::of(&files));
    workspace.set_text("Ticker.verify.yaml", 1, "invariants: ['true']\n").expect("the first");
    workspace.set_text("Ticker.chart", 1, TICKER.replace("by Clock", "by Clack")).expect("the first");
    let found = lines(&workspace.check("Ticker.verify.yaml").expect("it is open"));
    assert!(found[0].starts_with("Ticker.chart:5:"), "{found:?}");
    workspace.set_text("Ticker.chart", 2, "chart Ticker\n").expect("the second");
    let found = lines(&workspace.check("Ticker.verify.yaml").expect("it is open"));
    assert_eq!(found, ["not checked: there is no model Ticker.asm"]);
}
