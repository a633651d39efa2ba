//! `gonio completion`.

use super::{
    arguments::{Arguments, CompletionOptions, ShellArgument},
    messages::print,
};
use clap::CommandFactory;
use clap_complete::{Shell, generate};
use gonio::Result;

/// Writes the shell's script to standard output.
pub(super) fn completion(options: &CompletionOptions) -> Result<i32> {
    let shell = match options.shell {
        ShellArgument::Bash => Shell::Bash,
        ShellArgument::Zsh => Shell::Zsh,
        ShellArgument::Fish => Shell::Fish,
    };
    // In one piece: a reader that leaves early must not break the generator off.
    let mut script = Vec::new();
    generate(shell, &mut Arguments::command(), "gonio", &mut script);
    print(String::from_utf8_lossy(&script).trim_end());
    Ok(0)
}
