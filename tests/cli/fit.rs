//! `mcm fit`.

use mcm::manipulator::SceneFile;

use super::{assert_status, folder, mcm, stderr, stdout};

/// One segment with this hardness and remanence.
fn scene(hardness: f64, remanence: f64) -> String {
    format!(
        "[design]\nsegments = 1\n[design.helix]\nshore_a = {hardness}\n[design.ring]\nremanence_t = {remanence}\n[field]\n\
         uniform_mt = [0.0, 4.0, 0.0]\n[load]\n[model]\ninteraction = \"rings\"\n"
    )
}

const OUTPUTS: &str = "alpha_deg,tip_y_mm,tip_z_mm";

/// The table of a sweep of the true device, over fields and forces.
fn swept(here: &std::path::Path) {
    std::fs::write(here.join("true.toml"), scene(35.0, 1.3)).unwrap();
    std::fs::write(here.join("scene.toml"), scene(33.0, 1.35)).unwrap();
    let arguments = [
        "sweep",
        "true.toml",
        "--vary",
        "load.tip_force_n[2]=0:0.02:2",
        "--vary",
        "field.uniform_mt[2]=2:14:7",
    ];
    assert_status(&mcm(here, &[&arguments[..], &["--out", "swept.csv"]].concat()), 0);
    // A laboratory's table has numbers only.
    let mut table = csv::Reader::from_path(here.join("swept.csv")).unwrap();
    let header = table.headers().unwrap().clone();
    let wanted =
        ["load.tip_force_n[2]", "field.uniform_mt[2]", "alpha_deg", "tip_y_mm", "tip_z_mm", "energy_j"];
    let places = wanted.map(|name| header.iter().position(|title| title == name).unwrap());
    let mut lines = vec![wanted.join(",")];
    for record in table.records() {
        let record = record.unwrap();
        lines.push(places.map(|place| record[place].to_owned()).join(","));
    }
    std::fs::write(here.join("data.csv"), lines.join("\n")).unwrap();
}

#[test]
fn a_sweep_of_the_true_device_gives_its_numbers_back() {
    let here = folder("fit");
    swept(&here);
    let arguments = [
        "fit",
        "scene.toml",
        "--measured",
        "data.csv",
        "--vary",
        "design.helix.shore_a",
        "--vary",
        "design.ring.remanence_t",
        "--use",
        OUTPUTS,
        "--out",
        "fit.toml",
        "--picture",
        "fit.png",
    ];
    let output = mcm(&here, &arguments);
    assert_status(&output, 0);
    let text = stdout(&output);
    assert!(
        text.starts_with("parameter") && text.contains("correlation of design.helix.shore_a and"),
        "{text}"
    );
    assert!(text.contains("alpha_deg: 14 values"), "{text}");
    let file = SceneFile::parse(&std::fs::read_to_string(here.join("fit.toml")).unwrap(), "fit").unwrap();
    for (key, wanted) in [("design.helix.shore_a", 35.0), ("design.ring.remanence_t", 1.3)] {
        let value = file.number(key).unwrap();
        assert!((value / wanted - 1.0).abs() < 1e-6, "{key}: {value}");
    }
    assert_eq!(file.uncertainty().unwrap().keys, ["design.helix.shore_a", "design.ring.remanence_t"]);
    let picture = std::fs::read(here.join("fit.png")).unwrap();
    assert!(picture.starts_with(b"\x89PNG") && picture.len() > 5000);
    // The result is a scene to go on with.
    assert_status(&mcm(&here, &["solve", "fit.toml", "--uncertainty"]), 0);
}

#[test]
fn what_cannot_be_told_is_named_and_the_scene_has_no_uncertainty() {
    let here = folder("fit untold");
    let text = "[design]\nkind = \"cylinder\"\nlength_mm = 40.0\nradius_mm = 1.0\nelastic_modulus_mpa = 2.0\nremanence_t = 0.2\n\
                [field]\nuniform_mt = [0.0, 0.0, 0.0]\n[model]\ninteraction = \"none\"\n";
    std::fs::write(here.join("scene.toml"), text).unwrap();
    std::fs::write(here.join("data.csv"), "field.uniform_mt[2],alpha_deg\n1,20\n2,32\n3,41\n").unwrap();
    let arguments = [
        "fit",
        "scene.toml",
        "--measured",
        "data.csv",
        "--vary",
        "design.elastic_modulus_mpa",
        "--vary",
        "design.remanence_t",
        "--out",
        "fit.toml",
    ];
    let output = mcm(&here, &arguments);
    assert_status(&output, 2);
    assert!(
        stderr(&output).contains("cannot be told apart by these rows; add a row with"),
        "{}",
        stderr(&output)
    );
    assert!(stdout(&output).contains("not told"));
    assert!(!std::fs::read_to_string(here.join("fit.toml")).unwrap().contains("[uncertainty]"));
}

#[test]
fn bad_tables_are_refused_and_nothing_is_written() {
    let here = folder("fit bad");
    std::fs::write(here.join("scene.toml"), scene(33.0, 1.35)).unwrap();
    let fit = |table: &str, more: &[&str]| {
        std::fs::write(here.join("data.csv"), table).unwrap();
        let arguments = ["fit", "scene.toml", "--measured", "data.csv", "--vary", "design.helix.shore_a"];
        let output = mcm(&here, &[&arguments[..], more].concat());
        assert_status(&output, 1);
        assert!(!here.join("fit.toml").exists());
        stderr(&output)
    };
    let out = ["--out", "fit.toml"];
    for (table, reason) in [
        ("field.uniform_mt[2],alpha_deg\n", "data.csv has no rows"),
        ("field.uniform_mt[2]\n1\n", "has no column with a measured output"),
        ("field.uniform_mt[2],alpha\n1,2\n", "alpha is no input of the scene and no output"),
        ("field.uniform_mt[2],alpha_dge\n1,2\n", "did you mean alpha_deg?"),
        ("field.uniform_mt[2],alpha_deg\n1,nan\n", "line 2: alpha_deg = \"nan\" is not a finite number"),
        (
            "field.uniform_mt[2],alpha_deg,sd_alpha_deg\n1,2,0\n",
            "line 2: standard deviation of alpha_deg = 0",
        ),
        ("field.unifrom_mt[2],alpha_deg\n1,2\n", "field.unifrom_mt"),
        ("design.helix.radius_mm,alpha_deg\n2,2\n", "is no input"),
        ("field.uniform_mt[2],alpha_deg,alpha_deg\n1,2,3\n", "two columns alpha_deg"),
    ] {
        let said = fit(table, &out);
        assert!(said.contains(reason), "{table}: {said}");
    }
    let fine = "field.uniform_mt[2],alpha_deg\n1,2\n";
    assert!(fit(fine, &["--out", "fit.txt"]).contains("must end in .toml"));
    assert!(fit(fine, &["--out", "scene.toml"]).contains("which is read"));
    assert!(fit(fine, &["--out", "fit.toml", "--picture", "fit.svg"]).contains("must end in .png"));
    assert!(
        fit(fine, &["--out", "fit.toml", "--use", "alpha"])
            .contains("--use: `alpha` is nothing that can be measured")
    );
    assert!(
        fit(fine, &["--out", "fit.toml", "--vary", "design.ring.remanence_t"])
            .contains("at least 2, one for each parameter")
    );
}
