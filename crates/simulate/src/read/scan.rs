//! The reader of [`super::read_value`]: a cursor over the text, directed by the expected domain.

use std::sync::Arc;

use machine::{Real, Value};
use model::Basic;
use program::{DomainId, DomainKind, ProcedureId, Program};

use super::{element, real, type_domain};

/// A cursor. An error says only that the text does not fit; [`super::expectation`] words it.
pub(super) struct Scan<'a> {
    program: &'a Program,
    rest: &'a str,
    depth: u32,
}

type Read<T> = Result<T, ()>;

/// Deeper nesting is refused, so no text can exhaust the stack.
const DEPTH: u32 = 200;

impl<'a> Scan<'a> {
    pub fn new(program: &'a Program, text: &'a str) -> Self {
        Scan { program, rest: text, depth: 0 }
    }

    /// Only blanks may be left.
    pub fn end(&mut self) -> Read<()> {
        if self.rest.trim().is_empty() { Ok(()) } else { Err(()) }
    }

    /// `name` or `name(value, …)` with values of these domains.
    pub fn arguments(&mut self, parameters: &[DomainId]) -> Read<Vec<Value>> {
        let open = self.rest.find('(').unwrap_or(self.rest.len());
        self.rest = &self.rest[open..];
        if parameters.is_empty() {
            if self.eat("(") {
                self.expect(")")?;
            }
            return Ok(Vec::new());
        }
        self.expect("(")?;
        let values = self.components(parameters)?;
        self.expect(")")?;
        Ok(values)
    }

    fn components(&mut self, domains: &[DomainId]) -> Read<Vec<Value>> {
        let mut values = Vec::with_capacity(domains.len());
        for (index, domain) in domains.iter().enumerate() {
            if index > 0 {
                self.expect(",")?;
            }
            values.push(self.value(*domain)?);
        }
        Ok(values)
    }

    /// A value of the domain.
    pub fn value(&mut self, domain: DomainId) -> Read<Value> {
        self.depth += 1;
        if self.depth > DEPTH {
            return Err(());
        }
        let value = self.value_inside(domain);
        self.depth -= 1;
        value
    }

    fn value_inside(&mut self, domain: DomainId) -> Read<Value> {
        self.blanks();
        let before = self.rest;
        if self.word() == "undef" {
            return Ok(Value::Undef);
        }
        self.rest = before;
        let program = self.program;
        let domain = type_domain(program, domain);
        match &program.domain(domain).kind {
            DomainKind::Basic(basic) => self.basic(*basic),
            DomainKind::Enum { literals } => {
                let word = self.word();
                let index = literals.iter().position(|literal| literal == word).ok_or(())?;
                Ok(Value::Enum(domain, index as u32))
            }
            DomainKind::Abstract { .. } => element(program, domain, self.word()).ok_or(()),
            DomainKind::Prod(parts) => {
                self.expect("(")?;
                let values = self.components(parts)?;
                self.expect(")")?;
                Ok(Value::tuple(values))
            }
            DomainKind::Seq(of) => Ok(Value::seq(self.elements("[", *of, "]")?)),
            DomainKind::Powerset(of) => Ok(Value::set(self.elements("{", *of, "}")?)),
            DomainKind::Bag(of) => Ok(Value::bag(self.elements("<", *of, ">")?)),
            DomainKind::Map(key, of) => self.map(*key, *of),
            DomainKind::Rule(_) => self.rule(),
            DomainKind::Any => self.any(domain),
            DomainKind::Concrete { .. } | DomainKind::Error => Err(()),
        }
    }

    fn basic(&mut self, basic: Basic) -> Read<Value> {
        match basic {
            Basic::Boolean => match self.word() {
                "true" => Ok(Value::Boolean(true)),
                "false" => Ok(Value::Boolean(false)),
                _ => Err(()),
            },
            Basic::Integer => self.integer(),
            Basic::Natural => match self.integer()? {
                Value::Integer(n) if n < 0 => Err(()),
                value => {
                    self.eat("n");
                    Ok(value)
                }
            },
            Basic::Real => real(self.number()?).ok_or(()),
            Basic::Complex => self.complex(),
            Basic::Char => {
                let text = self.quoted('\'')?;
                let mut chars = text.chars();
                match (chars.next(), chars.next()) {
                    (Some(c), None) => Ok(Value::Char(c)),
                    _ => Err(()),
                }
            }
            Basic::String => Ok(Value::string(self.quoted('"')?)),
            Basic::Undef => Err(()),
        }
    }

    fn integer(&mut self) -> Read<Value> {
        self.blanks();
        let sign = usize::from(self.rest.starts_with(['-', '+']));
        let digits = self.rest[sign..].bytes().take_while(u8::is_ascii_digit).count();
        let (number, rest) = self.rest.split_at(sign + digits);
        if rest.starts_with('.') {
            return Err(());
        }
        self.rest = rest;
        number.parse().map(Value::Integer).map_err(|_| ())
    }

    fn number(&mut self) -> Read<f64> {
        self.blanks();
        let sign = usize::from(self.rest.starts_with(['-', '+']));
        if let Some(rest) = self.rest[sign..].strip_prefix("Infinity") {
            let negative = self.rest.starts_with('-');
            self.rest = rest;
            return Ok(if negative { f64::NEG_INFINITY } else { f64::INFINITY });
        }
        let bytes = self.rest.as_bytes();
        let mut end = sign;
        while end < bytes.len() {
            let exponent_sign = matches!(bytes[end], b'+' | b'-') && matches!(bytes[end - 1], b'e' | b'E');
            if !(bytes[end].is_ascii_digit() || matches!(bytes[end], b'.' | b'e' | b'E') || exponent_sign) {
                break;
            }
            end += 1;
        }
        let (number, rest) = self.rest.split_at(end);
        self.rest = rest;
        number.parse().map_err(|_| ())
    }

    /// `re`, `re+iim`, `re-iim`, `iim`, `-iim`.
    fn complex(&mut self) -> Read<Value> {
        self.blanks();
        let imaginary = |text: &str| text.trim_start_matches(['+', '-']).starts_with('i');
        let re = if imaginary(self.rest) { 0.0 } else { self.number()? };
        let mut im = 0.0;
        if imaginary(self.rest) {
            let sign = if self.rest.starts_with('-') { -1.0 } else { 1.0 };
            self.rest = self.rest.trim_start_matches(['+', '-']).strip_prefix('i').ok_or(())?;
            im = sign * if self.rest.starts_with(|c: char| c.is_ascii_digit()) { self.number()? } else { 1.0 };
        }
        Ok(Value::Complex(Arc::new((Real::new(re).ok_or(())?, Real::new(im).ok_or(())?))))
    }

    fn quoted(&mut self, quote: char) -> Read<String> {
        self.blanks();
        let mut chars = self.rest.char_indices();
        if chars.next().map(|(_, c)| c) != Some(quote) {
            return Err(());
        }
        let mut text = String::new();
        while let Some((at, c)) = chars.next() {
            match c {
                c if c == quote => {
                    self.rest = &self.rest[at + c.len_utf8()..];
                    return Ok(text);
                }
                '\\' => text.push(match chars.next().ok_or(())?.1 {
                    'n' => '\n',
                    't' => '\t',
                    'r' => '\r',
                    'b' => '\u{8}',
                    'f' => '\u{c}',
                    other => other,
                }),
                c => text.push(c),
            }
        }
        Err(())
    }

    fn elements(&mut self, open: &str, of: DomainId, close: &str) -> Read<Vec<Value>> {
        self.expect(open)?;
        let mut values = Vec::new();
        if self.eat(close) {
            return Ok(values);
        }
        loop {
            values.push(self.value(of)?);
            if !self.eat(",") {
                break;
            }
        }
        self.expect(close)?;
        Ok(values)
    }

    fn map(&mut self, key: DomainId, of: DomainId) -> Read<Value> {
        self.expect("{")?;
        let mut entries = Vec::new();
        if self.eat("->") || self.rest.trim_start().starts_with('}') {
            self.expect("}")?;
            return Ok(Value::map(entries));
        }
        loop {
            let k = self.value(key)?;
            self.expect("->")?;
            entries.push((k, self.value(of)?));
            if !self.eat(",") {
                break;
            }
        }
        self.expect("}")?;
        Ok(Value::map(entries))
    }

    fn rule(&mut self) -> Read<Value> {
        self.expect("<<")?;
        let name = self.word();
        self.expect(">>")?;
        let index = self.program.procedures.iter().position(|procedure| procedure.name == name).ok_or(())?;
        Ok(Value::Rule(ProcedureId(index as u32)))
    }

    /// A value whose domain is not known: its text shows it.
    fn any(&mut self, domain: DomainId) -> Read<Value> {
        match self.rest.chars().next().ok_or(())? {
            '"' => Ok(Value::string(self.quoted('"')?)),
            '\'' => self.basic(Basic::Char),
            '(' => Ok(Value::tuple(self.elements("(", domain, ")")?)),
            '[' => Ok(Value::seq(self.elements("[", domain, "]")?)),
            '{' if self.rest.contains("->") => self.map(domain, domain),
            '{' => Ok(Value::set(self.elements("{", domain, "}")?)),
            '<' if self.rest.starts_with("<<") => self.rule(),
            '<' => Ok(Value::bag(self.elements("<", domain, ">")?)),
            c if c.is_ascii_digit() || c == '-' => {
                let before = self.rest;
                self.integer().or_else(|()| {
                    self.rest = before;
                    real(self.number()?).ok_or(())
                })
            }
            _ => {
                let word = self.word();
                match word {
                    "true" => return Ok(Value::Boolean(true)),
                    "false" => return Ok(Value::Boolean(false)),
                    _ => {}
                }
                let domains = self.program.domains.iter().enumerate();
                let mut found = domains.filter_map(|(index, entry)| {
                    let id = DomainId(index as u32);
                    match &entry.kind {
                        DomainKind::Enum { literals } => {
                            let place = literals.iter().position(|literal| literal == word)?;
                            Some(Value::Enum(id, place as u32))
                        }
                        _ => element(self.program, id, word),
                    }
                });
                found.next().ok_or(())
            }
        }
    }

    fn word(&mut self) -> &'a str {
        self.blanks();
        let end = self.rest.find(|c: char| !(c.is_alphanumeric() || c == '_' || c == '!')).unwrap_or(self.rest.len());
        let (word, rest) = self.rest.split_at(end);
        self.rest = rest;
        word
    }

    fn blanks(&mut self) {
        self.rest = self.rest.trim_start();
    }

    fn eat(&mut self, text: &str) -> bool {
        self.blanks();
        match self.rest.strip_prefix(text) {
            Some(rest) => {
                self.rest = rest;
                true
            }
            None => false,
        }
    }

    fn expect(&mut self, text: &str) -> Read<()> {
        if self.eat(text) { Ok(()) } else { Err(()) }
    }
}
