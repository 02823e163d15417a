//! A condition about an arbitrary state, as terms, with names for the locations and elements in it.
//!
//! In: a program and a condition over it. Out: a [`Question`], first-order logic without quantifiers over the locations
//! that the condition reads. [`crate::encode::free`] defines its meaning.

use std::collections::{BTreeMap, BTreeSet};
use std::sync::Arc;

use machine::Bounds;
use machine::{Limits, Machine, Value};
use program::{DomainKind, Expression, Program};

use crate::encode::free::{Sort, Unknown, is_text_of};
use crate::encode::{Encoder, Outside};
use crate::session::Constant;
use crate::shared::{Node, Op, Terms, VariableId};
use crate::symbol::{Codes, Shape};

/// A condition about an arbitrary state.
#[derive(Debug)]
pub struct Question {
    program: Arc<Program>,
    pub(crate) terms: Terms,
    codes: Codes,
    pub(crate) unknowns: BTreeMap<VariableId, Unknown>,
    /// The condition.
    pub(crate) condition: Node,
    /// Facts about the values of locations.
    pub(crate) given: Vec<Node>,
    /// The locations in the condition, each after those it depends on.
    pub(crate) locations: Vec<Node>,
}

/// The question whether a condition can hold; for an `exist` at its top, values of its variables are searched as well.
///
/// # Errors
/// The condition contains something that cannot be encoded.
pub fn question(program: &Arc<Program>, condition: &Expression) -> Result<Question, Outside> {
    let machine = Machine::new(Arc::clone(program), Limits::default());
    let mut encoder = Encoder::new(machine, Bounds::new(), true, BTreeSet::new());
    let condition = encoder.condition_of_any_state(condition)?;
    let unknowns = encoder.unknowns();
    let Encoder { terms, codes, given, .. } = encoder;
    let is_location = |node: &Node| matches!(terms.op(*node), Op::Variable(_) | Op::Apply(..));
    let locations = terms.parts([condition]).into_iter().filter(is_location).collect();
    Ok(Question { program: Arc::clone(program), terms, codes, unknowns, condition, given, locations })
}

impl Question {
    /// The symbol of a location, and its arguments.
    pub(crate) fn location(&self, node: Node) -> Option<(VariableId, &[Node])> {
        match self.terms.op(node) {
            Op::Variable(id) => Some((*id, &[])),
            Op::Apply(id, arguments) => Some((*id, arguments)),
            _ => None,
        }
    }

    /// Known facts about a location's values.
    pub(crate) fn unknown(&self, node: Node) -> Option<&Unknown> {
        self.unknowns.get(&self.location(node)?.0)
    }

    /// The numbers of a sort's named elements, and the number of the first unnamed one.
    pub(crate) fn named(&self, (shape, domain): Sort) -> (Vec<i128>, i128) {
        let count = match (&self.program.domain(domain).kind, shape) {
            (_, Shape::Coded) => {
                let codes = self.codes.values();
                let ours = |code: &usize| is_text_of(&self.program, domain, &codes[*code]);
                let named = (0..codes.len()).filter(ours).map(|code| code as i128).collect();
                return (named, codes.len() as i128);
            }
            (DomainKind::Enum { literals }, _) => literals.len(),
            (DomainKind::Abstract { elements, .. }, _) => elements.len(),
            _ => 0,
        } as i128;
        ((0..count).collect(), count)
    }

    /// A constant as AsmetaL writes it.
    fn show(&self, (shape, domain): Sort, value: Constant) -> String {
        let number = match (shape, value) {
            (_, Constant::Boolean(truth)) => return truth.to_string(),
            (_, Constant::Real(number)) => return format!("{number:?}"),
            (Shape::Boolean | Shape::Integer | Shape::Real, Constant::Integer(number)) => return number.to_string(),
            (Shape::Enum(_) | Shape::Element(_) | Shape::Coded, Constant::Integer(number)) => number,
        };
        let declared = self.program.domain(domain);
        let at = |names: &[String]| names.get(usize::try_from(number).ok()?).cloned();
        let name = match (&declared.kind, shape) {
            (_, Shape::Coded) => match usize::try_from(number).ok().and_then(|code| self.codes.values().get(code)) {
                Some(Value::String(text)) => Some(format!("{text:?}")),
                Some(Value::Char(letter)) => Some(format!("{letter:?}")),
                _ => None,
            },
            (DomainKind::Enum { literals }, _) => at(literals),
            (DomainKind::Abstract { elements, .. }, _) => at(elements),
            _ => None,
        };
        let first = self.named((shape, domain)).1;
        name.unwrap_or_else(|| format!("{}!{}", declared.name, number - first + 1))
    }

    /// A location and its value: `f(a) = v`, `isUndef(f)`.
    pub(crate) fn show_location(&self, id: VariableId, arguments: &[Constant], value: Constant) -> String {
        let Some(unknown) = self.unknowns.get(&id) else { return String::new() };
        let shown = arguments.iter().zip(&unknown.parameters).map(|(value, sort)| self.show(*sort, *value));
        let arguments: Vec<String> = shown.collect();
        let location = match arguments.is_empty() {
            true => unknown.name.clone(),
            false => format!("{}({})", unknown.name, arguments.join(", ")),
        };
        match (unknown.definedness, value) {
            (true, Constant::Boolean(true)) => format!("isDef({location})"),
            (true, _) => format!("isUndef({location})"),
            (false, Constant::Boolean(true)) => location,
            (false, Constant::Boolean(false)) => format!("not {location}"),
            (false, value) => format!("{location} = {}", self.show(unknown.sort, value)),
        }
    }
}
