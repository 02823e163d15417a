//! A fingerprint of a model's texts: shows whether a trace was made from the same model.

use syntax::Sources;

/// FNV-1a over the texts in the order they were read, as 16 hexadecimal digits. File names do not count, so a moved
/// model keeps its fingerprint.
pub fn fingerprint(sources: &Sources) -> String {
    let mut hash = 0xcbf2_9ce4_8422_2325_u64;
    let mut add = |byte: u8| hash = (hash ^ u64::from(byte)).wrapping_mul(0x0100_0000_01b3);
    for (_, file) in sources.iter() {
        file.text.bytes().for_each(&mut add);
        add(0xff);
    }
    format!("{hash:016x}")
}
