//! Imports point one way between the folders of a crate and between its modules; Cargo checks those between
//! crates.

use std::collections::{BTreeMap, HashMap, HashSet};
use std::mem::take;

use piola_tidy::{Crate, Module, crates, forbid, name_of, tokens};
use proc_macro2::TokenStream;
use quote::ToTokens;
use syn::Item;

/// Modules of the runtime from the bottom up: each may need those on the floors below.
const RUNTIME: &[&[&str]] = &[
    &["lanes", "message", "no_such_node", "random"],
    &["status"],
    &["quotient"],
    &["material"],
    &["univariate"],
    &["interpreter", "point"],
    &["kernels"],
    &["batch", "contract", "convert"],
    &["dynamic"],
    &["__private"],
];

/// Modules of bodies from the bottom up.
const BODIES: &[&[&str]] = &[&["mesh"], &["system"], &["step"]];

#[test]
fn modules_know_only_those_on_the_floors_below_them() {
    let crates = crates();
    for (name, floors) in [("piola", RUNTIME), ("piola_bodies", BODIES)] {
        let one = crates.iter().find(|one| one.name == name).expect("the crate");
        let floor = |module: usize| {
            let name = &one.modules[module].path[0];
            let floor = floors.iter().position(|floor| floor.contains(&name.as_str()));
            floor.unwrap_or_else(|| panic!("this file does not say on which floor `{name}` stands"))
        };
        let graph = Graph::new(one);
        let mut edges = graph.between_folders(graph.edges());
        edges.retain(|edge| floor(edge.from) <= floor(edge.to));
        forbid(&format!("paths in {name} that do not point downwards"), &lines(one, &edges));
    }
}

/// Needs between a module and its own child do not count: the parent re-exports, the child is a part of it.
#[test]
fn no_folders_and_no_modules_of_a_crate_need_each_other() {
    let mut found = Vec::new();
    for one in crates() {
        let graph = Graph::new(&one);
        let is_child = |a: usize, b: usize| one.modules[a].parent == Some(b);
        let mut edges = graph.edges();
        found.extend(lines(&one, &circles(graph.between_folders(edges.clone()))));
        edges.retain(|edge| !is_child(edge.from, edge.to) && !is_child(edge.to, edge.from));
        found.extend(lines(&one, &circles(edges)));
    }
    forbid("imports in circles, or between circles", &found);
}

/// A line for each pair of modules, with the first path between them.
fn lines(one: &Crate, edges: &[Edge]) -> Vec<String> {
    let pairs: BTreeMap<_, _> = edges.iter().rev().map(|edge| ((edge.from, edge.to), edge)).collect();
    let line = |edge: &Edge| {
        let (from, to) = (&one.modules[edge.from], &one.modules[edge.to]);
        format!("{}: {from} → {to}: {}", one.name, edge.written)
    };
    pairs.into_values().map(line).collect()
}

/// The edges that are left when those from where none arrives and those to where none begins are taken away,
/// again and again.
fn circles(mut edges: Vec<Edge>) -> Vec<Edge> {
    loop {
        let begins: HashSet<usize> = edges.iter().map(|edge| edge.from).collect();
        let ends: HashSet<usize> = edges.iter().map(|edge| edge.to).collect();
        let before = edges.len();
        edges.retain(|edge| ends.contains(&edge.from) && begins.contains(&edge.to));
        if edges.len() == before {
            return edges;
        }
    }
}

/// A module that needs another of the same crate, by their indices.
#[derive(Clone)]
struct Edge {
    from: usize,
    to: usize,
    /// The path, with file and line.
    written: String,
}

/// What a name in a module stands for.
enum Name {
    /// A module in it, by its index.
    Child(usize),
    /// An item of the module itself.
    Defined,
    /// The path of an import.
    BroughtIn(Vec<String>),
}

/// The modules of a crate with the names in them.
struct Graph<'a> {
    modules: &'a [Module],
    /// Under this name the crate may call itself.
    own_name: &'a str,
    names: HashMap<(usize, String), Name>,
}

impl<'a> Graph<'a> {
    fn new(of: &'a Crate) -> Self {
        let mut names = HashMap::new();
        for (index, module) in of.modules.iter().enumerate() {
            let imports = module.items.iter().filter(|item| matches!(item, Item::Use(_))).flat_map(mentions);
            // Nothing is looked for behind `*`: only `__private` of piola has any of its own items.
            for Mention { segments, name, .. } in imports.filter(|import| import.name != "*") {
                names.insert((index, name), Name::BroughtIn(segments));
            }
            for (name, _) in module.items.iter().filter_map(name_of) {
                names.insert((index, name.to_string()), Name::Defined);
            }
            if let (Some(parent), Some(name)) = (module.parent, module.path.last()) {
                names.insert((parent, name.clone()), Name::Child(index));
            }
        }
        Self { modules: &of.modules, own_name: &of.name, names }
    }

    fn edges(&self) -> Vec<Edge> {
        let mut edges = Vec::new();
        for (from, module) in self.modules.iter().enumerate() {
            for Mention { segments, line, .. } in module.items.iter().flat_map(mentions) {
                if let Some(to) = self.resolve(from, &segments, 0).filter(|&to| to != from) {
                    let written = format!("{} at {}:{line}", segments.join("::"), module.file.display());
                    edges.push(Edge { from, to, written });
                }
            }
        }
        edges
    }

    /// Edges among the modules of the root, each with all that is below it; the root itself is none of them.
    fn between_folders(&self, edges: Vec<Edge>) -> Vec<Edge> {
        let folder = |module: usize| {
            let first = self.modules[module].path.first()?;
            match self.names.get(&(0, first.clone()))? {
                Name::Child(folder) => Some(*folder),
                _ => None,
            }
        };
        let lifted = |edge: Edge| {
            let (from, to) = (folder(edge.from)?, folder(edge.to)?);
            (from != to).then_some(Edge { from, to, ..edge })
        };
        edges.into_iter().filter_map(lifted).collect()
    }

    /// The module that defines what a path leads to, through re-exports; `None` where it leads to another
    /// crate.
    fn resolve(&self, from: usize, segments: &[String], depth: usize) -> Option<usize> {
        let first = segments.first()?;
        let (mut at, mut rest) = match first.as_str() {
            name if name == "crate" || name == self.own_name => (0, &segments[1..]),
            "self" => (from, &segments[1..]),
            "super" => (self.modules[from].parent?, &segments[1..]),
            _ => match self.names.get(&(from, first.clone()))? {
                Name::Defined if depth == 0 => return None,
                _ => (from, segments),
            },
        };
        while let Some((name, behind)) = rest.split_first() {
            at = match self.names.get(&(at, name.clone())) {
                _ if name == "super" => self.modules[at].parent?,
                Some(Name::Child(child)) => *child,
                // What comes from another crate belongs to nobody here.
                Some(Name::BroughtIn(target)) if depth < 16 => {
                    return self.resolve(at, &[target.as_slice(), behind].concat(), depth + 1);
                }
                _ => return Some(at),
            };
            rest = behind;
        }
        Some(at)
    }
}

/// A path with more than one segment.
struct Mention {
    /// `crate`, `point`, `Filter`; the last may be `*`.
    segments: Vec<String>,
    /// The name that it has as an import: the last segment, or what is behind `as`.
    name: String,
    /// Line in the file, from 1.
    line: usize,
}

/// All paths in code, inside macros as well, those of grouped imports one by one.
fn mentions(code: impl ToTokens) -> Vec<Mention> {
    let tokens = tokens(code);
    let text = |at: usize| tokens.get(at).map_or("", |token| token.text.as_str());
    let is_separated = |at: usize| text(at) == ":" && text(at + 1) == ":";
    let mut found: Vec<Mention> = Vec::new();
    let mut path: Vec<String> = Vec::new();
    // For each open brace the path before it, if imports are grouped in it.
    let mut groups: Vec<Vec<String>> = vec![Vec::new()];
    for (at, token) in tokens.iter().enumerate() {
        let continues = at > 1 && is_separated(at - 2);
        match token.text.as_str() {
            "{" => groups.push(if continues { take(&mut path) } else { Vec::new() }),
            "}" => drop(groups.pop()),
            name if is_word(name) || (name == "*" && continues) => {
                let group = groups.last().map_or(&[][..], Vec::as_slice);
                let is_alias = at > 0 && text(at - 1) == "as";
                if is_alias && let Some(import) = found.last_mut() {
                    import.name = name.to_owned();
                }
                if name == "as" || (is_alias && !group.is_empty()) {
                    continue;
                }
                if !continues {
                    path = group.to_vec();
                }
                path.push(name.to_owned());
                // Generic arguments end a path, and may hold others.
                if is_separated(at + 1) && text(at + 3) != "<" {
                    continue;
                }
                let mut segments = take(&mut path);
                segments.pop_if(|last| last == "self");
                if let [_, .., last] = &segments[..] {
                    found.push(Mention { name: last.clone(), segments, line: token.line });
                }
            }
            _ => {}
        }
    }
    found
}

fn is_word(token: &str) -> bool {
    token.starts_with(|c: char| c.is_alphabetic() || c == '_')
}

#[test]
fn every_form_of_a_path_is_seen() {
    for (code, expected) in [
        (
            "use crate::{a::{self, B}, c as d, e::*};",
            &["crate::a as a", "crate::a::B as B", "crate::c as d", "crate::e::* as *"][..],
        ),
        (
            "fn f(x: super::super::X) -> [u8; 0] { x.y::<piola::Z>(0..self::w(1)) }",
            &["super::super::X as X", "piola::Z as Z", "self::w as w"],
        ),
        ("assert!(d.e as f::G == crate::a::<b::C>());", &["f::G as G", "crate::a as a", "b::C as C"]),
        ("macro_rules! m { () => { $crate::a::b!() } }", &["crate::a::b as b"]),
    ] {
        let found = mentions(code.parse::<TokenStream>().expect("tokens"));
        let written: Vec<String> =
            found.iter().map(|path| format!("{} as {}", path.segments.join("::"), path.name)).collect();
        assert_eq!(written, expected);
    }
}

#[test]
fn a_circle_is_seen() {
    let edge = |(from, to)| Edge { from, to, written: String::new() };
    let left = |edges: &[(usize, usize)]| circles(edges.iter().copied().map(edge).collect()).len();
    assert_eq!(left(&[(0, 1), (1, 2), (0, 2)]), 0);
    assert_eq!(left(&[(0, 1), (1, 2), (2, 1), (2, 3)]), 2);
}
