//! Faults of patterns that answer yes or no, and of what is to be refined by them.

use syntax::{Diagnostic, Span};

const ID: &str = "pattern-answer";

/// A pattern that is left with an answer on some paths, and without one on others.
pub(crate) fn sometimes(span: Span, name: &str, with: Span) -> Diagnostic {
    Diagnostic::error(ID, span, format!("`{name}` is left without an answer here"))
        .here("a block of it leads on by its answer, so there must be one")
        .with_label(with, "here it answers")
        .with_help("write `exit yes` or `exit no`; or `exit` everywhere, if it is not to answer")
}

/// A pattern that has only one of the answers.
pub(crate) fn always(span: Span, name: &str, missing: bool) -> Diagnostic {
    let (there, missing) = if missing { ("no", "yes") } else { ("yes", "no") };
    Diagnostic::error(ID, span, format!("no path of `{name}` leads to `exit {missing}`: it can only answer {there}"))
        .here("a pattern that answers has both answers")
        .with_help(format!("lead a path to `exit {missing}`; or write `exit`, if it is not to answer"))
}

/// A pattern that would have to answer in the step that enters it.
pub(crate) fn at_once(span: Span, name: &str) -> Diagnostic {
    Diagnostic::error(ID, span, format!("`{name}` answers in the step that enters it"))
        .here("it has no control state, and its answer is looked at in a later step")
        .with_help("put a control state on its way; or declare a guard instead, whose term says the answer")
}

/// A pattern that need not be entered when its block is.
pub(crate) fn not_entered(span: Span, name: &str, guard: &str, missing: bool) -> Diagnostic {
    let missing = if missing { "yes" } else { "no" };
    Diagnostic::error(ID, span, format!("`{name}` is not entered if `{guard}` is {missing}"))
        .here("then its block would lead on without an answer")
        .with_help(format!("write a path `{guard} {missing} -> …`, for instance to a control state in which it waits"))
}

/// An arrow out of the block of a pattern that answers, which says neither yes nor no.
pub(crate) fn bare_block(span: Span, name: &str, pattern: &str) -> Diagnostic {
    Diagnostic::error("guard-exit", span, format!("the arrow out of the block `{name}` says neither yes nor no"))
        .here(format!("the pattern `{pattern}` answers, so its block has two exits"))
        .with_help(format!("write `{name} yes -> …` or `{name} no -> …`"))
}

/// `yes` or `no` after the block of a pattern that does not answer.
pub(crate) fn needless_branch(span: Span, name: &str, pattern: &str) -> Diagnostic {
    Diagnostic::error("guard-exit", span, format!("`{name}` is neither a guard nor a pattern that answers"))
        .here(format!("the pattern `{pattern}` is left over `exit`, without an answer"))
        .with_help("remove `yes` or `no`; or let the paths of the pattern end at `exit yes` and `exit no`")
}

/// A function for an answer that an import already declares.
pub(crate) fn made_already(span: Span, name: &str) -> Diagnostic {
    Diagnostic::error("made-name", span, format!("an import declares `{name}` already"))
        .here("a function of this name is made, for what the pattern answers")
        .with_help("choose another name for the pattern")
}

/// Something that cannot refine a shape, with the reason and the remedy.
pub(crate) fn unfit(span: Span, shape: &str, by: &str, reason: &str, help: String) -> Diagnostic {
    Diagnostic::warning("unfit-refinement", span, format!("`{shape}` cannot be refined by `{by}`: {reason}"))
        .here("nothing can be proved of it as it is")
        .with_help(help)
}
