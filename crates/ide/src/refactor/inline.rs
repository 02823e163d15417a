//! A macro rule written in the place of its calls, with the arguments in the place of the parameters.
//!
//! In: a model, and the token under the cursor: the name of a rule where it is called or declared. Out: the edits; nothing where a
//! variable would be caught by another of its name, where a number would change its form, or where the text would read
//! otherwise. A turbo rule is atomic and its arguments are values, so it is never inlined.

use model::{Basic, Call, DomainKind, Referent, RuleKind, TermKind};
use syntax::ast::{self, AstNode};
use syntax::{Span, SyntaxKind, SyntaxNode, SyntaxToken};

use super::{Candidate, RefactoringKind, bytes, has_comment, is_target, meanings, moved, tokens_in};
use crate::analysis::Analysis;
use crate::layout::indentation;
use crate::position::Edit;

/// A macro rule of the file.
struct Macro {
    body: SyntaxNode,
    /// Where its parameters are declared, and their names.
    parameters: Vec<(Span, String)>,
    /// The names that its body binds.
    bound: Vec<String>,
}

/// Writes the rule that a token names in the place of its calls.
pub(super) fn inline(analysis: &Analysis, token: &SyntaxToken) -> Vec<Candidate> {
    candidates(analysis, token).unwrap_or_default()
}

fn candidates(analysis: &Analysis, token: &SyntaxToken) -> Option<Vec<Candidate>> {
    if token.kind() != SyntaxKind::RULE_ID {
        return None;
    }
    let parent = token.parent()?;
    let [name] = analysis.names_at(token.text_range().start().into()) else { return None };
    let rule = name.referent;
    let called = macro_of(analysis, rule)?;
    let tree = analysis.tree()?;
    let calls: Vec<SyntaxNode> = analysis
        .names
        .iter()
        .filter(|name| name.referent == rule)
        .filter_map(|name| tree.token_at_offset(name.span.start.into()).right_biased()?.parent())
        .filter(|node| node.kind() == SyntaxKind::MACRO_CALL_RULE)
        .collect();
    let title = token.text();
    let mut found = Vec::new();
    if parent.kind() == SyntaxKind::MACRO_CALL_RULE {
        found.extend(inlined(analysis, &called, std::slice::from_ref(&parent), format!("Inline `{title}` here")));
    }
    if calls.len() > 1 || (calls.len() == 1 && parent.kind() == SyntaxKind::RULE_DECL) {
        found.extend(inlined(analysis, &called, &calls, format!("Inline `{title}` wherever this file calls it")));
    }
    Some(found)
}

fn macro_of(analysis: &Analysis, referent: Referent) -> Option<Macro> {
    let Referent::Rule(id) = referent else { return None };
    let rule = analysis.model.rule(id);
    if rule.turbo || rule.span.file != analysis.file {
        return None;
    }
    let token = analysis.tree()?.token_at_offset(rule.span.start.into()).right_biased()?;
    let declaration = token.parent().and_then(ast::RuleDecl::cast)?;
    let body = declaration.body()?.syntax().clone();
    let within = bytes(&body);
    let inside = |at: u32| within.0 <= at && at < within.1;
    let mut parameters = Vec::new();
    for parameter in declaration.parameters().into_iter().flat_map(|list| list.parameters()) {
        let variable = parameter.variable()?;
        parameters.push((Span::new(analysis.file, variable.text_range()), variable.text().to_string()));
    }
    let binds = |name: &&model::Use| name.declares && inside(name.span.start);
    let bound =
        analysis.names.iter().filter(binds).map(|name| analysis.text()[name.span.range()].to_string()).collect();
    let has_locals = body.descendants().any(|node| node.kind() == SyntaxKind::LOCAL_RULE);
    (!has_locals).then_some(Macro { body, parameters, bound })
}

fn inlined(analysis: &Analysis, called: &Macro, calls: &[SyntaxNode], title: String) -> Option<Candidate> {
    let mut names = meanings(analysis, |_| true);
    let mut edits = Vec::new();
    for call in calls {
        edits.push(in_place(analysis, called, call, &mut names)?);
    }
    Some(Candidate::new(title, RefactoringKind::Inline, edits).naming(names))
}

/// The body in the place of one call; `names` becomes what is named then.
fn in_place(analysis: &Analysis, called: &Macro, call: &SyntaxNode, names: &mut Vec<Referent>) -> Option<Edit> {
    let tree = analysis.tree()?;
    let (start, end) = bytes(call);
    let arguments: Vec<SyntaxNode> =
        ast::MacroCallRule::cast(call.clone())?.arguments()?.terms().map(|term| term.syntax().clone()).collect();
    if has_comment(&tree, (start, end)) || arguments.len() != called.parameters.len() {
        return None;
    }
    let body = bytes(&called.body);
    if body.0 <= start && end <= body.1 {
        return None;
    }
    keeps_forms(analysis, call, &arguments)?;
    catches_nothing(analysis, called, call, &arguments)?;
    let follows = std::iter::successors(call.last_token()?.next_token(), SyntaxToken::next_token);
    if follows
        .into_iter()
        .find(|token| !token.kind().is_trivia())
        .is_some_and(|token| token.kind() == SyntaxKind::IFNONE_KW)
        && ends_in_choose(&called.body)
    {
        return None;
    }
    let mut uses: Vec<(u32, usize)> = Vec::new();
    for token in tokens_in(&tree, body).filter(|token| token.kind() == SyntaxKind::VARIABLE) {
        let at = u32::from(token.text_range().start());
        let [name] = analysis.names_at(at) else { return None };
        let bound = analysis.declaration(name.referent)?;
        match called.parameters.iter().position(|(span, _)| *span == bound) {
            Some(index) => {
                admits(&token, &arguments[index])?;
                uses.push((at, index));
            }
            None if is_target(&token) => return None,
            None => {}
        }
    }
    let written = |token: &SyntaxToken| {
        let at = u32::from(token.text_range().start());
        let (_, index) = uses.iter().find(|(place, _)| *place == at)?;
        let argument = arguments[*index].text().to_string();
        let bare = matches!(
            token.parent()?.parent()?.kind(),
            SyntaxKind::ARGUMENT_LIST | SyntaxKind::UPDATE_RULE | SyntaxKind::CONDITIONAL_BRANCH | SyntaxKind::BINDING
        );
        let composed = matches!(arguments[*index].kind(), SyntaxKind::BINARY_TERM | SyntaxKind::UNARY_TERM);
        Some(if composed && !bare { format!("({argument})") } else { argument })
    };
    let of = |range: (u32, u32)| meanings(analysis, |at| range.0 <= at && at < range.1);
    for gone in of((start, end)) {
        names.remove(names.iter().position(|name| *name == gone)?);
    }
    names.extend(of(body));
    uses.iter().for_each(|(_, index)| names.extend(of(bytes(&arguments[*index]))));
    let text = analysis.text();
    let text = moved(&tree, body, (indentation(text, body.0), indentation(text, start)), &written);
    Some(Edit::new(start..end, text))
}

/// No argument is a number that the call takes to another form: put in, it would be taken for what it is.
fn keeps_forms(analysis: &Analysis, call: &SyntaxNode, written: &[SyntaxNode]) -> Option<()> {
    let checked = checked_call(analysis, call)?;
    let formals = &analysis.model.rule(checked.rule).parameters;
    let variables = &analysis.model.rule(checked.rule).variables;
    for ((argument, written), formal) in checked.arguments.iter().zip(written).zip(formals) {
        let formal = variables[formal.0 as usize].domain;
        let domains = &analysis.model.domains;
        let number = match domains.kind(domains.type_domain(formal)) {
            DomainKind::Basic(basic @ (Basic::Natural | Basic::Integer | Basic::Real | Basic::Complex)) => Some(*basic),
            _ => None,
        };
        let same = match argument.kind {
            TermKind::Coerce(_) | TermKind::Error | TermKind::Unbound(_) => false,
            // A literal is taken to the parameter's domain without a sign of it.
            _ if number.is_some() && written.kind() == SyntaxKind::LITERAL_TERM => {
                let whole = matches!(written.first_token()?.kind(), SyntaxKind::INTEGER | SyntaxKind::NATURAL);
                whole == matches!(number, Some(Basic::Integer | Basic::Natural))
            }
            _ => true,
        };
        if !same {
            return None;
        }
    }
    Some(())
}

fn checked_call<'a>(analysis: &'a Analysis, call: &SyntaxNode) -> Option<&'a Call> {
    let (start, end) = bytes(call);
    let mut found = None;
    for rule in analysis.model.rules.iter().filter(|rule| rule.span.file == analysis.file) {
        rule.body.walk(&mut |node| {
            if let RuleKind::MacroCall(call) = &node.kind
                && (node.span.file, node.span.start, node.span.end) == (analysis.file, start, end)
            {
                found = Some(call);
            }
        });
    }
    found
}

/// No variable of an argument has the name of one that the body binds, and the body binds none that the call stands in the scope of.
fn catches_nothing(analysis: &Analysis, called: &Macro, call: &SyntaxNode, arguments: &[SyntaxNode]) -> Option<()> {
    for argument in arguments {
        let mut variables = argument.descendants_with_tokens().filter_map(|element| element.into_token());
        if variables
            .any(|token| token.kind() == SyntaxKind::VARIABLE && called.bound.iter().any(|name| name == token.text()))
        {
            return None;
        }
    }
    let (start, end) = bytes(call);
    let declaration = call.ancestors().find(|node| node.kind() == SyntaxKind::RULE_DECL)?;
    let within = bytes(&declaration);
    for name in
        analysis.names.iter().filter(|name| name.declares && within.0 <= name.span.start && name.span.end <= within.1)
    {
        if !called.bound.iter().any(|bound| *bound == analysis.text()[name.span.range()]) {
            continue;
        }
        let binder = analysis.tree()?.token_at_offset(name.span.start.into()).right_biased()?;
        let part = |node: &SyntaxNode| {
            use SyntaxKind::{BINDER, BINDING, PARAMETER, PARAMETER_LIST};
            matches!(node.kind(), BINDER | BINDING | PARAMETER | PARAMETER_LIST)
        };
        let scope = bytes(&binder.parent_ancestors().find(|node| !part(node))?);
        if scope.0 <= start && end <= scope.1 {
            return None;
        }
    }
    Some(())
}

/// Whether an argument can stand where a parameter stands.
fn admits(token: &SyntaxToken, argument: &SyntaxNode) -> Option<()> {
    let term = token.parent().filter(|term| term.kind() == SyntaxKind::VARIABLE_TERM)?;
    let fits = match term.parent()?.kind() {
        SyntaxKind::UPDATE_RULE | SyntaxKind::RETURN_RULE if is_target(token) => {
            argument.kind() == SyntaxKind::FUNCTION_TERM
        }
        SyntaxKind::TERM_RULE => {
            matches!(argument.kind(), SyntaxKind::FUNCTION_TERM | SyntaxKind::VARIABLE_TERM)
        }
        _ => true,
    };
    fits.then_some(())
}

/// Whether `ifnone` behind a rule would belong to a `choose` in it.
fn ends_in_choose(body: &SyntaxNode) -> bool {
    let open = |choose: &ast::ChooseRule| choose.if_none().is_none() && bytes(choose.syntax()).1 == bytes(body).1;
    body.descendants().filter_map(ast::ChooseRule::cast).any(|choose| open(&choose))
}
