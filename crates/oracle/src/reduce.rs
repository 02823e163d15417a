//! Makes a text smaller, as long as it still shows what it should show.
//!
//! In: a [`Piece`] and a test that says whether a text still shows it. Out: one in which no single piece can be
//! replaced by a smaller one of its sort any more. A text that is no longer a model does not show it, so the reducer
//! need not know the language (A. Zeller, R. Hildebrandt, IEEE TSE 28(2), 2002, on trees).

use crate::generate::Piece;

/// The smallest that was found within this many trials.
pub fn reduce(mut piece: Piece, mut trials: usize, mut shows: impl FnMut(&str) -> bool) -> Piece {
    loop {
        let before = piece.to_string().len();
        let mut index = 0;
        // From the top, so large pieces go first; the tree shrinks during the walk.
        while let Some(path) = piece.paths().get(index).cloned() {
            for smaller in piece.at(&path).smaller() {
                if trials == 0 {
                    return piece;
                }
                trials -= 1;
                let candidate = piece.with(&path, smaller);
                if shows(&candidate.to_string()) {
                    piece = candidate;
                    break;
                }
            }
            index += 1;
        }
        if piece.to_string().len() == before {
            return piece;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::generate::Sort;

    #[test]
    fn keeps_what_is_needed_and_nothing_else() {
        let skip = || Piece::text(Sort::Rule, "skip");
        let needed = Piece::text(Sort::Rule, "f := 1");
        let inner = Piece::new(Sort::Rule, "par § § endpar", vec![skip(), needed]);
        let whole =
            Piece::new(Sort::Fixed, "main §", vec![Piece::new(Sort::Rule, "seq § § endseq", vec![inner, skip()])]);
        assert_eq!(reduce(whole, 100, |text| text.contains("f := 1")).to_string(), "main f := 1");
    }
}
