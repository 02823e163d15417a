//! Models built from the charts of systems go in lock-step with the models written by hand: the same locations have the
//! same values in every state, for several durations of the one elaboration whose duration varies. What machines of components decide has
//! no part in it, whatever their sensors say.

use std::collections::{BTreeMap, BTreeSet};
use std::sync::Arc;

use machine::{Choice, Environment, Limits, LocationRef, Machine, Show, TimeUnit, Value};
use program::{DomainId, Program};
use testkit::{EditedDisk, repository};

/// The files on the disk, with the duration of one elaboration changed.
fn disk(elaboration: u32) -> EditedDisk {
    EditedDisk { from: "case vs_elaborate: 120".to_string(), to: format!("case vs_elaborate: {elaboration}") }
}

/// Sensors that say now yes, now no.
#[derive(Default)]
struct Sensors(u64);

impl Environment for Sensors {
    fn monitored(&mut self, _: &Program, _: LocationRef<'_>, _: DomainId) -> Result<Value, String> {
        // A linear congruential generator (D. Knuth, TAOCP 2, 3.3.4).
        self.0 = self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        Ok(Value::Boolean(self.0 >> 63 == 1))
    }

    fn choose(&mut self, _: &Program, _: &Choice<'_>) -> Result<usize, String> {
        Err("nothing is chosen".to_string())
    }

    fn time(&mut self, _: TimeUnit) -> Result<i64, String> {
        Err("there is no clock".to_string())
    }
}

fn machine(name: &str, elaboration: u32) -> Machine {
    let mut disk = disk(elaboration);
    let path = repository::root().join(format!("examples/visual_servoing/{name}.asm"));
    let root = disk.read(&path).expect("the example is there");
    let loaded = groundstate::load(root, &mut disk).unwrap_or_else(|faulty| panic!("{:#?}", faulty.diagnostics));
    let mut machine = Machine::new(loaded.program, Limits::default());
    machine.start(&mut Sensors::default()).unwrap_or_else(|fault| panic!("{fault:?}"));
    machine
}

/// Renames the chart's waiting phase of visual servoing, which is called after the component.
fn named(text: String) -> String {
    text.replace("visual_servoing_wait", "vs_wait")
}

/// The names of a model's functions.
fn functions(machine: &Machine) -> BTreeSet<String> {
    machine.program().functions.iter().map(|function| function.name.clone()).collect()
}

/// The values of these functions.
fn state(machine: &Machine, functions: &BTreeSet<String>) -> BTreeMap<String, String> {
    let program = machine.program();
    let is_one = |location: &machine::Location| functions.contains(&program.function(location.function).name);
    let all = machine.locations().into_iter().filter(|(location, _)| is_one(location));
    all.map(|(location, value)| (named(location.show(program).to_string()), named(value.show(program).to_string())))
        .collect()
}

/// Makes a step and returns what it changed of these functions, and whether it changed others.
fn step(
    machine: &mut Machine,
    sensors: &mut Sensors,
    functions: &BTreeSet<String>,
) -> (BTreeMap<String, String>, bool) {
    machine.prepare(sensors).unwrap_or_else(|fault| panic!("{fault:?}"));
    machine.commit();
    let program = Arc::clone(machine.program());
    let is_one = |change: &machine::Change| functions.contains(&program.function(change.location.function).name);
    let (changes, others): (Vec<_>, Vec<_>) = machine.changes().into_iter().partition(is_one);
    let changes = changes
        .into_iter()
        .map(|change| {
            (named(change.location.show(&program).to_string()), named(change.after.show(&program).to_string()))
        })
        .collect();
    (changes, !others.is_empty())
}

/// `decides`: whether machines of the built model decide something meanwhile.
fn check(by_hand: &str, built: &str, elaborations: &[u32], steps: u32, decides: bool) {
    for &elaboration in elaborations {
        let (mut first, mut second) = (machine(by_hand, elaboration), machine(built, elaboration));
        let (functions, mut sensors, mut decided) = (functions(&first), Sensors(u64::from(elaboration) << 32), false);
        let states = |first: &Machine, second: &Machine| {
            assert_eq!(state(first, &functions), state(second, &functions), "{by_hand}, elaboration {elaboration}");
        };
        let mut moved = false;
        states(&first, &second);
        for number in 0..steps {
            let (one, _) = step(&mut first, &mut sensors, &functions);
            let (other, own) = step(&mut second, &mut sensors, &functions);
            assert_eq!(one, other, "{by_hand}, elaboration {elaboration}, step {number}");
            (decided, moved) = (decided | own, moved | !one.is_empty());
        }
        states(&first, &second);
        assert!(moved, "{by_hand}, elaboration {elaboration}");
        assert_eq!(decided, decides, "{built}, elaboration {elaboration}");
    }
}

#[test]
fn the_visual_servoing_robot() {
    // Below the camera's period, as written, and far above.
    check("VisualServoing", "VisionSystem", &[50, 120, 230], 250, false);
}

#[test]
fn the_complete_controller() {
    check("CompleteController", "ControllerSystem", &[50, 120], 250, true);
}

/// The committed models are what the charts build to: elaborations are kept, the rest comes from the chart.
#[test]
fn the_charts_are_built() {
    for name in ["VisionSystem", "ControllerSystem"] {
        let folder = repository::root().join("examples/visual_servoing");
        let text = |ending: &str| repository::text(folder.join(format!("{name}.{ending}")));
        let mut disk = disk(120);
        let root = disk.read(&folder.join(format!("{name}.chart"))).expect("the example is there");
        let chart::Loaded { chart: read, diagnostics, .. } = chart::load(root, &mut disk);
        assert_eq!(diagnostics, []);
        let beside = folder.join("Imports.asm").display().to_string();
        let known = chart::Known::imported(&read, &beside, &mut disk).expect("the imports have no faults");
        assert_eq!(chart::unbuilt(&read, &known), []);
        let built = chart::build(&read, &known, Some(&text("asm"))).expect("it parses");
        assert_eq!(built.text, text("asm"), "{name}");
        assert_eq!(built.to_write, Vec::<String>::new());
    }
}
