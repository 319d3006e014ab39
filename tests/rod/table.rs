//! The rows of `rod_benchmarks.csv`, and the rods and chains that they are about.

use std::path::Path;

use mcm::constants::VACUUM_PERMEABILITY;
use mcm::design::{Cylinder, CylinderMaterial, Design, Segmented, Specification};
use mcm::equilibrium::{Equilibrium, Inputs, Interaction, Report, Settings};

/// One number of the table.
#[derive(Debug, Clone)]
pub(crate) struct Benchmark {
    pub(crate) problem: String,
    pub(crate) parameters: String,
    pub(crate) quantity: String,
    pub(crate) value: f64,
}

/// What a test does with each problem; `None`: excluded, with the reason.
const PROBLEMS: [(&str, usize, Option<&str>); 8] = [
    ("elastica_tip_load", 9, None),
    ("hard_magnetic_elastica", 6, None),
    ("tip_dipole", 4, None),
    ("tip_dipole_snap", 2, None),
    ("chain_buckling", 3, None),
    ("greenhill", 1, None),
    ("rollup", 1, None),
    (
        "dipole_pair_softening",
        1,
        Some(
            "two point dipoles, moment and stiffness not stated: rings here are extended bodies, and their attraction \
             has its own tests against charged faces",
        ),
    ),
];

/// All rows; stops on a missing, empty or torn table.
pub(crate) fn benchmarks() -> Vec<Benchmark> {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/reference/rod_benchmarks.csv");
    let mut reader = csv::ReaderBuilder::new()
        .from_path(&path)
        .unwrap_or_else(|error| panic!("{}: {error}", path.display()));
    let rows: Vec<Benchmark> = reader
        .records()
        .map(|record| {
            let record = record.unwrap_or_else(|error| panic!("rod_benchmarks.csv: {error}"));
            Benchmark {
                problem: record[0].to_owned(),
                parameters: record[1].to_owned(),
                quantity: record[2].to_owned(),
                value: record[3].parse().unwrap_or_else(|_| panic!("no number: {record:?}")),
            }
        })
        .collect();
    assert!(!rows.is_empty(), "the table is empty");
    rows
}

/// The rows of one problem.
pub(crate) fn rows_of(problem: &str) -> Vec<Benchmark> {
    let rows: Vec<Benchmark> = benchmarks().into_iter().filter(|row| row.problem == problem).collect();
    assert!(!rows.is_empty(), "{problem} is not in the table");
    rows
}

#[test]
fn every_row_belongs_to_a_test_or_is_excluded_with_a_reason() {
    let rows = benchmarks();
    for (problem, count, _) in &PROBLEMS {
        assert_eq!(rows.iter().filter(|row| row.problem == *problem).count(), *count, "{problem}");
    }
    let named: usize = PROBLEMS.iter().map(|(_, count, _)| count).sum();
    assert_eq!(named, rows.len(), "a problem that no test knows");
    let excluded: Vec<_> =
        PROBLEMS.iter().filter_map(|(problem, _, reason)| Some((problem, (*reason)?))).collect();
    println!("excluded: {excluded:?}");
}

impl Benchmark {
    /// The number after `name=` among the parameters.
    pub(crate) fn parameter(&self, name: &str) -> f64 {
        let found =
            self.parameters.split_whitespace().find_map(|part| part.strip_prefix(name)?.strip_prefix('='));
        found.and_then(|text| text.parse().ok()).unwrap_or_else(|| panic!("{name} in {self:?}"))
    }
}

/// A rod so slender (length over radius 1e4) that it neither stretches nor shears: by 1e-8 of its bending.
pub(crate) struct Rod {
    pub(crate) equilibrium: Equilibrium,
    pub(crate) length: f64,
    /// Bending stiffness, N m2.
    pub(crate) bending: f64,
    /// Magnetic moment, A m2.
    pub(crate) moment: f64,
    /// Mass per length, kg/m.
    pub(crate) line_mass: f64,
}

impl Rod {
    pub(crate) fn slender() -> Self {
        let (length, radius, remanence, density) = (0.1, 1e-5, 1.0, 1000.0);
        let material = CylinderMaterial::Bulk { elastic_modulus: 1e9, poisson: 0.0, remanence };
        let rod = Cylinder { length, radius, inner_radius: 0.0, material, density: Some(density) };
        let design = Design::new(Specification::Cylinder(rod)).expect("allowed");
        let settings = Settings {
            interaction: Interaction::None,
            degree: 4,
            cylinder_elements: 16,
            ..Settings::default()
        };
        let area = core::f64::consts::PI * radius * radius;
        Self {
            equilibrium: Equilibrium::new(&design, None, settings, 2).expect("allowed"),
            length,
            bending: 1e9 * area * radius * radius / 4.0,
            moment: remanence * area * length / VACUUM_PERMEABILITY,
            line_mass: density * area,
        }
    }

    pub(crate) fn solve(&mut self, inputs: &Inputs) -> Report {
        let report = self.equilibrium.solve(inputs).expect("finite inputs");
        assert!(report.solved(), "{report:?}");
        report
    }
}

/// A chain of `segments` in which only the rings are magnetic, without the base's: each is a dipole at a core's end
/// for a uniform field.
pub(crate) struct Chain {
    pub(crate) equilibrium: Equilibrium,
    pub(crate) rings: usize,
    /// Field at which `Lam` is one, T: a segment's bending stiffness over a ring's moment.
    pub(crate) unit_field: f64,
}

impl Chain {
    pub(crate) fn new(segments: usize) -> Self {
        let Specification::Segmented(paper) = Specification::paper(segments) else { unreachable!() };
        let mut chain = Segmented { base_magnet: false, ..paper };
        chain.helix.particle_remanence = 0.0;
        let design = Design::new(Specification::Segmented(chain)).expect("allowed");
        let compliance: f64 =
            design.segments()[0].spans.iter().map(|span| span.length / span.stiffness.bending).sum();
        let moment = design.rings().next().expect("a ring").moment();
        let settings = Settings { interaction: Interaction::None, ..Settings::default() };
        Self {
            equilibrium: Equilibrium::new(&design, None, settings, 2).expect("allowed"),
            rings: segments,
            unit_field: 1.0 / (moment * compliance),
        }
    }
}
