//! No circles between the files of a crate: what two files need of each other lies in a third one below both.
//!
//! In: all Rust files. Out: a finding for each group of files that reach each other by the names they take from each other.
//! A name belongs to the file that declares it, whichever module hands it on; `pub use` alone takes nothing. A module may
//! take names from the modules around it, as it lies within them. Methods are not followed: the `impl` of one type may be
//! spread over files. Tests are left out.
//!
//! Where a circle is in the nature of things, as in a grammar whose terms hold rules and rules terms, each of its files says
//! `CIRCLE(name)` in its header, and one of them why.

use std::collections::{BTreeMap, BTreeSet};

use proc_macro2::{Delimiter, TokenStream, TokenTree};

use super::{File, Finding};

/// A module, by the names from the root of its crate on.
type ModulePath = Vec<String>;

/// The files of one crate, as far as names go.
#[derive(Default)]
struct Crate {
    /// The file of each module; inline modules have that of the module around them.
    files: BTreeMap<ModulePath, usize>,
    /// What `use` brings into a module: the name there, and the whole path.
    imports: BTreeMap<ModulePath, BTreeMap<String, Vec<String>>>,
}

/// A path that a module takes something by, from the root of the crate on.
struct Taken {
    module: ModulePath,
    path: Vec<String>,
}

/// The folder of the crate's sources, and the module that a file is.
fn place(path: &str) -> Option<(&str, ModulePath)> {
    let (root, rest) = path.split_once("/src/")?;
    let rest = rest.strip_suffix(".rs")?;
    let mut module: ModulePath = rest.split('/').map(str::to_string).collect();
    let last = module.last().map(String::as_str);
    if last == Some("mod") || module.len() == 1 && matches!(last, Some("lib" | "main")) {
        module.pop();
    }
    Some((root, module))
}

/// The tokens of a group, or none.
fn group(tree: Option<&TokenTree>, delimiter: Delimiter) -> Option<Vec<TokenTree>> {
    match tree {
        Some(TokenTree::Group(group)) if group.delimiter() == delimiter => Some(group.stream().into_iter().collect()),
        _ => None,
    }
}

fn ident(tree: Option<&TokenTree>) -> Option<String> {
    match tree {
        Some(TokenTree::Ident(ident)) => Some(ident.to_string()),
        _ => None,
    }
}

fn is(tree: Option<&TokenTree>, letter: char) -> bool {
    matches!(tree, Some(TokenTree::Punct(punct)) if punct.as_char() == letter)
}

/// `::` at this place.
fn colons(trees: &[TokenTree], at: usize) -> bool {
    is(trees.get(at), ':') && is(trees.get(at + 1), ':')
}

/// Reads the files of one crate.
struct Reader<'c> {
    known: &'c mut Crate,
    taken: Vec<Taken>,
    /// Names that a module hands on by `pub use`: they count where the module itself uses them.
    handed_on: Vec<(ModulePath, String)>,
    /// Names that stand in a module outside `use`.
    named: BTreeSet<(ModulePath, String)>,
}

impl Reader<'_> {
    /// Notes inline modules first, since paths may lead into them.
    fn inline(&mut self, trees: &[TokenTree], module: &ModulePath, file: usize) {
        for (at, tree) in trees.iter().enumerate() {
            if ident(Some(tree)).is_some_and(|word| word == "mod")
                && let (Some(name), Some(inner)) =
                    (ident(trees.get(at + 1)), group(trees.get(at + 2), Delimiter::Brace))
            {
                let path = [module.as_slice(), &[name]].concat();
                self.known.files.insert(path.clone(), file);
                self.inline(&inner, &path, file);
            }
        }
    }

    fn read(&mut self, trees: &[TokenTree], module: &ModulePath) {
        let mut at = 0;
        while at < trees.len() {
            let word = ident(trees.get(at));
            if is(trees.get(at), '#') {
                // `#[cfg(test)]` takes the item after it away.
                let attribute = trees.get(at + 1).map(ToString::to_string).unwrap_or_default();
                at += 2;
                if attribute.replace(' ', "") == "[cfg(test)]" {
                    while at < trees.len()
                        && group(trees.get(at), Delimiter::Brace).is_none()
                        && !is(trees.get(at), ';')
                    {
                        at += 1;
                    }
                    at += 1;
                }
            } else if word.as_deref() == Some("use") {
                let end = (at..trees.len()).find(|end| is(trees.get(*end), ';')).unwrap_or(trees.len());
                let before = |back: usize| at.checked_sub(back).and_then(|at| trees.get(at));
                let public = ident(before(1)).is_some_and(|word| word == "pub")
                    || group(before(1), Delimiter::Parenthesis).is_some();
                self.import(&trees[at + 1..end], &[], module, public);
                at = end;
            } else if word.as_deref() == Some("mod") {
                if let (Some(name), Some(inner)) =
                    (ident(trees.get(at + 1)), group(trees.get(at + 2), Delimiter::Brace))
                {
                    self.read(&inner, &[module.as_slice(), &[name]].concat());
                }
                at += 3;
            } else if let Some(first) = word {
                let mut path = vec![first];
                at += 1;
                while colons(trees, at)
                    && let Some(next) = ident(trees.get(at + 2))
                {
                    path.push(next);
                    at += 3;
                }
                self.named.insert((module.clone(), path[0].clone()));
                if path.len() > 1 {
                    self.taken.push(Taken { module: module.clone(), path });
                }
            } else {
                if let Some(TokenTree::Group(inner)) = trees.get(at) {
                    self.read(&inner.stream().into_iter().collect::<Vec<_>>(), module);
                }
                at += 1;
            }
        }
    }

    /// A tree of `use`, after the names of `before`.
    fn import(&mut self, trees: &[TokenTree], before: &[String], module: &ModulePath, public: bool) {
        let mut path = before.to_vec();
        let mut at = 0;
        while let Some(name) = ident(trees.get(at)) {
            path.push(name);
            at += 1;
            if !colons(trees, at) {
                break;
            }
            at += 2;
        }
        if let Some(inner) = group(trees.get(at), Delimiter::Brace) {
            for part in inner.split(|tree| is(Some(tree), ',')) {
                self.import(part, &path, module, public);
            }
            return;
        }
        if path.last().is_some_and(|last| last == "self") && path.len() > 1 {
            path.pop();
        }
        let renamed = ident(trees.get(at)).filter(|word| word == "as").and_then(|_| ident(trees.get(at + 1)));
        let Some(name) = renamed.or_else(|| path.last().cloned()) else { return };
        if !is(trees.get(at), '*') {
            self.known.imports.entry(module.clone()).or_default().insert(name.clone(), path.clone());
        }
        match public {
            true => self.handed_on.push((module.clone(), name)),
            false => self.taken.push(Taken { module: module.clone(), path }),
        }
    }
}

impl Crate {
    /// The file that declares what a path means in a module; none if it is of another crate, or a module and no more.
    fn file_of(&self, module: &[String], path: &[String], depth: usize) -> Option<usize> {
        let (first, mut rest) = path.split_first()?;
        let mut at: ModulePath = module.to_vec();
        match first.as_str() {
            "crate" => at.clear(),
            "self" => {}
            "super" => {
                at.pop();
                while let Some((next, after)) = rest.split_first()
                    && next == "super"
                {
                    at.pop();
                    rest = after;
                }
            }
            _ if depth == 0 => return None,
            name => {
                if let Some(imported) =
                    self.imports.get(module).and_then(|names| names.get(name)).filter(|all| *all != path)
                {
                    return self.file_of(module, &[imported.as_slice(), rest].concat(), depth - 1);
                }
                at.push(first.clone());
                self.files.get(&at)?;
            }
        }
        while let Some((name, after)) = rest.split_first() {
            let inner = [at.as_slice(), std::slice::from_ref(name)].concat();
            if self.files.contains_key(&inner) {
                (at, rest) = (inner, after);
                continue;
            }
            let imported = self.imports.get(&at).and_then(|names| names.get(name)).filter(|_| depth > 0);
            return match imported {
                Some(imported) => self.file_of(&at, &[imported.as_slice(), after].concat(), depth - 1),
                None => self.files.get(&at).copied(),
            };
        }
        None
    }
}

/// What each file takes from which other ones: the names.
type Edges = BTreeMap<usize, BTreeMap<usize, BTreeSet<String>>>;

fn edges(files: &[File], of: &[(usize, ModulePath)]) -> Edges {
    let mut known =
        Crate { files: of.iter().map(|(file, module)| (module.clone(), *file)).collect(), ..Crate::default() };
    let mut reader = Reader { known: &mut known, taken: Vec::new(), handed_on: Vec::new(), named: BTreeSet::new() };
    let tokens = |file: usize| -> Vec<TokenTree> {
        let text = files[file].text.as_deref().unwrap_or_default();
        text.parse::<TokenStream>().map(|stream| stream.into_iter().collect()).unwrap_or_default()
    };
    for (file, module) in of {
        reader.inline(&tokens(*file), module, *file);
    }
    for (file, module) in of {
        reader.read(&tokens(*file), module);
    }
    let Reader { mut taken, handed_on, named, .. } = reader;
    let used = handed_on.into_iter().filter(|handed| named.contains(handed));
    taken.extend(used.map(|(module, name)| Taken { path: vec![name], module }));
    let mut edges = Edges::new();
    for Taken { module, path } in taken {
        let (Some(from), Some(to)) = (known.files.get(&module), known.file_of(&module, &path, 8)) else { continue };
        let around = |outer: &ModulePath| module.starts_with(outer) && known.files.get(outer) == Some(&to);
        if *from != to && !(0..module.len()).any(|length| around(&module[..length].to_vec())) {
            let name = path.last().cloned().unwrap_or_default();
            edges.entry(*from).or_default().entry(to).or_default().insert(name);
        }
    }
    edges
}

/// Both files name one circle in their headers.
fn natural(from: &File, to: &File) -> bool {
    let names = |file: &File| -> BTreeSet<String> {
        let header = file.text.iter().flat_map(|text| text.lines()).take_while(|line| line.starts_with("//!"));
        let named = header.flat_map(|line| line.split("CIRCLE(").skip(1).filter_map(|rest| rest.split(')').next()));
        named.map(str::to_string).collect()
    };
    !names(from).is_disjoint(&names(to))
}

/// The shortest way from a file back to itself.
fn way_back(edges: &Edges, start: usize) -> Option<Vec<usize>> {
    let mut ways = vec![vec![start]];
    let mut seen = BTreeSet::new();
    let mut next = 0;
    while let Some(way) = ways.get(next).cloned() {
        next += 1;
        let last = way[way.len() - 1];
        for to in edges.get(&last).into_iter().flat_map(BTreeMap::keys) {
            if *to == start {
                return Some([way, vec![start]].concat());
            }
            if seen.insert(*to) {
                ways.push([way.as_slice(), &[*to]].concat());
            }
        }
    }
    None
}

/// No circles.
pub fn circles(files: &[File]) -> Vec<Finding> {
    let mut crates: BTreeMap<&str, Vec<(usize, ModulePath)>> = BTreeMap::new();
    for (index, file) in files.iter().enumerate() {
        if let Some((root, module)) = place(&file.path) {
            crates.entry(root).or_default().push((index, module));
        }
    }
    let mut findings = Vec::new();
    for of in crates.values() {
        let mut edges = edges(files, of);
        for (from, to) in &mut edges {
            to.retain(|to, _| !natural(&files[*from], &files[*to]));
        }
        let mut told: BTreeSet<usize> = BTreeSet::new();
        for (file, _) in of {
            if told.contains(file) {
                continue;
            }
            let Some(way) = way_back(&edges, *file) else { continue };
            told.extend(&way);
            let names = |pair: &[usize]| {
                let names = edges[&pair[0]][&pair[1]].iter().map(String::as_str).collect::<Vec<_>>().join(", ");
                format!("takes {names} from {}", files[pair[1]].path)
            };
            let steps: Vec<String> = way.windows(2).map(names).collect();
            let what =
                format!("a circle of files: it {}; put what they share into a file below", steps.join(", which "));
            findings.push(Finding::of(&files[*file], what));
        }
    }
    findings
}

#[cfg(test)]
mod tests {
    use super::*;

    fn found(files: &[(&str, &str)]) -> Vec<String> {
        let files: Vec<File> =
            files.iter().map(|(path, text)| File::new(&format!("crates/a/src/{path}"), text)).collect();
        circles(&files).into_iter().map(|finding| finding.path).collect()
    }

    #[test]
    fn two_files_that_need_each_other_are_found() {
        assert_eq!(
            found(&[
                ("lib.rs", "mod a; mod b;"),
                ("a.rs", "use crate::b::B; pub struct A(B);"),
                ("b.rs", "pub struct B; impl B { fn f(_: super::a::A) {} }"),
            ]),
            ["crates/a/src/a.rs"]
        );
    }

    #[test]
    fn what_is_handed_on_belongs_to_its_file() {
        let facade = "mod a; mod b; pub use a::A; pub use b::B;";
        assert_eq!(
            found(&[("lib.rs", facade), ("a.rs", "pub struct A;"), ("b.rs", "use crate::A; pub struct B(A);")]),
            [""; 0]
        );
        let uses_it = "mod inner; pub use inner::B; pub fn f() -> B { B }";
        let inner = "pub struct B; fn h() { crate::c::g() }";
        let files = [
            ("lib.rs", "mod a; mod c;"),
            ("a/mod.rs", uses_it),
            ("a/inner.rs", inner),
            ("c.rs", "pub fn g() { crate::a::f() }"),
        ];
        assert_eq!(found(&files), ["crates/a/src/a/mod.rs"]);
    }

    #[test]
    fn a_way_through_modules_and_macros_is_seen() {
        assert_eq!(
            found(&[
                ("lib.rs", "mod a; mod b;"),
                ("a/mod.rs", "mod inner; use crate::b; fn f() { println!(\"{}\", b::g()) }"),
                ("a/inner.rs", "pub fn h() {}"),
                ("b.rs", "pub fn g() { crate::a::inner::h() }"),
            ]),
            [""; 0]
        );
        assert_eq!(
            found(&[
                ("lib.rs", "mod a; mod b;"),
                ("a/mod.rs", "mod inner; use inner::h; fn f() { h() }"),
                ("a/inner.rs", "use crate::b; pub fn h() { println!(\"{}\", b::g()) }"),
                ("b.rs", "pub fn g() { crate::a::f() }"),
            ]),
            ["crates/a/src/a/mod.rs"]
        );
    }

    #[test]
    fn a_natural_circle_has_a_name() {
        let check = |name: &str| {
            let a = "//! A term holds rules. CIRCLE(grammar).\npub fn a() { crate::b::b() }";
            let b = format!("//! CIRCLE({name})\npub fn b() {{ crate::a::a() }}");
            found(&[("lib.rs", "mod a; mod b;"), ("a.rs", a), ("b.rs", &b)]).len()
        };
        assert_eq!((check("grammar"), check("other")), (0, 1));
    }

    #[test]
    fn a_module_lies_within_another() {
        let inner = "pub fn h() { super::f() } pub fn g() { crate::f() }";
        let outer = "mod inner; pub fn f() { inner::h() }";
        assert_eq!(found(&[("lib.rs", outer), ("inner.rs", inner)]), [""; 0]);
    }

    #[test]
    fn tests_may_know_everything() {
        let a = "pub struct A; #[cfg(test)] mod tests { use crate::b::B; }";
        assert_eq!(
            found(&[("lib.rs", "mod a; mod b;"), ("a.rs", a), ("b.rs", "use crate::a::A; pub struct B(A);")]),
            [""; 0]
        );
    }
}
