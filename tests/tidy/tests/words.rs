//! Comments and documentation.

use std::fs;
use std::path::Path;

use piola_tidy::{files, forbid, read, root};

/// As wide as rustfmt makes code; what cannot be broken, such as an address or a row of a table, may be
/// wider.
#[test]
fn comments_are_as_wide_as_code() {
    let configuration = read(Path::new("rustfmt.toml"));
    let width = configuration.lines().find_map(|line| line.strip_prefix("max_width = "));
    let width: usize = width.and_then(|width| width.parse().ok()).expect("max_width in rustfmt.toml");
    let mut found = Vec::new();
    for (path, text) in files(Path::new("")) {
        let wide = too_wide(&text, width);
        found.extend(wide.map(|(line, columns)| format!("{}:{line}: {columns} columns", path.display())));
    }
    forbid("comments that are wider than code", &found);
}

/// Number and columns of each line that ends with too wide a comment.
fn too_wide(text: &str, width: usize) -> impl Iterator<Item = (usize, usize)> {
    let mut is_displayed = false;
    (1..).zip(text.lines()).filter_map(move |(number, line)| {
        let words = comment(line)?.trim_start_matches(['/', '!']).trim();
        is_displayed ^= words.starts_with("```");
        let columns = line.chars().count();
        // Lines of a display, such as a formula or a program, are not broken.
        let can_be_broken = !is_displayed && words.contains(' ') && !words.starts_with(['|', '[']);
        (columns > width && can_be_broken).then_some((number, columns))
    })
}

#[test]
fn a_wide_comment_is_seen() {
    let text = [
        "// short",
        "let x = \"// a part of a text\";",
        "let x = 1; // as wide as this",
        "// [a]: b c d e f",
        "// cannot-be-broken",
        "//! ```",
        "//! a display of code",
    ];
    assert_eq!(too_wide(&text.join("\n"), 12).collect::<Vec<_>>(), [(3, 29)]);
}

/// The comment that a line ends with, unless it is a part of a text.
fn comment(line: &str) -> Option<&str> {
    let (code, comment) = line.match_indices("//").map(|(at, _)| line.split_at(at)).next()?;
    (code.matches('"').count() % 2 == 0).then_some(comment)
}

#[test]
fn nothing_is_left_undone() {
    let mut found = Vec::new();
    for (path, text) in files(Path::new("")) {
        for (number, line) in text.lines().enumerate() {
            if [["TO", "DO"], ["FIX", "ME"]].iter().any(|mark| line.contains(&mark.concat())) {
                found.push(format!("{}:{}: {}", path.display(), number + 1, line.trim()));
            }
        }
    }
    forbid("marks of what is left undone", &found);
}

fn links(text: &str) -> impl Iterator<Item = &str> {
    text.split("](").skip(1).filter_map(|rest| rest.split_once(')')).map(|(link, _)| link)
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
            for link in links(&text) {
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

/// Programs of documents are files that are compiled: the first is the test target `readme` of `piola-tests`.
#[test]
fn documents_show_programs_that_are_compiled() {
    let shows = |document: &str, before: &str, language: &str, program: &str| {
        let block = format!("{before}```{language}\n{}```\n", read(Path::new(program)));
        assert!(read(Path::new(document)).contains(&block), "{document} has another program than {program}");
    };
    shows("README.md", "", "rust", "materials/examples/own_energy.rs");
    shows("bindings/c/README.md", "", "c", "bindings/c/clients/example.c");
    shows("bindings/c/README.md", "", "cpp", "bindings/c/clients/example.cpp");
    let tutorial = "docs/your-first-material.md";
    let files =
        ["src/lib.rs", "tests/contract.rs", "examples/fit.rs", "examples/horse.rs", "examples/curve.rs"];
    for file in files {
        shows(tutorial, &format!("\n`{file}`:\n\n"), "rust", &format!("docs/biderman/{file}"));
    }
    assert_eq!(read(Path::new(tutorial)).matches("`:\n\n```rust\n").count(), files.len());
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
        let text: String =
            links(files).map(|file| without_spaces(&read(&Path::new("docs").join(file)))).collect();
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
