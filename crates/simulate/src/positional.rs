//! The peer's environment file: one constant on each line, in the order in which the machine asks.
//!
//! Blank lines and what follows `#` do not count. The file has no names, so a value that does not fit what is asked
//! for ends the run with the line's number.

use machine::Value;

use crate::inputs::{Ask, Source};
use crate::read::read_value;

/// The lines, and how far they are used.
#[derive(Debug, Clone)]
pub struct Positional {
    name: String,
    lines: Vec<(u32, String)>,
    next: usize,
    /// Where each step began, to step back to.
    began: Vec<(u64, usize)>,
}

impl Positional {
    /// Takes the text of the file called `name`.
    pub fn new(name: &str, text: &str) -> Self {
        let numbered = text.lines().zip(1..);
        let lines = numbered
            .map(|(line, number)| (number, without_comment(line).trim().to_string()))
            .filter(|(_, line)| !line.is_empty())
            .collect();
        Positional { name: name.to_string(), lines, next: 0, began: Vec::new() }
    }
}

/// The text before a `#` outside quotes.
fn without_comment(line: &str) -> &str {
    let mut quoted = false;
    for (at, c) in line.char_indices() {
        match c {
            '"' => quoted = !quoted,
            '#' if !quoted => return &line[..at],
            _ => {}
        }
    }
    line
}

impl Source for Positional {
    fn input(&mut self, ask: &Ask<'_>) -> Result<Option<Value>, String> {
        if ask.clock {
            return Ok(None);
        }
        let Some((number, line)) = self.lines.get(self.next) else {
            let location = ask.location.show(ask.program);
            return Err(format!("{} has no more values: {location} is asked for in step {}", self.name, ask.step));
        };
        let value = read_value(ask.program, ask.codomain, line).map_err(|reason| {
            format!("{}, line {number}, for {}: {reason}", self.name, ask.location.show(ask.program))
        })?;
        self.next += 1;
        Ok(Some(value))
    }

    fn after_step(&mut self, step: u64, back: bool) {
        if back {
            while self.began.last().is_some_and(|(later, _)| *later >= step) {
                self.began.pop();
            }
            self.next = self.began.last().map_or(0, |(_, next)| *next);
        } else {
            self.began.push((step, self.next));
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn blank_lines_and_comments_do_not_count() {
        let file = Positional::new("x.env", "# inputs\ntrue # yes\n\n\"a # b\"\n");
        assert_eq!(file.lines, [(2, "true".to_string()), (4, "\"a # b\"".to_string())]);
    }
}
