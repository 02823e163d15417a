//! "Did you mean": the nearest of the valid names.
//!
//! In: a name that means nothing and the names in scope. Out: one of them, if it is so near that it was probably
//! meant: it differs only in capitals, or by few edits for its length, or is the only one with more before or after it.

/// The candidate that was likely meant.
pub fn nearest<'a>(name: &str, candidates: impl IntoIterator<Item = &'a str>) -> Option<&'a str> {
    let allowed = match name.chars().count() {
        0..=2 => 1,
        3..=5 => 1,
        6..=9 => 2,
        _ => 3,
    };
    let (mut near, mut longer): (Option<(usize, &str)>, Vec<&str>) = (None, Vec::new());
    for candidate in candidates.into_iter().filter(|candidate| *candidate != name) {
        match distance(name, candidate, allowed) {
            Some(distance) => near = Some(near.map_or((distance, candidate), |best| (distance, candidate).min(best))),
            None if is_longer(name, candidate) => longer.push(candidate),
            None => {}
        }
    }
    match (near, &longer[..]) {
        (Some((_, candidate)), _) => Some(candidate),
        (None, [only]) => Some(only),
        (None, _) => None,
    }
}

/// Whether a name is another one with something before or after it: `HALTED` is, and `PLANNER_HALT` is, for `HALT`.
fn is_longer(name: &str, candidate: &str) -> bool {
    let ends = candidate.strip_suffix(name).is_some_and(|before| before.ends_with('_'));
    name.len() >= 3 && (candidate.starts_with(name) || ends)
}

/// What the domain of this name in other languages is called here.
pub(crate) fn foreign_domain(name: &str) -> Option<&'static str> {
    Some(match name {
        "Bool" | "Logical" => "Boolean",
        "Int" | "Long" | "Short" | "Byte" | "Number" => "Integer",
        "Nat" | "Unsigned" => "Natural",
        "Float" | "Double" | "Decimal" => "Real",
        "Str" | "Text" => "String",
        "Character" => "Char",
        "Set" => "Powerset",
        "List" | "Sequence" | "Array" | "Vector" => "Seq",
        _ => return None,
    })
}

fn distance(name: &str, candidate: &str, allowed: usize) -> Option<usize> {
    if name.eq_ignore_ascii_case(candidate) {
        return Some(0);
    }
    if name.len().abs_diff(candidate.len()) > allowed * 4 {
        return None;
    }
    let distance = strsim::osa_distance(name, candidate);
    (distance <= allowed && distance < name.chars().count()).then_some(distance)
}

/// `; did you mean …?` as a help, or another help where nothing is near.
pub(crate) fn did_you_mean<'a>(
    name: &str,
    candidates: impl IntoIterator<Item = &'a str>,
    otherwise: impl FnOnce() -> String,
) -> String {
    match nearest(name, candidates) {
        Some(candidate) => format!("did you mean `{candidate}`?"),
        None => otherwise(),
    }
}

#[cfg(test)]
mod tests {
    use super::nearest;

    #[test]
    fn near_names_are_suggested_and_far_ones_are_not() {
        assert_eq!(nearest("tempreature", ["pressure", "temperature"]), Some("temperature"));
        assert_eq!(nearest("integer", ["Integer", "interior"]), Some("Integer"));
        assert_eq!(nearest("flag", ["count"]), None);
        assert_eq!(nearest("x", ["y"]), None);
        assert_eq!(nearest("HALT", ["GOING", "HALTED"]), Some("HALTED"));
        assert_eq!(nearest("HALTED", ["GOING", "PLANNER_HALTED"]), Some("PLANNER_HALTED"));
        assert_eq!(nearest("HALTED", ["ARM_HALTED", "PLANNER_HALTED"]), None, "which of both was meant?");
    }
}
