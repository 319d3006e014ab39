//! The tables of `tests/reference`, and the sources that they were computed for.

use std::path::PathBuf;

use mcm::magnetics::AxialSource;
use nalgebra::Vector3;

/// One row: a point and the numbers that belong to it.
pub(crate) struct Row<const N: usize> {
    pub(crate) point: Vector3<f64>,
    pub(crate) values: [f64; N],
}

/// All rows of a table whose first three columns are the point; stops on a missing, empty or torn table.
pub(crate) fn table<const N: usize>(file: &str) -> Vec<Row<N>> {
    let path: PathBuf = [env!("CARGO_MANIFEST_DIR"), "tests", "reference", file].iter().collect();
    let mut reader = csv::Reader::from_path(&path).unwrap_or_else(|error| panic!("{file}: {error}"));
    let rows: Vec<Row<N>> = reader
        .records()
        .map(|record| {
            let record = record.unwrap_or_else(|error| panic!("{file}: {error}"));
            let numbers: Vec<f64> = record
                .iter()
                .map(|text| text.trim().parse().unwrap_or_else(|_| panic!("{file}: {text} is not a number")))
                .collect();
            assert_eq!(numbers.len(), 3 + N, "{file}: columns");
            Row {
                point: Vector3::new(numbers[0], numbers[1], numbers[2]),
                values: core::array::from_fn(|i| numbers[3 + i]),
            }
        })
        .collect();
    assert!(!rows.is_empty(), "{file} is empty");
    rows
}

/// The ring of `ring_field_dev.csv`: 4 mm by 1.5 mm by 1 mm, 1.35 T.
pub(crate) fn ring() -> AxialSource {
    AxialSource::new(0.75e-3, 2.0e-3, 1.0e-3, 1.35).expect("the reference ring is allowed")
}
