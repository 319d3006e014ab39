//! Loads on frames at any arc length: the element's derivatives against differences of its energy.

use std::sync::Arc;

use mcm::design::{Design, Specification};
use mcm::geometry::{Pose, RotationVector, hat};
use mcm::rod::{
    Configuration, Element, ElementDerivatives, ElementLoads, FrameState, Load, Order, Piece, PlacedCoupling,
    PlacedLoad, Resolution, Row, START,
};
use nalgebra::{Matrix3, Matrix6, Vector3};

use crate::tolerance::{HESSIAN_DIFFERENCE, ROUNDING, SLOPE_DIFFERENCE, assert_close};

/// Steps of the differences: of a gradient, and of second differences of the energy.
const STEP: f64 = 1e-6;
const SECOND_STEP: f64 = 3e-4;

fn element() -> Element {
    let design = Design::new(Specification::paper(1)).expect("the paper's design is allowed");
    let spans = &design.segments()[0].spans;
    let pieces: Vec<Piece<'_>> = spans.iter().map(Piece::whole).collect();
    Element::new(0.002, &pieces, &Resolution { degree: 3, nearest: None, bending_stop: true, fine: false })
}

/// Amplitudes that bend, twist, shear and stretch the core.
fn amplitudes(element: &Element) -> Vec<f64> {
    let sizes = [0.5, -0.3, 0.2, 1e-5, -2e-5, 3e-5];
    (0..element.freedoms())
        .map(|i| sizes[element.component[i]] * (1.0 + 0.7 * (1.3 * i as f64).sin()) / (1 + i / 6) as f64)
        .collect()
}

/// Springs between two frames of an element, each attached beside its centreline, and from the second to a fixed point.
struct Springs {
    rows: [Arc<Row>; 2],
    arms: [Vector3<f64>; 2],
    anchor: Vector3<f64>,
    stiffness: [f64; 2],
}

impl Springs {
    fn new(element: &Element) -> Self {
        Self {
            // Neither at a Gauss point nor at the end of a span.
            rows: [0.31, 0.77].map(|part| Arc::new(element.row(part * element.length))),
            arms: [Vector3::new(1e-3, -2e-3, 5e-4), Vector3::new(-1.5e-3, 5e-4, -1e-3)],
            anchor: Vector3::new(3e-3, 4e-3, 2e-3),
            stiffness: [20.0, 35.0],
        }
    }

    fn frames(&self, element: &Element, amplitudes: &[f64]) -> [FrameState; 2] {
        let mut configuration = Configuration::straight(element);
        configuration.update(element, amplitudes);
        self.rows.each_ref().map(|row| configuration.frame_at(element, row, amplitudes))
    }

    /// Energy with the start node at `start`.
    fn energy(&self, element: &Element, start: &Pose, amplitudes: &[f64]) -> f64 {
        let frames = self.frames(element, amplitudes);
        let [first, second] = [0, 1].map(|i| {
            let pose = start.compose(&frames[i].pose);
            pose.position + pose.rotation * self.arms[i]
        });
        0.5 * self.stiffness[0] * (first - second).norm_squared()
            + 0.5 * self.stiffness[1] * (second - self.anchor).norm_squared()
    }

    /// The loads of the springs on both frames, with the start node at the origin.
    fn loads(&self, element: &Element, amplitudes: &[f64]) -> (Vec<PlacedLoad>, Vec<PlacedCoupling>) {
        let frames = self.frames(element, amplitudes);
        let arms = [0, 1].map(|i| frames[i].pose.rotation * self.arms[i]);
        let points = [0, 1].map(|i| frames[i].pose.position + arms[i]);
        let spring = |arm: &Vector3<f64>, stretch: Vector3<f64>, stiffness: f64| {
            let lever = hat(arm);
            Load {
                force: stretch * stiffness,
                couple: stretch * arm.transpose() * stiffness,
                position_position: Matrix3::identity() * stiffness,
                position_rotation: lever * -stiffness,
                rotation_rotation: lever.tr_mul(&lever) * stiffness,
                stiff: true,
                ..Load::zero()
            }
        };
        let [between, fixed] = self.stiffness;
        let first = spring(&arms[0], points[0] - points[1], between);
        let mut second = spring(&arms[1], points[1] - points[0], between);
        second += spring(&arms[1], points[1] - self.anchor, fixed);
        let mut matrix = Matrix6::zeros();
        let [near, far] = arms.map(|arm| {
            let mut motion = nalgebra::Matrix3x6::zeros();
            motion.fixed_columns_mut::<3>(0).fill_diagonal(1.0);
            motion.fixed_columns_mut::<3>(3).copy_from(&-hat(&arm));
            motion
        });
        matrix -= near.transpose() * far * between;
        let placed = frames.into_iter().zip(&self.rows).zip([first, second]);
        let placed = placed.map(|((frame, row), load)| PlacedLoad { row: row.clone(), frame, load });
        (placed.collect(), vec![PlacedCoupling { between: [0, 1], matrix }])
    }
}

/// Gradient and Hessian of elastic energy and springs.
fn derivatives(
    element: &Element,
    springs: &Springs,
    amplitudes: &[f64],
    order: Order,
) -> (Vec<f64>, Vec<f64>) {
    let mut configuration = Configuration::straight(element);
    configuration.update(element, amplitudes);
    let (placed, couplings) = springs.loads(element, amplitudes);
    let stations = vec![Load::zero(); element.stations.len()];
    let end = (Vector3::zeros(), Vector3::zeros());
    let loads = ElementLoads { stations: &stations, placed: &placed, couplings: &couplings, end };
    let mut out = ElementDerivatives::new(element);
    out.assemble(element, &configuration, amplitudes, &loads, order);
    (out.gradient, out.hessian)
}

/// Energy at a displacement of the start node (displacement, rotation vector) and of the amplitudes.
fn energy(element: &Element, springs: &Springs, amplitudes: &[f64], moved: &[f64]) -> f64 {
    let vector = |i: usize| Vector3::from_column_slice(&moved[i..i + 3]);
    let start = Pose { position: vector(0), rotation: RotationVector::new(vector(3)).matrix() };
    let amplitudes: Vec<f64> = amplitudes.iter().zip(&moved[START..]).map(|(a, b)| a + b).collect();
    let mut configuration = Configuration::straight(element);
    configuration.update(element, &amplitudes);
    configuration.elastic_energy(element, &amplitudes) + springs.energy(element, &start, &amplitudes)
}

/// Units of the element's columns: lengths and shear strains are a thousandth of angles.
fn units(element: &Element) -> Vec<f64> {
    let start = [1e-3, 1e-3, 1e-3, 1.0, 1.0, 1.0];
    let own = element.component.iter().map(|c| if *c < 3 { 1.0 } else { 1e-3 });
    start.into_iter().chain(own).collect()
}

#[test]
fn derivatives_of_loads_between_the_stations_are_those_of_their_energy() {
    let element = element();
    let springs = Springs::new(&element);
    let amplitudes = amplitudes(&element);
    let units = units(&element);
    let size = units.len();
    let (gradient, hessian) = derivatives(&element, &springs, &amplitudes, Order::Hessian);
    let at = |moved: &[(usize, f64)]| {
        let mut all = vec![0.0; size];
        for (i, step) in moved {
            all[*i] += step * units[*i];
        }
        energy(&element, &springs, &amplitudes, &all)
    };
    let scaled: Vec<f64> = gradient.iter().zip(&units).map(|(g, unit)| g * unit).collect();
    let expected: Vec<f64> =
        (0..size).map(|i| (at(&[(i, STEP)]) - at(&[(i, -STEP)])) / (2.0 * STEP)).collect();
    assert_close("gradient", &scaled, &expected, SLOPE_DIFFERENCE);
    let (alone, _) = derivatives(&element, &springs, &amplitudes, Order::Gradient);
    assert_close("gradient without Hessian", &alone, &gradient, ROUNDING);
    // Rows of the start node against each other: second differences.
    let step = SECOND_STEP;
    for i in 0..START {
        let row: Vec<f64> = (0..START).map(|j| hessian[i * size + j] * units[i] * units[j]).collect();
        let expected: Vec<f64> = (0..START)
            .map(|j| {
                let value = |a: f64, b: f64| at(&[(i, a * step), (j, b * step)]);
                (value(1.0, 1.0) - value(1.0, -1.0) - value(-1.0, 1.0) + value(-1.0, -1.0))
                    / (4.0 * step * step)
            })
            .collect();
        assert_close(format!("start row {i}"), &row, &expected, HESSIAN_DIFFERENCE);
    }
    for j in 0..element.freedoms() {
        let moved = |sign: f64| {
            let mut changed = amplitudes.clone();
            changed[j] += sign * STEP * units[START + j];
            derivatives(&element, &springs, &changed, Order::Gradient).0
        };
        let (up, down) = (moved(1.0), moved(-1.0));
        let expected: Vec<f64> = (0..size).map(|i| (up[i] - down[i]) * units[i] / (2.0 * STEP)).collect();
        let column: Vec<f64> =
            (0..size).map(|i| hessian[i * size + START + j] * units[i] * units[START + j]).collect();
        assert_close(format!("column of amplitude {j}"), &column, &expected, HESSIAN_DIFFERENCE);
    }
}

#[test]
fn a_load_at_a_station_is_the_same_as_the_stations_load() {
    let element = element();
    let amplitudes = amplitudes(&element);
    let mut configuration = Configuration::straight(&element);
    configuration.update(&element, &amplitudes);
    let none = vec![Load::zero(); element.stations.len()];
    let mut derivatives = ElementDerivatives::new(&element);
    for (index, station) in element.stations.iter().enumerate() {
        let frame = configuration.frame_at(&element, &station.row, &amplitudes);
        let mut load = Load::fixed_force(
            &Vector3::new(0.01, 0.03, -0.02),
            &frame.pose.position,
            &Vector3::new(1e-3, 0.0, 2e-3),
        );
        load.rotation_rotation = Matrix3::new(2.0, 0.3, 0.1, 0.3, 1.0, 0.2, 0.1, 0.2, 3.0) * 1e-5;
        load.position_position = Matrix3::identity() * 3.0;
        load.stiff = true;
        let mut stations = none.clone();
        stations[index] = load;
        let placed = [PlacedLoad { row: Arc::new(station.row.clone()), frame, load }];
        let end = (Vector3::new(0.02, -0.01, 0.03), Vector3::new(1e-5, 2e-5, 0.0));
        let [at_station, at_place] =
            [(&stations, &placed[..0]), (&none, &placed[..])].map(|(stations, placed)| {
                let loads = ElementLoads { stations, placed, couplings: &[], end };
                derivatives.assemble(&element, &configuration, &amplitudes, &loads, Order::Hessian);
                (derivatives.gradient.clone(), derivatives.hessian.clone())
            });
        assert_close(format!("gradient, station {index}"), &at_place.0, &at_station.0, ROUNDING);
        assert_close(format!("Hessian, station {index}"), &at_place.1, &at_station.1, ROUNDING);
    }
}
