//! A solver that answers one question after another and keeps what it was told.
//!
//! In: commands of SMT-LIB. Out: the solver's answers, as [`Verdict`]s and [`Constant`]s. The shell runs the process.

use crate::expression::{Expression, expressions, integer, real, spelled};
use crate::shared::Kind;

/// Why a solver does not answer.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Silence {
    /// It exceeds the time limit.
    Late,
    /// The caller stopped waiting.
    Stopped,
    /// It cannot be run, or has ended; a clause says why.
    Broken(String),
}

/// A running solver. After a [`Silence`] it is not asked again.
pub trait Session {
    /// Sends commands, the last of which has an answer, and returns that answer: one expression. Waits at most this
    /// many seconds; asks `go_on` regularly whether to continue.
    ///
    /// # Errors
    /// There is no answer.
    fn ask(&mut self, commands: &str, seconds: u32, go_on: &mut dyn FnMut() -> bool) -> Result<String, Silence>;
}

/// Starts solvers.
pub trait Solvers {
    /// The solver's name and version: `z3 4.8.12`.
    ///
    /// # Errors
    /// There is no solver; a clause says why.
    fn name(&self) -> Result<String, String>;

    /// Starts a solver.
    ///
    /// # Errors
    /// There is no solver, or it does not run.
    fn start(&mut self) -> Result<Box<dyn Session>, Silence>;
}

/// A solver's answer about satisfiability.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Verdict {
    /// `sat`
    Possible,
    /// `unsat`
    Impossible,
    /// Neither.
    Unknown,
}

/// The verdict in an answer.
///
/// # Errors
/// The answer is no verdict; says what it is.
pub fn verdict(answer: &str) -> Result<Verdict, Silence> {
    match answer.trim() {
        "sat" => Ok(Verdict::Possible),
        "unsat" => Ok(Verdict::Impossible),
        "unknown" | "timeout" => Ok(Verdict::Unknown),
        other => {
            Err(Silence::Broken(format!("the solver says `{}`", other.chars().take(200).collect::<String>().trim())))
        }
    }
}

/// A value in an answer.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Constant {
    /// A truth value.
    Boolean(bool),
    /// An integer.
    Integer(i128),
    /// The double nearest to a real number.
    Real(f64),
}

/// The values in an answer to `get-value` for terms of these kinds; `None` for values that are not our constants, such
/// as algebraic numbers.
pub fn constants(answer: &str, kinds: &[Kind]) -> Vec<Option<Constant>> {
    let pairs = match expressions(answer).into_iter().next() {
        Some(Expression::List(pairs)) => pairs,
        _ => Vec::new(),
    };
    let value = |index: usize, kind: &Kind| {
        let Expression::List(pair) = pairs.get(index)? else { return None };
        let value = pair.get(1)?;
        match kind {
            Kind::Boolean => spelled(value).parse().ok().map(Constant::Boolean),
            Kind::Integer => integer(value).map(Constant::Integer),
            Kind::Real => real(value).map(Constant::Real),
        }
    };
    kinds.iter().enumerate().map(|(index, kind)| value(index, kind)).collect()
}

/// Whether a text is a complete answer: a word on a line, or an expression with balanced parentheses.
pub fn is_answer(text: &str) -> bool {
    let (mut depth, mut quoted, mut inside) = (0i64, None, false);
    for letter in text.chars() {
        match (quoted, letter) {
            (Some(quote), letter) if quote == letter => quoted = None,
            (Some(_), _) => {}
            (None, '|' | '"') => quoted = Some(letter),
            (None, '(') => (depth, inside) = (depth + 1, true),
            (None, ')') => depth -= 1,
            (None, letter) => inside |= !letter.is_whitespace(),
        }
    }
    inside && depth <= 0 && quoted.is_none() && text.ends_with('\n')
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn answers() {
        assert!(is_answer("sat\n") && is_answer("((x 1)\n (|(| 2))\n"));
        assert!(!is_answer("\n") && !is_answer("((x 1)\n") && !is_answer("sa") && !is_answer("((|x) 1|\n"));
        let kinds = [Kind::Integer, Kind::Boolean, Kind::Real, Kind::Real, Kind::Integer];
        let read =
            constants("((x (- 5)) (p true) (r (- (/ 1.0 4.0))) (s (root-obj x 1)) (y 9223372036854775808))", &kinds);
        let expected = [
            Some(Constant::Integer(-5)),
            Some(Constant::Boolean(true)),
            Some(Constant::Real(-0.25)),
            None,
            Some(Constant::Integer(1 << 63)),
        ];
        assert_eq!(read, expected);
        assert_eq!(verdict("unsat\n"), Ok(Verdict::Impossible));
        assert!(verdict("(error \"line 1\")").is_err());
    }
}
