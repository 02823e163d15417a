//! Names of the chart as names of C++: types in PascalCase, functions in snake_case.

/// `camera_to_vs` as `CameraToVs`, `visionSystem` as `VisionSystem`.
pub(super) fn pascal(name: &str) -> String {
    let parts = name.split('_').filter(|part| !part.is_empty());
    parts.map(|part| part[..1].to_uppercase() + &part[1..]).collect()
}

/// `setPoint` as `set_point`.
pub(super) fn snake(name: &str) -> String {
    let mut text = String::new();
    let mut before = '_';
    for letter in name.chars() {
        if letter.is_uppercase() && before != '_' && !before.is_uppercase() {
            text.push('_');
        }
        text.extend(letter.to_lowercase());
        before = letter;
    }
    text
}

/// A name as that of a member: with `_` behind it where it means something in C++.
pub(super) fn member(name: &str) -> String {
    if is_reserved(name) { format!("{name}_") } else { name.to_string() }
}

/// The name of a hook: a member, beside those that every hook class has.
pub(super) fn hook(name: &str) -> String {
    let name = snake(name);
    if ["start", "safe_stop"].contains(&name.as_str()) { format!("{name}_") } else { member(&name) }
}

fn is_reserved(name: &str) -> bool {
    const WORDS: &[&str] = &[
        "alignas",
        "alignof",
        "and",
        "and_eq",
        "asm",
        "auto",
        "bitand",
        "bitor",
        "bool",
        "break",
        "case",
        "catch",
        "char",
        "char8_t",
        "char16_t",
        "char32_t",
        "class",
        "compl",
        "concept",
        "const",
        "consteval",
        "constexpr",
        "constinit",
        "const_cast",
        "continue",
        "co_await",
        "co_return",
        "co_yield",
        "decltype",
        "default",
        "delete",
        "do",
        "double",
        "dynamic_cast",
        "else",
        "enum",
        "explicit",
        "export",
        "extern",
        "false",
        "float",
        "for",
        "friend",
        "goto",
        "if",
        "inline",
        "int",
        "long",
        "mutable",
        "namespace",
        "new",
        "noexcept",
        "not",
        "not_eq",
        "nullptr",
        "operator",
        "or",
        "or_eq",
        "private",
        "protected",
        "public",
        "register",
        "reinterpret_cast",
        "requires",
        "return",
        "short",
        "signed",
        "sizeof",
        "static",
        "static_assert",
        "static_cast",
        "struct",
        "switch",
        "template",
        "this",
        "thread_local",
        "throw",
        "true",
        "try",
        "typedef",
        "typeid",
        "typename",
        "union",
        "unsigned",
        "using",
        "virtual",
        "void",
        "volatile",
        "wchar_t",
        "while",
        "xor",
        "xor_eq",
    ];
    WORDS.contains(&name)
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
        assert_eq!((member("operator").as_str(), member("camera").as_str()), ("operator_", "camera"));
    }
}
