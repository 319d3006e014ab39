//! A GUID that is computed from the content of an FMU, so that it is the same for the same design and no other.

/// Offset basis and prime of the 128-bit FNV-1a hash (G. Fowler, L. C. Noll, K.-P. Vo, D. Eastlake:
/// RFC 9923, section 5).
const BASIS: u128 = 0x6c62_272e_07bb_0142_62b8_2175_6295_c58d;
const PRIME: u128 = 0x0000_0000_0100_0000_0000_0000_0000_013b;

/// The GUID of a list of texts, in braces, as a UUID of version 8 (RFC 9562: with content defined by its maker).
///
/// ```
/// use mcm::fmi::guid::guid;
/// assert_eq!(guid(["a", "b"]).len(), 38);
/// assert_eq!(guid(["a", "b"]), guid(["a", "b"]));
/// assert_ne!(guid(["a", "b"]), guid(["ab", ""]));
/// ```
#[must_use]
pub fn guid<'a>(texts: impl IntoIterator<Item = &'a str>) -> String {
    let mut hash = BASIS;
    for text in texts {
        // A byte that does not occur in UTF-8 separates the texts.
        for byte in text.bytes().chain([0xff]) {
            hash = (hash ^ u128::from(byte)).wrapping_mul(PRIME);
        }
    }
    let version = (hash & !(0xf << 76)) | (0x8 << 76);
    let variant = (version & !(0b11 << 62)) | (0b10 << 62);
    let hex = format!("{variant:032x}");
    format!("{{{}-{}-{}-{}-{}}}", &hex[..8], &hex[8..12], &hex[12..16], &hex[16..20], &hex[20..])
}
