//! The floating-point environment of the host's thread.
#![cfg(target_arch = "x86_64")]

use std::arch::asm;
use std::fs;
use std::path::Path;

use super::*;

/// Rounding upwards, downwards, to zero; subnormal numbers flushed to zero; no trap masked but that of the inexact result.
const HOSTS: [u32; 5] = [0x1f80 | 0x4000, 0x1f80 | 0x2000, 0x1f80 | 0x6000, 0x1f80 | 0x8040, 0x1000];

fn word() -> u32 {
    let mut word: u32 = 0;
    // SAFETY: stores the word of this thread.
    unsafe { asm!("stmxcsr [{}]", in(reg) &raw mut word) };
    word
}

fn set_word(word: u32) {
    // SAFETY: the test sets the word of a new process again before it goes on.
    unsafe { asm!("ldmxcsr [{}]", in(reg) &raw const word) };
}

/// Instantiates, initialises and steps in an environment: the bits of an output, and whether the environment was left as it was.
fn run(guid: &CStr, location: &CStr, tip: fmi2ValueReference, host: u32) -> (u64, bool) {
    let (functions, mut angle) = (callbacks(501), f64::NAN);
    let before = word();
    set_word(host);
    // SAFETY: texts are zero-terminated, one reference and one value.
    let ended = unsafe {
        let kind = fmi2Type::fmi2CoSimulation;
        let (name, functions) = (c"one".as_ptr(), &raw const functions);
        let it = fmi2Instantiate(name, kind, guid.as_ptr(), location.as_ptr(), functions, 0, 0);
        let ended = [
            fmi2SetupExperiment(it, 0, 0.0, 0.0, 0, 0.0),
            fmi2EnterInitializationMode(it),
            fmi2ExitInitializationMode(it),
            fmi2DoStep(it, 0.0, 0.1, 1),
            fmi2GetReal(it, &raw const tip, 1, &raw mut angle),
        ];
        fmi2FreeInstance(it);
        ended
    };
    let kept = word() & !0x3f == host & !0x3f; // but for the flags of exceptions
    set_word(before);
    assert_eq!(ended, [OK; 5], "{host:#x}: {:?}", heard(501));
    (angle.to_bits(), kept)
}

#[test]
fn rounding_and_traps_of_the_host_change_nothing_and_are_left_alone() {
    let scene = "[design]\nsegments = 1\n[design.helix]\nlength_mm = 4.3\nboundary_angle_deg = 29.7\nshore_a = 31.3\n\
                 [field]\nuniform_mt = [0.1, 7.3, 0.3]\n[magnet]\nposition_mm = [1.1, -119.3, 21.7]";
    let package = Package::new(scene, "scene", 3).unwrap();
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join("abi environment");
    fs::create_dir_all(&folder).unwrap();
    for (name, text) in package.resources().unwrap() {
        fs::write(folder.join(name), text).unwrap();
    }
    let guid = CString::new(package.guid()).unwrap();
    let location = CString::new(format!("file://{}", folder.display())).unwrap();
    let tip = package.table().reference("tip.angle").unwrap();
    let (expected, kept) = run(&guid, &location, tip, 0x1f80);
    assert!(kept);
    for host in HOSTS {
        assert_eq!(run(&guid, &location, tip, host), (expected, true), "{host:#x}");
    }
}
