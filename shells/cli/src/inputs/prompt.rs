//! Asks for inputs at the terminal: a prompt with the domain's values, history, completion, steps back, a look at the
//! state.
//!
//! INVARIANT: Tab and the arrows offer only values of the requested domain.

use std::collections::BTreeMap;
use std::io::Write;

use groundstate::job::Command;
use groundstate::simulate::{expected, read_value};
use machine::{Location, Show, Value};
use program::{DomainId, Program};
use rustyline::completion::Completer;
use rustyline::error::ReadlineError;
use rustyline::highlight::Highlighter;
use rustyline::hint::Hinter;
use rustyline::history::MemHistory;
use rustyline::validate::Validator;
use rustyline::{Behavior, Config, Context, Editor, Helper};

/// The prompt. The line editor is created at the first question.
#[derive(Default)]
pub struct Prompt {
    editor: Option<Editor<Words, MemHistory>>,
    /// Earlier answers, by domain.
    answers: BTreeMap<DomainId, Vec<String>>,
    /// The last answer, and whether it was new in the history of its domain.
    last: Option<(DomainId, String, bool)>,
    /// The state before the step that is being made.
    pub state: String,
    /// What the last step changed.
    pub updates: String,
}

/// A requested input.
#[derive(Debug, Clone)]
pub struct Question {
    pub step: u64,
    pub location: Location,
    pub domain: DomainId,
    /// The first of its values, if they are known.
    pub values: Vec<Value>,
}

const HELP: &str = "  :help     this text              :state  the state before this step
  :back     take a step back       :updates  what the last step changed
  :quit     end the run            Tab completes, arrow up recalls";
const FIRST: &str = "  :help lists the commands; Tab completes, arrow up recalls";
const COMMANDS: [&str; 5] = [":help", ":state", ":updates", ":back", ":quit"];

/// Writes to the terminal; if it is gone, the next question reports that.
fn say(text: &str) {
    let _ = writeln!(std::io::stderr(), "{text}");
}

impl Prompt {
    /// Carries out a command that only shows something; returns `false` for any other.
    fn look(&self, line: &str) -> bool {
        match line {
            ":help" | ":h" | ":?" => say(HELP),
            ":state" | ":s" => say(self.state.trim_end()),
            ":updates" | ":u" if self.updates.is_empty() => say("  no step has been made"),
            ":updates" | ":u" => say(self.updates.trim_end()),
            _ => return false,
        }
        true
    }

    fn editor(&mut self) -> Result<&mut Editor<Words, MemHistory>, String> {
        if self.editor.is_none() {
            let config = Config::builder().behavior(Behavior::PreferTerm).build();
            let editor = Editor::with_history(config, MemHistory::new())
                .map_err(|error| format!("there is no terminal to ask at: {error}"))?;
            say(FIRST);
            self.editor = Some(editor);
        }
        self.editor.as_mut().ok_or_else(|| "there is no terminal to ask at".to_string())
    }

    /// Asks until there is a command for the run.
    pub fn ask(&mut self, program: &Program, question: &Question) -> Command {
        self.answer(program, question).unwrap_or_else(Command::Withhold)
    }

    fn answer(&mut self, program: &Program, question: &Question) -> Result<Command, String> {
        let values: Vec<String> = question.values.iter().map(|value| value.show(program).to_string()).collect();
        let words = wording(program, question, &values);
        let earlier = self.answers.get(&question.domain).cloned().unwrap_or_default();
        let editor = self.editor()?;
        editor.set_helper(Some(Words(values)));
        let _ = editor.clear_history();
        earlier.iter().for_each(|answer| _ = editor.add_history_entry(answer));
        loop {
            match self.editor()?.readline(&words) {
                Ok(line) => {
                    let line = line.trim();
                    match line {
                        "" => continue,
                        ":back" | ":b" => return Ok(Command::Back),
                        ":quit" | ":q" => return Ok(Command::Stop),
                        command if self.look(command) => continue,
                        command if command.starts_with(':') => {
                            say(&format!("  {command} is not a command\n{HELP}"));
                            continue;
                        }
                        _ => {}
                    }
                    match read_value(program, question.domain, line) {
                        Ok(value) => {
                            self.remember(question.domain, line);
                            return Ok(Command::Answer(value));
                        }
                        Err(message) => say(&format!("  {message}")),
                    }
                }
                Err(ReadlineError::Eof | ReadlineError::Interrupted) => return Ok(Command::Stop),
                Err(error) => return Err(format!("the terminal cannot be read: {error}")),
            }
        }
    }

    fn remember(&mut self, domain: DomainId, line: &str) {
        let answers = self.answers.entry(domain).or_default();
        let is_new = answers.last().is_none_or(|last| last != line);
        if is_new {
            answers.push(line.to_string());
        }
        self.last = Some((domain, line.to_string(), is_new));
    }

    /// The run refused the last answer: says why, and forgets it.
    pub fn refused(&mut self, program: &Program) {
        let Some((domain, line, is_new)) = self.last.take() else { return };
        say(&format!("  {line} is not in {}", program.domain(domain).name));
        if is_new {
            self.answers.entry(domain).or_default().pop();
        }
    }
}

/// LIMIT: of a larger domain only the first values are shown.
const SHOWN: usize = 12;

fn wording(program: &Program, question: &Question, values: &[String]) -> String {
    let domain = &program.domain(question.domain).name;
    let location = question.location.show(program);
    let choice = match values {
        [] => expected(program, question.domain).unwrap_or_else(|| "a value".to_string()),
        _ if values.len() > SHOWN => format!("{}, …", values[..SHOWN].join(", ")),
        _ => values.join(", "),
    };
    format!("step {}: {location} ({domain}: {choice}) = ", question.step)
}

/// Completes the names of values.
struct Words(Vec<String>);

impl Words {
    /// The completions of what was typed. Commands are offered only at the beginning, after a colon.
    fn fitting(&self, begun: &str, at_begin: bool) -> Vec<String> {
        let commands = COMMANDS.iter().filter(|_| at_begin && begun.starts_with(':'));
        let words = self.0.iter().map(String::as_str).chain(commands.copied());
        words.filter(|word| word.starts_with(begun)).map(str::to_string).collect()
    }
}

impl Completer for Words {
    type Candidate = String;

    fn complete(&self, line: &str, at: usize, _context: &Context<'_>) -> rustyline::Result<(usize, Vec<String>)> {
        let start = line[..at].rfind(|c: char| !(c.is_alphanumeric() || c == '_' || c == ':')).map_or(0, |i| i + 1);
        let begun = &line[start..at];
        Ok((start, self.fitting(begun, start == 0)))
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
        let words = Words(vec!["OPENED".to_string(), "OPENING".to_string(), "CLOSED".to_string()]);
        assert_eq!(words.fitting("OPEN", true), ["OPENED", "OPENING"]);
        assert_eq!(words.fitting("", true), ["OPENED", "OPENING", "CLOSED"]);
        assert_eq!(words.fitting(":", true), COMMANDS);
        assert!(words.fitting(":", false).is_empty());
    }

    #[test]
    fn the_state_can_be_looked_at() {
        let prompt = Prompt::default();
        assert!(prompt.look(":state") && prompt.look(":updates") && prompt.look(":help"));
        assert!(!prompt.look(":stat") && !prompt.look("true"));
    }

    #[test]
    fn what_was_refused_is_not_recalled() {
        let domain = DomainId(0);
        let mut prompt = Prompt::default();
        prompt.remember(domain, "1");
        prompt.remember(domain, "1");
        assert_eq!(prompt.last.as_ref().map(|last| last.2), Some(false));
        assert_eq!(prompt.answers[&domain], ["1"]);
    }
}
