//! The checksum of MCAP files: the CRC-32 of ISO 3309, over bytes that come piece by piece.
//!
//! In: bytes. Out: their checksum, as the format stores it. It takes eight bytes at a time, because a log is long.

/// A checksum on its way.
#[derive(Debug, Clone, Copy)]
pub struct Checksum(u32);

/// `TABLES[k][byte]`: the value of a byte that `k` more bytes follow.
static TABLES: [[u32; 256]; 8] = tables();

const fn tables() -> [[u32; 256]; 8] {
    let mut tables = [[0; 256]; 8];
    let mut byte = 0;
    while byte < 256 {
        let mut entry = byte as u32;
        let mut bit = 0;
        while bit < 8 {
            entry = (entry >> 1) ^ if entry & 1 == 1 { 0xedb8_8320 } else { 0 };
            bit += 1;
        }
        tables[0][byte] = entry;
        byte += 1;
    }
    let mut behind = 1;
    while behind < 8 {
        let mut byte = 0;
        while byte < 256 {
            let before = tables[behind - 1][byte];
            tables[behind][byte] = (before >> 8) ^ tables[0][(before & 0xff) as usize];
            byte += 1;
        }
        behind += 1;
    }
    tables
}

impl Default for Checksum {
    fn default() -> Checksum {
        Checksum(u32::MAX)
    }
}

impl Checksum {
    /// The checksum of these bytes.
    pub fn of(bytes: &[u8]) -> u32 {
        let mut sum = Checksum::default();
        sum.add(bytes);
        sum.value()
    }

    /// Goes on with these bytes.
    pub fn add(&mut self, bytes: &[u8]) {
        let eights = bytes.chunks_exact(8);
        let rest = eights.remainder();
        for eight in eights {
            let (mut sum, first) = (0, self.0.to_le_bytes());
            for (at, byte) in eight.iter().enumerate() {
                sum ^= TABLES[7 - at][usize::from(byte ^ first.get(at).unwrap_or(&0))];
            }
            self.0 = sum;
        }
        for byte in rest {
            self.0 = (self.0 >> 8) ^ TABLES[0][((self.0 ^ u32::from(*byte)) & 0xff) as usize];
        }
    }

    /// The checksum of all bytes so far.
    pub fn value(self) -> u32 {
        !self.0
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn it_is_the_one_of_the_standard_in_pieces_of_any_size() {
        assert_eq!(Checksum::of(b""), 0);
        assert_eq!(Checksum::of(b"123456789"), 0xcbf4_3926);
        let text = b"The quick brown fox jumps over the lazy dog";
        for size in 1..text.len() {
            let mut sum = Checksum::default();
            text.chunks(size).for_each(|piece| sum.add(piece));
            assert_eq!(sum.value(), 0x414f_a339, "pieces of {size}");
        }
    }
}
