//! Tests of `web`.

mod description;

mod device;

/// One segment beside the paper's magnet pair.
const BESIDE: &str = "[design]\nsegments = 1\n[magnet]\nposition_mm = [0.0, -120.0, 5.0]\n";

/// Nine segments that the magnet passes with its field against them: they snap on the way.
const PASSING: &str = "[design]\nsegments = 9\n[magnet]\nposition_mm = [0, -120, -80]\nturn_deg = 180\n\
                       [model]\ninteraction = \"none\"";
