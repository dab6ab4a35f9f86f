//! Comments and documentation.

use std::fs;
use std::path::{Path, PathBuf};

use piola_tidy::tokens::summaries;
use piola_tidy::{crates, files, files_with, forbid, members, read, root};
use quote::ToTokens;

/// First words of summaries that depend on the text above them or do not name the item, with a remedy.
const HEADLESS: [(&str, &str); 27] = [
    ("Whether", "`True if …`"),
    ("How many", "`Number of …`"),
    ("How", "a noun, such as `Length of …`, `Accuracy of …`"),
    ("What", "the noun for it"),
    ("Where", "`Position of …`, or `if` for a condition"),
    ("When", "`Time of …`"),
    ("Why", "`Reason why …`"),
    ("Which", "the noun for it"),
    ("Who", "the noun for it"),
    ("Whatever", "the noun for it"),
    ("The same", "the noun for it"),
    ("That of", "the noun again"),
    ("That", "the noun again"),
    ("Those", "the noun again"),
    ("One of them", "the noun again"),
    ("Of", "a noun before it"),
    ("As", "a noun or a verb before it"),
    ("By", "a noun or a verb before it"),
    ("From", "a noun or a verb before it"),
    ("To", "a noun or a verb before it"),
    ("With", "a noun or a verb before it"),
    ("Without", "a noun or a verb before it"),
    ("In the", "a noun before it"),
    ("In a", "a noun before it"),
    ("At the", "a noun before it"),
    ("It", "the noun for it"),
    ("They", "the noun for it"),
];

/// Phrases that readers of plain English stumble over, with a remedy; allowed between quotes or backticks.
const STUMBLING: [(&str, &str); 6] = [
    ("but for", "`except for`, `up to`"),
    ("caller's own", "`user-defined`, `of the caller`"),
    ("one's own", "`your own`, `user-defined`"),
    ("so many", "the name of the number"),
    ("as far as", "`if`, `where`, `within`"),
    ("in the place of", "`instead of`, or `replaces`"),
];

/// Words after `is no` with which it compares, and does not stand for `is not a`.
const COMPARATIVES: [&str; 14] = [
    "longer", "shorter", "more", "less", "fewer", "larger", "smaller", "greater", "farther", "nearer",
    "better", "worse", "faster", "slower",
];

/// In a search result or next to a cursor, a summary stands alone.
#[test]
fn summaries_make_sense_alone() {
    let mut found = Vec::new();
    for one in crates() {
        for module in &one.modules {
            let inner = module.attributes.iter().map(ToTokens::to_token_stream).collect();
            let items = module.items.iter().map(ToTokens::to_token_stream);
            for (line, summary) in items.chain([inner]).flat_map(summaries) {
                let begins = |(words, _): &&(&str, &str)| {
                    summary
                        .strip_prefix(words)
                        .is_some_and(|rest| !rest.starts_with(|c: char| c == '-' || c.is_alphanumeric()))
                };
                if let Some((words, remedy)) = HEADLESS.iter().find(begins) {
                    found.push(format!(
                        "{}:{line}: begins with `{words}`, write {remedy}: {summary}",
                        module.file.display()
                    ));
                }
            }
        }
    }
    found.sort();
    found.dedup();
    forbid("summaries that do not stand alone", &found);
}

/// Comments, documentation, texts of programs and documents are in plain technical English.
#[test]
fn words_are_plain() {
    let mut found = Vec::new();
    let documents = files_with("md", Path::new(""));
    assert!(documents.len() > 20, "{} documents", documents.len());
    for (path, text) in sources().into_iter().chain(documents) {
        let prose = Prose::of(&text);
        for (phrase, remedy) in STUMBLING {
            for line in prose.places(phrase, |_, _| true) {
                found.push(format!("{}:{line}: `{phrase}`, write {remedy}", path.display()));
            }
        }
        for verb in ["is", "are", "was", "were"] {
            let is_negation = |before: &str, after: &str| {
                !before.eq_ignore_ascii_case("there") && !COMPARATIVES.contains(&after)
            };
            for line in prose.places(&format!("{verb} no"), is_negation) {
                found.push(format!("{}:{line}: `{verb} no`, write `{verb} not`", path.display()));
            }
        }
    }
    found.sort();
    forbid("phrases that are not plain English", &found);
}

/// The words of a text, with the number of the line of each; marks of comments are left out.
struct Prose<'a>(Vec<(&'a str, usize)>);

impl<'a> Prose<'a> {
    fn of(text: &'a str) -> Self {
        let mut words = Vec::new();
        for (number, line) in text.lines().enumerate() {
            let line = line.trim_start().trim_start_matches(['/', '!', '>', '#']);
            words.extend(line.split_whitespace().filter(|word| *word != "\\").map(|word| (word, number + 1)));
        }
        Self(words)
    }

    /// Lines on which a phrase begins, if the words before and after it, without punctuation, satisfy a
    /// condition. Punctuation inside of a phrase, and a quote before it, make it another one.
    fn places(&self, phrase: &str, holds: impl Fn(&str, &str) -> bool) -> Vec<usize> {
        let wanted: Vec<&str> = phrase.split(' ').collect();
        let parts =
            |at: usize| self.0.get(at).map_or("", |(word, _)| word).split(|c: char| !c.is_alphanumeric());
        let before = |at: usize| parts(at.wrapping_sub(1)).rfind(|part| !part.is_empty()).unwrap_or_default();
        let after = |at: usize| parts(at).find(|part| !part.is_empty()).unwrap_or_default();
        let matches = |at: &usize| {
            let words = &self.0[*at..*at + wanted.len()];
            let (last, inner) = words.split_last().expect("a phrase has words");
            let begins = |(word, _): &(&str, usize), expected: &str| {
                word.strip_prefix(expected).is_some_and(|rest| !rest.starts_with(char::is_alphanumeric))
            };
            inner.iter().zip(&wanted).all(|((word, _), expected)| word.eq_ignore_ascii_case(expected))
                && begins(last, wanted[wanted.len() - 1])
                && holds(before(*at), after(*at + wanted.len()))
        };
        (0..(self.0.len() + 1).saturating_sub(wanted.len())).filter(matches).map(|at| self.0[at].1).collect()
    }
}

#[test]
fn phrases_are_found_across_lines_and_not_between_quotes() {
    let text = "/// A red\n/// hat. Not \"red hat\", nor `red hat`.\n// (\"No red hat, one red\n// hat.";
    let prose = Prose::of(text);
    assert_eq!(prose.places("red hat", |_, _| true), [1, 3, 3]);
    assert_eq!(prose.places("red hat", |before, after| before == "No" && after == "one"), [3]);
}

/// As wide as rustfmt makes code; what cannot be broken, such as an address or a row of a table, may be
/// wider.
#[test]
fn comments_are_as_wide_as_code() {
    let configuration = read(Path::new("rustfmt.toml"));
    let width = configuration.lines().find_map(|line| line.strip_prefix("max_width = "));
    let width: usize = width.and_then(|width| width.parse().ok()).expect("max_width in rustfmt.toml");
    let mut found = Vec::new();
    for (path, text) in sources() {
        let mut is_displayed = false;
        for (number, line) in text.lines().enumerate() {
            let Some(words) = comment(line).map(|words| words.trim_start_matches(['/', '!']).trim()) else {
                continue;
            };
            is_displayed ^= words.starts_with("```");
            let columns = line.chars().count();
            // Lines of a display, such as a formula or a program, are not broken.
            let can_be_broken =
                !is_displayed && words.contains(' ') && !words.starts_with('|') && !words.starts_with('[');
            if columns > width && can_be_broken {
                found.push(format!("{}:{}: {columns} columns", path.display(), number + 1));
            }
        }
    }
    forbid("comments that are wider than code", &found);
}

/// The comment that a line ends with, unless it is a part of a text.
fn comment(line: &str) -> Option<&str> {
    let (code, comment) = line.match_indices("//").map(|(at, _)| line.split_at(at)).next()?;
    (code.matches('"').count() % 2 == 0).then_some(comment)
}

#[test]
fn nothing_is_left_undone() {
    let mut found = Vec::new();
    for (path, text) in sources() {
        for (number, line) in text.lines().enumerate() {
            if [["TO", "DO"], ["FIX", "ME"]].iter().any(|mark| line.contains(&mark.concat())) {
                found.push(format!("{}:{}: {}", path.display(), number + 1, line.trim()));
            }
        }
    }
    forbid("marks of what is left undone", &found);
}

/// All Rust files of the workspace, each once, and those of the crates outside of it.
fn sources() -> Vec<(PathBuf, String)> {
    let mut found: Vec<_> = members().iter().flat_map(|folder| files(folder)).collect();
    found.extend(files(Path::new("fuzz/fuzz_targets")));
    found.extend(
        ["distributed", "bindings/c", "bindings/python", "bindings/web", "examples/fenris", "examples/wgpu"]
            .iter()
            .flat_map(|folder| files(Path::new(folder))),
    );
    found.sort();
    found.dedup();
    found
}

/// Relative links of the repository's documents lead to files.
#[test]
fn links_of_documents_lead_to_files() {
    let mut found = Vec::new();
    let mut judged = 0;
    for folder in ["", "docs", "tests"] {
        for entry in fs::read_dir(root().join(folder)).expect("a folder of the repository") {
            let document = entry.expect("an entry").path();
            if document.extension().is_none_or(|extension| extension != "md") {
                continue;
            }
            let text = fs::read_to_string(&document).expect("a document");
            for link in text.split("](").skip(1).filter_map(|rest| rest.split_once(')')).map(|(link, _)| link)
            {
                judged += 1;
                let file = link.split('#').next().unwrap_or_default();
                if !file.contains("://") && !document.with_file_name(file).exists() {
                    found.push(format!("{}: {link}", document.display()));
                }
            }
        }
    }
    forbid("links that lead nowhere", &found);
    assert!(judged > 5, "{judged} links");
}

/// The README shows a program that the test target `readme` of `piola-tests` compiles and runs.
#[test]
fn the_readme_shows_the_example() {
    let (readme, example) =
        (read(Path::new("README.md")), read(Path::new("materials/examples/own_energy.rs")));
    let (_, rest) = readme.split_once("```rust\n").expect("a Rust block in the README");
    let (shown, _) = rest.split_once("```").expect("the end of the block");
    assert_eq!(shown, example, "README.md and materials/examples/own_energy.rs differ");
}

/// The first table of `docs/embedding.md` quotes lines of files that it links to, and that are tested.
#[test]
fn lines_to_embed_piola_are_quoted() {
    let without_spaces = |text: &str| -> String { text.split_whitespace().collect() };
    let document = read(Path::new("docs/embedding.md"));
    let (mut found, mut judged) = (Vec::new(), 0);
    let rows = document.lines().skip_while(|line| !line.starts_with('|')).skip(2);
    for row in rows.take_while(|line| line.starts_with('|')) {
        let cells: Vec<&str> = row.split(" | ").collect();
        let [_, lines, files] = cells[..] else { panic!("three columns: {row}") };
        let files = files.split("](").skip(1).filter_map(|rest| rest.split_once(')'));
        let text: String =
            files.map(|(file, _)| without_spaces(&read(&Path::new("docs").join(file)))).collect();
        for line in lines.split('`').skip(1).step_by(2) {
            judged += 1;
            if !text.contains(&without_spaces(line)) {
                found.push(line.to_owned());
            }
        }
    }
    forbid("lines of docs/embedding.md that none of the linked files has", &found);
    assert!(judged > 15, "{judged} lines");
}
