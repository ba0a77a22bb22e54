//! Parses the command line and hands over.

fn main() -> std::process::ExitCode {
    ehl_explorer::cli::main(|scene| ehl_explorer::app::run(scene).map_err(|refusal| refusal.to_string()))
}
