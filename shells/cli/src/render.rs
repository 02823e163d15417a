//! Prints faults as text: the position, the source lines with every place underlined, the reason, what to do.

use std::borrow::Cow;
use std::collections::BTreeMap;
use std::ops::Range;

use annotate_snippets::{AnnotationKind, Element, Level, Renderer, Snippet};
use syntax::{Diagnostic, FileId, Label, Severity, Sources, Span};

use crate::failure::Failure;

/// A fault as text, without a line end at the end.
pub fn diagnostic(sources: &Sources, diagnostic: &Diagnostic, color: bool) -> String {
    let level = match diagnostic.severity {
        Severity::Error => Level::ERROR,
        Severity::Warning => Level::WARNING,
        Severity::Note => Level::NOTE,
    };
    let title = level.primary_title(diagnostic.message.as_str()).id(diagnostic.id);
    let mut group = title.elements(snippets(sources, diagnostic));
    if let Some(help) = &diagnostic.help {
        group = group.element(Level::HELP.message(help.as_str()));
    }
    renderer(color).render(&[group])
}

/// A failure of the world or of usage.
pub fn failure(failure: &Failure, color: bool) -> String {
    let message = failure.to_string();
    let title = Level::ERROR.primary_title(message.as_str());
    let group = match failure.help() {
        Some(help) => title.element(Level::HELP.message(help)),
        None => annotate_snippets::Group::with_title(title),
    };
    renderer(color).render(&[group])
}

fn renderer(color: bool) -> Renderer {
    let renderer = if color { Renderer::styled() } else { Renderer::plain() };
    renderer.term_width(120)
}

/// One snippet for each file, that of the primary place first.
fn snippets<'a>(sources: &'a Sources, diagnostic: &'a Diagnostic) -> Vec<Element<'a>> {
    let mut files: BTreeMap<FileId, Vec<(&Label, bool)>> = BTreeMap::new();
    for label in &diagnostic.secondary {
        files.entry(label.span.file).or_default().push((label, false));
    }
    let mut first = vec![(&diagnostic.primary, true)];
    first.extend(files.remove(&diagnostic.primary.span.file).into_iter().flatten());
    let others = files.into_iter();
    let all = std::iter::once((diagnostic.primary.span.file, first)).chain(others);
    all.map(|(file, labels)| snippet(sources, file, &labels)).collect()
}

fn snippet<'a>(sources: &'a Sources, file: FileId, labels: &[(&'a Label, bool)]) -> Element<'a> {
    let source = sources.file(file);
    let text: &str = &source.text;
    let from = labels.iter().map(|(label, _)| label.span.start as usize).min().unwrap_or(0);
    let to = labels.iter().map(|(label, _)| label.span.end as usize).max().unwrap_or(0);
    let window = window(text, from.min(text.len()), to.min(text.len()));
    let line = source.line_column(window.start as u32).line as usize;
    let mut snippet = Snippet::source(shown(&text[window.clone()])).line_start(line).path(source.name.as_str());
    for (label, primary) in labels {
        let kind = if *primary { AnnotationKind::Primary } else { AnnotationKind::Context };
        let annotation = kind.span(underlined(label.span, text, &window));
        let labelled = if label.text.is_empty() { annotation } else { annotation.label(label.text.as_str()) };
        snippet = snippet.annotation(labelled);
    }
    Element::from(snippet)
}

/// A piece of text without the carriage returns of Windows' line ends, which would be shown as glyphs.
fn shown(text: &str) -> Cow<'_, str> {
    if text.contains('\r') { Cow::Owned(text.replace('\r', "")) } else { Cow::Borrowed(text) }
}

/// The number of bytes of a text that are shown.
fn shown_len(text: &str) -> usize {
    text.len() - text.matches('\r').count()
}

/// How many bytes of a line are shown on either side of a fault; a line may have millions.
const WIDE: usize = 2_000;

/// The whole lines around a range, cut where they are very long.
fn window(text: &str, from: usize, to: usize) -> Range<usize> {
    let start = text[..from].rfind('\n').map_or(0, |at| at + 1);
    let end = text[to..].find('\n').map_or(text.len(), |at| to + at);
    let mut start = if from - start > WIDE { from - WIDE } else { start };
    let mut end = if end - to > WIDE { to + WIDE } else { end };
    while !text.is_char_boundary(start) {
        start += 1;
    }
    while !text.is_char_boundary(end) {
        end -= 1;
    }
    start..end
}

/// A label's place within the window: only the first line of a long construct, one character for an empty one.
fn underlined(span: Span, text: &str, window: &Range<usize>) -> Range<usize> {
    let start = (span.start as usize).clamp(window.start, window.end);
    let end = (span.end as usize).clamp(start, window.end);
    let first_line = text[start..end].find('\n').map_or(end, |at| start + at);
    let end = first_line.max(start);
    shown_len(&text[window.start..start])..shown_len(&text[window.start..end])
}

#[cfg(test)]
#[allow(clippy::single_range_in_vec_init, reason = "a list of one place is meant")]
mod tests {
    use super::*;
    use syntax::SourceFile;

    fn rendered(text: &str, places: &[Range<u32>]) -> String {
        let mut sources = Sources::default();
        let file = sources.add(SourceFile::new("a.asm", text));
        let span = |range: &Range<u32>| Span { file, start: range.start, end: range.end };
        let mut fault = Diagnostic::error("an-id", span(&places[0]), "a message").here("here").with_help("do it");
        for place in &places[1..] {
            fault = fault.with_label(span(place), "and there");
        }
        diagnostic(&sources, &fault, false)
    }

    #[test]
    fn a_place_at_the_very_end_is_shown() {
        assert!(rendered("asm", &[3..3]).contains("here"));
        assert!(rendered("", &[0..0]).contains("a message"));
    }

    #[test]
    fn both_places_of_a_clash_are_underlined() {
        let text = rendered("x := 1\n\n\n\n\n\n\nx := 2\n", &[13..19, 0..6]);
        assert!(text.contains("x := 1") && text.contains("x := 2") && text.contains("and there"), "{text}");
        assert!(text.contains("a.asm:8:1"), "{text}");
    }

    #[test]
    fn the_line_ends_of_windows_are_not_shown() {
        let text = rendered("asm a\r\nx := 1\r\ny\r\n", &[7..13]);
        assert_eq!(text.lines().nth(3), Some("2 | x := 1"), "{text:?}");
        assert!(rendered("asm a\r", &[0..5]).contains("1 | asm a\n"), "{text:?}");
    }

    #[test]
    fn a_long_line_is_cut() {
        let long = "é".repeat(1_000_000);
        assert!(rendered(&long, &[1_000_000..1_000_002]).len() < 2_000);
    }
}
