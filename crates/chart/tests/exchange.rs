//! SCXML round trip: our export reads back as the same machine; a change made in another tool is kept.

#![allow(clippy::disallowed_methods, reason = "a test reads the repository's own charts")]

use std::collections::BTreeSet;
use std::path::Path;

use chart::import::scxml;
use chart::{Chart, dump, read, scxml_of};
use syntax::{FileId, Severity, parse_chart};

fn chart(text: &str) -> Chart {
    let (chart, faults) = read(FileId(0), &parse_chart(FileId(0), text));
    let errors: Vec<_> = faults.iter().filter(|fault| fault.severity == Severity::Error).collect();
    assert!(errors.is_empty(), "{errors:#?}\n{text}");
    chart
}

/// The shapes and transitions of a chart's machine, independent of the order of shapes.
fn lines(chart: &Chart, machine: &str) -> BTreeSet<String> {
    let mut alone = chart.clone();
    alone.imports.clear();
    alone.charts.clear();
    alone.machines.retain(|known| known.name == machine);
    alone.patterns = chart.machines.iter().filter(|known| known.name != machine).cloned().collect();
    dump(&alone).lines().skip(1).map(str::to_string).collect()
}

fn there_and_back(text: &str) {
    let before = chart(text);
    for machine in &before.machines {
        let document = scxml_of(&before, machine);
        let back = scxml(FileId(0), &document, "Back");
        assert_eq!(back.diagnostics, [], "{document}");
        // The chart's other patterns are exported to files of their own; here they are put back beside the machine.
        let mut whole: String = back
            .text
            .expect("no errors")
            .lines()
            .filter(|line| !line.starts_with("import"))
            .collect::<Vec<_>>()
            .join("\n");
        let mut others = before.clone();
        others.machines.retain(|other| other.name != machine.name);
        others.imports.clear();
        whole += &chart::write(&others).split_once('\n').map(|(_, rest)| rest.to_string()).unwrap_or_default();
        let after = chart(&whole);
        assert_eq!(lines(&after, &machine.name), lines(&before, &machine.name), "{document}");
        let sequences = |chart: &Chart| chart.machine(&machine.name).map(|machine| machine.sequences.len());
        assert_eq!(sequences(&after), sequences(&before));
    }
}

#[test]
fn the_repository_s_charts() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("../..");
    for file in [
        "library/patterns/DataProducer.chart",
        "library/patterns/PatternMachines.chart",
        "examples/visual_servoing/VisualServoingComponent.chart",
    ] {
        there_and_back(&std::fs::read_to_string(root.join(file)).expect("the chart is there"));
    }
}

#[test]
fn the_awkward_parts() {
    there_and_back(
        "chart Awkward
machine m($c in Crane, $d in Prod(Crane, Crane)) \"Two\\nlines & <more> \\\"quotes\\\"\" {r_m}
	control {at($c, $d)}
	initial state a \"A\\nB\" {FIRST}
	state b
	guard g \"x < 3 & y\" {x($c) < 3 and y}
	guard h to refine by later
	action one {r_one[$c]}
	action two to refine
	instance p of fetch($c) \"Fetch\"
	instance q of blink($c)
	instance beside of blink($c) \"Beside\" {r_beside}
	sequence one, two
	a -> g yes -> one -> two -> b
	g no -> h no -> a
	h yes -> q -> p -> b
	b -> a
	b -> p
endmachine
pattern fetch($c in Crane)
	control arm
	state s
	enter -> s -> exit
endpattern
pattern blink($c in Crane)
	action light
	enter -> light -> exit
endpattern
",
    );
}

#[test]
fn a_machine_with_composite_states() {
    let before = chart(
        "chart C
machine m
	control c
	initial state off
	composite state on
		history
		exit lampOff
		initial state slow
		state fast
	endstate
	guard up
	guard stop
	action note to refine by later
	action halt
	sequence note, halt
	off -> up yes -> on
	slow -> fast
	on -> stop yes -> note -> halt -> off
endmachine
",
    );
    let document = scxml_of(&before, &before.machines[0]);
    let back = scxml(FileId(0), &document, "Back");
    assert_eq!(back.diagnostics, []);
    let text = back.text.expect("no errors");
    let after = chart(&text);
    // One of each for each state that is left; what they do is written once, and refined once.
    for part in [
        "guard stop2 \"Stop\" {stop}",
        "action note \"Note\" to refine by later",
        "action note2 \"Note\" {r_note[]}\n",
        "action halt2 \"Halt\" {r_halt[]}",
        "sequence note, note2, halt, halt2",
    ] {
        assert!(text.contains(part), "{part} is missing in\n{text}");
    }
    assert_eq!(
        chart::transitions(&after, &after.machines[0]).len(),
        chart::transitions(&before, &before.machines[0]).len()
    );
}

#[test]
fn a_change_in_another_tool_is_kept() {
    let text = "chart C machine m control x initial state a state b guard g {ready} action f {r_f[]} a -> g yes -> f -> b endmachine";
    let before = chart(text);
    let document = scxml_of(&before, &before.machines[0]);
    let back = |from: &str, to: &str| {
        assert!(document.contains(from), "{document}");
        let back = scxml(FileId(0), &document.replace(from, to), "C");
        assert_eq!(back.diagnostics, []);
        dump(&chart(&back.text.expect("no errors")))
    };
    assert!(
        back("cond=\"ready\"", "cond=\"steady\"").contains("a --[steady]/f"),
        "{}",
        back("cond=\"ready\"", "cond=\"steady\"")
    );
    assert!(back("target=\"b\"", "target=\"a\"").contains("a --[g]/f--> a"));
    assert!(back("<script>r_f[]</script>", "<script>r_h[]</script>").contains("{r_h[]}"));
}

/// Numbers that look random and are the same in every run.
struct Dice(u64);

impl Dice {
    fn throw(&mut self, sides: usize) -> usize {
        self.0 = self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (self.0 >> 33) as usize % sides.max(1)
    }
}

#[test]
fn damaged_documents() {
    let whole = include_str!("../../../shells/cli/tests/cmd/chart.in/Player.scxml");
    let pieces: Vec<&str> = whole.split_inclusive(['<', '>', '"', ' ']).collect();
    let mut dice = Dice(7);
    let mut read_back = 0;
    for _ in 0..400 {
        let mut damaged = pieces.clone();
        for _ in 0..=dice.throw(2) {
            let (at, other) = (dice.throw(damaged.len()), dice.throw(damaged.len()));
            match dice.throw(3) {
                0 => _ = damaged.remove(at),
                1 => damaged.insert(at, pieces[dice.throw(pieces.len())]),
                _ => damaged.swap(at, other),
            }
        }
        let imported = scxml(FileId(0), &damaged.concat(), "Damaged");
        let errors = imported.diagnostics.iter().any(|fault| fault.severity == Severity::Error);
        assert_eq!(imported.text.is_none(), errors);
        if let Some(text) = imported.text {
            chart(&text);
            read_back += 1;
        }
    }
    assert!(read_back > 20, "only {read_back}");
}

#[test]
fn an_element_crowded_with_attributes_is_refused() {
    let attributes: String = (0..100_000).map(|number| format!(" a{number}='='")).collect();
    let document =
        format!("<scxml xmlns=\"http://www.w3.org/2005/07/scxml\">\n<!-- it's --><state{attributes}/></scxml>");
    let imported = scxml(FileId(0), &document, "C");
    assert_eq!(imported.text, None);
    let [fault] = &imported.diagnostics[..] else { panic!("{:?}", imported.diagnostics) };
    assert_eq!(fault.id, "foreign-notation");
    assert_eq!(document[..fault.primary.span.start as usize].lines().count(), 2);
    let quoted = format!(
        "<scxml><state id=\"s\"><!--{0}--><onentry><script><![CDATA[{0}]]></script></onentry></state></scxml>",
        "a='b' ".repeat(2000)
    );
    assert!(scxml(FileId(0), &quoted, "C").text.is_some());
}

#[test]
fn a_state_that_begins_in_itself_is_refused() {
    let refused = |inner: &str| {
        let document = format!("<scxml><state id='outer' initial='{inner}'><state id='inner'/></state></scxml>");
        let imported = scxml(FileId(0), &document, "C");
        imported.diagnostics.iter().any(|fault| fault.severity == Severity::Error)
    };
    assert!(!refused("inner"));
    assert!(refused("outer"));
    let twice = "<scxml><state id='s' initial='s'><state id='s'><state id='t'/></state></state></scxml>";
    assert_eq!(scxml(FileId(0), twice, "C").text, None);
}
