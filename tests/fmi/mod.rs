//! Tests of `fmi`.

mod derivatives;

mod description;

mod endings;

mod importer;

mod instance;

mod log;

mod model_exchange;

mod package;

mod refused;

mod serialise;

mod sources;

mod state;

mod table;

mod unknowns;

mod vessel;

use std::sync::{Arc, Mutex};

use mcm::fmi::log::Log;
use mcm::fmi::state::Interface;
use mcm::fmi::{Instance, Package};

/// One segment in a uniform field: quick to solve, and bent.
const BENT: &str =
    "[design]\nsegments = 1\n[field]\nuniform_mt = [0.0, 10.0, 0.0]\n[model]\ninteraction = \"none\"";

/// What an instance has told its host.
pub(crate) type Told = Arc<Mutex<Vec<String>>>;

/// An instance of a scene with five shape points, and its log.
fn instance(scene: &str) -> (Instance, Package, Told) {
    instance_of(Package::new(scene, "test scene", 5).unwrap())
}

/// An instance of a package, and its log.
pub(crate) fn instance_of(package: Package) -> (Instance, Package, Told) {
    instance_for(Interface::CoSimulation, package)
}

/// An instance of a package for an interface, and its log.
fn instance_for(interface: Interface, package: Package) -> (Instance, Package, Told) {
    let told = Told::default();
    let sink = Arc::clone(&told);
    let log = Log::new(
        Box::new(move |_, category, message| {
            sink.lock().unwrap().push(format!("{}: {message}", category.name()));
        }),
        false,
    );
    (Instance::new(interface, Arc::new(package.clone()), log), package, told)
}

/// The last message.
fn last(told: &Told) -> String {
    told.lock().unwrap().last().cloned().unwrap_or_default()
}
