//! What lies beside a model: its C++ and its inputs, and what of it is not shown.

use serde_json::{Value, json};

use crate::browser::{Running, Tab};

const MODEL: &str = "asm a\n";

/// C++ of `sub/a.asm`, made from that text and from another one beside it.
fn map(fingerprint: &str) -> String {
    let texts = json!([
        { "file": "../a.asm", "fingerprint": fingerprint },
        { "file": "../b.asm", "fingerprint": groundstate::text_fingerprint("b\n") },
    ]);
    let place = |file: &str| json!({ "file": file, "line": 3, "column": 2, "end_line": 4, "end_column": 5 });
    let line =
        |number: u64, file: &str| json!({ "generated": { "file": "a.cpp", "line": number }, "model": place(file) });
    let lines =
        [line(7, "../a.asm"), line(8, "<library>/x.asm"), line(9, "../../../secret.asm"), line(10, "/etc/x.asm")];
    json!({ "lines": lines, "texts": texts }).to_string()
}

fn running(map: &str) -> Running {
    Running::over(&[
        ("sub/a.asm", MODEL),
        ("sub/b.asm", "b\n"),
        ("sub/a.generated/a.cpp", "int x;\n"),
        ("sub/a.generated/source-map.json", map),
        ("sub/a.generated/CMakeLists.txt", "project(a)\n"),
        ("sub/a.generated/notes.txt", "secret"),
        ("sub/a.generated/runtime/include/r.hpp", "runtime"),
        ("sub/a.generated/build/b.cpp", "built"),
        ("sub/other.cpp", "secret"),
    ])
}

fn listed(tab: &mut Tab) -> Value {
    tab.ask("studio/generated", json!({ "path": "sub/a.asm" })).expect("listed")
}

#[test]
fn generated_code_lies_beside_its_model() {
    let running = running(&map(&groundstate::text_fingerprint(MODEL)));
    let mut tab = running.tab();
    let told = listed(&mut tab);
    assert_eq!(told["files"], json!(["CMakeLists.txt", "a.cpp"]));
    assert_eq!((&told["state"], &told["changed"]), (&json!("current"), &json!([])));
    // Places outside of the folder, and in libraries, are no places for a browser.
    assert_eq!(told["lines"], json!([{ "file": "a.cpp", "line": 7, "model": "sub/a.asm", "at": [3, 2, 4, 5] }]));
    let text = tab.ask("studio/generated", json!({ "path": "sub/a.asm", "file": "a.cpp" }));
    assert_eq!(text.expect("read")["text"], "int x;\n");
    let none = tab.ask("studio/generated", json!({ "path": "sub/b.asm" })).expect("listed");
    assert_eq!((&none["state"], &none["files"]), (&json!("none"), &json!([])));
}

#[test]
fn older_code_is_never_called_current() {
    let running = running(&map(&groundstate::text_fingerprint(MODEL)));
    let mut tab = running.tab();
    let state = |tab: &mut Tab| listed(tab)["state"].clone();
    let write = |name: &str, text: &str| std::fs::write(running.folder().join(name), text).expect("written");
    assert_eq!(state(&mut tab), "current");
    // Whichever text it was made from is another one, also one that is imported, or is gone.
    write("sub/b.asm", "c\n");
    assert_eq!((state(&mut tab), listed(&mut tab)["changed"].clone()), (json!("older"), json!(["sub/b.asm"])));
    std::fs::remove_file(running.folder().join("sub/b.asm")).expect("removed");
    assert_eq!(state(&mut tab), "older");
    write("sub/b.asm", "b\n");
    assert_eq!(state(&mut tab), "current");
    write("sub/a.asm", "asm a // changed\n");
    assert_eq!(state(&mut tab), "older");
    write("sub/a.asm", MODEL);
    // A map that does not say what it was made from, is broken, or is not there.
    let maps = [
        "{\"lines\": []}".to_string(),
        "{".to_string(),
        json!({ "texts": [] }).to_string(),
        json!({ "texts": [{ "file": "../../../secret.asm", "fingerprint": "0" }] }).to_string(),
    ];
    for map in maps {
        write("sub/a.generated/source-map.json", &map);
        assert_eq!(state(&mut tab), "unknown", "{map}");
    }
    std::fs::remove_file(running.folder().join("sub/a.generated/source-map.json")).expect("removed");
    assert_eq!(state(&mut tab), "unknown");
}

#[test]
fn nothing_but_generated_code_is_read() {
    let running = running(&map("0"));
    std::fs::write(running.place().join("secret.cpp"), "secret").expect("written");
    #[cfg(unix)]
    {
        use std::os::unix::fs::symlink;
        let code = running.folder().join("sub/a.generated");
        symlink(running.place().join("secret.cpp"), code.join("out.cpp")).expect("linked");
        symlink(running.folder().join("sub/other.cpp"), code.join("within.cpp")).expect("linked");
        symlink(running.place(), code.join("up")).expect("linked");
        symlink(running.folder().join("sub"), code.join("back")).expect("linked");
        symlink(running.folder().join("sub"), running.folder().join("b.generated")).expect("linked");
        std::fs::write(running.folder().join("b.asm"), MODEL).expect("written");
    }
    let mut tab = running.tab();
    let files = [
        "",
        ".",
        "..",
        "../other.cpp",
        "../a.generated/a.cpp",
        "./a.cpp",
        "/etc/passwd",
        "//a.cpp",
        "a.cpp\0",
        "a.cpp/",
        "..\\other.cpp",
        "C:a.cpp",
        "out.cpp",
        "within.cpp",
        "up/secret.cpp",
        "back/other.cpp",
        "notes.txt",
        "source-map.json",
        "runtime/include/r.hpp",
        "build/b.cpp",
        "build",
        ".a.cpp",
        "a.cpp ",
        "A.CPP.",
        "none.cpp",
    ];
    for file in files {
        let read = tab.ask("studio/generated", json!({ "path": "sub/a.asm", "file": file }));
        assert!(read.is_err(), "{file:?} is read: {read:?}");
    }
    let paths = ["../a.asm", "sub/../sub/a.asm", "/sub/a.asm", "sub/a.generated/a.cpp", "sub", "", "sub/a.verify.yaml"];
    for path in paths {
        assert!(tab.ask("studio/generated", json!({ "path": path })).is_err(), "{path:?} is listed");
        assert!(tab.ask("studio/generated", json!({ "path": path, "file": "a.cpp" })).is_err(), "{path:?} is read");
    }
    let names = listed(&mut tab)["files"].to_string();
    assert_eq!(names, "[\"CMakeLists.txt\",\"a.cpp\"]");
    // A folder that is a link is none.
    let linked = tab.ask("studio/generated", json!({ "path": "b.asm", "file": "other.cpp" }));
    assert!(linked.is_err(), "{linked:?}");
    assert_eq!(tab.ask("studio/generated", json!({ "path": "b.asm" })).expect("listed")["state"], "none");
}

#[cfg(unix)]
#[test]
fn nothing_is_generated_or_built_through_a_link_that_leads_out() {
    use std::os::unix::fs::symlink;
    let running = Running::over(&[("a.chart", "chart A\n"), ("b.chart", "chart B\n"), ("b.generated/main.cpp", "")]);
    symlink(running.place(), running.folder().join("a.generated")).expect("linked");
    symlink(running.place(), running.folder().join("b.generated/build")).expect("linked");
    let mut tab = running.tab();
    for path in ["a.chart", "b.chart"] {
        for job in ["generate", "program"] {
            let refused = tab.ask("studio/job", json!({ "job": job, "path": path })).expect_err("it is refused");
            assert!(refused.contains("is no file of this folder"), "{job} {path}: {refused}");
        }
    }
    let refused = tab.ask("studio/job", json!({ "job": "program", "path": "../a.chart" }));
    assert!(refused.is_err(), "{refused:?}");
}

#[test]
fn files_of_inputs() {
    let running = Running::over(&[
        ("sub/a.asm", MODEL),
        ("sub/day.yaml", "1: { x: 2 }\n"),
        ("sub/night.csv", "step,x\n"),
        ("sub/a.verify.yaml", "limits: {}\n"),
        ("sub/.hidden.yaml", "secret"),
        ("sub/key.pem", "secret"),
        ("top.yaml", "1: {}\n"),
    ]);
    std::fs::write(running.place().join("secret.yaml"), "secret").expect("written");
    #[cfg(unix)]
    std::os::unix::fs::symlink(running.place().join("secret.yaml"), running.folder().join("sub/link.yaml"))
        .expect("linked");
    let mut tab = running.tab();
    let told = tab.ask("studio/inputs", json!({ "path": "sub/a.asm" })).expect("listed");
    assert_eq!(told["files"], json!(["sub/day.yaml", "sub/night.csv"]));
    let text = tab.ask("studio/inputs", json!({ "file": "sub/day.yaml" })).expect("read");
    assert_eq!(text["text"], "1: { x: 2 }\n");
    for file in [
        "../secret.yaml",
        "sub/link.yaml",
        "sub/.hidden.yaml",
        "sub/key.pem",
        "sub/a.verify.yaml",
        "/etc/x.yaml",
        "sub/none.csv",
    ] {
        assert!(tab.ask("studio/inputs", json!({ "file": file })).is_err(), "{file:?} is read");
    }
    assert!(tab.ask("studio/inputs", json!({ "path": "../a.asm" })).is_err());
    assert!(tab.ask("studio/inputs", json!({ "path": "sub/day.yaml" })).is_err());
}
