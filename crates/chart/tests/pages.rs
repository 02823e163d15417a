//! The pages in spec/ are correct: the charts of `charts.md` have no faults, they are built to what the page shows,
//! which passes `check`, and each fault has a page whose example shows it.

use chart::{Chart, Known, build, probed, read};
use model::check;
use syntax::{Diagnostic, FileId, SourceFile, parse_chart};
use testkit::page::Block;
use testkit::{NoFiles, NoSolver, Page, Patterns, Texts};

fn chart(text: &str) -> (Chart, Vec<Diagnostic>) {
    read(FileId(0), &parse_chart(FileId(0), text))
}

/// What the pattern library declares.
fn patterns() -> Known {
    let (importing, _) = chart("chart C import patterns/ControlTask");
    Known::imported(&importing, "Imports.asm", &mut Patterns).expect("the library has no faults")
}

fn built(text: &str) -> String {
    let (chart, faults) = chart(text);
    assert_eq!(faults, [], "{text}");
    build(&chart, &Known::default(), None).expect("there was no file").text
}

#[test]
fn the_charts_of_the_page() {
    let page = Page::spec("charts");
    let blocks = page.blocks();
    for (index, Block { info, text: code, .. }) in blocks.iter().enumerate().filter(|(_, block)| block.info == "chart")
    {
        if chart(code).0.system.is_some() {
            continue; // it is built over the library, as the examples are
        }
        let text = built(code);
        if let Some(shown) = blocks.get(index + 1).filter(|block| block.info == "asmetal built") {
            assert_eq!(text, shown.text, "{info}");
        }
        let checked = check(SourceFile::new(format!("{}.asm", chart(code).0.name), text.as_str()), &mut NoFiles);
        assert_eq!(checked.diagnostics, [], "{text}");
    }
}

/// Whether a component has a machine.
fn computes(chart: &Chart) -> bool {
    let components = chart.system.iter().flat_map(|system| &system.components);
    components.flat_map(|component| &component.phases).any(|phase| phase.machine.is_some())
}

#[test]
fn each_fault_has_a_page_whose_example_shows_it() {
    assert!(chart::FAULT_IDS.is_sorted());
    for id in chart::FAULT_IDS {
        let page = Page::fault(id);
        let block = |wanted: &str| page.texts(wanted).first().copied();
        if let Some(document) = block("xml fault") {
            let faults = chart::import::scxml(FileId(0), document, "Example").diagnostics;
            assert_eq!(faults.iter().map(|fault| fault.id).collect::<Vec<_>>(), [*id]);
            continue;
        }
        let (drawn, mut faults) = chart(block("chart fault").expect("an example"));
        if faults.is_empty() && computes(&drawn) {
            // A machine is read from its own file.
            let machine = block("asmetal machine").unwrap_or_default();
            let texts = machine.split_whitespace().nth(1).map(|name| (format!("{name}.asm"), machine));
            let mut loader = Texts::of(texts.iter().map(|(name, text)| (name.as_str(), *text)));
            let root = SourceFile::new("Example.chart", block("chart fault").expect("an example"));
            faults = chart::load(root, &mut loader).diagnostics;
        }
        if faults.is_empty() {
            faults.extend(chart::unbuilt(&drawn, &patterns()));
        }
        if faults.is_empty() && drawn.system.is_none() {
            faults.extend(chart::unverified(&drawn, &patterns()).into_iter().filter(|fault| fault.id == *id));
        }
        let before = block("chart before").map(|text| {
            let (before, faults) = chart(text);
            assert_eq!(faults, []);
            build(&before, &patterns(), None).expect("there was no file").text
        });
        if let Some(specification) = block("asmetal").or(before.as_deref()) {
            let probed = probed(&drawn, specification).expect("the specification parses");
            let checked = check(SourceFile::new(format!("{}.asm", drawn.name), probed.text.as_str()), &mut Patterns);
            faults.extend(chart::check(&drawn, &probed, &checked, &mut NoSolver));
        }
        let ids: Vec<_> = faults.iter().map(|fault| fault.id).collect();
        assert_eq!(ids, [*id], "{faults:#?}");
    }
}

/// A model that exists runs what is drawn once it has been built again.
#[test]
fn a_changed_chart_changes_what_the_model_runs() {
    let lamp = "chart L\nmachine lamp\n\tcontrol light\n\tinitial state off\n\tstate on\n\tguard pressed\n\
                \toff -> pressed yes -> on\n\ton -> off\nendmachine\n";
    let fan =
        "machine fan ($r in Room)\n\tcontrol speed\n\tinitial state slow\n\tstate fast\n\tslow -> fast\nendmachine\n";
    let bulb = lamp.replace("machine lamp", "machine bulb");
    let first = built(lamp);
    let again = |code: &str, text: &str| {
        let rebuilt = build(&chart(code).0, &Known::default(), Some(text)).expect("the file has no faults").text;
        assert_eq!(build(&chart(code).0, &Known::default(), Some(&rebuilt)).expect("no faults").text, rebuilt);
        rebuilt.split_once("\tmain rule").expect("a main rule").1.split_whitespace().collect::<Vec<_>>().join(" ")
    };
    let off = "default init s0: function light = OFF";
    assert_eq!(again(lamp, &first), format!("r_Main = r_lamp[] {off}"));
    assert_eq!(again(&bulb, &first), format!("r_Main = r_bulb[] {off}"));
    let on = lamp.replace("initial state off", "state off").replace("state on", "initial state on");
    assert_eq!(again(&on, &first), "r_Main = r_lamp[] default init s0: function light = ON");
    let both = "par r_lamp[] forall $r in Room with true do r_fan[$r] endpar";
    let slow = "function speed($r in Room) = SLOW";
    assert_eq!(again(&format!("{lamp}{fan}"), &first), format!("r_Main = {both} {off} {slow}"));
    // Of two machines with one control variable, the first had another name.
    let other = bulb.split_once("machine bulb").expect("a machine").1;
    let two = again(&format!("{bulb}machine fan{other}"), &first);
    assert_eq!(two, format!("r_Main = par r_bulb[] r_fan[] endpar {off}"));
    // What is written by hand stays: other rules that are called, a main rule that does more, a value that is computed.
    let with = |main: &str, value: &str| {
        let rules = "rule r_reset = if wanted then light := OFF endif\n\trule r_all = r_lamp[]\n\tmain rule r_Main =";
        let text = first.replace("main rule r_Main =\n\t\tr_lamp[]", &format!("{rules} {main}"));
        text.replace("function light = OFF", &format!("function light = {value}"))
    };
    let reset = with("par r_lamp[] // first\n r_reset[] endpar", "OFF");
    assert_eq!(again(&bulb, &reset), format!("r_Main = par r_bulb[] // first r_reset[] endpar {off}"));
    assert_eq!(again(lamp, &with("r_all[]", "OFF")), format!("r_Main = r_all[] {off}"));
    assert_eq!(
        again(&bulb, &with("seq r_lamp[] skip endseq", "OFF")),
        format!("r_Main = seq r_lamp[] skip endseq {off}")
    );
    let chosen = again(&on, &with("r_lamp[]", "chooseone({OFF, ON})"));
    assert_eq!(chosen, "r_Main = r_lamp[] default init s0: function light = chooseone({OFF, ON})");
    let nothing = first.split("default init").next().expect("the rules").to_string();
    assert_eq!(again(lamp, &nothing), format!("r_Main = r_lamp[] {off}"));
}

#[test]
fn what_is_written_by_hand_stays() {
    let before = Page::spec("charts");
    let blocks = before.blocks();
    let code = blocks.iter().find(|block| block.text.contains("chart Fetch")).expect("the chart").text;
    let text = built(code);
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
    // Building an unchanged chart changes nothing.
    changed = chart(code).0;
    assert_eq!(build(&changed, &Known::default(), Some(&text)).expect("no faults").text, text);
}
