//! `wearlaw plan SCENE`: what a run would compute, what it would leave out and why.

use super::args::PlanArguments;
use super::console::Console;
use super::interrupt::Interrupt;
use super::run::prepared;
use crate::error::Error;
use crate::exit_code::ExitCode;

pub(super) fn command(console: &Console, arguments: PlanArguments) -> Result<ExitCode, Error> {
    let interrupt = Interrupt::watch();
    let (_scene, _law) = prepared(console, &interrupt, &arguments.scene, &arguments.shared)?;
    Err(Error::Fault { what: "`plan` is not connected to the planner".to_owned() })
}
