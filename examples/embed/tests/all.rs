//! The shell in one file does what it says.

use std::process::Command;

#[test]
fn it_opens_edits_steps_verifies_and_cancels() {
    let model = concat!(env!("CARGO_MANIFEST_DIR"), "/../coffee_machine/CoffeeMachine.asm");
    let output = Command::new(env!("CARGO_BIN_EXE_embed")).arg(model).output().expect("it starts");
    let text = String::from_utf8(output.stdout).expect("text");
    assert!(output.status.success(), "{text}\n{}", String::from_utf8_lossy(&output.stderr));
    for expected in [
        "as it is: 0 faults\n",
        "with a slip: ",
        "\nstep 3: ",
        "back to before step 3\n",
        "end: Quit\n2 steps made\n",
        " checks hold\n",
        "not verified: Stopped(Asked)\n",
    ] {
        assert!(text.contains(expected), "{expected}\n{text}");
    }
    assert!(!text.contains("with a slip: 0 faults"), "{text}");
}
