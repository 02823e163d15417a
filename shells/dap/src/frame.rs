//! Messages of the protocol: a header with the length, an empty line, JSON.
//!
//! In: bytes. Out: messages. A text that is no JSON costs that message alone; a header that says no length ends the session, since
//! nobody knows where the next one begins. LIMIT: so many bytes of a message and of a header.

use std::io::{BufRead, Read, Write};

use serde_json::Value;

/// LIMIT: bytes of a message.
const BYTES: usize = 16 << 20;

/// LIMIT: bytes of a line of the header.
const LINE: u64 = 4096;

/// LIMIT: lines of a header.
const LINES: usize = 64;

/// What is wrong with what was read.
#[derive(Debug)]
pub enum Wrong {
    /// One message; a sentence.
    Content(String),
    /// All that follows; a sentence.
    Frame(String),
}

/// The next message; none at the end.
///
/// # Errors
/// It is no message.
pub fn read_message(input: &mut impl BufRead) -> Result<Option<Value>, Wrong> {
    let frame = |reason: String| Wrong::Frame(reason);
    let mut length = None;
    for read in 0..=LINES {
        let mut line = Vec::new();
        let of_line = input.by_ref().take(LINE).read_until(b'\n', &mut line);
        of_line.map_err(|error| frame(format!("a message cannot be read: {error}")))?;
        if line.is_empty() && read == 0 {
            return Ok(None);
        }
        if !line.ends_with(b"\n") || read == LINES {
            return Err(frame("a header has no end".to_string()));
        }
        let line = String::from_utf8_lossy(&line);
        let line = line.trim();
        if line.is_empty() {
            break;
        }
        if let Some((name, value)) = line.split_once(':')
            && name.trim().eq_ignore_ascii_case("content-length")
        {
            length = value.trim().parse::<usize>().ok();
        }
    }
    let Some(length) = length else { return Err(frame("a header has no Content-Length".to_string())) };
    if length > BYTES {
        return Err(frame(format!("a message of {length} bytes is too large")));
    }
    let mut text = vec![0; length];
    input.read_exact(&mut text).map_err(|_| frame("a message is shorter than its header says".to_string()))?;
    serde_json::from_slice(&text).map(Some).map_err(|error| Wrong::Content(format!("a message is no JSON: {error}")))
}

/// Writes a message.
///
/// # Errors
/// Nobody reads.
pub fn write_message(output: &mut dyn Write, message: &Value) -> std::io::Result<()> {
    let text = message.to_string();
    write!(output, "Content-Length: {}\r\n\r\n{text}", text.len())?;
    output.flush()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn frames_are_told_apart() {
        let read = |text: &str| match read_message(&mut text.as_bytes()) {
            Ok(Some(value)) => value.to_string(),
            Ok(None) => "end".to_string(),
            Err(Wrong::Content(_)) => "content".to_string(),
            Err(Wrong::Frame(_)) => "frame".to_string(),
        };
        assert_eq!(read("Content-Length: 2\r\n\r\n{}"), "{}");
        assert_eq!(read("X: y\r\ncontent-length: 2\n\n[]"), "[]");
        assert_eq!(read(""), "end");
        assert_eq!(read("Content-Length: 1\r\n\r\n{"), "content");
        assert_eq!(read("Content-Length: 9\r\n\r\n{}"), "frame");
        assert_eq!(read("Content-Length: -9\r\n\r\n{}"), "frame");
        assert_eq!(read("Content-Length: 99999999999\r\n\r\n{}"), "frame");
        assert_eq!(read(&"x".repeat(10_000)), "frame");
        assert_eq!(read(&"x: y\r\n".repeat(10_000)), "frame");
        assert_eq!(read("\r\n"), "frame");
    }
}
