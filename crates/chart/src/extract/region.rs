//! Composite states that were found, by what they hold.

/// A composite state.
#[derive(Debug, Clone)]
pub(super) struct Region {
    /// The region that it stands in: one before it.
    pub(super) around: Option<usize>,
    /// The control states in it, also those of regions in it.
    pub(super) states: Vec<String>,
    /// Where its path begins. Where that leads nowhere, the states do what they do otherwise.
    pub(super) path: usize,
    /// The location that remembers in which state it was left.
    pub(super) history: Option<String>,
    /// What is done whenever it is entered.
    pub(super) entry: Vec<String>,
    /// What is done whenever it is left.
    pub(super) exit: Vec<String>,
    /// The state in which it begins, if anything begins there.
    pub(super) initial: Option<String>,
}

/// Whether a region is another one, or stands in it.
pub(super) fn is_within(regions: &[Region], inner: usize, outer: usize) -> bool {
    std::iter::successors(Some(inner), |region| regions[*region].around).any(|region| region == outer)
}
