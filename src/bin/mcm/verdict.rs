//! Status and stability of a solution, in the words of JSON and CSV, and the resulting exit status.

use mcm::manipulator::{Collapse, Outcome, Outputs, Status};

use super::failure::{NEUTRAL, NOT_CONVERGED, UNSTABLE};

/// Whether a shape was found at the requested inputs.
pub(crate) fn converged(outputs: &Outputs) -> bool {
    outputs.status != Status::NotSolved
}

/// How the solve ended.
pub(crate) fn status(outputs: &Outputs) -> &'static str {
    match outputs.status {
        Status::Solved => "solved",
        Status::NearFold => "near_fold",
        Status::Snapped => "snapped",
        Status::NotSolved => "not_converged",
    }
}

/// Stability of the shape, as far as it is known; `None` without a shape.
///
/// In a neutral shape one direction is free up to rounding, so that it is neither stable nor unstable.
pub(crate) fn stability(outputs: &Outputs) -> Option<&'static str> {
    converged(outputs).then_some(match (outputs.outcome, outputs.stable) {
        (Outcome::Neutral, _) => "neutral",
        (_, Some(true)) => "stable",
        (_, Some(false)) => "unstable",
        (_, None) => "unknown",
    })
}

/// What happened and what to do about it; `None` where an equilibrium was found that is not neutral, within the tolerance, of a device
/// that its rings do not pull shut.
pub(crate) fn reason(outputs: &Outputs, collapse: Option<&Collapse>) -> Option<String> {
    let shut = collapse.map(Collapse::to_string);
    let own = if outputs.outcome == Outcome::Solved {
        doubt(outputs)
    } else {
        // Without a shape, the advice of the outcome is for devices that stand.
        Some(outputs.outcome.to_string()).filter(|_| shut.is_none() || converged(outputs))
    };

    let said: Vec<String> = own.into_iter().chain(shut).collect();
    (!said.is_empty()).then(|| said.join("; "))
}

/// That the error of a shape is larger than its tolerance; `None` where it is not, and where the shape is free to turn.
pub(crate) fn doubt(outputs: &Outputs) -> Option<String> {
    let known = converged(outputs) && outputs.outcome == Outcome::Solved;
    (known && outputs.beyond_tolerance).then(|| {
        let error = 1e3 * outputs.error_estimate;
        format!("the tip may be off by {error:.3} mm, which is more than the tolerances of the model allow")
    })
}

/// Exit status and warning for a shape that was not found, or is unstable or neutral; otherwise `None`.
pub(crate) fn warning(outputs: &Outputs, collapse: Option<&Collapse>) -> Option<(u8, String)> {
    match stability(outputs) {
        None => {
            let (percent, outcome) = (100.0 * outputs.progress, outputs.outcome);
            let why = match collapse {
                Some(shut) => format!(": {shut}"),
                None => format!(", {percent:.1} % of the way from the unloaded shape: {outcome}"),
            };
            Some((NOT_CONVERGED, format!("not converged{why}")))
        }
        Some("neutral") => Some((NEUTRAL, outputs.outcome.to_string())),
        Some("unstable") => Some((UNSTABLE, "the equilibrium is unstable".into())),
        Some(_) => None,
    }
}

#[cfg(test)]
mod tests {
    use mcm::manipulator::Scene;

    use super::*;

    #[test]
    fn exit_status_says_what_is_known() -> Result<(), mcm::error::Error> {
        let scene = Scene::parse("[design]\nsegments = 1", "one segment")?;
        let straight = scene.manipulator(2)?.outputs().clone();
        let exit = |status, stable, outcome| {
            warning(&Outputs { status, stable, outcome, ..straight.clone() }, None).map(|(number, _)| number)
        };
        assert_eq!(exit(Status::Solved, Some(true), Outcome::Solved), None);
        assert_eq!(exit(Status::Snapped, Some(true), Outcome::Solved), None);
        assert_eq!(exit(Status::Solved, None, Outcome::Solved), None, "no potential, no verdict");
        assert_eq!(exit(Status::Solved, Some(false), Outcome::Solved), Some(3));
        assert_eq!(exit(Status::NearFold, Some(false), Outcome::Neutral), Some(4));
        assert_eq!(exit(Status::NotSolved, Some(true), Outcome::BranchEnds), Some(2));
        Ok(())
    }
}
