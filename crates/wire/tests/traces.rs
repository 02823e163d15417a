//! Traces of older versions stay readable, whatever newer versions add.

use groundstate::simulate::{End, RandomSource, Record, Run};
use groundstate::simulate::{Header, Inputs, Options};
use machine::Limits;
use syntax::SourceFile;
use testkit::NoFiles;
use wire::{Line, Reader, VERSION, Wire};

const LAMP: &str = "asm Lamp\nimport StandardLibrary\nsignature:\n\tenum domain Colour = {RED | GREEN}\n\
                    \tmonitored button: Boolean\n\tcontrolled lamp: Colour\n\tcontrolled count: Integer\ndefinitions:\n\
                    \tinvariant over count: count < 3\n\
                    \tmain rule r_Main = choose $c in {RED, GREEN} with $c != lamp do par lamp := $c if button then \
                    count := count + 1 endif endpar\ndefault init s0:\n\tfunction lamp = RED\n\tfunction count = 0\n";

fn lamp() -> groundstate::Loaded {
    let loaded = groundstate::load(SourceFile::new("Lamp.asm", LAMP), &mut NoFiles);
    loaded.unwrap_or_else(|faulty| panic!("{:?}", faulty.diagnostics))
}

#[test]
fn what_was_read_is_written_as_the_same_bytes() {
    let loaded = lamp();
    let inputs = Inputs::new().with(RandomSource::new(3, Default::default()));
    let options = Options { steps: Some(40), ..Options::default() };
    let mut run = Run::new(loaded.program.clone(), Limits::default(), inputs, options);
    let (wire, reader) =
        (Wire { program: &loaded.program, sources: &loaded.sources }, Reader { program: &loaded.program });
    let mut records = 0;
    while let Some(record) = run.advance() {
        let text = serde_json::to_string(&wire.record(&record, run.steps())).expect("it is written");
        let line: Line = serde_json::from_str(&text).expect("it is read");
        assert_eq!(serde_json::to_string(&line).expect("it is written"), text);
        let read = reader.record(&line).expect("it fits the model");
        if let (Record::Step(made), Record::Step(read)) = (&record, &read) {
            assert_eq!(
                (&made.inputs, made.changes.len(), made.updates),
                (&read.inputs, read.changes.len(), read.updates)
            );
        }
        records += 1;
        if let Record::End(end) = record {
            assert_eq!(end, End::Violation);
        }
    }
    assert!(records > 3, "{records} records");
}

/// Written by the first version; must not be changed.
const OLD: &[&str] = &[
    r#"{"type":"trace","version":1,"model":"Lamp","path":"Lamp.asm","source":"0123456789abcdef","seed":0,"steps":2,"invariants":"stop"}"#,
    r#"{"type":"state","values":{"count":"0","lamp":"RED"}}"#,
    r#"{"type":"step","step":1,"inputs":{"button":"true"},"choices":[{"at":"Lamp.asm:10:21","of":1,"index":0,"values":["GREEN"]}],"changes":{"count":{"from":"0","to":"1","by":"Lamp.asm:10:100"},"lamp":{"from":"RED","to":"GREEN","by":"Lamp.asm:10:80"}},"updates":2,"changed":true}"#,
    r#"{"type":"end","reason":"steps","steps":1}"#,
];

#[test]
fn old_traces_are_read() {
    let loaded = lamp();
    let reader = Reader { program: &loaded.program };
    let lines: Vec<Line> = OLD.iter().map(|line| serde_json::from_str(line).expect("it is a line")).collect();
    let header = Reader::header(&lines[0]).expect("it is a header");
    assert_eq!((header.model.as_str(), header.seed, header.steps), ("Lamp", Some(0), Some(2)));
    for line in &lines[1..] {
        reader.record(line).unwrap_or_else(|reason| panic!("{line:?}: {reason}"));
    }
}

#[test]
fn what_is_new_in_a_trace_is_passed_over() {
    let newer = OLD[3].replace("\"steps\":1", "\"steps\":1,\"unheard_of\":[1]");
    assert!(matches!(serde_json::from_str(&newer), Ok(Line::End(_))));
    assert!(matches!(serde_json::from_str(r#"{"type":"unheard-of","key":1}"#), Ok(Line::Other)));
}

#[test]
fn a_trace_of_another_version_is_refused() {
    let header = |version: u32| -> Result<Header, String> {
        let line = OLD[0].replace("\"version\":1", &format!("\"version\":{version}"));
        Reader::header(&serde_json::from_str(&line).expect("it is a line"))
    };
    assert!(header(VERSION).is_ok());
    let refused = header(VERSION + 1).expect_err("it is newer");
    assert_eq!(refused, "the trace has format version 2, this program reads version 1");
}
