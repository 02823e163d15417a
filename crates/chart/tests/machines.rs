//! Components' own machines: how their functions meet channels and devices, what they become in the ground model, and the faults.

use chart::{Feed, Known, Take, build};
use syntax::SourceFile;
use testkit::{NoSolver, Texts, WithPatterns};

const MESSAGES: &str = "module Messages
export *
signature:
	enum domain Code = {LETTER | PARCEL}
definitions:
";

const SEQUENCER: &str = "asm Sequencer
import StandardLibrary
import Messages
signature:
	enum domain Mode = {IDLE | BUSY}
	domain Count subsetof Integer
	monitored codes: Code
	monitored isNewCodes: Boolean
	monitored stop: Boolean
	out orders: Boolean
	out lamp: Integer
	controlled mode: Mode
	derived isBusy: Boolean
definitions:
	domain Count = {0 : 3}
	function isBusy = mode = BUSY
	rule r_decide($m in Mode) = par mode := $m orders := $m = BUSY endpar
	invariant inv_lamp over lamp: lamp >= 0
	main rule r_Main =
		if not stop and isNewCodes and codes = PARCEL and not isBusy then r_decide[BUSY] else par r_decide[IDLE] lamp := 1 endpar endif
default init s0:
	function mode = IDLE
	function orders = false
	function lamp = 0
";

const CELL: &str = "chart Cell
import Messages
import machines/Sequencer
import patterns/ControlTask
system cell
	sensor stop : Boolean
	actuator lamp : Integer \"Lamp\"
	component reader synchronous period 10 ms
		elaborate look 1 ms
		write codes 1 ms
	endcomponent
	component sequencer synchronous period 20 ms
		read codes 1 ms
		elaborate decide 2 ms by Sequencer
		write orders 1 ms
	endcomponent
	component pusher synchronous period 10 ms
		read orders 1 ms
	endcomponent
	channel codes : Code from reader to sequencer queue 4
	channel orders : Boolean from sequencer to pusher shared value
	stop -> sequencer
	sequencer -> lamp
endsystem
";

fn files(sequencer: &str) -> WithPatterns {
    WithPatterns(Texts::of([
        ("Messages.asm", MESSAGES),
        ("machines/Messages.asm", MESSAGES),
        ("machines/Sequencer.asm", sequencer),
    ]))
}

fn load(cell: &str, sequencer: &str) -> chart::Loaded {
    let sequencer = sequencer.replace("import Messages", "import ../Messages");
    chart::load(SourceFile::new("Cell.chart", cell), &mut files(&sequencer))
}

fn faults(cell: &str, sequencer: &str) -> Vec<String> {
    let found = load(cell, sequencer).diagnostics;
    found
        .iter()
        .map(|fault| format!("{}: {} ({})", fault.id, fault.message, fault.help.clone().unwrap_or_default()))
        .collect()
}

/// The ids and texts of what `chart check` tells of a model.
fn told(drawn: &chart::Chart, model: &str) -> Vec<String> {
    let mut files = files(&SEQUENCER.replace("import Messages", "import ../Messages"));
    let checked = model::check(SourceFile::new("Cell.asm", model), &mut files);
    assert_eq!(checked.diagnostics, [], "{model}");
    let probed = chart::probed(drawn, model).expect("the model parses");
    let told = chart::check(drawn, &probed, &checked, &mut NoSolver);
    told.iter().map(|fault| format!("{}: {}", fault.id, fault.message)).collect()
}

#[test]
fn an_elaboration_may_have_a_rule_beside_its_machine() {
    let cell = CELL.replace("by Sequencer", "by Sequencer {r_stage[$c]}");
    let loaded = load(&cell, SEQUENCER);
    assert_eq!(loaded.diagnostics, []);
    let mut drawn = loaded.chart;
    let mut files = files(&SEQUENCER.replace("import Messages", "import ../Messages"));
    let known = Known::completed(&mut drawn, "Imports.asm", &mut files).expect("the imports have no faults");
    assert_eq!(chart::unbuilt(&drawn, &known), []);
    let built = build(&drawn, &known, None).expect("there was no file");
    assert_eq!(built.to_write, ["r_stage"]);
    for part in ["case sequencer_decide: <<r_stage(Scheduler)>>", "case sequencer_decide: r_end_sequencer_decide[]"] {
        assert!(built.text.contains(part), "{part} is missing in\n{}", built.text);
    }
    // What is written by hand is kept. It may look at what the machine decides, and leaves that to the machine.
    let stub = "rule r_stage($c in Scheduler) = skip\n";
    assert!(built.text.contains(stub), "{}", built.text);
    let written = |rule: &str| built.text.replace(stub, &format!("rule r_stage($c in Scheduler) =\n\t\t{rule}\n"));
    let model = written("if sequencer_mode = SEQUENCER_BUSY then sv_staged(orders) := clock endif");
    assert_eq!(told(&drawn, &model), [""; 0]);
    assert!(build(&drawn, &known, Some(&model)).expect("it parses").text.contains("sv_staged(orders) := clock"));
    for update in ["sequencer_mode := SEQUENCER_IDLE", "orders_value(1) := true", "lamp := 3"] {
        let function = update.split([' ', '(']).next().unwrap_or_default();
        let message = format!("`r_stage` updates `{function}`, which is for the machines of components alone");
        assert_eq!(told(&drawn, &written(update)), [format!("system-differs: {message}")]);
    }
}

/// The built text, which has no faults.
fn built() -> String {
    let mut drawn = load(CELL, SEQUENCER).chart;
    let mut files = files(&SEQUENCER.replace("import Messages", "import ../Messages"));
    let known = Known::completed(&mut drawn, "Imports.asm", &mut files).expect("the imports have no faults");
    assert_eq!(chart::unbuilt(&drawn, &known), []);
    let built = build(&drawn, &known, None).expect("there was no file").text;
    let checked = model::check(SourceFile::new("Cell.asm", built.as_str()), &mut files);
    assert_eq!(checked.diagnostics, [], "{built}");
    // Building again changes nothing, and chart and model agree.
    assert_eq!(build(&drawn, &known, Some(&built)).expect("what was built parses").text, built);
    let probed = chart::probed(&drawn, &built).expect("the model parses");
    assert_eq!(chart::check(&drawn, &probed, &checked, &mut NoSolver), []);
    let changed = built.replace("sequencer_lamp", "lamp").replace("lamp := 1", "lamp := 2");
    assert_ne!(changed, built);
    let probed = chart::probed(&drawn, &changed).expect("the model parses");
    let checked = model::check(SourceFile::new("Cell.asm", changed.as_str()), &mut files);
    let told = chart::check(&drawn, &probed, &checked, &mut NoSolver);
    assert_eq!(told.iter().map(|fault| fault.id).collect::<Vec<_>>(), ["system-differs"]);
    built
}

#[test]
fn what_building_anew_would_define_otherwise_is_told() {
    let text = built();
    let mut drawn = load(CELL, SEQUENCER).chart;
    let mut files = files(&SEQUENCER.replace("import Messages", "import ../Messages"));
    let known = Known::completed(&mut drawn, "Imports.asm", &mut files).expect("the imports have no faults");
    let told = |model: &str| -> Vec<String> {
        let faults = chart::outdated(&drawn, &known, syntax::FileId(0), model);
        faults.into_iter().map(|fault| fault.message).collect()
    };
    assert_eq!(told(&text), [""; 0]);
    assert_eq!(told(&text.replace("= mq_taken(codes) !=", "=\n// new?\n mq_taken(codes)   !=")), [""; 0]);
    let inverted = text.replace("= mq_taken(codes) !=", "= mq_taken(codes) =");
    assert_eq!(told(&inverted), ["the definition of `sequencer_isNewCodes` differs from what the chart is built to"]);
    // An overload by hand hides none of it.
    let overload = "\n\tfunction sequencer_isNewCodes($n in Integer) = $n > 0\n\n\tmain rule";
    assert_eq!(told(&text.replacen("\n\tmain rule", overload, 1)), [""; 0]);
    assert_eq!(told(&inverted.replacen("\n\tmain rule", overload, 1)).len(), 1);
    let line = text.lines().find(|line| line.contains("function sequencer_isNewCodes")).expect("it is built");
    assert_eq!(told(&text.replace(line, "")), ["the model lacks the definition of `sequencer_isNewCodes`"]);
}

#[test]
fn a_machine_becomes_a_part_of_its_component() {
    let loaded = load(CELL, SEQUENCER);
    assert_eq!(loaded.diagnostics, []);
    // The machine's module is not imported: its names would not be the component's.
    assert_eq!(loaded.chart.imports, ["Messages", "patterns/ControlTask"]);
    let system = loaded.chart.system.expect("a system");
    let machine = &system.computing.machines[0];
    let named = |name: &str| name.to_string();
    let feeds =
        [(named("codes"), Feed::Channel(0)), (named("isNewCodes"), Feed::IsNew(0)), (named("stop"), Feed::Sensor(0))];
    assert_eq!((machine.component, machine.phase, &machine.feeds[..]), (1, 1, &feeds[..]));
    assert_eq!(machine.takes, [(named("orders"), Take::Channel(1)), (named("lamp"), Take::Actuator(1))]);
    let text = built();
    for part in [
        "enum domain SequencerMode = {SEQUENCER_IDLE | SEQUENCER_BUSY}",
        "domain SequencerCount = {0 : 3}",
        "derived sequencer_codes: Code",
        "function sequencer_codes = codes_value(mq_taken(codes))",
        "function sequencer_isNewCodes = mq_taken(codes) != sequencer_taken_codes",
        "monitored stop: Boolean",
        "out lamp: Integer",
        "orders_value(sv_sequence(orders) + 1) := sequencer_orders",
        "monitored reader_codes: Code",
        "codes_value(mq_sent(codes) + 1) := reader_codes",
        "rule r_sequencer_decide($m in SequencerMode) =",
        "function sequencer_mode = SEQUENCER_IDLE",
        "case sequencer_decide: r_end_sequencer_decide[]",
    ] {
        assert!(text.contains(part), "{part}\n{text}");
    }
    // What the machine has to keep is about the machine alone.
    assert!(!text.contains("inv_lamp"), "{text}");
}

#[test]
fn faults_of_the_chart() {
    let check = |from: &str, to: &str, expected: &[&str]| {
        assert!(CELL.contains(from), "{from}");
        assert_eq!(faults(&CELL.replacen(from, to, 1), SEQUENCER), expected, "{to}");
    };
    check(
        "by Sequencer",
        "by Sequenzer",
        &["component-machine: there is no machine `Sequenzer` (did you mean `Sequencer`?)"],
    );
    check(
        "channel codes : Code from",
        "channel codes from",
        &[
            "unfed-function: nothing feeds the monitored function `codes` of the machine (say what the channel carries: `channel codes : DOMAIN from …`)",
            "unfed-function: nothing feeds the monitored function `isNewCodes` of the machine (say what the channel carries: `channel codes : DOMAIN from …`)",
        ],
    );
    check(
        "\tstop -> sequencer\n",
        "",
        &[
            "unfed-function: nothing feeds the monitored function `stop` of the machine (connect the two: `stop -> sequencer`)",
        ],
    );
    check(
        "channel orders : Boolean",
        "channel orders : Code",
        &[
            "message-domain: the function `orders` of the machine is of Boolean, what goes through is of Code (give both the same domain: one that a module declares which the chart and the machine import)",
        ],
    );
    check(
        "channel codes : Code",
        "channel codes : Cod",
        &[
            "message-domain: there is no domain `Cod` (declare it in a module, and import that in the chart and in the machines)",
        ],
    );
    check(
        "read orders 1 ms",
        "read orders 1 ms by Sequencer",
        &["component-machine: this phase has a machine and computes nothing (write it after an `elaborate` phase)"],
    );
    check(
        "\t\telaborate look 1 ms\n",
        "",
        &[
            "unwritten-channel: `reader` writes `codes` before it has elaborated anything (put an `elaborate` phase before it)",
        ],
    );
}

#[test]
fn faults_of_the_machine() {
    let check = |from: &str, to: &str, expected: &[&str]| {
        assert!(SEQUENCER.contains(from), "{from}");
        let found = faults(CELL, &SEQUENCER.replace(from, to));
        assert_eq!(found.len(), expected.len(), "{found:#?}");
        found.iter().zip(expected).for_each(|(found, expected)| assert!(found.starts_with(expected), "{found}"));
    };
    check("main rule r_Main", "rule r_Main", &["component-machine: `Sequencer` cannot be the machine of a component"]);
    check("stop: Boolean", "stop: Booleen", &["component-machine: `Sequencer` cannot be the machine of a component"]);
    check(
        "isNewCodes",
        "isNewCode",
        &[
            "unfed-function: nothing feeds the monitored function `isNewCode` of the machine (did you mean `isNewCodes`?)",
        ],
    );
    check("out orders", "controlled orders", &["unwritten-channel: the machine has no out function `orders`"]);
    check("orders := $m = BUSY", "skip", &["unwritten-channel: the machine never updates `orders`"]);
    check(
        "lamp",
        "lamps",
        &["untaken-function: nothing takes the out function `lamps` of the machine (did you mean `lamp`?)"],
    );
    check(
        "controlled mode: Mode",
        "controlled mode: Mode\n\tshared common: Integer",
        &["unfed-function: nothing feeds"],
    );
}

#[test]
fn names_that_meet() {
    let mut drawn = load(CELL, &SEQUENCER.replace("isBusy", "wait")).chart;
    let mut files = files(&SEQUENCER.replace("isBusy", "wait").replace("import Messages", "import ../Messages"));
    let known = Known::completed(&mut drawn, "Imports.asm", &mut files).expect("the imports have no faults");
    let told: Vec<String> = chart::unbuilt(&drawn, &known).into_iter().map(|fault| fault.message).collect();
    assert_eq!(told, ["a second `sequencer_wait` would be made"]);
}

#[test]
fn the_example_of_the_page() {
    let page = testkit::Page::spec("charts");
    let block =
        |words: &str| page.blocks().into_iter().find(|block| block.text.starts_with(words)).expect("a block").text;
    let mut files = WithPatterns(Texts::of([("Sequencer.asm", block("asm Sequencer"))]));
    let loaded = chart::load(SourceFile::new("Cell.chart", block("chart Cell")), &mut files);
    assert_eq!(loaded.diagnostics, []);
    let mut drawn = loaded.chart;
    let known = Known::completed(&mut drawn, "Imports.asm", &mut files).expect("the imports have no faults");
    let built = build(&drawn, &known, None).expect("there was no file").text;
    let checked = model::check(SourceFile::new("Cell.asm", built.as_str()), &mut files);
    assert_eq!(checked.diagnostics, [], "{built}");
}
