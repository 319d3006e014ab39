//! The work of `fmi2Instantiate`.

use std::path::PathBuf;
use std::sync::Arc;

use super::super::bindings::{fmi2CallbackFunctions, fmi2Type};
use super::super::guard::guarded;
use super::super::instance::Instance;
use super::super::location;
use super::super::log::{Category, Log};
use super::super::package::identify;
use super::super::registry;
use super::super::state::{Ending, Interface};
use super::logger::Logger;
use super::memory::Flaw;

/// What the host passes to `fmi2Instantiate`.
pub(super) struct Arguments<'a> {
    pub(super) instance_name: Result<&'a str, Flaw>,
    pub(super) fmu_type: fmi2Type,
    pub(super) guid: Result<&'a str, Flaw>,
    pub(super) resource_location: Result<&'a str, Flaw>,
    pub(super) callbacks: Option<fmi2CallbackFunctions>,
    pub(super) logging_on: bool,
}

/// Makes an instance and returns its handle. If that fails, the host's logger is told why.
pub(super) fn instantiate(arguments: Arguments) -> Option<usize> {
    let logger = Logger::new(arguments.callbacks, arguments.instance_name.as_ref().unwrap_or(&""));
    let log = logger.clone();
    // This guard is inside that of the C function, because after a panic here there is a logger to be told.
    match guarded(|| make(arguments, log)).and_then(|made| made) {
        Ok(handle) => Some(handle),
        Err(reason) => {
            logger.tell(Ending::Error, Category::Error, &format!("not instantiated: {reason}"));
            None
        }
    }
}

fn make(arguments: Arguments, logger: Logger) -> Result<usize, String> {
    let name = arguments.instance_name.map_err(|flaw| format!("the instance name {flaw}"))?;
    if name.is_empty() {
        return Err("the instance name is empty".to_owned());
    }
    let interface = match arguments.fmu_type {
        fmi2Type::fmi2CoSimulation => Interface::CoSimulation,
        fmi2Type::fmi2ModelExchange => Interface::ModelExchange,
        fmi2Type(other) => {
            return Err(format!("FMI 2.0 has no FMU type {other}: 0 is model exchange, 1 co-simulation"));
        }
    };
    let guid = arguments.guid.map_err(|flaw| format!("the GUID {flaw}"))?;
    let location = match arguments.resource_location {
        Err(Flaw::Null) => Ok(""), // some hosts pass null when an archive has no resources
        location => location.map_err(|flaw| format!("the resource location {flaw}")),
    }?;
    let paths = location::paths(location).map_err(|error| error.to_string())?;
    let package =
        identify(guid, &paths).map_err(|error| with_location(&error.to_string(), location, &paths))?;
    let sink = Box::new(move |ending, category, message: &str| logger.tell(ending, category, message));
    let log = Log::new(sink, arguments.logging_on);
    Ok(registry::enter(Instance::new(interface, Arc::new(package), log)))
}

/// A reason for which no design was found, with what is wrong about the location of its resources.
///
/// A `file:` URI has an absolute path. Of a relative one with two slashes, as `file://unpacked/resources`, the first part is the name of a
/// host (RFC 8089, section 2).
fn with_location(reason: &str, location: &str, paths: &[PathBuf]) -> String {
    match location::named_host(location) {
        Some(host) if !paths.iter().any(|path| path.is_dir()) => format!(
            "{reason}; in {location}, {host} is the name of a host: a file URI is file:// and an absolute path"
        ),
        _ => reason.to_owned(),
    }
}
