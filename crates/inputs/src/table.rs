//! CSV inputs: one column for each location, or the long form `step,location,value`.
//!
//! In the first form the column `step` may be missing; the rows are then steps 1, 2, 3, … An empty cell gives
//! nothing, so the value before it holds on.

use csv::{ReaderBuilder, StringRecord};
use simulate::{Given, Steps};
use syntax::{FileId, Span};

use crate::{Read, fault, steps, text, whole};

/// Reads a table.
pub fn read(file: FileId, source: &str) -> Read<Vec<Given>> {
    let mut reader =
        ReaderBuilder::new().has_headers(false).flexible(true).comment(Some(b'#')).from_reader(source.as_bytes());
    let mut given = Vec::new();
    let mut header: Option<(StringRecord, Span)> = None;
    let mut row = 0;
    for record in reader.records() {
        let record = record.map_err(|error| fault(whole(file), format!("the table cannot be read: {error}")))?;
        let span = span_of(file, source, &record);
        match &header {
            None => header = Some((record, span)),
            Some((names, place)) => {
                row += 1;
                read_row(names, *place, &record, span, row, &mut given)?;
            }
        }
    }
    match header {
        Some(_) => Ok(given),
        None => Err(fault(whole(file), "the table is empty: its first line names the locations")),
    }
}

fn read_row(
    names: &StringRecord,
    header: Span,
    record: &StringRecord,
    span: Span,
    row: u64,
    given: &mut Vec<Given>,
) -> Result<(), Box<syntax::Diagnostic>> {
    if record.len() > names.len() {
        return Err(fault(span, format!("{} cells, but {} columns", record.len(), names.len())));
    }
    let column = |name: &str| names.iter().position(|found| found.trim() == name);
    let step = match column("step") {
        Some(index) => steps(record.get(index).unwrap_or_default(), span)?,
        None => Steps::From(row),
    };
    if let (Some(location), Some(value)) = (column("location"), column("value")) {
        let cell = |index: usize| record.get(index).unwrap_or_default().trim();
        given.push(Given {
            steps: step,
            location: (cell(location).to_string(), span),
            value: (text(cell(value)), span),
        });
        return Ok(());
    }
    for (name, cell) in names.iter().zip(record) {
        if name.trim() != "step" && !cell.trim().is_empty() {
            given.push(Given {
                steps: step,
                location: (name.trim().to_string(), header),
                value: (text(cell.trim()), span),
            });
        }
    }
    Ok(())
}

/// The line a record begins on.
fn span_of(file: FileId, source: &str, record: &StringRecord) -> Span {
    let start = record.position().map_or(0, |position| position.byte() as usize).min(source.len());
    // The position may be that of comment lines before the record.
    let mut start = start;
    while source[start..].starts_with(['#', '\n', '\r']) {
        match source[start..].find('\n') {
            Some(at) => start += at + 1,
            None => break,
        }
    }
    let end = source[start..].find(['\n', '\r']).map_or(source.len(), |at| start + at);
    Span { file, start: start as u32, end: end as u32 }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn check(source: &str, expected: &[&str]) {
        let read: Vec<String> = match read(FileId(0), source) {
            Ok(given) => given.iter().map(|g| format!("{:?} {} = {:?}", g.steps, g.location.0, g.value.0)).collect(),
            Err(fault) => vec![fault.message],
        };
        assert_eq!(read, expected);
    }

    #[test]
    fn a_column_a_location() {
        check(
            "step,passed,\"at(1,2)\"\n1,true,5\n# later\n4..6,,7\n",
            &["From(1) passed = Text(\"true\")", "From(1) at(1,2) = Text(\"5\")", "Range(4, 6) at(1,2) = Text(\"7\")"],
        );
    }

    #[test]
    fn rows_count_where_no_step_is_given() {
        check("a\n1\n\n2\n", &["From(1) a = Text(\"1\")", "From(2) a = Text(\"2\")"]);
    }

    #[test]
    fn the_long_form() {
        check("step,location,value\n3,f(A),RED\n", &["From(3) f(A) = Text(\"RED\")"]);
    }

    #[test]
    fn trouble() {
        check("", &["the table is empty: its first line names the locations"]);
        check("step,a\nx,1\n", &["`x` names no step: write a number from 1, a range such as 3..5, or `always`"]);
        check("a\n1,2\n", &["2 cells, but 1 columns"]);
    }
}
