//! Random things done to pictures of charts: the text means what was drawn, and undoing gives the bytes back.
//!
//! A second account of the chart, shapes and arrows alone, is kept beside the text. GROUNDSTATE_FULL makes ten thousand operations.

use std::collections::{BTreeMap, BTreeSet};

use chart::{Chart, End, Machine, ShapeId};
use ide::{Copied, Edit, Fresh, FreshKind, Joint, Moment, Operation, drawn, edited};
use syntax::ast::{AstNode, ChartFile, Shape};
use syntax::{FileId, parse_chart};

const START: &str = "/* head */\nchart Random\n\npattern part \"Part\" // first\n\tcontrol partState\n\tstate one \"One\" // a comment\n\t// two\n\
                     \tguard g \"G\" {f(1) = 2} to refine\n\taction a \"A\"\n\taction b \"B\" {r_b[]}\n\tsequence a, b\n\tenter -> a -> b -> one\n\
                     \tone -> g yes -> exit\n\tg no -> one\nendpattern // end\n\nlayout part\n\tone at 1, 2 // here\nendlayout\n";

struct Random(u64);

impl Random {
    fn below(&mut self, bound: usize) -> usize {
        self.0 ^= self.0 << 13;
        self.0 ^= self.0 >> 7;
        self.0 ^= self.0 << 17;
        (self.0 % bound.max(1) as u64) as usize
    }
}

#[derive(Debug, Clone, Default, PartialEq)]
struct Account {
    shapes: BTreeMap<String, Figure>,
    arrows: BTreeSet<(String, Option<bool>, String)>,
    places: BTreeMap<String, (i64, i64)>,
    /// The composite state around a shape.
    within: BTreeMap<String, String>,
    /// Composite states, each with whether it remembers.
    composites: BTreeMap<String, bool>,
    /// What is done on entering and on leaving, with the composite state.
    doings: BTreeSet<(String, bool, String)>,
}

#[derive(Debug, Clone, Copy, PartialEq)]
enum Figure {
    State,
    Guard,
    Other,
}

fn read(text: &str) -> Chart {
    chart::read(FileId(0), &parse_chart(FileId(0), text)).0
}

fn account(chart: &Chart) -> Account {
    let machine: &Machine = &chart.machines[0];
    let named = |end: End| match end {
        End::Enter => "enter".to_string(),
        End::Exit => "exit".to_string(),
        End::Shape(id) => machine.shape(id).name.clone(),
    };
    let kind = |shape: &chart::Shape| match shape.kind {
        chart::ShapeKind::State { .. } | chart::ShapeKind::Composite(_) => Figure::State,
        chart::ShapeKind::Guard => Figure::Guard,
        chart::ShapeKind::Action | chart::ShapeKind::Instance(_) => Figure::Other,
    };
    Account {
        shapes: machine.shapes.iter().map(|shape| (shape.name.clone(), kind(shape))).collect(),
        arrows: machine.arrows.iter().map(|arrow| (named(arrow.from), arrow.branch, named(arrow.to))).collect(),
        places: chart
            .layouts
            .get("part")
            .into_iter()
            .flatten()
            .map(|(name, at)| (name.clone(), (at.0 as i64, at.1 as i64)))
            .collect(),
        within: machine
            .shapes
            .iter()
            .filter_map(|shape| Some((shape.name.clone(), called(machine, shape.inside?))))
            .collect(),
        composites: composites(machine).map(|(name, one)| (name, one.history.is_some())).collect(),
        doings: composites(machine)
            .flat_map(|(name, one)| {
                let told = |ids: &[ShapeId], is_entry: bool| {
                    ids.iter().map(|id| (name.clone(), is_entry, called(machine, *id))).collect::<Vec<_>>()
                };
                told(&one.entry, true).into_iter().chain(told(&one.exit, false)).collect::<Vec<_>>()
            })
            .collect(),
    }
}

fn called(machine: &Machine, id: ShapeId) -> String {
    machine.shape(id).name.clone()
}

fn composites(machine: &Machine) -> impl Iterator<Item = (String, &chart::Composite)> {
    machine.shapes.iter().filter_map(|shape| Some((shape.name.clone(), shape.composite()?)))
}

/// The shapes of the machine, in the order of the text.
fn in_order(text: &str) -> Vec<Shape> {
    let file = ChartFile::cast(parse_chart(FileId(0), text).syntax()).expect("it is a chart");
    file.machines().next().expect("it has a machine").shapes().collect()
}

fn name_of(shape: &Shape) -> String {
    shape.name().expect("it has a name").text().to_string()
}

/// The declaration of a shape, and the names in it.
fn declaration(text: &str, name: &str) -> (String, Vec<String>) {
    let shapes = in_order(text);
    let whole = shapes.iter().find(|shape| name_of(shape) == name).expect("it is there").syntax().clone();
    let inside = shapes.iter().filter(|shape| shape.syntax().ancestors().any(|node| node == whole));
    let names = inside.map(name_of).collect();
    (whole.text().to_string().trim().to_string(), names)
}

impl Account {
    /// What connecting two ends makes of it; none if it is refused.
    fn connect(&mut self, from: &str, branch: Option<bool>, to: &str) -> bool {
        let kind = self.shapes.get(from).copied();
        let legal = to != "enter"
            && from != "exit"
            && (to == "exit" || self.shapes.contains_key(to))
            && !self.doings.iter().any(|(.., name)| name == from || name == to);
        let branch = if kind == Some(Figure::Guard) { branch } else { None };
        let known = from == "enter" || kind.is_some();
        if !legal || !known || kind == Some(Figure::Guard) && branch.is_none() {
            return false;
        }
        let forks = from == "enter" || kind == Some(Figure::State);
        if !forks {
            self.arrows.retain(|(other, exit, _)| other != from || *exit != branch);
        }
        self.arrows.insert((from.to_string(), branch, to.to_string()));
        true
    }

    /// A shape goes, and all in it.
    fn delete(&mut self, name: &str) -> bool {
        let inside = self.within.iter().filter(|(_, around)| *around == name).map(|(inner, _)| inner.clone());
        for inner in inside.collect::<Vec<_>>() {
            self.delete(&inner);
        }
        let is_there = self.shapes.remove(name).is_some();
        self.arrows.retain(|(from, _, to)| from != name && to != name);
        self.places.remove(name);
        self.within.remove(name);
        self.composites.remove(name);
        self.doings.retain(|(.., own)| own != name);
        is_there
    }

    /// All names are others.
    fn renamed(&self, of: impl Fn(&String) -> String) -> Account {
        Account {
            shapes: self.shapes.iter().map(|(name, figure)| (of(name), *figure)).collect(),
            arrows: self.arrows.iter().map(|(from, branch, to)| (of(from), *branch, of(to))).collect(),
            places: self.places.iter().map(|(name, at)| (of(name), *at)).collect(),
            within: self.within.iter().map(|(name, around)| (of(name), of(around))).collect(),
            composites: self.composites.iter().map(|(name, history)| (of(name), *history)).collect(),
            doings: self.doings.iter().map(|(name, is_entry, own)| (of(name), *is_entry, of(own))).collect(),
        }
    }

    /// What is of these shapes alone.
    fn only(&self, names: &[String]) -> Account {
        let mut part = self.clone();
        part.shapes.retain(|name, _| names.contains(name));
        part.arrows.retain(|(from, _, to)| names.contains(from) && names.contains(to));
        part.places.clear();
        part.within.retain(|name, around| names.contains(name) && names.contains(around));
        part.composites.retain(|name, _| names.contains(name));
        part.doings.retain(|(name, ..)| names.contains(name));
        part
    }

    fn add(&mut self, other: Account) {
        self.shapes.extend(other.shapes);
        self.arrows.extend(other.arrows);
        self.places.extend(other.places);
        self.within.extend(other.within);
        self.composites.extend(other.composites);
        self.doings.extend(other.doings);
    }

    /// A shape goes into a composite state, or out of all. Out: whether it may.
    fn nest(&mut self, name: &str, into: Option<&String>) -> bool {
        let is_doing = self.doings.iter().any(|(.., own)| own == name);
        if !self.shapes.contains_key(name) || is_doing || into.is_some_and(|into| !self.composites.contains_key(into)) {
            return false;
        }
        let home = self.within.get(name).cloned();
        if home.as_ref() == into {
            return true;
        }
        let mut around = into.cloned();
        while let Some(at) = around {
            if at == name {
                return false;
            }
            around = self.within.get(&at).cloned();
        }
        let is_state = |other: &String| self.shapes.get(other) == Some(&Figure::State);
        let others =
            |home: &String| self.within.iter().any(|(own, around)| around == home && own != name && is_state(own));
        if is_state(&name.to_string()) && home.as_ref().is_some_and(|home| !others(home)) {
            return false;
        }
        match into {
            Some(into) => _ = self.within.insert(name.to_string(), into.clone()),
            None => _ = self.within.remove(name),
        }
        true
    }
}

#[test]
fn the_text_means_what_was_drawn() {
    let rounds = if testkit::sample::is_full() { 10_000 } else { 300 };
    let mut random = Random(0x9E37_79B9_7F4A_7C15);
    let mut text = START.to_string();
    let mut kept = account(&read(&text));
    for round in 0..rounds {
        if round % 60 == 59 {
            text = START.to_string();
            kept = account(&read(&text));
        }
        let mut names: Vec<String> = kept.shapes.keys().cloned().collect();
        names.extend(["enter".to_string(), "exit".to_string()]);
        let pick = |random: &mut Random| names[random.below(names.len())].clone();
        let branch = |random: &mut Random| [None, Some(true), Some(false)][random.below(3)];
        let mut next = kept.clone();
        let arrow = (!kept.arrows.is_empty())
            .then(|| kept.arrows.iter().nth(random.below(kept.arrows.len())).cloned())
            .flatten();
        let joint = |(from, branch, to): (String, Option<bool>, String)| Joint { from, branch, to };
        let composite = |random: &mut Random| kept.composites.keys().nth(random.below(kept.composites.len())).cloned();
        // What it makes gets names that only the text knows.
        let mut made: Option<(Vec<String>, Account)> = None;
        let (operation, is_legal) = match random.below(15) {
            0 | 1 => {
                let (from, branch, to) = (pick(&mut random), branch(&mut random), pick(&mut random));
                let legal = next.connect(&from, branch, &to);
                (Operation::Connect(Joint { from, branch, to }), legal)
            }
            2 if let Some(arrow) = arrow => {
                next.arrows.remove(&arrow);
                (Operation::Disconnect(joint(arrow)), true)
            }
            3 if let Some(arrow) = arrow => {
                let to = pick(&mut random);
                next.arrows.remove(&arrow);
                let legal = next.connect(&arrow.0, arrow.1, &to);
                let new = (arrow.0.clone(), arrow.1, to);
                (Operation::Redirect(joint(arrow), joint(new)), legal)
            }
            4 => {
                let name = pick(&mut random);
                let is_there = next.delete(&name);
                (Operation::Delete(vec![name]), is_there)
            }
            5 | 6 => {
                let (kind, own) = [
                    (FreshKind::State, Figure::State),
                    (FreshKind::Guard, Figure::Guard),
                    (FreshKind::Action, Figure::Other),
                ][random.below(3)];
                let name = format!("n{round}");
                let at = (random.below(500) as f64, random.below(500) as f64);
                next.shapes.insert(name.clone(), own);
                next.places.insert(name.clone(), (at.0 as i64, at.1 as i64));
                let text = Some(format!("N {round} // \"no comment\""));
                (Operation::Add(Fresh { kind, name: Some(name), text, link: None, of: None, at }), true)
            }
            7 => {
                let (name, to) = (pick(&mut random), format!("r{round}"));
                let is_there = next.shapes.contains_key(&name);
                if is_there {
                    next = next.renamed(|own| if *own == name { to.clone() } else { own.clone() });
                }
                (Operation::Rename(name, to), is_there)
            }
            8 => {
                let name = format!("n{round}");
                let at = (random.below(500) as f64, random.below(500) as f64);
                next.shapes.insert(name.clone(), Figure::State);
                next.composites.insert(name.clone(), false);
                let mut inner = Account::default();
                inner.shapes.insert("inner".to_string(), Figure::State);
                inner.places.insert("inner".to_string(), (at.0 as i64, at.1 as i64));
                inner.within.insert("inner".to_string(), name.clone());
                made = Some((vec!["inner".to_string()], inner));
                (
                    Operation::Add(Fresh {
                        kind: FreshKind::Composite,
                        name: Some(name),
                        text: None,
                        link: None,
                        of: None,
                        at,
                    }),
                    true,
                )
            }
            9 | 10 => {
                let name = pick(&mut random);
                let into = if random.below(3) == 0 { None } else { composite(&mut random) };
                let legal = next.nest(&name, into.as_ref());
                (Operation::Nest(vec![name], into, BTreeMap::new()), legal)
            }
            11 if let Some(name) = composite(&mut random) => {
                let history = [None, Some(None), Some(Some("left".to_string()))][random.below(3)].clone();
                next.composites.insert(name.clone(), history.is_some());
                (Operation::History(name, history), true)
            }
            12 if let Some(name) = composite(&mut random) => {
                let (is_entry, own) = (random.below(2) == 0, format!("d{round}"));
                next.shapes.insert(own.clone(), Figure::Other);
                next.within.insert(own.clone(), name.clone());
                next.doings.insert((name.clone(), is_entry, own.clone()));
                let moment = if is_entry { Moment::Entry } else { Moment::Exit };
                (Operation::AddDoing(name, moment, Some(own)), true)
            }
            13 if let Some(name) = composite(&mut random).filter(|_| kept.shapes.len() < 40) => {
                let (source, names) = declaration(&text, &name);
                let copy = kept.only(&names);
                let arrows = copy.arrows.iter().cloned().map(joint).collect();
                made = Some((names, copy));
                (Operation::Paste(Vec::new(), vec![Copied { source, places: BTreeMap::new() }], arrows), true)
            }
            _ => {
                let name = pick(&mut random);
                let at = (random.below(500), random.below(500));
                let is_framed = next.composites.contains_key(&name) || next.doings.iter().any(|(.., own)| *own == name);
                let is_there = name != "exit" && !is_framed;
                next.places.insert(name.clone(), (at.0 as i64, at.1 as i64));
                (Operation::Move(BTreeMap::from([(name, (at.0 as f64, at.1 as f64))])), is_there)
            }
        };
        let done = drawn(&text, "part", &operation, &BTreeMap::new());
        match (done, is_legal) {
            (Ok(done), true) => {
                let edits: Vec<Edit> = done.edit.into_iter().collect();
                let after = edited(&text, &edits);
                if let Some((names, account)) = made {
                    // They come in the order in which they are declared.
                    let mut fresh: Vec<String> = in_order(&after).iter().map(name_of).collect();
                    fresh.retain(|name| !next.shapes.contains_key(name));
                    assert_eq!(fresh.len(), names.len(), "{operation:?}\n{after}");
                    let of = |name: &String| match names.iter().position(|own| own == name) {
                        Some(at) => fresh[at].clone(),
                        None => name.clone(),
                    };
                    next.add(account.renamed(of));
                }
                assert_eq!(account(&read(&after)), next, "{operation:?}\n{text}\n=>\n{after}");
                for comment in ["/* head */", "// first", "// end", "chart Random"] {
                    assert!(after.contains(comment), "{comment} is lost by {operation:?}\n{after}");
                }
                let back: Vec<Edit> = edits
                    .iter()
                    .map(|edit| {
                        let (start, end) = edit.range;
                        Edit::new(start..start + edit.text.len() as u32, &text[start as usize..end as usize])
                    })
                    .collect();
                assert_eq!(edited(&after, &back), text);
                (text, kept) = (after, next);
            }
            (Err(_), false) => {}
            (done, _) => panic!("{operation:?} is legal: {is_legal}, but {done:?}\n{text}"),
        }
    }
}
