//! Faults of the lexer: characters that make no token, and literals that do not end.
//!
//! In: the place, and the text there. Out: a diagnostic that names what to write instead. For operators of other
//! languages that is the operator of AsmetaL (see [`replacement`]).

use crate::{Diagnostic, Span};

/// The AsmetaL spelling of an operator of other languages or of mathematics.
pub(crate) fn replacement(operator: &str) -> Option<&'static str> {
    Some(match operator {
        "==" | "===" => "=",
        "!==" | "≠" | "<>" => "!=",
        "&&" | "&" | "/\\" | "∧" => "and",
        "||" | "\\/" | "∨" => "or",
        "!" | "~" | "¬" => "not",
        "%" => "mod",
        "=>" | "->" | "⇒" | "→" => "implies",
        "<=>" | "⇔" | "↔" => "iff",
        "**" => "^",
        "≤" => "<=",
        "≥" => ">=",
        "∈" => "in",
        "∉" => "notin",
        "∀" => "forall",
        "∃" => "exists",
        "×" | "·" => "*",
        "÷" => "/",
        "−" | "–" => "-",
        _ => return None,
    })
}

/// An operator of another language.
pub(crate) fn foreign_operator(span: Span, operator: &str) -> Diagnostic {
    let ours = replacement(operator).unwrap_or("=");
    Diagnostic::error("foreign-operator", span, format!("`{operator}` is no operator of AsmetaL"))
        .here(format!("written `{ours}` in AsmetaL"))
        .with_help(format!("write `{ours}`"))
}

/// A character that starts no token.
pub(crate) fn unknown_character(span: Span, text: &str) -> Diagnostic {
    if replacement(text).is_some() {
        return foreign_operator(span, text);
    }
    let letter = text.chars().next().unwrap_or('?');
    let shown = match letter {
        c if c.is_control() => format!("the control character U+{:04X}", c as u32),
        '\u{FFFD}' => "a byte that is not UTF-8".to_string(),
        c => format!("the character `{c}`"),
    };
    let help = match letter {
        '“' | '”' | '„' | '«' | '»' => "write a string between straight quotes, \"like this\"",
        '‘' | '’' | '`' => "write a character between straight quotes, 'a'",
        '$' => "a variable is `$` and then a name that starts with a letter or an underscore, as `$x`",
        '#' => "a comment starts with `//`",
        '@' => "remove it; AsmetaL has no annotations",
        '?' => "write `if … then … else … endif` for a choice between two terms",
        '\\' => "remove it; a path with backslashes stands only behind `import`",
        '\u{FFFD}' => "save the file as UTF-8",
        _ => "remove it; outside comments and strings only ASCII is read",
    };
    Diagnostic::error("unknown-character", span, format!("{shown} has no meaning here")).with_help(help)
}

/// A name with a letter beyond ASCII.
pub(crate) fn foreign_letter(span: Span, name: &str) -> Diagnostic {
    let letter = name.chars().find(|letter| !letter.is_ascii()).unwrap_or('?');
    Diagnostic::error("unknown-character", span, format!("the letter `{letter}` cannot stand in a name"))
        .here("a name holds the letters a–z and A–Z, digits and `_`")
        .with_help("rename it with ASCII letters")
}

/// `/*` without `*/`.
pub(crate) fn unterminated_comment(span: Span) -> Diagnostic {
    Diagnostic::error("unterminated-comment", span, "this comment has no end")
        .here("opened here, and the rest of the file is in it")
        .with_help("close it with `*/`; comments do not nest")
}

/// A string that does not end on its line.
pub(crate) fn unterminated_string(span: Span) -> Diagnostic {
    Diagnostic::error("unterminated-string", span, "this string has no end")
        .here("a string ends with `\"` on the line where it starts")
        .with_help("close it with `\"`; write `\\n` for a line end and `\\\"` for a quote within it")
}

/// A character literal that does not end on its line.
pub(crate) fn unterminated_character(span: Span) -> Diagnostic {
    Diagnostic::error("unterminated-character", span, "this character literal has no end")
        .here("it ends with `'` on the line where it starts")
        .with_help("close it with `'`, as in `'a'` or `'\\n'`; a text of several characters stands in \"…\"")
}

/// A backslash with a letter that is not an escape.
pub(crate) fn unknown_escape(span: Span, letter: char) -> Diagnostic {
    Diagnostic::error("unknown-escape", span, format!("`\\{letter}` is no escape"))
        .here(r#"the escapes are \n \t \b \r \f \\ \' \" , \ and one to three octal digits, and \uXXXX"#)
        .with_help(format!("write `\\\\{letter}` for a backslash followed by `{letter}`"))
}

/// `1.5e3`
pub(crate) fn exponent(span: Span, text: &str) -> Diagnostic {
    Diagnostic::error("number-form", span, format!("`{text}` has an exponent"))
        .here("a number is digits, and for a real also a point and digits")
        .with_help("write all digits, as in `1500.0`")
}
