//! `mcm pack`: the libraries of an archive. What else is in it, `tests/python/test_archive.py` sees.

use std::fs::{self, File};
use std::path::Path;

use zip::ZipArchive;

use super::{assert_status, folder, mcm, stderr};

/// Files that begin as libraries of the platforms do.
const LIBRARIES: [(&str, &[u8]); 4] = [
    ("linux.so", b"\x7fELF\x02 linux"),
    ("windows.dll", b"MZ windows"),
    ("mac.dylib", b"\xcf\xfa\xed\xfe mac"),
    ("text.dll", b"no library"),
];

fn libraries(test: &str) -> std::path::PathBuf {
    let folder = folder(test);
    for (name, bytes) in LIBRARIES {
        fs::write(folder.join(name), bytes).unwrap();
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
        ("binaries/darwin64/mcm.dylib", LIBRARIES[2].1),
        ("binaries/linux64/mcm.so", LIBRARIES[0].1),
        ("binaries/win64/mcm.dll", LIBRARIES[1].1),
    ];
    assert_eq!(found, expected.map(|(name, bytes)| (name.to_owned(), bytes.to_vec())));
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
