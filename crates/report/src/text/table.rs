//! A table of plain text: columns as wide as their widest cell, the first one to the left, numbers to the right.

/// Rows of cells.
pub(super) struct Table {
    rows: Vec<Vec<String>>,
}

impl Table {
    /// A table with these headings; all empty: without.
    pub fn new(head: &[&str]) -> Table {
        Table { rows: vec![head.iter().map(|cell| (*cell).to_owned()).collect()] }
    }

    pub fn row(&mut self, cells: Vec<String>) {
        self.rows.push(cells);
    }

    /// The lines; `prose`: every column to the left.
    pub fn render(&self, indent: &str, prose: bool) -> String {
        let columns = self.rows[0].len();
        let width = |column: usize| self.rows.iter().map(|row| row[column].chars().count()).max().unwrap_or(0);
        let widths: Vec<usize> = (0..columns).map(width).collect();
        let mut out = String::new();
        for row in self.rows.iter().filter(|row| row.iter().any(|cell| !cell.is_empty())) {
            let mut line = indent.to_owned();
            for (column, (cell, width)) in row.iter().zip(&widths).enumerate() {
                let pad = " ".repeat(width - cell.chars().count());
                let gap = if column == 0 { "" } else { "  " };
                let left = prose || column == 0;
                line = if left { format!("{line}{gap}{cell}{pad}") } else { format!("{line}{gap}{pad}{cell}") };
            }
            out.push_str(line.trim_end());
            out.push('\n');
        }
        out
    }
}
