//! Names of columns as labels: in words, with the unit that the name ends with.

/// Ends of names, and the unit that each means.
const UNITS: [(&str, &str); 24] = [
    ("_t_per_m", "T/m"),
    ("_kg_m3", "kg/m3"),
    ("_m_s2", "m/s2"),
    ("_mpa", "MPa"),
    ("_deg", "deg"),
    ("_rad", "rad"),
    ("_unm", "uN m"),
    ("_nm", "N m"),
    ("_mm", "mm"),
    ("_um", "um"),
    ("_mt", "mT"),
    ("_mn", "mN"),
    ("_mj", "mJ"),
    ("_uj", "uJ"),
    ("_us", "us"),
    ("_ms", "ms"),
    ("_pa", "Pa"),
    ("_percent", "%"),
    ("_a", "A"),
    ("_j", "J"),
    ("_m", "m"),
    ("_n", "N"),
    ("_s", "s"),
    ("_t", "T"),
];

/// Ends of names that look like a unit: hardness is measured on the scale Shore A.
const NO_UNITS: [&str; 1] = ["shore_a"];

/// A name without its unit, and the unit; empty for a pure number.
fn parts(column: &str) -> (String, &'static str) {
    if column == "time" {
        return (column.into(), "s"); // as in tables of an FMU's inputs
    }
    // An index of a key stands behind the unit.
    let (key, index) = column.split_at(column.find('[').unwrap_or(column.len()));
    let known = UNITS.iter().filter(|_| !NO_UNITS.iter().any(|end| key.ends_with(end)));
    let found = known.clone().find_map(|(end, unit)| Some((key.strip_suffix(end)?, *unit)));
    let (name, unit) = found.unwrap_or((key, ""));
    (format!("{}{index}", name.replace('_', " ")), unit)
}

/// The label of an axis.
pub(crate) fn label(column: &str) -> String {
    let (name, unit) = parts(column);
    if unit.is_empty() { name } else { format!("{name} ({unit})") }
}

/// A value of a key, which is called by the last part of its name, in words.
pub(crate) fn value(column: &str, value: &str) -> String {
    let (name, unit) = parts(column);
    let name = name.rsplit('.').next().unwrap_or_default();
    let value = value.parse().map_or_else(|_| value.to_owned(), |number: f64| number.to_string());
    format!("{name} = {value} {unit}").trim_end().to_owned()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_tell_their_units() {
        for (column, expected) in [
            ("alpha_deg", "alpha (deg)"),
            ("tip_x_mm", "tip x (mm)"),
            ("field.uniform_mt[2]", "field.uniform[2] (mT)"),
            ("field.gradient_t_per_m[1]", "field.gradient[1] (T/m)"),
            ("magnetic_torque_y_nm", "magnetic torque y (N m)"),
            ("magnetic_force_x_n", "magnetic force x (N)"),
            ("design.helix.shore_a", "design.helix.shore a"),
            ("coil.current_a[3]", "coil.current[3] (A)"),
            ("stability_margin", "stability margin"),
            ("magnet.position[1]", "magnet.position[1]"),
            ("time", "time (s)"),
        ] {
            assert_eq!(label(column), expected);
        }
        assert_eq!(value("design.helix.length_mm", "3.5"), "length = 3.5 mm");
        assert_eq!(value("design.segments", "3.0"), "segments = 3");
    }
}
