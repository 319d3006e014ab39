//! Where a host says that the unpacked resources are.

use std::path::PathBuf;

use crate::error::Error;

/// The paths that a resource location may mean, likeliest first; none if the host gave none.
///
/// Hosts write `file:/dir`, `file:///dir`, `file:////dir`, or a plain path, with or without a slash at the end, with
/// blanks escaped or raw. Where a percent sign leaves doubt, both readings are returned.
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
/// [`Error::Syntax`] for a location that is no file on this machine.
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

/// Without the slash at the end, and without the one before a drive letter.
fn trimmed(path: &str) -> PathBuf {
    let path = if path.len() > 1 { path.trim_end_matches('/') } else { path };
    let drive = |path: &str| {
        let bytes = path.as_bytes();
        bytes.len() > 2 && bytes[0] == b'/' && bytes[1].is_ascii_alphabetic() && bytes[2] == b':'
    };
    PathBuf::from(if drive(path) { &path[1..] } else { path })
}

/// The text with `%20` and its like replaced; `None` if that gives no text. A percent sign without two hexadecimal
/// digits after it stands for itself.
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
