//! A folder in which commands are given, as in a shell.

#![allow(dead_code, reason = "each test program uses a part of it")]

use std::collections::BTreeMap;
use std::fs;
use std::path::PathBuf;
use std::process::{Command, Output};

use serde_json::Value;
use tempfile::TempDir;

/// A new folder in which commands are given.
pub(crate) struct Folder(TempDir);

impl Folder {
    pub(crate) fn new() -> Self {
        Self(tempfile::tempdir().expect("a scratch folder"))
    }

    pub(crate) fn path(&self, name: &str) -> PathBuf {
        self.0.path().join(name)
    }

    #[track_caller]
    pub(crate) fn write(&self, name: &str, content: impl AsRef<[u8]>) {
        fs::write(self.path(name), content).expect("a scratch file");
    }

    #[track_caller]
    pub(crate) fn read(&self, name: &str) -> String {
        fs::read_to_string(self.path(name)).expect(name)
    }

    /// Everything in a folder by name, with the content of files.
    #[track_caller]
    pub(crate) fn content(&self, folder: &str) -> BTreeMap<String, Vec<u8>> {
        let entries =
            fs::read_dir(self.path(folder)).expect("a folder").map(|entry| entry.expect("an entry"));
        let name = |entry: &fs::DirEntry| entry.file_name().into_string().expect("UTF-8");
        entries.map(|entry| (name(&entry), fs::read(entry.path()).unwrap_or_default())).collect()
    }

    /// The summary of the run in a folder.
    #[track_caller]
    pub(crate) fn summary(&self, folder: &str) -> Value {
        serde_json::from_str(&self.read(&format!("{folder}/summary.json"))).expect("JSON")
    }

    /// The command with a line of arguments; quotes enclose an argument with spaces.
    pub(crate) fn command(&self, arguments: &str) -> Command {
        let mut command = Command::new(env!("CARGO_BIN_EXE_piola"));
        command.current_dir(self.0.path());
        for (index, part) in arguments.split('\'').enumerate() {
            match index % 2 {
                0 => command.args(part.split_whitespace()),
                _ => command.arg(part),
            };
        }
        command
    }

    pub(crate) fn piola(&self, arguments: &str) -> Output {
        self.command(arguments).output().expect("the command starts")
    }

    /// Standard output and standard error of a command that succeeds.
    #[track_caller]
    pub(crate) fn outputs(&self, arguments: &str) -> (String, String) {
        let output = self.piola(arguments);
        assert!(output.status.success(), "{arguments}: {}", stderr(&output));
        (String::from_utf8(output.stdout.clone()).expect("text"), stderr(&output))
    }

    /// Standard output of a command that succeeds.
    #[track_caller]
    pub(crate) fn answer(&self, arguments: &str) -> String {
        self.outputs(arguments).0
    }

    /// The message of a command that is refused with status 2, and has written nothing.
    #[track_caller]
    pub(crate) fn refusal(&self, arguments: &str) -> String {
        let before = self.content("");
        let output = self.piola(arguments);
        assert_eq!(output.status.code(), Some(2), "{arguments}: {}", stderr(&output));
        assert!(output.stdout.is_empty(), "{arguments} wrote to standard output");
        assert_eq!(self.content(""), before, "{arguments} wrote files");
        stderr(&output)
    }
}

pub(crate) fn stderr(output: &Output) -> String {
    String::from_utf8_lossy(&output.stderr).into_owned()
}

/// Asserts that all of these words are in a text.
#[track_caller]
pub(crate) fn assert_contains(text: &str, words: &[&str]) {
    for word in words {
        assert!(text.contains(word), "`{word}` is not in: {text}");
    }
}
