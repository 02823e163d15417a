//! Shows diagnostics as a golden test pins them: position, source line, underline, labels, help.

use std::fmt::Write;
use syntax::{Diagnostic, SourceFile, Span};

/// All diagnostics of one text.
pub fn render(name: &str, text: &str, diagnostics: &[Diagnostic]) -> String {
    let file = SourceFile::new(name, text);
    let mut out = String::new();
    let severity = |fault: &Diagnostic| format!("{:?}", fault.severity).to_lowercase();
    for fault in diagnostics {
        let _ = writeln!(out, "{}[{}]: {}", severity(fault), fault.id, fault.message);
        place(&mut out, &file, fault.primary.span, '^', &fault.primary.text);
        for label in &fault.secondary {
            place(&mut out, &file, label.span, '-', &label.text);
        }
        if let Some(help) = &fault.help {
            let _ = writeln!(out, "  help: {help}");
        }
        out.push('\n');
    }
    out
}

fn place(out: &mut String, file: &SourceFile, span: Span, mark: char, text: &str) {
    let at = file.line_column(span.start);
    let line = file.text.lines().nth(at.line as usize - 1).unwrap_or_default();
    let line = line.replace('\t', " ");
    let rest = line.chars().count().saturating_sub(at.column as usize - 1);
    let length = file.text[span.range()].chars().count().min(rest).max(1);
    let _ = writeln!(out, "{:>4} | {}", at.line, line.trim_end());
    let marks: String = std::iter::repeat_n(mark, length).collect();
    let _ = writeln!(out, "     | {:indent$}{marks} {text}", "", indent = at.column as usize - 1);
}
