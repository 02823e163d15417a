//! The lines of a trace whose steps may still be taken back.
//!
//! INVARIANT: a step that was taken back leaves no line.

use crate::Line;

/// Collects the lines.
#[derive(Debug, Default)]
pub struct Kept(Vec<Line>);

impl Kept {
    /// Adds a line. A [`Line::Back`] removes what came from its step on.
    pub fn add(&mut self, line: Line) {
        match line {
            Line::Back { step } => {
                let is_undone = |line: &Line| match line {
                    Line::Step(made) | Line::Attempt(made) => made.step >= step,
                    Line::End(_) => true,
                    _ => false,
                };
                while self.0.last().is_some_and(is_undone) {
                    self.0.pop();
                }
            }
            line => self.0.push(line),
        }
    }

    /// The remaining lines.
    pub fn into_lines(self) -> Vec<Line> {
        self.0
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_step_taken_back_leaves_no_line() {
        let line = |text: &str| serde_json::from_str::<Line>(text).expect("a line");
        let mut kept = Kept::default();
        kept.add(line(r#"{"type":"state","values":{}}"#));
        // No step has been made yet.
        kept.add(Line::Back { step: 1 });
        kept.add(line(r#"{"type":"step","step":1}"#));
        kept.add(line(r#"{"type":"step","step":2}"#));
        kept.add(line(r#"{"type":"attempt","step":3}"#));
        kept.add(line(r#"{"type":"end","reason":"violation","steps":2}"#));
        kept.add(Line::Back { step: 2 });
        let left: Vec<String> =
            kept.into_lines().iter().map(|line| serde_json::to_string(line).expect("it is JSON")).collect();
        assert_eq!(left, [r#"{"type":"state","values":{}}"#, r#"{"type":"step","step":1}"#]);
    }
}
