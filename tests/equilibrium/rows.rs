//! The rows of `statics_dev.json` as scenes.

use std::path::Path;

use mcm::design::{Design, Segmented, Specification, SpiralKind};
use mcm::equilibrium::{Equilibrium, Inputs, Interaction, PlacedSource, Settings};
use mcm::geometry::Pose;
use mcm::magnetics::{AxialMagnet, Cylinders, Source};
use nalgebra::Vector3;
use serde_json::Value;

use crate::tolerance::PAIRS;

/// One row of the table.
pub(crate) struct Row {
    pub(crate) id: String,
    /// The level's name in the table.
    pub(crate) level: String,
    pub(crate) segmented: Segmented,
    pub(crate) inputs: Inputs,
    pub(crate) magnet: Option<Source>,
    /// Size of the field where it is turned from +z to its direction.
    pub(crate) turned: Option<f64>,
    /// Angle of the field from +z, deg.
    pub(crate) field_angle: f64,
    pub(crate) outputs: Value,
}

/// All rows; stops on a missing, empty or torn table.
pub(crate) fn rows() -> Vec<Row> {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/reference/statics_dev.json");
    let text = std::fs::read_to_string(&path).unwrap_or_else(|error| panic!("{}: {error}", path.display()));
    let file: Value = serde_json::from_str(&text).expect("the table is JSON");
    let cases = file["cases"].as_array().expect("the table has cases");
    assert!(!cases.is_empty(), "the table is empty");
    cases.iter().map(Row::read).collect()
}

/// The row of that name.
pub(crate) fn row(id: &str) -> Row {
    rows().into_iter().find(|row| row.id == id).unwrap_or_else(|| panic!("{id} is not in the table"))
}

fn magnet_pair(diameter: f64, length: f64, gap: f64, remanence: f64) -> Source {
    let offset = 0.5 * (length + gap);
    let magnet =
        |offset| AxialMagnet { radius: 0.5 * diameter, inner_radius: 0.0, length, offset, remanence };
    Cylinders::new(vec![magnet(-offset), magnet(offset)]).expect("the reference pair is allowed").into()
}

/// The number at `key`, which must be one.
pub(crate) fn number(value: &Value, key: &str) -> f64 {
    value[key].as_f64().unwrap_or_else(|| panic!("{key} is not a number: {}", value[key]))
}

/// All numbers of a list.
pub(crate) fn list(value: &Value) -> Vec<f64> {
    let entries = value.as_array().unwrap_or_else(|| panic!("no list: {value}"));
    entries.iter().map(|entry| entry.as_f64().unwrap_or_else(|| panic!("no number: {entry}"))).collect()
}

/// A list of three numbers.
pub(crate) fn vector(value: &Value) -> Vector3<f64> {
    Vector3::from_row_slice(&list(value))
}

impl Row {
    fn read(case: &Value) -> Self {
        let (setup, given) = (&case["setup"], &case["inputs"]);
        let id = case["id"].as_str().expect("a row has a name").to_owned();
        let Specification::Segmented(paper) = Specification::paper(setup["S"].as_u64().expect("S") as usize)
        else {
            unreachable!("the paper's manipulator is segmented")
        };
        assert_eq!(setup["include_bonded_disc"], false, "{id}: bonded discs interact in no level of ours");
        let mut segmented = Segmented {
            base_magnet: setup["base_ring"].as_bool().expect("base_ring"),
            spiral: match setup["spiral"].as_str() {
                Some("helical") => SpiralKind::Helical,
                Some("axisymmetric") => SpiralKind::Axisymmetric,
                other => panic!("{id}: spiral {other:?}"),
            },
            ..paper
        };
        segmented.helix.density = given["rho_mpc"].as_f64();
        if let Some(density) = given["rho_ring"].as_f64() {
            segmented.ring.density = density;
        }
        let mut inputs = Inputs::unloaded(segmented.segments + usize::from(segmented.base_magnet));
        for (key, target) in [("B", &mut inputs.uniform_field), ("gravity", &mut inputs.gravity)] {
            if !given[key].is_null() {
                *target = vector(&given[key]);
            }
        }
        let pair = &given["magnet_pair"];
        let magnet = pair.is_object().then(|| {
            assert_eq!(list(&pair["axis"]), [0.0, 0.0, 1.0], "{id}");
            let up = number(pair, "polarity") > 0.0;
            let orientation = if up { [1.0, 0.0, 0.0, 0.0] } else { [0.0, 1.0, 0.0, 0.0] };
            let pose = Pose::new(vector(&pair["centre"]).into(), orientation).expect("a pose");
            inputs.sources = vec![PlacedSource { pose, strength: 1.0 }];
            let size = |key| number(pair, key);
            magnet_pair(size("diameter"), size("length_each"), size("gap"), size("Br"))
        });
        let turned = given["path"].as_str().map(|path| {
            assert_eq!(path, "rotated from +z", "{id}");
            number(given, "Bmag")
        });
        Self {
            level: setup["level"].as_str().expect("level").to_owned(),
            id,
            segmented,
            inputs,
            magnet,
            turned,
            field_angle: given["theta_deg"].as_f64().unwrap_or(f64::NAN),
            outputs: case["outputs"].clone(),
        }
    }

    /// The level, if this project has it.
    pub(crate) fn interaction(&self) -> Option<Interaction> {
        match self.level.as_str() {
            "none" => Some(Interaction::None),
            "rings" => Some(Interaction::Rings),
            "base" => Some(Interaction::Preceding),
            "full" => Some(Interaction::Full),
            _ => None,
        }
    }

    /// Whether the row is an equilibrium: all outputs, reached without a fold.
    pub(crate) fn is_equilibrium(&self) -> bool {
        self.outputs["alpha_deg"].is_f64()
    }

    /// Whether the row is an expected failure: its branch ends before its inputs are reached.
    pub(crate) fn is_lost(&self) -> bool {
        self.outputs["status"].is_string()
    }

    pub(crate) fn design(&self) -> Design {
        Design::new(Specification::Segmented(self.segmented.clone())).expect("the row's design is allowed")
    }

    /// The manipulator, unsolved, with the ring pairs integrated to the accuracy of the table.
    pub(crate) fn equilibrium(&self) -> Equilibrium {
        self.with(Settings::default())
    }

    /// The manipulator, unsolved, resolved more finely than a user's: for loads at which a shape loses its stability.
    pub(crate) fn refined(&self) -> Equilibrium {
        self.with(Settings { pair_accuracy: PAIRS, degree: 3, ..Settings::default() })
    }

    fn with(&self, settings: Settings) -> Equilibrium {
        let interaction = self.interaction().expect("a level that this project has");
        let settings = Settings { interaction, ..settings };
        Equilibrium::new(&self.design(), self.magnet.as_ref(), settings, 2).expect("allowed settings")
    }

    /// The inputs with the field `angle` degrees from +z towards +y.
    pub(crate) fn turned_to(&self, angle: f64) -> Inputs {
        let (sine, cosine) = angle.to_radians().sin_cos();
        let size = self.turned.expect("a row whose field is turned");
        Inputs { uniform_field: Vector3::new(0.0, sine, cosine) * size, ..self.inputs.clone() }
    }

    /// The inputs with the magnet's strength scaled.
    pub(crate) fn ramped_to(&self, strength: f64) -> Inputs {
        let mut inputs = self.inputs.clone();
        inputs.sources[0].strength = strength;
        inputs
    }
}
