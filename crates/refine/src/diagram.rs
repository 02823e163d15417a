//! Diagrams: so many steps of the abstract machine correspond to so many of the concrete one (Schellhorn 2001).
//!
//! In: `m:n`, each a number or a range. Out: whether a diagram is allowed. A diagram has at least one concrete step: an abstract
//! machine that has to move first does so within the diagram of the next concrete step.

use std::ops::RangeInclusive;

/// LIMIT: the most steps of either machine in one diagram.
pub const MOST: u32 = 64;

/// Diagrams that are allowed.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Diagram {
    /// How many steps of the abstract machine.
    pub m: RangeInclusive<u32>,
    /// How many of the concrete one.
    pub n: RangeInclusive<u32>,
}

impl Diagram {
    /// `m:n`, such as `0..1:1`.
    ///
    /// # Errors
    /// It is none; a sentence for the user.
    pub fn read(text: &str) -> Result<Diagram, String> {
        let written =
            || "a diagram is written `m:n`: numbers of abstract and of concrete steps, such as 1:1 or 0..1:1..4";
        let range = |text: &str| -> Result<RangeInclusive<u32>, String> {
            let (low, high) = text.split_once("..").unwrap_or((text, text));
            let number = |text: &str| text.trim().parse::<u32>().map_err(|_| written().to_string());
            let (low, high) = (number(low)?, number(high)?);
            if low > high {
                return Err(format!("`{}` is no range: the lower number comes first", text.trim()));
            }
            if high > MOST {
                return Err(format!("a diagram has at most {MOST} steps of each machine"));
            }
            Ok(low..=high)
        };
        let (m, n) = text.split_once(':').ok_or_else(written)?;
        let (m, n) = (range(m)?, range(n)?);
        if *n.start() == 0 {
            return Err("a diagram has at least one step of the concrete machine: `m:n` with n from 1".to_string());
        }
        Ok(Diagram { m, n })
    }
}

/// All diagrams that are allowed.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Diagrams(pub Vec<Diagram>);

impl Diagrams {
    /// What is allowed if nothing is said: each concrete step corresponds to one abstract step or to none. Where segments have ends of
    /// their own, they may be longer.
    pub fn usual(segments: bool) -> Diagrams {
        let longest = if segments { 16 } else { 1 };
        Diagrams(vec![Diagram { m: 0..=1, n: 1..=longest }])
    }

    /// Whether `m` abstract steps may correspond to `n` concrete ones.
    pub fn allows(&self, m: u32, n: u32) -> bool {
        self.0.iter().any(|diagram| diagram.m.contains(&m) && diagram.n.contains(&n))
    }

    /// The most abstract steps beside `n` concrete ones; none if no diagram has `n`.
    pub fn most_abstract(&self, n: u32) -> Option<u32> {
        self.0.iter().filter(|diagram| diagram.n.contains(&n)).map(|diagram| *diagram.m.end()).max()
    }

    /// The most concrete steps.
    pub fn most_concrete(&self) -> u32 {
        self.0.iter().map(|diagram| *diagram.n.end()).max().unwrap_or(1)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_allowed() {
        let check = |text: &str, m, n, expect| {
            assert_eq!(Diagram::read(text).map(|diagram| Diagrams(vec![diagram]).allows(m, n)), Ok(expect), "{text}");
        };
        check("1:1", 1, 1, true);
        check("1:1", 0, 1, false);
        check(" 0..1 : 1..4 ", 0, 4, true);
        assert!(Diagrams::usual(false).allows(0, 1) && !Diagrams::usual(false).allows(1, 2));
        assert_eq!(Diagrams::usual(true).most_concrete(), 16);
        for text in ["", "1", "a:1", "1:0", "2..1:1", "1:65", "-1:1", "1:1:1"] {
            assert!(Diagram::read(text).is_err(), "{text}");
        }
    }
}
