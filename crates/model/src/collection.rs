//! The kinds of collections, for domains and terms.

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
