//! Whether the model beside a chart is the chart's, before somebody takes its verdict for one of the chart.
//!
//! In: a chart. Out: what `groundstate chart check` says of both. Nothing is written.

use std::path::Path;

use groundstate::Kind;
use serde_json::{Value, json};

use crate::studio::Studio;

/// The faults by which a chart and its model differ; others are of one of the two. What the model lacks may be what building adds, such as the
/// rule of a machine that got another name: if it is not, building says so.
const DIFFERS: [&str; 3] = ["chart-differs", "system-differs", "broken-link"];

/// The model beside a chart, and whether both agree: `none`, `agrees`, `differs`, `faulty` or `unknown`.
///
/// # Errors
/// The path is none of a chart, or the two cannot be compared; a sentence.
pub fn agreement(studio: &Studio, path: &str) -> Result<Value, String> {
    if Kind::of(Path::new(path)) != Some(Kind::Chart) {
        return Err(format!("`{}` is no chart", path.escape_debug()));
    }
    let model = Path::new(path).with_extension("asm").to_string_lossy().into_owned();
    studio.folder.place(path)?;
    if !studio.folder.place(&model)?.is_file() {
        return Ok(json!({ "model": model, "state": "none" }));
    }
    let ended = studio.jobs.at_once(&["chart", "check", &format!("./{path}"), "--within", ".", "--format", "json"])?;
    let said = String::from_utf8_lossy(&ended.stdout);
    let state = match ended.status.code() {
        Some(0) => "agrees",
        Some(1) => of_faults(&said),
        Some(3) => "unknown",
        _ => return Err(String::from_utf8_lossy(&ended.stderr).trim().trim_start_matches("error: ").to_string()),
    };
    Ok(json!({ "model": model, "state": state }))
}

fn of_faults(lines: &str) -> &'static str {
    let faults = lines.lines().filter_map(|line| serde_json::from_str::<Value>(line).ok());
    let mut errors = faults.filter(|fault| fault["severity"] == "error");
    let is_difference = |fault: &Value| fault["id"].as_str().is_some_and(|id| DIFFERS.contains(&id));
    if errors.all(|fault| is_difference(&fault)) { "differs" } else { "faulty" }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_difference_is_no_fault_of_the_chart() {
        let check = |ids: &[(&str, &str)], expected: &str| {
            let line = |(severity, id): &(&str, &str)| json!({ "severity": severity, "id": id }).to_string() + "\n";
            let lines: String = ids.iter().map(line).collect();
            assert_eq!(of_faults(&lines), expected, "{lines}");
        };
        check(&[("error", "chart-differs"), ("error", "system-differs")], "differs");
        check(&[("warning", "overlap"), ("error", "chart-differs")], "differs");
        check(&[("error", "broken-link")], "differs");
        check(&[("error", "chart-differs"), ("error", "syntax-error")], "faulty");
    }
}
