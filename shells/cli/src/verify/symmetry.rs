//! Reports interchangeable elements: which there are, and why others are not.

use std::io::Write;

use groundstate::verify::{Distinct, Symmetry};
use machine::{Show, Value};
use program::DomainKind;
use wire::{DomainLine, Place};

use crate::failure::Failure;
use crate::shell::Shell;
use crate::verify::tell::Teller;

impl Teller<'_> {
    /// The report as JSON.
    pub fn symmetry_lines(&self, symmetry: &Symmetry) -> Vec<DomainLine> {
        let name = |domain: &program::DomainId| self.program.domain(*domain).name.clone();
        let classes = symmetry.classes.iter().map(|(domain, class)| DomainLine {
            domain: name(domain),
            interchangeable: self.elements(class),
            distinct: None,
            at: None,
        });
        let distinct = symmetry.distinct.iter().map(|(domain, why)| DomainLine {
            domain: name(domain),
            interchangeable: Vec::new(),
            distinct: Some(self.why_distinct(*why)),
            at: place_of(*why).map(|span| Place::new(self.sources, span)),
        });
        classes.chain(distinct).collect()
    }

    /// The report as text.
    pub fn symmetry(&self, shell: &mut Shell, symmetry: &Symmetry) -> Result<(), Failure> {
        for (domain, class) in &symmetry.classes {
            let domain = &self.program.domain(*domain).name;
            writeln!(shell.out(), "interchangeable in {domain}: {}", self.elements(class).join(", "))?;
        }
        for (domain, why) in &symmetry.distinct {
            let declared = self.program.domain(*domain);
            // Literals of an enum are always named, so this reason is left out for them.
            if !matches!((&declared.kind, why), (DomainKind::Enum { .. }, Distinct::Named(_))) {
                writeln!(shell.out(), "not interchangeable in {}: {}", declared.name, self.why_distinct(*why))?;
            }
        }
        Ok(())
    }

    fn elements(&self, class: &[Value]) -> Vec<String> {
        class.iter().map(|element| element.show(self.program).to_string()).collect()
    }

    fn why_distinct(&self, why: Distinct) -> String {
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

fn place_of(why: Distinct) -> Option<syntax::Span> {
    match why {
        Distinct::Named(span) | Distinct::Told(span) | Distinct::Extended(span) | Distinct::Ordered(span) => Some(span),
        Distinct::Bounded(_) | Distinct::Subsets | Distinct::Packed => None,
    }
}
