//! `mcm plot`: curves that are where the numbers of the table are.

use std::collections::BTreeSet;
use std::path::PathBuf;

use super::svg::{Axes, Element, elements, names};
use super::{assert_status, folder, mcm, stderr, stdout, table, with_scene};

const SCENE: &str = "[design]\nsegments = 1\n[model]\ninteraction = \"none\"\n";

/// A walk that loses its shape, snaps, and passes an unstable one.
const WALK: &str = "\
k_mm,way,alpha_deg,stable,snaps,converged
0,forth,0,true,0,true
1,forth,10,true,0,true
2,forth,,,0,false
3,forth,30,true,0,true
4,forth,60,true,1,true
5,forth,70,false,1,true
6,forth,80,true,1,true
7,forth,90,true,1,true
";

/// Draws a table.
fn drawn(test: &str, text: &str, more: &[&str]) -> (PathBuf, Vec<Element>) {
    let here = folder(test);
    std::fs::write(here.join("table.csv"), text).unwrap();
    assert_status(&mcm(&here, &[&["plot", "table.csv", "--out", "out.svg"], more].concat()), 0);
    let elements = elements(&here.join("out.svg"));
    (here, elements)
}

fn has_text(elements: &[Element], text: &str) -> bool {
    elements.iter().any(|element| element.text == text)
}

#[test]
fn every_combination_of_a_sweep_has_a_curve_at_its_numbers() {
    let vary = ["--vary", "field.uniform_mt[2]=0:20:5", "--vary", "design.helix.length_mm=3:5:3"];
    let arguments = [&["sweep", "scene.toml"], &vary[..], &["--out", "sweep.csv"]].concat();
    let (here, output) = with_scene("plot", SCENE, &arguments);
    assert_status(&output, 0);
    let output = mcm(&here, &["plot", "sweep.csv", "--out", "sweep.svg"]);
    assert_status(&output, 0);
    assert_eq!(stdout(&output), "sweep.svg: alpha_deg over field.uniform_mt[2], curves: 3\n");
    let elements = elements(&here.join("sweep.svg"));
    let axes = &Axes::of(&elements)[0];
    let curves = axes.curves();
    assert_eq!(curves.len(), 3);
    let rows = table(&here.join("sweep.csv"));
    let number = |row: usize, key: &str| rows[row][key].parse::<f64>().unwrap();
    for (curve, parts) in curves.iter().enumerate() {
        let [path] = parts[..] else { panic!("one line: {parts:?}") };
        let expected: Vec<[f64; 2]> = (5 * curve..5 * curve + 5)
            .map(|row| [number(row, "field.uniform_mt[2]"), number(row, "alpha_deg")])
            .collect();
        axes.assert_at(&path.places(), &expected);
    }
    let colours: BTreeSet<&str> = curves.iter().map(|parts| parts[0].get("stroke")).collect();
    assert_eq!(colours.len(), 3);
    // From top to bottom, as the curves end.
    assert_eq!(names(&elements), ["length = 5 mm", "length = 4 mm", "length = 3 mm"]);
    assert!(has_text(&elements, "field.uniform[2] (mT)") && has_text(&elements, "alpha (deg)"));
    let files = std::fs::read_dir(&here).unwrap().count();
    assert_eq!(files, 3, "a scene, a table and a picture");
}

#[test]
fn gaps_snaps_and_unstable_shapes_are_no_solid_line() {
    let (_, elements) = drawn("plot_walk", WALK, &[]);
    let axes = &Axes::of(&elements)[0];
    let curve = &axes.curves()[0];
    let lines: Vec<&Element> = curve.iter().copied().filter(|part| part.name == "path").collect();
    let [there, doubtful, on] = lines[..] else { panic!("{lines:?}") };
    axes.assert_at(&there.places(), &[[0.0, 0.0], [1.0, 10.0]]);
    axes.assert_at(&doubtful.places(), &[[3.0, 30.0], [4.0, 60.0], [5.0, 70.0], [6.0, 80.0]]);
    axes.assert_at(&on.places(), &[[6.0, 80.0], [7.0, 90.0]]);
    assert_eq!([there, on].map(|line| line.get("stroke-dasharray")), ["", ""]);
    assert!(!doubtful.get("stroke-dasharray").is_empty());
    let snaps: Vec<&&Element> = curve.iter().filter(|part| part.get("class") == "snap").collect();
    assert_eq!(snaps.len(), 1);
    axes.assert_at(&snaps[0].places(), &[[4.0, 60.0]]);
    assert!(elements.iter().any(|element| element.text.starts_with("snap; dotted: ")));
    // Without a snap or a doubt nothing is explained.
    let (_, plain) = drawn("plot_plain", "t_s,b\n0,1\n1,2\n", &[]);
    assert!(!plain.iter().any(|element| element.text.contains("dotted")), "{plain:?}");
    // A number of a row without a shape is not drawn solid either, and one between two gaps is a point.
    let lost = "x_mm,alpha_deg,residual,converged\n0,1,0.1,true\n1,,0.5,false\n2,3,0.1,true\n";
    let (_, lost) = drawn("plot_lost", lost, &["--y", "residual", "alpha_deg"]);
    let axes = Axes::of(&lost);
    assert!(axes[0].curves()[0].iter().all(|part| !part.get("stroke-dasharray").is_empty()));
    let points: Vec<[f64; 2]> = axes[1].curves()[0].iter().flat_map(|part| part.places()).collect();
    axes[1].assert_at(&points, &[[0.0, 1.0], [2.0, 3.0]]);
}

#[test]
fn the_way_back_is_a_dashed_curve_from_where_the_other_ends() {
    let text = "k_mm,way,alpha_deg\n0,forth,0\n1,forth,1\n2,forth,5\n1,back,4\n0,back,3\n";
    let (_, elements) = drawn("plot_back", text, &[]);
    let axes = &Axes::of(&elements)[0];
    let [forth, back] = &axes.curves()[..] else { panic!("two curves") };
    axes.assert_at(&forth[0].places(), &[[0.0, 0.0], [1.0, 1.0], [2.0, 5.0]]);
    axes.assert_at(&back[0].places(), &[[2.0, 5.0], [1.0, 4.0], [0.0, 3.0]]);
    assert_eq!(forth[0].get("stroke"), back[0].get("stroke"));
    assert!(forth[0].get("stroke-dasharray").is_empty() && !back[0].get("stroke-dasharray").is_empty());
    assert_eq!(names(&elements), ["forth", "back (dashed)"]);
}

#[test]
fn several_ordinates_share_the_abscissa() {
    let text = "time,magnet.position[2],magnet.position[3],way,alpha_deg,tip_y_mm\n\
                0,-0.12,0,forth,5,1\n1,-0.11,0.01,forth,7,2\n2,-0.1,0.02,forth,9,4\n";
    let more = ["--y", "tip_y_mm", "alpha_deg", "--y", "magnet.position[3]"];
    let (_, elements) = drawn("plot_panels", text, &more);
    let axes = Axes::of(&elements);
    assert_eq!(axes.len(), 3);
    for (axes, values) in axes.iter().zip([[1.0, 2.0, 4.0], [5.0, 7.0, 9.0], [0.0, 0.01, 0.02]]) {
        let curves = axes.curves();
        assert_eq!(curves.len(), 1, "inputs that move together are one way");
        let expected: Vec<[f64; 2]> = values.iter().zip(0..).map(|(y, x)| [f64::from(x), *y]).collect();
        axes.assert_at(&curves[0][0].places(), &expected);
    }
    let abscissae = elements.iter().filter(|element| element.text == "time (s)");
    assert_eq!(abscissae.count(), 1);
    assert!(names(&elements).is_empty(), "one curve needs no name");
    // Another abscissa than the first.
    let (_, other) = drawn("plot_x", text, &["--x", "alpha_deg"]);
    assert!(has_text(&other, "alpha (deg)") && has_text(&other, "time (s)"));
}

#[test]
fn names_stand_above_where_they_do_not_fit_beside() {
    let row = |key: usize| format!("0,{key},0\n1,{key},{key}\n");
    let text = format!("x_mm,k,alpha_deg\n{}", (0..20).map(row).collect::<String>());
    let (_, elements) = drawn("plot_names", &text, &["--y", "alpha_deg", "alpha_deg"]);
    assert_eq!(Axes::of(&elements)[0].curves().len(), 20);
    let found = names(&elements);
    assert_eq!(found.len(), 20, "once for both axes: {found:?}");
    assert_eq!([found[0], found[19]], ["k = 0", "k = 19"]);
    let text = format!("x_mm,k,alpha_deg\n{}", (0..41).map(row).collect::<String>());
    let here = folder("plot_many");
    std::fs::write(here.join("table.csv"), text).unwrap();
    let output = mcm(&here, &["plot", "table.csv", "--out", "out.svg"]);
    assert_status(&output, 1);
    assert!(
        stderr(&output).contains("41 curves, one for each value of k, are too many"),
        "{}",
        stderr(&output)
    );
}

#[test]
fn what_stands_in_a_table_cannot_break_the_picture() {
    let title = "</text><b>&\"'";
    let here = folder("plot_escaped");
    let name = "a&b<c>.csv";
    let text = format!("\"{}\",alpha_deg\n0,1\n1,2\n", title.replace('"', "\"\""));
    std::fs::write(here.join(name), text).unwrap();
    assert_status(&mcm(&here, &["plot", name, "--out", "out.svg"]), 0);
    let elements = elements(&here.join("out.svg"));
    assert!(has_text(&elements, title) && has_text(&elements, name), "{elements:?}");
    assert!(elements.iter().all(|element| element.name != "b"));
}

#[test]
fn numbers_of_any_size_have_round_ticks() {
    for (values, unit) in [(["1e-7", "3e-7"], 1e-7), (["2000000", "9000000"], 1e6), (["5", "5"], 1.0)] {
        let (_, elements) = drawn(
            "plot_size",
            &format!("x_s,energy_j\n0,{}\n1,{}\n", values[0], values[1]),
            &["--y", "energy_j"],
        );
        let axes = &Axes::of(&elements)[0];
        let expected: Vec<[f64; 2]> =
            values.iter().zip(0..).map(|(y, x)| [f64::from(x), y.parse().unwrap()]).collect();
        axes.assert_at(&axes.curves()[0][0].places(), &expected);
        for tick in elements.iter().filter(|element| element.get("class") == "y") {
            let steps = tick.text.parse::<f64>().unwrap() / unit * 10.0;
            assert!((steps - steps.round()).abs() < 1e-6, "{}", tick.text);
        }
    }
}

#[test]
fn bad_input_is_refused_before_anything_is_written() {
    let good = "x_mm,name,alpha_deg,empty_mm\n0,a,1,\n1,b,2,\n";
    for (test, text, more, expected) in [
        ("x", good, &["--x", "x_m"][..], "there is no column x_m; did you mean x_mm?"),
        ("y", good, &["--y", "alfa_deg"], "there is no column alfa_deg; did you mean alpha_deg?"),
        ("far", good, &["--y", "qqqqqqqqqq"], "there is no column qqqqqqqqqq\n"),
        ("words", good, &["--y", "name"], "line 2: name = \"a\" is not a finite number"),
        ("empty", good, &["--y", "empty_mm"], "empty_mm has no value to draw"),
        ("none", "a,b\nx,y\n", &[], "there is no column of numbers under a title"),
        ("rows", "a,b\n", &[], "there are no rows"),
        ("blank", "", &[], "there are no rows"),
        ("still", "a_mm,alpha_deg\n1,2\n1,2\n", &[], "no column of numbers varies"),
        ("alone", "a_mm,b\n1,2\n2,2\n", &[], "only one column of numbers varies"),
        ("twice", "a,a\n1,2\n2,3\n", &[], "two columns are called a"),
        ("nan", "a_mm,alpha_deg\n1,2\n2,nan\n", &[], "line 3: alpha_deg = \"nan\" is not a finite number"),
        ("ragged", "a_mm,alpha_deg\n1,2\n2\n", &[], "cannot read table.csv"),
    ] {
        let here = folder(&format!("plot_bad_{test}"));
        std::fs::write(here.join("table.csv"), text).unwrap();
        let output = mcm(&here, &[&["plot", "table.csv", "--out", "out.svg"], more].concat());
        assert_status(&output, 1);
        assert!(stderr(&output).contains(expected), "{test}: {}", stderr(&output));
        assert!(!here.join("out.svg").exists(), "{test}");
    }
    let here = folder("plot_bad_out");
    std::fs::write(here.join("table.csv"), good).unwrap();
    for (out, expected) in [
        ("table.csv", "table.csv would be written over table.csv, which is read"),
        ("out.png", "--out out.png must end in .svg"),
        ("out", "--out out must end in .svg"),
        ("out.toml", "called like a scene"),
        ("no/out.svg", "there is no folder no"),
    ] {
        let output = mcm(&here, &["plot", "table.csv", "--out", out]);
        assert_status(&output, 1);
        assert!(stderr(&output).contains(expected), "{out}: {}", stderr(&output));
    }
    let output = mcm(&here, &["plot", "tabel.csv", "--out", "out.svg"]);
    assert_status(&output, 1);
    assert!(stderr(&output).contains("did you mean table.csv?"), "{}", stderr(&output));
    assert_eq!(std::fs::read_to_string(here.join("table.csv")).unwrap(), good);
    assert_eq!(std::fs::read_dir(&here).unwrap().count(), 1, "nothing else is left");
}
