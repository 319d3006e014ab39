//! The numbers of Table 1 and what follows from them.

use core::f64::consts::PI;

use mcm::constants::VACUUM_PERMEABILITY;
use mcm::design::{
    Backbone, Cylinder, CylinderMaterial, Design, Helix, RingMagnet, SectorKind, Segmented, SpanKind,
    Specification, SpiralKind, SpiralVolume, composite_shear_modulus, gent_modulus,
};
use serde_json::Value;

use crate::tolerance::{PRINTED, ROUNDING, assert_close};

fn paper(segments: usize) -> Segmented {
    match Specification::paper(segments) {
        Specification::Segmented(chain) => chain,
        _ => panic!("the paper's manipulator is segmented"),
    }
}

fn design(chain: Segmented) -> Design {
    Design::new(Specification::Segmented(chain)).expect("allowed")
}

#[test]
fn derived_numbers_as_printed() {
    let geometry = Helix::paper().geometry().expect("allowed");
    let elastic = gent_modulus(33.0);
    let shear = composite_shear_modulus(elastic, 0.4, 0.25);
    for (what, got, printed) in [
        ("h (mm)", geometry.height * 1e3, 0.6509),
        ("p (mm)", geometry.pitch * 1e3, 0.6981),
        ("phi (deg)", geometry.sector_angle.to_degrees(), 173.70),
        ("E_pdms (MPa)", elastic * 1e-6, 1.29447),
        ("G_mpc (MPa)", shear * 1e-6, 1.18753),
        ("E_mpc (MPa)", 2.0 * shear * 1.4e-6, 3.32509),
    ] {
        assert_close(what, &[got], &[printed], PRINTED);
    }
}

#[test]
fn derived_numbers_as_in_the_independent_model() {
    let path = concat!(env!("CARGO_MANIFEST_DIR"), "/tests/reference/statics_dev.json");
    let text = std::fs::read_to_string(path).expect("the reference is there");
    let reference: Value = serde_json::from_str(&text).expect("JSON");
    let given = &reference["cases"][0]["setup"]["design"];
    let number = |key: &str| given[key].as_f64().unwrap_or_else(|| panic!("{key} is missing"));
    let geometry = Helix::paper().geometry().expect("allowed");
    let device = design(paper(1));
    let core = &device.segments()[0].spans[1];
    for (key, got) in [
        ("p", geometry.pitch),
        ("h", geometry.height),
        ("phi", geometry.sector_angle),
        ("Lc", geometry.core_length),
        ("G", core.stiffness.shear / core.area()),
        ("E", core.stiffness.axial / core.area()),
        ("Br_mpc", core.magnetisation * VACUUM_PERMEABILITY),
    ] {
        assert_close(key, &[got], &[number(key)], ROUNDING);
    }
}

#[test]
fn the_curve_of_the_helix_ends_at_its_length() {
    // Eq. (1): z_u(phi) = 2 h at the end of the closed end, and z_u(2 pi W + phi) = L.
    let helix = Helix { windings: 3.0, length: 7e-3, ..Helix::paper() };
    let geometry = helix.geometry().expect("allowed");
    let upper = |beta: f64| beta / (2.0 * PI) * (geometry.height + geometry.pitch) + geometry.height;
    assert_close("start", &[upper(geometry.sector_angle)], &[2.0 * geometry.height], ROUNDING);
    let end = upper(2.0 * PI * helix.windings + geometry.sector_angle);
    assert_close("end", &[end], &[helix.length], ROUNDING);
}

#[test]
fn relative_moment_of_nine_segments() {
    let exact = paper(9).relative_moment(SpiralVolume::Exact).expect("allowed");
    let printed = paper(9).relative_moment(SpiralVolume::Printed).expect("allowed");
    assert_close("exact", &[exact.moment], &[0.1957], 3e-4);
    assert_close("printed", &[printed.moment], &[0.1989], 3e-4);
    let device = design(paper(9));
    let solid = 1.35 * PI * 4e-6 * device.length() / VACUUM_PERMEABILITY;
    assert_close("moment", &[exact.remanent_moment], &[device.moment() / solid], ROUNDING);
    assert!(exact.remanent_moment < exact.magnetic_volume, "the particles are the weaker magnets");
}

#[test]
fn volumes_of_the_helix() {
    let exact = Helix::paper().volumes(SpiralVolume::Exact).expect("allowed");
    let printed = Helix::paper().volumes(SpiralVolume::Printed).expect("allowed");
    assert_close("spiral (mm3)", &[exact.spiral * 1e9], &[12.669], PRINTED);
    assert_close("printed spiral (mm3)", &[printed.spiral * 1e9], &[13.108], PRINTED);
    let device = design(paper(1));
    let bodies: f64 = device.segments()[0].spans.iter().map(mcm::design::Span::volume).sum();
    assert_close("spans", &[bodies], &[exact.total()], ROUNDING);
}

#[test]
fn the_chain_has_the_bodies_it_should() {
    for (base_magnet, tip_magnet, rings) in
        [(true, true, 4), (false, true, 3), (true, false, 3), (false, false, 2)]
    {
        let chain = Segmented { base_magnet, tip_magnet, ..paper(3) };
        assert_eq!(chain.ring_count(), rings);
        let device = design(chain);
        assert_eq!(!device.base_rings().is_empty(), base_magnet);
        assert_eq!(device.rings().count(), rings);
        assert_close("length", &[device.length()], &[12e-3 + rings as f64 * 1e-3], ROUNDING);
        for segment in device.segments() {
            let kinds: Vec<SpanKind> = segment.spans.iter().map(|span| span.kind).collect();
            assert_eq!(kinds, [SpanKind::Disc, SpanKind::Core, SpanKind::Disc]);
        }
        assert_eq!(!device.segments()[2].rings.is_empty(), tip_magnet);
    }
    let spread = design(Segmented { spiral: SpiralKind::Axisymmetric, ..paper(1) });
    assert_eq!(spread.segments()[0].spans[1].spiral.map(|s| s.kind), Some(SectorKind::Axisymmetric));
}

#[test]
fn stiffness_of_core_and_backbone_add_up() {
    let bare = design(paper(1));
    let with = design(Segmented { backbone: Some(Backbone::silicone()), ..paper(1) });
    let tube_modulus = gent_modulus(50.0);
    let inertia = PI / 4.0 * (0.75e-3_f64.powi(4) - 0.25e-3_f64.powi(4));
    let area = PI * (0.75e-3_f64.powi(2) - 0.25e-3_f64.powi(2));
    for (one, two) in bare.segments()[0].spans.iter().zip(&with.segments()[0].spans) {
        let (a, b) = (one.stiffness, two.stiffness);
        assert_close("EI", &[b.bending - a.bending], &[tube_modulus * inertia], 1e-12);
        assert_close("GJ", &[b.torsion - a.torsion], &[tube_modulus / 2.8 * 2.0 * inertia], 1e-12);
        assert_close("EA", &[b.axial - a.axial], &[tube_modulus * area], 1e-12);
        assert_close("GA", &[b.shear - a.shear], &[tube_modulus / 2.8 * area], 1e-12);
        assert_close("mass", &[two.mass() - one.mass()], &[1000.0 * area * one.length], 1e-12);
    }
    let core = bare.segments()[0].spans[1].stiffness;
    let expected = 3.325_086_41e6 * PI / 4.0 * (0.95e-3_f64.powi(4) - 0.75e-3_f64.powi(4));
    assert_close("EI of the core", &[core.bending], &[expected], 1e-8);
    assert_close("GJ / EI", &[core.torsion / core.bending], &[1.0 / 1.4], ROUNDING);
    assert_close("mass", &[with.mass() - bare.mass()], &[1000.0 * area * 6e-3], 1e-12);
    assert!(design(Segmented { backbone: Some(Backbone::ptfe()), ..paper(1) }).mass() > bare.mass());
}

#[test]
fn mass_of_nine_segments() {
    // By the densities of rings and composite; the paper weighs 2.25 g with tube, glue and coating.
    let device = design(paper(9));
    let ring = RingMagnet::paper().density * PI * (4.0 - 0.5625) * 1e-9;
    let helix = 2500.0 * Helix::paper().volumes(SpiralVolume::Exact).expect("allowed").total();
    assert_close("mass", &[device.mass()], &[10.0 * ring + 9.0 * helix], 1e-12);
    assert_close("mass (g)", &[device.mass() * 1e3], &[1.42], 5e-3);
    let heavy = Segmented { helix: Helix { density: Some(5000.0), ..Helix::paper() }, ..paper(9) };
    assert_close("given density", &[design(heavy).mass()], &[10.0 * ring + 18.0 * helix], 1e-12);
}

#[test]
fn a_plain_cylinder_is_one_span() {
    let material = CylinderMaterial::Composite {
        shore_a: 33.0,
        poisson: 0.4,
        volume_fraction: 0.2,
        particle_remanence: 1.0,
    };
    let rod = Cylinder { length: 16e-3, radius: 2e-3, inner_radius: 0.0, material, density: None };
    let device = Design::new(Specification::Cylinder(rod)).expect("allowed");
    assert_eq!((device.rings().count(), device.segments().len()), (0, 1));
    let [span] = device.segments()[0].spans.as_slice() else { panic!("one span") };
    assert_eq!(span.kind, SpanKind::Rod);
    assert_close("Phi B_r", &[span.magnetisation * VACUUM_PERMEABILITY], &[0.2], ROUNDING);
    assert_close("density", &[span.density], &[2200.0], ROUNDING);
    assert_close("length", &[device.length()], &[16e-3], ROUNDING);
    let bulk = CylinderMaterial::Bulk { elastic_modulus: 1e6, poisson: 0.25, remanence: 0.1 };
    let rod = Cylinder { inner_radius: 1e-3, material: bulk, density: Some(1234.0), ..rod };
    let device = Design::new(Specification::Cylinder(rod)).expect("allowed");
    let span = &device.segments()[0].spans[0];
    assert_close("EA", &[span.stiffness.axial], &[1e6 * PI * 3e-6], ROUNDING);
    assert_close("GA", &[span.stiffness.shear], &[0.4e6 * PI * 3e-6], ROUNDING);
    assert_close("mass", &[device.mass()], &[1234.0 * PI * 3e-6 * 16e-3], ROUNDING);
}
