//! The domains that channels, sensors and actuators carry, and whether a value of one domain is one of another.
//!
//! In: the chart's imports. Out: [`Types`]: for each name of a channel or device the identity of its domain. Domains of two models are the
//! same if they have the same form, and their names come from the same files.

use std::collections::BTreeMap;

use model::{Basic, Checked, DomainId, DomainKind, Domains, Loader};
use syntax::{Diagnostic, Severity, SourceFile};

use crate::chart::Chart;
use crate::computing::Content;
use crate::fault::component as fault;
use crate::system::{Named, System};

/// The name of the text in which the domains are declared: long enough that no module of a user has it.
const NAME: &str = "CarriedByChannelsAndDevices";

/// The domain of each channel and device that says one, by name.
pub(super) type Types = BTreeMap<String, Carried>;

/// A domain in the chart.
#[derive(Debug, Clone)]
pub(super) struct Carried {
    /// As it is written.
    pub(super) named: Named,
    /// Its form.
    pub(super) content: Content,
    /// It, and what it is a subset of.
    identity: Identity,
}

/// A domain, whichever model it belongs to.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(super) struct Identity {
    own: String,
    /// The domain of which it is a subset; the same otherwise.
    base: String,
}

impl Identity {
    /// The identity of a domain of a model.
    pub(super) fn of(checked: &Checked, domain: DomainId) -> Identity {
        let domains = &checked.model.domains;
        Identity { own: identity(checked, domain), base: identity(checked, domains.type_domain(domain)) }
    }

    /// Whether each value of this domain is one of the other.
    fn is_within(&self, other: &Identity) -> bool {
        self.own == other.own || self.base == other.own || (self.own == "Natural" && other.own == "Integer")
    }
}

impl Carried {
    /// Whether what is carried fits a function that reads it.
    pub(super) fn feeds(&self, function: &Identity) -> bool {
        self.identity.is_within(function)
    }

    /// Whether what a function has can be carried.
    pub(super) fn takes(&self, function: &Identity) -> bool {
        function.is_within(&self.identity)
    }
}

fn identity(checked: &Checked, domain: DomainId) -> String {
    let list = |ids: &[DomainId]| ids.iter().map(|id| identity(checked, *id)).collect::<Vec<_>>().join(",");
    let entry = checked.model.domains.get(domain);
    match &entry.kind {
        DomainKind::Prod(parts) => format!("Prod({})", list(parts)),
        DomainKind::Seq(of) => format!("Seq({})", identity(checked, *of)),
        DomainKind::Powerset(of) => format!("Powerset({})", identity(checked, *of)),
        DomainKind::Bag(of) => format!("Bag({})", identity(checked, *of)),
        DomainKind::Map(key, value) => format!("Map({},{})", identity(checked, *key), identity(checked, *value)),
        DomainKind::Rule(parts) => format!("Rule({})", list(parts)),
        DomainKind::Basic(_)
        | DomainKind::Any
        | DomainKind::Enum { .. }
        | DomainKind::Abstract { .. }
        | DomainKind::Concrete { .. }
        | DomainKind::Error => {
            let name = entry.name.clone().unwrap_or_default();
            match entry.span {
                Some(span) => format!("{name} of {}", checked.sources.file(span.file).name),
                None => name,
            }
        }
    }
}

/// The form of a domain's values.
fn content(checked: &Checked, domain: DomainId) -> Content {
    let domains = &checked.model.domains;
    let entry = domains.get(domains.type_domain(domain));
    match &entry.kind {
        DomainKind::Basic(Basic::Boolean) => Content::Boolean,
        DomainKind::Basic(Basic::Integer | Basic::Natural) => Content::Integer,
        DomainKind::Basic(Basic::Real) => Content::Real,
        DomainKind::Enum { literals } => {
            Content::Enum { name: entry.name.clone().unwrap_or_default(), literals: literals.clone() }
        }
        DomainKind::Prod(parts) => {
            let parts: Vec<Content> = parts.iter().map(|part| content(checked, *part)).collect();
            let fits = (2..=5).contains(&parts.len()) && !parts.iter().any(|part| matches!(part, Content::Other(_)));
            if fits { Content::Tuple(parts) } else { Content::Other(domains.display(domain)) }
        }
        DomainKind::Basic(Basic::Complex | Basic::Char | Basic::String | Basic::Undef)
        | DomainKind::Any
        | DomainKind::Abstract { .. }
        | DomainKind::Concrete { .. }
        | DomainKind::Seq(_)
        | DomainKind::Powerset(_)
        | DomainKind::Bag(_)
        | DomainKind::Map(..)
        | DomainKind::Rule(_)
        | DomainKind::Error => Content::Other(domains.display(domain)),
    }
}

/// The domains of the channels and devices of a system, and the faults of those that nothing declares.
pub(super) fn types(
    root: &SourceFile,
    chart: &Chart,
    system: &System,
    loader: &mut dyn Loader,
) -> (Types, Vec<Diagnostic>) {
    let drawn = system.drawn_channels().map(|channels| &channels[0]);
    let channels = drawn.filter_map(|channel| Some((&channel.drawn, channel.message.as_ref()?)));
    let devices = system.devices.iter().filter_map(|device| Some((&device.name, device.message.as_ref()?)));
    let named: Vec<(&String, &Named)> = channels.chain(devices).collect();
    // Declared one a line, behind the imports, so that a fault's line says whose it is.
    let mut text = format!("module {NAME}\n");
    for import in &chart.imports {
        text.push_str(&format!("import \"{import}\"\n"));
    }
    text.push_str("signature:\n");
    let first = text.matches('\n').count();
    for (index, (_, named)) in named.iter().enumerate() {
        text.push_str(&format!("controlled message{index}: {}\n", named.text));
    }
    text.push_str("definitions:\n");
    let folder = root.name.rfind(['/', '\\']).map_or("", |end| &root.name[..=end]);
    let checked = model::check(SourceFile::new(format!("{folder}{NAME}.asm"), text), loader);
    let mut faults = Vec::new();
    for found in checked.diagnostics.iter().filter(|found| found.severity == Severity::Error) {
        let span = found.primary.span;
        let line = checked.sources.file(span.file).line_column(span.start).line as usize;
        match named.get(line.wrapping_sub(first + 1)).filter(|_| span.file == checked.model.root) {
            Some((_, named)) => faults.push(fault::unknown_message(named.span, found)),
            None => {
                let place = chart.places.get(line.wrapping_sub(2)).filter(|_| span.file == checked.model.root);
                faults.push(crate::fault::import::no_model(*place.unwrap_or(&system.span), found, None));
            }
        }
    }
    let mut types = Types::new();
    for (index, (name, named)) in named.iter().enumerate() {
        let function = checked.model.functions.iter().find(|function| function.name == format!("message{index}"));
        let domain = function.map_or(Domains::ERROR, |function| function.codomain);
        let identity = Identity::of(&checked, domain);
        let content = content(&checked, domain);
        types.insert((*name).clone(), Carried { named: (*named).clone(), content, identity });
    }
    (types, faults)
}
