//! What a host can instantiate.

use std::ffi::CString;
use std::fs;
use std::path::Path;

use mcm::fmi::Package;
use mcm::fmi::value::{DataType, Value};
use mcm::fmi::variable::{Causality, Variable};

/// Scenes of every kind: rings and none, stop, backbone, every level of interaction, few segments and many.
/// The first are quick to build and to solve, the next still short.
const SCENES: [&str; 7] = [
    "[design]\nsegments = 1\n[model]\nbending_stop = true\ninteraction = \"rings\"",
    "[design]\nsegments = 1\nbase_magnet = false\n[model]\ninteraction = \"none\"",
    "[design]\nsegments = 1\n[field]\nuniform_mt = [0.0, 10.0, 0.0]\n[model]\ninteraction = \"preceding\"",
    "[design]\nsegments = 2\nbase_magnet = false\n[design.backbone]\nouter_radius_mm = 0.7\ninner_radius_mm = 0.25\n\
     shore_a = 50.0\npoisson = 0.4\n[model]\ninteraction = \"full\"",
    "[design]\nsegments = 1",
    "[design]\nkind = \"cylinder\"\nlength_mm = 20.0\nradius_mm = 1.0\nshore_a = 33.0",
    "[design]\nsegments = 9",
];

/// How many of them are quick, and how many short or quick.
pub(crate) const QUICK: usize = 2;
pub(crate) const SHORT: usize = 6;

/// A packed design with its unpacked resources; of its variables the references by type and causality.
pub(crate) struct Design {
    pub(crate) guid: CString,
    pub(crate) location: CString,
    /// By reference: the start value, or 0.
    pub(crate) starts: Vec<f64>,
    pub(crate) inputs: Vec<u32>,
    pub(crate) parameters: Vec<u32>,
    pub(crate) outputs: Vec<u32>,
    pub(crate) integers: Vec<u32>,
    pub(crate) booleans: Vec<u32>,
}

impl Design {
    /// Every design, unpacked into `folder`.
    pub(crate) fn all(folder: &Path) -> Vec<Self> {
        let scenes = (0..).zip(SCENES);
        scenes
            .map(|(number, scene)| Self::unpacked(scene, &folder.join(format!("100% {number} ü"))))
            .collect()
    }

    fn unpacked(scene: &str, folder: &Path) -> Self {
        let package = Package::new(scene, "hostile scene", 3).unwrap();
        fs::create_dir_all(folder).unwrap();
        for (name, text) in package.resources().unwrap() {
            fs::write(folder.join(name), text).unwrap();
        }
        let variables = package.table().variables();
        let of = |real: bool, listed: fn(&Variable) -> bool| {
            let fits = |row: &usize| {
                listed(&variables[*row]) && matches!(variables[*row].data_type, DataType::Real(_)) == real
            };
            (0..variables.len()).filter(fits).map(|row| u32::try_from(row).unwrap()).collect::<Vec<_>>()
        };
        let start = |row: usize| match variables[row].host_value(package.start()) {
            Some(Value::Real(value)) => value,
            _ => 0.0,
        };
        let others = of(false, |_| true);
        let is_boolean =
            |&reference: &u32| matches!(variables[reference as usize].data_type, DataType::Boolean);
        let (booleans, integers) = others.into_iter().partition(is_boolean);
        Self {
            guid: CString::new(package.guid()).unwrap(),
            location: CString::new(format!("file://{}", folder.display())).unwrap(),
            starts: (0..variables.len()).map(start).collect(),
            inputs: of(true, |variable| variable.causality == Causality::Input),
            parameters: of(true, |variable| variable.causality == Causality::Parameter),
            outputs: of(true, Variable::is_result),
            integers,
            booleans,
        }
    }

    /// What a variable starts with; 0 for a reference that is none.
    pub(crate) fn start(&self, reference: u32) -> f64 {
        self.starts.get(reference as usize).copied().unwrap_or_default()
    }
}
