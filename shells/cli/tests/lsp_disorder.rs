//! The language server under requests in disorder: each is answered once, and no answer has places of another text.
//!
//! With `GROUNDSTATE_FULL` set ten thousand requests, otherwise some hundreds.

use std::collections::BTreeMap;

use serde_json::{Value, json};

use crate::lsp::{Editor, LAMP};

const METHODS: [&str; 15] = [
    "textDocument/hover",
    "textDocument/hover",
    "textDocument/definition",
    "textDocument/references",
    "textDocument/documentHighlight",
    "textDocument/completion",
    "textDocument/documentSymbol",
    "textDocument/semanticTokens/full",
    "textDocument/foldingRange",
    "textDocument/prepareRename",
    "textDocument/formatting",
    "textDocument/inlayHint",
    "workspace/symbol",
    "groundstate/nothing",
    "textDocument/codeLens",
];

/// Numbers that look drawn and are always the same.
struct Draw(u64);

impl Draw {
    fn below(&mut self, many: usize) -> usize {
        self.0 = self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (self.0 >> 33) as usize % many
    }
}

/// What is known of a request: the method, and the line and the number of lines when it was sent.
struct Sent {
    method: &'static str,
    line: u64,
    lines: u64,
}

#[test]
fn requests_in_disorder_are_answered_once_and_of_their_own_text() {
    let count = if testkit::sample::is_full() { 10_000 } else { 400 };
    let mut editor = Editor::plain("disorder", &[("Lamp.asm", LAMP)]);
    let mut draw = Draw(3);
    // Lines above the model come and go: `light` is declared that much lower.
    let (mut above, mut version) = (0_u64, 1);
    let own = LAMP.lines().count() as u64;
    editor.open("Lamp.asm", LAMP);
    let (mut asked, mut answered, mut placed, mut given_up) = (0, 0, 0, 0);
    while asked < count {
        let mut sent: BTreeMap<i64, Sent> = BTreeMap::new();
        for _ in 0..40 {
            match draw.below(10) {
                0 => {
                    let is_more = above == 0 || draw.below(3) > 0;
                    let end = if is_more { 0 } else { 1 };
                    let range =
                        json!({ "start": { "line": 0, "character": 0 }, "end": { "line": end, "character": 0 } });
                    version += 1;
                    editor.change(
                        "Lamp.asm",
                        version,
                        json!({ "range": range, "text": if is_more { "// 😀\n" } else { "" } }),
                    );
                    above = if is_more { above + 1 } else { above - 1 };
                }
                1 if !sent.is_empty() => {
                    let id = sent.keys().nth(draw.below(sent.len())).copied();
                    editor.tell("$/cancelRequest", json!({ "id": id }));
                }
                2 => {
                    let id = [7, -1, 1_000_000][draw.below(3)];
                    editor.tell("$/cancelRequest", json!({ "id": id }));
                }
                _ => {
                    let method = METHODS[draw.below(METHODS.len())];
                    // `light` of the signature, or any place, also one that is not there.
                    let line = if draw.below(2) == 0 { above + 4 } else { draw.below(60) as u64 };
                    let mut params = editor.at("Lamp.asm", line as u32, 14);
                    params["query"] = json!("light");
                    params["context"] = json!({ "includeDeclaration": true, "triggerKind": 1 });
                    params["options"] = json!({ "tabSize": 4, "insertSpaces": false });
                    params["range"] =
                        json!({ "start": { "line": 0, "character": 0 }, "end": { "line": line, "character": 0 } });
                    let id = editor.request(method, params);
                    sent.insert(id, Sent { method, line, lines: above + own });
                    asked += 1;
                }
            }
        }
        for (id, Sent { method, line, lines }) in sent {
            let answer = editor.answer(id);
            answered += 1;
            if let Some(code) = answer["error"]["code"].as_i64() {
                assert!([-32800, -32801, -32803, -32601].contains(&code), "{method}: {answer}");
                assert!(code != -32601 || method == "groundstate/nothing", "{method}: {answer}");
                given_up += 1;
                continue;
            }
            if method == "textDocument/hover" && !answer["result"].is_null() {
                let at = &answer["result"]["range"]["start"];
                assert_eq!(at["line"], line, "line {line} of {lines}: {answer}");
                placed += 1;
            }
            let is_own = answer["result"][0]["uri"].as_str().is_some_and(|uri| uri.ends_with("Lamp.asm"));
            if method == "textDocument/definition" && is_own {
                let own = lines - own;
                let at = answer["result"][0]["range"]["start"]["line"].as_u64().expect("a line");
                assert!(at >= own && at < lines, "{own} lines are above: {answer}");
                placed += 1;
            }
        }
        editor.kept.retain(|message| message.get("method").is_none());
        assert!(editor.kept.is_empty(), "answered twice: {:?}", editor.kept);
    }
    assert!(answered == asked && placed > asked / 40 && given_up > 0, "{asked}, {answered}, {placed}, {given_up}");
    // It lives on, and knows the text.
    let hover = editor.ask("textDocument/hover", editor.at("Lamp.asm", above as u32 + 4, 14));
    assert_eq!(hover["result"]["range"]["start"], json!({ "line": above + 4, "character": 12 }), "{hover}");
    assert!(Value::is_string(&hover["result"]["contents"]["value"]), "{hover}");
    editor.end();
}
