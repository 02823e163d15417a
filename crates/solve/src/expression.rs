//! Parses the output of solvers: expressions in parentheses, and the numbers in them.

/// An S-expression.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(crate) enum Expression {
    Word(String),
    List(Vec<Expression>),
}

pub(crate) fn spelled(expression: &Expression) -> String {
    match expression {
        Expression::Word(word) => word.clone(),
        Expression::List(inner) => format!("({})", inner.iter().map(spelled).collect::<Vec<_>>().join(" ")),
    }
}

/// `12`, `(- 12)`
pub(crate) fn integer(expression: &Expression) -> Option<i128> {
    match expression {
        Expression::Word(word) => word.parse().ok(),
        Expression::List(inner) => match &inner[..] {
            [Expression::Word(sign), number] if sign == "-" => integer(number).map(|number| -number),
            _ => None,
        },
    }
}

/// `1.5`, `(- 1.5)`, `(/ 1.0 3.0)`
pub(crate) fn real(expression: &Expression) -> Option<f64> {
    match expression {
        Expression::Word(word) => word.parse().ok(),
        Expression::List(inner) => match &inner[..] {
            [Expression::Word(sign), number] if sign == "-" => real(number).map(|number| -number),
            [Expression::Word(sign), a, b] if sign == "/" => Some(real(a)? / real(b)?),
            _ => None,
        },
    }
}

/// The expressions of a text; unmatched parentheses are ignored.
pub(crate) fn expressions(text: &str) -> Vec<Expression> {
    let mut open: Vec<Vec<Expression>> = vec![Vec::new()];
    let mut letters = text.char_indices().peekable();
    let put = |open: &mut Vec<Vec<Expression>>, expression| {
        if let Some(list) = open.last_mut() {
            list.push(expression);
        }
    };
    while let Some((start, letter)) = letters.next() {
        match letter {
            '(' => open.push(Vec::new()),
            ')' => {
                let list = open.pop().unwrap_or_default();
                if open.is_empty() {
                    open.push(Vec::new());
                }
                put(&mut open, Expression::List(list));
            }
            '|' => {
                let end = letters.by_ref().find(|(_, letter)| *letter == '|').map_or(text.len(), |(at, _)| at + 1);
                put(&mut open, Expression::Word(text[start..end].to_string()));
            }
            letter if letter.is_whitespace() => {}
            _ => {
                let mut end = start + letter.len_utf8();
                while let Some((at, letter)) = letters.peek() {
                    if letter.is_whitespace() || matches!(letter, '(' | ')') {
                        break;
                    }
                    end = at + letter.len_utf8();
                    letters.next();
                }
                put(&mut open, Expression::Word(text[start..end].to_string()));
            }
        }
    }
    open.swap_remove(0)
}
