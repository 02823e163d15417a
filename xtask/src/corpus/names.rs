//! Elements made by `extend`, matched up to their numbers.
//!
//! In: the same state as listed by the peer and by us. Out: which of our elements is which of theirs. The peer makes
//! elements in the order of its hash tables, so equal states may number them otherwise. Elements are told apart by
//! colour refinement: an element's colour is what is said of it, with the colours of the others in it. INVARIANT: the
//! result is a bijection; whether the states agree under it is for the caller to see.

use std::collections::{BTreeMap, BTreeSet};
use std::hash::{DefaultHasher, Hash, Hasher};

use super::text::parts;

/// Location and value, as text.
type Fact = (String, String);

/// Which of our elements is which of theirs, keeping those that are known; none if the numbers of the others differ.
pub fn matching(ours: &[Fact], theirs: &[Fact], known: &BTreeMap<String, String>) -> Option<BTreeMap<String, String>> {
    // A known element is written without its mark: it is a name like any other.
    let plain = |name: &str| name.replace('!', "#");
    let mine = |name: &str| known.get(name).map_or_else(|| name.to_string(), |their| plain(their));
    let settled: BTreeSet<&String> = known.values().collect();
    let their = |name: &str| if settled.contains(&name.to_string()) { plain(name) } else { name.to_string() };
    let (mut ours, mut theirs) = (coloured(&renamed(ours, &mine)), coloured(&renamed(theirs, &their)));
    if ours.len() != theirs.len() {
        return None;
    }
    // Equal colours first; where the states are not the same, the rest by number.
    let mut found = known.clone();
    ours.retain(|((colour, _), mine)| {
        let same = theirs.iter().position(|((other, _), _)| other == colour);
        same.is_none_or(|at| {
            found.insert(mine.clone(), theirs.remove(at).1);
            false
        })
    });
    ours.sort_by_key(|((_, number), _)| *number);
    theirs.sort_by_key(|((_, number), _)| *number);
    found.extend(ours.into_iter().zip(theirs).map(|((_, mine), (_, their))| (mine, their)));
    Some(found)
}

fn renamed(facts: &[Fact], name: &dyn Fn(&str) -> String) -> Vec<Fact> {
    let open =
        facts.iter().filter(|(location, value)| (location.contains('!') || value.contains('!')) && value != "undef");
    open.map(|(location, value)| (painted(location, name), painted(value, name))).collect()
}

/// The elements that occur, ordered by colour and then by number.
fn coloured(facts: &[Fact]) -> Vec<((u64, u64), String)> {
    let facts: Vec<(&Fact, Vec<String>)> = facts
        .iter()
        .map(|fact| (fact, elements(&fact.0).into_iter().chain(elements(&fact.1)).collect()))
        .filter(|(_, elements): &(_, Vec<String>)| !elements.is_empty())
        .collect();
    let all: BTreeSet<&String> = facts.iter().flat_map(|(_, elements)| elements).collect();
    let mut colours: BTreeMap<String, u64> = all.iter().map(|name| ((*name).clone(), 0)).collect();
    for _ in 0..all.len().min(12) {
        let mut said: BTreeMap<&String, Vec<u64>> = BTreeMap::new();
        for ((location, value), elements) in &facts {
            for element in elements {
                let colour = |name: &str| if name == element { "*".to_string() } else { format!("#{}", colours[name]) };
                let painted = format!("{}={}", painted(location, &colour), painted(value, &colour));
                said.entry(element).or_default().push(hash(&painted));
            }
        }
        let next = said.into_iter().map(|(element, mut said)| {
            said.sort_unstable();
            (element.clone(), hash(&(colours[element], said)))
        });
        colours = next.collect();
    }
    let number = |name: &str| name.rsplit_once('!').and_then(|(_, digits)| digits.parse().ok()).unwrap_or(0);
    let mut ordered: Vec<_> = colours.into_iter().map(|(name, colour)| ((colour, number(&name)), name)).collect();
    ordered.sort();
    ordered
}

fn hash(value: &impl Hash) -> u64 {
    // The hasher without keys: the same in every run.
    let mut hasher = DefaultHasher::new();
    value.hash(&mut hasher);
    hasher.finish()
}

/// The text with its elements named otherwise, sets sorted again.
pub fn painted(text: &str, name: &dyn Fn(&str) -> String) -> String {
    if !text.contains('!') {
        return text.to_string();
    }
    let Some(open) = text.find(['(', '[', '{']) else {
        return if is_element(text) { name(text) } else { text.to_string() };
    };
    let close = match text.as_bytes()[open] {
        b'(' => ')',
        b'[' => ']',
        _ => '}',
    };
    let (head, rest) = text.split_at(open);
    let Some(inner) = rest[1..].strip_suffix(close) else { return text.to_string() };
    let mut inside: Vec<String> = parts(inner)
        .into_iter()
        .map(|part| match part.split_once("->") {
            Some((key, value)) => format!("{}->{}", painted(key, name), painted(value, name)),
            None => painted(part, name),
        })
        .collect();
    if close == '}' {
        inside.sort();
    }
    format!("{head}{}{}{close}", &rest[..1], inside.join(","))
}

/// The elements that a text names.
fn elements(text: &str) -> Vec<String> {
    let mut found = Vec::new();
    for word in text.split(|c: char| !(c.is_alphanumeric() || c == '_' || c == '!')) {
        if is_element(word) {
            found.push(word.to_string());
        }
    }
    found
}

fn is_element(word: &str) -> bool {
    let number = word.split_once('!').filter(|(domain, _)| !domain.is_empty()).map(|(_, number)| number);
    number.is_some_and(|number| !number.is_empty() && number.bytes().all(|b| b.is_ascii_digit()))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn facts(lines: &[&str]) -> Vec<Fact> {
        let split = |line: &&str| line.split_once('=').map(|(a, b)| (a.to_string(), b.to_string())).unwrap();
        lines.iter().map(split).collect()
    }

    #[test]
    fn elements_are_matched_by_what_is_said_of_them() {
        let ours = facts(&["N={n!1,n!2}", "owner(n!1)=a", "owner(n!2)=b", "next(n!1)=n!2"]);
        let theirs = facts(&["N={n!1,n!2}", "owner(n!2)=a", "owner(n!1)=b", "next(n!2)=n!1"]);
        let names = matching(&ours, &theirs, &BTreeMap::new()).unwrap();
        assert_eq!(names["n!1"], "n!2");
        assert_eq!(names["n!2"], "n!1");
        let rename = |name: &str| names[name].clone();
        assert_eq!(painted("f(n!1,{n!2,n!1})", &rename), "f(n!2,{n!1,n!2})");
    }

    #[test]
    fn alike_elements_are_matched_in_order() {
        let ours = facts(&["N={n!1,n!2}"]);
        let none = BTreeMap::new();
        assert_eq!(matching(&ours, &ours, &none).unwrap()["n!2"], "n!2");
        assert_eq!(matching(&ours, &facts(&["N={n!1}"]), &none), None);
    }

    #[test]
    fn known_elements_stay_what_they_are() {
        let ours = facts(&["N={n!1,n!2}", "f(n!1)=a", "f(n!2)=a"]);
        let known = BTreeMap::from([("n!1".to_string(), "n!2".to_string())]);
        let names = matching(&ours, &ours, &known).unwrap();
        assert_eq!((names["n!1"].as_str(), names["n!2"].as_str()), ("n!2", "n!1"));
    }
}
