//! The debug adapter under requests in disorder: whatever comes, each request is answered once, and the adapter lives on.

use serde_json::{Value, json};

use crate::dap::{Debugger, LIFT};

const COMMANDS: [&str; 26] = [
    "initialize",
    "launch",
    "configurationDone",
    "setBreakpoints",
    "setFunctionBreakpoints",
    "setDataBreakpoints",
    "setExceptionBreakpoints",
    "dataBreakpointInfo",
    "breakpointLocations",
    "continue",
    "next",
    "next",
    "stepBack",
    "reverseContinue",
    "pause",
    "stackTrace",
    "scopes",
    "variables",
    "variables",
    "setVariable",
    "setExpression",
    "evaluate",
    "evaluate",
    "exceptionInfo",
    "source",
    "threads",
];

const WORDS: [&str; 18] = [
    "floor",
    "called := 3",
    "called",
    "called := ?",
    "visits(2)",
    "visits",
    "r_Ring",
    "top",
    "2",
    "9",
    "",
    "((",
    "{1:100000}",
    "choice := #1",
    "$x",
    "(forall $f in Floor with visits($f) >= 0)",
    "floor + ",
    "self",
];

const COUNTS: [&str; 6] = ["", "2", ">= 1", "% 2", "% 0", "two"];

const MESSAGES: [&str; 6] = ["", "here", "{floor} of {called}", "{", "{}", "{idiv(1, floor)}"];

/// Numbers that look drawn and are always the same.
struct Draw(u64);

impl Draw {
    fn below(&mut self, many: usize) -> usize {
        self.0 = self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (self.0 >> 33) as usize % many
    }

    fn word(&mut self) -> Value {
        match self.below(8) {
            0 => [Value::Null, json!(-1), json!([{}]), json!(1e300)][self.below(4)].clone(),
            _ => json!(WORDS[self.below(WORDS.len())]),
        }
    }
}

#[test]
fn requests_in_disorder_are_answered_one_by_one() {
    let sessions = if testkit::sample::is_full() { 200 } else { 12 };
    for session in 0..sessions {
        let mut debugger = Debugger::start("disorder", &[("Lift.asm", LIFT)]);
        let mut draw = Draw(session);
        let path = debugger.path("Lift.asm");
        // Most sessions begin as they should.
        if draw.below(4) > 0 {
            for command in &COMMANDS[..3] {
                let seed = if draw.below(2) == 0 { json!(session) } else { Value::Null };
                debugger.ask(command, json!({ "program": path, "seed": seed }));
            }
        }
        for _ in 0..60 {
            let command = COMMANDS[draw.below(COMMANDS.len())];
            let one = json!({
                "line": draw.below(50), "name": draw.word(), "dataId": draw.word(), "condition": draw.word(),
                "hitCondition": COUNTS[draw.below(COUNTS.len())], "logMessage": MESSAGES[draw.below(MESSAGES.len())],
            });
            let filter = ["faults", "violations", "x"][draw.below(3)];
            let context = ["repl", "watch"][draw.below(2)];
            let arguments = json!({
                "program": path, "threadId": 1, "source": { "path": path }, "breakpoints": [one, one],
                "filters": [filter], "line": draw.below(60), "endLine": draw.below(60),
                "name": draw.word(), "expression": draw.word(), "value": draw.word(), "context": context,
                "variablesReference": draw.below(14), "sourceReference": draw.below(5),
            });
            // `ask` sees to it that this request is answered, and no other twice.
            let answer = debugger.ask(command, arguments.clone());
            let reason = answer["message"].as_str().unwrap_or_default();
            assert!(!reason.contains("defect"), "session {session}: {command} {arguments}: {answer}");
        }
        debugger.end();
    }
}
