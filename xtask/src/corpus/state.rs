//! A state of ours, listed as the peer lists its own.
//!
//! In: a machine. Out: a [`Listed`]: every location that has a value, as text, and the contents of the domains asked
//! for. The peer lists under a domain's name only the elements introduced for that very domain, not those of its
//! subsets, so the same is done here.

use std::collections::BTreeMap;

use machine::{Location, Machine, Value};
use program::{DomainId, DomainKind, Program};

use super::names;
use super::text;
use super::trace::Listing;

/// A state as text.
#[derive(Debug, Default)]
pub struct Listed {
    /// Values by location. Two modules may each have a function of the same name, so there can be several.
    values: BTreeMap<String, Vec<(Location, String)>>,
    /// Contents of domains by name.
    domains: BTreeMap<String, String>,
    /// Our elements by their names in the record, where they differ.
    renaming: BTreeMap<String, String>,
}

impl Listed {
    /// The state of a machine, with the domains that a recorded listing has.
    pub fn of(machine: &mut Machine, listing: &Listing) -> Listed {
        let program = machine.program().clone();
        let mut listed = Listed::default();
        for (location, value) in machine.locations() {
            let key = text::location(&program, &location);
            listed.values.entry(key).or_default().push((location, text::show(&program, &value)));
        }
        for (name, _) in listing.iter().filter(|(name, _)| name.starts_with(char::is_uppercase)) {
            if let Some(contents) = contents(machine, &program, name) {
                listed.domains.insert(name.clone(), contents);
            }
        }
        listed
    }

    /// The renaming of our elements that can make the two agree, keeping what is known of it.
    pub fn matching(&self, listing: &Listing, known: &BTreeMap<String, String>) -> Option<BTreeMap<String, String>> {
        let values =
            self.values.iter().flat_map(|(key, all)| all.iter().map(|(_, value)| (key.clone(), value.clone())));
        let domains = self.domains.iter().map(|(name, contents)| (name.clone(), contents.clone()));
        let ours: Vec<(String, String)> = values.chain(domains).collect();
        names::matching(&ours, listing, known)
    }

    /// The same state with our elements under other names.
    pub fn renamed(&self, renaming: &BTreeMap<String, String>) -> Listed {
        let name = |element: &str| renaming.get(element).cloned().unwrap_or_else(|| element.to_string());
        let mut renamed = Listed { renaming: renaming.clone(), ..Listed::default() };
        for (key, all) in &self.values {
            let all = all.iter().map(|(location, value)| (location.clone(), names::painted(value, &name)));
            renamed.values.entry(names::painted(key, &name)).or_default().extend(all);
        }
        for (domain, contents) in &self.domains {
            renamed.domains.insert(domain.clone(), names::painted(contents, &name));
        }
        renamed
    }

    /// A location's name in the record.
    pub fn key(&self, program: &Program, location: &Location) -> String {
        let name = |element: &str| self.renaming.get(element).cloned().unwrap_or_else(|| element.to_string());
        names::painted(&text::location(program, location), &name)
    }

    /// Our value of a location of the record: theirs if any of the functions of that name has it.
    pub fn value(&self, location: &str, theirs: &str) -> &str {
        match (self.values.get(location), self.domains.get(location)) {
            (Some(all), _) => {
                all.iter().map(|(_, value)| value.as_str()).find(|value| *value == theirs).unwrap_or(&all[0].1)
            }
            (None, Some(contents)) => contents,
            (None, None) => "undef",
        }
    }

    /// The location of that name, if it has a value.
    pub fn location(&self, name: &str) -> Option<&Location> {
        self.values.get(name).map(|all| &all[0].0)
    }
}

/// The elements introduced for a domain itself.
fn contents(machine: &mut Machine, program: &Program, name: &str) -> Option<String> {
    let domain = DomainId(program.domains.iter().position(|domain| domain.name == name)? as u32);
    let mut elements = machine.elements(domain).ok()?;
    for (index, subset) in program.domains.iter().enumerate() {
        let DomainKind::Concrete { base, elements: declared, dynamic, .. } = &subset.kind else { continue };
        if *base != domain {
            continue;
        }
        let named = match &program.domain(domain).kind {
            DomainKind::Abstract { elements, .. } => elements.len() as u32,
            _ => 0,
        };
        elements.retain(|element| !matches!(element, Value::Element(_, number) if declared.contains(number)));
        if *dynamic {
            let made = machine.elements(DomainId(index as u32)).unwrap_or_default();
            elements
                .retain(|element| !(made.contains(element) && matches!(element, Value::Element(_, n) if *n >= named)));
        }
    }
    Some(text::show(program, &Value::set(elements)))
}
