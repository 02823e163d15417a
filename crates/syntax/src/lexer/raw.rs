//! The regular layer of the lexer: what logos recognises without context.
//!
//! Longest match wins. Marks that other languages use as operators are one token, so that one fault can name the
//! AsmetaL operator. An unterminated comment, string or character is a token, too: up to the end of the file or line.

use crate::SyntaxKind::{self, *};
use logos::Logos;

#[derive(Logos, Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Raw {
    #[regex(r"[\s\u{FEFF}]+")]
    Whitespace,
    #[regex(r"//[^\r\n]*", allow_greedy = true)]
    LineComment,
    #[token("/*", block_comment)]
    BlockComment,

    #[regex(r"\$[_A-Za-z][_A-Za-z0-9]*")]
    Variable,
    #[regex(r"[_A-Za-z][_A-Za-z0-9]*", priority = 5)]
    Word,
    #[regex(r"[_\p{Alphabetic}][_\p{Alphabetic}\p{Nd}]*", priority = 2)]
    ForeignWord,
    #[regex(r"i([0-9]+(\.[0-9]+)?)?", priority = 10)]
    Imaginary,
    #[regex(r"[0-9]+")]
    Integer,
    #[regex(r"[0-9]+n")]
    Natural,
    #[regex(r"[0-9]+\.[0-9]+")]
    Real,
    #[regex(r#"'([^'\\\r\n]|\\[^\r\n])*'"#)]
    Char,
    #[regex(r#"'([^'\\\r\n]|\\[^\r\n])*"#)]
    OpenChar,
    #[regex(r#""([^"\\\r\n]|\\[^\r\n])*""#)]
    String,
    #[regex(r#""([^"\\\r\n]|\\[^\r\n])*"#)]
    OpenString,

    #[token("(")]
    LParen,
    #[token(")")]
    RParen,
    #[token("[")]
    LBracket,
    #[token("]")]
    RBracket,
    #[token("{")]
    LBrace,
    #[token("}")]
    RBrace,
    #[token(",")]
    Comma,
    #[token(":")]
    Colon,
    #[token(";")]
    Semicolon,
    #[token(".")]
    Dot,
    #[token("|")]
    Bar,
    #[token(":=")]
    Assign,
    #[token("->")]
    Arrow,
    #[token("=")]
    Eq,
    #[token("!=")]
    Neq,
    #[token("<")]
    Lt,
    #[token("<=")]
    Le,
    #[token(">")]
    Gt,
    #[token(">=")]
    Ge,
    #[token("+")]
    Plus,
    #[token("-")]
    Minus,
    #[token("*")]
    Star,
    #[token("/")]
    Slash,
    #[token("^")]
    Caret,

    #[token("==")]
    #[token("===")]
    #[token("!==")]
    #[token("&&")]
    #[token("&")]
    #[token("||")]
    #[token("!")]
    #[token("~")]
    #[token("%")]
    #[token("=>")]
    #[token("<=>")]
    #[token("**")]
    #[token("/\\")]
    #[token("\\/")]
    Foreign,
    #[regex(r"#[^\r\n]*", allow_greedy = true)]
    ForeignComment,
}

/// Takes a comment up to its end mark, or otherwise the rest of the file.
fn block_comment(lexer: &mut logos::Lexer<'_, Raw>) {
    let rest = lexer.remainder();
    lexer.bump(rest.find("*/").map_or(rest.len(), |at| at + 2));
}

impl Raw {
    /// The kind of a token that needs no context.
    pub(super) fn kind(self) -> SyntaxKind {
        match self {
            Raw::Whitespace => WHITESPACE,
            Raw::LineComment => LINE_COMMENT,
            Raw::BlockComment => BLOCK_COMMENT,
            Raw::Variable => VARIABLE,
            Raw::Word | Raw::ForeignWord => GENERIC_ID,
            Raw::Imaginary => COMPLEX,
            Raw::Integer => INTEGER,
            Raw::Natural => NATURAL,
            Raw::Real => REAL,
            Raw::Char | Raw::OpenChar => CHAR,
            Raw::String | Raw::OpenString => STRING,
            Raw::LParen => L_PAREN,
            Raw::RParen => R_PAREN,
            Raw::LBracket => L_BRACKET,
            Raw::RBracket => R_BRACKET,
            Raw::LBrace => L_BRACE,
            Raw::RBrace => R_BRACE,
            Raw::Comma => COMMA,
            Raw::Colon => COLON,
            Raw::Semicolon => SEMICOLON,
            Raw::Dot => DOT,
            Raw::Bar => BAR,
            Raw::Assign => ASSIGN,
            Raw::Arrow => ARROW,
            Raw::Eq => EQ,
            Raw::Neq => NEQ,
            Raw::Lt => LT,
            Raw::Le => LE,
            Raw::Gt => GT,
            Raw::Ge => GE,
            Raw::Plus => PLUS,
            Raw::Minus => MINUS,
            Raw::Star => STAR,
            Raw::Slash => SLASH,
            Raw::Caret => CARET,
            Raw::Foreign | Raw::ForeignComment => ERROR,
        }
    }
}
