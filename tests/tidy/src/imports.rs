//! Dependencies between the modules of a crate: paths are followed through re-exports to where an item is
//! defined.

use std::collections::{BTreeMap, BTreeSet, HashMap, HashSet};

use quote::ToTokens;
use syn::{Item, UseTree, Visibility};

use crate::tokens::{Mention, mentions};
use crate::{Crate, Module};

/// A module that needs another of the same crate.
#[derive(Clone, Debug)]
pub struct Edge {
    /// Index of the module that needs.
    pub from: usize,
    /// Index of the module that defines what is needed.
    pub to: usize,
    /// The path as written.
    pub written: String,
    /// Line in the file of `from`.
    pub line: usize,
}

/// The modules of a crate with the names that they define and bring in.
pub struct Graph<'a> {
    modules: &'a [Module],
    /// Under this name the crate may call itself.
    own_name: &'a str,
    children: HashMap<(usize, String), usize>,
    defined: HashSet<(usize, String)>,
    brought_in: HashMap<(usize, String), Vec<String>>,
}

impl<'a> Graph<'a> {
    /// Reads the modules of a crate.
    #[must_use]
    pub fn new(of: &'a Crate) -> Self {
        let mut graph = Self {
            modules: &of.modules,
            own_name: &of.name,
            children: HashMap::new(),
            defined: HashSet::new(),
            brought_in: HashMap::new(),
        };
        for (index, module) in of.modules.iter().enumerate() {
            if let (Some(parent), Some(name)) = (module.parent, module.path.last()) {
                graph.children.insert((parent, name.clone()), index);
            }
            for item in &module.items {
                if let Item::Use(item) = item {
                    graph.bring_in(index, &[], &item.tree);
                } else if let Some((_, name, _)) = name_of(item) {
                    graph.defined.insert((index, name));
                }
            }
        }
        graph
    }

    fn bring_in(&mut self, module: usize, prefix: &[String], tree: &UseTree) {
        let joined = |name: &str| prefix.iter().cloned().chain([name.to_owned()]).collect::<Vec<_>>();
        match tree {
            UseTree::Path(path) => self.bring_in(module, &joined(&path.ident.to_string()), &path.tree),
            UseTree::Group(group) => group.items.iter().for_each(|tree| self.bring_in(module, prefix, tree)),
            // Nothing is looked for behind one: only `__private` of piola has any of its own items.
            UseTree::Glob(_) => {}
            UseTree::Name(name) if name.ident == "self" => {
                if let Some(last) = prefix.last() {
                    self.brought_in.insert((module, last.clone()), prefix.to_vec());
                }
            }
            UseTree::Name(name) => {
                let name = name.ident.to_string();
                self.brought_in.insert((module, name.clone()), joined(&name));
            }
            UseTree::Rename(rename) => {
                let mut path = joined(&rename.ident.to_string());
                if path.len() > 1 {
                    path.pop_if(|last| last == "self");
                }
                self.brought_in.insert((module, rename.rename.to_string()), path);
            }
        }
    }

    /// Every need of one module of another.
    #[must_use]
    pub fn edges(&self) -> Vec<Edge> {
        let mut edges = Vec::new();
        for (from, module) in self.modules.iter().enumerate() {
            let tokens = module.items.iter().flat_map(|item| mentions(item.to_token_stream()));
            for Mention { segments, line } in tokens {
                if let Some(to) = self.resolve(from, &segments, 0).filter(|&to| to != from) {
                    edges.push(Edge { from, to, written: segments.join("::"), line });
                }
            }
        }
        edges
    }

    /// The module that defines what a path leads to; `None` where it leads to another crate.
    fn resolve(&self, from: usize, segments: &[String], depth: usize) -> Option<usize> {
        let (first, _) = segments.split_first()?;
        let key = (from, first.clone());
        let (mut at, mut rest) = match first.as_str() {
            name if name == "crate" || name == self.own_name => (0, &segments[1..]),
            "self" => (from, &segments[1..]),
            "super" => (self.modules[from].parent?, &segments[1..]),
            _ if self.children.contains_key(&key)
                || self.brought_in.contains_key(&key)
                || (depth > 0 && self.defined.contains(&key)) =>
            {
                (from, segments)
            }
            _ => return None,
        };
        while let Some((name, behind)) = rest.split_first() {
            let key = (at, name.clone());
            if name == "super" {
                at = self.modules[at].parent?;
            } else if let Some(&child) = self.children.get(&key) {
                at = child;
            } else if self.defined.contains(&key) || name == "self" || name == "*" {
                return Some(at);
            } else if let Some(target) = self.brought_in.get(&key).filter(|_| depth < 16) {
                let whole: Vec<String> = target.iter().chain(behind).cloned().collect();
                // What comes from another crate belongs to nobody here.
                return self.resolve(at, &whole, depth + 1);
            } else {
                return Some(at);
            }
            rest = behind;
        }
        Some(at)
    }

    /// Groups of modules that need each other in a circle, each with the needs inside it.
    ///
    /// Needs between a module and its own child do not count: the parent re-exports, the child is a part of
    /// it.
    #[must_use]
    pub fn circles(&self) -> Vec<Vec<Edge>> {
        let is_child = |a: usize, b: usize| self.modules[a].parent == Some(b);
        let counts = |edge: &Edge| !is_child(edge.from, edge.to) && !is_child(edge.to, edge.from);
        circles(self.edges().into_iter().filter(counts).collect())
    }

    /// Circles among the modules of the root, each with all that is below it; see [`Self::circles`].
    #[must_use]
    pub fn circles_of_folders(&self) -> Vec<Vec<Edge>> {
        circles(self.edges_of_folders())
    }

    /// Needs among the modules of the root, each with all that is below it; the root itself is none of them.
    #[must_use]
    pub fn edges_of_folders(&self) -> Vec<Edge> {
        let folder = |module: usize| {
            let first = self.modules[module].path.first()?;
            self.children.get(&(0, first.clone())).copied()
        };
        let lifted = |edge: Edge| {
            let (from, to) = (folder(edge.from)?, folder(edge.to)?);
            let file = self.modules[edge.from].file.display();
            let written = format!("{} ({file})", edge.written);
            (from != to).then_some(Edge { from, to, written, ..edge })
        };
        self.edges().into_iter().filter_map(lifted).collect()
    }
}

/// The edges inside groups in which each reaches each.
fn circles(edges: Vec<Edge>) -> Vec<Vec<Edge>> {
    let mut next: BTreeMap<usize, BTreeSet<usize>> = BTreeMap::new();
    for edge in &edges {
        next.entry(edge.from).or_default().insert(edge.to);
    }
    let reached = |from: usize| {
        let mut reached = BTreeSet::new();
        let mut open = vec![from];
        while let Some(at) = open.pop() {
            open.extend(next.get(&at).into_iter().flatten().filter(|&&to| reached.insert(to)));
        }
        reached
    };
    let reach: BTreeMap<usize, BTreeSet<usize>> = next.keys().map(|&from| (from, reached(from))).collect();
    let reaches = |a: usize, b: usize| reach.get(&a).is_some_and(|reached| reached.contains(&b));
    let mut groups: BTreeMap<usize, Vec<Edge>> = BTreeMap::new();
    for edge in edges {
        if reaches(edge.to, edge.from) {
            // The first of the group stands for it.
            let members = reach.get(&edge.from).into_iter().flatten().filter(|&&to| reaches(to, edge.from));
            let first = members.min().copied().unwrap_or(edge.from);
            groups.entry(first).or_default().push(edge);
        }
    }
    groups.into_values().collect()
}

/// Kind, name and visibility of an item that has a name.
#[must_use]
pub fn name_of(item: &Item) -> Option<(&'static str, String, Option<&Visibility>)> {
    Some(match item {
        Item::Const(item) => ("const", item.ident.to_string(), Some(&item.vis)),
        Item::Enum(item) => ("enum", item.ident.to_string(), Some(&item.vis)),
        Item::Fn(item) => ("fn", item.sig.ident.to_string(), Some(&item.vis)),
        Item::Macro(item) => ("macro", item.ident.as_ref()?.to_string(), None),
        Item::Static(item) => ("static", item.ident.to_string(), Some(&item.vis)),
        Item::Struct(item) => ("struct", item.ident.to_string(), Some(&item.vis)),
        Item::Trait(item) => ("trait", item.ident.to_string(), Some(&item.vis)),
        Item::Type(item) => ("type", item.ident.to_string(), Some(&item.vis)),
        Item::Union(item) => ("union", item.ident.to_string(), Some(&item.vis)),
        _ => return None,
    })
}
