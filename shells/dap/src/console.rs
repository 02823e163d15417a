//! What is typed in the debug console: a term, an input that is set, a choice that is made.
//!
//! In: a text. Out: what it asks for.

/// See the module.
#[derive(Debug, PartialEq, Eq)]
pub enum Typed<'t> {
    /// A term to evaluate.
    Term(&'t str),
    /// `location := value`; the value `?` takes it away.
    Set(&'t str, &'t str),
    /// `choice := candidate`
    Choose(&'t str),
}

/// Reads what was typed.
pub fn typed(text: &str) -> Typed<'_> {
    let text = text.trim().trim_end_matches(';').trim();
    match text.split_once(":=") {
        Some((left, right)) if left.trim() == "choice" => Typed::Choose(right.trim()),
        Some((left, right)) if !left.contains('"') => Typed::Set(left.trim(), right.trim()),
        _ => Typed::Term(text),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_typed() {
        assert_eq!(typed(" x = 3 "), Typed::Term("x = 3"));
        assert_eq!(typed("f(A) := true;"), Typed::Set("f(A)", "true"));
        assert_eq!(typed("choice := 1, 2"), Typed::Choose("1, 2"));
        assert_eq!(typed("s = \":=\""), Typed::Term("s = \":=\""));
    }
}
