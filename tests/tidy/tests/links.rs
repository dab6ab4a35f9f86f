//! Links between the documents of the repository.

use std::fs;
use std::path::{Path, PathBuf};

use piola_tidy::{forbid, root};

#[test]
fn relative_links_lead_to_files() {
    let documents =
        ["", "docs", "tests", "cli", "laboratory", "macros", "macros/core", "materials", "runtime", "scenes"]
            .iter()
            .flat_map(|folder| fs::read_dir(root().join(folder)).expect("a folder of the repository"))
            .map(|entry| entry.expect("an entry").path())
            .filter(|path| path.extension().is_some_and(|extension| extension == "md"))
            .collect::<Vec<PathBuf>>();
    assert!(documents.len() > 10, "{documents:?}");
    let found: Vec<String> = documents.iter().flat_map(|document| dead_links(document)).collect();
    forbid("links that lead nowhere", &found);
}

/// Targets of a document's inline links, other than addresses on the web, that are no files.
fn dead_links(document: &Path) -> Vec<String> {
    let text = fs::read_to_string(document).expect("a document");
    let links = text.split("](").skip(1).filter_map(|rest| rest.split_once(')')).map(|(link, _)| link);
    links
        .filter(|link| {
            let file = link.split('#').next().unwrap_or_default();
            !file.contains("://") && !document.with_file_name(file).exists()
        })
        .map(|link| format!("{}: {link}", document.display()))
        .collect()
}
