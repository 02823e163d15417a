//! The slots of an open-addressed hash table that becomes larger than the processor's caches.
//!
//! In: entries, which are not 0. Out: where they are. Slots are mapped anonymously in pages of 2 MiB, which Linux backs by huge
//! pages if it can: each access to such a table misses the caches, and with pages of 4 KiB also those of addresses. A table grows by half. Its
//! pages are read in order meanwhile and given back one by one, so the old slots and the new ones never take memory together.

use memmap2::MmapMut;

/// The logarithm of the slots in a page.
const PAGE: u32 = 18;
/// The slots of the first table.
const FIRST: usize = 1 << 10;
/// The largest load of a table.
const FULL: (usize, usize) = (7, 8);

/// Slots of 64 bits; 0 marks an empty one.
#[derive(Debug, Default)]
pub(crate) struct Slots {
    pages: Vec<MmapMut>,
    len: usize,
}

impl Slots {
    /// So many empty slots; nothing if there is no memory.
    fn empty(len: usize) -> Option<Slots> {
        let mut pages = Vec::new();
        pages.try_reserve(len.div_ceil(1 << PAGE)).ok()?;
        for start in (0..len).step_by(1 << PAGE) {
            let page = MmapMut::map_anon(8 * (len - start).min(1 << PAGE)).ok()?;
            #[cfg(target_os = "linux")]
            if len > 1 << PAGE {
                // A kernel without huge pages refuses, and pages stay small.
                let _ = page.advise(memmap2::Advice::HugePage);
            }
            pages.push(page);
        }
        Some(Slots { pages, len })
    }

    /// How many slots there are.
    #[inline]
    pub fn len(&self) -> usize {
        self.len
    }

    /// The number of bytes they take.
    pub fn bytes(&self) -> usize {
        8 * self.len
    }

    /// How many slots there are after they have grown, from so many, until they hold this many entries.
    pub fn grown_for(mut len: usize, entries: usize) -> usize {
        while entries * FULL.1 > len * FULL.0 {
            len = if len == 0 { FIRST } else { len + len / 2 };
        }
        len
    }

    /// Whether so many entries are too many.
    #[inline]
    pub fn is_full_with(&self, entries: usize) -> bool {
        entries * FULL.1 > self.len * FULL.0
    }

    /// The content of a slot.
    #[inline(always)]
    pub fn get(&self, slot: usize) -> u64 {
        let (slots, _) = self.pages[slot >> PAGE].as_chunks::<8>();
        u64::from_ne_bytes(slots[slot & ((1 << PAGE) - 1)])
    }

    /// Puts an entry into a slot.
    #[inline(always)]
    pub fn set(&mut self, slot: usize, entry: u64) {
        let (slots, _) = self.pages[slot >> PAGE].as_chunks_mut::<8>();
        slots[slot & ((1 << PAGE) - 1)] = entry.to_ne_bytes();
    }

    /// The slot after one.
    #[inline(always)]
    pub fn after(&self, slot: usize) -> usize {
        if slot + 1 == self.len { 0 } else { slot + 1 }
    }

    /// Puts an entry that is not there into the first empty slot from its own on.
    #[inline]
    pub fn put(&mut self, mut slot: usize, entry: u64) {
        while self.get(slot) != 0 {
            slot = self.after(slot);
        }
        self.set(slot, entry);
    }

    /// Takes this many slots, of which `home` gives that of an entry among so many, in the order of the present ones: then old and
    /// new slots are passed through in order. `false` if there is no memory; nothing has changed then.
    #[cold]
    pub fn grow(&mut self, len: usize, home: impl Fn(u64, usize) -> usize) -> bool {
        let Some(mut wider) = Slots::empty(len) else { return false };
        for page in std::mem::take(&mut self.pages) {
            for entry in
                page.as_chunks::<8>().0.iter().map(|entry| u64::from_ne_bytes(*entry)).filter(|entry| *entry != 0)
            {
                wider.put(home(entry, len), entry);
            }
        }
        *self = wider;
        true
    }

    /// Takes this many slots, all of them empty. `false` if there is no memory; nothing has changed then.
    #[cold]
    pub fn clear(&mut self, len: usize) -> bool {
        Slots::empty(len).map(|wider| *self = wider).is_some()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Entries in several pages, each at its place or behind it, through growing and round the end.
    #[test]
    fn entries_stay_through_growing() {
        let home = |entry: u64, len: usize| {
            ((u128::from(entry.wrapping_mul(0x9e37_79b9_7f4a_7c15)) * len as u128) >> 64) as usize
        };
        let mut slots = Slots::default();
        let count = 1_000_000;
        for entry in 1..=count {
            let entries = entry as usize;
            if slots.is_full_with(entries) {
                assert!(slots.grow(Slots::grown_for(slots.len(), entries), home));
            }
            slots.put(home(entry, slots.len()), entry);
        }
        assert!(slots.pages.len() > 3 && slots.len() % (1 << PAGE) != 0, "the last page is shorter");
        for entry in 1..=count {
            let mut slot = home(entry, slots.len());
            while slots.get(slot) != entry {
                assert_ne!(slots.get(slot), 0, "{entry} is lost");
                slot = slots.after(slot);
            }
        }
        assert_eq!((0..slots.len()).filter(|slot| slots.get(*slot) != 0).count(), count as usize);
    }

    #[test]
    fn without_memory_nothing_changes() {
        let mut slots = Slots::default();
        assert!(slots.grow(1 << 10, |_, _| 0));
        slots.put(1023, 7);
        slots.put(1023, 8);
        assert!(!slots.grow(1 << 58, |_, _| 0) && !slots.clear(1 << 58));
        assert_eq!((slots.len(), slots.get(1023), slots.get(0)), (1 << 10, 7, 8));
    }
}
