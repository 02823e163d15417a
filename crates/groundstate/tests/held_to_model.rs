//! A recording with decisions is held to the model that is given: to its own main rule, to when that lets machines decide, and to what it
//! keeps of their decisions. Half of the model or of the decisions is missing, changed or out of order, and nothing of it conforms.

use groundstate::Loaded;
use groundstate::conform::{Decision, Recording, Refusal, Verdict};
use groundstate::job::{self, Cancel, ConformRequest, Events, NoTail, NotConformed};
use machine::Limits;

use super::machines::{CONTROL, GAUGE, TANK, edited, model, recorded};

/// What comes of a comparison, in words. All instants are those of ticks, as if tasks had been interrupted: that suits real time alone.
fn fate(loaded: Loaded, mut recording: Recording, by_order: bool) -> String {
    if by_order {
        recording.pace = "real".to_string();
    }
    let events = Events::<NoTail>::Whole(recording);
    let request = ConformRequest { loaded, events, limits: Limits::default(), by_order };
    match job::conform(request, Cancel::new()).expect("a thread").finish().expect("no panic") {
        Ok(conformed) => match conformed.verdict {
            Verdict::Conforms { .. } => "conforms".to_string(),
            Verdict::Parts(parted) => format!("parts: {} {}", parted.task, parted.reason.unwrap_or_default()),
            Verdict::Unknown { reason, .. } => format!("unknown: {reason}"),
        },
        Err(NotConformed::Refused(Refusal::Words(words))) => format!("refused: {words}"),
        Err(NotConformed::Refused(Refusal::Model(_, faults))) => panic!("{faults:?}"),
        Err(_) => unreachable!("it is whole"),
    }
}

/// What comes of the model's own run, tick by tick and by the order of events, if the model's text is another one.
#[track_caller]
fn of_model(from: &str, to: &str) -> [String; 2] {
    let edit = |text: String| {
        assert!(text.contains(from), "{text}");
        text.replace(from, to)
    };
    let (loaded, good) = (edited(TANK, GAUGE, CONTROL, &edit), recorded(&model(), 1));
    [false, true].map(|by_order| fate(loaded.clone(), good.clone(), by_order))
}

#[track_caller]
fn other_model(from: &str, to: &str, expect: [&str; 2]) {
    let found = of_model(from, to);
    assert!(found.iter().zip(expect).all(|(found, expect)| found.starts_with(expect)), "{found:#?}");
}

const ALL_STEP: &str = "forall $c in Scheduler with true do program($c)";
const TICKS: &str = "clock := clock + 1";

#[test]
fn the_main_rule_is_the_models_own() {
    assert_eq!(of_model("asm Tank", "asm Tank"), ["conforms", "conforms"]);
    let none = "refused: its main rule r_Main has no `forall $c in Scheduler` in which its tasks step";
    other_model(ALL_STEP, "skip", ["parts: gauge ", none]);
    other_model(ALL_STEP, "program(gauge)", ["parts: control ", none]);
    let several = "refused: its main rule r_Main lets its tasks step in several places";
    other_model(ALL_STEP, &format!("{ALL_STEP} {ALL_STEP}"), ["conforms", several]);
    let not_control = ALL_STEP.replace("with true", "with $c != control");
    let left_out = "parts: control the model's main rule does not let this component step";
    other_model(ALL_STEP, &not_control, ["parts: control ", left_out]);
    let leads = "parts: gauge a step of the model leads its clock from 0 to";
    other_model(TICKS, "clock := clock + 2", ["parts: ", &format!("{leads} 2")]);
    other_model(TICKS, "skip", ["parts: ", &format!("{leads} 0")]);
    // A step of the one is also one of the other.
    let both = "forall $c in Scheduler with true do par program(gauge) program(control) endpar";
    other_model(ALL_STEP, both, ["conforms", "parts: gauge in the model's step of this task, control "]);
}

/// What only counts may stand beside the tasks' steps, and does not matter.
#[test]
fn what_counts_beside_the_steps_is_no_difference() {
    let counted = |text: String| {
        text.replace("\tout valve", "\tcontrolled counted: Integer\n\tout valve")
            .replace("\tmain rule r_Main =\n\t\tpar", "\tmain rule r_Main =\n\t\tpar\n\t\t\tr_count[]")
            .replace(
                "\tmain rule r_Main",
                "\trule r_count = counted := counted + clock + control_highest\n\n\tmain rule r_Main",
            )
            .replace("function valve = false", "function valve = false\n\tfunction counted = 0")
    };
    for by_order in [false, true] {
        let loaded = edited(TANK, GAUGE, CONTROL, &counted);
        assert!(loaded.program.find_function("counted", 0).is_some());
        assert_eq!(fate(loaded, recorded(&model(), 1), by_order), "conforms");
    }
}

/// Machines decide where their elaborations end, and nowhere else, and nothing else depends on it.
#[test]
fn the_model_lets_machines_decide() {
    let without = ["parts: gauge the model ends gauge_measure without what is computed at its end"; 2];
    other_model("agent Scheduler: r_computingTask[]", "agent Scheduler: r_controlTask[]", without);
    let at_end = "if tElapsed(self) then r_endOfElaboration[scheduler_currentPhase(self)] endif";
    other_model(at_end, &at_end.replace("if tElapsed", "if not tElapsed"), ["parts: gauge the model ", without[0]]);
    let always = "if true then r_endOfElaboration[scheduler_currentPhase(self)] endif";
    let slow = "parts: control the model computes what comes at the end of control_decide before it ends";
    let slower = |text: String| text.replace("elaborate decide", "elaborate decide 3 ms");
    let always = |text: String| text.replace(at_end, always);
    let loaded = [&|text| text as String, &always as &dyn Fn(String) -> String]
        .map(|edit| edited(&slower(TANK.to_string()), GAUGE, CONTROL, edit));
    let good = recorded(&loaded[0], 1);
    for by_order in [false, true] {
        assert_eq!(fate(loaded[0].clone(), good.clone(), by_order), "conforms");
    }
    assert_eq!(fate(loaded[1].clone(), good, false), slow);
    other_model(
        "case control_decide: r_end_control_decide[]",
        "otherwise skip",
        ["parts: control decided valve = "; 2],
    );
    let gauges = "case gauge_measure: r_end_control_decide[]";
    other_model("case gauge_measure: r_end_gauge_measure[]", gauges, ["parts: gauge decided levels = "; 2]);
    let entangled = ["refused: what tasks do depends on clock, which the end of an elaboration changes"; 2];
    other_model("r_control_Main[]", "par r_control_Main[] clock := clock + 1 endpar", entangled);
    let reads = ["refused: what is computed at the end of an elaboration depends on clock, which the tasks change"; 2];
    other_model("gauge_levels := level * 10", "gauge_levels := level * clock", reads);
    let steers = ["refused: what tasks do depends on valve, which the end of an elaboration changes"; 2];
    other_model(TICKS, "clock := if valve then clock + 1 else clock + 1 endif", steers);
}

#[test]
fn the_model_keeps_what_machines_decide() {
    other_model(
        "function control_highest = 0",
        "function control_highest = 9000",
        ["parts: control decided valve = "; 2],
    );
    let lost =
        "parts: gauge decided as its machine does, but in the model levels_value(1), the next datum of levels, is ";
    for other in
        ["levels_value(sb_written(levels) + 2) := gauge_levels", "levels_value(sb_written(levels) + 1) := 7", "skip"]
    {
        other_model("levels_value(sb_written(levels) + 1) := gauge_levels", other, [lost; 2]);
    }
}

/// What a component without a machine computes is kept, too, and a recording has no decisions of it.
#[test]
fn who_has_no_machine_decides_nothing() {
    let chart =
        TANK.replace("elaborate decide by Control", "elaborate decide").replace("\tactuator valve : Boolean\n", "");
    let chart = chart.replace("\tcontrol -> valve\n", "");
    let no_control = edited(&chart, GAUGE, CONTROL, &|text| text);
    let no_gauge = TANK.replace("elaborate measure by Gauge", "elaborate measure");
    let no_gauge = no_gauge.replace("\tsensor level : Integer\n", "").replace("\tlevel -> gauge\n", "");
    let without = |track: usize| {
        let mut less = recorded(&model(), 1);
        less.tracks[track].decisions.clear();
        less
    };
    let kept = edited(&no_gauge, GAUGE, CONTROL, &|text| text);
    let lost = edited(&no_gauge, GAUGE, CONTROL, &|text| {
        text.replace("levels_value(sb_written(levels) + 1) := gauge_levels", "skip")
    });
    for by_order in [false, true] {
        assert_eq!(fate(no_control.clone(), without(1), by_order), "conforms");
        let parts = "parts: control got levels, and has no machine in the model";
        assert_eq!(fate(no_control.clone(), recorded(&model(), 1), by_order), parts);
        assert_eq!(fate(kept.clone(), without(0), by_order), "conforms");
        let refused =
            "refused: the model loses what gauge computes: levels_value(1), the next datum of levels, is undef";
        assert_eq!(fate(lost.clone(), without(0), by_order), refused);
    }
}

/// A decision too many, or recorded outside its elaboration.
#[test]
fn each_elaboration_has_a_decision_of_its_own() {
    let good = recorded(&model(), 1);
    let found = |change: &dyn Fn(&mut Vec<Decision>), expect: &str| {
        for by_order in [false, true] {
            let mut wrong = good.clone();
            change(&mut wrong.tracks[0].decisions);
            let found = fate(model(), wrong, by_order);
            assert!(found.starts_with(expect), "{found}");
        }
    };
    let double = |decisions: &mut Vec<Decision>| {
        let again = decisions[2..4].to_vec();
        decisions.splice(4..4, again);
    };
    found(&double, "parts: gauge decided 3 times, and had begun gauge_measure 2 times");
    let late = |decisions: &mut Vec<Decision>| decisions[0..2].iter_mut().for_each(|one| one.events += 1);
    found(&late, "parts: gauge ended gauge_measure once, but what it decided is recorded never");
    let early = |decisions: &mut Vec<Decision>| {
        decisions[0..2].iter_mut().for_each(|one| (one.events, one.time_ns) = (0, 0));
    };
    found(&early, "parts: gauge decided once, and had begun gauge_measure never");
    found(
        &|decisions| _ = decisions.drain(2..4),
        "parts: gauge ended gauge_measure 2 times, but what it decided is recorded once",
    );
}
