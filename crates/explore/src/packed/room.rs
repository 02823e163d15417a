//! Which collections stand in place, and how long sequences may be: as long as the words of a state have room for.
//!
//! In: by function how many bits its values need by number, and the collections that might stand in place. Out: those that
//! do. A state that needs one word more takes longer to find than a sequence by its number, and a sequence that becomes
//! too long makes the search begin again. So sequences stand in place where states stay short, and get all the bits that their
//! words have left. INVARIANT: a state needs no more words than it would with numbers.

use crate::packed::codes::NUMBER;
use crate::packed::collection::Collection;

/// LIMIT: states of more words hold sequences by number.
const WORDS: usize = 2;

/// The fields of a function.
#[derive(Debug)]
pub(crate) struct Want {
    /// How many bits each needs where it is no collection in place.
    pub bits: Vec<usize>,
    /// The collections that may stand there.
    pub collection: Option<Collection>,
}

impl Want {
    /// How many bits each has.
    pub fn bits(&self) -> impl Iterator<Item = usize> + '_ {
        let in_place = self.collection.as_ref().map(Collection::bits);
        self.bits.iter().map(move |bits| in_place.unwrap_or(*bits))
    }
}

/// How many words fields of so many bits need, one after the other, each within a word.
fn words(bits: impl Iterator<Item = usize>) -> usize {
    let (mut words, mut left) = (1, 63);
    for bits in bits {
        if bits > left {
            (words, left) = (words + 1, 64);
        }
        left -= bits;
    }
    words
}

/// How many words they need as they are.
fn needed(wants: &[Want]) -> usize {
    words(wants.iter().flat_map(Want::bits))
}

/// Leaves the collections that stand in place, and makes room in them.
pub(crate) fn fit(wants: &mut [Want]) {
    let most = words(wants.iter().flat_map(|want| want.bits.iter().copied())).min(WORDS);
    if needed(wants) > most {
        for want in wants.iter_mut() {
            // A set of few elements needs no more than a number does.
            want.collection.take_if(|collection| collection.is_sequence() || collection.bits() > NUMBER);
        }
        return;
    }
    let least = needed(wants);
    // First all of them become longer alike, then each as far as it goes.
    let all: Vec<usize> = (0..wants.len()).collect();
    for some in std::iter::once(&all[..]).chain(all.chunks(1)) {
        loop {
            let shorter: Vec<Option<Collection>> = some.iter().map(|index| wants[*index].collection.clone()).collect();
            let mut any = false;
            for index in some {
                let want = &mut wants[*index];
                if let Some(longer) = want.collection.as_ref().and_then(Collection::longer) {
                    (want.collection, any) = (Some(longer), true);
                }
            }
            if !any || needed(wants) > least {
                some.iter().zip(shorter).for_each(|(index, shorter)| wants[*index].collection = shorter);
                break;
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use machine::Value;

    fn sequences(elements: i64, longest: usize) -> Option<Collection> {
        Collection::sequences((0..elements).map(Value::Integer).collect(), longest)
    }

    /// How many bits each has in the end.
    fn check(mut wants: Vec<Want>, expected: &[usize]) {
        fit(&mut wants);
        assert_eq!(wants.iter().map(|want| want.bits().next().expect("a field")).collect::<Vec<_>>(), expected);
    }

    fn want(count: usize, bits: usize, collection: Option<Collection>) -> Want {
        Want { bits: vec![bits; count], collection }
    }

    #[test]
    fn sequences_get_the_bits_that_are_left() {
        // Six messages of four bits and a length of three; seven acknowledgements of three bits and a length.
        check(vec![want(1, 12, None), want(1, 32, sequences(10, 0)), want(1, 32, sequences(5, 0))], &[12, 27, 24]);
        // One that needs more than a word has gets it in the second, and so do the others.
        check(vec![want(1, 40, None), want(1, 32, sequences(16, 7))], &[40, 60]);
    }

    #[test]
    fn many_queues_are_numbers() {
        check(vec![want(11, 2, None), want(11, 32, sequences(11, 2))], &[2, 32]);
        let sets = |count| Collection::sets((0..count).map(Value::Integer).collect());
        check(vec![want(9, 32, sets(20)), want(9, 32, sets(40))], &[20, 32]);
    }

    #[test]
    fn elements_without_bits_are_no_end() {
        check(vec![want(1, 32, sequences(1, 0))], &[6]);
    }
}
