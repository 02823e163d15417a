//! The command line of one command: options with a value, flags, and the rest in order.
//!
//! In: the words after the command's name. Out: what each option was given. An option that was not asked for is a
//! fault, so that a misspelt one is never ignored.

use crate::Failure;

/// The words of a command, taken apart.
#[derive(Debug)]
pub struct Arguments {
    options: Vec<(String, String)>,
    flags: Vec<String>,
    /// The words that belong to no option.
    pub rest: Vec<String>,
}

impl Arguments {
    /// Takes the words apart; `options` are followed by a value, `flags` stand alone.
    ///
    /// # Errors
    /// An unknown option, or one without its value.
    pub fn read(words: &[String], options: &[&str], flags: &[&str]) -> Result<Arguments, Failure> {
        let mut read = Arguments { options: Vec::new(), flags: Vec::new(), rest: Vec::new() };
        let mut words = words.iter();
        while let Some(word) = words.next() {
            if options.contains(&word.as_str()) {
                let value = words.next().ok_or_else(|| format!("`{word}` needs a value"))?;
                read.options.push((word.clone(), value.clone()));
            } else if flags.contains(&word.as_str()) {
                read.flags.push(word.clone());
            } else if word.starts_with('-') && word.len() > 1 {
                return Err(format!("there is no option `{word}` here"));
            } else {
                read.rest.push(word.clone());
            }
        }
        Ok(read)
    }

    /// The value of an option; the last one counts.
    pub fn option(&self, name: &str) -> Option<&str> {
        self.options.iter().rev().find(|(option, _)| option == name).map(|(_, value)| value.as_str())
    }

    /// The value of an option as a number.
    ///
    /// # Errors
    /// It is none.
    pub fn number(&self, name: &str, default: u64) -> Result<u64, Failure> {
        match self.option(name) {
            Some(value) => value.parse().map_err(|_| format!("`{name}` takes a number, not `{value}`")),
            None => Ok(default),
        }
    }

    /// Whether a flag is set.
    pub fn flag(&self, name: &str) -> bool {
        self.flags.iter().any(|flag| flag == name)
    }
}
