//! The command `piola`; `piola_cli::main` does its work.

fn main() -> std::process::ExitCode {
    piola_cli::main()
}
