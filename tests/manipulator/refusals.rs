//! What a scene file is refused for, and in which words.

use mcm::manipulator::{Scene, SceneFile};

/// Why a text is refused.
pub(super) fn refusal(text: &str) -> String {
    Scene::parse(text, "test").expect_err(text).to_string()
}

#[test]
fn refusals_name_line_path_and_remedy() {
    for (text, expected) in [
        ("[desing]", "test, line 1: unknown key `desing`; did you mean `design`?"),
        (
            "[design]\n\n[design.helix]\nlenght_mm = 4.0",
            "test, line 4: unknown key `design.helix.lenght_mm`; did you mean `length_mm`?",
        ),
        (
            "[magnet]\ncylinders = [{ radius_mm = 1, length_mm = 1, remanence_t = 1, remanense = 2 }]",
            "test, line 2: unknown key `magnet.cylinders[1].remanense`; did you mean `remanence_t`?",
        ),
        ("[gravity]\nx = 1", "test, line 2: unknown key `gravity.x`; known here: acceleration_m_s2"),
        (
            "[field]\nuniform_mt = [1, 2]",
            "test, line 2: `field.uniform_mt`: invalid length 2, expected an array of length 3",
        ),
        (
            "[field]\nuniform_mt = \"strong\"",
            "test, line 2: `field.uniform_mt`: invalid type: string \"strong\", expected an array of length 3",
        ),
        (
            "[field]\nuniform_mt = [0, nan, 0]",
            "test, line 2: field.uniform_mt[2] = NaN is not allowed: it must be finite",
        ),
        (
            "[load]\ntip_force_n = [0, 0, inf]",
            "test, line 2: load.tip_force_n[3] = inf is not allowed: it must be finite",
        ),
        (
            "[base]\norientation_wxyz = [0, 0, 0, 0]",
            "test, line 2: norm of base.orientation_wxyz = 0 is not allowed: it must be 1 within 1e-3",
        ),
        (
            "[load]\nring_force_n = [[0, 0, 1]]",
            "test, line 2: load.ring_force_n has 1 entries, expected 10, one for each ring of the design",
        ),
        (
            "[model]\ninteraction = \"all\"",
            "test, line 2: `model.interaction`: \"all\" is not a level: choose one of none, preceding, rings, full, auto",
        ),
        (
            "[model]\nmethod = \"shoting\"",
            "test, line 2: `model.method`: \"shoting\" is not available in this version: choose one of potential, shooting-fd, \
             shooting, multiple-shooting, collocation, constant-curvature, planar",
        ),
        (
            "[model]\nbending_stop = \"yes\"",
            "test, line 2: `model.bending_stop`: invalid type: string \"yes\", expected a boolean",
        ),
        (
            "[design]\nlength_mm = 4",
            "test, line 2: design.length_mm belongs to kind = \"cylinder\"; the segments' dimensions are in design.helix and \
             design.ring",
        ),
        (
            "[design]\nsegments = 3\nspiral_start_deg = [0, 90]",
            "test, line 3: design.spiral_start_deg has 2 entries, expected 3, one for each segment",
        ),
        (
            "[design]\nspiral_start_deg = -360.5",
            "test, line 2: design.spiral_start_deg = -360.5 is not allowed: it must be from -360 to 360",
        ),
        (
            "[design]\nsegments = 2\nspiral_start_deg = [0, 400]",
            "test, line 3: design.spiral_start_deg[2] = 400 is not allowed: it must be from -360 to 360",
        ),
        (
            "[design]\nsegments = 2\nspiral_start_deg = [0, nan]",
            "test, line 3: design.spiral_start_deg[2] = NaN is not allowed: it must be finite",
        ),
        (
            "[design]\nspiral_start_deg = \"east\"",
            "test, line 2: `design.spiral_start_deg`: invalid type: string \"east\", expected a number, or a list with one \
             number for each segment",
        ),
        (
            "[design]\nkind = \"cylinder\"\nspiral_start_deg = 90",
            "test, line 3: design.spiral_start_deg belongs to kind = \"segments\"",
        ),
        (
            "[design]\nkind = \"cylinder\"\nsegments = 2",
            "test, line 3: design.segments belongs to kind = \"segments\"",
        ),
        ("[design]\nkind = \"cylinder\"", "test, line 1: design.length_mm is missing"),
        (
            "[design]\nsegments = 2000000000",
            "test, line 2: design.segments = 2000000000 is not allowed: it must be from 1 to 64",
        ),
    ] {
        assert_eq!(refusal(text), expected, "{text}");
    }
    assert!(refusal("[field").contains("line 1"));
    assert!(refusal("[field]\n[field]").contains("line 2"));
}

#[test]
fn all_faults_are_told_at_once_in_the_order_of_the_text() {
    let text = "\
[design]
segmets = 3
kind = \"segments\"
[design.helix]
length_mm = -4
boundary_angle_deg = 200
shore_a = 120.0
[field]
uniform_mt = [0, 20]
turn_deg = 1e6
[magnet]
strength = nan
cylinders = [{ radius_mm = 0, length_mm = 30, remanence_t = 1 }]
[gravity]
acceleration_m_s2 = [0, 0, -9.81, 0]
[model]
bending_stop = 1
";
    let refused = refusal(text);
    let lines: Vec<&str> = refused.lines().collect();
    assert_eq!(
        lines,
        [
            "test, line 2: unknown key `design.segmets`; did you mean `segments`?",
            "test, line 5: design.helix.length_mm = -4 is not allowed: it must be > 0 and <= 1000",
            "test, line 6: design.helix.boundary_angle_deg = 200 is not allowed: it must be > 0 and <= 180",
            "test, line 7: design.helix.shore_a = 120 is not allowed: it must be > 0 and < 100",
            "test, line 9: `field.uniform_mt`: invalid length 2, expected an array of length 3",
            "test, line 10: field.turn_deg = 1000000 is not allowed: it must be from -36000 to 36000",
            "test, line 12: magnet.strength = NaN is not allowed: it must be finite",
            "test, line 13: magnet.cylinders[1].radius_mm = 0 is not allowed: it must be > 0.000001 and <= 1000000",
            "test, line 15: gravity.acceleration_m_s2 has 4 entries, expected 3",
            "test, line 17: `model.bending_stop`: invalid type: integer `1`, expected a boolean",
        ]
    );
    let cascade = "[design]\nspiral = \"alternatng\"\nspiral_start_deg = [0, 240]\nsegments = 3\n[design.helix]\nlength_mm = 1.0\n[base]\norientation_wxyz = [0, 0, 0, 0]";
    let refused = refusal(cascade);
    let lines: Vec<&str> = refused.lines().collect();
    assert_eq!(
        lines[0],
        "test, line 2: `design.spiral`: \"alternatng\" is not known here: choose one of helical, axisymmetric, alternating"
    );
    assert!(lines[1].starts_with("test, line 5: design.helix: winding height h (m) = "), "{refused}");
    assert!(lines[2].starts_with("test, line 8: norm of base.orientation_wxyz = 0"), "{refused}");
    assert!(refusal("[design]\nsegments = 3\nsegments = 4").contains("line 3: duplicate key `segments`"));
    assert!(refusal("[field]\nuniform_mt = [1, 2,, 3]\n[gravity\n").lines().count() >= 2);
}

#[test]
fn arrays_that_are_too_long_are_refused() {
    for (table, key, most) in [
        ("gravity", "acceleration_m_s2", 3),
        ("field", "uniform_mt", 3),
        ("field", "gradient_t_per_m", 5),
        ("field", "turn_axis", 3),
        ("magnet", "position_mm", 3),
        ("magnet", "orientation_wxyz", 4),
        ("base", "position_mm", 3),
        ("base", "orientation_wxyz", 4),
        ("load", "tip_force_n", 3),
        ("load", "tip_moment_nm", 3),
    ] {
        let array = |length| vec!["1"; length].join(", ");
        let expected = format!("test, line 2: {table}.{key} has {} entries, expected {most}", most + 1);
        let refused = refusal(&format!("[{table}]\n{key} = [{}]", array(most + 1)));
        // Four ones are no unit quaternion either.
        assert_eq!(refused.lines().next(), Some(expected.as_str()));
    }
    let forces = "[design]\nsegments = 1\n[load]\nring_force_n = [[0, 0, 1], [0, 0, 1, 2]]";
    assert_eq!(refusal(forces), "test, line 4: load.ring_force_n[2] has 4 entries, expected 3");
}

/// Every number of the file that has a limit, out of it: the message names the key and the number as written.
#[test]
fn what_is_out_of_range_is_named_as_the_file_writes_it() {
    let cylinder =
        "kind = \"cylinder\"\nlength_mm = 40\nradius_mm = 2\ninner_radius_mm = 1\ndensity_kg_m3 = 1000";
    let composite = "shore_a = 30\npoisson = 0.4\nvolume_fraction = 0.2\nparticle_remanence_t = 1.0";
    let bulk = "elastic_modulus_mpa = 1.5\npoisson = 0.4\nremanence_t = 0.1";
    let tube = "[design.backbone]\nouter_radius_mm = 0.5\ninner_radius_mm = 0.3\npoisson = 0.4\ndensity_kg_m3 = 1000";
    let segments = "[design]\nsegments = 2\n[design.helix]\ndensity_kg_m3 = 2000\n[magnet]";
    for (text, prefix) in [
        (segments.to_owned(), "design.segments"),
        (segments.to_owned(), "design.helix."),
        (segments.to_owned(), "design.ring."),
        (segments.to_owned(), "magnet.cylinders[2]."),
        (segments.to_owned(), "magnet.turn_deg"),
        (format!("{segments}\n{tube}\nshore_a = 30"), "design.backbone."),
        (format!("{segments}\n{tube}\nelastic_modulus_mpa = 2"), "design.backbone."),
        (format!("[design]\n{cylinder}\n{composite}"), "design."),
        (format!("[design]\n{cylinder}\n{bulk}"), "design."),
        (String::new(), "field.turn_deg"),
        (String::new(), "base.turn_deg"),
        (String::new(), "model.time_budget_s"),
    ] {
        let file = SceneFile::parse(&text, "test").unwrap();
        let table: toml::Table = file.to_toml().unwrap().parse().unwrap();
        let keys = numbers(&toml::Value::Table(table), "");
        let keys: Vec<&String> = keys.iter().filter(|key| key.starts_with(prefix)).collect();
        assert!(!keys.is_empty(), "{prefix}");
        for key in keys {
            // A count below zero is no count at all.
            let value = if *key == "design.segments" { 9e8 } else { -9e8 };
            let refused = file.with(key, value).and_then(|file| file.scene()).unwrap_err().to_string();
            assert!(refused.starts_with(&format!("{key} = {value} is not allowed")), "{key}: {refused}");
        }
    }
}

/// Paths of all numbers.
pub(super) fn numbers(value: &toml::Value, path: &str) -> Vec<String> {
    match value {
        toml::Value::Float(_) | toml::Value::Integer(_) => vec![path.to_owned()],
        toml::Value::Table(table) => {
            let inside = |key: &str| if path.is_empty() { key.to_owned() } else { format!("{path}.{key}") };
            table.iter().flat_map(|(key, value)| numbers(value, &inside(key))).collect()
        }
        toml::Value::Array(array) => array
            .iter()
            .enumerate()
            .flat_map(|(index, value)| numbers(value, &format!("{path}[{}]", index + 1)))
            .collect(),
        _ => Vec::new(),
    }
}

#[test]
fn a_key_of_a_missing_table_says_so_and_an_optional_number_can_be_set() {
    let with = |text: &str, key: &str| {
        let file = SceneFile::parse(text, "test").unwrap();
        file.with(key, 1.5).map_err(|error| error.to_string())
    };
    let refused = with("", "magnet.turn_deg").unwrap_err();
    assert_eq!(refused, "no key `magnet.turn_deg`: this scene has no table [magnet]");
    let refused = with("", "design.backbone.poisson").unwrap_err();
    assert_eq!(refused, "no key `design.backbone.poisson`: this scene has no table [design.backbone]");
    assert!(with("[magnet]", "magnet.turn_deg").is_ok());
    let file = with("", "design.helix.density_kg_m3").unwrap();
    assert!(file.to_toml().unwrap().contains("density_kg_m3 = 1.5"));
    let refused = with("", "design.helix.densitty_kg_m3").unwrap_err();
    assert!(refused.starts_with("unknown key `design.helix.densitty_kg_m3`; known here:"), "{refused}");
}

#[test]
fn what_is_known_is_what_a_device_of_that_kind_has() {
    let known = |text: &str| {
        let refused = refusal(text);
        let (_, known) = refused.split_once("known here: ").unwrap_or_else(|| panic!("{refused}"));
        known.split(", ").map(str::to_owned).collect::<Vec<_>>()
    };
    let segments = [
        "kind",
        "segments",
        "base_magnet",
        "tip_magnet",
        "spiral",
        "spiral_start_deg",
        "helix",
        "ring",
        "backbone",
    ];
    assert_eq!(known("[design]\nxyzzy = 1"), segments);
    assert_eq!(known("[design]\nxyzzy = 1\nkind = \"segments\""), segments);
    let rod = "[design]\nkind = \"cylinder\"\nlength_mm = 40\nradius_mm = 2\n";
    let of_rod = [
        "kind",
        "length_mm",
        "radius_mm",
        "inner_radius_mm",
        "shore_a",
        "elastic_modulus_mpa",
        "poisson",
        "volume_fraction",
        "particle_remanence_t",
        "remanence_t",
        "density_kg_m3",
    ];
    assert_eq!(known(&format!("{rod}xyzzy = 1")), of_rod);
    // What is near is of that kind, too.
    assert!(refusal(&format!("{rod}segmens = 1")).contains("known here: kind, length_mm"));
    assert!(refusal(&format!("{rod}shor_a = 1")).ends_with("did you mean `shore_a`?"));
    // A path names keys that the file leaves out, too.
    for (text, own) in [("", &segments[..]), (rod, &of_rod[..])] {
        let refused = SceneFile::parse(text, "test").unwrap().number("design.xyzzy").unwrap_err().to_string();
        assert!(refused.ends_with(&own.join(", ")), "{refused}");
    }
}

#[test]
fn what_is_wrong_besides_the_mesh_is_told_before_it_is_sampled() {
    let mesh = "[vessel]\nmesh_stl = \"vessel.stl\"\n";
    for (text, expected) in [
        ("[feed]\nmode = \"insertion\"\n", "test: feed.shaft is missing"),
        ("[design.helix]\nshore_a = 120\n", "test, line 4: design.helix.shore_a = 120 is not allowed"),
        ("wall_modulus_mpa = -1\n", "test, line 3: vessel.wall_modulus_mpa = -1 is not allowed"),
        ("friction = 11\n", "test, line 3: vessel.friction = 11 is not allowed"),
        (
            "[[vessel.branch]]\nname = \"b\"\npoints_mm = [[0, 0, 0], [0, 0, 9]]\nradius_mm = 3\n",
            "vessel.mesh_stl has no meaning",
        ),
    ] {
        let sampled = std::cell::Cell::new(false);
        let refused = SceneFile::parse_with(&format!("{mesh}{text}"), "test", |_| {
            sampled.set(true);
            Err(mcm::error::Error::Unsupported("sampled".into()))
        });
        let refused = refused.unwrap_err().to_string();
        assert!(refused.contains(expected), "{refused}");
        assert!(!sampled.get(), "{text}");
    }
}
