//! The message of a log point: text with terms in braces, such as `floor {floor}, doors {{open($d) | $d in Doors}}`.
//!
//! In: a text. Out: its parts. Braces in a term are counted, since AsmetaL writes sets with them; those in its strings are not. A
//! brace that is meant as such is written `\{`.

/// A part of a message.
#[derive(Debug, PartialEq, Eq)]
pub enum Part {
    /// As it is written.
    Text(String),
    /// A term.
    Term(String),
}

/// The parts of a message.
///
/// # Errors
/// A sentence: a brace is missing, or has no term.
pub fn parts(message: &str) -> Result<Vec<Part>, String> {
    let mut parts = Vec::new();
    let mut text = String::new();
    let mut letters = message.chars().peekable();
    while let Some(letter) = letters.next() {
        match letter {
            '\\' if matches!(letters.peek(), Some('{' | '}')) => text.extend(letters.next()),
            '{' => {
                let term = term(&mut letters).ok_or_else(|| format!("a `}}` is missing in `{message}`"))?;
                if term.trim().is_empty() {
                    return Err("`{}` has no term: write it between the braces, or `\\{` for a brace".to_string());
                }
                if !text.is_empty() {
                    parts.push(Part::Text(std::mem::take(&mut text)));
                }
                parts.push(Part::Term(term.trim().to_string()));
            }
            _ => text.push(letter),
        }
    }
    if !text.is_empty() {
        parts.push(Part::Text(text));
    }
    Ok(parts)
}

/// The term up to the brace that closes it; none if none does.
fn term(letters: &mut impl Iterator<Item = char>) -> Option<String> {
    let (mut term, mut depth, mut quoted) = (String::new(), 0, false);
    while let Some(letter) = letters.next() {
        match letter {
            '\\' if quoted => {
                term.push(letter);
                term.extend(letters.next());
                continue;
            }
            '"' => quoted = !quoted,
            '{' if !quoted => depth += 1,
            '}' if !quoted && depth == 0 => return Some(term),
            '}' if !quoted => depth -= 1,
            _ => {}
        }
        term.push(letter);
    }
    None
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn terms_stand_in_braces() {
        let told = |message: &str| match parts(message) {
            Ok(parts) => {
                let part = |part: &Part| match part {
                    Part::Text(text) => text.clone(),
                    Part::Term(term) => format!("⟨{term}⟩"),
                };
                parts.iter().map(part).collect::<String>()
            }
            Err(reason) => format!("refused: {reason}"),
        };
        assert_eq!(told("nothing"), "nothing");
        assert_eq!(told("floor { floor }!"), "floor ⟨floor⟩!");
        assert_eq!(told("{x}{y}"), "⟨x⟩⟨y⟩");
        assert_eq!(told("{{1 : 3}} and {{$x in D | $x > 1}}"), "⟨{1 : 3}⟩ and ⟨{$x in D | $x > 1}⟩");
        assert_eq!(told(r#"{"}"} {f("\"}{")}"#), r#"⟨"}"⟩ ⟨f("\"}{")⟩"#);
        assert_eq!(told(r"\{not {x}\} a\b }"), r"{not ⟨x⟩} a\b }");
        assert_eq!(told("{x"), "refused: a `}` is missing in `{x`");
        assert_eq!(told("{{x}"), "refused: a `}` is missing in `{{x}`");
        assert!(told("{ }").starts_with("refused: `{}` has no term"));
    }
}
