//! Parameters from measured rows.

mod derivatives;
mod intervals;
mod rows;
mod synthetic;
mod tell_apart;

use mcm::fit::{Fit, Measurable, Measurements, Settings};
use mcm::manipulator::SceneFile;

/// One segment in a field.
const ONE: &str =
    "[design]\nsegments = 1\n[field]\nuniform_mt = [0, 10, 0]\n[model]\ninteraction = \"rings\"";

fn scene(text: &str) -> SceneFile {
    SceneFile::parse(text, "test").unwrap()
}

/// What a device with these values measures at these inputs: a cell for each input and output.
fn measure(file: &SceneFile, truth: &[(&str, f64)], inputs: &[(&str, f64)], outputs: &[&str]) -> Vec<f64> {
    let all = truth.iter().chain(inputs);
    let file = all.fold(file.clone(), |file, (key, value)| file.with(key, *value).unwrap());
    let scene = file.scene().unwrap();
    let mut manipulator = scene.manipulator(2).unwrap();
    let solved = manipulator.solve(&scene.inputs).unwrap();
    let values = outputs.iter().map(|name| Measurable::named(name).unwrap().read(solved));
    inputs.iter().map(|input| input.1).chain(values).collect()
}

fn table(file: &SceneFile, titles: &[&str], rows: &[Vec<f64>]) -> Measurements {
    let text: Vec<Vec<String>> = rows.iter().map(|row| row.iter().map(f64::to_string).collect()).collect();
    let rows = text.iter().zip(2..).map(|(row, line)| (line, row.iter().map(String::as_str).collect()));
    Measurements::parse(file, titles, rows).unwrap()
}

fn fitted(file: &SceneFile, keys: &[&str], measured: &Measurements) -> Fit {
    Fit::new(file, keys, measured, &Settings::default()).unwrap()
}
