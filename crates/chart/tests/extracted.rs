//! An extracted chart has no faults and agrees with its model and with what is built from it; what cannot be extracted
//! is reported.

use chart::{Chart, Extracted, Known, build, dump, extract, nest, probed, read, write};
use expect_test::{Expect, expect};
use model::{Checked, Loader, check};
use syntax::{Diagnostic, FileId, Severity, SourceFile, parse_chart};
use testkit::{Disk, NoSolver, Texts, repository};

fn errors(faults: &[Diagnostic]) -> Vec<&Diagnostic> {
    faults.iter().filter(|fault| fault.severity == Severity::Error).collect()
}

fn checked(source: SourceFile, loader: &mut dyn Loader) -> Checked {
    let checked = check(source, loader);
    let errors = errors(&checked.diagnostics);
    assert!(errors.is_empty(), "{errors:#?}\n{}", checked.sources.file(checked.model.root).text);
    checked
}

/// Extracts the machines of a model and checks their chart in every available way; also returns the chart as it is read
/// back.
fn kept(source: &SourceFile, loader: &mut dyn Loader) -> (Extracted, Chart) {
    let model = checked(source.clone(), loader).model;
    kept_as(source, loader, extract(&model, None, None));
    let mut nested = extract(&model, None, None);
    nest(&model, &mut nested);
    kept_as(source, loader, nested)
}

fn kept_as(source: &SourceFile, loader: &mut dyn Loader, mut extracted: Extracted) -> (Extracted, Chart) {
    if extracted.chart.machines.is_empty() {
        let chart = extracted.chart.clone();
        return (extracted, chart);
    }
    let own = source.name.rsplit('/').next().unwrap_or(&source.name).to_string();
    extracted.chart.imports.push(own);
    let text = write(&extracted.chart);
    let (chart, faults) = read(FileId(0), &parse_chart(FileId(0), &text));
    assert_eq!(errors(&faults), Vec::<&Diagnostic>::new(), "{text}");
    agrees(&chart, &source.name, &source.text, loader);
    // The model with the chart built into it does the same, and has the same chart.
    let beside = source.name.rsplit_once('/').map_or(String::new(), |(folder, _)| format!("{folder}/")) + "Imports.asm";
    let known = Known::imported(&chart, &beside, loader).unwrap_or_else(|unknown| panic!("{unknown:#?}"));
    let built = build(&chart, &known, Some(&source.text)).expect("the model has no faults");
    assert_eq!(built.to_write, Vec::<String>::new(), "{text}");
    let again = checked(SourceFile::new(source.name.clone(), built.text.clone()), loader);
    agrees(&chart, &source.name, &built.text, loader);
    assert_eq!(extract(&again.model, None, None).chart.machines.len(), chart.machines.len(), "{}", built.text);
    (extracted, chart)
}

fn agrees(chart: &Chart, name: &str, text: &str, loader: &mut dyn Loader) {
    let probed = probed(chart, text).expect("the model has no faults");
    let checked = checked(SourceFile::new(name, probed.text.clone()), loader);
    let faults = chart::check(chart, &probed, &checked, &mut NoSolver);
    assert_eq!(errors(&faults), Vec::<&Diagnostic>::new(), "{}\n{text}", write(chart));
}

#[test]
fn every_model_of_the_library() {
    assert!(machines_in(&["library"]) > 10);
}

#[test]
fn every_other_model_of_this_repository() {
    assert!(machines_in(&["examples", "bench/models"]) > 10);
}

/// How many machines are found in the models of these folders, each of which is kept.
fn machines_in(folders: &[&str]) -> usize {
    let files = folders.iter().flat_map(|folder| repository::files(folder, &["asm"]));
    files.map(|file| kept(&Disk::read(&file).expect("the model is there"), &mut Disk).1.machines.len()).sum()
}

/// A model with such a rule.
fn model_with(signature: &str, rules: &str, init: &str) -> String {
    format!(
        "asm M\nimport StandardLibrary\nsignature:\n enum domain Mode = {{IDLE | BUSY | DONE}}\n controlled mode: Mode\n {signature}\n\
         definitions:\n {rules}\n main rule r_Main = skip\ndefault init s0: {init}"
    )
}

/// The chart of a model's own rules, and what is reported of the others.
fn found(signature: &str, rules: &str, init: &str) -> String {
    let text = model_with(signature, rules, init);
    let mut files = Texts::of([("M.asm", text.as_str())]);
    let (extracted, chart) = kept(&SourceFile::new("M.asm", text.clone()), &mut files);
    let mut out: String =
        dump(&chart).lines().filter(|line| !line.starts_with("chart")).map(|line| format!("{line}\n")).collect();
    extracted.others.iter().for_each(|(rule, reason)| out += &format!("{rule}: {reason}\n"));
    extracted.further.iter().for_each(|(rule, location)| out += &format!("{rule}: over {location}, too\n"));
    out
}

fn shows(signature: &str, rules: &str, init: &str, expected: &Expect) {
    expected.assert_eq(&found(signature, rules, init));
}

#[test]
fn a_machine_that_begins_where_its_rule_does_nothing() {
    let rule = "rule r_press = switch mode case BUSY: mode := DONE endswitch";
    shows(
        "",
        rule,
        "function mode = IDLE",
        &expect![[r#"
        import M.asm

        machine press() "Press"
          control {mode}
          initial state idle "Idle" {IDLE}
          state busy "Busy" {BUSY}
          state done "Done" {DONE}
          busy --[]/--> done
    "#]],
    );
}

/// What a machine calls may set other locations of its control function, also before the machine's own in the text.
#[test]
fn a_machine_whose_action_sets_another_location_of_its_control_function() {
    let text = "asm Two\nimport StandardLibrary\nsignature:\n enum domain Thread = {ONE | OTHER}\n enum domain Place = {RESTING | WORKING | ASLEEP}\n\
        controlled place: Thread -> Place\ndefinitions:\n\
        rule r_begin($t in Thread) = switch $t case ONE: place(ONE) := ASLEEP case OTHER: place(OTHER) := WORKING endswitch\n\
        rule r_step($t in Thread) = switch place($t) case RESTING: r_begin[$t] case WORKING: place($t) := RESTING\n\
        case ASLEEP: place($t) := WORKING endswitch\n\
        main rule r_Main = choose $t in Thread with true do r_step[$t]\ndefault init s0: function place($t in Thread) = RESTING";
    let (extracted, _) = kept(&SourceFile::new("Two.asm", text), &mut Texts::of([("Two.asm", text)]));
    assert_eq!(extracted.chart.machines.len(), 1);
}

#[test]
fn a_machine_that_unsets_its_control_location() {
    shows(
        "",
        "rule r_deposit = if mode = BUSY then mode := undef endif",
        "",
        &expect![[r#"
        import M.asm

        machine deposit() "Deposit"
          control {mode}
          initial state undefined "Undefined" {undef}
          state busy "Busy" {BUSY}
          busy --[]/--> undefined
    "#]],
    );
    // A machine that is also entered from undef is a pattern.
    let rule = "rule r_fetch = if isUndef(mode) then mode := BUSY elseif mode = BUSY then mode := undef endif";
    shows(
        "",
        rule,
        "function mode = IDLE",
        &expect![[r#"
        import M.asm

        pattern fetch() "Fetch"
          control {mode}
          state busy "Busy" {BUSY}
          enter --[]/--> busy
          busy --[]/--> exit
    "#]],
    );
}

#[test]
fn what_is_done_without_a_value() {
    let rule = "rule r_all = if mode = BUSY then mode := IDLE else n := 1 endif";
    shows(
        "controlled n: Integer",
        rule,
        "",
        &expect![[r#"
        import M.asm

        machine all() "All"
          control {mode}
          state idle "Idle" {IDLE}
          state busy "Busy" {BUSY}
          state done "Done" {DONE}
          initial state undefined "Undefined" {undef}
          action n "n := 1" {n := 1}
          action n2 "n := 1" {n := 1}
          action n3 "n := 1" {n := 1}
          idle --[]/n--> idle
          busy --[]/--> idle
          done --[]/n2--> done
          undefined --[]/n3--> undefined
    "#]],
    );
    shows(
        "controlled n: Integer",
        rule,
        "function mode = BUSY",
        &expect![[r#"
        import M.asm

        machine all() "All"
          control {mode}
          state idle "Idle" {IDLE}
          initial state busy "Busy" {BUSY}
          state done "Done" {DONE}
          action n "n := 1" {n := 1}
          action n2 "n := 1" {n := 1}
          idle --[]/n--> idle
          busy --[]/--> idle
          done --[]/n2--> done
    "#]],
    );
}

#[test]
fn updates_that_clash_are_paths_that_clash() {
    let inputs = "monitored a: Boolean monitored b: Boolean controlled n: Integer";
    let rule = "rule r_clash = if mode = BUSY then par if a then mode := IDLE endif if b then mode := DONE endif n := 3 endpar endif";
    shows(
        inputs,
        rule,
        "function mode = BUSY",
        &expect![[r#"
        import M.asm

        machine clash() "Clash"
          control {mode}
          initial state busy "Busy" {BUSY}
          state idle "Idle" {IDLE}
          state done "Done" {DONE}
          action n "n := 3" {n := 3}
          action n2 "n := 3" {n := 3}
          action n3 "n := 3" {n := 3}
          guard b "B" {b}
          guard a "A" {a}
          guard b2 "B" {b}
          guard a2 "A" {a}
          busy --[a]/n--> idle
          busy --[not a and b]/n2--> done
          busy --[not a and not b]/n3--> busy
          busy --[a2 and b2]/--> done
    "#]],
    );
}

#[test]
fn a_rule_has_one_machine() {
    let rule = "rule r_swap = if mode = BUSY and second = BUSY then par mode := IDLE second := DONE endpar endif";
    shows(
        "controlled second: Mode",
        rule,
        "function mode = BUSY function second = BUSY",
        &expect![[r#"
        import M.asm

        machine swap() "Swap"
          control {mode}
          initial state busy "Busy" {BUSY}
          state idle "Idle" {IDLE}
          action second "second := DONE" {second := DONE}
          guard second2 "second = BUSY" {second = BUSY}
          busy --[second2]/second--> idle
        r_swap: over second, too
    "#]],
    );
}

#[test]
fn names_that_are_words_of_charts() {
    let inputs = "monitored chart: Boolean monitored at: Boolean monitored tick: Boolean monitored of: Boolean";
    let rules = "rule r_machine = if mode = BUSY then if tick and of then mode := IDLE else if chart or at then \
                 mode := DONE endif endif endif rule r_r_state = if mode = IDLE then mode := BUSY endif \
                 rule r_state = if mode = DONE then mode := BUSY endif";
    shows(
        inputs,
        rules,
        "function mode = BUSY",
        &expect![[r#"
        import M.asm

        machine machine2() "Machine"
          control {mode}
          initial state busy "Busy" {BUSY}
          state idle "Idle" {IDLE}
          state done "Done" {DONE}
          guard at "At" {at}
          guard chart "Chart" {chart}
          guard of "Of" {of}
          guard tick "Tick" {tick}
          busy --[tick and of]/--> idle
          busy --[tick and not of and chart]/--> done
          busy --[tick and not of and not chart and at]/--> done
          busy --[not tick and chart]/--> done
          busy --[not tick and not chart and at]/--> done

        machine state2() "State"
          control {mode}
          initial state busy "Busy" {BUSY}
          state idle "Idle" {IDLE}
          idle --[]/--> busy

        machine state3() "State"
          control {mode}
          initial state busy "Busy" {BUSY}
          state done "Done" {DONE}
          done --[]/--> busy
    "#]],
    );
}

/// The machine of a chart, built to a model and extracted from that again.
fn again(machine: &str) -> String {
    let text = format!("chart M\n{machine}");
    let (chart, faults) = read(FileId(0), &parse_chart(FileId(0), &text));
    assert_eq!(errors(&faults), Vec::<&Diagnostic>::new(), "{text}");
    let known = Known::imported(&chart, "Imports.asm", &mut Texts::default()).unwrap_or_else(|_| panic!("{text}"));
    let built = build(&chart, &known, None).expect("the chart has no faults").text;
    let mut files = Texts::of([("M.asm", built.as_str())]);
    let (_, chart) = kept(&SourceFile::new("M.asm", built.clone()), &mut files);
    let text = write(&chart);
    text[text.find("machine ").expect("a machine")..].to_string()
}

#[test]
fn composite_states_with_history_entry_and_exit() {
    expect![[r#"
        machine carrier "Carrier" {r_carrier}
        	control {mode}
        	initial state stopped "Stopped" {STOPPED}
        	state ready "Ready" {READY}
        	composite state working "Working"
        		history {workingLeft}
        		initial state empty "Empty" {EMPTY}
        		state loaded "Loaded" {LOADED}
        		state lifted "Lifted" {LIFTED}
        		entry lampOn "LAMP ON" {r_lampOn[]}
        		exit lampOff "LAMP OFF" {r_lampOff[]}
        		guard grasped "Grasped" {grasped}
        		guard up "Up" {up}
        		guard released "Released" {released}
        	endstate
        	guard fresh "Fresh" {fresh}
        	guard started "Started" {started}
        	action halt "HALT" {r_halt[]}
        	guard emergency "Emergency" {emergency}
        	guard full "Full" {full}
        	stopped -> started yes -> working
        	empty -> grasped yes -> loaded
        	loaded -> released yes -> empty
        	lifted -> full yes -> ready
        	ready -> fresh yes -> loaded
        	working -> emergency yes -> halt -> stopped
        	up yes -> lifted
        	released no -> up
        endmachine
    "#]]
    .assert_eq(&again(
        "machine carrier\n control mode\n initial state stopped\n composite state working\n history\n entry lampOn\n exit lampOff\n \
         initial state empty\n state loaded\n state lifted\n guard grasped\n guard released\n guard full\n guard up\n \
         empty -> grasped yes -> loaded\n loaded -> released yes -> empty\n released no -> up yes -> lifted\n lifted -> full yes -> ready\n endstate\n \
         state ready\n guard started\n guard emergency\n guard fresh\n action halt\n stopped -> started yes -> working\n \
         working -> emergency yes -> halt -> stopped\n ready -> fresh yes -> loaded\nendmachine\n",
    ));
}

#[test]
fn composite_states_in_composite_states() {
    expect![[r#"
        machine line "Line" {r_line}
        	control {mode}
        	initial state off "Off" {OFF}
        	state failed "Failed" {FAILED}
        	composite state untilStop "Until stop"
        		initial state ready "Ready" {READY}
        		entry power "POWER" {r_power[]}
        		exit cut "CUT" {r_cut[]}
        		composite state untilPause "Until pause"
        			initial state forward "Forward" {FORWARD}
        			state back "Back" {BACK}
        			action turn "TURN" {r_turn[]}
        			guard atEnd "At end" {atEnd}
        		endstate
        		guard atHome "At home" {atHome}
        		guard pause "Pause" {pause}
        		guard go "Go" {go}
        	endstate
        	guard reset "Reset" {reset}
        	guard start "Start" {start}
        	guard armed "Armed" {armed}
        	guard broken "Broken" {broken}
        	guard stop "Stop" {stop}
        	off -> start yes -> untilStop
        	failed -> reset yes -> untilStop
        	ready -> go yes -> untilPause
        	forward -> atEnd yes -> turn -> back
        	back -> atHome yes -> ready
        	untilStop -> stop yes -> armed yes -> off
        	untilPause -> pause yes -> ready
        	broken yes -> failed
        	stop no -> broken
        endmachine
    "#]]
    .assert_eq(&again(
        "machine line\n control mode\n initial state off\n state failed\n composite state on\n entry power\n exit cut\n \
         initial state ready\n composite state moving\n initial state forward\n state back\n guard atEnd\n guard atHome\n action turn\n \
         forward -> atEnd yes -> turn -> back\n back -> atHome yes -> ready\n endstate\n guard go\n guard pause\n \
         ready -> go yes -> moving\n moving -> pause yes -> ready\n endstate\n guard stop\n guard armed\n guard broken\n guard start\n guard reset\n \
         off -> start yes -> on\n failed -> reset yes -> on\n on -> stop yes -> armed yes -> off\n stop no -> broken yes -> failed\nendmachine\n",
    ));
}

/// A model with an emergency stop, asked in each of these ways; the states that stand in a composite state.
fn held(stops: [&str; 2], more: &str) -> Vec<String> {
    let [idle, busy] = stops;
    let rule =
        format!("rule r_stop = par if mode = IDLE then {idle} endif if mode = BUSY then {busy} endif {more} endpar");
    let inputs = "monitored stop: Boolean monitored go: Boolean monitored ok: Boolean controlled n: Integer controlled last: Mode";
    let text = model_with(inputs, &rule, "function mode = IDLE");
    let mut files = Texts::of([("M.asm", text.as_str())]);
    let (_, chart) = kept(&SourceFile::new("M.asm", text.clone()), &mut files);
    let text = write(&chart);
    let inside = |line: &&str| line.starts_with("\t\t") && line.contains("state ");
    text.lines().filter(inside).map(|line| line.trim().to_string()).collect()
}

#[test]
fn what_is_a_composite_state_and_what_is_none() {
    let idle = "if stop then mode := DONE else if go then mode := BUSY endif endif";
    let busy = "if stop then mode := DONE else if ok then mode := IDLE endif endif";
    assert_eq!(held([idle, busy], "").len(), 2);
    // Asked last, or the other way round.
    assert_eq!(held([idle, "if ok and not stop then mode := IDLE elseif stop then mode := DONE endif"], "").len(), 2);
    assert_eq!(held([idle, "if not stop then if ok then mode := IDLE endif else mode := DONE endif"], "").len(), 2);
    // It does something else, or comes last.
    assert_eq!(
        held([idle, "if stop then par mode := DONE n := 1 endpar elseif ok then mode := IDLE endif"], ""),
        [""; 0]
    );
    assert_eq!(held([idle, "if ok then mode := IDLE elseif stop then mode := DONE endif"], ""), [""; 0]);
    // Two states that have nothing to do with each other.
    assert_eq!(
        held(["if stop then mode := DONE elseif go then n := 1 endif", "if stop then mode := DONE endif"], ""),
        [""; 0]
    );
    // Something goes on beside it, in one of them.
    assert_eq!(held([idle, busy], "if mode = BUSY and go then n := 2 endif"), [""; 0]);
    // One way out does not remember.
    let remember =
        |state: &str, rest: &str| format!("if stop then par mode := DONE last := {state} endpar else {rest} endif");
    let [idle, busy] =
        [remember("IDLE", "if go then mode := BUSY endif"), remember("BUSY", "if ok then mode := IDLE endif")];
    assert_eq!(held([&idle, &busy], "").len(), 2);
    let leaving = remember("BUSY", "if ok then mode := IDLE elseif go then mode := DONE endif");
    assert_eq!(held([&idle, &leaving], ""), [""; 0]);
}
