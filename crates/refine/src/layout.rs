//! The canonical layout of a coupling file: a statement a line, terms as in a model, comments where they stand.
//!
//! In: the text. Out: the text laid out, or its first fault. A term that is too long for
//! a line is folded. INVARIANT: words and comments stay as they are, in their order, and laying out the result changes nothing.

use syntax::{Diagnostic, FileId, Severity};

use crate::SIDES;
use crate::fault::bad_coupling;
use crate::written::{Statement, statements};

/// The text in its canonical layout.
///
/// # Errors
/// The text has a fault of form; or it is one that layout would change, which is a bug of ours.
pub fn format(file: FileId, text: &str) -> Result<String, Box<Diagnostic>> {
    let formatted = laid_out(file, text)?;
    let kept = laid_out(file, &formatted).is_ok_and(|again| again == formatted) && words(text) == words(&formatted);
    match kept {
        true => Ok(formatted),
        false => {
            Err(bad_coupling(crate::coupling::start(file), "this coupling cannot be laid out without changing it"))
        }
    }
}

/// What stands in a text besides blanks.
fn words(text: &str) -> String {
    text.chars().filter(|letter| !letter.is_whitespace()).collect()
}

fn laid_out(file: FileId, text: &str) -> Result<String, Box<Diagnostic>> {
    let mut out = String::new();
    let mut at = 0;
    for statement in statements(file, text)? {
        between(&text[at..statement.word.span.start as usize], &mut out);
        one(file, &statement, &mut out)?;
        at = statement.end;
    }
    between(&text[at..], &mut out);
    let whole = out.trim_end();
    Ok(if whole.is_empty() { String::new() } else { format!("{whole}\n") })
}

/// The comments between two statements. One behind a statement stays in its line; a blank line stays one.
fn between(gap: &str, out: &mut String) {
    let mut rest = gap;
    let mut beside = !out.is_empty();
    loop {
        let trimmed = rest.trim_start();
        let blank = &rest[..rest.len() - trimmed.len()];
        beside &= !blank.contains('\n');
        let lines = blank.matches('\n').count();
        let empty = lines > 1 && !out.is_empty() && !out.ends_with("\n\n");
        let end = match trimmed {
            comment if comment.starts_with("//") => comment.find('\n').unwrap_or(comment.len()),
            comment if comment.starts_with("/*") => comment.find("*/").map_or(comment.len(), |end| end + 2),
            _ => {
                if !out.is_empty() && !out.ends_with('\n') {
                    out.push('\n');
                }
                out.push_str(if empty { "\n" } else { "" });
                return;
            }
        };
        if beside {
            out.push(' ');
        } else {
            if !out.is_empty() && !out.ends_with('\n') {
                out.push('\n');
            }
            out.push_str(if empty { "\n" } else { "" });
        }
        out.push_str(trimmed[..end].trim_end());
        rest = &trimmed[end..];
        // Behind a comment to the end of its line nothing stands in that line.
        beside &= trimmed.starts_with("/*");
    }
}

fn one(file: FileId, statement: &Statement, out: &mut String) -> Result<(), Box<Diagnostic>> {
    let body = &statement.body;
    out.push_str(&statement.word.text);
    out.push(' ');
    match statement.word.text.as_str() {
        "couple" | "fair" | "segment" | "variant" => term(file, &body.text, body.span.start as usize, out)?,
        "input" => {
            let (input, value) = body.text.split_once('=').unwrap_or((&body.text, ""));
            let start = body.span.end as usize - value.trim_start().len();
            out.push_str(input.trim());
            out.push_str(" = ");
            term(file, value.trim(), start, out)?;
        }
        "same" | "free" => out.push_str(&list(&body.text, |part| part.to_string())),
        "diagrams" => out.push_str(&list(&body.text, |part| part.split_whitespace().collect())),
        _ => out.push_str(&body.text),
    }
    out.push(';');
    Ok(())
}

fn list(text: &str, part: impl Fn(&str) -> String) -> String {
    text.split(',').map(|one| part(one.trim())).collect::<Vec<_>>().join(", ")
}

/// A term as a model has it. The names of both machines are written as plain ones meanwhile, since `abstract` is a word of models.
fn term(file: FileId, text: &str, start: usize, out: &mut String) -> Result<(), Box<Diagnostic>> {
    let letters = ['_', 'q', 'x', 'y', 'z', 'j', 'k', 'w', '0', '1', '2', '3', '4', '5', '6', '7', '8', '9'];
    let is_free = |letter: &char| SIDES.iter().all(|side| !text.contains(&format!("{side}{letter}")));
    let Some(letter) = letters.into_iter().find(is_free) else {
        out.push_str(text);
        return Ok(());
    };
    let mut plain = text.to_string();
    for side in SIDES {
        plain = plain.replace(&format!("{side}."), &format!("{side}{letter}"));
    }
    let parse = syntax::parse_term(file, &plain);
    if let Some(fault) = parse.diagnostics.iter().find(|fault| fault.severity == Severity::Error) {
        let mut fault = fault.clone();
        fault.primary.span.start += start as u32;
        fault.primary.span.end += start as u32;
        return Err(Box::new(fault));
    }
    let mut formatted = syntax::format(&parse).trim_end().to_string();
    for side in SIDES {
        formatted = formatted.replace(&format!("{side}{letter}"), &format!("{side}."));
    }
    let indented = formatted.lines().skip(1).all(|line| line.is_empty() || line.starts_with('\t'));
    let mut open = false;
    for (number, line) in formatted.lines().enumerate() {
        if number > 0 {
            out.push('\n');
            // The inside of a comment stays as it is.
            out.push_str(if open || indented || line.is_empty() { "" } else { "\t" });
        }
        out.push_str(line);
        open = ends_in_comment(line, open);
    }
    if formatted.lines().last().is_some_and(|line| line.contains("//")) {
        out.push('\n');
    }
    Ok(())
}

/// Whether a comment of several lines is open behind a line.
fn ends_in_comment(line: &str, open: bool) -> bool {
    match (line.rfind("/*"), line.rfind("*/")) {
        (None, None) => open,
        (Some(_), None) => true,
        (None, Some(_)) => false,
        (Some(begin), Some(end)) => begin > end,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn check(text: &str, expected: &str) {
        let formatted = format(FileId(0), text).map_err(|fault| fault.message);
        assert_eq!(formatted.as_deref(), Ok(expected), "{text:?}");
        assert_eq!(format(FileId(0), expected).map_err(|fault| fault.message).as_deref(), Ok(expected));
    }

    #[test]
    fn a_statement_stands_in_a_line() {
        check("", "");
        check("  \n ", "");
        check("same f,g ;segment not   concrete.busy;", "same f, g;\nsegment not concrete.busy;\n");
        check("diagrams 0 .. 1 : 1..4,1:1;", "diagrams 0..1:1..4, 1:1;\n");
        check("abstract   \"A b.asm\";\nallow   waiting ;", "abstract \"A b.asm\";\nallow waiting;\n");
        check(
            "input abstract.f=concrete.g+1;free abstract.h,abstract.i;",
            "input abstract.f = concrete.g + 1;\nfree abstract.h, abstract.i;\n",
        );
        check("same f;\n\n\n\nsame g;\nsame h;", "same f;\n\nsame g;\nsame h;\n");
    }

    #[test]
    fn terms_are_laid_out_as_in_a_model() {
        check(
            "couple abstract.n=concrete.f( 1,2 )and abstract_x;",
            "couple abstract.n = concrete.f(1, 2) and abstract_x;\n",
        );
        check("variant   2*concrete.n-1;", "variant 2 * concrete.n - 1;\n");
        check("couple abstract.n=concrete.m\n        +1;", "couple abstract.n = concrete.m + 1;\n");
        check(
            "couple (forall $x in N with abstract.f($x)=concrete.f($x));",
            "couple (forall $x in N with abstract.f($x) = concrete.f($x));\n",
        );
    }

    #[test]
    fn comments_stay() {
        check(
            "// a\n\n\n// b\nsame f; // c\n/* d */ same g; /* e */ /* f */\n// g",
            "// a\n\n// b\nsame f; // c\n/* d */\nsame g; /* e */ /* f */\n// g\n",
        );
        check("couple abstract.a // why\n  and concrete.b;", "couple abstract.a // why\n\tand concrete.b;\n");
        check("couple abstract.a // why\n;", "couple abstract.a // why\n;\n");
        check("couple /* x */ abstract.a;", "couple /* x */\n\tabstract.a;\n");
    }

    #[test]
    fn a_text_with_faults_has_none() {
        for text in ["couple abstract.a", "relate x;", "couple abstract.a and;", "same abstract.f;", "/* a"] {
            assert!(format(FileId(0), text).is_err(), "{text}");
        }
    }
}
