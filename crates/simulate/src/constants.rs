//! Inputs that are the same in every step: `--set passed=true`.

use std::collections::BTreeMap;

use machine::{Location, Value};
use program::{FunctionKind, Program};

use crate::inputs::{Ask, Source};
use crate::read::{read_location, read_value};

/// Values by location.
#[derive(Debug, Clone, Default)]
pub struct Constants {
    values: BTreeMap<Location, Value>,
    shared: Vec<(Location, Value)>,
}

impl Constants {
    /// Adds `location=value`.
    ///
    /// # Errors
    /// A sentence for the user: no such input, or no such value.
    pub fn set(&mut self, program: &Program, text: &str) -> Result<(), String> {
        let (location, value) =
            split(text).ok_or_else(|| format!("`{text}` is not of the form location=value, such as passed=true"))?;
        let location = read_input(program, location)?;
        let function = program.function(location.function);
        let value = read_value(program, function.codomain, value)?;
        if function.kind == FunctionKind::Shared {
            self.shared.push((location.clone(), value.clone()));
        }
        self.values.insert(location, value);
        Ok(())
    }
}

/// At the first `=` outside parentheses and quotes.
pub(crate) fn split(text: &str) -> Option<(&str, &str)> {
    let mut depth = 0;
    let mut quoted = false;
    for (at, c) in text.char_indices() {
        match c {
            '"' => quoted = !quoted,
            '(' if !quoted => depth += 1,
            ')' if !quoted => depth -= 1,
            '=' if !quoted && depth == 0 => return Some((&text[..at], text[at + 1..].trim_start_matches('='))),
            _ => {}
        }
    }
    None
}

/// A location that the environment may write.
pub(crate) fn read_input(program: &Program, text: &str) -> Result<Location, String> {
    let location = read_location(program, text)?;
    let function = program.function(location.function);
    match function.kind {
        FunctionKind::Monitored | FunctionKind::Shared => Ok(location),
        _ => Err(format!(
            "`{}` is written by the machine: only monitored and shared functions take inputs",
            function.name
        )),
    }
}

impl Source for Constants {
    fn input(&mut self, ask: &Ask<'_>) -> Result<Option<Value>, String> {
        Ok(self.values.get(&ask.location.to_location()).cloned())
    }

    fn has_writes(&self) -> bool {
        !self.shared.is_empty()
    }

    fn writes(&mut self, _step: u64) -> Vec<(Location, Value)> {
        self.shared.clone()
    }
}

#[cfg(test)]
mod tests {
    use super::split;

    #[test]
    fn splits_at_the_first_equals_sign_outside() {
        assert_eq!(split("passed=true"), Some(("passed", "true")));
        assert_eq!(split("f(\"a=b\")=1"), Some(("f(\"a=b\")", "1")));
        assert_eq!(split("passed"), None);
    }
}
