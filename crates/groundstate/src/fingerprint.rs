//! A fingerprint of a model's texts: shows whether a trace, or C++, was made from the same model.

use syntax::Sources;

/// FNV-1a over the texts in the order they were read, as 16 hexadecimal digits. File names do not count, so a moved
/// model keeps its fingerprint.
pub fn fingerprint(sources: &Sources) -> String {
    shown(sources.iter().flat_map(|(_, file)| file.text.bytes().chain([0xff])))
}

/// The same of one text.
pub fn text_fingerprint(text: &str) -> String {
    shown(text.bytes())
}

fn shown(bytes: impl Iterator<Item = u8>) -> String {
    let add = |hash: u64, byte: u8| (hash ^ u64::from(byte)).wrapping_mul(0x0100_0000_01b3);
    format!("{:016x}", bytes.fold(0xcbf2_9ce4_8422_2325_u64, add))
}
