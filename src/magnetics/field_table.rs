//! Tabulated field of a ring in front of and behind its faces: a cheaper approximation for thousands of points.

use core::f64::consts::PI;

use nalgebra::{Matrix3, Vector3};

use super::axial_source::AxialSource;
use super::axisymmetric::{Components, Meridian};

/// Number of nodes of a cell in each direction, for cubic polynomials.
const NODES: usize = 4;

/// Distance from a face, relative to the outer radius, where the table begins: closer to the edges, cells would be too
/// small.
const NEAREST: f64 = 0.3;

/// Number of layers, each twice as thick as the previous one: they end at 19 radii.
const LAYERS: usize = 6;

/// Number of cells through the thickness of a layer.
const ROWS: usize = 12;

/// Largest distance of a layer from the axis: factors of the outer radius and of the distance of its end from the face.
const ASIDE: (f64, f64) = (1.0, 0.75);

/// Size of the cells across a layer, relative to the distance of the nearest singularity from the real axis.
const LENGTH: f64 = 0.09;

/// `B_rho / rho`, `B_z`, `dB_rho/dz / rho` and `dB_z/dz`.
type Values = [f64; 4];

/// Field and gradient of a ring as piecewise polynomials in the distance from its face and the squared distance from
/// the axis.
///
/// They are interpolated separately: the gradient is not the derivative of the interpolated field, but as accurate as
/// the field, and both are discontinuous between cells by up to [`Self::ERROR`].
#[derive(Debug, Clone, PartialEq)]
pub struct FieldTable {
    half: f64,
    layers: Vec<Layer>,
}

/// Cells between two distances from the face.
#[derive(Debug, Clone, PartialEq)]
struct Layer {
    start: f64,
    end: f64,
    /// Largest squared distance from the axis, m2.
    aside: f64,
    /// Number of cells per metre and per square metre.
    density: [f64; 2],
    columns: usize,
    /// By row and column: coefficients of the powers of both local coordinates, with the distance as the last index.
    cells: Vec<[[Values; NODES]; NODES]>,
}

impl FieldTable {
    /// Largest relative error of field and gradient; it occurs where the gradient almost vanishes. The mean error is
    /// below 1e-5.
    pub const ERROR: f64 = 2e-4;

    /// Tabulates the field of `source`.
    ///
    /// ```
    /// use mcm::magnetics::{AxialSource, FieldTable};
    /// use nalgebra::Vector3;
    /// let ring = AxialSource::new(0.75e-3, 2.0e-3, 1.0e-3, 1.35)?;
    /// let table = FieldTable::new(&ring);
    /// let point = Vector3::new(1e-3, 0.0, 3e-3);
    /// let (field, _) = table.field_gradient(&point).unwrap_or_default();
    /// let exact = ring.field(&point)?;
    /// assert!((field - exact).norm() < FieldTable::ERROR * exact.norm());
    /// assert!(table.field_gradient(&Vector3::new(3e-3, 0.0, 0.0)).is_none()); // beside the ring
    /// # Ok::<(), mcm::error::Error>(())
    /// ```
    #[must_use]
    pub fn new(source: &AxialSource) -> Self {
        let start = |layer: usize| NEAREST * source.outer_radius() * f64::from(1_u32 << layer);
        let layers = (0..LAYERS).map(|layer| Layer::new(source, start(layer), start(layer + 1)));
        Self { half: 0.5 * source.length(), layers: layers.collect() }
    }

    /// `B` (T) and its gradient `dB_i/dx_j` (T/m) at a point (m) of the ring's frame; `None` outside the table.
    #[inline]
    #[must_use]
    pub fn field_gradient(&self, point: &Vector3<f64>) -> Option<(Vector3<f64>, Matrix3<f64>)> {
        let distance = point.z.abs() - self.half;
        let layer = self.layers.iter().find(|layer| distance < layer.end)?;
        let [radial, axial, radial_dz, axial_dz] =
            layer.at(distance, point.x * point.x + point.y * point.y)?;
        // Behind the ring, components that are odd in the height change their sign.
        let side = 1.0_f64.copysign(point.z);
        let components = Components {
            radial: side * radial,
            axial,
            radial_dz,
            axial_dz: side * axial_dz,
            ..Components::default()
        };
        let at = Meridian::of(point.x, point.y);
        Some((components.field(&at), components.gradient(&at)))
    }
}

impl Layer {
    fn new(source: &AxialSource, start: f64, end: f64) -> Self {
        let reach = ASIDE.0 * source.outer_radius() + ASIDE.1 * end;
        let aside = reach * reach;
        // As a function of the squared distance from the axis, the field of an edge of radius `a` is singular at
        // `(a +- i start)^2`.
        let edge = if source.inner_radius() > 0.0 { source.inner_radius() } else { source.outer_radius() };
        let columns = 1 + cell_of(aside / (LENGTH * (2.0 * edge + start) * start));
        let density = [ROWS as f64 / (end - start), columns as f64 / aside];
        let nodes = core::array::from_fn(|i| -0.5 * (PI * (i as f64 + 0.5) / NODES as f64).cos());
        let powers = powers(&nodes);
        let values = |row: usize, column: usize| {
            nodes.map(|x| {
                nodes.map(|y| {
                    let height = 0.5 * source.length() + start + (row as f64 + 0.5 + y) / density[0];
                    let rho = ((column as f64 + 0.5 + x) / density[1]).sqrt();
                    let jet = source.field_gradient(&Vector3::new(rho, 0.0, height)).unwrap_or_default();
                    [jet.0.x / rho, jet.0.z, jet.1.m13 / rho, jet.1.m33]
                })
            })
        };
        let cell = |row, column| {
            let by_node = values(row, column).map(|along| coefficients(&powers, &along));
            let across = |k: usize| coefficients(&powers, &by_node.map(|along| along[k]));
            let [c0, c1, c2, c3] = [across(0), across(1), across(2), across(3)];
            core::array::from_fn(|power| [c0[power], c1[power], c2[power], c3[power]])
        };
        let cells = (0..ROWS).flat_map(|row| (0..columns).map(move |column| (row, column)));
        let cells = cells.map(|(row, column)| cell(row, column)).collect();
        Self { start, end, aside, density, columns, cells }
    }

    #[inline]
    fn at(&self, distance: f64, rho2: f64) -> Option<Values> {
        if !(distance >= self.start && rho2 < self.aside) {
            return None;
        }
        let (along, across) = ((distance - self.start) * self.density[0], rho2 * self.density[1]);
        // Rounding may lead past the last cell: then the last cell is used.
        let (row, column) = (cell_of(along).min(ROWS - 1), cell_of(across).min(self.columns - 1));
        let cell = self.cells.get(row * self.columns + column)?;
        let (y, x) = (along - row as f64 - 0.5, across - column as f64 - 0.5);
        let [first, second, third, fourth] = cell;
        Some(horner(&[horner(first, y), horner(second, y), horner(third, y), horner(fourth, y)], x))
    }
}

/// Index of the cell at a position given in units of cells.
#[inline]
#[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "places are positive and few")]
fn cell_of(place: f64) -> usize {
    place as usize
}

/// Values of polynomials with these coefficients of the powers of `x`.
#[inline]
fn horner(powers: &[Values; NODES], x: f64) -> Values {
    let [p0, p1, p2, p3] = powers;
    core::array::from_fn(|c| ((p3[c] * x + p2[c]) * x + p1[c]) * x + p0[c])
}

/// Coefficients of the powers in the polynomials that take these values at the nodes.
fn coefficients(powers: &[[f64; NODES]; NODES], values: &[Values; NODES]) -> [Values; NODES] {
    core::array::from_fn(|k| {
        core::array::from_fn(|c| powers.iter().zip(values).map(|(own, value)| own[k] * value[c]).sum())
    })
}

/// Coefficients of the powers in each Lagrange polynomial through `nodes`.
fn powers(nodes: &[f64; NODES]) -> [[f64; NODES]; NODES] {
    nodes.each_ref().map(|own| {
        let mut coefficients = [0.0; NODES];
        coefficients[0] = 1.0;
        for other in nodes.iter().filter(|other| !core::ptr::eq(*other, own)) {
            let lower = coefficients;
            for (k, entry) in coefficients.iter_mut().enumerate() {
                let raised = if k > 0 { lower[k - 1] } else { 0.0 };
                *entry = (raised - other * lower[k]) / (own - other);
            }
        }
        coefficients
    })
}
