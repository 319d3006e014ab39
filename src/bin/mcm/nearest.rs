//! The name that was probably meant.

/// Smallest similarity (1: equal) at which another name is suggested as a correction.
const PLAUSIBLE: f64 = 0.5;

/// The most similar of the names, if one is similar enough to be suggested.
pub(crate) fn nearest(wanted: &str, names: impl IntoIterator<Item = String>) -> Option<String> {
    names
        .into_iter()
        .map(|name| (strsim::normalized_damerau_levenshtein(wanted, &name), name))
        .filter(|(similarity, _)| *similarity >= PLAUSIBLE)
        .max_by(|a, b| a.0.total_cmp(&b.0))
        .map(|(_, name)| name)
}
