//! Describes how far a search came, and what reduced it.
//!
//! In: the numbers of a search, and its reductions. Out: words and lines.

use machine::{Show, Value};
use program::DomainKind;
use syntax::Span;
use verify::{Distinct, EngineKind, Progress, Report, Symmetry, Unreduced};

use super::{Verdicts, plural};

/// What reduced a search, and how it went through the states.
#[derive(Debug, Clone, Copy, Default)]
pub struct Extent {
    /// All reachable states were explored.
    pub complete: bool,
    /// Independent moves were made in one order.
    pub is_reduced: bool,
    /// States that differ by interchangeable elements were one.
    pub up_to_elements: bool,
    /// The search used sets of states.
    pub sets: bool,
}

impl Extent {
    /// Of a verification.
    pub fn of(report: &Report) -> Extent {
        let classes = report.symmetry.as_ref().map_or(&[][..], |symmetry| &symmetry.classes);
        Extent {
            complete: report.complete,
            is_reduced: matches!(report.reduced, Some(Ok(()))),
            up_to_elements: classes.iter().any(|(_, class)| !class.is_empty()),
            sets: report.engine == EngineKind::Symbolic,
        }
    }
}

/// How far a search came, as one line.
pub fn explored(progress: &Progress, extent: Extent) -> String {
    let whole = match extent {
        Extent { complete: false, .. } => "not all reachable",
        Extent { is_reduced: true, .. } => "all reachable, up to the order of moves",
        Extent { up_to_elements: true, .. } => "all reachable, up to interchangeable elements",
        _ => "all reachable",
    };
    let states = plural(progress.states as usize, "state");
    let transitions = match extent.sets {
        true => "met as sets".to_string(),
        false => plural(progress.transitions as usize, "transition"),
    };
    // Rounds of a symbolic search are not depths.
    let depth = if extent.sets { String::new() } else { format!(", depth {}", progress.depth) };
    let disk = match progress.spilled {
        0 => String::new(),
        bytes => format!(", {} MiB on disk", bytes.div_ceil(1 << 20)),
    };
    // Where the engine has found that remembering steps does not pay.
    let compiled = match progress.compiled {
        0 => String::new(),
        count => format!(", the steps of {count} by machine code"),
    };
    let blocked = match progress.blocked {
        0 => String::new(),
        count => format!("; in {} no step satisfies the assumptions: runs end there", plural(count as usize, "state")),
    };
    format!("{states} ({whole}), {transitions}{depth}{disk}{compiled}{blocked}")
}

/// Why partial-order reduction was not possible.
pub fn why_unreduced(unreduced: Unreduced) -> &'static str {
    match unreduced {
        Unreduced::NoChoice => "the main rule does not choose who moves",
        Unreduced::Inputs => "an invariant or an assumption reads inputs",
        Unreduced::AllShared => "no agent has locations of its own",
    }
}

impl Verdicts<'_> {
    /// Which elements are interchangeable, and why others are not, as lines.
    pub fn symmetry(&self, symmetry: &Symmetry) -> Vec<String> {
        let mut lines = Vec::new();
        for (domain, class) in &symmetry.classes {
            let domain = &self.program.domain(*domain).name;
            lines.push(format!("interchangeable in {domain}: {}", self.elements(class).join(", ")));
        }
        for (domain, why) in &symmetry.distinct {
            let declared = self.program.domain(*domain);
            // Literals of an enum are always named, so this reason is left out for them.
            if !matches!((&declared.kind, why), (DomainKind::Enum { .. }, Distinct::Named(_))) {
                lines.push(format!("not interchangeable in {}: {}", declared.name, self.why_distinct(*why)));
            }
        }
        lines
    }

    /// The elements of a class.
    pub fn elements(&self, class: &[Value]) -> Vec<String> {
        class.iter().map(|element| element.show(self.program).to_string()).collect()
    }

    /// Why elements are not interchangeable.
    pub fn why_distinct(&self, why: Distinct) -> String {
        let place = place_of(why).map(|span| format!(" ({})", self.place(span))).unwrap_or_default();
        match why {
            Distinct::Named(_) => format!("an element is named{place}"),
            Distinct::Told(_) => format!("an operation tells elements apart or shows their order{place}"),
            Distinct::Bounded(function) => {
                format!("{} is tried with only some of them", self.program.function(function).name)
            }
            Distinct::Extended(_) => format!("elements are created one after another{place}"),
            Distinct::Ordered(_) => format!("which fault is met first may depend on their order{place}"),
            Distinct::Subsets => "they belong to different subsets".to_string(),
            Distinct::Packed => "there are too many, or they stand where they cannot be permuted".to_string(),
        }
    }
}

/// The place that shows why elements are not interchangeable.
pub fn place_of(why: Distinct) -> Option<Span> {
    match why {
        Distinct::Named(span) | Distinct::Told(span) | Distinct::Extended(span) | Distinct::Ordered(span) => Some(span),
        Distinct::Bounded(_) | Distinct::Subsets | Distinct::Packed => None,
    }
}
