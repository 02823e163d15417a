//! The bytes of a file as text: UTF-8, or otherwise Windows-1252.
//!
//! In: all bytes of a file. Out: the text, and, if it was not UTF-8, the first byte that shows it ([`Foreign`]). Older
//! models hold comments in the encoding of some editor. Windows-1252, which extends Latin-1, is by far the most usual
//! one, and gives every byte a meaning (WHATWG Encoding Standard, index windows-1252). INVARIANT: UTF-8 is never
//! changed.

use crate::{Diagnostic, FileId, Span};

/// What shows that a file was not UTF-8.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Foreign {
    /// The first byte that does not belong to a character of UTF-8.
    pub byte: u8,
    /// Its place in the file, from 0.
    pub offset: usize,
    /// How many bytes were read as Windows-1252 letters.
    pub count: usize,
    /// The place of its letter in the text.
    at: u32,
}

impl Foreign {
    /// The warning that says so.
    pub fn warning(&self, file: FileId) -> Diagnostic {
        let letter = letter(self.byte);
        let end = self.at + letter.len_utf8() as u32;
        let Foreign { byte, offset, count, at: start } = *self;
        let message =
            format!("the file is not UTF-8: byte 0x{byte:02X} at offset {offset} does not belong to a character");
        let all = match count - 1 {
            0 => String::new(),
            1 => ", and so was one byte more".to_string(),
            more => format!(", and so were {more} bytes more"),
        };
        Diagnostic::warning("not-utf8", Span { file, start, end }, message)
            .here(format!("read as `{letter}`, as in Windows-1252{all}"))
            .with_help("save the file as UTF-8")
    }
}

/// The text of a file, unless the bytes are not text at all.
pub(crate) fn decode(bytes: Vec<u8>) -> Result<(String, Option<Foreign>), NotText> {
    let (bytes, offset) = match String::from_utf8(bytes) {
        Ok(text) => return Ok((text, None)),
        Err(error) => {
            let offset = error.utf8_error().valid_up_to();
            (error.into_bytes(), offset)
        }
    };
    // No encoding of bytes writes a zero within a text; UTF-16, pictures and programs do.
    if bytes.contains(&0) {
        return Err(NotText { offset });
    }
    let mut text = String::with_capacity(bytes.len() + bytes.len() / 8);
    let mut count = 0;
    let mut at = 0;
    for chunk in bytes.utf8_chunks() {
        text.push_str(chunk.valid());
        for byte in chunk.invalid() {
            if count == 0 {
                at = text.len() as u32;
            }
            count += 1;
            text.push(letter(*byte));
        }
    }
    Ok((text, Some(Foreign { byte: bytes[offset], offset, count, at })))
}

/// Bytes that are neither UTF-8 nor a text in an encoding of single bytes.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct NotText {
    /// The first byte that does not belong to a character of UTF-8, from 0.
    pub offset: usize,
}

/// A byte in Windows-1252.
fn letter(byte: u8) -> char {
    const FROM_80: [char; 32] = [
        '€', '\u{81}', '‚', 'ƒ', '„', '…', '†', '‡', 'ˆ', '‰', 'Š', '‹', 'Œ', '\u{8d}', 'Ž', '\u{8f}', '\u{90}', '‘',
        '’', '“', '”', '•', '–', '—', '˜', '™', 'š', '›', 'œ', '\u{9d}', 'ž', 'Ÿ',
    ];
    match byte {
        0x80..=0x9f => FROM_80[usize::from(byte - 0x80)],
        byte => char::from(byte),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn check(bytes: &[u8], text: &str, foreign: Option<(u8, usize, usize)>) {
        let (decoded, found) = decode(bytes.to_vec()).expect("a text");
        assert_eq!(decoded, text);
        assert_eq!(found.map(|found| (found.byte, found.offset, found.count)), foreign);
        if let Some(found) = found {
            assert!(decoded[found.at as usize..].starts_with(letter(found.byte)));
        }
    }

    #[test]
    fn utf8_is_left_alone() {
        check("// caffè\r\n".as_bytes(), "// caffè\r\n", None);
        check(b"", "", None);
    }

    #[test]
    fn other_bytes_are_letters_of_windows_1252() {
        check(b"// caff\xe8\r\n", "// caffè\r\n", Some((0xe8, 7, 1)));
        check(b"\x80\x9f\xff \x81", "€Ÿÿ \u{81}", Some((0x80, 0, 4)));
    }

    #[test]
    fn what_is_utf8_in_such_a_file_stays() {
        check(b"\xc3\xa8 \xe8 \xe2\x80", "è è â€", Some((0xe8, 3, 3)));
    }

    #[test]
    fn what_holds_zeros_is_no_text() {
        assert_eq!(decode(b"\xff\xfea\0s\0m\0".to_vec()), Err(NotText { offset: 0 }));
        check(b"a\0", "a\0", None);
    }
}
