//! The libraries in an archive, one per platform.

use std::env::consts::{ARCH, DLL_PREFIX, DLL_SUFFIX, OS};
use std::fs;
use std::path::{Path, PathBuf};
use std::str::FromStr;

use mcm::fmi::xml::MODEL_IDENTIFIER;

use crate::failure::Failure;

/// A platform of FMI 2.0 (section 2.3): folder name, file extension of its libraries, and their possible first bytes.
#[derive(Debug)]
struct Platform {
    name: &'static str,
    ending: &'static str,
    beginnings: &'static [&'static [u8]],
}

const PLATFORMS: [Platform; 5] = [
    Platform { name: "linux64", ending: "so", beginnings: &[b"\x7fELF\x02"] },
    Platform { name: "linux32", ending: "so", beginnings: &[b"\x7fELF\x01"] },
    Platform { name: "win64", ending: "dll", beginnings: &[b"MZ"] },
    Platform { name: "win32", ending: "dll", beginnings: &[b"MZ"] },
    // For one processor architecture, or for several.
    Platform { name: "darwin64", ending: "dylib", beginnings: &[b"\xcf\xfa\xed\xfe", b"\xca\xfe\xba\xbe"] },
];

/// A library for a platform, as given by the option `--binary`.
#[derive(Debug, Clone)]
pub(crate) struct Binary {
    platform: &'static Platform,
    library: PathBuf,
}

impl FromStr for Binary {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let (name, library) = text.split_once('=').ok_or("expected PLATFORM=FILE")?;
        let platform = named(name).ok_or_else(|| {
            let known = PLATFORMS.each_ref().map(|platform| platform.name);
            format!("FMI 2.0 has no platform `{name}`; its platforms are {}", known.join(", "))
        })?;
        Ok(Self { platform, library: library.into() })
    }
}

impl Binary {
    /// Its name in the archive, and its bytes.
    fn entry(&self) -> Result<(String, Vec<u8>), Failure> {
        let Self { platform: Platform { name, ending, beginnings }, library } = self;
        let shown = library.display();
        let bytes = fs::read(library)
            .map_err(|error| Failure::Message(format!("cannot read the library {shown}: {error}")))?;
        if !beginnings.iter().any(|beginning| bytes.starts_with(beginning)) {
            return Err(Failure::Message(format!("{shown} is not a library for {name}")));
        }
        Ok((format!("binaries/{name}/{MODEL_IDENTIFIER}.{ending}"), bytes))
    }
}

/// The files below `binaries/`: the libraries `given`, and one for the platform that this program runs on: `own` or, if
/// that platform has none at all, the one beside the program.
pub(super) fn entries(own: Option<&Path>, given: &[Binary]) -> Result<Vec<(String, Vec<u8>)>, Failure> {
    let here = named(match (OS, ARCH) {
        ("linux", "x86_64") => "linux64",
        ("windows", "x86_64") => "win64",
        ("macos", "x86_64") => "darwin64",
        _ => "",
    });
    let mut binaries = given.to_vec();
    match (here, own) {
        (Some(platform), Some(own)) => binaries.push(Binary { platform, library: own.into() }),
        (Some(platform), None) if given.iter().all(|binary| binary.platform.name != platform.name) => {
            binaries.push(Binary { platform, library: beside()? });
        }
        (None, own) if own.is_some() || given.is_empty() => {
            let here = format!("{OS} on {ARCH}");
            return Err(Failure::Message(format!("FMI 2.0 has no platform for {here}: use --binary")));
        }
        _ => {}
    }
    binaries.sort_by_key(|binary| binary.platform.name);
    if let Some(pair) = binaries.windows(2).find(|pair| pair[0].platform.name == pair[1].platform.name) {
        return Err(Failure::Message(format!("there are two libraries for {}", pair[0].platform.name)));
    }
    binaries.iter().map(Binary::entry).collect()
}

fn named(name: &str) -> Option<&'static Platform> {
    PLATFORMS.iter().find(|platform| platform.name == name)
}

/// The library beside this program.
fn beside() -> Result<PathBuf, Failure> {
    let name = format!("{DLL_PREFIX}{MODEL_IDENTIFIER}{DLL_SUFFIX}");
    let library = std::env::current_exe()?.with_file_name(&name);
    if library.is_file() {
        return Ok(library);
    }
    Err(Failure::Message(format!(
        "there is no library {}: build it with `cargo build --release --lib`, or name it with --library",
        library.display()
    )))
}
