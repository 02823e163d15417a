//! Vacuity: parts of a formula that have no part in its being true.
//!
//! In: properties that hold. Out: stronger formulas, each with one part replaced by `false` where the formula grows with the part, and by
//! `true` where it shrinks with it. If such a formula holds as well, the replaced part plays no part: whatever stood in its place, the formula would
//! hold. Source: I. Beer, S. Ben-David, C. Eisner, Y. Rodeh, *Efficient detection of vacuity in temporal model checking*, Formal Methods in
//! System Design 18(2), 2001; that one replacement by a constant decides it for a part that occurs once: O. Kupferman, M. Y. Vardi, *Vacuity
//! detection in temporal model checking*, STTT 4(2), 2003. Parts are operands of connectives, quantifiers and temporal operators; what
//! is inside of a definition, of an equation, or under an operator that neither grows nor shrinks with it is not looked at.

use program::{
    Basic, Builtin, DomainId, DomainKind, Expression, Literal, Program, Property, PropertyKind, Quantifier,
    TemporalOperator, Term, TermId, TermList,
};
use syntax::Span;

use crate::question::Subject;
use crate::report::{Outcome, Report};

/// A part of a formula, replaced by a constant that makes the formula stronger.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Replaced {
    /// The property, in the program that it is from.
    pub property: usize,
    /// Where the part is written.
    pub part: Span,
    /// What stands in its place.
    pub by: bool,
    /// The one of these whose part contains this one; none if no part does.
    inside: Option<usize>,
}

/// The properties of a program, with parts replaced.
#[derive(Debug, Clone)]
pub struct Question {
    /// The program with its assumptions, and with each stronger formula as a property.
    pub program: Program,
    /// What was replaced, outer parts before inner ones.
    pub replaced: Vec<Replaced>,
    /// The place of the first stronger formula among the properties of `program`; the others follow.
    first: usize,
}

/// What a search says of a [`Question`].
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct Idle {
    /// Parts without which their properties hold as well; none inside of another.
    pub parts: Vec<Replaced>,
    /// How many parts it is not known of.
    pub open: usize,
}

impl Question {
    /// Asks which parts of properties are idle. The properties are those that hold, by their places; assumptions stay as they are.
    pub fn new(program: &Program, properties: &[usize]) -> Question {
        let mut asked = program.clone();
        let is_asked = |kind| matches!(kind, PropertyKind::Invariant | PropertyKind::Ctl | PropertyKind::Ltl);
        asked.properties.retain(|property| !is_asked(property.kind));
        let first = asked.properties.len();
        let mut replaced: Vec<Replaced> = Vec::new();
        for index in properties {
            let property = &program.properties[*index];
            let mut parts = Vec::new();
            find(program, property.formula.body, &mut Vec::new(), (true, true), None, &mut parts);
            let before = replaced.len();
            for part in parts {
                let span = program.term_span(part.term);
                let constant = constant(&mut asked, part.grows, span);
                let body = rebuilt(&mut asked, property.formula.body, &part.path, constant);
                let formula = Expression { body, ..property.formula.clone() };
                asked.properties.push(Property { formula, ..property.clone() });
                let inside = part.inside.map(|inside| before + inside);
                replaced.push(Replaced { property: *index, part: span, by: !part.grows, inside });
            }
        }
        Question { program: asked, replaced, first }
    }

    /// The idle parts, by the verdicts on the stronger formulas.
    pub fn idle(&self, report: &Report) -> Idle {
        let outcome = |number: usize| {
            let subject = Subject::Property(self.first + number);
            report.verdicts.iter().find(|verdict| verdict.subject == subject).map(|verdict| &verdict.outcome)
        };
        let mut is_idle: Vec<bool> = Vec::new();
        let mut idle = Idle::default();
        for (number, replaced) in self.replaced.iter().enumerate() {
            let within = replaced.inside.is_some_and(|inside| is_idle[inside]);
            match outcome(number) {
                Some(Outcome::Holds) if !within => idle.parts.push(*replaced),
                Some(Outcome::Holds | Outcome::Violated(_)) => {}
                Some(Outcome::Unknown(_)) | None => idle.open += 1,
            }
            is_idle.push(within || matches!(outcome(number), Some(Outcome::Holds)));
        }
        idle
    }
}

/// A part of a formula.
struct Part {
    term: TermId,
    /// From the formula down: which operand.
    path: Vec<usize>,
    /// The formula is true in more cases if the part is; otherwise in fewer.
    grows: bool,
    inside: Option<usize>,
}

fn find(
    program: &Program,
    term: TermId,
    path: &mut Vec<usize>,
    (grows, alone): (bool, bool),
    inside: Option<usize>,
    parts: &mut Vec<Part>,
) {
    let operands = operands(program, term);
    // With all of the formula under an operator replaced, it would say nothing.
    let alone = alone && operands.len() == 1;
    for (index, (operand, same)) in operands.into_iter().enumerate() {
        let Some(same) = same else { continue };
        path.push(index);
        let grows = grows == same;
        let mut within = inside;
        if !alone && !matches!(program.term(operand), Term::Constant(_)) {
            within = Some(parts.len());
            parts.push(Part { term: operand, path: path.clone(), grows, inside });
        }
        find(program, operand, path, (grows, alone), within, parts);
        path.pop();
    }
}

/// The operands of a term that a part may be; whether the term grows (true) or shrinks with each, or none where that is not so.
fn operands(program: &Program, term: TermId) -> Vec<(TermId, Option<bool>)> {
    let is_boolean = |operand: TermId| {
        let domain = &program.domain(program.term_domain(operand)).kind;
        matches!(domain, DomainKind::Basic(Basic::Boolean))
    };
    match program.term(term) {
        Term::Builtin { builtin, arguments } => {
            let arguments = program.term_list(*arguments);
            let directions: Vec<bool> = match builtin {
                Builtin::And | Builtin::Or => vec![true; arguments.len()],
                Builtin::Not => vec![false],
                Builtin::Implies => vec![false, true],
                Builtin::Temporal(operator) if grows(*operator) => vec![true; arguments.len()],
                _ => return Vec::new(),
            };
            arguments
                .iter()
                .zip(directions)
                .map(|(operand, same)| (*operand, is_boolean(*operand).then_some(same)))
                .collect()
        }
        Term::Quantified {
            quantifier: Quantifier::Forall | Quantifier::Exists, condition: Some(condition), ..
        } => {
            vec![(*condition, Some(true))]
        }
        Term::Let { body, .. } => vec![(*body, Some(true))],
        Term::Quantified { .. }
        | Term::Constant(_)
        | Term::Slot(_)
        | Term::Read { .. }
        | Term::Define { .. }
        | Term::Domain(_)
        | Term::Tuple(_)
        | Term::Project { .. }
        | Term::Collection { .. }
        | Term::Range { .. }
        | Term::Comprehension { .. }
        | Term::If { .. }
        | Term::Switch { .. }
        | Term::Rule(_)
        | Term::Unbound
        | Term::Missing(_)
        | Term::Coerce(_) => Vec::new(),
    }
}

/// Whether a temporal operator grows with each of its operands.
fn grows(operator: TemporalOperator) -> bool {
    use TemporalOperator as T;
    match operator {
        T::Eg | T::Ex | T::Ef | T::Ag | T::Ax | T::Af | T::Eu | T::Au | T::Ew | T::Aw | T::ExN | T::AxN => true,
        T::Next | T::Globally | T::Finally | T::Until | T::Releases => true,
        T::Previous | T::WeakPrevious | T::Historically | T::Once | T::Since | T::Triggered => true,
        T::AbsenceGlobally
        | T::AbsenceBefore
        | T::AbsenceAfter
        | T::AbsenceBetween
        | T::AbsenceAfterUntil
        | T::Precedence
        | T::PrecedenceBefore => false,
    }
}

/// The constant that makes a formula stronger where it stands for a part.
fn constant(program: &mut Program, grows: bool, span: Span) -> TermId {
    let literal = Literal::Boolean(!grows);
    let known = program.constants.iter().position(|constant| *constant == literal);
    let index = known.unwrap_or_else(|| {
        program.constants.push(literal);
        program.constants.len() - 1
    });
    let boolean = |domain: &program::Domain| matches!(domain.kind, DomainKind::Basic(Basic::Boolean));
    let domain = program.domains.iter().position(boolean).expect("a formula is Boolean");
    program.add_term(Term::Constant(index as u32), DomainId(domain as u32), span)
}

/// A term with the operand at a path replaced.
fn rebuilt(program: &mut Program, term: TermId, path: &[usize], by: TermId) -> TermId {
    let Some((first, rest)) = path.split_first() else { return by };
    let (operand, _) = operands(program, term)[*first];
    let replaced = rebuilt(program, operand, rest, by);
    let copy = match program.term(term).clone() {
        Term::Builtin { builtin, arguments } => {
            let mut list = program.term_list(arguments).to_vec();
            list[*first] = replaced;
            let start = program.term_lists.len() as u32;
            program.term_lists.extend_from_slice(&list);
            Term::Builtin { builtin, arguments: TermList { start, len: list.len() as u32 } }
        }
        Term::Quantified { quantifier, binders, .. } => {
            Term::Quantified { quantifier, binders, condition: Some(replaced) }
        }
        Term::Let { slot, value, .. } => Term::Let { slot, value, body: replaced },
        other => other,
    };
    program.add_term(copy, program.term_domain(term), program.term_span(term))
}
