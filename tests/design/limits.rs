//! What a design refuses, and that it says which quantity, which value and what is allowed.

use mcm::design::{
    Backbone, Cylinder, CylinderMaterial, Design, Helix, Modulus, RingMagnet, Segmented, Specification,
    SpiralStart,
};
use mcm::error::Error;

fn paper() -> Segmented {
    match Specification::paper(2) {
        Specification::Segmented(chain) => chain,
        _ => panic!("the paper's manipulator is segmented"),
    }
}

#[track_caller]
fn refused(specification: &Specification, named: &str) {
    match Design::new(specification.clone()) {
        Err(Error::Range { quantity, allowed, .. }) => {
            assert!(quantity.contains(named), "{quantity} instead of {named}");
            assert!(!allowed.is_empty());
        }
        other => panic!("{specification:?} gave {other:?}"),
    }
}

/// What is wrong for every dimension: it must be positive and finite.
const NO_LENGTHS: [f64; 6] = [f64::NAN, f64::INFINITY, f64::NEG_INFINITY, -1e-3, 0.0, 4.0];

/// Reaches one quantity of a helix.
type Entry = fn(&mut Helix) -> &mut f64;

#[test]
fn helices_out_of_range() {
    let table: [(Entry, &str, &[f64]); 9] = [
        (|h| &mut h.length, "length", &NO_LENGTHS),
        (|h| &mut h.length, "height h", &[1.3e-3]),
        (|h| &mut h.boundary_angle, "Theta", &[f64::NAN, 0.0, -0.1, 4.0, 40.0]),
        (|h| &mut h.radius, "radius", &NO_LENGTHS),
        (|h| &mut h.windings, "windings", &[f64::NAN, 0.0, 0.5, -2.0, 1e6]),
        (|h| &mut h.core_outer_radius, "core outer radius", &[f64::NAN, 0.0, 2.0e-3, 3e-3]),
        (|h| &mut h.core_inner_radius, "core inner radius", &[f64::NAN, -1e-4, 0.95e-3, 1e-3]),
        (|h| &mut h.volume_fraction, "volume fraction", &[f64::NAN, -0.1, 1.0 / 1.35, 0.8, 1.0]),
        (|h| &mut h.particle_remanence, "remanence", &[f64::NAN, -1.0, 20.1]),
    ];
    for (entry, named, values) in table {
        for &value in values {
            let mut chain = paper();
            *entry(&mut chain.helix) = value;
            refused(&Specification::Segmented(chain), named);
        }
    }
    for shore_a in [f64::NAN, 0.0, -5.0, 100.0, 120.0] {
        refused(
            &Specification::Segmented(Segmented { helix: Helix { shore_a, ..Helix::paper() }, ..paper() }),
            "Shore A",
        );
    }
    for poisson in [f64::NAN, -0.1, 0.5, 0.7] {
        refused(
            &Specification::Segmented(Segmented { helix: Helix { poisson, ..Helix::paper() }, ..paper() }),
            "Poisson",
        );
    }
    let helix = Helix { density: Some(-1.0), ..Helix::paper() };
    refused(&Specification::Segmented(Segmented { helix, ..paper() }), "density");
}

#[test]
fn chains_and_rings_out_of_range() {
    for segments in [0, 65, usize::MAX] {
        refused(&Specification::paper(segments), "number of segments");
    }
    for segments in [1, 64] {
        assert!(Design::new(Specification::paper(segments)).is_ok(), "{segments}");
    }
    for length in NO_LENGTHS {
        let ring = RingMagnet { length, ..RingMagnet::paper() };
        refused(&Specification::Segmented(Segmented { ring, ..paper() }), "ring length");
    }
    for remanence in [f64::NAN, -1.35, 20.1] {
        let ring = RingMagnet { remanence, ..RingMagnet::paper() };
        refused(&Specification::Segmented(Segmented { ring, ..paper() }), "ring remanence");
    }
    for recoil_permeability in [f64::NAN, 0.99, 0.0, -1.0, 2.01, f64::INFINITY] {
        let ring = RingMagnet { recoil_permeability, ..RingMagnet::paper() };
        refused(&Specification::Segmented(Segmented { ring, ..paper() }), "ring recoil permeability");
    }
    for recoil_permeability in [1.0, 1.05, 2.0] {
        let ring = RingMagnet { recoil_permeability, ..RingMagnet::paper() };
        assert!(Design::new(Specification::Segmented(Segmented { ring, ..paper() })).is_ok());
    }
    let ring = RingMagnet { density: f64::NAN, ..RingMagnet::paper() };
    refused(&Specification::Segmented(Segmented { ring, ..paper() }), "density");
}

#[test]
fn backbones_out_of_range() {
    let tube = Backbone::silicone();
    let cases = [
        (Backbone { outer_radius: 0.8e-3, ..tube }, "backbone outer radius"),
        (Backbone { outer_radius: f64::NAN, ..tube }, "backbone outer radius"),
        (Backbone { inner_radius: 0.75e-3, ..tube }, "backbone inner radius"),
        (Backbone { inner_radius: -1e-4, ..tube }, "backbone inner radius"),
        (Backbone { modulus: Modulus::ShoreA(100.0), ..tube }, "Shore A"),
        (Backbone { modulus: Modulus::Elastic(0.0), ..tube }, "Young"),
        (Backbone { modulus: Modulus::Elastic(f64::NAN), ..tube }, "Young"),
        (Backbone { poisson: 0.5, ..tube }, "Poisson"),
        (Backbone { density: -1.0, ..tube }, "density"),
    ];
    for (backbone, named) in cases {
        refused(&Specification::Segmented(Segmented { backbone: Some(backbone), ..paper() }), named);
    }
    // 0.75 mm read from millimetres fits in 0.75 mm, whatever the last bit says.
    let rounded = Backbone { outer_radius: 0.75e-3_f64.next_up(), ..tube };
    let chain = Segmented { backbone: Some(rounded), ..paper() };
    assert!(Design::new(Specification::Segmented(chain)).is_ok());
    let closed = Helix { core_inner_radius: 0.0, ..Helix::paper() };
    assert!(Design::new(Specification::Segmented(Segmented { helix: closed, ..paper() })).is_ok());
    let chain = Segmented { helix: closed, backbone: Some(tube), ..paper() };
    refused(&Specification::Segmented(chain), "backbone outer radius");
}

#[test]
fn cylinders_out_of_range() {
    let material = CylinderMaterial::Bulk { elastic_modulus: 1e6, poisson: 0.4, remanence: 0.2 };
    let rod = Cylinder { length: 16e-3, radius: 2e-3, inner_radius: 0.0, material, density: None };
    assert!(Design::new(Specification::Cylinder(rod)).is_ok());
    for value in NO_LENGTHS {
        refused(&Specification::Cylinder(Cylinder { length: value, ..rod }), "cylinder length");
        refused(&Specification::Cylinder(Cylinder { radius: value, ..rod }), "cylinder radius");
    }
    refused(&Specification::Cylinder(Cylinder { inner_radius: 2e-3, ..rod }), "cylinder inner radius");
    refused(&Specification::Cylinder(Cylinder { density: Some(f64::NAN), ..rod }), "density");
    let bulk = |elastic_modulus, poisson, remanence| {
        let material = CylinderMaterial::Bulk { elastic_modulus, poisson, remanence };
        Specification::Cylinder(Cylinder { material, ..rod })
    };
    refused(&bulk(-1.0, 0.4, 0.2), "Young");
    refused(&bulk(1e6, 0.5, 0.2), "Poisson");
    refused(&bulk(1e6, 0.4, f64::NAN), "remanence");
    let composite = CylinderMaterial::Composite {
        shore_a: 33.0,
        poisson: 0.4,
        volume_fraction: 0.75,
        particle_remanence: 1.0,
    };
    refused(&Specification::Cylinder(Cylinder { material: composite, ..rod }), "volume fraction");
}

#[test]
fn start_angles_of_spirals_are_one_for_each_segment_and_within_a_turn() {
    let design = |spiral_start| Design::new(Specification::Segmented(Segmented { spiral_start, ..paper() }));
    for angle in [f64::NAN, f64::INFINITY, 6.3, -6.3, 90.0] {
        for (start, named) in
            [(SpiralStart::Same(angle), "spirals"), (SpiralStart::Each(vec![0.0, angle]), "segment 2")]
        {
            refused(&Specification::Segmented(Segmented { spiral_start: start, ..paper() }), named);
        }
    }
    for angle in [360.0_f64, -360.0].map(f64::to_radians) {
        assert!(design(SpiralStart::Same(angle)).is_ok());
        assert!(design(SpiralStart::Each(vec![angle, 0.0])).is_ok());
    }
    for angles in [vec![], vec![0.0], vec![0.0; 3]] {
        let count = angles.len();
        let message = design(SpiralStart::Each(angles)).unwrap_err().to_string();
        let expected =
            format!("start angles of the spirals has {count} entries, expected 2, one for each segment");
        assert_eq!(message, expected);
    }
}
