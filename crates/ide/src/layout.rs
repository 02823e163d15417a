//! The canonical layout of a part of a file, and of what is being typed.
//!
//! In: the name and the text of a file, which need not be a project's: an editor's text is laid out on a thread of its own. Out: edits
//! of the white space between words. INVARIANT: words and comments stay as they are, in their order; laying out the whole file
//! afterwards gives what it would have given before.

use std::path::Path;

use groundstate::Kind;
use syntax::ast::trimmed_range;
use syntax::{FileId, Parse, Severity, SyntaxKind, SyntaxNode, SyntaxToken};

use crate::position::{Edit, edited};

/// A word or a comment of a text, without the blanks behind it.
struct Word {
    kind: SyntaxKind,
    start: u32,
    end: u32,
}

/// The layout of the parts of a file that lie wholly in a range.
///
/// # Errors
/// The text has errors, or is of a kind that has no canonical layout; a sentence.
pub fn layout_in(path: &str, text: &str, range: (u32, u32)) -> Result<Vec<Edit>, String> {
    let parse = parsed(path, text).ok_or("only models, scenarios and charts have a canonical layout")?;
    if parse.diagnostics.iter().any(|fault| fault.severity == Severity::Error) {
        return Err("a text with errors is not formatted".to_string());
    }
    let mut parts = Vec::new();
    whole_parts(&parse.syntax(), range, &mut parts);
    let words = words(&parse);
    let comments = words.iter().filter(|word| word.kind.is_trivia() && range.0 <= word.start && word.end <= range.1);
    parts.extend(comments.map(|word| (word.start, word.end)));
    let admitted = |gap: &Gap| {
        let inside = parts.iter().any(|(start, end)| *start <= gap.before && gap.after <= *end);
        // The beginning of its line belongs to a part.
        let leads = parts.iter().any(|(start, _)| *start == gap.after) && begins_line(text, gap.after);
        inside || (leads && range.0 <= gap.edit.range.0 && gap.edit.range.1 <= range.1)
    };
    let formatted = syntax::format(&parse);
    let mut gaps = gaps(path, text, &formatted, &words);
    gaps.retain(admitted);
    // How a construct around the range is laid out depends on whether its parts begin lines. That must not change.
    for joins in [true, false] {
        let chosen = gaps.iter().filter(|gap| joins || !gap.joins_lines);
        let edits: Vec<Edit> = chosen.map(|gap| gap.edit.clone()).collect();
        let after = parsed(path, &edited(text, &edits));
        if after.is_some_and(|after| syntax::format(&after) == formatted) {
            return Ok(edits);
        }
    }
    Ok(Vec::new())
}

/// The layout of the line in which something was typed that ends at an offset: the end of a line, or a word that ends or divides a
/// construct.
pub fn layout_typed(path: &str, text: &str, at: u32) -> Vec<Edit> {
    let Some(typed) = text.get(..at as usize).and_then(|before| before.chars().next_back()) else { return Vec::new() };
    let Some(parse) = parsed(path, text) else { return Vec::new() };
    let tree = parse.syntax();
    if typed == '\n' {
        return new_line(&tree, text, at).into_iter().collect();
    }
    let Some(word) = tree.token_at_offset(at.into()).left_biased() else { return Vec::new() };
    let start = u32::from(word.text_range().start());
    if u32::from(word.text_range().end()) != at || !begins_line(text, start) {
        return Vec::new();
    }
    let Some(opener) = opener(&word) else { return Vec::new() };
    let broken = parse.diagnostics.iter().any(|fault| fault.severity == Severity::Error);
    let ends = word.text().starts_with("end");
    if ends && !broken {
        let from = u32::from(opener.text_range().start());
        if let Ok(edits) = layout_in(path, text, (from, at)) {
            return edits;
        }
    }
    let wanted = indentation(text, opener.text_range().start().into());
    replaced(text, start, wanted).into_iter().collect()
}

fn parsed(path: &str, text: &str) -> Option<Parse> {
    match Kind::of(Path::new(path))? {
        Kind::Model => Some(syntax::parse_asmetal(FileId(0), text)),
        Kind::Scenario => Some(syntax::parse_avalla(FileId(0), text)),
        Kind::Chart => Some(syntax::parse_chart(FileId(0), text)),
        Kind::Report | Kind::Verification | Kind::Coupling => None,
    }
}

/// The largest nodes that lie in a range.
fn whole_parts(node: &SyntaxNode, range: (u32, u32), found: &mut Vec<(u32, u32)>) {
    let own = trimmed_range(node);
    let (start, end) = (u32::from(own.start()), u32::from(own.end()));
    if range.1 <= start || end <= range.0 {
        return;
    }
    if range.0 <= start && end <= range.1 {
        found.push((start, end));
        return;
    }
    node.children().for_each(|child| whole_parts(&child, range, found));
}

fn words(parse: &Parse) -> Vec<Word> {
    let tokens = parse.syntax().descendants_with_tokens().filter_map(|element| element.into_token());
    let words = tokens.filter(|token| token.kind() != SyntaxKind::WHITESPACE).map(|token| {
        let start = u32::from(token.text_range().start());
        Word { kind: token.kind(), start, end: start + token.text().trim_end().len() as u32 }
    });
    words.collect()
}

/// White space that layout changes.
struct Gap {
    /// Where it begins.
    before: u32,
    /// Where it ends.
    after: u32,
    /// What changes it.
    edit: Edit,
    /// It ends a line, and will not any more.
    joins_lines: bool,
}

fn gaps(path: &str, text: &str, formatted: &str, before: &[Word]) -> Vec<Gap> {
    let Some(after) = parsed(path, formatted).map(|parse| words(&parse)) else { return Vec::new() };
    let own = |text: &str, word: &Word| text[word.start as usize..word.end as usize].to_string();
    let same = before.len() == after.len()
        && before.iter().zip(&after).all(|(one, other)| own(text, one) == own(formatted, other));
    if !same {
        return Vec::new();
    }
    let mut found = Vec::new();
    let (mut here, mut there) = (0, 0);
    let ends = (text.len() as u32, formatted.len() as u32);
    let starts = before.iter().zip(&after).map(|(one, other)| ((one.start, other.start), (one.end, other.end)));
    for ((one, other), (next, next_other)) in starts.chain([(ends, ends)]) {
        let (old, new) = (&text[here as usize..one as usize], &formatted[there as usize..other as usize]);
        let joins_lines = old.contains('\n') && !new.contains('\n');
        found.extend(difference(here, old, new).map(|edit| Gap { before: here, after: one, edit, joins_lines }));
        (here, there) = (next, next_other);
    }
    found
}

/// The edit that takes white space to another, as short as it can be at both ends.
fn difference(at: u32, old: &str, new: &str) -> Option<Edit> {
    if old == new {
        return None;
    }
    let start = old.bytes().zip(new.bytes()).take_while(|(a, b)| a == b).count();
    let (rest, other) = (&old[start..], &new[start..]);
    let end = rest.bytes().rev().zip(other.bytes().rev()).take_while(|(a, b)| a == b).count();
    Some(Edit::new(at + start as u32..at + (old.len() - end) as u32, &other[..other.len() - end]))
}

/// The indentation of a line that has just been begun, at whose beginning the offset is.
fn new_line(tree: &SyntaxNode, text: &str, at: u32) -> Option<Edit> {
    let last = tree.token_at_offset(at.into()).left_biased();
    let last = std::iter::successors(last, SyntaxToken::prev_token).find(|token| !token.kind().is_trivia());
    let mut last = last.filter(|token| u32::from(token.text_range().end()) <= at)?;
    let rest = text[at as usize..].lines().next().unwrap_or_default();
    let first = tree.token_at_offset((at + (rest.len() - rest.trim_start().len()) as u32).into()).right_biased();
    if let Some(word) = first.filter(|token| u32::from(token.text_range().start()) >= at)
        && let Some(opener) = opener(&word)
    {
        return replaced(text, at, indentation(text, opener.text_range().start().into()));
    }
    if !rest.trim().is_empty() {
        last = std::iter::successors(Some(last), SyntaxToken::prev_token).find(|token| !token.kind().is_trivia())?;
    }
    let own = indentation(text, last.text_range().start().into());
    let level = if own.starts_with(' ') { "    " } else { "\t" };
    let deeper = if opens(&last) { level } else { "" };
    replaced(text, at, &format!("{own}{deeper}"))
}

/// Whether what comes behind a word stands one level deeper.
fn opens(token: &SyntaxToken) -> bool {
    use SyntaxKind::*;
    let section = |kind| matches!(kind, SIGNATURE | DEFINITIONS | INIT | CASE_BRANCH | ERROR);
    match token.kind() {
        PAR_KW | SEQ_KW | ITERATE_KW | THEN_KW | ELSE_KW | OTHERWISE_KW | DO_KW | IFNONE_KW | BEGIN_KW | L_BRACE => {
            true
        }
        EQ => token.parent().is_some_and(|node| matches!(node.kind(), RULE_DECL | FUNCTION_DEF | DOMAIN_DEF)),
        IN_KW => token.parent().is_some_and(|node| matches!(node.kind(), LET_RULE | LET_TERM)),
        COLON => token.parent().is_some_and(|node| section(node.kind())),
        _ => false,
    }
}

/// The word that a word ends or divides; by the words alone, so that a text with errors has it, too.
fn opener(word: &SyntaxToken) -> Option<SyntaxToken> {
    let wanted = opening(word.kind())?;
    let mut open: Vec<SyntaxKind> = vec![wanted];
    let mut token = word.prev_token();
    while let Some(here) = token {
        let kind = here.kind();
        if ends(kind) {
            open.push(opening(kind)?);
        } else if is_opening(kind) {
            if open.len() == 1 {
                return (kind == wanted).then_some(here);
            }
            if open.last() == Some(&kind) {
                open.pop();
            }
        }
        token = here.prev_token();
    }
    None
}

fn opening(kind: SyntaxKind) -> Option<SyntaxKind> {
    use SyntaxKind::*;
    match kind {
        ENDPAR_KW => Some(PAR_KW),
        ENDSEQ_KW => Some(SEQ_KW),
        ENDIF_KW | ELSE_KW | ELSEIF_KW => Some(IF_KW),
        ENDSWITCH_KW | OTHERWISE_KW => Some(SWITCH_KW),
        ENDLET_KW => Some(LET_KW),
        ENDITERATE_KW => Some(ITERATE_KW),
        _ => None,
    }
}

fn ends(kind: SyntaxKind) -> bool {
    use SyntaxKind::*;
    matches!(kind, ENDPAR_KW | ENDSEQ_KW | ENDIF_KW | ENDSWITCH_KW | ENDLET_KW | ENDITERATE_KW)
}

fn is_opening(kind: SyntaxKind) -> bool {
    use SyntaxKind::*;
    matches!(kind, PAR_KW | SEQ_KW | IF_KW | SWITCH_KW | LET_KW | ITERATE_KW)
}

fn begins_line(text: &str, at: u32) -> bool {
    let before = text[..at as usize].trim_end_matches([' ', '\t']);
    before.is_empty() || before.ends_with('\n')
}

/// The white space that the line of an offset begins with.
pub(crate) fn indentation(text: &str, at: u32) -> &str {
    let start = text[..at as usize].rfind('\n').map_or(0, |end| end + 1);
    let line = &text[start..];
    &line[..line.len() - line.trim_start_matches([' ', '\t']).len()]
}

/// Another beginning for the line of an offset.
fn replaced(text: &str, at: u32, wanted: &str) -> Option<Edit> {
    let present = indentation(text, at);
    let start = text[..at as usize].rfind('\n').map_or(0, |end| end + 1) as u32;
    (present != wanted).then(|| Edit::new(start..start + present.len() as u32, wanted))
}
