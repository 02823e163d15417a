//! The part of `bench` that does not depend on the clock: the same steps end in the same state, however they are
//! divided.

use std::process::Command;

use serde_json::Value;

fn bench(model: &str, options: &[&str]) -> Value {
    let output = Command::new(env!("CARGO_BIN_EXE_groundstate"))
        .args(["bench", "--format", "json"])
        .args(options)
        .arg(format!("{}/../../{model}", env!("CARGO_MANIFEST_DIR")))
        .output()
        .expect("it starts");
    let text = String::from_utf8_lossy(&output.stdout).into_owned();
    serde_json::from_str(text.lines().next().expect("a line")).unwrap_or_else(|error| panic!("{error}: {text}"))
}

#[test]
fn the_digest_is_of_the_steps_alone() {
    for model in ["examples/coffee_machine/CoffeeMachine.asm", "bench/models/Philosophers.asm"] {
        let alone = bench(model, &["--steps", "300", "--windows", "0"]);
        let windows = bench(model, &["--steps", "300", "--windows", "2", "--window-ms", "1"]);
        assert_eq!(alone["digest"], windows["digest"], "{model}");
        let changed = alone["changed_percent"].as_f64().expect("a number");
        assert!(changed > 0.0 && changed <= 100.0, "{model}: {changed}");
        let others = [&["--steps", "301", "--windows", "0"][..], &["--steps", "300", "--windows", "0", "--seed", "1"]];
        for other in others {
            assert_ne!(alone["digest"], bench(model, other)["digest"], "{model}: {other:?}");
        }
    }
}
