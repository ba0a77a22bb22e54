//! Parses the command line and hands over.

fn main() -> std::process::ExitCode {
    ehl_explorer::cli::main(ehl_explorer::app::run)
}
