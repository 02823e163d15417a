//! Values as text, in the syntax of AsmetaL, so that the text can be read back. Named elements and literals have their
//! names; elements made by `extend` are `domain!k`.

use std::fmt;

use program::{DomainId, DomainKind, Program};

use crate::value::Value;

/// Gives a value a `Display`.
pub trait Show {
    /// The value as AsmetaL would write it.
    fn show<'a>(&'a self, program: &'a Program) -> ShowValue<'a>;
}

impl Show for Value {
    fn show<'a>(&'a self, program: &'a Program) -> ShowValue<'a> {
        ShowValue { value: self, program }
    }
}

/// See [`Show`].
pub struct ShowValue<'a> {
    value: &'a Value,
    program: &'a Program,
}

/// LIMIT: so many bytes of a value are shown to people.
const BRIEF: usize = 4096;

impl<'a> ShowValue<'a> {
    /// The same for people: a long one is cut, and says so.
    pub fn briefly(self) -> BriefValue<'a> {
        BriefValue(self)
    }
}

/// See [`ShowValue::briefly`].
pub struct BriefValue<'a>(ShowValue<'a>);

impl fmt::Display for BriefValue<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let mut cut = Cut { out: f, left: BRIEF, full: false };
        match fmt::write(&mut cut, format_args!("{}", self.0)) {
            Err(_) if cut.full => write!(f, "… (cut here, of {} values)", self.0.value.weight().leaves),
            outcome => outcome,
        }
    }
}

/// Takes this many bytes, and ignores the rest.
struct Cut<'f, 'o> {
    out: &'f mut fmt::Formatter<'o>,
    left: usize,
    full: bool,
}

impl fmt::Write for Cut<'_, '_> {
    fn write_str(&mut self, text: &str) -> fmt::Result {
        if text.len() <= self.left {
            self.left -= text.len();
            return self.out.write_str(text);
        }
        let end = (0..=self.left).rev().find(|end| text.is_char_boundary(*end)).unwrap_or(0);
        self.out.write_str(&text[..end])?;
        self.full = true;
        Err(fmt::Error)
    }
}

impl fmt::Display for ShowValue<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let program = self.program;
        match self.value {
            Value::Undef => f.write_str("undef"),
            Value::Boolean(b) => f.write_str(if *b { "true" } else { "false" }),
            Value::Integer(n) => write!(f, "{n}"),
            Value::Real(r) => real(f, r.get()),
            Value::Enum(domain, index) => match &program.domain(*domain).kind {
                DomainKind::Enum { literals } => f.write_str(&literals[*index as usize]),
                _ => write!(f, "?{index}"),
            },
            Value::Element(domain, index) => match &program.domain(*domain).kind {
                DomainKind::Abstract { elements, .. } if (*index as usize) < elements.len() => {
                    f.write_str(&elements[*index as usize])
                }
                _ => f.write_str(&element_name(program, *domain, *index)),
            },
            Value::Char(c) => write!(f, "'{}'", escaped(&c.to_string(), '\'')),
            Value::Rule(procedure) => write!(f, "<<{}>>", program.procedure(*procedure).name),
            Value::Complex(parts) => {
                let (re, im) = (parts.0.get(), parts.1.get());
                real(f, re)?;
                f.write_str(if im < 0.0 { "-i" } else { "+i" })?;
                real(f, im.abs())
            }
            Value::String(text) => write!(f, "\"{}\"", escaped(text, '"')),
            Value::Tuple(items) => list(f, program, "(", items.iter(), ")"),
            Value::Seq(items) => list(f, program, "[", items.iter(), "]"),
            Value::Set(items) => list(f, program, "{", items.iter(), "}"),
            Value::Bag(items) => {
                let all = items.iter().flat_map(|(item, count)| std::iter::repeat_n(item, *count as usize));
                list(f, program, "<", all, ">")
            }
            Value::Map(items) if items.is_empty() => f.write_str("{->}"),
            Value::Map(items) => {
                f.write_str("{")?;
                for (index, (key, value)) in items.iter().enumerate() {
                    let comma = if index > 0 { "," } else { "" };
                    write!(f, "{comma}{}->{}", key.show(program), value.show(program))?;
                }
                f.write_str("}")
            }
        }
    }
}

/// The name of an element: its static function's, or `domain!k` with `k` from 1 for one made by `extend`.
pub fn element_name(program: &Program, domain: DomainId, index: u32) -> String {
    let entry = program.domain(domain);
    match &entry.kind {
        DomainKind::Abstract { elements, .. } if (index as usize) < elements.len() => elements[index as usize].clone(),
        DomainKind::Abstract { elements, .. } => {
            format!("{}!{}", uncapitalised(&entry.name), index as usize - elements.len() + 1)
        }
        _ => format!("{}!{}", uncapitalised(&entry.name), index + 1),
    }
}

/// The name with its first letter in lower case.
fn uncapitalised(name: &str) -> String {
    let mut letters = name.chars();
    letters.next().map_or(String::new(), |first| first.to_lowercase().chain(letters).collect())
}

fn list<'v>(
    f: &mut fmt::Formatter<'_>,
    program: &Program,
    open: &str,
    items: impl IntoIterator<Item = &'v Value>,
    close: &str,
) -> fmt::Result {
    f.write_str(open)?;
    for (index, item) in items.into_iter().enumerate() {
        let comma = if index > 0 { "," } else { "" };
        write!(f, "{comma}{}", item.show(program))?;
    }
    f.write_str(close)
}

/// A Real: the shortest decimal that reads back as the same double, always with a point.
fn real(f: &mut fmt::Formatter<'_>, number: f64) -> fmt::Result {
    if number.is_infinite() {
        return f.write_str(if number > 0.0 { "Infinity" } else { "-Infinity" });
    }
    write!(f, "{number:?}")
}

fn escaped(text: &str, quote: char) -> String {
    let mut out = String::with_capacity(text.len());
    for c in text.chars() {
        match c {
            '\n' => out.push_str("\\n"),
            '\t' => out.push_str("\\t"),
            '\r' => out.push_str("\\r"),
            '\\' => out.push_str("\\\\"),
            c if c == quote => {
                out.push('\\');
                out.push(c);
            }
            c => out.push(c),
        }
    }
    out
}
