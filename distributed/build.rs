//! Bindings to the functions of PETSc that `src/petsc.rs` calls, generated from its headers: the widths of
//! integers and the values of enumerations are those of the PETSc that is linked.

#![expect(clippy::print_stderr, reason = "a build script reports errors in this way")]

use std::collections::BTreeSet;
use std::env;
use std::fs;
use std::io;
use std::path::PathBuf;
use std::process::exit;

const ADVICE: &str = "on Debian: apt-get install -y --no-install-recommends gcc libc6-dev pkg-config libclang-dev \
                      petsc-dev libopenmpi-dev openmpi-bin";

/// Advice against two versions of clang: bindgen loads the newest libclang that it finds, with the headers of
/// the program `clang`.
const VERSIONS: &str = "if the header at fault is one of clang's own, several versions of clang are installed: set \
                        LIBCLANG_PATH to the folder of the libclang that belongs to `clang`";

/// Words after `ffi::` in the sources of the interface: the functions of PETSc among them are bound.
fn names() -> io::Result<BTreeSet<String>> {
    let mut files = vec![PathBuf::from("src/petsc.rs")];
    for entry in fs::read_dir("src/petsc")? {
        files.push(entry?.path());
    }
    let mut names = BTreeSet::new();
    for file in files {
        for rest in fs::read_to_string(file)?.split("ffi::").skip(1) {
            let name: String = rest.chars().take_while(|&c| c.is_ascii_alphanumeric() || c == '_').collect();
            names.insert(name);
        }
    }
    // After `ffi::{` in an import.
    names.remove("");
    Ok(names)
}

fn main() {
    for source in ["build.rs", "src/petsc.rs", "src/petsc"] {
        println!("cargo:rerun-if-changed={source}");
    }
    let names = names().unwrap_or_else(|error| {
        eprintln!("src/petsc: {error}");
        exit(1);
    });
    let library = pkg_config::Config::new().atleast_version("3.18").probe("PETSc").unwrap_or_else(|error| {
        eprintln!(
            "PETSc 3.18 or later is not installed, or pkg-config does not find it: {ADVICE}\n\n{error}"
        );
        exit(1);
    });
    let mpi = pkg_config::Config::new()
        .cargo_metadata(false)
        .probe("mpi-c")
        .or_else(|_| pkg_config::Config::new().cargo_metadata(false).probe("mpi"));
    let folders = library.include_paths.iter().chain(mpi.iter().flat_map(|mpi| &mpi.include_paths));
    let bindings = names
        .iter()
        .fold(bindgen::Builder::default(), |builder, name| builder.allowlist_function(name))
        .header_contents("petsc_functions.h", "#include <petscksp.h>\n")
        .clang_args(folders.map(|folder| format!("-I{}", folder.display())))
        .blocklist_type("MPI_Comm|ompi_communicator_t")
        .raw_line("use mpi::ffi::MPI_Comm;")
        .layout_tests(false)
        .generate_comments(false)
        .generate();
    let bindings = bindings.unwrap_or_else(|error| {
        eprintln!("the headers of PETSc and MPI cannot be read: {ADVICE}; {VERSIONS}\n\n{error}");
        exit(1);
    });
    let folder = PathBuf::from(env::var_os("OUT_DIR").unwrap_or_default());
    if let Err(error) = bindings.write_to_file(folder.join("petsc_functions.rs")) {
        eprintln!("{}: {error}", folder.display());
        exit(1);
    }
}
