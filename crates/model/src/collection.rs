//! The kinds of collections, of which both domains and terms speak.

/// Set, sequence, bag or map.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum CollectionKind {
    /// `{a}`
    Set,
    /// `[a]`
    Seq,
    /// `<a>`
    Bag,
    /// `{a -> b}`: each element is a term that gives a pair.
    Map,
}
