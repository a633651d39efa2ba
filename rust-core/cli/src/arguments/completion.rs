//! What `gonio completion` takes.

use clap::{Args, ValueEnum};

#[derive(Args, Debug)]
pub(crate) struct CompletionOptions {
    /// The shell.
    #[arg(value_enum)]
    pub(crate) shell: ShellArgument,
}

#[derive(Clone, Copy, Debug, ValueEnum)]
pub(crate) enum ShellArgument {
    /// GNU Bash.
    Bash,
    /// Z shell.
    Zsh,
    /// fish.
    Fish,
}
