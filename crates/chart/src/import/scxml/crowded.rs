//! Tags with so many attributes that the XML reader would take too long.

/// LIMIT: attributes of one element. The XML reader compares every pair of them.
pub(super) const MAX_ATTRIBUTES: usize = 1000;

/// The place of the first tag with more attributes than that.
pub(super) fn crowded_tag(text: &str) -> Option<u32> {
    let mut rest = text;
    while let Some(start) = rest.find('<') {
        rest = &rest[start..];
        let tag = (text.len() - rest.len()) as u32;
        // Text in these contains no attributes.
        let other = [("<!--", "-->"), ("<![CDATA[", "]]>"), ("<?", "?>")];
        if let Some((open, close)) = other.iter().find(|(open, _)| rest.starts_with(open)) {
            let end = rest[open.len()..].find(close)?;
            rest = &rest[open.len() + end..];
            continue;
        }
        let (mut attributes, mut quote) = (0, None);
        let end = rest.bytes().position(|byte| {
            match (quote, byte) {
                (None, b'"' | b'\'') => quote = Some(byte),
                (None, b'=') => attributes += 1,
                (Some(open), _) if open == byte => quote = None,
                _ => {}
            }
            attributes > MAX_ATTRIBUTES || quote.is_none() && byte == b'>'
        });
        if attributes > MAX_ATTRIBUTES {
            return Some(tag);
        }
        rest = &rest[end? + 1..];
    }
    None
}
