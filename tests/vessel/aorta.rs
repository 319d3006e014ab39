//! The abdominal aorta: its measures, found again on the finished branches, and the way through it.

use mcm::numerics::bisection::bisect;
use mcm::vessel::aorta::SideArtery;
use mcm::vessel::{Aorta, Branch, Lumen};
use nalgebra::Vector3;

use crate::tolerance::{CLEARANCE, MEASURE, MEASURED_ANGLE};

/// Distance between places that are searched along a centreline, m.
const STEP: f64 = 2e-5;

/// Radius of the device and the room that it must have besides, m.
const DEVICE: [f64; 2] = [2e-3, 1e-3];

fn presets() -> [(&'static str, Aorta); 2] {
    [("planar", Aorta::planar()), ("spatial", Aorta::spatial())]
}

fn branch(branches: &[Branch], name: &str) -> Branch {
    branches.iter().find(|branch| branch.name() == name).expect(name).clone()
}

/// Parameters, a step apart, of a whole centreline.
fn along(branch: &Branch) -> impl Iterator<Item = f64> {
    let end = *branch.range().end();
    let count = (end / STEP).ceil() as u32;
    (0..=count).map(move |i| end * f64::from(i) / f64::from(count))
}

fn centre(branch: &Branch, t: f64) -> Vector3<f64> {
    branch.ball(t).0
}

fn direction(branch: &Branch, t: f64) -> Vector3<f64> {
    (centre(branch, t + 1e-6) - centre(branch, t - 1e-6)).normalize()
}

/// Parameter of the place of a centreline that is nearest to a point.
fn nearest(branch: &Branch, point: &Vector3<f64>) -> f64 {
    let distance = |t: f64| (centre(branch, t) - point).norm();
    along(branch).min_by(|a, b| distance(*a).total_cmp(&distance(*b))).unwrap()
}

/// Length of a centreline between two parameters.
fn length(branch: &Branch, from: f64, to: f64) -> f64 {
    let at = |i: u32| centre(branch, from + (to - from) * f64::from(i) / 2000.0);
    (0..2000).map(|i| (at(i + 1) - at(i)).norm()).sum::<f64>() * (to - from).signum()
}

/// Where the centreline of an artery leaves the aorta's lumen.
fn mouth(aorta: &Branch, artery: &Branch) -> f64 {
    along(artery).find(|t| aorta.clearance(&centre(artery, *t)).value < 0.0).unwrap()
}

/// Where the lumens of the common iliac arteries part: the first place downwards with a wall between their centres.
fn bifurcation(aorta: &Branch, right: &Branch) -> Vector3<f64> {
    let tightest = |t: f64| {
        let to = centre(right, t);
        let from = centre(aorta, nearest_level(aorta, to.z));
        let at = |share: f64| from + (to - from) * share;
        let nearer_left = |share| aorta.clearance(&at(share)).value > right.clearance(&at(share)).value;
        at(bisect([0.0, 1.0], 40, nearer_left)[0])
    };
    let parted = |t: &f64| aorta.clearance(&tightest(*t)).value < 0.0;
    tightest(along(right).skip_while(|t| *t < 0.015).find(parted).unwrap())
}

/// Parameter of the place of the left iliac artery and the aorta at this height.
fn nearest_level(aorta: &Branch, z: f64) -> f64 {
    bisect([0.0, *aorta.range().end()], 50, |t| centre(aorta, t).z < z)[0]
}

fn side_arteries(aorta: &Aorta) -> [(&'static str, &SideArtery); 5] {
    [
        ("celiac trunk", &aorta.celiac),
        ("superior mesenteric", &aorta.sma),
        ("inferior mesenteric", &aorta.ima),
        ("left renal", &aorta.left_renal),
        ("right renal", &aorta.right_renal),
    ]
}

#[test]
fn distances_are_those_of_the_autopsies() {
    for (preset, aorta) in presets() {
        let branches = aorta.branches().unwrap();
        let main = &branches[0];
        let place = |name: &str| {
            let artery = branch(&branches, name);
            nearest(main, &centre(&artery, mouth(main, &artery)))
        };
        // The aorta's axis goes straight on from where the centrelines part.
        let top = centre(&branches[1], 0.0);
        let (top, below) = (nearest(main, &top), top.z - bifurcation(main, &branches[1]).z);
        let [celiac, sma, ima] = ["celiac trunk", "superior mesenteric", "inferior mesenteric"].map(&place);
        let [left, right] = ["left renal", "right renal"].map(place);
        let to_left_renal = if preset == "planar" { 20e-3 } else { 16e-3 };
        for (what, got, expected) in [
            ("celiac trunk to superior mesenteric", length(main, sma, celiac), 14.3e-3),
            ("superior to inferior mesenteric", length(main, ima, sma), 57.8e-3),
            ("inferior mesenteric to bifurcation", length(main, top, ima) + below, 35.2e-3),
            ("celiac trunk to bifurcation", length(main, top, celiac) + below, 107.3e-3),
            ("superior mesenteric to left renal", length(main, left, sma), to_left_renal),
            ("superior mesenteric to right renal", length(main, right, sma), 10e-3),
        ] {
            println!("{preset}: {what} {:.3} mm", got * 1e3);
            assert!((got - expected).abs() < MEASURE, "{preset}: {what} {got}, expected {expected}");
        }
    }
}

#[test]
fn widths_are_those_of_the_table() {
    for (preset, aorta) in presets() {
        let branches = aorta.branches().unwrap();
        let main = &branches[0];
        let fork = bifurcation(main, &branches[1]);
        let celiac = branch(&branches, "celiac trunk");
        let celiac = nearest(main, &centre(&celiac, mouth(main, &celiac)));
        let parting = nearest(main, &centre(&branches[1], 0.0));
        let common = nearest_level(main, fork.z - 0.02);
        let external = common - 0.06;
        let mut widths = vec![
            ("aorta above the celiac trunk", main, celiac + 0.01, 25e-3),
            ("aorta at the celiac trunk", main, celiac, 25e-3),
            ("aorta above its bifurcation", main, parting, 19e-3),
            ("left common iliac", main, common, 10.5e-3),
            ("left external iliac", main, external, 7.9e-3),
            ("port", main, nearest_level(main, 0.0), 7.9e-3),
        ];
        for (name, width) in [
            ("celiac trunk", 6.43e-3),
            ("superior mesenteric", 7.38e-3),
            ("inferior mesenteric", 3.61e-3),
            ("left renal", 5.4e-3),
            ("right renal", 5.2e-3),
            ("left internal iliac", 6.86e-3),
            ("right internal iliac", 6.86e-3),
        ] {
            let own = branches.iter().find(|branch| branch.name() == name).unwrap();
            widths.extend([(name, own, 0.0, width), (name, own, *own.range().end(), width)]);
        }
        for (what, branch, t, expected) in widths {
            // Across the vessel, the wall is half the width away on every side.
            let along = direction(branch, t.clamp(2e-6, branch.range().end() - 2e-6));
            let across = along.cross(&Vector3::new(0.3, 1.0, 0.2)).normalize() * (0.5 * expected);
            for side in [across, -across, along.cross(&across)] {
                let wall = branch.clearance(&(centre(branch, t) + side)).value;
                assert!(wall.abs() < MEASURE, "{preset}: {what}: wall {wall:e} m from {:e}", 0.5 * expected);
            }
        }
    }
}

#[test]
fn arteries_leave_at_their_angles_and_a_device_turns_by_135_degrees() {
    for (preset, aorta) in presets() {
        let branches = aorta.branches().unwrap();
        let mouths = aorta.mouths().unwrap();
        assert_eq!(mouths.len(), 5);
        for (name, side) in side_arteries(&aorta) {
            let (main, artery) = (&branches[0], branch(&branches, name));
            let at = mouth(main, &artery);
            let up = direction(main, nearest(main, &centre(&artery, at)));
            let turn = up.angle(&direction(&artery, at));
            let told = mouths.iter().find(|mouth| mouth.name == name).unwrap();
            println!("{preset}: {name} turns a device from below by {:.2} deg", turn.to_degrees());
            assert!(
                (turn - told.turn).abs() < MEASURED_ANGLE,
                "{preset}: {name}: {turn}, told {}",
                told.turn
            );
            assert!((told.turn + side.angle - core::f64::consts::PI).abs() < 1e-12);
            assert!((told.middle - centre(&artery, at)).norm() < MEASURE, "{preset}: {name}");
            assert!(told.direction.angle(&direction(&artery, at)) < MEASURED_ANGLE, "{preset}: {name}");
        }
        let sma = &mouths[1];
        assert_eq!(sma.name, "superior mesenteric");
        assert!((sma.turn.to_degrees() - 135.0).abs() < 1e-9);
    }
}

#[test]
fn mouths_are_open_and_arteries_meet_nowhere_else() {
    for (preset, aorta) in presets() {
        let branches = aorta.branches().unwrap();
        let lumen = Lumen::new(branches.clone()).unwrap();
        for branch in &branches {
            for t in along(branch).step_by(25) {
                let (centre, radius) = branch.ball(t);
                let clearance = lumen.clearance(&centre).value;
                assert!(
                    clearance >= radius * (1.0 - 1e-10),
                    "{preset}: {} at {t}: {clearance}",
                    branch.name()
                );
            }
        }
        // Each begins on the centreline of the one that it leaves.
        for (number, from) in [(1, 0), (2, 0), (3, 1), (4, 0), (5, 0), (6, 0), (7, 0), (8, 0)] {
            let start = centre(&branches[number], 0.0);
            let aside = (centre(&branches[from], nearest(&branches[from], &start)) - start).norm();
            assert!(aside < STEP, "{preset}: {} begins {aside} m aside", branches[number].name());
        }
        for side in &branches[4..] {
            let mouth = mouth(&branches[0], side);
            for other in branches.iter().filter(|other| other.name() != side.name()) {
                // From where its whole width has left the aorta.
                let outside = along(side).step_by(25).filter(|t| *t > mouth + 0.012);
                for t in outside {
                    let (centre, radius) = side.ball(t);
                    let wall = -radius - other.clearance(&centre).value;
                    assert!(wall > 2e-3, "{preset}: {} and {}: {wall} m", side.name(), other.name());
                }
            }
        }
    }
}

#[test]
fn a_device_has_room_from_the_port_into_the_superior_mesenteric_artery() {
    for (preset, aorta) in presets() {
        let lumen = Lumen::new(aorta.branches().unwrap()).unwrap();
        let route = aorta.route("superior mesenteric", 0.04).unwrap();
        let [least, at] = route.points.iter().fold([f64::INFINITY; 2], |least, point| {
            let clearance = lumen.clearance(point).value;
            if clearance < least[0] { [clearance, point.z] } else { least }
        });
        let longest = route.points.windows(2).map(|pair| (pair[1] - pair[0]).norm()).fold(0.0, f64::max);
        let chords: f64 = route.points.windows(2).map(|pair| (pair[1] - pair[0]).norm()).sum();
        let length = route.length * 1e3;
        println!("{preset}: {length:.1} mm long, narrowest {:.2} mm at z = {:.1} mm", least * 1e3, at * 1e3);
        assert!(least > DEVICE[0] + DEVICE[1], "{preset}: {least} m at z = {at} m");
        assert!(route.points[0].norm() < CLEARANCE && longest < 2.01e-3, "{preset}: {longest}");
        assert!((chords - route.length).abs() < 1e-4, "{preset}: {chords}");
        assert!(
            aorta.route("superior mesenteric", 0.0).unwrap().length > 0.5,
            "{preset}: the paper's is longer"
        );
        let end = route.points[route.points.len() - 1];
        let artery = branch(lumen.branches(), "superior mesenteric");
        assert!((artery.clearance(&end).value - 0.5 * aorta.sma.width).abs() < MEASURE);
        let short = Aorta { access_length: 0.0, ..aorta.clone() };
        let shorter = short.route("superior mesenteric", 0.04).unwrap();
        assert!((route.length - shorter.length - aorta.access_length).abs() < 1e-12);
    }
}

#[test]
fn the_vessel_runs_along_z_through_the_port_and_goes_on_behind_it() {
    for (preset, aorta) in presets() {
        assert!((aorta.port().axis() - Vector3::z()).norm() < CLEARANCE);
        let branches = aorta.branches().unwrap();
        let main = &branches[0];
        let port = nearest_level(main, 0.0);
        assert!(centre(main, port).norm() < 1e-12, "{preset}: {:?}", centre(main, port));
        assert!((direction(main, port) - Vector3::z()).norm() < 1e-9, "{preset}");
        let behind = centre(main, 0.0);
        assert!(behind.z <= -0.03 && behind.xy().norm() < 1e-12, "{preset}: {behind:?}");
    }
}

#[test]
fn only_the_planar_one_is_planar() {
    let out_of_plane = |aorta: &Aorta| {
        let arteries = aorta.arteries().unwrap();
        arteries.iter().flat_map(|artery| &artery.points).map(|point| point.y.abs()).fold(0.0, f64::max)
    };
    assert!(out_of_plane(&Aorta::planar()) < CLEARANCE);
    assert!(out_of_plane(&Aorta::spatial()) > 0.05);
    assert_eq!(Aorta::default(), Aorta::planar());
    // In space the unpaired arteries leave towards +y, the renal ones to the sides.
    for mouth in Aorta::spatial().mouths().unwrap() {
        let ventral = mouth.direction.y > mouth.direction.x.abs();
        assert_eq!(ventral, !mouth.name.contains("renal"), "{mouth:?}");
    }
}

#[test]
fn text_of_a_scene_is_the_same_aorta() {
    for (preset, aorta) in presets() {
        let text = aorta.scene_text().unwrap();
        let scene: toml::Table = text.parse().unwrap();
        let tables = scene["vessel"]["branch"].as_array().unwrap();
        let arteries = aorta.arteries().unwrap();
        assert_eq!(tables.len(), arteries.len());
        for (table, artery) in tables.iter().zip(&arteries) {
            assert_eq!(table["name"].as_str(), Some(artery.name));
            assert!(text.contains(&format!("# {}: {}\n[[vessel.branch]]", artery.name, artery.remark)));
            let numbers = |value: &toml::Value| match value.as_array() {
                Some(list) => list.iter().map(|v| v.as_float().unwrap() * 1e-3).collect(),
                None => vec![value.as_float().unwrap() * 1e-3; artery.points.len()],
            };
            let points = table["points_mm"].as_array().unwrap().iter().map(numbers);
            let points: Vec<Vector3<f64>> = points.map(|point: Vec<f64>| Vector3::from_vec(point)).collect();
            let radii = numbers(&table["radius_mm"]);
            let rounded = artery.points.iter().zip(&points).map(|(a, b)| (a - b).amax());
            let rounded = rounded.chain(artery.radii.iter().zip(&radii).map(|(a, b)| (a - b).abs()));
            assert!(rounded.fold(0.0, f64::max) < 0.51e-7, "{preset}: {}", artery.name);
            Branch::new(artery.name, &points, &radii).unwrap();
        }
        assert!(text.lines().all(|line| line.len() <= 120) && !text.contains("-0.0,"), "{preset}");
    }
}

#[test]
fn an_aorta_that_cannot_be_is_refused() {
    let standard = Aorta::spatial();
    let sma = |changed: SideArtery| Aorta { sma: changed, ..standard.clone() };
    let own = standard.sma.clone();
    let mut alike = standard.clone();
    alike.left_iliac.common_direction = [0.0; 2];
    alike.right_iliac.common_direction = [0.0; 2];
    let mut short = standard.clone();
    short.left_iliac.external_length = 0.05;
    let mut stub = standard.clone();
    stub.right_iliac.internal_length = 0.01;
    let mut nowhere = standard.clone();
    nowhere.left_iliac.external_direction[1] = f64::NAN;
    for (aorta, expected) in [
        (stub, "length of an internal iliac artery behind its bend (m) = -0.007"),
        (nowhere, "angle (deg) of an iliac artery = NaN"),
        (
            sma(SideArtery { turn: [f64::INFINITY, 0.0], ..own.clone() }),
            "angle (deg) of superior mesenteric = inf",
        ),
        (Aorta { top_width: f64::NAN, ..standard.clone() }, "width of the aorta's top (m) = NaN"),
        (Aorta { access_length: -0.1, ..standard.clone() }, "access length (m) = -0.1"),
        (Aorta { length: 0.1, ..standard.clone() }, "beyond the celiac trunk"),
        (sma(SideArtery { width: 0.0, ..own.clone() }), "superior mesenteric (m) = 0"),
        (
            sma(SideArtery { angle: 0.1, ..own.clone() }),
            "angle (deg) of the artery \"superior mesenteric\" = 5.7",
        ),
        (sma(SideArtery { height: 0.01, ..own.clone() }), "height (m) of an artery's mouth"),
        (sma(SideArtery { height: 0.139, ..own }), "on the aorta's centreline"),
        (alike, "angle (deg) between the common iliac arteries = 0"),
        (short, "straight length (m) of the external iliac artery"),
    ] {
        let refused = aorta.branches().map(drop).expect_err(expected).to_string();
        assert!(refused.contains(expected), "{refused}");
    }
    assert!(standard.route("superior mesenteric", 0.2).is_err());
    let unknown = standard.route("splenic", 0.0).unwrap_err().to_string();
    assert!(unknown.contains("there are celiac trunk, superior mesenteric"), "{unknown}");
}
