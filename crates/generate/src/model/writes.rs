//! Finds the functions and growing domains that a rule may update, directly or through calls.
//!
//! In: a program. Out: the [`Target`]s of each procedure. Rule values and agents may run every procedure that is a
//! value or a program. Units and sequences of the generated code cover these targets only.

use std::collections::BTreeSet;

use program::{DomainId, DomainKind, FunctionId, ProcedureId, Program, Rule, RuleId};

use crate::model::nesting::runnable;

/// Something that an update changes.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub(crate) enum Target {
    Function(FunctionId),
    Domain(DomainId),
}

/// The targets of each procedure.
#[derive(Debug, Clone)]
pub(crate) struct Writes {
    procedures: Vec<BTreeSet<Target>>,
    /// What a rule value or an agent's program may update.
    values: BTreeSet<Target>,
    /// The functions that some rule updates or declares locally.
    updated: BTreeSet<FunctionId>,
    /// How deeply units are nested; `None` if there is no bound.
    pub levels: Option<u64>,
}

impl Writes {
    /// Computes the targets.
    pub fn new(program: &Program) -> Writes {
        let mut writes = Writes {
            procedures: vec![BTreeSet::new(); program.procedures.len()],
            values: BTreeSet::new(),
            updated: program.updated_functions(),
            levels: crate::model::nesting::levels(program),
        };
        let run: Vec<ProcedureId> = runnable(program).collect();
        loop {
            let mut changed = false;
            for (index, procedure) in program.procedures.iter().enumerate() {
                let found = writes.of(program, procedure.body);
                changed |= found.len() != writes.procedures[index].len();
                writes.procedures[index] = found;
            }
            let values: BTreeSet<Target> =
                run.iter().flat_map(|id| writes.procedures[id.0 as usize].iter().copied()).collect();
            changed |= values.len() != writes.values.len();
            writes.values = values;
            if !changed {
                return writes;
            }
        }
    }

    /// What a rule may update.
    pub fn of(&self, program: &Program, rule: RuleId) -> BTreeSet<Target> {
        let mut found = BTreeSet::new();
        let mut open = vec![rule];
        while let Some(id) = open.pop() {
            match program.rule(id) {
                Rule::Update { function, .. } => {
                    found.insert(Target::Function(*function));
                }
                Rule::Return { function, procedure, .. } => {
                    found.insert(Target::Function(*function));
                    found.extend(self.procedure(*procedure));
                }
                Rule::Call { procedure, .. } | Rule::TurboCall { procedure, .. } => {
                    found.extend(self.procedure(*procedure));
                }
                Rule::RunValue { .. } | Rule::RunAgent { .. } => found.extend(&self.values),
                Rule::Extend { domain, .. } => {
                    let base = program.base_domain(*domain);
                    found.extend([Target::Domain(*domain), Target::Domain(base)]);
                }
                Rule::Skip
                | Rule::Par(_)
                | Rule::Seq(_)
                | Rule::If { .. }
                | Rule::Switch { .. }
                | Rule::Let { .. }
                | Rule::Choose { .. }
                | Rule::Forall { .. }
                | Rule::Iterate(_)
                | Rule::While { .. }
                | Rule::RecursiveWhile { .. }
                | Rule::Local { .. } => {}
            }
            program.each_child_of_rule(id, &mut |child| open.push(child));
        }
        found.retain(|target| match target {
            Target::Domain(domain) => match program.domain(*domain).kind {
                DomainKind::Abstract { dynamic, .. } | DomainKind::Concrete { dynamic, .. } => dynamic,
                _ => false,
            },
            Target::Function(_) => true,
        });
        found
    }

    /// Whether any rule updates a function.
    pub fn anywhere(&self, function: FunctionId) -> bool {
        self.updated.contains(&function)
    }

    /// What a procedure may update.
    pub fn procedure(&self, procedure: ProcedureId) -> &BTreeSet<Target> {
        &self.procedures[procedure.0 as usize]
    }
}
