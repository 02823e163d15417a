//! What a process writes, line by line, as a tab gets it: an object where a line is one, a text else.
//!
//! In: bytes. Out: values of a size that a browser can hold. A line is read whole, or it would be cut within an object. Of an object that is
//! too large, the run is shortened to its beginning and its end, and what is left out is told beside it (`omitted`); so a verdict
//! always comes through. INVARIANT: no text goes on that is a part of an object. LIMIT: bytes of a line that are read, bytes of one
//! that goes on, steps of a run.

use std::collections::BTreeMap;
use std::io::BufRead;
use std::ops::Range;

use serde_json::{Map, Value, json};

/// LIMIT: bytes of a line that goes on as it is.
const WHOLE: usize = 4 << 20;
/// LIMIT: bytes of a line that are read; of a longer one, only its beginning.
const READ: usize = 256 << 20;
/// LIMIT: steps at the beginning of a run that is too long, and at its end.
const STEPS: usize = 500;

/// Reads the next line, without its end. Out: how long it is, which may be more than was read; none at the end of all.
pub fn next(from: &mut impl BufRead, line: &mut Vec<u8>) -> Option<usize> {
    line.clear();
    let mut length = 0;
    loop {
        let Ok(part) = from.fill_buf() else { return None };
        if part.is_empty() {
            return (length > 0).then_some(length);
        }
        let end = part.iter().position(|byte| *byte == b'\n');
        let own = end.unwrap_or(part.len());
        line.extend_from_slice(&part[..own.min(READ.saturating_sub(line.len()))]);
        length += own + usize::from(end.is_some());
        from.consume(own + usize::from(end.is_some()));
        if end.is_some() {
            return Some(length);
        }
    }
}

/// What a tab gets of a line that has so many bytes.
pub fn said(line: &[u8], length: usize) -> Value {
    let line = line.strip_suffix(b"\r").unwrap_or(line);
    let left_out = |why: &str| Value::from(format!("a line of {} MB is left out: {why}", length.div_ceil(1_000_000)));
    let is_object = line.starts_with(b"{\"");
    if length <= WHOLE {
        return match serde_json::from_slice(line) {
            Ok(value) => value,
            Err(_) if is_object => left_out("it cannot be understood"),
            Err(_) => Value::from(String::from_utf8_lossy(line)),
        };
    }
    match is_object.then(|| shortened(line)) {
        Some(Some(value)) => value,
        Some(None) => left_out("it cannot be understood"),
        None => left_out("it is too long"),
    }
}

/// Whether an object says how a job came out: such a one goes on, however much was said before.
pub fn is_outcome(said: &Value) -> bool {
    matches!(
        said["type"].as_str(),
        Some("verdict" | "explored" | "summary" | "conformance" | "refinement" | "mutation")
    )
}

/// An object without what makes it large. What is missing at its end, because not all was read, is left out, too.
fn shortened(line: &[u8]) -> Option<Value> {
    let (mut kept, mut omitted) = (Map::new(), Map::new());
    for (name, value) in members(line) {
        let text = &line[value.clone()];
        if name == "trace" {
            let (run, left) = shortened_run(line, &value);
            omitted.extend(left.map(|left| (name.clone(), left)));
            kept.insert(name, Value::from(run));
        } else if text.len() <= WHOLE / 8 {
            kept.insert(name, serde_json::from_slice(text).ok()?);
        } else {
            omitted.insert(name, Value::Bool(true));
        }
    }
    if kept.is_empty() {
        return None;
    }
    kept.insert("omitted".to_string(), Value::from(omitted));
    let mut value = Value::from(kept);
    if value.to_string().len() > WHOLE {
        // A few steps are too large already.
        let here = value["trace"].as_array().map_or(0, Vec::len) as u64;
        let left = value["omitted"]["trace"]["steps"].as_u64().unwrap_or_default();
        value["trace"] = json!([]);
        value["omitted"]["trace"] = json!({ "after": 0, "steps": here + left });
    }
    (value.to_string().len() <= WHOLE).then_some(value)
}

/// The beginning and the end of a run, and how many steps after which one are left out, if some are. A step says what it changes: the first
/// one after those that are left out says what they have changed. Of a run whose end was not read, only the beginning is kept.
fn shortened_run(line: &[u8], run: &Range<usize>) -> (Vec<Value>, Option<Value>) {
    let steps = elements(line, run);
    let parsed = |span: &Range<usize>| serde_json::from_slice::<Value>(&line[span.clone()]).ok();
    // The object around it goes on behind a run that is whole.
    if run.end == line.len() {
        let first = &steps[..steps.len().min(STEPS)];
        let left = json!({ "after": first.len(), "steps": steps.len() - first.len() });
        return (first.iter().filter_map(parsed).collect(), Some(left));
    }
    if steps.len() <= 2 * STEPS {
        return (steps.iter().filter_map(parsed).collect(), None);
    }
    let (first, rest) = steps.split_at(STEPS);
    let (between, last) = rest.split_at(rest.len() - STEPS);
    let mut values: BTreeMap<String, Value> = BTreeMap::new();
    let mut set = |location: &Value, value: &Value| {
        location.as_str().map(|location| values.insert(location.to_string(), value.clone()));
    };
    for step in between.iter().filter_map(parsed) {
        step["values"].as_array().into_iter().flatten().for_each(|pair| set(&pair[0], &pair[1]));
        step["changes"].as_array().into_iter().flatten().for_each(|change| set(&change["location"], &change["to"]));
    }
    let mut run: Vec<Value> = first.iter().filter_map(parsed).collect();
    let mut last: Vec<Value> = last.iter().filter_map(parsed).collect();
    if let Some(step) = last.first_mut() {
        let own = step["values"].as_array().cloned().unwrap_or_default();
        let former = values.into_iter().map(|(location, value)| json!([location, value]));
        step["values"] = former.chain(own).collect();
    }
    run.extend(last);
    (run, Some(json!({ "after": STEPS, "steps": between.len() })))
}

/// The members of an object, those that are complete; of a run that is not, what there is of it.
fn members(line: &[u8]) -> Vec<(String, Range<usize>)> {
    let mut found = Vec::new();
    let mut at = blank(line, 1);
    while line.get(at) == Some(&b'"') {
        let Some(end) = value_end(line, at) else { break };
        let Ok(name) = serde_json::from_slice::<String>(&line[at..end]) else { break };
        let colon = blank(line, end);
        if line.get(colon) != Some(&b':') {
            break;
        }
        let begin = blank(line, colon + 1);
        let Some(end) = value_end(line, begin) else {
            if name == "trace" {
                found.push((name, begin..line.len()));
            }
            break;
        };
        found.push((name, begin..end));
        at = blank(line, end);
        if line.get(at) == Some(&b',') {
            at = blank(line, at + 1);
        }
    }
    found
}

/// The elements of an array, those that are complete.
fn elements(line: &[u8], array: &Range<usize>) -> Vec<Range<usize>> {
    let mut found = Vec::new();
    let mut at = blank(line, array.start + 1);
    while at < array.end && line[at] != b']' {
        let Some(end) = value_end(line, at).filter(|end| *end <= array.end) else { break };
        found.push(at..end);
        at = blank(line, end);
        if line.get(at) == Some(&b',') {
            at = blank(line, at + 1);
        }
    }
    found
}

/// Where what is no blank goes on.
fn blank(line: &[u8], at: usize) -> usize {
    line.iter().skip(at).position(|byte| !byte.is_ascii_whitespace()).map_or(line.len(), |blanks| at + blanks)
}

/// The end of the value that begins here; none if it is not complete.
fn value_end(line: &[u8], at: usize) -> Option<usize> {
    let (mut deep, mut at) = (0_usize, at);
    loop {
        match line.get(at)? {
            b'"' => at = text_end(line, at)?,
            b'{' | b'[' => (deep, at) = (deep + 1, at + 1),
            b'}' | b']' => (deep, at) = (deep.checked_sub(1)?, at + 1),
            byte if deep == 0 && !matches!(byte, b',' | b':') => {
                let is_over = |byte: &u8| matches!(byte, b',' | b'}' | b']') || byte.is_ascii_whitespace();
                return line[at..].iter().position(is_over).map(|length| at + length);
            }
            _ => at += 1,
        }
        if deep == 0 {
            return Some(at);
        }
    }
}

fn text_end(line: &[u8], quote: usize) -> Option<usize> {
    let mut at = quote + 1;
    loop {
        match line.get(at)? {
            b'"' => return Some(at + 1),
            b'\\' => at += 2,
            _ => at += 1,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A verdict whose run counts up to so many steps, as `verify` writes it.
    fn counted(steps: usize) -> String {
        let step = |at: usize| match at {
            0 => json!({ "step": 0, "values": [["x", "0"], ["]\"}", "{"]] }),
            _ => {
                json!({ "step": at, "changes": [{ "location": "x", "from": (at - 1).to_string(), "to": at.to_string(), "by": "C.asm:9:29" }] })
            }
        };
        let trace: Vec<Value> = (0..=steps).map(step).collect();
        json!({ "type": "verdict", "check": "a \"b\" [", "verdict": "violated", "trace": trace, "scenario": "step\n".repeat(steps) })
            .to_string()
    }

    #[test]
    fn a_verdict_comes_through_whatever_its_run() {
        let line = counted(9);
        assert_eq!(said(line.as_bytes(), line.len()), serde_json::from_str::<Value>(&line).expect("JSON"));
        let line = counted(120_000);
        assert!(line.len() > WHOLE);
        let value = said(line.as_bytes(), line.len());
        assert_eq!((&value["verdict"], &value["check"]), (&json!("violated"), &json!("a \"b\" [")));
        assert_eq!(value["omitted"], json!({ "scenario": true, "trace": { "after": 500, "steps": 119_001 } }));
        let trace = value["trace"].as_array().expect("steps");
        assert_eq!(trace.len(), 2 * STEPS);
        assert_eq!((&trace[499]["step"], &trace[500]["step"]), (&json!(499), &json!(119_501)));
        // What those between have changed.
        assert_eq!(trace[500]["values"], json!([["x", "119500"]]));
        assert_eq!(trace[999]["changes"][0]["to"], "120000");
        // One of which only the beginning was read: what was last is not known.
        let value = said(&line.as_bytes()[..line.len() / 2], line.len());
        assert_eq!((&value["type"], value["trace"].as_array().map(Vec::len)), (&json!("verdict"), Some(STEPS)));
        // Few steps, each too large.
        let large = "z".repeat(WHOLE / 3);
        let line =
            json!({ "type": "verdict", "verdict": "violated", "trace": [large, large, large, large] }).to_string();
        let value = said(line.as_bytes(), line.len());
        assert_eq!((&value["verdict"], &value["trace"]), (&json!("violated"), &json!([])));
        assert_eq!(value["omitted"], json!({ "trace": { "after": 0, "steps": 4 } }));
    }

    #[test]
    fn no_part_of_an_object_is_told_as_a_text() {
        let check = |line: &str, told: Value| assert_eq!(said(line.as_bytes(), line.len()), told, "{line}");
        check("words\r", json!("words"));
        check("{ } is no object", json!("{ } is no object"));
        check("{\"type\":\"verdict\",", json!("a line of 1 MB is left out: it cannot be understood"));
        let long = "x".repeat(WHOLE + 1);
        check(&long, json!("a line of 5 MB is left out: it is too long"));
        check(&format!("{{\"{long}"), json!("a line of 5 MB is left out: it cannot be understood"));
    }

    #[test]
    fn lines_are_read_whole() {
        let check = |text: &str, lines: &[&str]| {
            let (mut from, mut line, mut found) =
                (std::io::BufReader::with_capacity(3, text.as_bytes()), Vec::new(), Vec::new());
            while next(&mut from, &mut line).is_some() {
                found.push(String::from_utf8_lossy(&line).into_owned());
            }
            assert_eq!(found, lines, "{text:?}");
        };
        check("", &[]);
        check("one\n\nlong line\nlast", &["one", "", "long line", "last"]);
    }
}
