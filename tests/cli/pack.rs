//! `mcm pack`: the libraries of an archive. What else is in it, `tests/python/test_archive.py` sees.

use std::fs::{self, File};
use std::path::Path;

use zip::ZipArchive;

use super::{assert_status, folder, mcm, stderr};

/// Files that begin as libraries of the platforms do.
const LIBRARIES: [(&str, &[u8]); 4] = [
    ("linux.so", &{
        let mut header = [0; 64];
        [header[0], header[1], header[2], header[3], header[4], ..] = *b"\x7fELF\x02";
        header
    }),
    ("windows.dll", b"MZ windows"),
    ("mac.dylib", b"\xcf\xfa\xed\xfe mac"),
    ("text.dll", b"no library"),
];

/// Every function that a library may export, by the official header.
const HEADER: &str = include_str!("../../fmu/headers/fmi2Functions.h");

/// Names as a library's table of symbols holds them.
fn functions() -> Vec<&'static str> {
    let declared = HEADER.lines().filter_map(|line| line.trim().strip_prefix("FMI2_Export"));
    declared.filter_map(|line| line.trim_end_matches(';').split_whitespace().last()).collect()
}

/// The bytes of a file of [`LIBRARIES`], followed by the names of its functions.
fn library(number: usize) -> Vec<u8> {
    let names = format!("\0{}\0", functions().join("\0"));
    [LIBRARIES[number].1, names.as_bytes()].concat()
}

fn libraries(test: &str) -> std::path::PathBuf {
    let folder = folder(test);
    for (number, (name, _)) in LIBRARIES.iter().enumerate() {
        fs::write(folder.join(name), library(number)).unwrap();
    }
    folder
}

/// Names and contents below `binaries/`.
fn binaries(archive: &Path) -> Vec<(String, Vec<u8>)> {
    let mut archive = ZipArchive::new(File::open(archive).unwrap()).unwrap();
    let mut found = Vec::new();
    for index in 0..archive.len() {
        let mut file = archive.by_index(index).unwrap();
        let name = file.name().unwrap().into_owned();
        if name.starts_with("binaries/") {
            let mut bytes = Vec::new();
            std::io::copy(&mut file, &mut bytes).unwrap();
            found.push((name, bytes));
        }
    }
    found
}

#[test]
fn an_archive_carries_several_platforms() {
    let folder = libraries("pack several");
    let output = mcm(
        &folder,
        &[
            "pack",
            "--out",
            "mcm.fmu",
            "--binary",
            "win64=windows.dll",
            "--binary",
            "darwin64=mac.dylib",
            "--binary",
            "linux64=linux.so",
        ],
    );
    assert_status(&output, 0);
    let found = binaries(&folder.join("mcm.fmu"));
    let expected = [
        ("binaries/darwin64/mcm.dylib", library(2)),
        ("binaries/linux64/mcm.so", library(0)),
        ("binaries/win64/mcm.dll", library(1)),
    ];
    assert_eq!(found, expected.map(|(name, bytes)| (name.to_owned(), bytes)));
}

#[test]
#[cfg(all(target_os = "linux", target_arch = "x86_64"))]
fn the_own_platform_goes_with_others() {
    let folder = libraries("pack own");
    let output =
        mcm(&folder, &["pack", "--out", "mcm.fmu", "--library", "linux.so", "--binary", "win64=windows.dll"]);
    assert_status(&output, 0);
    let names: Vec<String> = binaries(&folder.join("mcm.fmu")).into_iter().map(|(name, _)| name).collect();
    assert_eq!(names, ["binaries/linux64/mcm.so", "binaries/win64/mcm.dll"]);
}

#[test]
fn what_cannot_be_packed_is_said_and_nothing_is_written() {
    let folder = libraries("pack refused");
    for (arguments, reason) in [
        (
            &["--binary", "amiga=windows.dll"][..],
            "no platform `amiga`; its platforms are linux64, linux32, win64",
        ),
        (&["--binary", "windows.dll"], "expected PLATFORM=FILE"),
        (&["--binary", "win64=absent.dll"], "cannot read the library absent.dll"),
        (&["--binary", "win64=text.dll"], "text.dll is not a library for win64"),
        (&["--binary", "win64=mac.dylib"], "mac.dylib is not a library for win64"),
        (&["--binary", "win64=windows.dll", "--binary", "win64=windows.dll"], "two libraries for win64"),
        (&["--library", "absent.so"], "cannot read the library absent.so"),
        (&["--library", "linux.so", "--binary", "linux64=linux.so"], "two libraries for linux64"),
    ] {
        let own = if arguments[0] == "--library" { &[][..] } else { &["--library", "linux.so"] };
        let output = mcm(&folder, &[&["pack", "--out", "mcm.fmu"], own, arguments].concat());
        assert_status(&output, 1);
        assert!(stderr(&output).contains(reason), "{arguments:?}: {}", stderr(&output));
        assert!(!folder.join("mcm.fmu").exists(), "{arguments:?}");
    }
}

#[test]
fn a_library_without_the_functions_of_an_fmu_is_refused() {
    let folder = libraries("pack functions");
    let whole = library(0);
    let mut needed = 0;
    for name in functions() {
        let text = String::from_utf8_lossy(&whole).replace(&format!("\0{name}\0"), "\0fmi3DoStep\0");
        fs::write(folder.join("other.so"), text).unwrap();
        let output = mcm(&folder, &["pack", "--out", "mcm.fmu", "--library", "other.so"]);
        if output.status.success() {
            fs::remove_file(folder.join("mcm.fmu")).unwrap();
            continue;
        }
        needed += 1;
        assert_status(&output, 1);
        let expected = format!("other.so is not the library of an FMU: it has no function {name}");
        assert!(stderr(&output).contains(&expected), "{}", stderr(&output));
        assert!(!folder.join("mcm.fmu").exists());
    }
    // Without state, derivatives, strings and asynchronous steps a library can still be driven both ways.
    assert_eq!(needed, 26);
}

#[test]
fn an_archive_is_not_written_over_what_is_read_and_an_older_one_stays_until_it_is_complete() {
    let folder = libraries("pack over");
    fs::write(folder.join("scene.toml"), "[design]\nsegments = 1").unwrap();
    for out in ["scene.toml", "./linux.so", "windows.dll"] {
        let arguments = [
            "pack",
            "--scene",
            "scene.toml",
            "--library",
            "linux.so",
            "--binary",
            "win64=windows.dll",
            "--out",
            out,
        ];
        let output = mcm(&folder, &arguments);
        assert_status(&output, 1);
        let reason = if out == "scene.toml" { "is called like a scene" } else { "which is read" };
        assert!(stderr(&output).contains(reason), "{out}: {}", stderr(&output));
    }
    fs::write(folder.join("old.fmu"), "an older one").unwrap();
    assert_status(&mcm(&folder, &["pack", "--library", "text.dll", "--out", "old.fmu"]), 1);
    assert_eq!(fs::read_to_string(folder.join("old.fmu")).unwrap(), "an older one");
    assert_status(&mcm(&folder, &["pack", "--library", "linux.so", "--out", "old.fmu"]), 0);
    assert_eq!(binaries(&folder.join("old.fmu")).len(), 1);
    let left = fs::read_dir(&folder)
        .unwrap()
        .filter(|entry| entry.as_ref().unwrap().file_name().to_string_lossy().ends_with(".part"));
    assert_eq!(left.count(), 0, "nothing half written is left");
}

/// As `cargo install` leaves it: a program alone in its folder, whose library is where both were built.
#[test]
fn an_installed_program_finds_its_library() {
    let folder = folder("pack installed");
    let program = folder.join("mcm");
    fs::copy(env!("CARGO_BIN_EXE_mcm"), &program).unwrap();
    let output =
        std::process::Command::new(&program).current_dir(&folder).args(["pack", "--out", "a.fmu"]).output();
    let output = output.unwrap();
    assert_status(&output, 0);
    assert!(binaries(&folder.join("a.fmu")).iter().any(|(_, bytes)| bytes.len() > 100_000));
}

#[test]
#[cfg(all(target_os = "linux", target_arch = "x86_64"))]
fn a_library_that_is_cut_short_is_refused() {
    let folder = folder("pack short");
    let own = Path::new(env!("CARGO_BIN_EXE_mcm")).with_file_name("libmcm.so");
    let whole = fs::read(own)
        .or_else(|_| fs::read(Path::new(env!("CARGO_BIN_EXE_mcm")).with_file_name("deps/libmcm.so")));
    let whole = whole.unwrap();
    for (length, reason) in
        [(whole.len(), ""), (whole.len() - 1, "is cut short"), (100_000, "is cut short"), (40, "short")]
    {
        fs::write(folder.join("own.so"), &whole[..length]).unwrap();
        let output = mcm(&folder, &["pack", "--out", "mcm.fmu", "--library", "own.so"]);
        assert_status(&output, i32::from(!reason.is_empty()));
        assert!(stderr(&output).contains(reason), "{length}: {}", stderr(&output));
    }
    assert!(
        stderr(&mcm(&folder, &["pack", "--out", "a.fmu", "--library", "/dev/zero"]))
            .contains("is not a file")
    );
    assert!(stderr(&mcm(&folder, &["solve", "/dev/zero"])).contains("is no scene"));
}
