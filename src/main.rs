//! Parses the command line and hands over.

use ehl_explorer::cli::NoWindow;

fn main() -> std::process::ExitCode {
    ehl_explorer::cli::main(|scene| ehl_explorer::app::run(scene).map_err(|refusal| NoWindow(refusal.to_string())))
}
