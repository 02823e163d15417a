//! Text and numbers as they stand in markup.
//!
//! INVARIANT: text from a model reaches a page only through [`Text`], so no name can become markup.

use std::fmt;

/// Text in an element or in a double-quoted attribute.
pub(crate) struct Text<T>(pub T);

impl<T: fmt::Display> fmt::Display for Text<T> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        struct Escape<'a, 'b>(&'a mut fmt::Formatter<'b>);
        impl fmt::Write for Escape<'_, '_> {
            fn write_str(&mut self, text: &str) -> fmt::Result {
                for c in text.chars() {
                    match c {
                        '&' => self.0.write_str("&amp;")?,
                        '<' => self.0.write_str("&lt;")?,
                        '>' => self.0.write_str("&gt;")?,
                        '"' => self.0.write_str("&quot;")?,
                        // Not allowed in XML at all.
                        c if c < ' ' && !matches!(c, '\t' | '\n' | '\r') => self.0.write_str("\u{fffd}")?,
                        '\u{fffe}' | '\u{ffff}' => self.0.write_str("\u{fffd}")?,
                        c => self.0.write_char(c)?,
                    }
                }
                Ok(())
            }
        }
        fmt::write(&mut Escape(f), format_args!("{}", self.0))
    }
}

/// A length: two decimals at most, none needless.
pub(crate) struct Px(pub f64);

impl fmt::Display for Px {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let text = format!("{:.2}", self.0);
        let text = text.trim_end_matches('0').trim_end_matches('.');
        f.write_str(if text == "-0" { "0" } else { text })
    }
}

/// Text as a JSON string that is safe inside a `script` element.
pub(crate) struct Json<'a>(pub &'a str);

impl fmt::Display for Json<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("\"")?;
        for c in self.0.chars() {
            match c {
                '"' => f.write_str("\\\"")?,
                '\\' => f.write_str("\\\\")?,
                c if c < ' ' || matches!(c, '<' | '>' | '&' | '\u{2028}' | '\u{2029}') => {
                    write!(f, "\\u{:04x}", c as u32)?
                }
                c => write!(f, "{c}")?,
            }
        }
        f.write_str("\"")
    }
}

/// Bytes as a `data:` address has them.
pub(crate) struct Base64<'a>(pub &'a [u8]);

impl fmt::Display for Base64<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        const DIGITS: &[u8; 64] = b"ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
        for three in self.0.chunks(3) {
            let bits = (0..3).fold(0, |bits, at| bits << 8 | u32::from(three.get(at).copied().unwrap_or(0)));
            let digits: String = (0..4)
                .map(|at| match at <= three.len() {
                    true => char::from(DIGITS[(bits >> (18 - 6 * at) & 63) as usize]),
                    false => '=',
                })
                .collect();
            f.write_str(&digits)?;
        }
        Ok(())
    }
}

/// Appends formatted text to a `String`.
macro_rules! put {
    ($out:expr, $($format:tt)*) => {{
        use std::fmt::Write as _;
        // Writing to a String cannot fail.
        let _ = write!($out, $($format)*);
    }};
}
pub(crate) use put;

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn bytes_become_digits() {
        let coded: Vec<String> = ["", "f", "fo", "foo", "foob"].map(|text| Base64(text.as_bytes()).to_string()).into();
        assert_eq!(coded, ["", "Zg==", "Zm8=", "Zm9v", "Zm9vYg=="]);
    }

    #[test]
    fn names_cannot_become_markup() {
        assert_eq!(Text("<script>\"&\u{1}").to_string(), "&lt;script&gt;&quot;&amp;\u{fffd}");
        assert_eq!(Json("</script>\"\\\n").to_string(), "\"\\u003c/script\\u003e\\\"\\\\\\u000a\"");
        assert_eq!(format!("{} {} {}", Px(1.0), Px(0.125), Px(-0.001)), "1 0.12 0");
    }
}
