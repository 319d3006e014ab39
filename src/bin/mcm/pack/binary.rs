//! The libraries in an archive, one per platform.

use std::collections::HashSet;
use std::env::consts::{ARCH, DLL_PREFIX, DLL_SUFFIX, OS};
use std::fs;
use std::path::{Path, PathBuf};
use std::str::FromStr;

use mcm::fmi::xml::MODEL_IDENTIFIER;

use crate::failure::Failure;
use crate::output::folder;

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

/// What the names of all functions of FMI 2.0 begin with.
const PREFIX: &[u8] = b"fmi2";

/// Functions without which no master can run an FMU of both interfaces (FMI 2.0, sections 2.1, 3.2 and 4.2).
const FUNCTIONS: [&str; 26] = [
    "fmi2GetTypesPlatform",
    "fmi2GetVersion",
    "fmi2Instantiate",
    "fmi2FreeInstance",
    "fmi2SetupExperiment",
    "fmi2EnterInitializationMode",
    "fmi2ExitInitializationMode",
    "fmi2Terminate",
    "fmi2Reset",
    "fmi2GetReal",
    "fmi2GetInteger",
    "fmi2GetBoolean",
    "fmi2SetReal",
    "fmi2SetInteger",
    "fmi2SetBoolean",
    "fmi2DoStep",
    "fmi2EnterEventMode",
    "fmi2NewDiscreteStates",
    "fmi2EnterContinuousTimeMode",
    "fmi2CompletedIntegratorStep",
    "fmi2SetTime",
    "fmi2SetContinuousStates",
    "fmi2GetDerivatives",
    "fmi2GetEventIndicators",
    "fmi2GetContinuousStates",
    "fmi2GetNominalsOfContinuousStates",
];

/// Whether the end of a 64-bit ELF library is missing, where its table of sections stands (ELF-64 Object File Format 1.5,
/// section 2: offset, size and number of its entries in the header).
fn is_cut_short(library: &[u8]) -> bool {
    let number = |at: usize, length: usize| {
        let bytes = library.get(at..at + length)?;
        Some(bytes.iter().rev().fold(0_u64, |number, byte| (number << 8) | u64::from(*byte)))
    };
    let end = || number(0x28, 8)?.checked_add(number(0x3a, 2)? * number(0x3c, 2)?);
    library.starts_with(b"\x7fELF\x02") && end().is_none_or(|end| end > library.len() as u64)
}

/// The first of [`FUNCTIONS`] whose name, as the tables of symbols of all platforms hold it, is not in a library.
fn missing_function(library: &[u8]) -> Option<&'static str> {
    let starts = library.windows(PREFIX.len()).enumerate().filter(|(_, bytes)| *bytes == PREFIX);
    let names: HashSet<&[u8]> =
        starts.filter_map(|(start, _)| library[start..].split(|byte| *byte == 0).next()).collect();
    FUNCTIONS.into_iter().find(|name| !names.contains(name.as_bytes()))
}

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
    /// The file of the library.
    pub(super) fn library(&self) -> &PathBuf {
        &self.library
    }

    /// Its name in the archive, and its bytes.
    fn entry(&self) -> Result<(String, Vec<u8>), Failure> {
        let Self { platform: Platform { name, ending, beginnings }, library } = self;
        let shown = library.display();
        if fs::metadata(library).is_ok_and(|found| !found.is_file()) {
            return Err(Failure(format!("the library {shown} is not a file")));
        }
        let bytes = fs::read(library)
            .map_err(|error| Failure(format!("cannot read the library {shown}: {error}")))?;
        if !beginnings.iter().any(|beginning| bytes.starts_with(beginning)) {
            return Err(Failure(format!("{shown} is not a library for {name}")));
        }
        if is_cut_short(&bytes) {
            return Err(Failure(format!("{shown} is cut short: its table of sections is beyond its end")));
        }
        if let Some(missing) = missing_function(&bytes) {
            return Err(Failure(format!(
                "{shown} is not the library of an FMU: it has no function {missing}"
            )));
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
            binaries.push(Binary { platform, library: own_library()? });
        }
        (None, own) if own.is_some() || given.is_empty() => {
            let here = format!("{OS} on {ARCH}");
            return Err(Failure(format!("FMI 2.0 has no platform for {here}: use --binary")));
        }
        _ => {}
    }

    binaries.sort_by_key(|binary| binary.platform.name);
    if let Some(pair) = binaries.windows(2).find(|pair| pair[0].platform.name == pair[1].platform.name) {
        return Err(Failure(format!("there are two libraries for {}", pair[0].platform.name)));
    }

    binaries.iter().map(Binary::entry).collect()
}

fn named(name: &str) -> Option<&'static Platform> {
    PLATFORMS.iter().find(|platform| platform.name == name)
}

/// The library that belongs to this program: beside it, as cargo builds both, or where it was built, as an installed program
/// leaves it.
fn own_library() -> Result<PathBuf, Failure> {
    let program =
        std::env::current_exe().map_err(|error| Failure(format!("cannot find this program: {error}")))?;
    let built = Path::new(env!("MCM_BUILD_FOLDER"));
    let folders = [folder(&program).to_owned(), built.to_owned(), built.join("deps")];
    first_library(&folders, &format!("{DLL_PREFIX}{MODEL_IDENTIFIER}{DLL_SUFFIX}"))
}

fn first_library(folders: &[PathBuf], name: &str) -> Result<PathBuf, Failure> {
    folders.iter().map(|folder| folder.join(name)).find(|library| library.is_file()).ok_or_else(|| {
        let tried: Vec<String> = folders.iter().map(|folder| folder.display().to_string()).collect();
        Failure(format!(
            "the library of the FMU, {name}, is in none of {}: in the source folder, `cargo build --release --lib` makes \
             target/release/{name}; name it with --library, or put it beside this program",
            tried.join(", ")
        ))
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_library_that_is_nowhere_is_said_with_what_to_do() {
        let folders = [PathBuf::from("/nowhere"), PathBuf::from("/nor/here")];
        let message = first_library(&folders, "libmcm.so").map_err(|failure| failure.0);
        assert!(message.is_err_and(|said| {
            said.contains("none of /nowhere, /nor/here") && said.contains("cargo build --release --lib")
        }));
    }
}
