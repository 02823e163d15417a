//! Properties of every system of this project, set in the picture: what is set to what it is changes no byte, what is set and set back
//! gives the bytes back, and nothing but the line of the property changes.

use std::collections::BTreeMap;

use ide::{Edit, Operation, Property, drawn, edited};
use syntax::ast::{AstNode, ChartFile, PhaseKind, Quantity, SystemChart};
use syntax::{FileId, SyntaxKind, SyntaxToken, parse_chart};

fn after(text: &str, system: &str, operation: &Operation) -> Result<String, String> {
    let drawn = drawn(text, system, operation, &BTreeMap::new())?;
    let edits: Vec<Edit> = drawn.edit.into_iter().collect();
    Ok(edited(text, &edits))
}

fn word(token: Option<SyntaxToken>) -> Option<String> {
    token.map(|token| token.text().to_string())
}

fn length(quantity: Option<Quantity>) -> Option<String> {
    quantity.map(|quantity| quantity.syntax().text().to_string().trim().to_string())
}

/// Each property with what it is, and something else that it may be.
fn properties(system: &SystemChart) -> Vec<(String, Property, Option<String>, &'static str)> {
    let mut out = Vec::new();
    let own = word(system.name()).unwrap_or_default();
    out.push((own.clone(), Property::Tick, length(system.ticks().next().and_then(|tick| tick.quantity())), "7 us"));
    out.push((own.clone(), Property::Processors, word(system.processors().next().and_then(|some| some.number())), "9"));
    for (bound, at) in system.age_bounds().zip(0..) {
        out.push((own.clone(), Property::Age(at), length(bound.quantity()), "777 ms"));
    }
    for component in system.components() {
        let (name, Some(kind)) = (word(component.name()).unwrap_or_default(), component.kind()) else { continue };
        if kind.is_synchronous() {
            let words = [
                (Property::Period, SyntaxKind::PERIOD_KW),
                (Property::Offset, SyntaxKind::OFFSET_KW),
                (Property::Deadline, SyntaxKind::DEADLINE_KW),
            ];
            out.extend(words.map(|(property, word)| (name.clone(), property, length(kind.quantity(word)), "777 ms")));
            let missed = kind.tolerance().map(|one| one.syntax().text().to_string().trim()[7..].to_string());
            out.push((name.clone(), Property::Misses, missed, "7 of 77"));
        } else {
            let awaited = kind.awaits().map(|one| one.syntax().text().to_string().trim()[7..].to_string());
            out.push((name.clone(), Property::Awaits, awaited, "any other, another"));
        }
        for (phase, at) in component.phases().zip(0..) {
            out.push((name.clone(), Property::PhaseTime(at), length(phase.time()), "777 ms"));
            if phase.kind() == Some(PhaseKind::Elaborate) {
                out.push((name.clone(), Property::PhaseMachine(at), word(phase.machine()), "Other"));
            } else {
                out.push((name.clone(), Property::PhaseName(at), word(phase.name()), "other"));
            }
            if phase.kind() == Some(PhaseKind::Read) {
                let fresh = length(phase.fresh().and_then(|bound| bound.quantity()));
                out.push((name.clone(), Property::PhaseFresh(at), fresh, "777 ms"));
            }
        }
    }
    for channel in system.channels() {
        let (name, Some(kind)) = (word(channel.name()).unwrap_or_default(), channel.kind()) else { continue };
        out.extend(kind.size().map(|size| (name.clone(), Property::Size, word(Some(size)), "5")));
        if kind.is_buffer() {
            out.push((name.clone(), Property::Master, word(kind.master()), "other"));
        }
        let domain = channel.message().map(|message| message.syntax().text().to_string().trim().to_string());
        out.push((name, Property::Domain, domain, "Prod(Integer, Boolean)"));
    }
    for device in system.devices() {
        let domain = device.message().map(|message| message.syntax().text().to_string().trim().to_string());
        out.push((word(device.name()).unwrap_or_default(), Property::Domain, domain, "Seq(Integer)"));
    }
    out
}

#[test]
fn what_is_set_and_set_back_gives_the_bytes_back() {
    let mut set = 0;
    let folders = ["examples", "library", "cpp/systems", "shells/cli/tests", "shells/cli/templates"];
    for path in folders.iter().flat_map(|folder| testkit::repository::files(folder, &["chart"])) {
        let Ok(text) = std::fs::read_to_string(&path) else { continue };
        let parse = parse_chart(FileId(0), &text);
        let systems =
            ChartFile::cast(parse.syntax()).map(|file| file.systems().collect::<Vec<_>>()).unwrap_or_default();
        for system in systems {
            let name = word(system.name()).unwrap_or_default();
            for (id, property, value, other) in properties(&system) {
                let told = format!("{}: {property:?} of {id}", path.display());
                let to = |value: Option<String>| Operation::Set(id.clone(), property, value);
                if let Some(value) = &value {
                    assert_eq!(after(&text, &name, &to(Some(value.clone()))).as_deref(), Ok(&*text), "{told}");
                }
                let changed = after(&text, &name, &to(Some(other.to_string())))
                    .unwrap_or_else(|reason| panic!("{told}: {reason}"));
                let differ =
                    |one: &str, two: &str| one.lines().filter(|line| !two.lines().any(|other| other == *line)).count();
                assert!(changed.contains(other) && differ(&text, &changed) <= 1, "{told}:\n{changed}");
                let again = after(&changed, &name, &to(value)).unwrap_or_else(|reason| panic!("{told}: {reason}"));
                assert_eq!(again, text, "{told}");
                set += 1;
            }
        }
    }
    assert!(set > 300, "{set}");
}
