//! Which comments belong to a token: those after it on its line, and those on the lines before it.
//!
//! In: a token. Out: documents of its comments, and of the empty line before it, if there is one. INVARIANT: each comment
//! of a file belongs to exactly one token or to the end of the file, so none is lost and none is printed twice.

use super::document::Document;
use crate::{SyntaxKind::*, SyntaxNode, SyntaxToken};

/// A comment on the lines before a token.
struct Comment {
    text: String,
    column: usize,
    /// An empty line stands before it.
    blank_before: bool,
}

/// The comments after a token on its line.
pub(super) fn behind(token: &SyntaxToken) -> Vec<Document> {
    let mut comments = Vec::new();
    let mut next = token.next_token();
    while let Some(trivia) = next.filter(|token| token.kind().is_trivia()) {
        match trivia.kind() {
            WHITESPACE if trivia.text().contains('\n') => break,
            WHITESPACE => {}
            LINE_COMMENT => comments.push(Document::TrailingComment(trivia.text().trim_end().to_string())),
            _ => comments.extend([Document::Space, Document::Text(trivia.text().to_string()), Document::Space]),
        }
        next = trivia.next_token();
    }
    comments
}

/// The comments before a token, and then whether an empty line stands before the token itself.
fn before(token: &SyntaxToken) -> (Vec<Comment>, bool) {
    let (trivia, starts_file) = trivia_before(token);
    // What stands on the line of the token before belongs to that one.
    let own = match trivia.iter().position(|token| token.kind() == WHITESPACE && token.text().contains('\n')) {
        _ if starts_file => 0,
        Some(first) => first,
        None => trivia.len(),
    };
    let (mut comments, mut lines) = (Vec::new(), 0);
    for token in &trivia[own..] {
        if token.kind() == WHITESPACE {
            lines += token.text().matches('\n').count();
        } else {
            let text = token.text().trim_end().to_string();
            comments.push(Comment { text, column: column(token), blank_before: lines > 1 });
            lines = 0;
        }
    }
    (comments, lines > 1)
}

/// A line ends between the token before and this one.
pub(super) fn starts_line(token: &SyntaxToken) -> bool {
    trivia_before(token).0.iter().any(|trivia| trivia.text().contains('\n'))
}

/// The trivia right before a token, and whether the file starts with it.
fn trivia_before(token: &SyntaxToken) -> (Vec<SyntaxToken>, bool) {
    let mut trivia = Vec::new();
    let mut previous = token.prev_token();
    while let Some(token) = previous {
        if !token.kind().is_trivia() {
            trivia.reverse();
            return (trivia, false);
        }
        previous = token.prev_token();
        trivia.push(token);
    }
    trivia.reverse();
    (trivia, true)
}

/// How far right a token starts on its line, in characters.
fn column(token: &SyntaxToken) -> usize {
    let mut width = 0;
    let mut previous = token.prev_token();
    while let Some(token) = previous {
        let text = token.text();
        match text.rfind('\n') {
            Some(end) => return width + text[end + 1..].chars().count(),
            None => width += text.chars().count(),
        }
        previous = token.prev_token();
    }
    width
}

/// What stands between the line before and a token that starts a line: its comments and at most one empty line.
pub(super) struct Gap {
    /// Comments that stand further right than the token: they belong to what is before it.
    pub(super) inner: Document,
    /// The other comments.
    pub(super) outer: Document,
}

/// The gap before a token that starts a line. Without `blanks` an empty line at the start of the gap is dropped.
pub(super) fn gap(token: &SyntaxToken, blanks: bool) -> Gap {
    let (comments, blank_before_token) = before(token);
    let here = if comments.is_empty() { 0 } else { column(token) };
    let inner_count = comments.iter().take_while(|comment| comment.column > here).count();
    let line = |blank: bool| if blank { Document::BlankLine } else { Document::HardLine };
    let mut parts = Vec::new();
    for (index, comment) in comments.iter().enumerate() {
        parts.push(line(comment.blank_before && (blanks || index > 0)));
        parts.push(Document::OwnLineComment(comment.text.clone()));
    }
    let outer = parts.split_off(2 * inner_count);
    let last = line(blank_before_token && (blanks || !comments.is_empty()));
    let outer = Document::Concat(outer.into_iter().chain([last]).collect());
    Gap { inner: Document::Concat(parts), outer }
}

/// The comments before a token that stands within a line.
pub(super) fn within_line(token: &SyntaxToken) -> Vec<Document> {
    before(token).0.into_iter().map(|comment| Document::OwnLineComment(comment.text)).collect()
}

/// The comments before the first token of a file.
pub(super) fn at_start_of_file(root: &SyntaxNode) -> Document {
    match root
        .descendants_with_tokens()
        .filter_map(|element| element.into_token())
        .find(|token| !token.kind().is_trivia())
    {
        // There is nothing before the file that an indented comment could belong to.
        Some(first) => {
            let Gap { inner, outer } = gap(&first, false);
            Document::Concat(vec![inner, outer])
        }
        None => Document::nothing(),
    }
}

/// The comments after the last token of a file.
pub(super) fn at_end_of_file(root: &SyntaxNode) -> Document {
    let Some(last) = root.last_token().filter(|token| token.kind().is_trivia()) else { return Document::nothing() };
    let (mut trivia, starts_file) = trivia_before(&last);
    trivia.push(last);
    let mut parts = Vec::new();
    let mut lines = usize::from(starts_file);
    let mut indented = false;
    for token in trivia {
        if token.kind() == WHITESPACE {
            lines += token.text().matches('\n').count();
        } else if lines > 0 || starts_file {
            // Where there are comments alone, there is nothing that an indented one could belong to.
            let belongs = if parts.is_empty() { !starts_file } else { indented };
            indented = belongs && column(&token) > 0;
            parts.push(if lines > 1 { Document::BlankLine } else { Document::HardLine });
            let comment = Document::OwnLineComment(token.text().trim_end().to_string());
            parts.push(if indented { Document::Indent(Box::new(comment)) } else { comment });
            lines = 0;
        }
    }
    Document::Concat(parts)
}
