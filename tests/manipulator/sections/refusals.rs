//! What is wrong with a section, in words of the scene.

use super::super::refusals::refusal;

/// A scene with one section that has these lines instead of those of a plain tube.
fn tube(lines: &[&str]) -> String {
    let mut table = vec![
        "length_mm = 30.0",
        "outer_radius_mm = 0.5",
        "inner_radius_mm = 0.2",
        "elastic_modulus_mpa = 2.0",
    ];
    let key = |line: &str| line.split(" = ").next().unwrap_or_default().to_owned();
    for line in lines {
        table.retain(|own| key(own) != key(line.trim_start_matches('-')));
        if !line.starts_with('-') {
            table.push(line);
        }
    }
    format!(
        "[design]\nkind = \"sections\"\n[[design.section]]\nlength_mm = 5.0\nouter_radius_mm = 0.5\n\
         elastic_modulus_mpa = 2.0\n[[design.section]]\n{}",
        table.join("\n")
    )
}

#[test]
#[expect(clippy::too_many_lines, reason = "a table")]
fn refusals_name_section_value_and_range() {
    let two = "design.section[2]";
    for (lines, expected) in [
        (
            &["outer_radius_mm = 0.0000001"][..],
            format!("{two}.outer_radius_mm = 0.0000001 is not allowed: it must be from 0.001 to 1000"),
        ),
        (
            &["inner_radius_mm = 0.5"],
            format!("{two}.inner_radius_mm = 0.5 is not allowed: it must be >= 0 and < its outer radius"),
        ),
        (
            &["inner_radius_mm = [0.1, 0.6]"],
            format!(
                "{two}.inner_radius_mm: section inner radius (m) = 0.0006 is not allowed: it must be >= 0 and < its outer radius"
            ),
        ),
        (&["length_mm = 0.0"], format!("{two}.length_mm = 0 is not allowed: it must be > 0 and <= 1000")),
        (&["-length_mm = "], format!("{two}.length_mm is missing")),
        (
            &["elastic_modulus_mpa = -1.0"],
            format!("{two}.elastic_modulus_mpa = -1 is not allowed: it must be > 0 and <= 1000000"),
        ),
        (&["poisson = 0.5"], format!("{two}.poisson = 0.5 is not allowed: it must be >= 0 and < 0.5")),
        (
            &["direction = [0.0, 0.0, 0.0]"],
            format!(
                "{two}.direction: length of the direction of magnetisation = 0 is not allowed: it must be 1 within 1e-3"
            ),
        ),
        (
            &["direction = [0.0, 1.0, 1.0]"],
            format!(
                "{two}.direction: length of the direction of magnetisation = 1.4142135623730951 is not allowed: it must be 1 within 1e-3"
            ),
        ),
        (
            &["remanence_t = 21.0"],
            format!("{two}.remanence_t = 21 is not allowed: it must be from -20 to 20"),
        ),
        (
            &["rest_curvature_per_m = [2500.0, 0.0, 0.0]"],
            format!(
                "{two}.rest_curvature_per_m: rest curvature (1/m) = 2500 is not allowed: it must be < 2000.000000 in bending: the inner side of the tube would close on itself"
            ),
        ),
        (
            &["rest_curvature_per_m = [0.0, 300.0, 0.0]"],
            format!(
                "{two}.rest_curvature_per_m: rest curvature (1/m) = 300 is not allowed: it must be < 209.439510 as a whole, less than a full turn, or with so much twist that the turns pass one another: the tube would close on itself"
            ),
        ),
        (
            &["direction_turn_deg_per_mm = 1e4"],
            format!(
                "{two}.direction_turn_deg_per_mm = 10000 is not allowed: it must be at most 192 of either sign: sixteen turns in the section"
            ),
        ),
        (&["rigid = true"], format!("{two}.elastic_modulus_mpa has no meaning in a rigid section")),
        (
            &["rigid = true", "-elastic_modulus_mpa = ", "outer_radius_mm = [0.5, 0.4]"],
            format!(
                "{two}.outer_radius_mm: section outer radius (m) = 0.0004 is not allowed: it must be 0.0005 as at the start: a rigid section has no taper"
            ),
        ),
        (
            &["rigid = true", "-elastic_modulus_mpa = ", "rest_curvature_per_m = [1.0, 0.0, 0.0]"],
            format!(
                "{two}.rest_curvature_per_m: rest curvature (1/m) = 1 is not allowed: it must be 0: a rigid section is straight"
            ),
        ),
        (
            &["bending_stiffness_n_m2 = 1e-7"],
            format!(
                "{two}.elastic_modulus_mpa has no meaning beside bending_stiffness_n_m2: give one or the other"
            ),
        ),
        (
            &["bending_stiffness_n_m2 = 1e-7", "-elastic_modulus_mpa = "],
            format!("{two}.torsional_stiffness_n_m2 is missing beside bending_stiffness_n_m2"),
        ),
        (
            &["axial_stiffness_n = 1.0"],
            format!("{two}.axial_stiffness_n has no meaning without bending_stiffness_n_m2"),
        ),
        (
            &[
                "bending_stiffness_n_m2 = 1e-7",
                "torsional_stiffness_n_m2 = 1e-7",
                "axial_stiffness_n = 1.0",
                "-elastic_modulus_mpa = ",
                "outer_radius_mm = [0.5, 0.4]",
            ],
            format!(
                "{two}.outer_radius_mm: section outer radius (m) = 0.0004 is not allowed: it must be 0.0005 as at the start: a section with measured stiffness has no taper"
            ),
        ),
        (
            &["shape = \"ball\"", "-elastic_modulus_mpa = "],
            format!(
                "{two}.length_mm = 30 is not allowed: it must be 0.001, twice the outer radius: it is a ball"
            ),
        ),
        (
            &["remanence_t = 0.1", "volume_fraction = 0.2"],
            format!(
                "{two}.remanence_t has no meaning beside volume_fraction or particle_remanence_t: give one or the other"
            ),
        ),
        (
            &["particle_remanence_t = 0.2"],
            format!("{two}.particle_remanence_t has no meaning without volume_fraction"),
        ),
        (
            &["-elastic_modulus_mpa = "],
            format!(
                "{two} needs one of elastic_modulus_mpa, shore_a and bending_stiffness_n_m2, or rigid = true"
            ),
        ),
        (
            &["outer_radius_mm = [0.5, 0.5, 0.5]"],
            format!(
                "{two}.outer_radius_mm has 3 entries, expected one number, or two: at the start and at the end"
            ),
        ),
        (&["repeat = 0"], format!("{two}.repeat = 0 is not allowed: it must be from 1 to 128")),
        (
            &["elastic_modulus = 2.0"],
            format!("unknown key `{two}.elastic_modulus`; did you mean `elastic_modulus_mpa`?"),
        ),
    ] {
        let told = refusal(&tube(lines));
        assert!(told.ends_with(&expected), "{lines:?}:\n{told}\ninstead of\n{expected}");
    }
}

#[test]
fn what_is_repeated_is_told_by_its_table() {
    let text = "[design]\nkind = \"sections\"\n[[design.section]]\nlength_mm = 1.0\nouter_radius_mm = 0.5\n\
                elastic_modulus_mpa = 2.0\nrepeat = 5\n[[design.section]]\nlength_mm = 1.0\nouter_radius_mm = 0.5\n\
                elastic_modulus_mpa = 2.0\npoisson = 0.7\n";
    let told = refusal(text);
    assert!(told.contains("line 12: design.section[2].poisson = 0.7 is not allowed"), "{told}");

    let many = text.replace("0.7", "0.4\nrepeat = 128");
    let told = refusal(&many);
    assert!(told.contains("number of sections = 133 is not allowed: it must be from 1 to 128"), "{told}");
    let told = refusal(&many.replace("repeat = 5\n", "repeat = 4000000000\n"));
    assert!(
        told.contains("design.section[1].repeat = 4000000000 is not allowed: it must be from 1 to 128"),
        "{told}"
    );
}

#[test]
fn groups_are_refused_by_the_names_they_do_not_find() {
    let text = |group: &str| {
        format!(
            "[design]\nkind = \"sections\"\n[[design.section]]\nname = \"soft\"\nlength_mm = 1.0\nouter_radius_mm = 0.5\n\
             elastic_modulus_mpa = 2.0\n[[design.section]]\nname = \"hard\"\nlength_mm = 1.0\nouter_radius_mm = 0.5\n\
             rigid = true\n[[design.group]]\n{group}"
        )
    };
    for (group, expected) in [
        (
            "sections = [\"soft\", \"hart\"]",
            "design.group[1].sections: no section is named \"hart\"; did you mean `hard`?",
        ),
        ("sections = []", "design.group[1].sections is empty: a group needs at least one section"),
        (
            "sections = [\"soft\"]\nrepeat = 0",
            "design.group[1].repeat = 0 is not allowed: it must be from 1 to 128",
        ),
    ] {
        let told = refusal(&text(group));
        assert!(told.ends_with(expected), "{told}\ninstead of\n{expected}");
    }
    let rigid = "[design]\nkind = \"sections\"\n[[design.section]]\nlength_mm = 1.0\nouter_radius_mm = 0.5\nrigid = true\n";
    assert!(
        refusal(rigid)
            .ends_with("design.section: all sections are rigid; a device needs at least one that is elastic")
    );
    let none = "[design]\nkind = \"sections\"\n";
    assert!(refusal(none).ends_with("design.section is missing: kind = \"sections\" needs at least one"));
    let other = "[[design.section]]\nlength_mm = 1.0\nouter_radius_mm = 0.5\nrigid = true\n";
    assert!(refusal(other).ends_with("design.section belongs to kind = \"sections\""));
}
