//! Runs of a session that are written as scenarios, and scenarios that are played though they lie in no file.

use serde_json::{Value, json};

use crate::lsp::Editor;

const CHOOSING: &str = "asm Choosing
import StandardLibrary
signature:
	controlled sum: Integer
	controlled last: Integer
	monitored add: Boolean
definitions:
	main rule r_Main =
		if add then
			choose $a in { 1 : 9 } with true do
				par
					sum := sum + $a
					last := $a
				endpar
		endif
default init s0:
	function sum = 0
	function last = 0
";

#[test]
fn a_run_is_written_as_a_scenario_that_plays_in_no_file() {
    let mut editor = Editor::plain("written", &[("Choosing.asm", CHOOSING)]);
    let document = json!({ "uri": editor.uri("Choosing.asm") });
    let opened = editor.ask("groundstate/session/open", json!({ "textDocument": document, "seed": 5 }));
    let id = opened["result"]["session"].clone();
    let mut ask = |method: &str, params: Value| {
        let mut params = params;
        params["session"] = id.clone();
        editor.ask(&format!("groundstate/session/{method}"), params)
    };
    let asked = json!({ "name": "again", "model": "Choosing.asm" });
    assert!(ask("scenario", asked.clone())["error"]["message"].is_string());
    // Many steps at once are as many steps; what is taken back is not in it.
    ask("step", json!({ "steps": 30 }));
    for _ in 0..10 {
        ask("back", json!({}));
    }
    let sum = ask("state", json!({}))["result"]["state"]["sum"].clone();
    let text = ask("scenario", asked)["result"]["text"].as_str().expect("a text").to_string();
    assert_eq!(text.lines().filter(|line| *line == "step").count(), 20, "{text}");
    assert!(text.contains("pick $a in r_Main := "), "{text}");
    // With first candidates for what is not picked it comes to the same state: all is picked.
    let played = json!({ "textDocument": document, "scenario": text, "begins": true });
    let opened = editor.ask("groundstate/session/open", played)["result"].clone();
    assert_eq!((&opened["state"]["sum"], &opened["stale"]), (&json!("0"), &json!(false)), "{opened}");
    assert!(opened["next"].is_object(), "{opened}");
    let step = json!({ "session": opened["session"], "steps": 10_000 });
    let ended = editor.ask("groundstate/session/step", step)["result"].clone();
    assert_eq!((&ended["word"], &ended["state"]["sum"], &ended["step"]), (&json!("passed"), &sum, &json!(20)));
    // Its beginning is where going back ends.
    let back = json!({ "session": opened["session"] });
    while editor.ask("groundstate/session/back", back.clone())["result"]["refused"].is_null() {}
    let begun = editor.ask("groundstate/session/state", back)["result"].clone();
    assert_eq!((&begun["state"]["sum"], &begun["step"]), (&json!("0"), &json!(0)), "{begun}");
    // A wrong scenario is refused, with the reason.
    let wrong = json!({ "textDocument": document, "scenario": "scenario x\nload Nothing.asm\n" });
    let refused = editor.ask("groundstate/session/open", wrong);
    assert!(refused["error"]["message"].as_str().is_some_and(|told| told.contains("has errors")), "{refused}");
    editor.end();
}
