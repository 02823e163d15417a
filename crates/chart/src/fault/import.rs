//! Faults of imports of charts.

use syntax::{Diagnostic, Span};

const ID: &str = "chart-import";

/// There is no such file, or it cannot be read.
pub(crate) fn not_found(span: Span, path: &str, reason: &str) -> Diagnostic {
    Diagnostic::error(ID, span, format!("the chart \"{path}\" cannot be read"))
        .here(reason.to_string())
        .with_help("paths of imports start at the folder of the file they stand in")
}

/// A chart that imports itself, directly or through others.
pub(crate) fn circular(span: Span, circle: &[&str]) -> Diagnostic {
    Diagnostic::error(ID, span, format!("the charts import each other: {}", circle.join(" → ")))
        .here("this import closes the circle")
        .with_help("move the patterns that both use into a chart of their own")
}

/// A second import of a chart.
pub(crate) fn twice(span: Span, path: &str) -> Diagnostic {
    Diagnostic::warning(ID, span, format!("the chart \"{path}\" is imported twice"))
        .here("its patterns are known already")
        .with_help("remove one of the imports")
}

/// Two patterns with the same name, from two charts.
pub(crate) fn ambiguous(span: Span, name: &str, second: Span, first: Span) -> Diagnostic {
    Diagnostic::error(ID, span, format!("two imported patterns are called `{name}`"))
        .here("an instance could not tell the two apart")
        .with_label(first, "the first one")
        .with_label(second, "the second one")
        .with_help("rename one of them, or import only one of the charts")
}

/// A module that the chart imports has faults.
pub(crate) fn no_model(span: Span, found: &Diagnostic, chart: Option<&str>) -> Diagnostic {
    let fault =
        Diagnostic::error(ID, span, found.message.clone()).here("the links of the chart may name what it declares");
    match chart {
        Some(path) => fault.with_help(format!(
            "the model of an imported chart is built first: `groundstate chart build {path}.chart`"
        )),
        None => fault.with_help("correct the path, which starts at the folder of the chart; `.asm` may be left out"),
    }
}

/// A control state becomes a literal that an import declares.
pub(crate) fn literal(span: Span, state: &str, value: &str) -> Diagnostic {
    Diagnostic::error(
        "made-name",
        span,
        format!("an import declares `{value}`, which `{state}` becomes in the model, too"),
    )
    .here(format!("the control state's value is the literal `{value}`"))
    .with_help(format!("name the state otherwise, or link it to another value: `{state} {{MY_{value}}}`"))
}

/// A module that is added declares a name that is there.
pub(crate) fn clash(span: Span, name: &str, module: &str) -> Diagnostic {
    Diagnostic::error("made-name", span, format!("an import declares `{name}`, and so does `{module}` of the library"))
        .here(format!("the times of this system need `{module}`"))
        .with_help(format!("rename your `{name}`"))
}
