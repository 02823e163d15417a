//! Models built from the charts of systems go in lock-step with the models written by hand: the same locations have the
//! same values in every state, for several durations of the one elaboration whose duration varies.

use std::collections::BTreeMap;
use std::sync::Arc;

use machine::{Closed, Limits, Machine, Show};
use testkit::{EditedDisk, repository};

/// The files on the disk, with the duration of one elaboration changed.
fn disk(elaboration: u32) -> EditedDisk {
    EditedDisk { from: "case vs_elaborate: 120".to_string(), to: format!("case vs_elaborate: {elaboration}") }
}

fn machine(name: &str, elaboration: u32) -> Machine {
    let mut disk = disk(elaboration);
    let path = repository::root().join(format!("examples/visual_servoing/{name}.asm"));
    let root = disk.read(&path).expect("the example is there");
    let loaded = groundstate::load(root, &mut disk).unwrap_or_else(|faulty| panic!("{:#?}", faulty.diagnostics));
    let mut machine = Machine::new(loaded.program, Limits::default());
    machine.start(&mut Closed).unwrap_or_else(|fault| panic!("{fault:?}"));
    machine
}

/// Renames the chart's waiting phase of visual servoing, which is called after the component.
fn named(text: String) -> String {
    text.replace("visual_servoing_wait", "vs_wait")
}

fn state(machine: &Machine) -> BTreeMap<String, String> {
    let program = machine.program();
    let all = machine.locations().into_iter();
    all.map(|(location, value)| (named(location.show(program).to_string()), named(value.show(program).to_string())))
        .collect()
}

/// Makes a step and returns what it changed.
fn step(machine: &mut Machine) -> BTreeMap<String, String> {
    machine.prepare(&mut Closed).unwrap_or_else(|fault| panic!("{fault:?}"));
    let program = Arc::clone(machine.program());
    let changes = machine.changes().into_iter();
    let changes = changes
        .map(|change| {
            (named(change.location.show(&program).to_string()), named(change.after.show(&program).to_string()))
        })
        .collect();
    machine.commit();
    changes
}

fn check(by_hand: &str, built: &str, elaborations: &[u32], steps: u32) {
    for &elaboration in elaborations {
        let (mut first, mut second) = (machine(by_hand, elaboration), machine(built, elaboration));
        assert_eq!(state(&first), state(&second), "{by_hand}, elaboration {elaboration}");
        for number in 0..steps {
            let (one, other) = (step(&mut first), step(&mut second));
            assert_eq!(one, other, "{by_hand}, elaboration {elaboration}, step {number}");
        }
        assert_eq!(state(&first), state(&second), "{by_hand}, elaboration {elaboration}");
    }
}

#[test]
fn the_visual_servoing_robot() {
    // Below the camera's period, as written, and far above.
    check("VisualServoing", "VisionSystem", &[50, 120, 230], 250);
}

#[test]
fn the_complete_controller() {
    check("CompleteController", "ControllerSystem", &[50, 120], 120);
}

/// The committed models are what the charts build to: elaborations are kept, the rest comes from the chart.
#[test]
fn the_charts_are_built() {
    for name in ["VisionSystem", "ControllerSystem"] {
        let folder = repository::root().join("examples/visual_servoing");
        let text = |ending: &str| repository::text(folder.join(format!("{name}.{ending}")));
        let file = syntax::FileId(0);
        let (read, faults) = chart::read(file, &syntax::parse_chart(file, &text("chart")));
        assert_eq!(faults, []);
        let beside = folder.join("Imports.asm").display().to_string();
        let mut disk = disk(120);
        let known = chart::Known::imported(&read, &beside, &mut disk).expect("the imports have no faults");
        assert_eq!(chart::unbuilt(&read, &known), []);
        let built = chart::build(&read, &known, Some(&text("asm"))).expect("it parses");
        assert_eq!(built.text, text("asm"), "{name}");
        assert_eq!(built.to_write, Vec::<String>::new());
    }
}
