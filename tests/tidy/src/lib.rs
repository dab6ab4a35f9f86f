//! Sources of the workspace as trees of modules, for the tests of the rules that they follow.
//!
//! Nothing of piola is needed to read it, so these tests compile in seconds.

use std::fmt;
use std::fs;
use std::path::{Path, PathBuf};

use proc_macro2::TokenStream;
use syn::{Attribute, Item};

pub mod imports;
pub mod tokens;

/// Root folder of the workspace.
#[must_use]
pub fn root() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../..")
}

/// A library or program of the workspace, without what is compiled for tests only.
pub struct Crate {
    /// Name by which Rust code imports it.
    pub name: String,
    /// True if it is published to a registry.
    pub is_published: bool,
    /// Its modules, the root first, parents before their children.
    pub modules: Vec<Module>,
}

/// A module of a [`Crate`].
pub struct Module {
    /// Names from the root of the crate, which itself has none.
    pub path: Vec<String>,
    /// File below [`root`].
    pub file: PathBuf,
    /// Index of the module around it.
    pub parent: Option<usize>,
    /// Items other than modules.
    pub items: Vec<Item>,
}

impl fmt::Display for Module {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        if self.path.is_empty() { f.write_str("crate") } else { f.write_str(&self.path.join("::")) }
    }
}

/// Folders of the members of the workspace, from its manifest.
#[must_use]
pub fn members() -> Vec<PathBuf> {
    let manifest = read(Path::new("Cargo.toml"));
    let (_, rest) = manifest.split_once("members = [").expect("members in Cargo.toml");
    let (list, _) = rest.split_once(']').expect("the end of members");
    list.split('"').skip(1).step_by(2).map(PathBuf::from).collect()
}

/// All libraries and programs of the workspace.
#[must_use]
pub fn crates() -> Vec<Crate> {
    let mut crates = Vec::new();
    for folder in members() {
        let manifest = read(&folder.join("Cargo.toml"));
        let package = manifest.lines().find_map(|line| line.strip_prefix("name = ")).expect("a name");
        let name = package.trim_matches('"').replace('-', "_");
        let is_published = !manifest.contains("publish = false");
        for (file, name) in [("src/lib.rs", name.clone()), ("src/main.rs", format!("{name} (program)"))] {
            let file = folder.join(file);
            if root().join(&file).exists() {
                let mut modules = Vec::new();
                load(&mut modules, Vec::new(), None, file);
                crates.push(Crate { name, is_published, modules });
            }
        }
    }
    assert!(crates.len() >= 8, "the workspace has more crates than {}", crates.len());
    crates
}

/// Rust files in a folder below [`root`], with their text, except for hidden folders and those of builds.
#[must_use]
pub fn files(folder: &Path) -> Vec<(PathBuf, String)> {
    let mut found = Vec::new();
    let mut folders = vec![folder.to_owned()];
    while let Some(folder) = folders.pop() {
        for entry in fs::read_dir(root().join(&folder)).expect("a folder of the workspace") {
            let name = entry.expect("an entry").file_name();
            let path = folder.join(&name);
            if root().join(&path).is_dir() {
                let is_hidden = name.to_string_lossy().starts_with('.');
                if !is_hidden && name != "target" && name != "node_modules" {
                    folders.push(path);
                }
            } else if path.extension().is_some_and(|extension| extension == "rs") {
                let text = read(&path);
                found.push((path, text));
            }
        }
    }
    found.sort();
    found
}

/// Text of a file below [`root`].
#[must_use]
pub fn read(file: &Path) -> String {
    fs::read_to_string(root().join(file)).unwrap_or_else(|error| panic!("{}: {error}", file.display()))
}

/// Fails with a list of places unless it is empty.
#[track_caller]
pub fn forbid(what: &str, places: &[String]) {
    assert!(places.is_empty(), "{} {what}:\n{}", places.len(), places.join("\n"));
}

/// Adds the module in a file, and those that it declares.
fn load(modules: &mut Vec<Module>, path: Vec<String>, parent: Option<usize>, file: PathBuf) {
    let text = read(&file);
    let parsed = syn::parse_file(&text).unwrap_or_else(|error| panic!("{}: {error}", file.display()));
    let children = if parent.is_none() { file.with_file_name("") } else { file.with_extension("") };
    add(modules, path, parent, file, parsed.items, &children);
}

/// Adds a module; `children` is the folder of the files of its modules.
fn add(
    modules: &mut Vec<Module>,
    path: Vec<String>,
    parent: Option<usize>,
    file: PathBuf,
    items: Vec<Item>,
    children: &Path,
) {
    let here = modules.len();
    modules.push(Module { path: path.clone(), file: file.clone(), parent, items: Vec::new() });
    for item in items {
        if is_for_tests(attributes_of(&item)) {
            continue;
        }
        let Item::Mod(module) = item else {
            modules[here].items.push(item);
            continue;
        };
        let name = module.ident.to_string();
        let path: Vec<String> = path.iter().cloned().chain([name.clone()]).collect();
        match module.content {
            Some((_, items)) => add(modules, path, Some(here), file.clone(), items, &children.join(name)),
            None => load(modules, path, Some(here), children.join(format!("{name}.rs"))),
        }
    }
}

/// True if attributes contain `#[cfg(test)]` or `#[cfg(all(test, …))]`.
fn is_for_tests(attributes: &[Attribute]) -> bool {
    let condition = |attribute: &Attribute| attribute.meta.require_list().map(|list| list.tokens.clone());
    let conditions = attributes.iter().filter(|attribute| attribute.path().is_ident("cfg"));
    conditions.filter_map(|attribute| condition(attribute).ok()).any(|condition: TokenStream| {
        let text = condition.to_string();
        text == "test" || text.starts_with("all (test") || text.starts_with("all(test")
    })
}

/// Attributes of an item.
#[must_use]
pub fn attributes_of(item: &Item) -> &[Attribute] {
    match item {
        Item::Const(item) => &item.attrs,
        Item::Enum(item) => &item.attrs,
        Item::ExternCrate(item) => &item.attrs,
        Item::Fn(item) => &item.attrs,
        Item::Impl(item) => &item.attrs,
        Item::Macro(item) => &item.attrs,
        Item::Mod(item) => &item.attrs,
        Item::Static(item) => &item.attrs,
        Item::Struct(item) => &item.attrs,
        Item::Trait(item) => &item.attrs,
        Item::Type(item) => &item.attrs,
        Item::Union(item) => &item.attrs,
        Item::Use(item) => &item.attrs,
        _ => &[],
    }
}
