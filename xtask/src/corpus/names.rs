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
    // Equal colours first, the finest before those that look less far around; where the states are not the same, the
    // rest by number.
    let mut found = known.clone();
    for round in (0..ROUNDS).rev() {
        let colour = |element: &Coloured| element.colours.get(round).or(element.colours.last()).copied();
        ours.sort_by_key(|element| (colour(element), element.number));
        theirs.sort_by_key(|element| (colour(element), element.number));
        ours.retain(|mine| {
            let same = theirs.iter().position(|their| colour(their) == colour(mine));
            same.is_none_or(|at| {
                found.insert(mine.name.clone(), theirs.remove(at).name);
                false
            })
        });
    }
    ours.sort_by_key(|element| element.number);
    theirs.sort_by_key(|element| element.number);
    found.extend(ours.into_iter().zip(theirs).map(|(mine, their)| (mine.name, their.name)));
    Some(found)
}

fn renamed(facts: &[Fact], name: &dyn Fn(&str) -> String) -> Vec<Fact> {
    let open =
        facts.iter().filter(|(location, value)| (location.contains('!') || value.contains('!')) && value != "undef");
    open.map(|(location, value)| (painted(location, name), painted(value, name))).collect()
}

/// LIMIT: how far around an element is looked.
const ROUNDS: usize = 12;

/// An element that occurs.
struct Coloured {
    name: String,
    number: u64,
    /// Its colour after each round.
    colours: Vec<u64>,
}

fn coloured(facts: &[Fact]) -> Vec<Coloured> {
    let facts: Vec<(&Fact, Vec<String>)> = facts
        .iter()
        .map(|fact| (fact, elements(&fact.0).into_iter().chain(elements(&fact.1)).collect()))
        .filter(|(_, elements): &(_, Vec<String>)| !elements.is_empty())
        .collect();
    let all: BTreeSet<&String> = facts.iter().flat_map(|(_, elements)| elements).collect();
    let mut colours: BTreeMap<String, u64> = all.iter().map(|name| ((*name).clone(), 0)).collect();
    let number = |name: &str| name.rsplit_once('!').and_then(|(_, digits)| digits.parse().ok()).unwrap_or(0);
    let element = |name: &String| Coloured { name: name.clone(), number: number(name), colours: Vec::new() };
    let mut found: Vec<Coloured> = colours.keys().map(element).collect();
    for _ in 0..all.len().min(ROUNDS) {
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
        found.iter_mut().for_each(|element| element.colours.push(colours[&element.name]));
    }
    found
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
    fn elements_are_matched_though_others_are_not_alike() {
        let ours = facts(&["N={n!1,n!2}", "f(n!1)=a", "f(n!2)=b"]);
        let theirs = facts(&["N={n!1,n!2}", "f(n!1)=c", "f(n!2)=a"]);
        assert_eq!(matching(&ours, &theirs, &BTreeMap::new()).unwrap()["n!1"], "n!2");
    }

    #[test]
    fn known_elements_stay_what_they_are() {
        let ours = facts(&["N={n!1,n!2}", "f(n!1)=a", "f(n!2)=a"]);
        let known = BTreeMap::from([("n!1".to_string(), "n!2".to_string())]);
        let names = matching(&ours, &ours, &known).unwrap();
        assert_eq!((names["n!1"].as_str(), names["n!2"].as_str()), ("n!2", "n!1"));
    }
}
