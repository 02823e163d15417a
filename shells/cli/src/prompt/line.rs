//! Reads lines at the prompt: at a terminal with completion and history, elsewhere as they come.
//!
//! In: the words that fit, and earlier answers for the domain. Out: a line; none where there are no more. What is piped in is shown after
//! the prompt, so that the output reads like that of a terminal. INVARIANT: Tab and the arrows offer only values of the requested domain.

use std::collections::BTreeMap;
use std::io::{BufRead, IsTerminal, Write};

use program::DomainId;
use rustyline::completion::Completer;
use rustyline::error::ReadlineError;
use rustyline::highlight::Highlighter;
use rustyline::hint::Hinter;
use rustyline::history::MemHistory;
use rustyline::validate::Validator;
use rustyline::{Behavior, Config, Context, Editor, Helper};

use super::command::COMMANDS;

const FIRST: &str = "  ? says what can be typed; Tab completes, arrow up recalls";

/// Reads lines. The line editor is created at the first question.
#[derive(Default)]
pub struct Lines {
    editor: Option<Editor<Words, MemHistory>>,
    /// Earlier answers, by domain.
    answers: BTreeMap<DomainId, Vec<String>>,
    /// The last answer, and whether it was new in the history of its domain.
    last: Option<(DomainId, String, bool)>,
}

/// Writes to the terminal; if it is gone, the next question reports that.
pub fn say(text: &str) {
    let _ = writeln!(std::io::stderr(), "{text}");
}

impl Lines {
    /// The next line; none at the end of what is typed.
    ///
    /// # Errors
    /// A sentence: there is no terminal, or it cannot be read.
    pub fn read(&mut self, prompt: &str, domain: Option<DomainId>, words: Words) -> Result<Option<String>, String> {
        if !std::io::stdin().is_terminal() {
            return piped(prompt);
        }
        let earlier = domain.and_then(|domain| self.answers.get(&domain)).cloned().unwrap_or_default();
        let editor = match &mut self.editor {
            Some(editor) => editor,
            none => {
                let config = Config::builder().behavior(Behavior::PreferTerm).build();
                let editor = Editor::with_history(config, MemHistory::new())
                    .map_err(|error| format!("there is no terminal to ask at: {error}"))?;
                say(FIRST);
                none.insert(editor)
            }
        };
        editor.set_helper(Some(words));
        let _ = editor.clear_history();
        earlier.iter().for_each(|answer| _ = editor.add_history_entry(answer));
        match editor.readline(prompt) {
            Ok(line) => Ok(Some(line)),
            Err(ReadlineError::Eof | ReadlineError::Interrupted) => Ok(None),
            Err(error) => Err(format!("the terminal cannot be read: {error}")),
        }
    }

    /// This was the answer for an input of this domain.
    pub fn remember(&mut self, domain: DomainId, line: &str) {
        let answers = self.answers.entry(domain).or_default();
        let is_new = answers.last().is_none_or(|last| last != line);
        if is_new {
            answers.push(line.to_string());
        }
        self.last = Some((domain, line.to_string(), is_new));
    }

    /// The last answer was refused.
    pub fn forget(&mut self) {
        if let Some((domain, _, true)) = self.last.take() {
            self.answers.entry(domain).or_default().pop();
        }
    }
}

/// LIMIT: bytes of a line that is piped in.
const LONGEST: u64 = 1 << 20;

fn piped(prompt: &str) -> Result<Option<String>, String> {
    let mut bytes = Vec::new();
    let mut input = std::io::Read::take(std::io::stdin().lock(), LONGEST);
    input.read_until(b'\n', &mut bytes).map_err(|error| format!("the standard input cannot be read: {error}"))?;
    let line = String::from_utf8(bytes).map_err(|_| "the standard input is not UTF-8".to_string())?;
    if line.is_empty() {
        return Ok(None);
    }
    let line = line.trim_end_matches(['\n', '\r']);
    say(&format!("{prompt}{line}"));
    Ok(Some(line.to_string()))
}

/// What Tab completes.
#[derive(Debug, Default)]
pub struct Words {
    /// Values of the input that is asked for.
    pub values: Vec<String>,
    /// Names that terms are made of.
    pub names: Vec<String>,
}

impl Words {
    /// The completions of what was typed after `before`. Commands are offered only at the beginning, after a colon.
    fn fitting(&self, before: &str, begun: &str) -> Vec<String> {
        let command = before.split_whitespace().next().unwrap_or_default();
        match command {
            _ if before.is_empty() && begun.starts_with(':') => fit(COMMANDS.into_iter(), begun),
            ":state" | ":s" | ":until" => fit(self.names.iter().map(String::as_str), begun),
            ":inputs" => fit(["held", "random"].into_iter(), begun),
            _ if command.starts_with(':') => Vec::new(),
            _ => fit(self.values.iter().map(String::as_str), begun),
        }
    }
}

fn fit<'w>(words: impl Iterator<Item = &'w str>, begun: &str) -> Vec<String> {
    words.filter(|word| word.starts_with(begun)).map(str::to_string).collect()
}

impl Completer for Words {
    type Candidate = String;

    fn complete(&self, line: &str, at: usize, _context: &Context<'_>) -> rustyline::Result<(usize, Vec<String>)> {
        let start = line[..at].rfind(|c: char| !(c.is_alphanumeric() || c == '_' || c == ':')).map_or(0, |i| i + 1);
        Ok((start, self.fitting(&line[..start], &line[start..at])))
    }
}

impl Hinter for Words {
    type Hint = String;
}
impl Highlighter for Words {}
impl Validator for Words {}
impl Helper for Words {}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_offered_fits_the_question() {
        let values = ["OPENED", "OPENING", "CLOSED"].map(str::to_string).to_vec();
        let words = Words { values, names: vec!["door".to_string()] };
        assert_eq!(words.fitting("", "OPEN"), ["OPENED", "OPENING"]);
        assert_eq!(words.fitting("", ""), ["OPENED", "OPENING", "CLOSED"]);
        assert_eq!(words.fitting("", ":"), COMMANDS);
        assert!(words.fitting("(", ":").is_empty());
        assert_eq!(words.fitting(":until ", "do"), ["door"]);
        assert_eq!(words.fitting(":inputs ", ""), ["held", "random"]);
        assert!(words.fitting(":run ", "").is_empty());
    }

    #[test]
    fn what_was_refused_is_not_recalled() {
        let domain = DomainId(0);
        let mut lines = Lines::default();
        lines.remember(domain, "1");
        lines.remember(domain, "1");
        assert_eq!(lines.last.as_ref().map(|last| last.2), Some(false));
        assert_eq!(lines.answers[&domain], ["1"]);
        lines.remember(domain, "2");
        lines.forget();
        assert_eq!(lines.answers[&domain], ["1"]);
    }
}
