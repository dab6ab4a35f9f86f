//! Sources of the workspace as trees of modules and as tokens, for the tests of the rules that they follow.
//!
//! Nothing of piola is needed to read it, so these tests compile in seconds.

use std::fmt;
use std::fs;
use std::path::{Path, PathBuf};

use proc_macro2::{Delimiter, Ident, TokenStream, TokenTree};
use quote::ToTokens;
use syn::{Item, Visibility};

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

/// All libraries and programs of the workspace.
#[must_use]
pub fn crates() -> Vec<Crate> {
    let mut crates = Vec::new();
    let manifest = read(Path::new("Cargo.toml"));
    let (_, rest) = manifest.split_once("members = [").expect("members in Cargo.toml");
    let (members, _) = rest.split_once(']').expect("the end of members");
    for folder in members.split('"').skip(1).step_by(2).map(Path::new) {
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
        if attributes(&item).iter().any(is_for_tests) {
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

/// True of `#[cfg(test)]` and `#[cfg(all(test, …))]`.
fn is_for_tests(attribute: &TokenStream) -> bool {
    let tokens = tokens(attribute);
    let words: Vec<&str> = tokens.iter().map(|token| token.text.as_str()).collect();
    matches!(words[..], ["cfg", "(", "test", ..] | ["cfg", "(", "all", "(", "test", ..])
}

/// The attributes of an item, without their brackets.
#[must_use]
pub fn attributes(item: &Item) -> Vec<TokenStream> {
    let tokens: Vec<TokenTree> = item.to_token_stream().into_iter().collect();
    let attributes = tokens.chunks(2).map_while(|pair| match pair {
        [TokenTree::Punct(mark), TokenTree::Group(group)] if mark.as_char() == '#' => Some(group.stream()),
        _ => None,
    });
    attributes.collect()
}

/// Name of an item that has one, and true if it is `pub`.
#[must_use]
pub fn name_of(item: &Item) -> Option<(&Ident, bool)> {
    let (name, visibility) = match item {
        Item::Const(item) => (&item.ident, &item.vis),
        Item::Enum(item) => (&item.ident, &item.vis),
        Item::Fn(item) => (&item.sig.ident, &item.vis),
        Item::Macro(item) => return Some((item.ident.as_ref()?, false)),
        Item::Static(item) => (&item.ident, &item.vis),
        Item::Struct(item) => (&item.ident, &item.vis),
        Item::Trait(item) => (&item.ident, &item.vis),
        Item::Type(item) => (&item.ident, &item.vis),
        Item::Union(item) => (&item.ident, &item.vis),
        _ => return None,
    };
    Some((name, matches!(visibility, Visibility::Public(_))))
}

/// A word, a mark or a bracket of code.
pub struct Token {
    /// The token as written; a mark is a single character.
    pub text: String,
    /// Line in the file, from 1.
    pub line: usize,
}

/// The tokens of code in their order, those inside brackets and macros too. What is quoted becomes code of
/// others and is left out.
#[must_use]
pub fn tokens(code: impl ToTokens) -> Vec<Token> {
    let mut found = Vec::new();
    flatten(code.to_token_stream(), &mut found);
    found
}

fn flatten(code: TokenStream, found: &mut Vec<Token>) {
    for tree in code {
        let line = tree.span().start().line;
        match tree {
            TokenTree::Group(group) => {
                let [open, close] = match group.delimiter() {
                    Delimiter::Parenthesis => ["(", ")"],
                    Delimiter::Brace => ["{", "}"],
                    Delimiter::Bracket => ["[", "]"],
                    Delimiter::None => ["", ""],
                };
                let is_quoted = matches!(&found[..], [.., name, mark]
                    if mark.text == "!" && ["quote", "quote_spanned"].contains(&name.text.as_str()));
                found.push(Token { text: open.to_owned(), line });
                if !is_quoted {
                    flatten(group.stream(), found);
                }
                found.push(Token { text: close.to_owned(), line });
            }
            tree => found.push(Token { text: tree.to_string(), line }),
        }
    }
}
