//! Small couples of machines, one for each thing that a refinement may be or lack.

use std::sync::Arc;

use program::Program;
use refine::{CONCRETE, Coupling, Ended, Options, Report, Vacuous, Verdict, refine};
use syntax::SourceFile;
use testkit::NoFiles;

pub fn program(name: &str, text: &str) -> Arc<Program> {
    let checked = model::check(SourceFile::new(format!("{name}.asm"), text), &mut NoFiles);
    let wrong: Vec<_> = checked.diagnostics.iter().map(|fault| (&fault.message, fault.primary.span)).collect();
    assert!(wrong.is_empty(), "{wrong:?}");
    Arc::new(program::lower(&checked.model).expect("it is lowered"))
}

/// The program of a text that begins with `asm NAME`.
pub fn example(text: &str) -> Arc<Program> {
    program(text.split_whitespace().nth(1).expect("a name"), text)
}

/// A machine with this signature, main rule and initial state.
pub fn machine(signature: &str, rule: &str, init: &str) -> Arc<Program> {
    program("M", &text_of(signature, rule, init))
}

/// The text of such a machine.
pub fn text_of(signature: &str, rule: &str, init: &str) -> String {
    format!("asm M\nimport StandardLibrary\nsignature:\n{signature}\ndefinitions:\n{rule}\ndefault init s0:\n{init}\n")
}

pub fn report(one: &Arc<Program>, other: &Arc<Program>, coupling: Option<&str>) -> Report {
    let text = coupling.map(|text| SourceFile::new("c.refine", text));
    let coupling = Coupling::new([one, other], text, &machine::Limits::default());
    let coupling = coupling.unwrap_or_else(|faulty| panic!("{:#?}", faulty.faults));
    refine(&coupling, &Options::default(), &mut |_| true).expect("it begins")
}

pub fn refuted(report: Report) -> refine::Refutation {
    match report.verdict {
        Verdict::DoesNot(refutation) => *refutation,
        other => panic!("{other:?}"),
    }
}

pub const COUNTER: &str = "domain N subsetof Integer controlled n: N";

pub fn counter(rule: &str) -> Arc<Program> {
    machine(COUNTER, &format!("domain N = {{0:3}}\nmain rule r_Main = {rule}"), "function n = 0")
}

#[test]
fn a_machine_refines_itself() {
    let one = counter("n := (n + 1) mod 4");
    let report = report(&one, &one, None);
    assert_eq!(report.verdict, Verdict::Refines);
    assert_eq!(report.progress.pairs, 4);
    assert_eq!(report.diagrams.into_iter().collect::<Vec<_>>(), [((1, 1), 4)]);
}

#[test]
fn fewer_choices_refine_and_more_do_not() {
    let free = counter("choose $x in N with true do n := $x");
    let one = counter("n := (n + 1) mod 4");
    assert_eq!(report(&free, &one, None).verdict, Verdict::Refines);
    let refutation = refuted(report(&one, &free, None));
    assert_eq!((refutation.segments.len(), refutation.runs[1].steps.len()), (0, 1));
    let Ended::Unmatched { tried, .. } = refutation.ended else { panic!() };
    assert_eq!(tried[0].parts[0].text, "abstract.n = concrete.n");
    let values: Vec<String> = tried[0].parts[0].values.iter().map(|(name, value)| format!("{name} {value}")).collect();
    assert_eq!(values, ["abstract.n 1", "concrete.n 2"]);
}

#[test]
fn two_steps_for_one() {
    let one = counter("n := (n + 2) mod 4");
    let two = counter("n := (n + 1) mod 4");
    refuted(report(&one, &two, None));
    let longer = "same n; diagrams 1:1..2;";
    assert_eq!(report(&one, &two, Some(longer)).verdict, Verdict::Refines);
    let segment = "same n; segment concrete.n mod 2 = 0;";
    let found = report(&one, &two, Some(segment));
    assert_eq!(found.verdict, Verdict::Refines);
    assert_eq!(found.diagrams.into_iter().collect::<Vec<_>>(), [((1, 2), 2)]);
    // A step of the concrete machine is two of the abstract one.
    assert_eq!(report(&two, &one, Some("same n; diagrams 2:1;")).verdict, Verdict::Refines);
}

#[test]
fn waiting_for_ever_is_no_refinement() {
    let signature = "domain N subsetof Integer controlled n: N controlled hidden: Boolean";
    let with = |rule: &str| {
        let init = "function n = 0 function hidden = false";
        machine(signature, &format!("domain N = {{0:3}}\nmain rule r_Main = {rule}"), init)
    };
    let one = counter("n := (n + 1) mod 4");
    let slow = with("if hidden then par n := (n + 1) mod 4 hidden := false endpar else hidden := true endif");
    assert_eq!(report(&one, &slow, None).verdict, Verdict::Refines);
    let stuck = with("if hidden and n < 2 then par n := n + 1 hidden := false endpar else hidden := not hidden endif");
    let refutation = refuted(report(&one, &stuck, None));
    assert!(matches!(refutation.ended, Ended::Waits(_)), "{:?}", refutation.ended);
    // What stops where the abstract machine goes on does not refine it either.
    let stops = counter("if n < 2 then n := n + 1 endif");
    let refutation = refuted(report(&one, &stops, None));
    assert!(matches!(refutation.ended, Ended::Waits(2)), "{:?}", refutation.ended);
}

#[test]
fn what_is_said_of_fairness_is_about_the_concrete_machine() {
    let one = counter("n := (n + 1) mod 4");
    let lamp = lamp("if pressed then on := not on endif");
    let faults = |programs: [&Arc<Program>; 2], text: &str| {
        let faulty = Coupling::new(programs, Some(SourceFile::new("c.refine", text)), &machine::Limits::default());
        faulty.expect_err("a fault").faults[0].message.clone()
    };
    let both = "`allow waiting` takes for granted that nothing waits for ever, whether or not that is fair";
    assert_eq!(faults([&one, &one], "same n; fair concrete.n = 0; allow waiting;"), both);
    let side = "fairness is said by the concrete machine's state and inputs alone";
    assert_eq!(faults([&one, &one], "same n; fair abstract.n = 0;"), side);
    assert_eq!(faults([&one, &one], "same n; fair true;"), "this looks at nothing of the concrete machine");
    assert!(faults([&one, &one], "same n; fair concrete.m = 0;").contains("concrete.m"));
    // An input that is true again and again has two values, one of which is enough.
    let fair = "same on; fair concrete.pressed;";
    assert_eq!(report(&lamp, &lamp, Some(fair)).verdict, Verdict::Refines);
    // What is never true, or true in a step behind which the other condition is true no more.
    let (always, once) = (self::lamp("on := true"), self::lamp("if pressed then on := true endif"));
    for none in [
        "same on; fair concrete.on and not concrete.on;",
        "same on; fair not concrete.on; fair concrete.pressed and not concrete.on;",
    ] {
        assert_eq!(report(&always, &once, Some(none)).verdict, Verdict::Vacuous(Vacuous::NoFairRun), "{none}");
        // What refines whatever is fair rests on nothing.
        let found = report(&once, &once, Some(none));
        assert_eq!((found.verdict, found.assumed), (Verdict::Refines, Vec::new()), "{none}");
    }
}

/// A wait that the variant does not allow is told with its values.
#[test]
fn a_variant_that_does_not_decrease_is_told() {
    let one = counter("n := (n + 1) mod 4");
    let signature = "domain N subsetof Integer controlled n: N controlled left: N";
    let slow = machine(
        signature,
        "domain N = {0:3} main rule r_Main =
            if left = 0 then par n := (n + 1) mod 4 left := 2 endpar else left := left - 1 endif",
        "function n = 0 function left = 0",
    );
    assert_eq!(report(&one, &slow, Some("same n; variant concrete.left;")).verdict, Verdict::Refines);
    let refutation = refuted(report(&one, &slow, Some("same n; variant 3 - concrete.left;")));
    let Ended::Unmatched { tried, .. } = refutation.ended else { panic!() };
    let part = tried.iter().flat_map(|tried| &tried.parts).find(|part| part.text.starts_with("variant"));
    let part = part.expect("the variant is told");
    assert_eq!(part.text, "variant 3 - concrete.left");
    assert_eq!(part.trouble.as_deref(), Some("is negative or does not decrease"));
    let values: Vec<String> = part.values.iter().map(|(when, value)| format!("{when} {value}")).collect();
    assert_eq!(values, ["before 1", "after 2"]);
}

/// A door with this rule, and what its model says of runs.
fn door(rule: &str, said: &str) -> Arc<Program> {
    let text = format!(
        "asm M\nimport StandardLibrary\nimport CTLLibrary\nsignature:\nmonitored arrived: Boolean\ncontrolled open: Boolean\n\
         definitions:\n{said}\nmain rule r_Main = {rule}\ndefault init s0:\nfunction open = false\n"
    );
    program("M", &text)
}

/// What must happen comes along by the concrete model's own words, whose formulas are about fair runs; not by those of the coupling.
#[test]
fn what_must_happen_comes_along_to_fair_runs() {
    let one = door("open := not open", "CTLSPEC ag(af(open))");
    let form = |said: &str, coupling: &str| {
        let found = report(&one, &door("if arrived then open := not open endif", said), Some(coupling));
        assert_eq!(found.verdict, Verdict::Refines);
        found.properties[0].form.clone()
    };
    assert_eq!(form("JUSTICE arrived", "same open;").as_deref(), Ok("ag(af(open))"));
    assert!(form("", "same open; fair concrete.arrived;").is_err());
    assert!(form("JUSTICE open", "same open; fair concrete.arrived;").is_err());
}

/// `JUSTICE` of the concrete model counts without a word in the coupling, that of the abstract one does not.
#[test]
fn justice_of_the_concrete_model_is_fairness() {
    let (always, sensed) = ("open := not open", "if arrived then open := not open endif");
    let by_input = "JUSTICE arrived";
    let verdict = |one: &Arc<Program>, other: &Arc<Program>| report(one, other, Some("same open;"));
    let one = door(always, "");
    refuted(verdict(&one, &door(sensed, "")));
    let just = verdict(&one, &door(sensed, by_input));
    assert_eq!(just.verdict, Verdict::Refines);
    assert_eq!(just.assumed.iter().map(|assumed| &*assumed.name).collect::<Vec<_>>(), ["JUSTICE at line 8"]);
    refuted(verdict(&door(always, by_input), &door(sensed, "")));
    // A condition on states, of which the round keeps one.
    assert_eq!(
        verdict(&one, &door("if arrived or open then open := not open endif", "JUSTICE open")).verdict,
        Verdict::Refines
    );
    refuted(verdict(&one, &door(sensed, "JUSTICE not open")));
    // What waits rests on it, and what nothing matches does not.
    let assumed = |rule: &str| {
        let found = verdict(&one, &door(rule, "JUSTICE not open"));
        let assumed = found.assumed.len();
        (matches!(refuted(found).ended, Ended::Waits(_)), assumed)
    };
    assert_eq!([assumed(sensed), assumed("if arrived then open := undef endif")], [(true, 1), (false, 0)]);
}

pub fn lamp(rule: &str) -> Arc<Program> {
    let signature = "monitored pressed: Boolean controlled on: Boolean";
    machine(signature, &format!("main rule r_Main = {rule}"), "function on = false")
}

#[test]
fn an_input_may_not_be_ignored() {
    let one = lamp("if pressed then on := not on endif");
    let same = lamp("if not pressed then skip else on := not on endif");
    assert_eq!(report(&one, &same, None).verdict, Verdict::Refines);
    let deaf = lamp("on := not on");
    let refutation = refuted(report(&one, &deaf, None));
    let Ended::Unmatched { inputs, .. } = refutation.ended else { panic!() };
    assert_eq!(inputs, [("pressed".to_string(), "false".to_string())]);
    // The other way round the abstract machine does what it wants anyway, and the concrete one only when asked.
    refuted(report(&deaf, &one, None));
    let free = "same on; free abstract.pressed;";
    assert_eq!(report(&one, &deaf, Some(free)).verdict, Verdict::Refines);
}

#[test]
fn inputs_may_come_from_the_concrete_state() {
    let one = lamp("if pressed then on := not on endif");
    let button = machine(
        "controlled held: Boolean controlled on: Boolean",
        "main rule r_Main = par held := not held if held then on := not on endif endpar",
        "function on = false function held = false",
    );
    let coupling = "same on; input abstract.pressed = concrete.held;";
    assert_eq!(report(&one, &button, Some(coupling)).verdict, Verdict::Refines);
    refuted(report(&one, &button, Some("same on; input abstract.pressed = not concrete.held;")));
}

#[test]
fn a_fault_of_the_concrete_machine_is_the_verdict() {
    let one = counter("n := (n + 1) mod 4");
    let clashes = counter("if n = 2 then par n := 3 n := 1 endpar else n := n + 1 endif");
    let refutation = refuted(report(&one, &clashes, None));
    assert_eq!(refutation.ended, Ended::Fault);
    assert_eq!((refutation.runs[1].steps.len(), refutation.segments.len()), (3, 2));
    assert!(refutation.runs[1].steps[2].fault.is_some());
}

#[test]
fn terms_over_both() {
    let one = counter("n := (n + 1) mod 4");
    let flags = machine(
        "enum domain Bit = {LOW | HIGH} domain Place subsetof Integer controlled bit: Place -> Bit",
        "domain Place = {0:1}
         main rule r_Main = par
             bit(0) := if bit(0) = LOW then HIGH else LOW endif
             if bit(0) = HIGH then bit(1) := if bit(1) = LOW then HIGH else LOW endif endif
         endpar",
        "function bit($p in Place) = LOW",
    );
    let coupling = "couple abstract.n = (if concrete.bit(0) = HIGH then 1 else 0 endif)
                        + (if concrete.bit(1) = HIGH then 2 else 0 endif);";
    let found = report(&one, &flags, Some(coupling));
    assert_eq!(found.verdict, Verdict::Refines);
    let every = "couple (forall $p in Place with concrete.bit($p) = LOW) implies abstract.n = 0;";
    refuted(report(&one, &flags, Some("couple abstract.n = 0 iff concrete.bit(0) = LOW; diagrams 1:1;")));
    // It says so little that waiting would do.
    assert_eq!(report(&one, &flags, Some(every)).verdict, Verdict::Refines);
}

#[test]
fn a_question_that_says_nothing() {
    let one = counter("n := (n + 1) mod 4");
    let idle = counter("skip");
    assert_eq!(report(&idle, &idle, None).verdict, Verdict::Vacuous(Vacuous::NoStep));
    let late = machine(COUNTER, "domain N = {0:3}\nmain rule r_Main = n := (n + 1) mod 4", "function n = 1");
    assert!(matches!(report(&one, &late, None).verdict, Verdict::Vacuous(Vacuous::NoInitialPair(_))));
    let total = "couple abstract.n >= 0 and concrete.n >= 0;";
    assert_eq!(report(&one, &one, Some(total)).verdict, Verdict::Vacuous(Vacuous::Total));
    // Many states change nothing of that, whether or not the game meets all pairs.
    let large = |last: u32, rule: &str| {
        let signature = "domain L subsetof Integer controlled n: L";
        machine(signature, &format!("domain L = {{0:{last}}}\nmain rule r_Main = {rule}"), "function n = 0")
    };
    let (any, round) = (large(7, "choose $n in L with true do n := $n"), large(899, "n := (n + 1) mod 900"));
    assert_eq!(report(&any, &round, Some(total)).verdict, Verdict::Vacuous(Vacuous::Total));
    let eight = large(7, "n := (n + 1) mod 8");
    assert_eq!(report(&eight, &round, Some(total)).verdict, Verdict::Vacuous(Vacuous::Total));
    assert_ne!(
        report(&any, &round, Some("couple abstract.n = concrete.n mod 8;")).verdict,
        Verdict::Vacuous(Vacuous::Total)
    );
}

/// A step that cannot be made is a refutation, whatever the coupling says; and of a few values of an input nothing follows for all.
#[test]
fn what_says_nothing_of_some_values_hides_no_fault() {
    let signature = "domain N subsetof Integer controlled x: N controlled warned: Boolean monitored go: Boolean";
    let with =
        |rule: &str| machine(signature, &format!("domain N = {{0:1}} main rule r_Main = {rule}"), "function x = 0");
    let (one, faulty) =
        (with("if go then x := 1 endif"), with("par if go then x := 1 endif if warned then skip endif endpar"));
    let bounded = |other: &Arc<Program>| {
        let text = Some(SourceFile::new("c.refine", "same x;"));
        let coupling = Coupling::new([&one, other], text, &machine::Limits::default()).expect("no faults");
        let mut options = Options::default();
        for (side, program) in [&one, other].into_iter().enumerate() {
            let go = program.find_function("go", 0).expect("an input");
            options.extents[side].bounds.insert(go, vec![machine::Value::Boolean(false)]);
        }
        refine(&coupling, &options, &mut |_| true).expect("it begins").verdict
    };
    assert!(matches!(bounded(&faulty), Verdict::DoesNot(_)), "{:?}", bounded(&faulty));
    assert!(matches!(bounded(&one), Verdict::Unknown(_)), "{:?}", bounded(&one));
}

/// The verdict where inputs have these values, by side; all of their domains where nothing is said.
pub fn bounded(programs: [&Arc<Program>; 2], text: &str, bounds: [&[(&str, &[machine::Value])]; 2]) -> Verdict {
    let file = Some(SourceFile::new("c.refine", text));
    let coupling = Coupling::new(programs, file, &machine::Limits::default()).expect("no faults");
    let mut options = Options::default();
    for (side, bounds) in bounds.into_iter().enumerate() {
        for (name, values) in bounds {
            let input = programs[side].find_function(name, 0).expect("an input");
            options.extents[side].bounds.insert(input, values.to_vec());
        }
    }
    refine(&coupling, &options, &mut |_| true).expect("it begins").verdict
}

const LEVEL: &str =
    "domain Level subsetof Integer monitored level: Level controlled last: Level controlled odd: Boolean";

fn levels(rule: &str) -> Arc<Program> {
    let domain = "domain Level = {0:3}";
    machine(LEVEL, &format!("{domain} main rule r_Main = {rule}"), "function last = 0 function odd = false")
}

/// A run that nothing matches refutes the refinement, unless it was the answers that were left out.
#[test]
fn bounds_hide_a_refutation_only_where_they_leave_out_answers() {
    let value = machine::Value::Integer;
    let low: &[machine::Value] = &[value(0), value(1)];
    let is_refuted = |verdict: Verdict| match verdict {
        Verdict::DoesNot(_) => true,
        Verdict::Unknown(why) => {
            assert!(matches!(why[..], [refine::Why::Bounded(refine::ABSTRACT, _)]), "{why:?}");
            false
        }
        other => panic!("{other:?}"),
    };
    let one = levels("last := level");
    let wrong = levels("last := (level + 1) mod 4");
    // Values of the concrete machine's input that are left out are runs that nobody looked at.
    assert!(is_refuted(bounded([&one, &wrong], "same last;", [&[], &[("level", low)]])));
    assert!(is_refuted(bounded([&one, &wrong], "same last;", [&[("level", low)], &[("level", low)]])));
    // The abstract machine never had 2 or 3, with which it would have an answer to them; but it had those to 0 and 1.
    assert!(is_refuted(bounded([&one, &wrong], "same last;", [&[("level", low)], &[]])));
    assert!(!is_refuted(bounded([&one, &one], "same last;", [&[("level", low)], &[]])));
    let at_three = levels("last := if level = 3 then 0 else level endif");
    assert!(!is_refuted(bounded([&one, &at_three], "same last;", [&[("level", low)], &[]])));
    let all: &[machine::Value] = &[value(0), value(1), value(2), value(3)];
    assert!(is_refuted(bounded([&one, &at_three], "same last;", [&[("level", all)], &[]])));
    // A free input might have had another value wherever the machine looks at it, and nowhere else.
    let free = "same last, odd; free abstract.level;";
    let counts = levels("last := 2");
    assert!(!is_refuted(bounded([&one, &counts], free, [&[("level", low)], &[]])));
    let blinks = levels("par last := 1 odd := not odd endpar");
    assert!(!is_refuted(bounded([&one, &blinks], free, [&[("level", low)], &[]])));
    let once = levels("last := if last = 3 then level else last + 1 endif");
    let late = "if last = 3 then last := 1 elseif last = 2 then choose $x in Level with $x = 3 or $x = BACK do last := $x else last := last + 1 endif";
    assert!(is_refuted(bounded([&once, &levels(&late.replace("BACK", "0"))], free, [&[("level", low)], &[]])));
    assert_eq!(bounded([&once, &levels(&late.replace("BACK", "3"))], free, [&[("level", low)], &[]]), Verdict::Refines);
    // So it is of a step that cannot be made.
    let faulty = levels("choose $x in Level with $x < 2 do last := if $x = 0 then 1 else last + 4 endif");
    assert!(is_refuted(bounded([&one, &faulty], free, [&[("level", low)], &[]])));
    // A term is what it is, whether or not that was tried.
    let term = "same last, odd; input abstract.level = concrete.last;";
    let stays = levels("last := if last = 0 then level else last endif");
    assert!(!is_refuted(bounded([&one, &levels("last := 1")], term, [&[("level", &[value(3)])], &[]])));
    assert!(is_refuted(bounded([&one, &levels("last := 1")], term, [&[("level", low)], &[]])));
    assert!(is_refuted(bounded(
        [&one, &stays],
        "same last; input abstract.level = 3 - concrete.level;",
        [&[("level", all)], &[("level", low)],]
    )));
}

/// So it is of initial states.
#[test]
fn bounds_may_leave_out_initial_states() {
    let begun = |level: &str| {
        let rule = "domain Level = {0:3} main rule r_Main = odd := not odd";
        machine(LEVEL, rule, &format!("function odd = false function last = {level}"))
    };
    let value = machine::Value::Integer;
    let free = "same last, odd; free abstract.level;";
    let (one, other) = (begun("level"), begun("3"));
    assert_eq!(bounded([&one, &other], free, [&[], &[]]), Verdict::Refines);
    let input = one.find_function("level", 0).expect("an input");
    let unknown = Verdict::Unknown(vec![refine::Why::Bounded(refine::ABSTRACT, input)]);
    assert_eq!(bounded([&one, &other], free, [&[("level", &[value(0)])], &[]]), unknown);
    let wrong = begun("if level = 0 then 0 else 1 endif");
    let verdict = bounded([&wrong, &other], free, [&[("level", &[value(0), value(1)])], &[]]);
    assert_eq!(verdict, Verdict::Unknown(vec![refine::Why::Bounded(refine::ABSTRACT, input)]));
    let verdict = bounded([&wrong, &other], free, [&[], &[]]);
    assert!(matches!(verdict, Verdict::Vacuous(Vacuous::NoInitialPair(_))), "{verdict:?}");
    // Where both have the input, that of the concrete machine says what it is.
    let verdict = bounded([&one, &other], "same last, odd;", [&[("level", &[value(0)])], &[]]);
    assert!(matches!(verdict, Verdict::Vacuous(Vacuous::NoInitialPair(_))), "{verdict:?}");
}

/// Enumerations with the same literals in another order are the same; what differs is told.
#[test]
fn literals_are_compared_by_their_names() {
    let answers = |literals: &str| {
        let signature = format!("enum domain Answer = {{{literals}}} monitored answer: Answer controlled last: Answer");
        machine(&signature, "main rule r_Main = last := answer", "function last = YES")
    };
    let one = answers("YES | NO");
    assert_eq!(report(&one, &answers("NO | YES"), None).verdict, Verdict::Refines);
    let text = Some(SourceFile::new("c.refine", "same last;"));
    let Err(faulty) = Coupling::new([&one, &answers("NO | YES | SKIP")], text, &machine::Limits::default()) else {
        panic!("the inputs have other domains");
    };
    let messages: Vec<&str> = faulty.faults.iter().map(|fault| &*fault.message).collect();
    let expected = "the abstract machine's input answer is in Answer {NO | YES}, and in the concrete machine in \
                    Answer {NO | SKIP | YES}";
    assert_eq!(messages, [expected]);
}

/// An assumption that is undef in a state leaves the state out, as in a verification.
#[test]
fn what_is_undef_is_not_assumed() {
    let signature = "domain N subsetof Integer controlled n: N controlled m: N";
    let text = |rule: &str, invar: &str| {
        machine(signature, &format!("domain N = {{0:3}} {invar} main rule r_Main = {rule}"), "function n = 0")
    };
    let one = text("choose $x in N with true do n := $x", "INVAR n = 0 or m = 0");
    let other = text("choose $x in {0, 1} with true do n := $x", "");
    assert!(matches!(report(&one, &other, Some("same n;")).verdict, Verdict::DoesNot(_)));
    let assumed = text("choose $x in {0, 1} with true do n := $x", "INVAR n = 0 or m = 0");
    let verdict = report(&one, &assumed, Some("same n;")).verdict;
    assert!(!matches!(verdict, Verdict::DoesNot(_)), "{verdict:?}");
}

/// Of several conditions those are told that are needed; of two that are enough each, that of the model.
#[test]
fn only_the_fairness_that_is_needed_is_assumed() {
    let one = door("open := not open", "");
    let assumed = |said: &str, coupling: &str| -> Vec<String> {
        let found = report(&one, &door("if arrived then open := not open endif", said), Some(coupling));
        assert_eq!(found.verdict, Verdict::Refines, "{coupling}");
        found.assumed.into_iter().map(|assumed| assumed.name).collect()
    };
    let arrived = "again and again: concrete.arrived";
    assert_eq!(assumed("", "same open; fair concrete.open or not concrete.open; fair concrete.arrived;"), [arrived]);
    assert_eq!(assumed("JUSTICE open", "same open; fair concrete.arrived;"), [arrived]);
    // In whatever order they stand: what no run meets is not what it rests on.
    assert_eq!(assumed("", "same open; fair concrete.arrived; fair concrete.open and not concrete.open;"), [arrived]);
    let two = "fair concrete.arrived and concrete.open; fair concrete.arrived and not concrete.open;";
    assert_eq!(assumed("", &format!("same open; {two}")), ["again and again: concrete.arrived and not concrete.open"]);
}

#[test]
fn inputs_of_initial_states_are_those_of_one_environment() {
    let signature = "domain N subsetof Integer monitored given: N monitored other: N controlled n: N";
    let with = |init: &str| {
        machine(signature, "domain N = {0:3}\nmain rule r_Main = n := (n + 1) mod 4", &format!("function n = {init}"))
    };
    assert_eq!(report(&with("given"), &with("given"), None).verdict, Verdict::Refines);
    assert_eq!(report(&with("given"), &with("(given + 4) mod 4"), None).verdict, Verdict::Refines);
    // Some initial states of the concrete machine have no match: those with other inputs.
    refuted(report(&with("given"), &with("other"), None));
    refuted(report(&with("given"), &with("1"), None));
    assert_eq!(report(&with("given"), &with("1"), Some("same n; free abstract.given;")).verdict, Verdict::Refines);
}

#[test]
fn each_input_that_is_not_looked_at_has_every_value() {
    let signature = "monitored a: Boolean monitored b: Boolean controlled on: Boolean";
    let with = |rule: &str| machine(signature, &format!("main rule r_Main = {rule}"), "function on = false");
    let both = with("if a and b then on := true endif");
    let either = with("choose $x in Boolean with ($x or a or b) do on := $x or on");
    let one = with("if a then on := true endif");
    let never = with("par on := on and a if a and b and on then on := on endif endpar");
    refuted(report(&both, &one, None));
    assert_eq!(report(&either, &with("on := true"), None).verdict, Verdict::Refines);
    assert!(!matches!(report(&both, &never, None).verdict, Verdict::Refines));
}

#[test]
fn in_a_long_diagram_an_input_has_a_value_that_it_had_in_it() {
    let one = lamp("if pressed then on := not on endif");
    let late = machine(
        "monitored pressed: Boolean controlled on: Boolean controlled heard: Boolean controlled busy: Boolean",
        "main rule r_Main = if busy then par busy := false if heard then on := not on endif endpar
                            else par busy := true heard := pressed endpar endif",
        "function on = false function heard = false function busy = false",
    );
    assert_eq!(report(&one, &late, Some("same on; segment not concrete.busy;")).verdict, Verdict::Refines);
    // It looks at nothing where it does something.
    refuted(report(&one, &late, Some("same on; diagrams 0..1:1;")));
}

#[test]
fn limits_leave_it_open_and_do_not_hide_a_refutation() {
    let endless =
        |rule: &str| machine("controlled n: Integer", &format!("main rule r_Main = {rule}"), "function n = 0");
    let check = |one: &Arc<Program>, other: &Arc<Program>| {
        let coupling = Coupling::new([one, other], None, &machine::Limits::default()).expect("a coupling");
        refine(&coupling, &Options { max_pairs: 10, ..Options::default() }, &mut |_| true).expect("it begins").verdict
    };
    let one = endless("n := n + 1");
    assert_eq!(check(&one, &one), Verdict::Unknown(vec![refine::Why::Pairs(10)]));
    assert!(matches!(check(&one, &endless("if n = 4 then n := 0 else n := n + 1 endif")), Verdict::DoesNot(_)));
    let input = machine("monitored x: Integer controlled n: Integer", "main rule r_Main = n := x", "function n = 0");
    let found = report(&input, &input, None);
    assert!(
        matches!(&found.verdict, Verdict::Unknown(why) if matches!(why[..], [refine::Why::Unbounded(..)])),
        "{found:?}"
    );
}

#[test]
fn functions_over_infinite_domains_and_other_enumerations() {
    let with = |literals: &str, rule: &str| {
        machine(
            &format!(
                "enum domain Mode = {{{literals}}} controlled mode: Mode controlled seen: Integer -> Mode controlled n: Integer"
            ),
            &format!("main rule r_Main = par {rule} n := (n + 1) mod 3 seen(n) := mode endpar"),
            "function mode = IDLE function n = 0",
        )
    };
    let one = with("IDLE | BUSY", "mode := if mode = IDLE then BUSY else IDLE endif");
    let other = with("BUSY | IDLE | GONE", "mode := if mode = IDLE then BUSY else IDLE endif");
    assert_eq!(report(&one, &one, Some("same seen, mode;")).verdict, Verdict::Refines);
    assert_eq!(report(&one, &other, Some("same seen, mode;")).verdict, Verdict::Refines);
    let gone = with("BUSY | IDLE | GONE", "mode := if mode = IDLE then BUSY else GONE endif");
    refuted(report(&one, &gone, Some("couple abstract.mode = concrete.mode;")));
}

#[test]
fn an_input_may_be_derived_from_several() {
    let one = lamp("if pressed then on := not on endif");
    let three = |rule: &str| {
        machine(
            "domain Key subsetof Integer monitored key: Key -> Boolean derived all: Boolean controlled on: Boolean",
            &format!("domain Key = {{0:2}} function all = (forall $k in Key with key($k)) main rule r_Main = {rule}"),
            "function on = false",
        )
    };
    let coupling = Some("same on; input abstract.pressed = concrete.all;");
    assert_eq!(report(&one, &three("if all then on := not on endif"), coupling).verdict, Verdict::Refines);
    assert_eq!(report(&one, &three("if key(0) and all then on := not on endif"), coupling).verdict, Verdict::Refines);
    refuted(report(&one, &three("if key(0) and key(1) then on := not on endif"), coupling));
    refuted(report(&one, &three("on := not on"), coupling));
}

#[test]
fn a_search_that_nobody_waits_for_ends() {
    let free = counter("choose $x in N with true do n := $x");
    let text = SourceFile::new("c.refine", "same n; diagrams 1:1..40;");
    let coupling = Coupling::new([&free, &free], Some(text), &machine::Limits::default()).expect("a coupling");
    let mut options = Options::default();
    let interrupt = machine::Interrupt::new();
    options.extents.iter_mut().for_each(|extent| extent.interrupt = interrupt.clone());
    let mut watch = |_: &refine::Progress| {
        interrupt.raise(machine::Cause::Asked);
        true
    };
    let found = refine(&coupling, &options, &mut watch).expect("it begins");
    assert_eq!(found.verdict, Verdict::Unknown(vec![refine::Why::Stopped(machine::Cause::Asked)]));
}

/// The states have no end, so only a look in between tells.
#[test]
fn what_is_lost_is_told_though_the_search_has_no_end() {
    let one = machine("controlled x: Integer", "main rule r_Main = x := x + 1", "function x = 0");
    let other = machine(
        "monitored go: Boolean controlled x: Integer",
        "main rule r_Main = if go then x := x + 1 else skip endif",
        "function x = 0",
    );
    let refutation = refuted(report(&one, &other, None));
    assert!(matches!(refutation.ended, Ended::Waits(_)), "{refutation:?}");
    let wrong = machine(
        "controlled x: Integer",
        "main rule r_Main = x := if x = 700 then 0 else x + 1 endif",
        "function x = 0",
    );
    let refutation = refuted(report(&one, &wrong, None));
    assert_eq!(refutation.runs[CONCRETE].steps.len(), 701);
}
