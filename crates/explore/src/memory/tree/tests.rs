//! A tree knows what it has learned, and nothing else, wherever the codes of a wide field lie.
//!
//! In: steps that look at one or two fields whose codes come densely, sparsely or in any order. Out: for each code the end
//! that was learned for it; codes that were not learned are not known.

use std::collections::BTreeMap;

use machine::Interrupt;
use program::FunctionId;

use super::*;

fn field(word: u32, bits: u8) -> Field {
    Field { location: word, function: FunctionId(0), word, shift: 3, bits, few: false }
}

fn ends(tree: &mut Tree, words: &[u64]) -> Option<Vec<End>> {
    let mut ends = Vec::new();
    tree.walk(words, &Interrupt::default(), &mut |end| ends.push(end)).ok()?;
    Some(ends)
}

/// Learns a step for each pair of codes, each its own, and looks for them and for their neighbours.
fn check(pairs: impl Iterator<Item = (u64, u64)>) {
    let fields = [field(0, 32), field(1, 20)];
    let events = [Event::Look(0), Event::Look(1)];
    let mut tree = Tree::default();
    let mut learned = BTreeMap::new();
    let words = |(a, b): (u64, u64)| [a << 3 | 5, b << 3 | 1 << 60];
    for (number, pair) in pairs.enumerate() {
        let end = number as End + 1;
        if learned.contains_key(&pair) {
            continue;
        }
        learned.insert(pair, end);
        tree.learn(&fields, &words(pair), &events, &[], end);
    }
    for (a, b) in learned.keys() {
        let near = [(*a, *b), (a + 1, *b), (*a, b + 1), (*b, *a), (a ^ 64, *b), (*a, b ^ 1 << 19)];
        let fits = |(a, b): &(u64, u64)| *a < 1 << 32 && *b < 1 << 20;
        for pair in near.into_iter().filter(fits) {
            assert_eq!(ends(&mut tree, &words(pair)), learned.get(&pair).map(|end| vec![*end]), "{pair:?}");
        }
    }
    let mut told: Vec<End> = Vec::new();
    tree.each_end(&mut |_, end| told.push(end));
    told.sort_unstable();
    let mut expected: Vec<End> = learned.into_values().collect();
    expected.sort_unstable();
    assert_eq!(told, expected);
}

#[test]
fn dense_codes_are_known() {
    check((0..300).map(|number| (number, number % 7)));
    check((0..300).rev().map(|number| (number % 20, number)));
}

#[test]
fn sparse_codes_are_known_and_come_to_stand_by_code() {
    check((0..300).map(|number| (number * number * 31 % 1009, number * 7919 % 5003)));
    // The far ones come first, the near ones then overtake them.
    let far = (0..40).map(|number| (3, 5000 - number * 100));
    check(far.chain((0..2000).map(|number| (3, number))).chain([(3, (1 << 20) - 1), ((1 << 32) - 1, 2)]));
}
