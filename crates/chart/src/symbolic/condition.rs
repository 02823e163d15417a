//! Executes conditions symbolically: each path is a list of atoms with their values, and has a result.
//!
//! INVARIANT: the paths of one condition exclude each other and cover all cases; none tests an atom twice.

use std::rc::Rc;

use model::{Literal, Term, TermKind};

use super::{Bound, Explorer, Frame};

/// Tests and their outcomes, in the order in which they are made.
pub(crate) type Path = Vec<(String, bool)>;

/// A path followed by another; `None` if they contradict each other.
pub(crate) fn joined(path: &Path, rest: &Path) -> Option<Path> {
    let mut out = path.clone();
    for (atom, holds) in rest {
        match out.iter().find(|(known, _)| known == atom) {
            Some((_, known)) if known != holds => return None,
            Some(_) => {}
            None => out.push((atom.clone(), *holds)),
        }
    }
    Some(out)
}

/// Whether no atom has different values on two paths.
pub(crate) fn consistent(a: &Path, b: &Path) -> bool {
    joined(a, b).is_some()
}

type Ways = Vec<(Path, bool)>;

/// Extends each path by further paths, chosen by its result.
fn then(first: &Ways, next: impl Fn(bool) -> Ways) -> Ways {
    let mut out = Vec::new();
    for (path, holds) in first {
        let further = next(*holds);
        out.extend(further.iter().filter_map(|(rest, result)| Some((joined(path, rest)?, *result))));
    }
    out
}

fn decided(holds: bool) -> Ways {
    vec![(Vec::new(), holds)]
}

impl<'m> Explorer<'m> {
    /// The paths through a condition.
    pub(super) fn condition(&self, term: &'m Term, frame: &Rc<Frame<'m>>, depth: usize) -> Ways {
        if depth > 40 {
            return self.atom(term, frame);
        }
        let inner = |term: &'m Term| self.condition(term, frame, depth + 1);
        match &term.kind {
            TermKind::Literal(Literal::Boolean(holds)) => decided(*holds),
            TermKind::Variable(id) => match frame.bound[id.0 as usize].as_ref().and_then(|bound| bound.term.as_ref()) {
                Some((term, frame)) => self.condition(term, frame, depth + 1),
                None => self.atom(term, frame),
            },
            TermKind::If { branches, otherwise: Some(otherwise) } => {
                let mut ways = inner(otherwise);
                for (guard, value) in branches.iter().rev() {
                    let rest = ways;
                    ways = then(&inner(guard), |holds| if holds { inner(value) } else { rest.clone() });
                }
                ways
            }
            TermKind::Switch { subject, cases, otherwise: Some(otherwise) } => {
                let mut ways = inner(otherwise);
                for (value, result) in cases.iter().rev() {
                    let rest = ways;
                    let equal = self.equality(subject, value, frame);
                    ways = then(&equal, |holds| if holds { inner(result) } else { rest.clone() });
                }
                ways
            }
            TermKind::Let { bindings, body } => {
                let mut frame = Rc::clone(frame);
                for (variable, term) in bindings {
                    let mut bound = frame.bound.clone();
                    bound[variable.0 as usize] =
                        Some(Bound { text: self.print(term, &frame), term: Some((term, Rc::clone(&frame))) });
                    frame = Rc::new(Frame { variables: frame.variables, bound });
                }
                self.condition(body, &frame, depth + 1)
            }
            TermKind::Apply { function, arguments } => {
                let declared = self.model.function(*function);
                match (declared.name.as_str(), &arguments[..]) {
                    ("not", [a]) => inner(a).into_iter().map(|(path, holds)| (path, !holds)).collect(),
                    ("and", [a, b]) => then(&inner(a), |holds| if holds { inner(b) } else { decided(false) }),
                    ("or", [a, b]) => then(&inner(a), |holds| if holds { decided(true) } else { inner(b) }),
                    ("implies", [a, b]) => then(&inner(a), |holds| if holds { inner(b) } else { decided(true) }),
                    ("eq", [a, b]) => self.equality(a, b, frame),
                    ("neq", [a, b]) => self.equality(a, b, frame).into_iter().map(|(p, holds)| (p, !holds)).collect(),
                    ("isUndef", [a]) => self.definedness(term, a, frame, true),
                    ("isDef", [a]) => self.definedness(term, a, frame, false),
                    _ if self.reads_control(*function, 0) => self.defined(*function, arguments, frame, depth),
                    _ => self.atom(term, frame),
                }
            }
            _ => self.atom(term, frame),
        }
    }

    fn atom(&self, term: &'m Term, frame: &Rc<Frame<'m>>) -> Ways {
        let text = self.print(term, frame);
        vec![(vec![(text.clone(), true)], true), (vec![(text, false)], false)]
    }

    /// `a = b`, decided if both are constants.
    pub(super) fn equality(&self, a: &'m Term, b: &'m Term, frame: &Rc<Frame<'m>>) -> Ways {
        if let (Some(a), Some(b)) = (self.constant(a, frame), self.constant(b, frame)) {
            return decided(a == b);
        }
        let text = format!("{} = {}", self.operand(a, frame), self.operand(b, frame));
        vec![(vec![(text.clone(), true)], true), (vec![(text, false)], false)]
    }

    fn definedness(&self, whole: &'m Term, term: &'m Term, frame: &Rc<Frame<'m>>, undef: bool) -> Ways {
        match self.constant(term, frame) {
            Some(value) => decided((value == "undef") == undef),
            None => self.atom(whole, frame),
        }
    }

    /// A function with a definition, which is expanded.
    fn defined(&self, function: model::FunctionId, arguments: &'m [Term], frame: &Rc<Frame<'m>>, depth: usize) -> Ways {
        let Some(definition) = &self.model.function(function).definition else { return decided(true) };
        let mut bound: Vec<Option<Bound<'m>>> = vec![None; definition.variables.len()];
        for (parameter, argument) in definition.parameters.iter().zip(arguments) {
            bound[parameter.0 as usize] =
                Some(Bound { text: self.print(argument, frame), term: Some((argument, Rc::clone(frame))) });
        }
        let inside = Rc::new(Frame { variables: &definition.variables, bound });
        self.condition(&definition.body, &inside, depth + 1)
    }
}
