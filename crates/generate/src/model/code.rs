//! An expression of C++ with what is known of it, and the ways of joining expressions.

use crate::model::interval::Interval;
use crate::model::types::Type;

/// Before the body of a lambda that is called on the spot: part of the code around it, whatever compilers estimate.
pub(crate) const CALLED: &str = "[&]() GROUNDSTATE_CALLED";

/// An expression of C++.
#[derive(Debug, Clone)]
pub(crate) struct Code {
    pub text: String,
    pub ty: Type,
    /// It is never undef; of a [`Type::Value`] always false.
    pub defined: bool,
    /// It neither faults nor asks anybody, so that it does not matter when it is evaluated.
    pub pure: bool,
    /// If it is an integer, it lies in here.
    pub range: Interval,
}

impl Code {
    pub fn defined(text: impl Into<String>, ty: Type) -> Code {
        Code { text: text.into(), ty, defined: ty != Type::Value, pure: false, range: Interval::ALL }
    }

    pub fn maybe(text: impl Into<String>, ty: Type) -> Code {
        Code { text: text.into(), ty, defined: false, pure: false, range: Interval::ALL }
    }

    pub fn value(text: impl Into<String>) -> Code {
        Code::maybe(text, Type::Value)
    }

    pub fn pure(self) -> Code {
        Code { pure: true, ..self }
    }

    /// `undef`, of no type yet.
    pub fn undef() -> Code {
        Code { text: "gs::Value{}".into(), ty: Type::Undef, defined: false, pure: true, range: Interval::EMPTY }
    }

    pub fn within(self, range: Interval) -> Code {
        Code { range, ..self }
    }

    /// The same where another integer stands beside it, which makes a literal one of 64 bits.
    pub fn beside(&self) -> &str {
        self.text.strip_prefix("std::int64_t{").and_then(|rest| rest.strip_suffix('}')).unwrap_or(&self.text)
    }
}

/// Expressions as a list of arguments.
pub(crate) fn listed(codes: &[Code]) -> String {
    codes.iter().map(|code| unwrapped(&code.text)).collect::<Vec<_>>().join(", ")
}

/// Two integers with an operator between; a literal is written without its type where the other one has it.
pub(crate) fn beside(left: &Code, symbol: &str, right: &Code) -> String {
    if left.beside() != left.text && right.beside() != right.text {
        return between(&left.text, symbol, &right.text);
    }
    between(left.beside(), symbol, right.beside())
}

/// An operator between two terms. Compilers warn of a term compared with itself where they see it.
pub(crate) fn between(left: &str, symbol: &str, right: &str) -> String {
    if left == right { format!("({left} {symbol} gs::itself({left}))") } else { format!("({left} {symbol} {right})") }
}

/// An expression after statements.
pub(crate) fn within(statements: &str, code: Code) -> Code {
    match statements {
        "" => code,
        _ => Code { text: format!("{CALLED} {{ {statements}return {}; }}()", code.text), pure: false, ..code },
    }
}

/// A text without the parentheses around it.
pub(crate) fn unwrapped(text: &str) -> &str {
    let Some(inner) = text.strip_prefix('(').and_then(|text| text.strip_suffix(')')) else { return text };
    let mut depth = 0;
    for letter in inner.chars() {
        match letter {
            '(' => depth += 1,
            ')' if depth == 0 => return text,
            ')' => depth -= 1,
            // A comma between operands would be one between arguments.
            ',' if depth == 0 => return text,
            '"' | '\'' => return text,
            _ => {}
        }
    }
    inner
}
