//! The models that verify a system behave like the system: from the same initial state and with the system's
//! elaboration times, both agree step by step, up to the quotient. So what is verified of them holds for the system.

use std::collections::BTreeMap;

use groundstate::simulate::read_value;
use machine::{Choice, Environment, Limits, LocationRef, Machine, Show, TimeUnit, Value};
use program::{DomainId, Program};
use testkit::{EditedDisk, repository};

/// The files on the disk, with the duration of one elaboration changed.
fn disk(elaboration: u32) -> EditedDisk {
    EditedDisk { from: "case vs_elaborate: 120".to_string(), to: format!("case vs_elaborate: {elaboration}") }
}

/// No fault is seeded; elaborations end when they do in the system. An endless one must be told to end: the operator
/// plans for 300 ticks.
#[derive(Default)]
struct Nominal {
    planning: u32,
}

impl Environment for Nominal {
    fn monitored(&mut self, program: &Program, location: LocationRef<'_>, codomain: DomainId) -> Result<Value, String> {
        let location = location.show(program).to_string();
        let text = match location.as_str() {
            "seeded" => "NONE",
            "endsNow(operator)" => {
                self.planning = (self.planning + 1) % 300;
                if self.planning == 0 { "true" } else { "false" }
            }
            _ => "false",
        };
        read_value(program, codomain, text)
    }

    fn choose(&mut self, _program: &Program, choice: &Choice<'_>) -> Result<usize, String> {
        Err(format!("nothing is to be chosen among {}", choice.candidates()))
    }

    fn time(&mut self, _unit: TimeUnit) -> Result<i64, String> {
        Err("no time is asked for".to_string())
    }
}

struct Run {
    machine: Machine,
    environment: Nominal,
}

impl Run {
    fn new(name: &str, elaboration: u32) -> Self {
        let mut disk = disk(elaboration);
        let path = repository::root().join(format!("examples/{name}.asm"));
        let root = disk.read(&path).expect("the example is there");
        let loaded = groundstate::load(root, &mut disk).unwrap_or_else(|faulty| panic!("{:#?}", faulty.diagnostics));
        let mut machine = Machine::new(loaded.program, Limits::default());
        let mut environment = Nominal::default();
        machine.start(&mut environment).unwrap_or_else(|fault| panic!("{fault:?}"));
        Self { machine, environment }
    }

    fn step(&mut self) {
        self.machine.prepare(&mut self.environment).unwrap_or_else(|fault| panic!("{fault:?}"));
        self.machine.commit();
    }

    /// The values of the locations, without undef.
    fn state(&self) -> BTreeMap<String, String> {
        let program = self.machine.program();
        let all = self.machine.locations().into_iter();
        all.map(|(location, value)| (location.show(program).to_string(), value.show(program).to_string()))
            .filter(|(_, value)| value != "undef")
            .collect()
    }

    /// What the quotient keeps: control states, locks and flags unchanged, ticks as ages.
    fn quotient(&self) -> BTreeMap<String, String> {
        const SAME: [&str; 9] = [
            "scheduler_currentPhase",
            "sb_ctrlState",
            "sem_state",
            "semaq",
            "indexUpdated",
            "sb_pending",
            "sb_fresh",
            "task_deadlinesMissed",
            "sem_illegalPost",
        ];
        const TICKS: [&str; 2] = ["task_periodStart", "sb_received"];
        let state = self.state();
        let clock: i64 = state["clock"].parse().expect("the clock is a number");
        let kept = state.iter().filter_map(|(location, value)| {
            let function = location.split('(').next().unwrap_or_default();
            if SAME.contains(&function) {
                return Some((location.clone(), value.clone()));
            }
            // An asynchronous task has no period, so the quotient leaves its period's start out.
            let tick: i64 = value.parse().ok()?;
            (TICKS.contains(&function) && state.contains_key(&location.replace("periodStart", "period")))
                .then(|| (location.clone(), (clock - tick).to_string()))
        });
        kept.collect()
    }
}

fn check(system: &str, verified: &str, elaborations: &[u32], steps: u32) {
    for &elaboration in elaborations {
        let (mut system, mut verified) = (Run::new(system, elaboration), Run::new(verified, elaboration));
        let (first, second) = (system.state(), verified.state());
        for (location, value) in &first {
            assert_eq!(second.get(location), Some(value), "{location} at the start");
        }
        for number in 0..steps {
            system.step();
            verified.step();
            assert_eq!(system.quotient(), verified.quotient(), "elaboration {elaboration}, step {number}");
        }
    }
}

#[test]
fn the_visual_servoing_robot() {
    // As written, and far above the camera's period.
    check("visual_servoing/VisualServoing", "visual_servoing/verification/VisualServoingInTicks", &[120, 230], 260);
}

#[test]
fn the_complete_controller() {
    // The operator's plan is sent.
    check("visual_servoing/CompleteController", "visual_servoing/verification/CompleteControllerInTicks", &[120], 310);
}
