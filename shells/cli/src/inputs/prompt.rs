//! Inputs from whoever sits at the terminal: a prompt with the domain's values, history, completion, a step back, a look at
//! the state.
//!
//! INVARIANT: what Tab and the arrows offer is of the domain that is asked for.

use std::collections::BTreeMap;
use std::io::Write;
use std::sync::{Arc, Mutex};

use groundstate::simulate::{Ask, Signal, Source, expected, read_value};
use machine::{Show, Value};
use program::DomainId;
use rustyline::completion::Completer;
use rustyline::error::ReadlineError;
use rustyline::highlight::Highlighter;
use rustyline::hint::Hinter;
use rustyline::history::MemHistory;
use rustyline::validate::Validator;
use rustyline::{Behavior, Config, Context, Editor, Helper};

/// The prompt; the line editor is made when the first question comes.
#[derive(Default)]
pub struct Prompt {
    editor: Option<Editor<Words, MemHistory>>,
    signal: Option<Signal>,
    /// What was answered, by the domain that was asked for.
    answers: BTreeMap<DomainId, Vec<String>>,
    told: Told,
}

/// What can be looked at between two answers; whoever makes the steps keeps it up to date.
pub type Told = Arc<Mutex<Look>>;

/// The state before the step that is being made, and what the last step changed.
#[derive(Debug, Default)]
pub struct Look {
    pub state: String,
    pub updates: String,
}

const HELP: &str = "  :help     this text              :state  the state before this step
  :back     take a step back       :updates  what the last step changed
  :quit     end the run            Tab completes, arrow up recalls";
const FIRST: &str = "  :help tells what else can be typed; Tab completes, arrow up recalls";
const COMMANDS: [&str; 5] = [":help", ":state", ":updates", ":back", ":quit"];

/// Writes to the terminal; if it is gone, the next question says so.
fn say(text: &str) {
    let _ = writeln!(std::io::stderr(), "{text}");
}

impl Prompt {
    pub fn new(told: Told) -> Self {
        Prompt { told, ..Prompt::default() }
    }

    /// Answers a command; `false`: it is none that is answered here.
    fn look(&self, line: &str) -> bool {
        let look = self.told.lock().unwrap_or_else(std::sync::PoisonError::into_inner);
        match line {
            ":help" | ":h" | ":?" => say(HELP),
            ":state" | ":s" => say(look.state.trim_end()),
            ":updates" | ":u" if look.updates.is_empty() => say("  no step has been made"),
            ":updates" | ":u" => say(look.updates.trim_end()),
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

    fn stop(&mut self, signal: Signal) -> Result<Option<Value>, String> {
        self.signal = Some(signal);
        Err("no value was given at the prompt".to_string())
    }
}

impl Source for Prompt {
    fn input(&mut self, ask: &Ask<'_>) -> Result<Option<Value>, String> {
        if ask.clock {
            return Ok(None);
        }
        let values = values(ask);
        let question = question(ask, &values);
        let earlier = self.answers.get(&ask.codomain).cloned().unwrap_or_default();
        let editor = self.editor()?;
        editor.set_helper(Some(Words(values)));
        let _ = editor.clear_history();
        earlier.iter().for_each(|answer| _ = editor.add_history_entry(answer));
        loop {
            match self.editor()?.readline(&question) {
                Ok(line) => {
                    let line = line.trim();
                    match line {
                        "" => continue,
                        ":back" | ":b" => return self.stop(Signal::Back),
                        ":quit" | ":q" => return self.stop(Signal::Quit),
                        command if self.look(command) => continue,
                        command if command.starts_with(':') => {
                            say(&format!("  {command} is no command here\n{HELP}"));
                            continue;
                        }
                        _ => {}
                    }
                    match read_value(ask.program, ask.codomain, line) {
                        Ok(value) if ask.admits(&value) => {
                            let answers = self.answers.entry(ask.codomain).or_default();
                            if answers.last().is_none_or(|last| last != line) {
                                answers.push(line.to_string());
                            }
                            return Ok(Some(value));
                        }
                        Ok(_) => say(&format!("  {line} is not in {}", ask.program.domain(ask.codomain).name)),
                        Err(message) => say(&format!("  {message}")),
                    }
                }
                Err(ReadlineError::Eof | ReadlineError::Interrupted) => return self.stop(Signal::Quit),
                Err(error) => return Err(format!("the terminal cannot be read: {error}")),
            }
        }
    }

    fn signal(&mut self) -> Option<Signal> {
        self.signal.take()
    }
}

/// The values of a small domain.
fn values(ask: &Ask<'_>) -> Vec<String> {
    use program::DomainKind;
    let program = ask.program;
    if let Some(elements) = ask.carriers.get(ask.codomain) {
        return elements.iter().take(100).map(|value| value.show(program).to_string()).collect();
    }
    match &program.domain(ask.codomain).kind {
        DomainKind::Enum { literals } => literals.clone(),
        DomainKind::Basic(model::Basic::Boolean) => vec!["true".to_string(), "false".to_string()],
        _ => Vec::new(),
    }
}

/// LIMIT: of a larger domain only the first values are shown.
const SHOWN: usize = 12;

fn question(ask: &Ask<'_>, values: &[String]) -> String {
    let domain = &ask.program.domain(ask.codomain).name;
    let location = ask.location.show(ask.program);
    let choice = match values {
        [] => expected(ask.program, ask.codomain).unwrap_or_else(|| "a value".to_string()),
        _ if values.len() > SHOWN => format!("{}, …", values[..SHOWN].join(", ")),
        _ => values.join(", "),
    };
    format!("step {}: {location} ({domain}: {choice}) = ", ask.step)
}

/// Completes the names of values.
struct Words(Vec<String>);

impl Words {
    /// What goes on as begun. A command is offered where it can stand, at the begin, and once it is begun.
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
        let told = Told::default();
        let prompt = Prompt::new(Arc::clone(&told));
        assert!(prompt.look(":state") && prompt.look(":updates") && prompt.look(":help"));
        assert!(!prompt.look(":stat") && !prompt.look("true"));
    }
}
