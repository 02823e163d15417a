//! `par` around rules, and no `par` around those that stand in one already.
//!
//! In: a model, and rules or the keyword of a `par`. Out: the edits. All rules of a `par` give one set of updates, so how they are
//! grouped makes no difference.

use syntax::{SyntaxKind, SyntaxNode, SyntaxToken};

use super::{Candidate, RefactoringKind, bytes, is_rule, level, meanings, moved};
use crate::analysis::Analysis;
use crate::fix::line_end;
use crate::layout::indentation;
use crate::position::Edit;

/// Puts the chosen rules in a `par` of their own: one rule, or some of the rules of a `par`.
pub(super) fn wrap(analysis: &Analysis, rules: &[SyntaxNode]) -> Option<Candidate> {
    let (first, last) = (rules.first()?, rules.last()?);
    let around = first.parent()?;
    let all = around.children().filter(is_rule).count();
    let title = match rules {
        [_] => "Wrap in `par`".to_string(),
        _ if around.kind() == SyntaxKind::PAR_RULE && rules.len() < all => {
            format!("Split `par`: put these {} rules in one of their own", rules.len())
        }
        _ => return None,
    };
    let (start, end) = (bytes(first).0, bytes(last).1);
    let text = analysis.text();
    let own = indentation(text, start);
    let inner = format!("{own}{}", level(text));
    let body = moved(&analysis.tree()?, (start, end), (own, &inner), &|_| None);
    let line = line_end(analysis);
    let edits = vec![Edit::new(start..end, format!("par{line}{inner}{body}{line}{own}endpar"))];
    Some(Candidate::new(title, RefactoringKind::Rewrite, edits).naming(meanings(analysis, |_| true)))
}

/// Takes away the `par`s directly in the `par` whose keyword the token is; if there are none, that `par` itself.
pub(super) fn merge(analysis: &Analysis, token: &SyntaxToken) -> Option<Candidate> {
    if !matches!(token.kind(), SyntaxKind::PAR_KW | SyntaxKind::ENDPAR_KW) {
        return None;
    }
    let is_par = |node: &SyntaxNode| node.kind() == SyntaxKind::PAR_RULE;
    let here = token.parent().filter(is_par)?;
    let mut inner: Vec<SyntaxNode> = here.children().filter(is_par).collect();
    if inner.is_empty() && here.parent().is_some_and(|around| is_par(&around)) {
        inner.push(here);
    }
    let edits: Vec<Edit> = inner.iter().filter_map(|par| without_keywords(analysis, par)).collect();
    if edits.is_empty() {
        return None;
    }
    let names = meanings(analysis, |_| true);
    Some(Candidate::new("Merge nested `par`s", RefactoringKind::Rewrite, edits).naming(names))
}

/// What stands between `par` and `endpar`, one level up.
fn without_keywords(analysis: &Analysis, par: &SyntaxNode) -> Option<Edit> {
    let text = analysis.text();
    let (start, end) = bytes(par);
    let (rules, _) = bytes(&par.children().next()?);
    let open = par.first_token().filter(|token| token.kind() == SyntaxKind::PAR_KW)?;
    let close = par.last_token().filter(|token| token.kind() == SyntaxKind::ENDPAR_KW)?;
    let space = |token: &SyntaxToken| token.kind() == SyntaxKind::WHITESPACE;
    let first =
        open.next_token().map(|token| if space(&token) { token.text_range().end() } else { open.text_range().end() });
    let last = close.prev_token().filter(space);
    let after_comment = last.as_ref().and_then(|token| token.prev_token());
    let after_comment = after_comment.is_some_and(|token| token.kind() == SyntaxKind::LINE_COMMENT);
    // The line of a comment has to end.
    let last = match last.filter(|_| !after_comment) {
        Some(token) => token.text_range().start(),
        None => close.text_range().start(),
    };
    let (first, last) = (u32::from(first?), u32::from(last));
    let body = moved(&analysis.tree()?, (first, last), (indentation(text, rules), indentation(text, start)), &|_| None);
    Some(Edit::new(start..end, body))
}
