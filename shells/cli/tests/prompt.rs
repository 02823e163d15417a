//! The prompt of `groundstate run`: piped, as a transcript; and at a pseudo terminal, with keys.
#![allow(clippy::disallowed_methods, reason = "the test makes the files it gives to the command")]

use std::io::Write;
use std::path::Path;
use std::process::{Command, Stdio};

use expect_test::{Expect, expect};

/// A door that opens and closes, with a choice and inputs of two domains.
const DOOR: &str = "asm Door
import StandardLibrary
signature:
	enum domain Position = {CLOSED | OPENING | OPENED}
	enum domain Hand = {PULL | PUSH | NONE}
	domain Level subsetof Integer
	monitored hand: Hand
	monitored level: Level
	controlled door: Position
	controlled seen: Level
	controlled moves: Integer
	derived isOpen: Boolean
definitions:
	domain Level = {0:5}
	function isOpen = door = OPENED
	invariant inv_few over moves: moves < 50
	main rule r_Main =
		par
			switch hand
				case PULL:
					par
						moves := moves + 1
						door := if door = CLOSED then OPENING else OPENED endif
						choose $n in {0, 1} with $n <= level do seen := $n
					endpar
				case PUSH:
					par
						moves := moves + 1
						door := CLOSED
					endpar
				otherwise skip
			endswitch
		endpar
default init s0:
	function door = CLOSED
	function seen = 0
	function moves = 0
";

/// A counter without inputs.
const COUNTER: &str = "asm Counter
import StandardLibrary
signature:
	controlled n: Integer
definitions:
	invariant inv_small over n: n < 5
	main rule r_Main = n := n + 1
default init s0:
	function n = 0
";

fn folder() -> tempfile::TempDir {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let write = |name: &str, text: &str| std::fs::write(folder.path().join(name), text).expect("a file");
    write("Door.asm", DOOR);
    write("Counter.asm", COUNTER);
    folder
}

/// What the program writes when these lines are piped in, in the order in which it writes it.
fn piped(folder: &Path, arguments: &str, lines: &str) -> (String, Option<i32>) {
    let program = env!("CARGO_BIN_EXE_groundstate");
    // One stream, so that results and prompts stand in their order.
    let mut child = Command::new("sh")
        .args(["-c", &format!("exec \"$0\" {arguments} 2>&1"), program])
        .current_dir(folder)
        .stdin(Stdio::piped())
        .stdout(Stdio::piped())
        .spawn()
        .expect("it starts");
    child.stdin.take().expect("a pipe").write_all(lines.as_bytes()).expect("it reads");
    let output = child.wait_with_output().expect("it ends");
    (String::from_utf8(output.stdout).expect("text"), output.status.code())
}

fn check(folder: &Path, arguments: &str, lines: &str, code: i32, expected: Expect) {
    let (told, ended) = piped(folder, arguments, lines);
    expected.assert_eq(&told);
    assert_eq!(ended, Some(code), "{told}");
}

#[test]
fn help_states_and_mistakes() {
    let folder = folder();
    let lines = "?\nPULLED\nquit\n:stat\n:state\n:state dor\nPULL\n9\n2\n:state door\n:state isOpen or moves > 3\n:updates\n:back\n:state moves\n:quit\n";
    check(
        folder.path(),
        "run Door.asm -i",
        lines,
        0,
        expect![[r#"
        state 0
          door = CLOSED
          seen = 0
          moves = 0
        step 1: hand (Hand: PULL, PUSH, NONE) = ?
          Step 1 asks for hand (Hand: PULL, PUSH, NONE)
          :state [TERM]    the state before this step; what a function or a term is in it
          :updates         what the last step changed
          :run [N]         make N steps without asking: inputs keep their values
          :until TERM      the same until TERM holds, for at most 1000 steps
          :inputs random   let :run and :until draw the inputs; `:inputs held` keeps them
          :back            take a step back; also `:undo`
          :save FILE       write the run so far as a scenario; `:save!` replaces a file
          :quit            end the run; also Ctrl-D
        step 1: hand (Hand: PULL, PUSH, NONE) = PULLED
          `PULLED` is not a value of Hand: PULL, PUSH or NONE is expected; did you mean `PULL`?
        step 1: hand (Hand: PULL, PUSH, NONE) = quit
          `quit` is not a value of Hand: PULL, PUSH or NONE is expected; did you mean `:quit`?
        step 1: hand (Hand: PULL, PUSH, NONE) = :stat
          `:stat` is not a command: did you mean `:state`?
        step 1: hand (Hand: PULL, PUSH, NONE) = :state
          door = CLOSED
          seen = 0
          moves = 0
        step 1: hand (Hand: PULL, PUSH, NONE) = :state dor
          there is no function `dor`; did you mean `door`?
        step 1: hand (Hand: PULL, PUSH, NONE) = PULL
        step 1: level (Level: 0, 1, 2, 3, 4, 5) = 9
          9 is not in Level
        step 1: level (Level: 0, 1, 2, 3, 4, 5) = 2
        step 1
          in hand = PULL
          in level = 2
          choose $n = 0 (1 of 2)
          door: CLOSED -> OPENING
          moves: 0 -> 1
        step 2: hand (Hand: PULL, PUSH, NONE) = :state door
          door = OPENING
        step 2: hand (Hand: PULL, PUSH, NONE) = :state isOpen or moves > 3
          isOpen or moves > 3 = false
        step 2: hand (Hand: PULL, PUSH, NONE) = :updates
          door: CLOSED -> OPENING
          moves: 0 -> 1
        step 2: hand (Hand: PULL, PUSH, NONE) = :back
        back to before step 1
        step 1: hand (Hand: PULL, PUSH, NONE) = :state moves
          moves = 0
        step 1: hand (Hand: PULL, PUSH, NONE) = :quit
        end after 0 steps: stopped at the prompt
    "#]],
    );
}

#[test]
fn steps_without_being_asked() {
    let folder = folder();
    let lines = "PULL\n1\n:run 3\n:state moves\n:until moves > 5\n:until moves > 5\n:inputs random\n:until door = CLOSED\n:until dor = CLOSED\n:until moves\n:run x\n";
    check(
        folder.path(),
        "run Door.asm -i --seed 4",
        lines,
        0,
        expect![[r#"
        state 0
          door = CLOSED
          seen = 0
          moves = 0
        step 1: hand (Hand: PULL, PUSH, NONE) = PULL
        step 1: level (Level: 0, 1, 2, 3, 4, 5) = 1
        step 1
          in hand = PULL
          in level = 1
          choose $n = 0 (1 of 2)
          door: CLOSED -> OPENING
          moves: 0 -> 1
        step 2: hand (Hand: PULL, PUSH, NONE) = :run 3
        step 2
          in hand = PULL
          in level = 1
          choose $n = 0 (1 of 2)
          door: OPENING -> OPENED
          moves: 1 -> 2
        step 3
          in hand = PULL
          in level = 1
          choose $n = 0 (1 of 2)
          moves: 2 -> 3
        step 4
          in hand = PULL
          in level = 1
          choose $n = 0 (1 of 2)
          moves: 3 -> 4
        step 5> :state moves
          moves = 4
        step 5> :until moves > 5
        step 5
          in hand = PULL
          in level = 1
          choose $n = 0 (1 of 2)
          moves: 4 -> 5
        step 6
          in hand = PULL
          in level = 1
          choose $n = 0 (1 of 2)
          moves: 5 -> 6
          `moves > 5` holds
        step 7> :until moves > 5
          `moves > 5` holds already
        step 7> :inputs random
          `:run` and `:until` draw the inputs, by --seed
        step 7> :until door = CLOSED
        step 7
          in hand = PULL
          in level = 1
          choose $n = 0 (1 of 2)
          moves: 6 -> 7
        step 8
          in hand = PULL
          in level = 5
          choose $n = 0 (1 of 2)
          moves: 7 -> 8
        step 9
          in hand = PUSH
          door: OPENED -> CLOSED
          moves: 8 -> 9
          `door = CLOSED` holds
        step 10> :until dor = CLOSED
          there is no function `dor`; did you mean `door`?
        step 10> :until moves
          `moves` is no condition: its value is not true or false
        step 10> :run x
          `x` is no number of steps: write one from 1, as in `:run 10`
        end after 9 steps: stopped at the prompt
    "#]],
    );
}

#[test]
fn an_input_that_cannot_be_held_is_asked_for() {
    let folder = folder();
    check(
        folder.path(),
        "run Door.asm -i --show none",
        "PULL\n:run 2\n3\n:quit\n",
        0,
        expect![[r#"
        step 1: hand (Hand: PULL, PUSH, NONE) = PULL
        step 1: level (Level: 0, 1, 2, 3, 4, 5) = :run 2
          level has no value yet that could be held
        step 1: level (Level: 0, 1, 2, 3, 4, 5) = 3
        step 3> :quit
        end after 2 steps: stopped at the prompt
    "#]],
    );
}

#[test]
fn a_run_without_inputs_waits_before_each_step_and_at_its_end() {
    let folder = folder();
    let lines = "\n:run 2\n7\n:run\n\n:run\n:back\n:state n\n:save low\n:save low\n:save! low\n:save low.txt\n:save no/low\n:quit\n";
    check(
        folder.path(),
        "run Counter.asm -i",
        lines,
        1,
        expect![[r#"
        state 0
          n = 0
        step 1> 
        step 1
          n: 0 -> 1
        step 2> :run 2
        step 2
          n: 1 -> 2
        step 3
          n: 2 -> 3
        step 4> 7
          no input is asked for now: Enter makes a step, `?` says what else can be typed
        step 4> :run
        step 4
          n: 3 -> 4
        step 5> 
        step 5
          n: 4 -> 5
          violated inv_small
        error[invariant-violated]: invariant inv_small does not hold after step 5
         --> Counter.asm:6:2
          |
        6 |     invariant inv_small over n: n < 5
          |     ^^^^^^^^^^^^^^^^^^^^^^^^^^^^-^^^^
          |                                 |
          |                                 is 5

        step 6> :run
        end after 5 steps: an invariant does not hold
        ended> :back
        back to before step 5
        step 5> :state n
          n = 4
        step 5> :save low
          wrote low.avalla: steps 4, checks 4; `groundstate test low.avalla` passes
        step 5> :save low
          low.avalla exists: choose another name, or replace it by `:save! low.avalla`
        step 5> :save! low
          wrote low.avalla: steps 4, checks 4; `groundstate test low.avalla` passes
        step 5> :save low.txt
          a scenario's name ends in .avalla, not in .txt
        step 5> :save no/low
          there is no folder no
        step 5> :quit
        end after 4 steps: stopped at the prompt
    "#]],
    );
}

#[test]
fn nothing_is_ever_true_within_the_limit() {
    let folder = folder();
    let (told, code) = piped(folder.path(), "run Counter.asm -i --no-invariants --show none", ":until n < 0\n:quit\n");
    assert_eq!(code, Some(0), "{told}");
    assert!(told.contains("`n < 0` did not hold within 1000 steps; `:until` goes on"), "{told}");
    assert!(told.contains("step 1001> "), "{told}");
}

/// What is saved is the run: a scenario that passes, and that fails on a model that does something else.
#[test]
fn a_saved_run_is_a_scenario() {
    let folder = folder();
    let lines = "PULL\n1\nPULL\n0\n:back\nPULL\n5\nNONE\nPUSH\n:save runs/closed\n:save closed\n:quit\n";
    std::fs::create_dir(folder.path().join("runs")).expect("a folder");
    let (told, code) = piped(folder.path(), "run Door.asm -i --choose random --seed 9", lines);
    assert_eq!(code, Some(0), "{told}");
    assert!(told.contains("wrote runs/closed.avalla: steps 4, checks"), "{told}");
    let test = |name: &str| {
        let mut command = Command::new(env!("CARGO_BIN_EXE_groundstate"));
        let output = command.args(["test", name]).current_dir(folder.path()).output().expect("it starts");
        (String::from_utf8_lossy(&output.stdout).into_owned(), output.status.code())
    };
    for name in ["runs/closed.avalla", "closed.avalla"] {
        assert!(told.contains(&format!("`groundstate test {name}` passes")), "{told}");
        assert_eq!(test(name).1, Some(0), "{}", test(name).0);
    }
    // Each mistake in the model is one in the run.
    for (from, to) in
        [("moves + 1", "moves + 2"), ("door := CLOSED", "door := OPENED"), ("then OPENING", "then OPENED")]
    {
        let wrong = DOOR.replace(from, to);
        assert_ne!(wrong, DOOR);
        std::fs::write(folder.path().join("Door.asm"), wrong).expect("a file");
        assert_eq!(test("closed.avalla").1, Some(1), "{to}: {}", test("closed.avalla").0);
    }
}

/// Whoever saves a run that no scenario repeats is told so.
#[test]
fn what_a_scenario_cannot_repeat_is_told() {
    let folder = folder();
    let clock = "asm Hour\nimport StandardLibrary\nsignature:\n\tcontrolled at: Integer\ndefinitions:\n\
                 \tmain rule r_Main = at := currTimeSecs\ndefault init s0:\n\tfunction at = 0\n";
    std::fs::write(folder.path().join("Hour.asm"), clock).expect("a file");
    let (told, code) = piped(folder.path(), "run Hour.asm -i --clock 5s", "\n\n:save hour\n");
    assert_eq!(code, Some(0), "{told}");
    assert!(told.contains("but `groundstate test hour.avalla` fails: "), "{told}");
}

#[test]
fn a_trace_of_an_interactive_run_is_replayed() {
    let folder = folder();
    let lines = "PULL\n1\nPULL\n0\n:back\n:back\nPULL\n5\n:inputs random\n:run 5\n:quit\n";
    let (told, code) = piped(folder.path(), "run Door.asm -i --trace door.trace", lines);
    assert_eq!(code, Some(0), "{told}");
    let mut command = Command::new(env!("CARGO_BIN_EXE_groundstate"));
    let output = command.args(["replay", "door.trace"]).current_dir(folder.path()).output().expect("it starts");
    assert_eq!(output.status.code(), Some(0), "{}", String::from_utf8_lossy(&output.stderr));
}

#[cfg(unix)]
mod terminal {
    use std::fs::File;
    use std::io::{Read, Write};
    use std::os::fd::OwnedFd;
    use std::process::{Child, Command, Stdio};
    use std::sync::mpsc::{Receiver, channel};
    use std::thread;
    use std::time::{Duration, Instant};

    use rustix::pty::{OpenptFlags, grantpt, openpt, ptsname, unlockpt};

    /// LIMIT: whoever does not write for so long writes nothing more.
    const SILENCE: Duration = Duration::from_secs(60);

    /// A program at a pseudo terminal. It ends with the test, whatever it waits for.
    struct Terminal {
        master: File,
        written: Receiver<Vec<u8>>,
        child: Child,
        told: String,
    }

    impl Terminal {
        fn run(folder: &std::path::Path, arguments: &[&str]) -> Terminal {
            let master: OwnedFd = openpt(OpenptFlags::RDWR | OpenptFlags::NOCTTY).expect("a pseudo terminal");
            grantpt(&master).expect("it is ours");
            unlockpt(&master).expect("it opens");
            let name = ptsname(&master, Vec::new()).expect("a name").into_string().expect("text");
            let slave = File::options().read(true).write(true).open(name).expect("the other end");
            let end = || Stdio::from(slave.try_clone().expect("one more"));
            let mut command = Command::new(env!("CARGO_BIN_EXE_groundstate"));
            command.args(arguments).current_dir(folder).env("TERM", "xterm").env("NO_COLOR", "1");
            let child = command.stdin(end()).stdout(end()).stderr(end()).spawn().expect("it starts");
            let master = File::from(master);
            let mut reader = master.try_clone().expect("one more");
            let (sender, written) = channel();
            // Reading waits for as long as nothing comes, so the test does not do it itself.
            thread::spawn(move || {
                let mut bytes = [0; 4096];
                while let Ok(read @ 1..) = reader.read(&mut bytes) {
                    if sender.send(bytes[..read].to_vec()).is_err() {
                        return;
                    }
                }
            });
            Terminal { master, written, child, told: String::new() }
        }

        /// Reads until the text comes after what was read before.
        fn await_text(&mut self, text: &str) {
            while !self.told.contains(text) {
                let Ok(bytes) = self.written.recv_timeout(SILENCE) else {
                    panic!("`{text}` does not come: {}", self.told);
                };
                self.told.push_str(&String::from_utf8_lossy(&bytes));
            }
            let end = self.told.find(text).expect("it is there") + text.len();
            self.told.drain(..end);
        }

        fn keys(&mut self, keys: &str) {
            self.master.write_all(keys.as_bytes()).expect("it reads");
        }

        /// The exit code, if the program ends.
        fn ends(&mut self) -> Option<i32> {
            let begin = Instant::now();
            while begin.elapsed() < SILENCE {
                if let Some(status) = self.child.try_wait().expect("it was started") {
                    return status.code();
                }
                thread::sleep(Duration::from_millis(10));
            }
            panic!("it does not end: {}", self.told);
        }
    }

    impl Drop for Terminal {
        fn drop(&mut self) {
            let _ = self.child.kill();
            let _ = self.child.wait();
        }
    }

    /// Tab completes a value of the domain, arrow up recalls one of the same domain and none of another; Ctrl-D ends the run.
    #[test]
    fn keys_complete_and_recall() {
        let folder = super::folder();
        let mut terminal = Terminal::run(folder.path(), &["run", "Door.asm"]);
        terminal.await_text("? says what can be typed");
        terminal.await_text("step 1: hand (Hand: PULL, PUSH, NONE) = ");
        terminal.keys("PUL\t\r");
        terminal.await_text("step 1: level (Level: 0, 1, 2, 3, 4, 5) = ");
        terminal.keys("4\r");
        terminal.await_text("CLOSED -> OPENING");
        terminal.await_text("step 2: hand (Hand: PULL, PUSH, NONE) = ");
        terminal.keys("\x1b[A\r");
        terminal.await_text("step 2: level (Level: 0, 1, 2, 3, 4, 5) = ");
        terminal.keys("\x1b[A\r");
        terminal.await_text("in level = 4");
        terminal.await_text("OPENING -> OPENED");
        terminal.await_text("step 3: hand (Hand: PULL, PUSH, NONE) = ");
        terminal.keys(":st\t doo\t\r");
        terminal.await_text("door = OPENED");
        terminal.await_text("step 3: hand");
        terminal.keys("\x04");
        terminal.await_text("stopped at the prompt");
        assert_eq!(terminal.ends(), Some(0));
    }
}
