//! A C++ expression with facts about it, and functions that combine expressions.

use crate::model::interval::Interval;
use crate::model::types::Type;

/// Precedes the body of a lambda that is called on the spot: forces inlining, whatever the compiler estimates.
pub(crate) const CALLED: &str = "[&]() GROUNDSTATE_CALLED";

/// An expression of C++.
#[derive(Debug, Clone)]
pub(crate) struct Code {
    pub text: String,
    pub ty: Type,
    /// Whether it is never undef; for a [`Type::Value`] always false.
    pub defined: bool,
    /// Whether it neither faults nor asks the environment, so that it may be evaluated at any time.
    pub pure: bool,
    /// An interval that contains it, if it is an integer.
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

    /// `undef`, without a type yet.
    pub fn undef() -> Code {
        Code { text: "gs::Value{}".into(), ty: Type::Undef, defined: false, pure: true, range: Interval::EMPTY }
    }

    pub fn within(self, range: Interval) -> Code {
        Code { range, ..self }
    }

    /// The expression as an operand beside another 64-bit integer, so that a literal needs no type.
    pub fn beside(&self) -> &str {
        self.text.strip_prefix("std::int64_t{").and_then(|rest| rest.strip_suffix('}')).unwrap_or(&self.text)
    }
}

/// Expressions as a list of arguments.
pub(crate) fn listed(codes: &[Code]) -> String {
    codes.iter().map(|code| unwrapped(&code.text)).collect::<Vec<_>>().join(", ")
}

/// Two integers with an operator between them; a literal is written without its type if the other operand has it.
pub(crate) fn beside(left: &Code, symbol: &str, right: &Code) -> String {
    if left.beside() != left.text && right.beside() != right.text {
        return between(&left.text, symbol, &right.text);
    }
    between(left.beside(), symbol, right.beside())
}

/// An operator between two terms, written so that compilers do not warn of a term compared with itself.
pub(crate) fn between(left: &str, symbol: &str, right: &str) -> String {
    if left == right { format!("({left} {symbol} gs::itself({left}))") } else { format!("({left} {symbol} {right})") }
}

/// An expression preceded by statements.
pub(crate) fn within(statements: &str, code: Code) -> Code {
    match statements {
        "" => code,
        _ => Code { text: format!("{CALLED} {{ {statements}return {}; }}()", code.text), pure: false, ..code },
    }
}

/// A text without the parentheses that enclose it.
pub(crate) fn unwrapped(text: &str) -> &str {
    let Some(inner) = text.strip_prefix('(').and_then(|text| text.strip_suffix(')')) else { return text };
    let mut depth = 0;
    for letter in inner.chars() {
        match letter {
            '(' => depth += 1,
            ')' if depth == 0 => return text,
            ')' => depth -= 1,
            // A comma between operands would become one between arguments.
            ',' if depth == 0 => return text,
            '"' | '\'' => return text,
            _ => {}
        }
    }
    inner
}
