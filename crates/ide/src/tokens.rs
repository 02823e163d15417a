//! What each token of a file is, for an editor's colours.
//!
//! In: an [`Analysis`]. Out: tokens with their kinds, in order. What a name means decides, not its shape alone;
//! a name that means nothing is coloured by its shape.

use groundstate::workspace::Files;
use model::{DomainKind, FunctionKind, Referent};
use syntax::{SyntaxKind, SyntaxToken};

use crate::analysis::{Analysis, Role};
use crate::project::Project;

/// What a token is.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum TokenKind {
    /// A comment.
    Comment,
    /// A keyword.
    Keyword,
    /// An operator.
    Operator,
    /// A number.
    Number,
    /// A string, a character, a path.
    String,
    /// A domain.
    Domain,
    /// An enum domain.
    Enum,
    /// An enum literal.
    Literal,
    /// A function; monitored, controlled, … by its modifier.
    Function,
    /// A macro rule.
    Rule,
    /// A turbo rule.
    TurboRule,
    /// A logical variable.
    Variable,
    /// The name of a machine, a scenario, a block, a shape, a property.
    Label,
}

/// What else a token is.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Modifier {
    /// It is declared here.
    Declaration,
    /// It is updated here.
    Modification,
    /// It is of a library that is built in.
    Library,
    /// A kind of function.
    Kind(FunctionKind),
}

/// A token of the file.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Coloured {
    /// Its bytes.
    pub range: (u32, u32),
    /// What it is.
    pub kind: TokenKind,
    /// What else it is.
    pub modifiers: Vec<Modifier>,
}

/// The tokens of a file, in order.
pub fn tokens<F: Files>(project: &mut Project<F>, path: &str) -> Vec<Coloured> {
    let Ok(analysis) = project.analysis(path) else { return Vec::new() };
    let Some(tree) = analysis.tree() else { return Vec::new() };
    let all = tree.descendants_with_tokens().filter_map(|element| element.into_token());
    all.filter_map(|token| coloured(&analysis, &token)).collect()
}

fn coloured(analysis: &Analysis, token: &SyntaxToken) -> Option<Coloured> {
    let range = (token.text_range().start().into(), token.text_range().end().into());
    let by_shape = by_shape(token)?;
    let is_name = token.text().starts_with(|c: char| c.is_ascii_alphabetic() || c == '$');
    let name = is_name.then(|| analysis.names_at(range.0).first().filter(|name| name.span.start == range.0)).flatten();
    let Some(name) = name else { return Some(Coloured { range, kind: by_shape, modifiers: Vec::new() }) };
    let model = &analysis.model;
    let mut modifiers = Vec::new();
    let kind = match name.referent {
        Referent::Domain(id) => match model.domains.kind(id) {
            DomainKind::Enum { .. } => TokenKind::Enum,
            _ => TokenKind::Domain,
        },
        Referent::Literal(..) => TokenKind::Literal,
        Referent::Function(id) => {
            let function = model.function(id);
            modifiers.push(Modifier::Kind(function.kind));
            if function.library {
                modifiers.push(Modifier::Library);
            }
            // `and`, `mod` and their like are operators by their place.
            match token.parent().map(|parent| parent.kind()) {
                Some(SyntaxKind::BINARY_TERM | SyntaxKind::UNARY_TERM) => TokenKind::Operator,
                _ => TokenKind::Function,
            }
        }
        Referent::Rule(id) if model.rule(id).turbo => TokenKind::TurboRule,
        Referent::Rule(_) => TokenKind::Rule,
        Referent::Variable(..) => TokenKind::Variable,
    };
    match analysis.role(name) {
        Role::Declaration => modifiers.push(Modifier::Declaration),
        Role::Write => modifiers.push(Modifier::Modification),
        Role::Definition | Role::Call | Role::Read => {}
    }
    Some(Coloured { range, kind, modifiers })
}

fn by_shape(token: &SyntaxToken) -> Option<TokenKind> {
    use SyntaxKind::*;
    Some(match token.kind() {
        WHITESPACE | ERROR | EOF | L_PAREN | R_PAREN | L_BRACKET | R_BRACKET | L_BRACE | R_BRACE | COMMA | COLON
        | SEMICOLON | DOT | BAR => return None,
        LINE_COMMENT | BLOCK_COMMENT => TokenKind::Comment,
        VARIABLE => TokenKind::Variable,
        ENUM_ID => TokenKind::Literal,
        DOMAIN_ID => TokenKind::Domain,
        RULE_ID => TokenKind::Rule,
        FUNCTION_ID => match token.parent().map(|parent| parent.kind()) {
            Some(BINARY_TERM | UNARY_TERM) => TokenKind::Operator,
            _ => TokenKind::Function,
        },
        INVARIANT_ID | CTL_ID | LTL_ID | GENERIC_ID => TokenKind::Label,
        MODULE_REF | CHAR | STRING => TokenKind::String,
        INTEGER | NATURAL | REAL | COMPLEX => TokenKind::Number,
        ASSIGN | ARROW | RETURN_ARROW | EQ | NEQ | LT | LE | GT | GE | PLUS | MINUS | STAR | SLASH | CARET => {
            TokenKind::Operator
        }
        PROD_KW | SEQ_DOMAIN_KW | POWERSET_KW | BAG_KW | MAP_KW | RULE_DOMAIN_KW => TokenKind::Domain,
        _ => TokenKind::Keyword,
    })
}
