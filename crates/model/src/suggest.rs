//! "Did you mean": the nearest of the valid names.
//!
//! In: a name that means nothing and the names in scope. Out: one of them, if it is so near that it was probably
//! meant: it differs only in capitals, or by few edits for its length.

/// The candidate that was likely meant.
pub fn nearest<'a>(name: &str, candidates: impl IntoIterator<Item = &'a str>) -> Option<&'a str> {
    let allowed = match name.chars().count() {
        0..=2 => 1,
        3..=5 => 1,
        6..=9 => 2,
        _ => 3,
    };
    candidates
        .into_iter()
        .filter(|candidate| *candidate != name)
        .filter_map(|candidate| Some((distance(name, candidate, allowed)?, candidate)))
        .min_by(|a, b| a.cmp(b))
        .map(|(_, candidate)| candidate)
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
    }
}
