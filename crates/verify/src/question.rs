//! The checks of a program: the built-in ones, its properties, its assumptions.
//!
//! In: a program and [`Options`]. Out: an immutable [`Question`]: the checks in the order of the report, and the
//! [`Plan`] of the search. It knows no engine.

use std::collections::BTreeMap;
use std::sync::Arc;

use explore::{Settings, input_values};
use program::{Program, PropertyKind};

use crate::options::Options;
use crate::plan::Plan;
use crate::target::Target;

/// The subject of a verdict.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum Subject {
    /// No step has an inconsistent update set.
    Consistent,
    /// No update has a value outside its location's domain.
    InDomain,
    /// No step meets an undefined guard or operation.
    Defined,
    /// Each state that is not terminal has a step that changes it.
    NoDeadlock,
    /// A property of the program, by its index.
    Property(usize),
}

/// The checks of a program.
#[derive(Debug)]
pub(crate) struct Question {
    /// The plan of the search.
    pub plan: Plan,
    /// The checks, each with its target among states; `None` for properties of runs.
    pub subjects: Vec<(Subject, Option<Target>)>,
    /// For each condition, the property that it comes from.
    property_of: Vec<usize>,
}

impl Question {
    /// The check that each target violates. With bounded inputs a state without steps violates nothing, since other
    /// inputs might change it.
    pub fn violated(&self, options: &Options) -> BTreeMap<Target, Subject> {
        let targets = self.subjects.iter().filter_map(|(subject, target)| Some(((*target)?, *subject)));
        targets.filter(|(target, _)| *target != Target::Rest || options.bounds.is_empty()).collect()
    }

    /// The property that a condition comes from.
    pub fn property_of(&self, condition: usize) -> usize {
        self.property_of[condition]
    }

    /// The checks of a program under these options.
    pub fn of(program: &Program, options: &Options) -> Question {
        let bounds = input_values(program, &options.bounds, &options.undefined);
        let mut settings = Settings { limits: options.limits.clone(), bounds: Arc::new(bounds), ..Settings::default() };
        settings.forgetful = options.forgetful;
        settings.engine = options.steps;
        settings.numbered = options.symmetry;
        settings.interrupt = options.interrupt.clone();
        let mut plan = Plan {
            settings,
            workers: options.workers,
            first: options.first,
            max_states: options.max_states,
            max_depth: options.max_depth,
            max_bytes: options.max_bytes,
            census: options.census,
            alone: options.alone,
            storage: options.storage,
            seed: options.seed,
            partial_order: options.partial_order,
            symmetry: options.symmetry,
            disk: options.disk.clone(),
            ..Plan::default()
        };
        let mut property_of = Vec::new();
        let mut subjects = vec![
            (Subject::Consistent, Some(Target::Fault(0))),
            (Subject::InDomain, Some(Target::Fault(1))),
            (Subject::Defined, Some(Target::Fault(2))),
            (Subject::NoDeadlock, Some(Target::Rest)),
        ];
        for (index, property) in program.properties.iter().enumerate() {
            let (settings, subject) = (&mut plan.settings, Subject::Property(index));
            let formula = property.formula.clone();
            let assumed = property.kind == PropertyKind::Invar;
            match property.kind {
                PropertyKind::Invariant | PropertyKind::Invar if property.reads_monitored => {
                    let condition = settings.step_conditions.len();
                    settings.step_conditions.push((formula, assumed));
                    if !assumed {
                        plan.wanted_steps.push(condition);
                        subjects.push((subject, Some(Target::StepCondition(condition))));
                    }
                }
                PropertyKind::Invariant | PropertyKind::Invar => {
                    let condition = settings.conditions.len();
                    settings.conditions.push(formula);
                    property_of.push(index);
                    if assumed {
                        plan.assumed.push(condition);
                    } else {
                        plan.wanted.push(condition);
                        subjects.push((subject, Some(Target::Condition(condition))));
                    }
                }
                PropertyKind::Ctl | PropertyKind::Ltl => subjects.push((subject, None)),
                PropertyKind::Justice | PropertyKind::Compassion => {}
            }
        }
        if let Some(terminal) = &options.terminal {
            plan.terminal = Some(plan.settings.conditions.len());
            plan.settings.conditions.push(terminal.clone());
            property_of.push(usize::MAX);
        }
        Question { plan, subjects, property_of }
    }
}
