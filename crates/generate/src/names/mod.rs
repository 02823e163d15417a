//! Turns names of models and charts into C++ identifiers.
//!
//! In: names as written there. Out: identifiers, distinct within their scope, that are neither keywords of C++, nor
//! macros of its headers, nor reserved.

mod library;
mod macros;

use std::collections::BTreeSet;

/// The keywords and other words of C++20 that no name may be.
const RESERVED: &[&str] = &[
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
    "co_await",
    "co_return",
    "co_yield",
    "compl",
    "concept",
    "const",
    "consteval",
    "constexpr",
    "constinit",
    "const_cast",
    "continue",
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
    "main",
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
    "std",
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
    // Namespaces of the runtime
    "gs",
    "groundstate",
];

/// The identifiers of one scope.
#[derive(Debug, Clone, Default)]
pub struct Scope {
    taken: BTreeSet<String>,
}

impl Scope {
    /// A new identifier for a name, which is taken from now on.
    pub fn take(&mut self, name: &str) -> String {
        let plain = identifier(name);
        let mut candidate = plain.clone();
        let mut number = 1;
        while !self.taken.insert(candidate.clone()) {
            number += 1;
            candidate = format!("{plain}_{number}");
        }
        candidate
    }

    /// Releases an identifier at the end of its block.
    pub fn release(&mut self, name: &str) {
        self.taken.remove(name);
    }

    /// Reserves an identifier for the generated code.
    pub fn keep(&mut self, name: &str) {
        self.taken.insert(name.to_string());
    }
}

/// Whether a name is a keyword of C++, a macro of its library, or used by generated code.
pub fn is_reserved(name: &str) -> bool {
    RESERVED.contains(&name) || macros::has(name)
}

/// A name as an identifier: other characters become `_`, and reserved words get a `_` appended.
pub fn identifier(name: &str) -> String {
    let mut out = String::new();
    for letter in name.trim_start_matches('$').chars() {
        let fitting = letter.is_ascii_alphanumeric() || letter == '_';
        // C++ reserves names with two underscores in a row.
        let letter = if fitting { letter } else { '_' };
        if letter != '_' || !out.ends_with('_') {
            out.push(letter);
        }
    }
    if out.is_empty() || out.starts_with(|first: char| first.is_ascii_digit() || first == '_') {
        out.insert_str(0, if out.starts_with('_') { "x" } else { "x_" });
    }
    // A trailing underscore marks members that hold state.
    let out = out.trim_end_matches('_').to_string();
    if is_reserved(&out) { format!("{out}_1") } else { out }
}

/// A name as a top-level namespace that does not clash with the C library.
pub fn namespace(name: &str) -> String {
    let out = identifier(&snake(name));
    if library::has(&out) { format!("{out}_1") } else { out }
}

/// A name in `snake_case`, which may be reserved.
pub fn snake(name: &str) -> String {
    let mut out = String::new();
    let letters: Vec<char> = name.chars().collect();
    for (place, letter) in letters.iter().enumerate() {
        if letter.is_ascii_uppercase() {
            let after_lower = place > 0 && !letters[place - 1].is_ascii_uppercase() && letters[place - 1] != '_';
            let before_lower = place > 0 && letters.get(place + 1).is_some_and(char::is_ascii_lowercase);
            if (after_lower || before_lower) && !out.ends_with('_') {
                out.push('_');
            }
            out.push(letter.to_ascii_lowercase());
        } else {
            out.push(*letter);
        }
    }
    out
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_are_identifiers_of_cpp() {
        assert_eq!(identifier("r_Main"), "r_Main");
        assert_eq!(identifier("$x"), "x");
        assert_eq!(identifier("class"), "class_1");
        assert_eq!(identifier("a__b"), "a_b");
        assert_eq!(identifier("_x"), "x_x");
        assert_eq!(identifier("SIGINT"), "SIGINT_1");
        assert_eq!(identifier("EBUSY"), "EBUSY_1");
        assert_eq!(identifier("major"), "major_1");
        assert_eq!(identifier("SIGNAL_LOST"), "SIGNAL_LOST_1");
        assert_eq!(identifier("EMPTY"), "EMPTY");
    }

    #[test]
    fn namespaces_are_beside_the_c_library() {
        assert_eq!(namespace("Abs"), "abs_1");
        assert_eq!(namespace("class"), "class_1");
        assert_eq!(namespace("CoffeeMachine"), "coffee_machine");
    }

    #[test]
    fn snake_case() {
        assert_eq!(snake("CoffeeVendingMachine"), "coffee_vending_machine");
        assert_eq!(snake("CarSystem002main"), "car_system002main");
        assert_eq!(snake("ABCTest"), "abc_test");
        assert_eq!(snake("IntAdd"), "int_add");
        assert_eq!(snake("setPoint"), "set_point");
        assert_eq!(snake("camera_to_vs"), "camera_to_vs");
    }

    #[test]
    fn a_scope_has_each_name_once() {
        let mut scope = Scope::default();
        assert_eq!([scope.take("x"), scope.take("x"), scope.take("$x")], ["x", "x_2", "x_3"]);
    }
}
