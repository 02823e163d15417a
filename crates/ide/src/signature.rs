//! The parameters of the call that an offset is in.
//!
//! In: a file and an offset. Out: the signatures of the rule or function that is called, and which parameter is being written.
//! Tokens alone decide, so that a call may be incomplete.

use groundstate::workspace::Files;
use syntax::{SyntaxKind, SyntaxToken};

use crate::analysis::previous;
use crate::hover;
use crate::project::Project;

/// A signature with its parameters.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Signature {
    /// All of it.
    pub label: String,
    /// The bytes of each parameter in the label.
    pub parameters: Vec<(u32, u32)>,
}

/// The signatures of what is called, and which parameter stands at the offset.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Signatures {
    /// All overloads.
    pub signatures: Vec<Signature>,
    /// The first that has so many parameters.
    pub active: usize,
    /// The parameter, from 0.
    pub parameter: usize,
}

/// The call around an offset.
pub fn signatures<F: Files>(project: &mut Project<F>, path: &str, offset: u32) -> Option<Signatures> {
    let analysis = project.analysis(path).ok()?;
    let tree = analysis.tree()?;
    let offset = offset.min(tree.text_range().end().into());
    let left = tree.token_at_offset(offset.into()).left_biased()?;
    let (name, parameter) = call_before(&left)?;
    let model = &analysis.model;
    let signatures: Vec<Signature> = match name.kind() {
        SyntaxKind::RULE_ID => {
            let rules = model.names.rules(name.text()).iter().map(|id| model.rule(*id));
            rules
                .map(|rule| labelled(&hover::rule_signature(&analysis, rule), &hover::parameters(&analysis, rule)))
                .collect()
        }
        _ => {
            let of = |id: &model::FunctionId| {
                let parameters = &model.function(*id).parameters;
                let parts: Vec<String> = parameters.iter().map(|domain| model.domains.display(*domain)).collect();
                labelled(&hover::signature(&analysis, *id), &parts)
            };
            model.names.functions(name.text()).iter().map(of).collect()
        }
    };
    let active = signatures.iter().position(|signature| signature.parameters.len() > parameter).unwrap_or(0);
    (!signatures.is_empty()).then_some(Signatures { signatures, active, parameter })
}

fn labelled(label: &str, parts: &[String]) -> Signature {
    let mut at = label.find(['(', ':']).unwrap_or(0);
    let mut parameters = Vec::new();
    for part in parts {
        let Some(found) = label[at..].find(part.as_str()) else { break };
        let start = at + found;
        at = start + part.len();
        parameters.push((start as u32, at as u32));
    }
    Signature { label: label.to_string(), parameters }
}

/// The name before the bracket that is open at a token, and how many commas stand between them.
pub(crate) fn call_before(from: &SyntaxToken) -> Option<(SyntaxToken, usize)> {
    let mut at = from.clone();
    let (mut depth, mut commas) = (0usize, 0);
    loop {
        match at.kind() {
            SyntaxKind::R_PAREN | SyntaxKind::R_BRACKET | SyntaxKind::R_BRACE => depth += 1,
            SyntaxKind::L_PAREN | SyntaxKind::L_BRACKET if depth == 0 => {
                let name = previous(&at)?;
                let called = matches!(name.kind(), SyntaxKind::FUNCTION_ID | SyntaxKind::RULE_ID);
                return called.then_some((name, commas));
            }
            SyntaxKind::L_BRACE if depth == 0 => return None,
            SyntaxKind::L_PAREN | SyntaxKind::L_BRACKET | SyntaxKind::L_BRACE => depth -= 1,
            SyntaxKind::COMMA if depth == 0 => commas += 1,
            SyntaxKind::ASSIGN | SyntaxKind::RULE_KW | SyntaxKind::SEMICOLON => return None,
            _ => {}
        }
        at = previous(&at)?;
    }
}
