//! A fingerprint of all texts of a model: tells whether a trace was made of the same model.

use syntax::Sources;

/// FNV-1a over the texts in the order read, as 16 hexadecimal digits. Names do not count: a moved model is the same.
pub fn fingerprint(sources: &Sources) -> String {
    let mut hash = 0xcbf2_9ce4_8422_2325_u64;
    let mut add = |byte: u8| hash = (hash ^ u64::from(byte)).wrapping_mul(0x0100_0000_01b3);
    for (_, file) in sources.iter() {
        file.text.bytes().for_each(&mut add);
        add(0xff);
    }
    format!("{hash:016x}")
}
