//! Inputs from whoever sits at the terminal: a prompt with the domain's values, history, completion, a step back.

use groundstate::simulate::{Ask, Signal, Source, expected, read_value};
use machine::{Show, Value};
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
}

const HELP: &str = "  :back  take the last step back    :quit  end the run    Tab completes, arrow up recalls";

impl Prompt {
    pub fn new() -> Self {
        Prompt::default()
    }

    fn editor(&mut self) -> Result<&mut Editor<Words, MemHistory>, String> {
        if self.editor.is_none() {
            let config = Config::builder().behavior(Behavior::PreferTerm).build();
            let editor = Editor::with_history(config, MemHistory::new())
                .map_err(|error| format!("there is no terminal to ask at: {error}"))?;
            eprintln!("{HELP}");
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
        loop {
            let editor = self.editor()?;
            editor.set_helper(Some(Words(values.clone())));
            match editor.readline(&question) {
                Ok(line) => {
                    let line = line.trim();
                    match line {
                        "" => continue,
                        ":back" | ":b" => return self.stop(Signal::Back),
                        ":quit" | ":q" => return self.stop(Signal::Quit),
                        ":help" | ":h" | ":?" => {
                            eprintln!("{HELP}");
                            continue;
                        }
                        _ => {}
                    }
                    let _ = editor.add_history_entry(line);
                    match read_value(ask.program, ask.codomain, line) {
                        Ok(value) if ask.admits(&value) => return Ok(Some(value)),
                        Ok(_) => eprintln!("  {line} is not in {}", ask.program.domain(ask.codomain).name),
                        Err(message) => eprintln!("  {message}"),
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

impl Completer for Words {
    type Candidate = String;

    fn complete(&self, line: &str, at: usize, _context: &Context<'_>) -> rustyline::Result<(usize, Vec<String>)> {
        let start = line[..at].rfind(|c: char| !(c.is_alphanumeric() || c == '_' || c == ':')).map_or(0, |i| i + 1);
        let begun = &line[start..at];
        let commands = [":back", ":quit", ":help"].map(String::from);
        let all = self.0.iter().chain(&commands);
        Ok((start, all.filter(|word| word.starts_with(begun)).cloned().collect()))
    }
}

impl Hinter for Words {
    type Hint = String;
}
impl Highlighter for Words {}
impl Validator for Words {}
impl Helper for Words {}
