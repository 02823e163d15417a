//! Pages in Markdown and their fenced blocks, which tests use as examples.
//!
//! In: the path of a page from the root of the repository. Out: its blocks, each with its info string, its text with the
//! last line end, and the line of its opening fence. Fences are at the beginning of a line; what the words of an info
//! string mean is known to each test alone.

use crate::repository;

/// A page.
#[derive(Debug, Clone)]
pub struct Page {
    /// Its path from the root of the repository.
    pub path: String,
    /// All of it.
    pub text: String,
}

/// A fenced block of a page.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Block<'p> {
    /// The text after the opening fence.
    pub info: &'p str,
    /// The text between the fences.
    pub text: &'p str,
    /// The line of the opening fence, from 1.
    pub line: usize,
}

impl Page {
    /// The page at a path from the root of the repository.
    ///
    /// # Panics
    /// There is no such page.
    pub fn read(path: &str) -> Self {
        Page { path: path.to_string(), text: repository::text(path) }
    }

    /// The page of that name in `spec/`.
    ///
    /// # Panics
    /// There is no such page.
    pub fn spec(name: &str) -> Self {
        Page::read(&format!("spec/{name}.md"))
    }

    /// The page of a fault.
    ///
    /// # Panics
    /// There is no such page, or it has another title.
    pub fn fault(id: &str) -> Self {
        let page = Page::spec(&format!("faults/{id}"));
        assert!(page.text.starts_with(&format!("# {id}\n")), "the page of {id} has another title");
        page
    }

    /// All blocks, in order.
    pub fn blocks(&self) -> Vec<Block<'_>> {
        blocks(&self.text)
    }

    /// The texts of the blocks with exactly this info string.
    pub fn texts(&self, info: &str) -> Vec<&str> {
        self.blocks().into_iter().filter(|block| block.info == info).map(|block| block.text).collect()
    }

    /// The text of the first block with exactly this info string.
    ///
    /// # Panics
    /// There is no such block.
    pub fn example(&self, info: &str) -> &str {
        self.texts(info).first().copied().unwrap_or_else(|| panic!("{} has no block {info}", self.path))
    }
}

/// The fenced blocks of a text.
///
/// # Panics
/// The last block has no end.
pub fn blocks(text: &str) -> Vec<Block<'_>> {
    let mut blocks = Vec::new();
    let mut open: Option<(Block<'_>, usize)> = None;
    let mut at = 0;
    for (index, line) in text.split_inclusive('\n').enumerate() {
        let start = at;
        at += line.len();
        match (line.strip_prefix("```"), open) {
            (Some(info), None) => open = Some((Block { info: info.trim_end(), text: "", line: index + 1 }, at)),
            (Some(_), Some((block, from))) => {
                blocks.push(Block { text: &text[from..start], ..block });
                open = None;
            }
            (None, _) => {}
        }
    }
    if let Some((block, _)) = open {
        panic!("the block in line {} has no end", block.line);
    }
    blocks
}
