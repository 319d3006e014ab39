//! The directory of the unpacked resources, from the resource location that a host passes to `fmi2Instantiate`.

use std::path::PathBuf;

use crate::error::Error;

/// The paths that a resource location may mean, likeliest first; none if it is empty.
///
/// Hosts write `file:/dir`, `file:///dir`, `file:////dir` or a plain path, with or without a slash at the end, and with
/// blanks escaped or not. If the location contains a percent sign, both the decoded and the literal path are returned.
///
/// ```
/// use mcm::fmi::location::paths;
/// assert_eq!(paths("file:////tmp/my%20fmu/resources/")?[0].to_str(), Some("/tmp/my fmu/resources"));
/// assert!(paths("")?.is_empty());
/// assert!(paths("https://example.org/resources").is_err());
/// # Ok::<(), mcm::error::Error>(())
/// ```
///
/// # Errors
/// [`Error::Syntax`] for a location with another scheme than `file:`.
pub fn paths(location: &str) -> Result<Vec<PathBuf>, Error> {
    let location = location.trim();
    if location.is_empty() {
        return Ok(Vec::new());
    }
    let scheme = location.get(..5).filter(|scheme| scheme.eq_ignore_ascii_case("file:"));
    let rest = match scheme {
        Some(scheme) => &location[scheme.len()..],
        None if location.contains("://") => {
            return Err(Error::Syntax {
                what: format!("resource location {location}"),
                reason: "only file: locations can be read".into(),
            });
        }
        None => location,
    };
    let slashes = rest.len() - rest.trim_start_matches('/').len();
    let named_host = rest.strip_prefix("//localhost/").map(|path| format!("/{path}"));
    let path = match named_host {
        Some(path) => path,
        None if slashes > 1 => rest[slashes - 1..].to_owned(),
        None => rest.to_owned(),
    };
    let mut paths: Vec<PathBuf> =
        decoded(&path).into_iter().chain([path.clone()]).map(|path| trimmed(&path)).collect();
    paths.dedup();
    Ok(paths)
}

/// The name of another host than this one in a `file://host/path`: what stands there where a relative path was put behind `file://`.
#[must_use]
pub fn named_host(location: &str) -> Option<&str> {
    let (scheme, rest) = location.trim().split_at_checked("file://".len())?;
    let (host, _) = rest.split_once('/').unwrap_or((rest, ""));
    (scheme.eq_ignore_ascii_case("file://") && !host.is_empty() && host != "localhost").then_some(host)
}

/// The path without a slash at its end and without one before a drive letter.
fn trimmed(path: &str) -> PathBuf {
    let path = if path.len() > 1 { path.trim_end_matches('/') } else { path };
    let drive = |path: &str| {
        let bytes = path.as_bytes();
        bytes.len() > 2 && bytes[0] == b'/' && bytes[1].is_ascii_alphabetic() && bytes[2] == b':'
    };
    PathBuf::from(if drive(path) { &path[1..] } else { path })
}

/// The text with escapes such as `%20` decoded; `None` if the result is not UTF-8. A percent sign that is not followed by
/// two hexadecimal digits stands for itself.
fn decoded(text: &str) -> Option<String> {
    let bytes = text.as_bytes();
    let digit = |at: usize| (*bytes.get(at)? as char).to_digit(16);
    let mut plain = Vec::with_capacity(bytes.len());
    let mut at = 0;
    while at < bytes.len() {
        match (bytes[at], digit(at + 1), digit(at + 2)) {
            (b'%', Some(high), Some(low)) => {
                plain.push(u8::try_from(16 * high + low).ok()?);
                at += 3;
            }
            (byte, ..) => {
                plain.push(byte);
                at += 1;
            }
        }
    }
    String::from_utf8(plain).ok()
}
