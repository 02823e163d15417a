//! Test results as JUnit XML, the dialect that continuous integration servers read. It contains no times, so that the
//! same results give the same bytes.
//!
//! In: the results of scenarios, and their faults as text. Out: a document.

use std::fmt::Write;

use groundstate::Tested;
use syntax::Diagnostic;

/// A report being written.
#[derive(Debug, Default)]
pub struct Junit {
    cases: String,
    tests: usize,
    failures: usize,
    errors: usize,
}

impl Junit {
    /// Adds the scenario of a file. `render` gives a fault as text.
    pub fn case(
        &mut self,
        file: &str,
        tested: &Tested,
        failures: &[Diagnostic],
        render: &dyn Fn(&Diagnostic) -> String,
    ) {
        self.tests += 1;
        let (name, class) = (escape(&tested.name), escape(file));
        let _ = write!(self.cases, "    <testcase name=\"{name}\" classname=\"{class}\" file=\"{class}\"");
        if failures.is_empty() {
            self.cases.push_str("/>\n");
            return;
        }
        // Scenarios that could not run are errors, the others failures.
        let element = if tested.verdict.is_some() { "failure" } else { "error" };
        if tested.verdict.is_some() {
            self.failures += 1
        } else {
            self.errors += 1
        }
        self.cases.push_str(">\n");
        for failure in failures {
            let text = render(failure);
            let (kind, message) = (escape(failure.id), escape(&failure.message));
            let text = escape(&text);
            let _ = writeln!(self.cases, "      <{element} type=\"{kind}\" message=\"{message}\">{text}</{element}>");
        }
        self.cases.push_str("    </testcase>\n");
    }

    /// The whole report.
    pub fn finish(self) -> String {
        let Junit { cases, tests, failures, errors } = self;
        let counts = format!("tests=\"{tests}\" failures=\"{failures}\" errors=\"{errors}\"");
        format!(
            "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<testsuites name=\"groundstate\" {counts}>\n  \
             <testsuite name=\"scenarios\" {counts}>\n{cases}  </testsuite>\n</testsuites>\n"
        )
    }
}

/// Text as XML character data; characters that XML cannot hold are replaced.
fn escape(text: &str) -> String {
    let mut escaped = String::with_capacity(text.len());
    for c in text.chars() {
        match c {
            '&' => escaped.push_str("&amp;"),
            '<' => escaped.push_str("&lt;"),
            '>' => escaped.push_str("&gt;"),
            '"' => escaped.push_str("&quot;"),
            '\n' | '\t' => escaped.push(c),
            c if c < ' ' || matches!(c, '\u{fffe}' | '\u{ffff}') => escaped.push('\u{fffd}'),
            c => escaped.push(c),
        }
    }
    escaped
}

#[cfg(test)]
mod tests {
    #[test]
    fn text_is_escaped() {
        assert_eq!(super::escape("a<b & \"c\"\u{1b}"), "a&lt;b &amp; &quot;c&quot;\u{fffd}");
    }
}
