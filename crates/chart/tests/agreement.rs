//! Charts, the models built from them and the charts extracted from these agree; so do the library and its charts.

use std::collections::BTreeSet;

use chart::{Chart, Known, Origin, Target, build, extract, probed, read, transitions, write};
use model::{Checked, check};
use syntax::{FileId, Severity, SourceFile, parse_chart};
use testkit::{NoSolver, Patterns, repository};

fn text(name: &str) -> String {
    repository::text(format!("library/patterns/{name}"))
}

fn chart(text: &str) -> Chart {
    let (chart, faults) = read(FileId(0), &parse_chart(FileId(0), text));
    assert!(faults.iter().all(|fault| fault.severity != Severity::Error), "{faults:#?}\n{text}");
    chart
}

fn checked(name: &str, text: &str) -> Checked {
    let checked = check(SourceFile::new(name, text), &mut Patterns);
    let errors: Vec<_> = checked.diagnostics.iter().filter(|fault| fault.severity == Severity::Error).collect();
    assert!(errors.is_empty(), "{errors:#?}\n{text}");
    checked
}

/// The transitions of a chart, by the links of its shapes; staying in the control state counts as a target.
fn meaning(chart: &Chart, rule: &str) -> BTreeSet<String> {
    let machine = chart.machines.iter().find(|machine| machine.rule.as_ref().is_some_and(|link| link.name == rule));
    let machine = machine.unwrap_or_else(|| panic!("no machine {rule} in {}", chart.name));
    let linked = |id| machine.shape(id).link.as_ref().map_or_else(String::new, |link| link.text.clone());
    let one = |transition: &chart::Transition| {
        let origin = match transition.origin {
            Origin::Enter => "enter".to_string(),
            Origin::State(id) | Origin::Left(id) => linked(id),
        };
        let mut guards: Vec<_> =
            transition.guards.iter().map(|(id, holds)| format!("{} is {holds}", linked(*id))).collect();
        guards.sort();
        let actions: BTreeSet<String> = transition.actions.iter().map(|id| linked(*id)).collect();
        let target = match transition.target {
            Target::State(id) | Target::Block(id) => linked(id),
            Target::Exit => "exit".to_string(),
        };
        format!("{origin} if {guards:?} does {actions:?} to {target}")
    };
    transitions(chart, machine).iter().map(one).collect()
}

#[test]
fn the_library_does_what_its_charts_say() {
    let chart = chart(&text("PatternMachines.chart"));
    let specification = text("PatternMachines.asm");
    let probed = probed(&chart, &specification).expect("the library parses");
    let checked = checked("PatternMachines.asm", &probed.text);
    assert_eq!(chart::check(&chart, &probed, &checked, &mut NoSolver), []);
}

#[test]
fn a_machine_begins_where_its_chart_does() {
    let drawn = chart(
        "chart Lamp machine lamp {r_lamp} control {light} initial state off {OFF} state on {ON} guard pressed {pressed}
         off -> pressed yes -> on endmachine",
    );
    let differs = |main: &str, init: &str| -> Vec<(Severity, String)> {
        let text = format!(
            "asm Lamp import StandardLibrary signature: enum domain Light = {{OFF | ON}} controlled light: Light
             monitored pressed: Boolean definitions:
             rule r_lamp = if light = OFF and pressed then light := ON endif
             rule r_twice = par r_lamp[] r_lamp[] endpar
             main rule r_Main = {main} {init}"
        );
        let probed = probed(&drawn, &text).expect("it parses");
        let faults = chart::check(&drawn, &probed, &checked("Lamp.asm", &probed.text), &mut NoSolver);
        let told = faults.iter().filter(|fault| fault.id == "chart-differs");
        told.map(|fault| (fault.severity, fault.message.clone())).collect()
    };
    let one = |severity: Severity, message: &str| vec![(severity, message.to_string())];
    let off = "default init s0: function light = OFF";
    assert_eq!(differs("r_twice[]", off), []);
    assert_eq!(differs("forall $x in {1:2} with true do r_lamp[]", off), []);
    let other = |state: &str| one(Severity::Error, &format!("the chart begins in `OFF`, and the model in `{state}`"));
    assert_eq!(differs("r_lamp[]", "default init s0: function light = ON"), other("ON"));
    assert_eq!(differs("r_lamp[]", "default init s0:"), other("undef"));
    assert_eq!(differs("r_lamp[]", ""), other("undef"));
    let computed = "that the model begins in `OFF`, as the chart does, was not looked at";
    let choice = "default init s0: function light = chooseone({OFF, ON})";
    assert_eq!(differs("r_lamp[]", choice), one(Severity::Warning, computed));
    let idle = "nothing runs the machine: no rule that runs calls `r_lamp`";
    assert_eq!(differs("skip", off), one(Severity::Warning, idle));
    // What nothing runs begins nowhere.
    assert_eq!(differs("skip", ""), one(Severity::Warning, idle));
}

/// A domain of parameters that the file has already gets no element.
#[test]
fn parameters_of_a_domain_written_by_hand_add_nothing_to_it() {
    let drawn = chart(
        "chart Tiny machine tiny ($p in Port) control mode initial state idle state busy guard go
         idle -> go yes -> busy endmachine",
    );
    let built = |existing: Option<&str>| build(&drawn, &Known::default(), existing).expect("it parses").text;
    assert!(built(None).contains("abstract domain Port\n\tstatic port1: Port\n"), "{}", built(None));
    let there = "asm Tiny import StandardLibrary signature: enum domain Port = {LEFT | RIGHT} definitions: main rule r_Main = skip";
    let merged = built(Some(there));
    assert!(!merged.contains("port1") && merged.contains("mode: Port -> ModeState"), "{merged}");
    assert_eq!(checked("Tiny.asm", &merged).diagnostics, [], "{merged}");
}

/// The control variable of a pattern without states would have no value.
#[test]
fn a_pattern_without_states_is_told() {
    let drawn = chart(
        "chart Nop machine m control mode initial state idle instance ii of pp idle -> ii -> idle endmachine
         pattern pp control hand action act enter -> act -> exit endpattern",
    );
    let told: Vec<String> = chart::stateless(&drawn).into_iter().map(|fault| fault.message).collect();
    assert_eq!(told, ["the pattern `pp` has no control state: there is nothing to build"]);
}

/// What only a chart's machines set is not set by others, and not before they run.
#[test]
fn patterns_and_histories_begin_undef_and_are_left_to_their_machines() {
    let drawn = chart(
        "chart Door machine door control mode initial state off composite state working history
         initial state shut state open guard push shut -> push yes -> open endstate instance looking of look
         guard power guard cut off -> power yes -> working working -> cut yes -> looking -> off endmachine
         pattern look control eye state first state second guard seen guard again action grip
         enter -> first -> seen yes -> grip -> second -> again yes -> exit endpattern",
    );
    let built = build(&drawn, &Known::default(), None).expect("there was no file").text;
    let differs = |from: &str, to: &str| -> Vec<(Severity, String)> {
        assert!(built.contains(from), "{built}");
        let text = built.replacen(from, to, 1);
        let probed = probed(&drawn, &text).expect("it parses");
        let checked = checked("Door.asm", &probed.text);
        assert_eq!(checked.diagnostics, [], "{text}");
        let faults = chart::check(&drawn, &probed, &checked, &mut NoSolver);
        faults.into_iter().map(|fault| (fault.severity, fault.message)).collect()
    };
    let begins = "default init s0:\n";
    let begun = |function: &str| differs(begins, &format!("{begins}\tfunction {function}\n"));
    let one = |severity: Severity, message: &str| vec![(severity, message.to_string())];
    assert_eq!(differs(begins, begins), []);
    assert_eq!(begun("eye = undef"), []);
    let eye = "`eye` is undef in the chart until the pattern is entered, and begins with `SECOND` in the model";
    assert_eq!(begun("eye = SECOND"), one(Severity::Error, eye));
    let left =
        "`workingLeft` is undef in the chart until the composite state is left, and begins with `OPEN` in the model";
    assert_eq!(begun("workingLeft = OPEN"), one(Severity::Error, left));
    let computed = "that `eye` is undef until the pattern is entered, as in the chart, was not looked at";
    assert_eq!(begun("eye = if true then SECOND else FIRST endif"), one(Severity::Warning, computed));
    let sets = |rule: &str, function: &str| {
        let message = format!("`{rule}` sets `{function}`, which the chart leaves to its machine: no arrow shows that");
        one(Severity::Error, &message)
    };
    let main = "main rule r_Main =\n\t\tr_door[]";
    let beside = |rule: &str| differs(main, &format!("main rule r_Main = par r_door[] {rule} endpar"));
    assert_eq!(beside("skip"), []);
    assert_eq!(beside("if mode = OFF and cut then mode := OPEN endif"), sets("r_Main", "mode"));
    assert_eq!(beside("if cut then workingLeft := OPEN endif"), sets("r_Main", "workingLeft"));
    let turbo = "turbo rule r_next in ModeState = result := OFF\n\tmain rule r_Main =\n\t\tpar r_door[] mode <- r_next() endpar";
    assert_eq!(differs(main, turbo), sets("r_Main", "mode"));
    assert_eq!(differs("rule r_grip = skip", "rule r_grip = mode := OFF"), sets("r_grip", "mode"));
}

/// Where the control variable is set to what it is and to something else, no step can be made.
#[test]
fn staying_counts_as_nothing_unless_something_else_leaves() {
    let drawn = chart(
        "chart Lamp machine lamp {r_lamp} control {light} initial state off {OFF} state on {ON} guard pressed {pressed}
         off -> pressed yes -> on on -> pressed pressed no -> off endmachine",
    );
    let differs = |rule: &str| -> Vec<String> {
        let text = format!(
            "asm Lamp import StandardLibrary signature: enum domain Light = {{OFF | ON}} controlled light: Light
             monitored pressed: Boolean definitions:
             rule r_lamp = par if light = OFF and pressed then light := ON endif
             if light = ON and not pressed then light := OFF endif {rule} endpar
             main rule r_Main = r_lamp[] default init s0: function light = OFF"
        );
        let probed = probed(&drawn, &text).expect("it parses");
        let faults = chart::check(&drawn, &probed, &checked("Lamp.asm", &probed.text), &mut NoSolver);
        faults.iter().map(|fault| fault.message.clone()).collect()
    };
    let says = |origin: &str, case: &str| {
        format!("in {origin}, the rule does `light := {origin}` where {case}, the chart does not")
    };
    let (off, on) = (says("OFF", "pressed"), says("ON", "not (pressed)"));
    assert_eq!(differs("if pressed and light = ON then light := ON endif"), [""; 0]);
    assert_eq!(differs("if not pressed and light = OFF then light := light endif"), [""; 0]);
    assert_eq!(differs("if light = OFF then light := OFF endif"), [off.as_str()]);
    assert_eq!(differs("if not pressed then light := light endif"), [on.as_str()]);
    assert_eq!(differs("light := light"), [off, on]);
}

#[test]
fn a_change_of_the_library_is_found() {
    let chart = chart(&text("PatternMachines.chart"));
    let specification = text("PatternMachines.asm");
    for (from, to) in [
        (
            "r_SwingingBuffer_endWrite[sharedMemory(scheduler_currentPhase($c))]\n\t\t\t\tr_startManaging",
            "r_startManaging",
        ),
        (
            "if givesUp($c) then\n\t\t\tpar\n\t\t\t\tr_giveUpSb[$c]\n\t\t\t\tr_startReading",
            "if givesUp($c) then\n\t\t\tpar\n\t\t\t\tr_startReading",
        ),
        ("case READING:\n\t\t\t\t\tr_finishReading", "case WRITING:\n\t\t\t\t\tr_finishReading"),
        ("sb_ctrlState(scheduler_currentPhase($c)) := undef", "sb_ctrlState(scheduler_currentPhase($c)) := READING"),
    ] {
        assert!(specification.contains(from), "the library has no {from:?}");
        let probed = probed(&chart, &specification.replacen(from, to, 1)).expect("the library parses");
        let faults = chart::check(&chart, &probed, &checked("PatternMachines.asm", &probed.text), &mut NoSolver);
        assert!(!faults.is_empty(), "{to} went unseen");
        assert!(faults.iter().all(|fault| fault.id == "chart-differs"), "{faults:#?}");
    }
}

#[test]
fn built_and_extracted_again() {
    let chart = chart(&text("PatternMachines.chart"));
    let specification = text("PatternMachines.asm");
    let imports: String = chart.imports.iter().map(|import| format!("import {import}\n")).collect();
    let known =
        Known::of(&checked("Imports.asm", &format!("module Imports\n{imports}signature:\ndefinitions:\n")).model);
    let built = build(&chart, &known, Some(&specification)).expect("the library parses");
    assert_eq!(built.to_write, Vec::<String>::new());
    let model = checked("PatternMachines.asm", &built.text).model;
    // The built model does what the original did, and the same chart is extracted from it.
    let extracted = extract(&model, None, None);
    assert_eq!(extracted.others, []);
    for rule in chart.machines.iter().filter_map(|machine| Some(machine.rule.as_ref()?.name.as_str())) {
        assert_eq!(meaning(&extracted.chart, rule), meaning(&chart, rule), "{rule}");
    }
    // Its text reads back as the same chart.
    let again = crate::agreement::chart(&write(&extracted.chart));
    for machine in &extracted.chart.machines {
        let rule = &machine.rule.as_ref().expect("an extracted machine has a rule").name;
        assert_eq!(meaning(&again, rule), meaning(&extracted.chart, rule));
    }
}

#[test]
fn other_shapes_of_one_machine_are_one_chart() {
    let model = |rules: &str| {
        let text = format!(
            "asm Lamp\nimport StandardLibrary\nsignature:\n enum domain Light = {{OFF | ON}}\n controlled light: Light\n \
             monitored pressed: Boolean\n derived lit: Boolean\ndefinitions:\n function lit = light = ON\n{rules}\n \
             main rule r_Main = r_lamp[]\n default init s0: function light = OFF"
        );
        checked("Lamp.asm", &text).model
    };
    let first = extract(
        &model(
            "rule r_lamp = par if light = OFF then if pressed then light := ON endif endif if light = ON and pressed then light := OFF endif endpar",
        ),
        Some("r_lamp"),
        None,
    );
    assert_eq!(first.chart.machines.len(), 1);
    for rules in [
        "rule r_lamp = if pressed then switch light case OFF: light := ON case ON: light := OFF endswitch endif",
        "rule r_set($l in Light) = light := $l rule r_lamp = if lit and pressed then r_set[OFF] elseif not lit and pressed then r_set[ON] endif",
        "rule r_lamp = let ($l = light, $p = pressed) in if $l = OFF then if $p then light := ON endif else if not $p then skip else light := OFF endif endif endlet",
    ] {
        let other = extract(&model(rules), Some("r_lamp"), None);
        assert_eq!(meaning(&other.chart, "r_lamp"), meaning(&first.chart, "r_lamp"), "{rules}");
    }
    let hidden = extract(
        &model("rule r_lamp = if light = OFF then seq light := ON light := OFF endseq endif"),
        Some("r_lamp"),
        None,
    );
    assert!(hidden.chart.machines.is_empty());
}
