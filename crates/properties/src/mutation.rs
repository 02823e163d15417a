//! Mutations of a text: tokens lost, doubled, exchanged, taken from elsewhere; bytes flipped.
//!
//! In: a text, others of its kind, words of the language, a seed. Out: bytes like it, the same for the same seed. Most
//! mutations change one or two tokens, so many of the models still check and reach the later stages.

/// Steele, Lea, Flood: SplitMix64.
#[derive(Debug, Clone)]
pub struct SplitMix(u64);

impl SplitMix {
    /// A generator; the same seed gives the same numbers.
    pub fn new(seed: u64) -> SplitMix {
        SplitMix(seed)
    }

    /// A number below the bound; 0 if the bound is 0.
    pub fn below(&mut self, bound: u64) -> u64 {
        self.0 = self.0.wrapping_add(0x9E37_79B9_7F4A_7C15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xBF58_476D_1CE4_E5B9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94D0_49BB_1331_11EB);
        (z ^ (z >> 31)) % bound.max(1)
    }

    fn index(&mut self, length: usize) -> usize {
        self.below(length as u64) as usize
    }

    fn pick<'a, T>(&mut self, from: &'a [T]) -> Option<&'a T> {
        let index = self.index(from.len());
        from.get(index)
    }
}

/// What characters a token is made of.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Kind {
    Space,
    Number,
    Word,
    Sign,
}

fn kind(letter: char) -> Kind {
    match letter {
        letter if letter.is_whitespace() => Kind::Space,
        '0'..='9' => Kind::Number,
        letter if letter.is_alphanumeric() || letter == '_' || letter == '$' => Kind::Word,
        _ => Kind::Sign,
    }
}

/// Runs of spaces, of digits, of letters; signs one by one.
fn tokens(text: &str) -> Vec<&str> {
    let mut tokens = Vec::new();
    let (mut begin, mut before) = (0, None);
    for (at, letter) in text.char_indices() {
        let mut now = kind(letter);
        if before == Some(Kind::Word) && now == Kind::Number {
            now = Kind::Word;
        }
        if at > begin && (before != Some(now) || now == Kind::Sign) {
            tokens.push(&text[begin..at]);
            begin = at;
        }
        before = Some(now);
    }
    if begin < text.len() {
        tokens.push(&text[begin..]);
    }
    tokens
}

/// Numbers at which something changes.
const EDGES: &[&str] =
    &["0", "1", "2", "300", "3001", "2147483648", "9223372036854775807", "9223372036854775808", "1e400"];

/// A text like `text`, with whole lines lost, doubled, exchanged, indented, or taken from elsewhere.
pub fn with_lines_mutated(text: &str, others: &[String], random: &mut SplitMix) -> String {
    let mut lines: Vec<String> = text.split_inclusive('\n').map(str::to_string).collect();
    for _ in 0..=random.below(3) {
        if lines.is_empty() {
            break;
        }
        let (at, to) = (random.index(lines.len()), random.index(lines.len()));
        match random.below(7) {
            0 => {
                lines.remove(at);
            }
            1 => {
                let line = lines[at].clone();
                lines.insert(to, line);
            }
            2 => lines.swap(at, to),
            3 => lines[at].insert_str(0, ["\t", "  ", "// ", "\u{a0}", "\r"][random.index(5)]),
            4 => lines[at] = lines[at].trim_end_matches('\n').to_string(),
            5 => {
                let other = random.pick(others).map(|other| other.split_inclusive('\n').collect::<Vec<_>>());
                let line = other.and_then(|lines| random.pick(&lines).map(|line| (*line).to_string()));
                lines.insert(at, line.unwrap_or_default());
            }
            _ => lines.insert(0, ["\t// comment\n", "\n\n", " /* a */ ", "\u{feff}"][random.index(4)].to_string()),
        }
    }
    lines.concat()
}

/// A text like `text`; parts from elsewhere come from `others` or `words`.
pub fn mutated(text: &str, others: &[String], words: &[String], random: &mut SplitMix) -> Vec<u8> {
    let mut tokens: Vec<&str> = tokens(text);
    for _ in 0..[1, 1, 1, 2, 2, 5][random.index(6)] {
        wound(&mut tokens, others, words, random);
    }
    let mut bytes: Vec<u8> = tokens.concat().into_bytes();
    if random.below(16) == 0 && !bytes.is_empty() {
        let at = random.index(bytes.len());
        bytes[at] ^= 1 << random.below(8);
    }
    bytes
}

fn wound<'a>(found: &mut Vec<&'a str>, others: &'a [String], words: &'a [String], random: &mut SplitMix) {
    if found.is_empty() {
        found.extend(words.first().map(String::as_str));
        return;
    }
    let at = random.index(found.len());
    let end = (at + 1 + random.index(8)).min(found.len());
    match random.below(10) {
        0 => {
            found.remove(at);
        }
        1 => {
            found.drain(at..end);
        }
        2 => {
            let part = found[at..end].to_vec();
            let to = random.index(found.len());
            found.splice(to..to, part);
        }
        3 => {
            let other = random.index(found.len());
            found.swap(at, other);
        }
        // One of the same kind: often it still checks.
        4..=6 => {
            let of = |token: &str| token.chars().next().map(kind);
            let same: Vec<&str> = found.iter().copied().filter(|token| of(token) == of(found[at])).collect();
            found[at] = match of(found[at]) {
                Some(Kind::Number) => EDGES[random.index(EDGES.len())],
                _ => same[random.index(same.len())],
            };
        }
        7 => found[at] = random.pick(words).map_or("", String::as_str),
        8 => {
            let other = random.pick(others).map(|other| tokens(other)).unwrap_or_default();
            let from = random.index(other.len());
            let part = &other[from..(from + 1 + random.index(12)).min(other.len())];
            found.splice(at..end, part.iter().copied());
        }
        _ => {
            if random.below(4) == 0 {
                found.truncate(at);
            } else if let Some(word) = random.pick(words) {
                found.insert(at, word);
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_text_is_its_tokens() {
        assert_eq!(tokens("r_a := x1+12 "), ["r_a", " ", ":", "=", " ", "x1", "+", "12", " "]);
    }

    #[test]
    fn the_same_seed_gives_the_same_wounds() {
        let words = ["seq".to_string(), "par".to_string()];
        let others = ["rule r_Main = skip".to_string()];
        let wounds = |seed| mutated("asm a\nsignature:\ndefinitions:\n", &others, &words, &mut SplitMix::new(seed));
        for seed in 0..200 {
            assert_eq!(wounds(seed), wounds(seed));
        }
        let different: std::collections::BTreeSet<Vec<u8>> = (0..200).map(wounds).collect();
        assert!(different.len() > 150, "{}", different.len());
    }
}
