//! Those who have no business there get nothing.

use std::time::{Duration, Instant};

use serde_json::json;

use crate::browser::Running;

const MODEL: &str =
    "asm a\nimport StandardLibrary\nsignature:\n\tcontrolled x: Integer\ndefinitions:\n\tmain rule r_m = x := 1\n";

#[test]
fn without_the_token_there_is_no_answer() {
    let running = Running::over(&[("a.asm", MODEL)]);
    let refused = |answer: String, what: &str| assert!(answer.starts_with("HTTP/1.1 403"), "{what}: {answer}");
    refused(running.get("/", &[]), "nothing");
    refused(running.get("/ws", &[]), "nothing");
    refused(running.get("/?token=", &[]), "no token");
    refused(running.get(&format!("/?token={}", "0".repeat(32)), &[]), "another token");
    refused(running.get(&format!("/?token={}x", running.token), &[]), "more than the token");
    refused(running.get("/", &[("Cookie", &format!("groundstate-1={}", running.token))]), "another port's cookie");
    refused(running.get("/", &[("Cookie", &format!("groundstate-{}=x", running.port))]), "another cookie");
    let entered = running.get(&format!("/?token={}", running.token), &[]);
    assert!(entered.starts_with("HTTP/1.1 303"), "{entered}");
    let cookie = format!("set-cookie: {}; HttpOnly; SameSite=Strict; Path=/", running.cookie());
    assert!(entered.contains(&cookie) && entered.contains("location: /\r\n"), "{entered}");
    let page = running.get("/", &[("Cookie", &running.cookie())]);
    assert!(page.starts_with("HTTP/1.1 200"), "{page}");
    // Another start has another token.
    assert_ne!(Running::over(&[]).token, running.token);
}

#[test]
fn other_sites_and_other_names_get_no_answer() {
    let running = Running::over(&[]);
    let cookie = running.cookie();
    let own = format!("http://127.0.0.1:{}", running.port);
    let status = |headers: &[(&str, &str)]| running.get("/", headers).get(9..12).unwrap_or_default().to_string();
    assert_eq!(status(&[("Cookie", &cookie)]), "200");
    assert_eq!(status(&[("Cookie", &cookie), ("Host", &format!("localhost:{}", running.port))]), "200");
    // A name that was made to point to this machine; another port; none; two.
    assert_eq!(status(&[("Cookie", &cookie), ("Host", &format!("evil.example:{}", running.port))]), "403");
    assert_eq!(status(&[("Cookie", &cookie), ("Host", "127.0.0.1")]), "403");
    assert_eq!(status(&[("Cookie", &cookie), ("Host", "")]), "403");
    let host = format!("127.0.0.1:{}", running.port);
    assert_ne!(status(&[("Cookie", &cookie), ("Host", &host), ("Host", "evil.example")]), "200");
    assert_eq!(status(&[("Cookie", &cookie), ("Origin", "http://evil.example")]), "403");
    assert_eq!(status(&[("Cookie", &cookie), ("Origin", "null")]), "403");
    assert_eq!(status(&[("Cookie", &cookie), ("Origin", &own)]), "200");
    assert_eq!(status(&[("Cookie", &cookie), ("Origin", &own), ("Origin", "http://evil.example")]), "403");
    let post = running.raw(&format!(
        "POST / HTTP/1.1\r\nHost: {host}\r\nCookie: {cookie}\r\nContent-Length: 0\r\nConnection: close\r\n\r\n"
    ));
    assert!(post.starts_with("HTTP/1.1 405"), "{post}");
    // A socket needs all three.
    assert!(running.tab_from(&own, &cookie).is_ok());
    assert!(running.tab_from("http://evil.example", &cookie).is_err());
    assert!(running.tab_from("", &cookie).is_err());
    assert!(running.tab_from(&own, "x=y").is_err());
    // What is answered may load nothing from elsewhere, whatever it is.
    for page in
        [running.get("/", &[("Cookie", &cookie)]), running.get("/", &[]), running.get("/none", &[("Cookie", &cookie)])]
    {
        assert!(page.contains("default-src 'none'; script-src 'self';"), "{page}");
        assert!(page.contains("x-content-type-options: nosniff") && page.contains("frame-ancestors 'none'"), "{page}");
    }
}

#[test]
fn nothing_outside_the_folder_is_read_or_written() {
    let running =
        Running::over(&[("a.asm", MODEL), ("sub/b.asm", MODEL), ("README.md", "secret"), (".git/c.asm", "secret")]);
    let outside = running.place();
    std::fs::write(outside.join("secret.asm"), "secret").expect("written");
    #[cfg(unix)]
    {
        use std::os::unix::fs::symlink;
        symlink(outside.join("secret.asm"), running.folder().join("link.asm")).expect("linked");
        symlink(outside, running.folder().join("up")).expect("linked");
        symlink(outside.join("none.asm"), running.folder().join("dangling.asm")).expect("linked");
    }
    let mut tab = running.tab();
    assert_eq!(tab.ask("studio/read", json!({ "path": "sub/b.asm" })).expect("it is there")["text"], MODEL);
    let absolute = outside.join("secret.asm").to_string_lossy().into_owned();
    let names = [
        "../secret.asm",
        "sub/../../secret.asm",
        "sub/../a.asm",
        "./a.asm",
        "//a.asm",
        "a.asm/",
        "",
        &absolute,
        "a.asm\0",
        "..\\secret.asm",
        "C:a.asm",
        "sub//b.asm",
        "link.asm",
        "up/secret.asm",
        "dangling.asm",
        ".git/c.asm",
        "README.md",
        "a.asm.",
        "a.asm ",
        &"x".repeat(2_000),
        "%2e%2e/secret.asm",
    ];
    for name in names {
        let read = tab.ask("studio/read", json!({ "path": name }));
        assert!(read.is_err(), "{name:?} is read: {read:?}");
        // A sign of percent has no meaning here: that is a folder of the project.
        if !name.starts_with('%') {
            let wrote = tab.ask("studio/write", json!({ "path": name, "text": "x", "base": null }));
            assert!(wrote.is_err(), "{name:?} is written: {wrote:?}");
        }
        let found = tab.ask("studio/names", json!({ "path": name }));
        assert!(found.is_err() || name.starts_with('%'), "{name:?} is looked for");
        let deleted = tab.ask("studio/delete", json!({ "path": name }));
        assert!(deleted.is_err(), "{name:?} is deleted: {deleted:?}");
        for (path, to) in [(name, "free.asm"), ("a.asm", name)] {
            let renamed = tab.ask("studio/rename", json!({ "files": [{ "path": path, "to": to }] }));
            assert!(renamed.is_err() || name.starts_with('%'), "{path:?} is renamed to {to:?}: {renamed:?}");
        }
        let job = tab.ask("studio/job", json!({ "job": "check", "path": name }));
        assert!(job.is_err() || name.is_empty() || !name.contains(".."), "{name:?} is checked: {job:?}");
    }
    assert_eq!(std::fs::read_to_string(outside.join("secret.asm")).expect("there"), "secret");
    assert!(!outside.join("none.asm").exists());
    assert!(tab.ask("studio/new", json!({ "template": "machine", "name": "../out" })).is_err());
    assert!(tab.ask("studio/new", json!({ "template": "--help", "name": "x" })).is_err());
    let files = tab.ask("studio/hello", json!({})).expect("told")["files"].to_string();
    assert!(!files.contains("secret") && !files.contains("README") && !files.contains("link.asm"), "{files}");
}

#[test]
fn the_language_server_sees_the_folder_alone() {
    let text = "asm a\nimport ../secret\nsignature:\ndefinitions:\n\tmain rule r_m = skip\n";
    let running = Running::over(&[("a.asm", text)]);
    std::fs::write(
        running.place().join("secret.asm"),
        "module secret\nexport *\nsignature:\n\tstatic password: Integer\ndefinitions:\n",
    )
    .expect("written");
    let mut tab = running.tab();
    tab.initialize(&running);
    tab.tell(
        "textDocument/didOpen",
        json!({ "textDocument": { "uri": running.uri("a.asm"), "languageId": "asmetal", "version": 1, "text": text } }),
    );
    let faults = tab.hear("textDocument/publishDiagnostics", |params| params["uri"] == running.uri("a.asm"));
    assert!(faults.to_string().contains("lies outside the folder that is open"), "{faults}");
    let symbols = tab.ask("workspace/symbol", json!({ "query": "password" })).expect("answered");
    assert!(!symbols.to_string().contains("password"), "{symbols}");
    let outside = format!("file://{}", running.place().join("secret.asm").display());
    for method in ["textDocument/documentSymbol", "textDocument/foldingRange", "groundstate/chart/picture"] {
        let told = tab.ask(method, json!({ "textDocument": { "uri": outside } }));
        assert!(!format!("{told:?}").contains("password"), "{method}: {told:?}");
    }
    let opened = tab.ask("groundstate/session/open", json!({ "textDocument": { "uri": outside } }));
    assert!(opened.is_err(), "{opened:?}");
}

#[test]
fn what_is_too_much_is_refused_and_the_studio_goes_on() {
    let running = Running::over(&[("a.asm", MODEL)]);
    let mut tab = running.tab();
    assert!(tab.ask("studio/none", json!({})).is_err());
    tab.send("{".to_string());
    assert_eq!(tab.next().expect("told")["error"]["message"], "this is no JSON");
    // Parameters of any shape.
    for params in [
        json!(null),
        json!([]),
        json!({ "path": 1 }),
        json!({ "path": ["a.asm"] }),
        json!({ "path": "a.asm", "text": 1 }),
    ] {
        for method in ["studio/read", "studio/write", "studio/job", "studio/stop", "studio/new"] {
            let is_right = method == "studio/read" && params["path"] == "a.asm";
            assert_eq!(tab.ask(method, params.clone()).is_ok(), is_right, "{method} {params}");
        }
    }
    let large = json!({ "jsonrpc": "2.0", "id": 99, "method": "studio/write",
                        "params": { "path": "a.asm", "text": "x".repeat(70 << 20), "base": null } });
    tab.send(large.to_string());
    assert!(tab.next().is_none(), "the tab is let go");
    assert_eq!(running.text("a.asm"), MODEL);
    // As many tabs as there may be, and one more.
    let mut tabs: Vec<_> = (0..16).map(|_| running.tab()).collect();
    let until = Instant::now() + Duration::from_secs(10);
    for tab in &mut tabs {
        let asked = tab.ask("studio/hello", json!({}));
        assert!(asked.is_ok(), "{asked:?}");
        assert!(Instant::now() < until);
    }
    let mut more = running.tab();
    assert_eq!(more.next().expect("told")["method"], "studio/refused");
    let long = running.get(&format!("/{}", "x".repeat(5_000)), &[("Cookie", &running.cookie())]);
    assert!(long.starts_with("HTTP/1.1 414"), "{long}");
}
