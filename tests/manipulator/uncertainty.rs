//! The tables that say how well the numbers of a scene are known.

use mcm::manipulator::{SceneFile, Uncertainty};
use nalgebra::dmatrix;

use super::refusals::refusal;

const SCENE: &str = "[design]\nsegments = 1\n[field]\n";

fn keys() -> [String; 2] {
    ["design.ring.remanence_t", "design.helix.shore_a"].map(str::to_owned)
}

#[test]
fn what_is_written_is_read_again_in_order() {
    let correlation = dmatrix![1.0, -0.4; -0.4, 1.0];
    let given = Uncertainty::new(&keys(), &[0.02, 1.0], &correlation).unwrap();
    let file = SceneFile::parse(SCENE, "test").unwrap();
    assert!(file.uncertainty().unwrap().keys.is_empty());
    let written = file.with_uncertainty(&given).unwrap().to_toml().unwrap();
    let read = SceneFile::parse(&written, "test").unwrap().uncertainty().unwrap();
    assert_eq!(read, given);
    assert_eq!(read.keys, ["design.helix.shore_a", "design.ring.remanence_t"]);
    assert_eq!(read.deviations, [1.0, 0.02]);
    assert_eq!(read.covariance(), dmatrix![1.0, -0.4 * 0.02; -0.4 * 0.02, 0.02 * 0.02]);
}

#[test]
fn what_contradicts_itself_is_refused_at_its_line() {
    let refused = |tables: &str| refusal(&format!("{SCENE}{tables}"));
    assert_eq!(
        refused("[uncertainty]\n\"design.helix.shore\" = 1.0"),
        "test, line 4: uncertainty: unknown key `design.helix.shore`; did you mean `shore_a`?"
    );
    assert_eq!(
        refused("[uncertainty]\n\"design.helix.shore_a\" = 0.0"),
        "test, line 4: uncertainty: `design.helix.shore_a` = 0 is not allowed: it must be > 0"
    );
    let two =
        "[uncertainty]\n\"design.helix.shore_a\" = 1.0\n\"design.ring.remanence_t\" = 0.02\n[correlation]\n";
    assert_eq!(
        refused(&format!("{two}\"design.helix.shore_a, design.ring.remanence_t\" = 1.5")),
        "test, line 7: correlation: `design.ring.remanence_t, design.helix.shore_a` = 1.5 is not allowed: it must be from -1 to 1"
    );
    assert_eq!(
        refused(&format!("{two}\"design.helix.shore_a, design.helix.poisson\" = 0.5")),
        "test, line 7: correlation: `design.helix.shore_a, design.helix.poisson` does not name two keys of [uncertainty], as \
         \"key, other key\""
    );
    assert_eq!(
        refused(&format!("{two}\"design.helix.shore_a, design.ring.remanence_t\" = -1.0")),
        "test, line 7: correlation: the correlations contradict one another: their matrix is not positive definite"
    );
    assert!(Uncertainty::new(&keys(), &[1.0], &dmatrix![1.0, 0.0; 0.0, 1.0]).is_err());
}
