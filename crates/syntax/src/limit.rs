//! How large, deep and faulty a text may be.

/// How deeply constructs may be nested (parentheses, rules in rules, right operands …).
pub const MAX_NESTING: usize = 256;

/// How deeply composite states may be nested.
pub const MAX_COMPOSITES: usize = 16;

/// The greatest height of the tree of one rule or term. A chain of left-associative operators (`a + b + …`) makes the
/// tree higher by one for each operator, so a chain has at most this many.
pub const MAX_CHAIN: usize = 1000;

/// How many faults of one file are reported.
pub const MAX_FAULTS: usize = 200;

/// The longest text that is read.
pub const MAX_TEXT_BYTES: usize = 1 << 30;
