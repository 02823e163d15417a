//! What a line at the prompt asks for.
//!
//! In: a line. Out: a [`Wish`], or a sentence that says what to type instead. A line that begins with a colon is a command, and so is `?`;
//! anything else is the value of an input.

use groundstate::model::nearest;

/// See the module.
#[derive(Debug, PartialEq, Eq)]
pub enum Wish<'l> {
    /// Nothing was typed.
    Nothing,
    /// What can be typed here.
    Help,
    /// The state, or what a term is in it.
    State(&'l str),
    /// What the last step changed.
    Updates,
    /// This many steps.
    Run(u64),
    /// Steps until a term holds.
    Until(&'l str),
    /// How `:run` and `:until` answer.
    Inputs(How),
    /// A step back.
    Back,
    /// The run as a scenario.
    Save { path: &'l str, replaces: bool },
    /// The end of the run.
    Quit,
    /// A value.
    Value(&'l str),
}

/// How inputs are answered while nobody is asked.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum How {
    /// Each keeps the value that it was given last.
    Held,
    /// They are drawn, by the seed.
    Random,
}

/// The commands, as they are completed.
pub const COMMANDS: [&str; 9] = [":help", ":state", ":updates", ":run", ":until", ":inputs", ":back", ":save", ":quit"];

/// Reads a line.
///
/// # Errors
/// A sentence: it is no command, or one that lacks something.
pub fn wish(line: &str) -> Result<Wish<'_>, String> {
    let line = line.trim();
    if line.is_empty() {
        return Ok(Wish::Nothing);
    }
    if line == "?" {
        return Ok(Wish::Help);
    }
    if !line.starts_with(':') {
        return Ok(Wish::Value(line));
    }
    let (word, rest) = line.split_once(char::is_whitespace).unwrap_or((line, ""));
    let rest = rest.trim();
    let alone = |wish| match rest {
        "" => Ok(wish),
        _ => Err(format!("`{word}` stands alone: nothing comes after it")),
    };
    match word {
        ":help" | ":h" | ":?" => alone(Wish::Help),
        ":updates" | ":u" => alone(Wish::Updates),
        ":back" | ":b" | ":undo" => alone(Wish::Back),
        ":quit" | ":q" | ":exit" => alone(Wish::Quit),
        ":state" | ":s" => Ok(Wish::State(rest)),
        ":run" | ":r" => match (rest, rest.parse()) {
            ("", _) => Ok(Wish::Run(1)),
            (_, Ok(steps)) if steps > 0 => Ok(Wish::Run(steps)),
            _ => Err(format!("`{rest}` is no number of steps: write one from 1, as in `:run 10`")),
        },
        ":until" if rest.is_empty() => Err("say what is to hold, as in `:until count > 3`".to_string()),
        ":until" => Ok(Wish::Until(rest)),
        ":inputs" => match rest {
            "held" => Ok(Wish::Inputs(How::Held)),
            "random" => Ok(Wish::Inputs(How::Random)),
            _ => Err("write `:inputs held` or `:inputs random`".to_string()),
        },
        ":save" | ":save!" if rest.is_empty() => Err("say where to, as in `:save first.avalla`".to_string()),
        ":save" | ":save!" => Ok(Wish::Save { path: rest, replaces: word.ends_with('!') }),
        _ => match nearest(word, COMMANDS.into_iter().chain([":undo"])) {
            Some(meant) => Err(format!("`{word}` is not a command: did you mean `{meant}`?")),
            None => Err(format!("`{word}` is not a command: `?` lists them")),
        },
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lines_are_read() {
        assert_eq!(wish("  "), Ok(Wish::Nothing));
        assert_eq!(wish("?"), Ok(Wish::Help));
        assert_eq!(wish("OPENED"), Ok(Wish::Value("OPENED")));
        assert_eq!(wish(":state f(A, 1)"), Ok(Wish::State("f(A, 1)")));
        assert_eq!((wish(":run"), wish(":run 12")), (Ok(Wish::Run(1)), Ok(Wish::Run(12))));
        assert_eq!(wish(":until x > 3 and y"), Ok(Wish::Until("x > 3 and y")));
        assert_eq!(wish(":undo"), Ok(Wish::Back));
        assert_eq!(wish(":save! a b.avalla"), Ok(Wish::Save { path: "a b.avalla", replaces: true }));
    }

    #[test]
    fn what_is_wrong_is_told_with_what_was_meant() {
        let told = |line| wish(line).expect_err("it is wrong");
        assert_eq!(told(":stat"), "`:stat` is not a command: did you mean `:state`?");
        assert_eq!(told(":fly"), "`:fly` is not a command: `?` lists them");
        assert!(told(":run x").contains("`x` is no number of steps") && told(":run 0").contains("from 1"));
        assert!(told(":back 3").contains("stands alone"));
        assert!(told(":inputs maybe").contains(":inputs held"));
    }
}
