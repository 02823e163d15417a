//! Turns names of the chart into C++ names: types in PascalCase, functions in snake_case.

use chart::Content;
use chart::system::{Channel, System};

use crate::names::{is_reserved, snake};

/// The types of the generated program itself, which no component, channel or domain may take.
const OWN_TYPES: &[&str] =
    &["Base", "C", "Cycle", "Hooks", "In", "Observer", "Out", "Phases", "Seen", "Side", "System"];

/// `camera_to_vs` as `CameraToVs`, `visionSystem` as `VisionSystem`, and `system` as `System_`.
pub(super) fn pascal(name: &str) -> String {
    let parts = name.split('_').filter(|part| !part.is_empty());
    let joined: String = parts.map(|part| part[..1].to_uppercase() + &part[1..]).collect();
    type_name(&joined)
}

/// The name of a domain as that of a type.
pub(super) fn type_name(name: &str) -> String {
    if OWN_TYPES.contains(&name) { format!("{name}_") } else { member(name) }
}

/// The type of a drawn channel's data: its name, or `PositionDatum` where a domain of the data or a component makes the type `Position`.
pub(super) fn datum(system: &System, channel: &str) -> String {
    let made = pascal(channel);
    let mut enums = system.computing.contents.values().flat_map(Content::enums);
    let is_taken = enums.any(|(name, _)| type_name(name) == made)
        || system.components.iter().any(|component| pascal(&component.name) == made);
    if is_taken { format!("{made}Datum") } else { made }
}

/// The readers of a channel that is drawn as one, in words.
pub(super) fn readers(system: &System, channels: &[Channel]) -> String {
    channels.iter().map(|channel| system.components[channel.to].name.as_str()).collect::<Vec<_>>().join(", ")
}

/// A name as that of a member; a `_` is appended if the name has a meaning in C++.
pub(super) fn member(name: &str) -> String {
    if is_reserved(name) { format!("{name}_") } else { name.to_string() }
}

/// The name of a hook: a member that must not clash with those of every hook class.
pub(super) fn hook(name: &str) -> String {
    let name = snake(name);
    if ["start", "safe_stop", "before_sensors"].contains(&name.as_str()) { format!("{name}_") } else { member(&name) }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_change_their_shape() {
        let check = |name: &str, type_name: &str, function: &str| {
            assert_eq!((pascal(name).as_str(), snake(name).as_str()), (type_name, function));
        };
        check("camera_to_vs", "CameraToVs", "camera_to_vs");
        check("setPoint", "SetPoint", "set_point");
        check("visionSystem", "VisionSystem", "vision_system");
        check("grab", "Grab", "grab");
        // A type of the program itself.
        check("c", "C_", "c");
        check("phases", "Phases_", "phases");
        assert_eq!((type_name("Side").as_str(), type_name("Mode").as_str()), ("Side_", "Mode"));
        // A macro of the headers that the program includes.
        check("EIO", "EIO_", "eio");
        assert_eq!((hook("beforeSensors").as_str(), hook("safeStop").as_str()), ("before_sensors_", "safe_stop_"));
        assert_eq!((member("operator").as_str(), member("camera").as_str()), ("operator_", "camera"));
    }
}
