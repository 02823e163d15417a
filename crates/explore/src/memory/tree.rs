//! What a step comes to, remembered by what it looked at: a tree of decisions.
//!
//! A step is a function of the fields that it looks at and of the answers it gets. Each inner node is a field, with a
//! child for each code, or a question, with a child for each answer; each end is what the step came to. In: the events of
//! a step that a machine has made ([`Tree::learn`]). Out: for any packed state, the ends of all its alternatives
//! ([`Tree::walk`]), unless one is not known yet. INVARIANT: a walk that finds all it looks for gives exactly what the
//! machine would: nothing but events decides how a step goes on.

use hashbrown::HashMap;
use machine::Interrupt;
use rustc_hash::FxBuildHasher;

use crate::alternatives::branches::{Asked, Event};
use crate::memory::maker::Unmade;
use crate::memory::record::Record;
use crate::packed::words::{Bits, Field};

/// The number of an end, given by who keeps what ends mean.
pub(crate) type End = u32;

/// The end of an alternative that is none.
pub(crate) const DEAD: End = 0;

/// A node, or an end where the highest bit is set; 0 is not known yet.
type Link = u32;
const END: Link = 1 << 31;

/// LIMIT: fields of more bits have only some of their children by code.
const WIDE: u8 = 8;
/// Children of such a field stand by code as long as at least one in so many of them is known, and in a table by hash beyond.
const SPARSE: u64 = 4;
/// LIMIT: a tree with more links is given up.
const LINKS: usize = 1 << 25;

#[derive(Debug, Clone, Copy)]
enum Node {
    /// Children by code, from `base` on.
    Field { word: u32, shift: u8, bits: u8, base: u32 },
    /// Children by code, the first `len` of them from `base` on, the others in a table.
    Wide { word: u32, shift: u8, bits: u8, base: u32, len: u32 },
    /// Every child is walked; dead where all of them are.
    Ask { base: u32, of: u32 },
    /// Every child is walked; where all are dead, the one after them.
    Guarded { base: u32, of: u32 },
}

/// See the module.
#[derive(Debug, Default)]
pub(crate) struct Tree {
    nodes: Vec<Node>,
    links: Vec<Link>,
    /// By the index of a node and a code, the children that do not stand by code.
    wide: HashMap<(u32, u64), Link, FxBuildHasher>,
    /// By the index of a node with children in that table, how many children it has in all.
    known: HashMap<u32, u32, FxBuildHasher>,
    root: Link,
    record: Record,
    given_up: bool,
}

/// Where a link stands.
#[derive(Debug, Clone, Copy)]
pub(crate) enum Place {
    Root,
    Link(usize),
    Wide(u32, u64),
}

/// What a link leads to, for who walks it with many states at a time.
#[derive(Debug, Clone, Copy)]
pub(crate) enum Stop {
    /// The alternative is none.
    Dead,
    /// What the step came to.
    End(End),
    /// A field is looked at; `below` is where its children are.
    Field { bits: Bits, below: Below },
    /// Every child is walked; where they are guarded and all are dead, the one after them.
    Ask { base: u32, of: u32, guarded: bool },
}

/// Where the children of a field are.
#[derive(Debug, Clone, Copy)]
pub(crate) enum Below {
    Links(u32),
    Table(u32),
}

impl Tree {
    /// Whether it pays to walk it.
    #[inline]
    pub fn is_used(&self) -> bool {
        !self.given_up
    }

    /// How often it has known the steps of a state.
    pub fn record(&mut self) -> &mut Record {
        &mut self.record
    }

    /// Forgets all of it, and learns no more.
    pub fn give_up(&mut self) {
        *self = Tree { given_up: true, ..Tree::default() };
    }

    /// How many nodes and links it has.
    pub fn size(&self) -> usize {
        self.nodes.len() + self.links.len() + self.wide.len()
    }

    /// Visits the ends of all alternatives of a state, in their order, dead ones left out.
    #[inline]
    pub fn walk(&mut self, words: &[u64], interrupt: &Interrupt, visit: &mut impl FnMut(End)) -> Result<(), Unmade> {
        self.record.walk();
        match self.walk_from(self.root, words, interrupt, visit) {
            Ok(_) => Ok(()),
            Err(Unmade::Unknown) => {
                self.fail();
                Err(Unmade::Unknown)
            }
            Err(interrupted) => Err(interrupted),
        }
    }

    /// The same without counting it; whether all ends are known.
    #[inline]
    pub fn knows(&self, words: &[u64], interrupt: &Interrupt, visit: &mut impl FnMut(End)) -> bool {
        self.walk_from(self.root, words, interrupt, visit).is_ok()
    }

    #[cold]
    fn fail(&mut self) {
        self.record.miss();
        if self.record.loses_to_machine() || self.is_crowded() {
            self.give_up();
        }
    }

    /// What a link comes to in a state, past all fields: an end, a question, or not known.
    #[inline(always)]
    fn past_fields(&self, mut link: Link, words: &[u64]) -> Link {
        loop {
            if link & END != 0 || link == 0 {
                return link;
            }
            match self.nodes[link as usize - 1] {
                Node::Field { word, shift, bits, base } => {
                    let code = words[word as usize] >> shift & ((1 << bits) - 1);
                    link = self.links[base as usize + code as usize];
                }
                Node::Wide { word, shift, bits, base, len } => {
                    let code = words[word as usize] >> shift & ((1 << bits) - 1);
                    link = match code < u64::from(len) {
                        true => self.links[base as usize + code as usize],
                        false => self.wide.get(&(link - 1, code)).copied().unwrap_or(0),
                    };
                }
                Node::Ask { .. } | Node::Guarded { .. } => return link,
            }
        }
    }

    /// Whether some alternative is none of the dead.
    fn walk_from(
        &self,
        link: Link,
        words: &[u64],
        interrupt: &Interrupt,
        visit: &mut impl FnMut(End),
    ) -> Result<bool, Unmade> {
        let mut link = self.past_fields(link, words);
        loop {
            if link & END != 0 {
                let end = link & !END;
                if end != DEAD {
                    visit(end);
                }
                return Ok(end != DEAD);
            }
            if link == 0 {
                return Err(Unmade::Unknown);
            }
            // Questions multiply, so that one state may have many alternatives.
            if interrupt.is_raised() {
                return Err(Unmade::Interrupted);
            }
            let (base, of, guarded) = match self.nodes[link as usize - 1] {
                Node::Ask { base, of } => (base as usize, of as usize, false),
                Node::Guarded { base, of } => (base as usize, of as usize, true),
                Node::Field { .. } | Node::Wide { .. } => unreachable!("the link is past all fields"),
            };
            let mut alive = false;
            for child in &self.links[base..base + of] {
                // Most are ends, for which a call would take as long as the way to them.
                let child = self.past_fields(*child, words);
                if child & END == 0 {
                    alive |= self.walk_from(child, words, interrupt, visit)?;
                } else if child != END | DEAD {
                    visit(child & !END);
                    alive = true;
                }
            }
            if alive || !guarded {
                return Ok(alive);
            }
            link = self.past_fields(self.links[base + of], words);
        }
    }

    /// Remembers that the step of a state, with these events and answers, came to an end.
    pub fn learn(&mut self, fields: &[Field], words: &[u64], events: &[Event], answers: &[Asked], end: End) {
        if self.given_up {
            return;
        }
        self.record.learn(events.len());
        let mut answers = answers.iter();
        let mut place = Place::Root;
        for event in events {
            if let Event::Look(field) = event
                && fields[*field as usize].bits == 0
            {
                continue;
            }
            let node = match self.link(&place) {
                0 => {
                    let node = self.add(fields, *event, answers.clone().next());
                    self.set(&place, node);
                    node
                }
                node => node,
            };
            assert!(node & END == 0, "a step goes on where the same step has ended");
            place = match (self.nodes[node as usize - 1], event) {
                (Node::Field { base, word, shift, bits }, Event::Look(field)) => {
                    let field = fields[*field as usize];
                    assert!(
                        (field.word, field.shift, field.bits) == (word, shift, bits),
                        "a step looks where the same step did not"
                    );
                    Place::Link(base as usize + field.code(words) as usize)
                }
                (Node::Wide { word, shift, bits, .. }, Event::Look(field)) => {
                    let field = fields[*field as usize];
                    assert!(
                        (field.word, field.shift, field.bits) == (word, shift, bits),
                        "a step looks where the same step did not"
                    );
                    Place::Wide(node - 1, field.code(words))
                }
                (Node::Ask { base, of } | Node::Guarded { base, of }, Event::Ask) => {
                    let asked = answers.next().expect("an answer to each question");
                    assert_eq!(asked.of, of, "a step asks for what the same step did not");
                    Place::Link(base as usize + asked.taken as usize)
                }
                _ => panic!("a step asks where the same step looked"),
            };
        }
        self.set(&place, END | end);
    }

    fn add(&mut self, fields: &[Field], event: Event, asked: Option<&Asked>) -> Link {
        let base = self.links.len() as u32;
        let node = match event {
            Event::Look(field) => {
                let Field { word, shift, bits, .. } = fields[field as usize];
                if bits > WIDE {
                    Node::Wide { word, shift, bits, base, len: 0 }
                } else {
                    self.links.resize(base as usize + (1 << bits), 0);
                    Node::Field { word, shift, bits, base }
                }
            }
            Event::Ask => {
                let asked = asked.expect("an answer to each question");
                let of = asked.of;
                self.links.resize((base + of) as usize + usize::from(asked.guarded), 0);
                if asked.guarded { Node::Guarded { base, of } } else { Node::Ask { base, of } }
            }
        };
        self.nodes.push(node);
        self.nodes.len() as Link
    }

    /// Whether no more can be remembered.
    pub fn is_crowded(&self) -> bool {
        self.given_up || self.links.len() + self.wide.len() > LINKS
    }

    /// What a link leads to, if that is known.
    pub fn stop(&self, place: Place) -> Option<Stop> {
        let link = self.link(&place);
        if link & END != 0 {
            let end = link & !END;
            return Some(if end == DEAD { Stop::Dead } else { Stop::End(end) });
        }
        let node = self.nodes.get((link as usize).checked_sub(1)?)?;
        Some(match *node {
            Node::Field { word, shift, bits, base } => {
                Stop::Field { bits: Bits { word, shift, bits }, below: Below::Links(base) }
            }
            Node::Wide { word, shift, bits, .. } => {
                Stop::Field { bits: Bits { word, shift, bits }, below: Below::Table(link - 1) }
            }
            Node::Ask { base, of } => Stop::Ask { base, of, guarded: false },
            Node::Guarded { base, of } => Stop::Ask { base, of, guarded: true },
        })
    }

    /// A child of what is no end: for a code, or for an answer.
    pub fn child(stop: Stop, child: u64) -> Place {
        match stop {
            Stop::Field { below: Below::Links(base), .. } | Stop::Ask { base, .. } => {
                Place::Link(base as usize + child as usize)
            }
            Stop::Field { below: Below::Table(index), .. } => Place::Wide(index, child),
            Stop::Dead | Stop::End(_) => unreachable!("an end has no children"),
        }
    }

    /// Calls `visit` with each end and the fields looked at on the way to it.
    pub fn each_end(&self, visit: &mut dyn FnMut(&[Bits], End)) {
        let mut open = vec![(Place::Root, Vec::new())];
        while let Some((place, looked)) = open.pop() {
            match self.stop(place) {
                None | Some(Stop::Dead) => {}
                Some(Stop::End(end)) => visit(&looked, end),
                Some(stop @ Stop::Field { bits, below }) => {
                    let longer: Vec<Bits> = looked.iter().copied().chain([bits]).collect();
                    let codes: Vec<u64> = match below {
                        Below::Links(_) => (0..1 << bits.bits).collect(),
                        Below::Table(index) => self.codes(index),
                    };
                    open.extend(codes.into_iter().map(|code| (Tree::child(stop, code), longer.clone())));
                }
                Some(stop @ Stop::Ask { of, guarded, .. }) => {
                    let children = of + u32::from(guarded);
                    open.extend((0..children).map(|child| (Tree::child(stop, u64::from(child)), looked.clone())));
                }
            }
        }
    }

    /// The codes of the known children of a node with a wide field, in their order.
    fn codes(&self, index: u32) -> Vec<u64> {
        let Node::Wide { base, len, .. } = self.nodes[index as usize] else { return Vec::new() };
        let places = (0..len).filter(|code| self.links[(base + code) as usize] != 0);
        let mut codes: Vec<u64> = places.map(u64::from).collect();
        codes.extend(self.wide.keys().filter(|(node, _)| *node == index).map(|(_, code)| *code));
        codes.sort_unstable();
        codes
    }

    fn link(&self, place: &Place) -> Link {
        match place {
            Place::Root => self.root,
            Place::Link(index) => self.links[*index],
            Place::Wide(node, code) => match self.nodes[*node as usize] {
                Node::Wide { base, len, .. } if *code < u64::from(len) => self.links[base as usize + *code as usize],
                _ => self.wide.get(&(*node, *code)).copied().unwrap_or(0),
            },
        }
    }

    fn set(&mut self, place: &Place, link: Link) {
        match *place {
            Place::Root => self.root = link,
            Place::Link(index) => self.links[index] = link,
            Place::Wide(node, code) => self.set_wide(node, code, link),
        }
    }

    fn set_wide(&mut self, index: u32, code: u64, link: Link) {
        let Node::Wide { base, len, .. } = &mut self.nodes[index as usize] else { return };
        let known = self.known.entry(index).or_default();
        if code < u64::from(*len) {
            let place = &mut self.links[*base as usize + code as usize];
            *known += u32::from(*place == 0);
            *place = link;
            return;
        }
        if self.wide.insert((index, code), link).is_some() {
            return;
        }
        *known += 1;
        // The number of a state's value may be any: only where most of the codes below are known do they get places.
        if code / SPARSE < u64::from(*known) && code < 1 << 30 {
            let (from, before) = (*base as usize, *len);
            (*base, *len) = (self.links.len() as u32, (code as u32 + 1).next_power_of_two());
            self.links.extend_from_within(from..from + before as usize);
            let Tree { links, wide, .. } = self;
            links.extend((before..*len).map(|code| wide.remove(&(index, u64::from(code))).unwrap_or(0)));
        }
    }
}

#[cfg(test)]
mod tests;
