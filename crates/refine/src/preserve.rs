//! Which properties of the abstract machine hold of the concrete one because it refines it, and in which form.
//!
//! In: a product whose game is won, or what else is proved of runs. Out: for each invariant and temporal property of the abstract machine a [`Preserved`]: what it says
//! of the concrete machine, or why it does not come along. Theory: a concrete run has the abstract run's states at the ends of its
//! diagrams, each again and again for a while. So it keeps what holds of all runs and does not count steps (Lamport 1983 of LTL; Browne,
//! Clarke, Grumberg 1988 of CTL*). INVARIANT: that an abstract property holds is assumed here, and nowhere else looked at.

use program::{Builtin, Program, Property, PropertyKind, Quantifier, TemporalOperator, Term, TermId};

use crate::ABSTRACT;
use crate::coupling::Coupling;
use crate::game::Parents;
use crate::product::Product;
use crate::transfer::{Ends, Transfer};
use crate::translate::Translation;

/// LIMIT: so many parts of a formula are looked at.
const PARTS: u32 = 1 << 14;

/// A property of the abstract machine.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Preserved {
    /// Its index in the abstract program.
    pub property: usize,
    /// Which kind it is.
    pub kind: PropertyKind,
    /// Its name.
    pub name: String,
    /// What holds of the concrete machine if the property holds of the abstract one, as the concrete model would write it; or a clause
    /// that says why nothing does.
    pub form: Result<String, String>,
}

/// The properties of the abstract machine, by a game that is won.
pub(crate) fn preserved(product: &mut Product<'_>, parents: &Parents) -> Vec<Preserved> {
    let coupling = product.judge.coupling;
    let is_asked = coupling.programs[ABSTRACT].properties.iter().any(is_said);
    if is_asked { preserved_by(coupling, &Transfer::of(product, parents)) } else { Vec::new() }
}

fn is_said(property: &Property) -> bool {
    matches!(property.kind, PropertyKind::Invariant | PropertyKind::Ctl | PropertyKind::Ltl)
}

/// The properties of the abstract machine, by what a proof says of runs.
pub(crate) fn preserved_by(coupling: &Coupling, transfer: &Transfer) -> Vec<Preserved> {
    let program = &*coupling.programs[ABSTRACT];
    let mut translation = Translation::new(coupling, transfer.ends == Ends::Segments);
    let properties = program.properties.iter().enumerate().filter(|(_, property)| is_said(property));
    let told = properties.map(|(index, property)| {
        let allowed = admits(program, property, transfer);
        let form = allowed.and_then(|()| translation.of(property));
        Preserved { property: index, kind: property.kind, name: property.name.clone(), form }
    });
    told.collect()
}

/// What a property needs of the two runs.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
struct Needs {
    each: bool,
    live: bool,
    exact: bool,
    /// It speaks of runs.
    runs: bool,
}

impl Needs {
    const NOTHING: Needs = Needs { each: false, live: false, exact: false, runs: true };
    const EACH: Needs = Needs { each: true, ..Needs::NOTHING };
    const LIVE: Needs = Needs { live: true, ..Needs::EACH };
    const EXACT: Needs = Needs { exact: true, ..Needs::LIVE };

    fn and(self, other: Needs) -> Needs {
        Needs {
            each: self.each | other.each,
            live: self.live | other.live,
            exact: self.exact | other.exact,
            runs: self.runs | other.runs,
        }
    }
}

/// Whether the two runs keep step as a property needs it.
fn admits(program: &Program, property: &Property, transfer: &Transfer) -> Result<(), String> {
    if transfer.ends == Ends::Some {
        return Err(
            "diagrams of several concrete steps pass through states that correspond to nothing, and no `segment` \
                    that is true or false in every state says where they end"
                .to_string(),
        );
    }
    if property.kind == PropertyKind::Invariant {
        return Ok(());
    }
    let unfair = |property: &Property| matches!(property.kind, PropertyKind::Justice | PropertyKind::Compassion);
    if program.properties.iter().any(unfair) {
        return Err("it speaks of fair runs only, and the refinement does not look at fairness".to_string());
    }
    let needs = Reader { program, left: PARTS }.needs(property.formula.body, true)?;
    let refuse = |why: &str| Err(why.to_string());
    if needs.runs && transfer.ends == Ends::Segments && transfer.begins_inside {
        return refuse("an initial state of the concrete machine is not the end of a segment");
    }
    if needs.exact && !transfer.exact {
        return refuse("it speaks of the next step, and a step of one machine may be none or several of the other");
    }
    if needs.each && !transfer.each {
        return refuse("a diagram of several abstract steps passes over states that it speaks of");
    }
    if needs.live && !transfer.live {
        return refuse(
            "something must happen by it, and the concrete machine may go on for ever while the abstract one makes no step, \
             or come to an end",
        );
    }
    Ok(())
}

/// Reads a formula for what it needs.
struct Reader<'p> {
    program: &'p Program,
    left: u32,
}

impl Reader<'_> {
    /// What a formula needs, where it stands under an even number of negations or an odd one.
    fn needs(&mut self, term: TermId, positive: bool) -> Result<Needs, String> {
        if !self.is_temporal(term)? {
            return Ok(Needs::default());
        }
        let program = self.program;
        match program.term(term) {
            Term::Builtin { builtin: Builtin::Temporal(operator), arguments } => {
                self.operator(*operator, program.term_list(*arguments), positive)
            }
            Term::Builtin { builtin, arguments } => {
                let arguments = program.term_list(*arguments);
                match (builtin, arguments) {
                    (Builtin::Not, [p]) => self.needs(*p, !positive),
                    (Builtin::And | Builtin::Or, all) => self.all(all, positive),
                    (Builtin::Implies, [p, q]) => Ok(self.needs(*p, !positive)?.and(self.needs(*q, positive)?)),
                    (_, all) => self.both(all),
                }
            }
            Term::Quantified { quantifier, binders, condition } => {
                let mut needs = Needs::default();
                for binder in program.binder_list(*binders) {
                    if self.is_temporal(binder.range)? {
                        needs = needs.and(self.both(&[binder.range])?);
                    }
                }
                let inside: Vec<TermId> = condition.iter().copied().collect();
                Ok(needs.and(match quantifier {
                    Quantifier::Forall | Quantifier::Exists => self.all(&inside, positive)?,
                    Quantifier::ExistsUnique => self.both(&inside)?,
                }))
            }
            Term::If { branches, otherwise } => {
                let mut needs = Needs::default();
                for pair in program.term_list(*branches).chunks_exact(2) {
                    needs = needs.and(self.both(&pair[..1])?).and(self.needs(pair[1], positive)?);
                }
                match otherwise {
                    Some(otherwise) => Ok(needs.and(self.needs(*otherwise, positive)?)),
                    None => Ok(needs),
                }
            }
            Term::Define { function, arguments } if arguments.len == 0 => {
                match &program.function(*function).definition {
                    Some(definition) => self.needs(definition.body, positive),
                    None => Ok(Needs::default()),
                }
            }
            _ => Err("its temporal operators stand in a term that is not translated".to_string()),
        }
    }

    fn all(&mut self, terms: &[TermId], positive: bool) -> Result<Needs, String> {
        let mut needs = Needs::default();
        for term in terms {
            needs = needs.and(self.needs(*term, positive)?);
        }
        Ok(needs)
    }

    /// Parts that stand under negations and under none.
    fn both(&mut self, terms: &[TermId]) -> Result<Needs, String> {
        Ok(self.all(terms, true)?.and(self.all(terms, false)?))
    }

    fn operator(&mut self, operator: TemporalOperator, arguments: &[TermId], positive: bool) -> Result<Needs, String> {
        use TemporalOperator::*;
        let needs = match (operator, positive) {
            // What fails if negated is what some run does.
            (Ag, true) | (Ef, false) | (AbsenceGlobally | AbsenceAfter, true) => Needs::NOTHING,
            (Aw, true) | (Eu, false) => Needs::EACH,
            (AbsenceBefore | AbsenceBetween | AbsenceAfterUntil | Precedence | PrecedenceBefore, true) => Needs::EACH,
            (Af | Au, true) | (Eg | Ew, false) => Needs::LIVE,
            (Ax | AxN, true) | (Ex | ExN, false) => Needs::EXACT,
            (Ef | Eg | Eu | Ew | Ex | ExN, true) => {
                return Err(
                    "it asks that some run does something, and the concrete machine may have fewer runs".to_string()
                );
            }
            (
                Ag | Af | Au | Aw | Ax | AxN | AbsenceGlobally | AbsenceBefore | AbsenceAfter | AbsenceBetween
                | AbsenceAfterUntil | Precedence | PrecedenceBefore,
                false,
            ) => {
                return Err(
                    "it asks that some run does something, and the concrete machine may have fewer runs".to_string()
                );
            }
            (Globally, true) | (Finally, false) => Needs::NOTHING,
            (Releases, true) | (Until, false) | (Historically | Once | Since | Triggered, _) => Needs::EACH,
            (Finally | Until, true) | (Globally | Releases, false) => Needs::LIVE,
            (Next | Previous | WeakPrevious, _) => Needs::EXACT,
        };
        let inside = match (operator, arguments) {
            (AxN | ExN, [formula, _]) => self.needs(*formula, positive)?,
            (
                AbsenceGlobally | AbsenceBefore | AbsenceAfter | AbsenceBetween | AbsenceAfterUntil | Precedence
                | PrecedenceBefore,
                all,
            ) => self.both(all)?,
            (_, all) => self.all(all, positive)?,
        };
        Ok(needs.and(inside))
    }

    /// Whether a temporal operator stands in a term, or in what it calls.
    fn is_temporal(&mut self, term: TermId) -> Result<bool, String> {
        let mut open = vec![term];
        let mut entered = Vec::new();
        while let Some(id) = open.pop() {
            self.left = self.left.checked_sub(1).ok_or("it is too large to be looked through")?;
            match self.program.term(id) {
                Term::Builtin { builtin: Builtin::Temporal(_), .. } => return Ok(true),
                Term::Define { function, .. } if !entered.contains(function) => {
                    entered.push(*function);
                    open.extend(self.program.function(*function).definition.iter().map(|definition| definition.body));
                }
                _ => {}
            }
            self.program.each_child_of_term(id, &mut |child| open.push(child));
        }
        Ok(false)
    }
}
