//! Constants: reads the value and the domain from the text of a token.
//!
//! In: a literal token. Out: the constant, or a reported fault. Escapes are decoded here and nowhere else.

use std::iter::Peekable;
use std::str::Chars;

use syntax::ast;
use syntax::{Span, SyntaxKind, SyntaxToken};

use super::body::{Body, error_term};
use crate::domain::Domains;
use crate::fault;
use crate::id::DomainId;
use crate::term::{Literal, Term, TermKind};

impl Body<'_> {
    /// A written constant.
    pub(crate) fn literal(&mut self, literal: &ast::LiteralTerm, span: Span) -> Term {
        let Some(token) = literal.token() else { return error_term(span) };
        match self.constant(&token, span) {
            Some((literal, domain)) => Term { kind: TermKind::Literal(literal), domain, span },
            None => error_term(span),
        }
    }

    fn constant(&mut self, token: &SyntaxToken, span: Span) -> Option<(Literal, DomainId)> {
        let text = token.text();
        Some(match token.kind() {
            SyntaxKind::UNDEF_KW => (Literal::Undef, Domains::UNDEF),
            SyntaxKind::TRUE_KW => (Literal::Boolean(true), Domains::BOOLEAN),
            SyntaxKind::FALSE_KW => (Literal::Boolean(false), Domains::BOOLEAN),
            SyntaxKind::INTEGER => (Literal::Integer(self.integer(text, span)?), Domains::INTEGER),
            SyntaxKind::NATURAL => {
                (Literal::Integer(self.integer(text.trim_end_matches('n'), span)?), Domains::NATURAL)
            }
            SyntaxKind::REAL => (Literal::Real(self.real(text, span)?), Domains::REAL),
            SyntaxKind::COMPLEX => {
                let (re, im) = self.complex(text, span)?;
                (Literal::Complex(re, im), Domains::COMPLEX)
            }
            SyntaxKind::STRING => (Literal::String(unescape(inner(text, '"'))), Domains::STRING),
            SyntaxKind::CHAR => {
                let value = unescape(inner(text, '\''));
                let mut letters = value.chars();
                match (letters.next(), letters.next()) {
                    (Some(letter), None) => (Literal::Char(letter), Domains::CHAR),
                    _ => {
                        self.site.faults.push(fault::term::malformed_character(span, text));
                        return None;
                    }
                }
            }
            _ => return None,
        })
    }

    fn integer(&mut self, text: &str, span: Span) -> Option<i64> {
        let value = text.parse().ok();
        if value.is_none() {
            let limit = format!("integers go up to {}", i64::MAX);
            self.site.faults.push(fault::term::number_too_large(span, text, &limit));
        }
        value
    }

    fn real(&mut self, text: &str, span: Span) -> Option<f64> {
        let value = text.parse().ok().filter(|value: &f64| value.is_finite());
        if value.is_none() {
            self.site.faults.push(fault::term::number_too_large(span, text, "reals are 64-bit floating-point numbers"));
        }
        value
    }

    /// `[num] [sign] i [num]`: the real part, and the imaginary part, which is 1 if there is no number.
    fn complex(&mut self, text: &str, span: Span) -> Option<(f64, f64)> {
        let (real, imaginary) = text.split_once('i')?;
        let (real, sign) = match real.strip_suffix('-') {
            Some(real) => (real, -1.0),
            None => (real.strip_suffix('+').unwrap_or(real), 1.0),
        };
        let mut part = |text: &str, absent| if text.is_empty() { Some(absent) } else { self.real(text, span) };
        Some((part(real, 0.0)?, sign * part(imaginary, 1.0)?))
    }
}

fn inner(text: &str, quote: char) -> &str {
    let text = text.strip_prefix(quote).unwrap_or(text);
    text.strip_suffix(quote).unwrap_or(text)
}

/// Decodes `\n`, `\t`, …, one to three octal digits, and `\uXXXX`: a unit of UTF-16, of which two may make a character.
fn unescape(text: &str) -> String {
    let mut value = String::with_capacity(text.len());
    let mut letters = text.chars().peekable();
    while let Some(letter) = letters.next() {
        if letter != '\\' {
            value.push(letter);
            continue;
        }
        match letters.next() {
            Some('n') => value.push('\n'),
            Some('t') => value.push('\t'),
            Some('b') => value.push('\u{8}'),
            Some('r') => value.push('\r'),
            Some('f') => value.push('\u{c}'),
            Some(digit @ '0'..='7') => {
                let mut code = digit.to_digit(8).unwrap_or(0);
                let most = if digit <= '3' { 2 } else { 1 };
                for _ in 0..most {
                    let Some(next) = letters.peek().and_then(|letter| letter.to_digit(8)) else { break };
                    code = code * 8 + next;
                    letters.next();
                }
                value.push(char::from_u32(code).unwrap_or('\u{fffd}'));
            }
            Some('u') => {
                let mut units = vec![hexadecimal(&mut letters)];
                let is_high = (0xd800..0xdc00).contains(&units[0]);
                let mut ahead = letters.clone();
                if is_high && ahead.next() == Some('\\') && ahead.next() == Some('u') {
                    units.push(hexadecimal(&mut ahead));
                    if (0xdc00..0xe000).contains(&units[1]) {
                        letters = ahead;
                    } else {
                        units.pop();
                    }
                }
                value.push_str(&String::from_utf16_lossy(&units));
            }
            Some(other) => value.push(other),
            None => value.push('\\'),
        }
    }
    value
}

/// The number of four hexadecimal digits, as the lexer has found them.
fn hexadecimal(letters: &mut Peekable<Chars<'_>>) -> u16 {
    let mut number = 0;
    for _ in 0..4 {
        let Some(digit) = letters.peek().and_then(|letter| letter.to_digit(16)) else { break };
        number = number * 16 + digit as u16;
        letters.next();
    }
    number
}

#[cfg(test)]
mod tests {
    use super::unescape;

    #[test]
    fn escapes() {
        assert_eq!(unescape(r#"a\tb\\\"\101\7"#), "a\tb\\\"A\u{7}");
        assert_eq!(unescape(r"\400"), " 0");
        assert_eq!(unescape(r"\u00e9\u0041b"), "\u{e9}Ab");
        assert_eq!(unescape(r"\ud83d\ude00!"), "\u{1f600}!");
        assert_eq!(unescape(r"\ud83d\u0041"), "\u{fffd}A");
    }
}
