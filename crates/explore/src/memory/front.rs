//! Which of several trees are known to come to one end by the first field that each looks at.
//!
//! In: the trees of a condition's parts, and the end that says that a part is true. Out: whether all parts are true in a state, if that is
//! known. Of `forall $a, $b with not (p($a) and q($b))` most parts are decided by `p($a)` alone; they are passed over together, field by
//! field. INVARIANT: what it passes over is what the trees know; it is made anew after they have learned.

use machine::Interrupt;

use crate::memory::tree::{Below, End, Place, Stop, Tree};
use crate::packed::words::Bits;

/// States that nothing is learned in before it is made, the first time; each time more.
const QUIET: u32 = 1 << 8;

/// See the module.
#[derive(Debug, Default)]
pub(crate) struct Front {
    groups: Option<Vec<Group>>,
    /// States since the trees have learned.
    quiet: u32,
    /// How often they have learned after it was made.
    unmade: u32,
}

/// The trees that look at one field first.
#[derive(Debug)]
struct Group {
    field: Bits,
    /// By code, the trees that it does not decide.
    open: Vec<Vec<u32>>,
}

impl Front {
    /// Some tree has learned.
    pub fn learned(&mut self) {
        self.unmade += u32::from(self.groups.take().is_some());
        self.quiet = 0;
    }

    /// Whether so many trees are known to come to this end alone.
    pub fn all_end<'t>(
        &mut self,
        count: usize,
        tree: impl Fn(usize) -> &'t Tree,
        end: End,
        state: &[u64],
        interrupt: &Interrupt,
    ) -> bool {
        let Some(groups) = &self.groups else {
            self.quiet += 1;
            if self.quiet >= QUIET << self.unmade.min(12) {
                self.groups = Some(groups(count, &tree, end));
            }
            return false;
        };
        groups.iter().all(|Group { field: Bits { word, shift, bits }, open }| {
            let code = state[*word as usize] >> shift & ((1 << bits) - 1);
            open[code as usize].iter().all(|index| {
                let mut alone = true;
                tree(*index as usize).knows(state, interrupt, &mut |found| alone &= found == end) && alone
            })
        })
    }
}

#[cold]
fn groups<'t>(count: usize, tree: &impl Fn(usize) -> &'t Tree, end: End) -> Vec<Group> {
    let ends = |stop: Stop| matches!(stop, Stop::End(found) if found == end);
    // Trees that begin in another way are open whatever the state.
    let mut groups = vec![Group { field: Bits { word: 0, shift: 0, bits: 0 }, open: vec![Vec::new()] }];
    for index in 0..count {
        let tree = tree(index);
        match tree.stop(Place::Root) {
            Some(stop) if ends(stop) => {}
            Some(stop @ Stop::Field { bits: field, below: Below::Links(_) }) => {
                let known = groups.iter().skip(1).position(|group| group.field == field);
                let place = known.map_or(groups.len(), |place| place + 1);
                if place == groups.len() {
                    groups.push(Group { field, open: vec![Vec::new(); 1 << field.bits] });
                }
                for (code, open) in (0..).zip(&mut groups[place].open) {
                    if !tree.stop(Tree::child(stop, code)).is_some_and(ends) {
                        open.push(index as u32);
                    }
                }
            }
            _ => groups[0].open[0].push(index as u32),
        }
    }
    groups
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::alternatives::branches::Event;
    use crate::packed::words::Field;
    use program::FunctionId;

    /// Trees that look at a field of two bits, and at the next one where it is 3; they come to 1 unless both are 3.
    #[test]
    fn what_the_first_field_decides_is_passed_over() {
        let field =
            |at: u8| Field { location: 0, function: FunctionId(0), word: 0, shift: 2 * at, bits: 2, few: false };
        let fields: Vec<Field> = (0..10).map(field).collect();
        let mut trees: Vec<Tree> = (0..9).map(|_| Tree::default()).collect();
        let (interrupt, mut front) = (Interrupt::default(), Front::default());
        let words = |code: u64, next: u64, at: usize| [code << (2 * at) | next << (2 * at + 2)];
        for (at, tree) in trees.iter_mut().enumerate() {
            for code in 0..3 {
                tree.learn(&fields, &words(code, 0, at), &[Event::Look(at as u32)], &[], 1);
            }
            for next in 0..4 {
                let looks = [Event::Look(at as u32), Event::Look(at as u32 + 1)];
                tree.learn(&fields, &words(3, next, at), &looks, &[], if next == 3 { 2 } else { 1 });
            }
        }
        let passed = |front: &mut Front, state: u64| front.all_end(9, |at| &trees[at], 1, &[state], &interrupt);
        (0..QUIET).for_each(|_| assert!(!passed(&mut front, 0), "it is not made yet"));
        let open: usize = front.groups.iter().flatten().flat_map(|group| &group.open).map(Vec::len).sum();
        assert_eq!(open, 9, "each tree is open for one code");
        for state in (0..1 << 20).step_by(77) {
            let all =
                trees.iter().all(|tree| tree.knows(&[state], &interrupt, &mut |end| assert!(end == 1 || end == 2)));
            let expected = (0..9).all(|at| state >> (2 * at) & 15 != 15);
            assert!(all && passed(&mut front, state) == expected, "{state:#x}");
        }
        front.learned();
        assert!(!passed(&mut front, 0) && front.groups.is_none(), "it is made anew");
    }
}
