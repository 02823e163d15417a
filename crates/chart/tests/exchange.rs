//! SCXML round trip: our export reads back as the same machine; a change made in another tool is kept.

#![allow(clippy::disallowed_methods, reason = "a test reads the repository's own charts")]

use std::collections::BTreeSet;
use std::path::Path;

use chart::import::scxml;
use chart::{Chart, End, History, ShapeId, dump, read, scxml_of};
use syntax::{FileId, Severity, parse_chart};

fn chart(text: &str) -> Chart {
    let (chart, faults) = read(FileId(0), &parse_chart(FileId(0), text));
    let errors: Vec<_> = faults.iter().filter(|fault| fault.severity == Severity::Error).collect();
    assert!(errors.is_empty(), "{errors:#?}\n{text}");
    chart
}

/// The shapes and arrows of a chart's machine, independent of their order.
fn lines(chart: &Chart, machine: &str) -> BTreeSet<String> {
    let mut alone = chart.clone();
    alone.imports.clear();
    alone.charts.clear();
    alone.machines.retain(|known| known.name == machine);
    alone.patterns = chart.machines.iter().filter(|known| known.name != machine).cloned().collect();
    let mut lines: BTreeSet<String> = dump(&alone).lines().skip(1).map(str::to_string).collect();
    // Names of what composite states are built to depend on the order of shapes.
    if let Some(machine) =
        alone.machines.iter().find(|machine| machine.shapes.iter().any(|one| one.composite().is_some()))
    {
        lines.retain(|line| !line.contains("--["));
        let name = |id: ShapeId| machine.shape(id).name.as_str();
        let end = |end| match end {
            End::Enter => "enter".to_string(),
            End::Exit => "exit".to_string(),
            End::Shape(id) => name(id).to_string(),
        };
        let arrows = machine.arrows.iter();
        lines.extend(arrows.map(|one| format!("{} {:?} -> {}", end(one.from), one.branch, end(one.to))));
        for (id, shape) in machine.numbered() {
            lines.extend(shape.inside.map(|around| format!("{} in {}", shape.name, name(around))));
            let Some(composite) = shape.composite() else { continue };
            let names = |all: &[ShapeId]| all.iter().map(|id| name(*id).to_string()).collect::<Vec<_>>();
            let history = composite.history.as_ref().map(|history| match history {
                History::Linked(link) => link.text.clone(),
                History::Made => String::new(),
            });
            lines.insert(format!(
                "{} {:?} {:?} {history:?}",
                name(id),
                names(&composite.entry),
                names(&composite.exit)
            ));
        }
        lines.extend(machine.aborts.iter().map(|id| format!("abort {}", name(*id))));
    }
    lines
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
        "examples/press_cell/Press.chart",
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

/// A lamp and a motor, with composite states in every form.
const NESTED: &str = "chart C
machine m
	control c
	initial composite state on \"Is on\"
		history {wasOn}
		entry lampOn
		exit lampOff \"LAMP OFF\" {r_lamp[false]}
		exit note to refine by later
		initial composite state turning
			history
			initial state slow
			state fast
			instance work of task
			guard up
			action turn
		endstate
		state waiting
		guard idle
	endstate
	state off
	guard go
	guard stop \"Stop & leave\" {stop and not held}
	guard late
	action halt
	action brake
	sequence halt, brake
	off -> go yes -> on
	slow -> up yes -> turn -> fast
	fast -> work -> slow
	turning -> idle yes -> waiting
	waiting -> on
	on -> stop yes -> halt -> brake -> off
	stop no -> late yes -> slow
endmachine
pattern task
	control t
	state busy
	abort giveBack
	enter -> busy -> exit
endpattern
";

#[test]
fn a_machine_with_composite_states() {
    there_and_back(NESTED);
    let before = chart(NESTED);
    let document = scxml_of(&before, &before.machines[0]);
    for part in [
        // What leads out of the states around comes first.
        "<transition cond=\"not (((stop and not held)) or (not (stop and not held) and late)) and not (idle) and up\" target=\"fast\"",
        "<onexit><script>par r_lamp[false] r_note[] endpar</script></onexit>",
        "<history id=\"on.history\" type=\"deep\"><transition target=\"turning.history\"/></history>",
        "<transition cond=\"go\" target=\"on.history\"",
    ] {
        assert!(document.contains(part), "{part} is missing in\n{document}");
    }
}

/// What the document of a nested machine is read as when another tool has changed it, and what is told.
fn changed(changes: &[(&str, &str)]) -> (String, Vec<String>) {
    let before = chart(NESTED);
    let mut document = scxml_of(&before, &before.machines[0]);
    for (from, to) in changes {
        assert!(document.contains(from), "{from}\n{document}");
        document = document.replacen(from, to, 1);
    }
    let back = scxml(FileId(0), &document, "C");
    let told = back.diagnostics.iter().map(|fault| fault.message.clone()).collect();
    let text = back.text.unwrap_or_default();
    if !text.is_empty() {
        let patterns = &NESTED[NESTED.find("pattern").expect("a pattern")..];
        chart(&(text.replace("import \"task.chart\"\n", "") + patterns));
    }
    (text, told)
}

#[test]
fn composite_states_that_another_tool_has_changed() {
    let kept = |changes: &[(&str, &str)], expected: &str| {
        let (text, told) = changed(changes);
        assert_eq!(told, [""; 0]);
        assert!(text.contains(expected), "{expected} is missing in\n{text}");
    };
    kept(&[("target=\"waiting\"", "target=\"off\"")], "idle yes -> off");
    // Not to where it was left, but to where it begins.
    kept(&[("cond=\"go\" target=\"on.history\"", "cond=\"go\" target=\"on\"")], "go yes -> slow");
    kept(&[("<onentry><script>r_lampOn[]", "<onentry><script>r_red[]")], "entry red \"r_red[]\" {r_red[]}");
    kept(&[("and up\"", "and faster\"")], "guard faster \"faster\" {faster}");
    kept(
        &[("<script>par r_halt[] r_brake[] endpar</script>", "<script>r_halt[]</script>")],
        "action halt2 \"r_halt[]\" {r_halt[]}",
    );
    kept(&[("gs:text=\"Is on\"", "gs:text=\"Runs\"")], "initial composite state on \"Runs\"");
    // Without what comes first: what is inside would be taken first now. A path of this machine leads from within to a history, so nothing can be read then.
    let flat = "the composite states are read without their frames: each state gets the paths around it";
    let history = "charts cannot express a transition to the `history` of a state around it";
    let bar = "not (((stop and not held)) or (not (stop and not held) and late)) and not (idle) and up";
    for (from, to) in [
        (bar, "up"),
        ("<onexit>", "<transition event=\"emergency\" target=\"off\"/><onexit>"),
        ("<state id=\"off\" gs:text=\"Off\">", "<state id=\"off\"><onentry><script>r_beep[]</script></onentry>"),
        ("and up\"", "and up or down\""),
        ("target=\"turning.history\"/></history>", "target=\"waiting\"/></history>"),
        ("initial=\"on.history\"", "initial=\"slow\""),
    ] {
        let (text, told) = changed(&[(from, to)]);
        let told: BTreeSet<&str> =
            told.iter().map(String::as_str).filter(|told| !told.contains("at the start")).collect();
        assert!(text.is_empty() && told.contains(flat) && told.contains(history), "{from}: {told:?}");
    }
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

#[test]
fn a_linked_history_keeps_its_link_without_frames() {
    let before = chart(
        "chart C machine m control c initial state off composite state on history {wasOn} initial state slow state fast endstate
         guard go guard up guard stop off -> go yes -> on slow -> up yes -> fast on -> stop yes -> off endmachine",
    );
    let document = scxml_of(&before, &before.machines[0]);
    let own = "cond=\"not (stop) and up\"";
    assert!(document.contains(own), "{document}");
    let back = scxml(FileId(0), &document.replace(own, "cond=\"up\""), "C");
    assert!(back.diagnostics[0].message.contains("without their frames"), "{:?}", back.diagnostics);
    let text = back.text.expect("no errors");
    assert!(text.contains("history {wasOn}"), "{text}");
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

#[test]
fn a_transition_to_a_state_around_it_leaves_and_enters_that() {
    let document = "<scxml datamodel='asmetal'><state id='outer'>
        <onexit><script>r_left[]</script></onexit><onentry><script>r_entered[]</script></onentry>
        <state id='inner'><state id='one'><transition cond='up' target='outer'/><transition cond='down' target='inner'/></state></state>
        </state></scxml>";
    let text = scxml(FileId(0), document, "C").text.expect("no errors");
    assert!(text.contains("one -> up yes -> left -> entered -> one"), "{text}");
    assert!(text.contains("up no -> down yes -> one"), "{text}");
}

#[test]
fn a_foreign_history() {
    let document = |history: &str, inside: &str| {
        format!(
            "<scxml datamodel='asmetal'><state id='off'><transition cond='go' target='back'/></state>
            <state id='on' initial='slow'><onentry><script>r_lamp[]</script></onentry>{history}
            <state id='slow'><transition cond='up' target='fast'/></state>
            <state id='fast' initial='gear'><onexit><script>r_down[]</script></onexit><state id='gear'>{inside}</state><state id='top'/></state>
            <transition cond='stop' target='off'/></state></scxml>"
        )
    };
    let read_back = |history: &str, inside: &str| scxml(FileId(0), &document(history, inside), "C");
    let text = read_back("<history id='back'><transition target='slow'/></history>", "").text.expect("no errors");
    chart(&text);
    for part in [
        "composite state on \"On\"\n\t\thistory\n\t\tinitial state slow",
        "composite state fast \"Fast\"\n\t\t\tinitial state gear",
        "off -> go yes -> lamp -> on",
        "gear -> stop2 yes -> down -> off",
    ] {
        assert!(text.contains(part), "{part} is missing in\n{text}");
    }
    // Deep: each state within is entered where it was left.
    let text = read_back("<history id='back' type='deep'/>", "").text.expect("no errors");
    assert!(text.contains("composite state on \"On\"\n\t\thistory\n"), "{text}");
    assert!(text.contains("composite state fast \"Fast\"\n\t\t\thistory"), "{text}");
    for (history, inside, told) in [
        ("<history id='back'/><history id='other'/>", "", "a second `history` of one state"),
        (
            "<history id='back'><transition target='top'/></history>",
            "",
            "a `history` that begins where none of its states does",
        ),
        (
            "<history id='back'><transition target='fast'/></history>",
            "",
            "a machine that does not begin where a `history` does",
        ),
        (
            "<history id='back'/><state id='n' initial='back'><state id='o'/></state>",
            "",
            "a state that begins in a `history`",
        ),
        (
            "<state id='n' initial='m'><history id='m'/><state id='o'/></state>",
            "",
            "a state that begins in a `history`",
        ),
        ("<history id='back'><transition target='off'/></history>", "", "a `history` that begins outside of its state"),
        (
            "<history id='back'/>",
            "<onentry><script>r_in[]</script></onentry>",
            "an entry action within a state with a `history`",
        ),
        (
            "<history id='back'/>",
            "<transition cond='x' target='back'/>",
            "a transition to the `history` of a state around it",
        ),
        (
            "<history id='back'/><state id='n'><history id='m'/><state id='o'/></state>",
            "",
            "a shallow `history` around another one",
        ),
    ] {
        let text = document(history, inside);
        let text =
            if told.starts_with("a machine") { text.replacen("<scxml ", "<scxml initial='on' ", 1) } else { text };
        let imported = scxml(FileId(0), &text, "C");
        let messages: Vec<&str> = imported.diagnostics.iter().map(|fault| fault.message.as_str()).collect();
        assert!(messages.contains(&format!("charts cannot express {told}").as_str()), "{told}: {messages:#?}");
        assert!(!messages.iter().any(|message| message.contains("does not lie within it")), "{told}: {messages:#?}");
        assert_eq!(imported.text, None);
    }
}
