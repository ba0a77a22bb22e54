//! Opens the explorer.

use std::process::ExitCode;

fn main() -> ExitCode {
    match ehl_explorer::app::run(None) {
        Ok(()) => ExitCode::SUCCESS,
        Err(message) => {
            eprintln!("{message}");
            ExitCode::from(2)
        }
    }
}
