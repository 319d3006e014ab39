//! Numbers that look like those of another unit: refused where nothing has them, otherwise warned of.

use mcm::manipulator::SceneFile;

use super::refusals::{numbers, refusal};

#[test]
fn remanences_above_twenty_tesla_are_refused_and_the_likely_unit_is_named() {
    let cylinder = "kind = \"cylinder\"\nlength_mm = 40\nradius_mm = 2\n";
    for (text, key, low) in [
        ("[design.ring]\nremanence_t = VALUE".to_owned(), "design.ring.remanence_t", "0"),
        ("[design.helix]\nparticle_remanence_t = VALUE".to_owned(), "design.helix.particle_remanence_t", "0"),
        (format!("[design]\n{cylinder}particle_remanence_t = VALUE"), "design.particle_remanence_t", "0"),
        (format!("[design]\n{cylinder}elastic_modulus_mpa = 1\nremanence_t = VALUE"), "design.remanence_t", "0"),
        (
            "[magnet]\nposition_mm = [0, -300, 0]\ncylinders = [{ radius_mm = 20, length_mm = 30, remanence_t = VALUE }]".to_owned(),
            "magnet.cylinders[1].remanence_t",
            "-20",
        ),
    ] {
        let with = |value: &str| SceneFile::parse(&text.replace("VALUE", value), "test");
        assert!(with("20").is_ok() && with("20.001").is_err(), "{key}");
        let refused = with("13500").unwrap_err().to_string();
        let expected = format!("{key} = 13500 is not allowed: it must be from {low} to 20; if it was meant in G, it is 1.35 T");
        assert!(refused.ends_with(&expected), "{refused}");
    }
    let refused = refusal("[design.helix]\nlength_mm = 4000");
    assert!(refused.ends_with("it must be > 0 and <= 1000; if it was meant in um, it is 4 mm"), "{refused}");
}

/// Every length and every remanence of a scene, in metres and in kilogauss, is warned of by its key; nothing usual is.
#[test]
fn every_size_and_remanence_in_another_unit_is_warned_of() {
    let tube = "outer_radius_mm = 0.6\ninner_radius_mm = 0.3\npoisson = 0.4\nshore_a = 30";
    let scene = format!(
        "[design]\nsegments = 2\n[design.backbone]\n{tube}\n[magnet]\n[[coil]]\nposition_mm = [0, 300, 0]\ninner_radius_mm = 20\n\
         outer_radius_mm = 40\nlength_mm = 60\nturns = 100\nmultipoles = [1e-7]\nreach_mm = 60\n[feed]\nmode = \"insertion\"\n\
         [feed.shaft]\n{tube}\n[guidewire]\nradius_mm = 0.2\nelastic_modulus_mpa = 1000\n[vessel]\n[[vessel.branch]]\nname = \"b\"\n\
         points_mm = [[0, 0, -30], [0, 0, 60]]\nradius_mm = [8, 8]\n[uncertainty]\n\"design.ring.remanence_t\" = 0.02\n\
         \"design.helix.length_mm\" = 0.01"
    );
    let rod = "[design]\nkind = \"cylinder\"\nlength_mm = 40\nradius_mm = 2\ninner_radius_mm = 1\nelastic_modulus_mpa = 1\nremanence_t = 0.1";
    let mixed = "[design]\nkind = \"cylinder\"\nlength_mm = 40\nradius_mm = 2\nparticle_remanence_t = 1";
    let mut tried = 0;
    for text in [scene.as_str(), rod, mixed] {
        let file = SceneFile::parse(text, "test").unwrap();
        assert!(file.warnings().unwrap().is_empty(), "{:?}", file.warnings());
        let table: toml::Table = file.to_toml().unwrap().parse().unwrap();
        for key in numbers(&toml::Value::Table(table), "") {
            let name = key.split('[').next().unwrap();
            let last = key.rsplit('.').next().unwrap();
            let is_size = ["position", "insertion", "offset", "points", "tolerance"]
                .iter()
                .all(|part| !last.contains(part))
                && last.contains("_mm");
            let is_remanence = last.contains("remanence");
            if !is_size && !is_remanence || name.starts_with("uncertainty") {
                continue;
            }
            // Of 50 mm and more a thousandth is a size that something may have.
            let number = file.number(&key).unwrap();
            if number == 0.0 || is_size && number >= 50.0 {
                continue;
            }
            // The scene may be refused with that number, but it is odd all the same.
            let (value, guess) = if is_size { (number / 1e3, "in m") } else { (14.0, "in kG") };
            let told = file.with(&key, value).unwrap().warnings().unwrap();
            let own = told.iter().find(|odd| odd.starts_with(&format!("{key} = {value}: ")));
            assert!(own.is_some_and(|odd| odd.contains(guess)), "{key}: {told:?}");
            tried += 1;
        }
    }
    assert!(tried >= 28, "{tried}");
    // What is too large by a thousand.
    let far = "[vessel]\n[[vessel.branch]]\nname = \"b\"\npoints_mm = [[0, 0, -30000], [0, 0, 60000]]\nradius_mm = 8";
    let told = SceneFile::parse(far, "test").unwrap().warnings().unwrap();
    assert_eq!(
        told,
        [
            "extent of vessel.branch[1].points_mm = 90000: usual are 0.05 mm to 1 m; if it was meant in um, it is 90 mm"
        ]
    );
}

#[test]
fn no_scene_of_the_project_is_odd() {
    for (name, text) in [
        ("default", include_str!("../../fmu/default.toml")),
        ("coils", include_str!("../../fmu/examples/eight_coils.toml")),
        ("aorta", include_str!("../../fmu/page/src/panel/aorta.toml")),
    ] {
        let told = SceneFile::parse(text, name).unwrap().warnings().unwrap();
        assert!(told.is_empty(), "{name}: {told:?}");
    }
}
