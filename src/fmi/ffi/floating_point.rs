//! The floating-point environment of the host's thread: rounding, flushing of small numbers, traps.
//!
//! Rust assumes that of a new process (round to nearest, no traps). A host whose thread has another one would get other last digits, and
//! from these another GUID of the same design.

#[cfg(any(target_arch = "x86_64", target_arch = "aarch64"))]
use core::arch::asm;

/// Control word of a new process: round to nearest, keep subnormal numbers, no traps (System V ABI for AMD64, section 3.4.1; Arm
/// Architecture Reference Manual, FPCR).
#[cfg(target_arch = "x86_64")]
const DEFAULT: u32 = 0x1f80;
#[cfg(target_arch = "aarch64")]
const DEFAULT: u64 = 0;

/// The host's environment, which returns when this is dropped.
struct Host(Word);

#[cfg(target_arch = "x86_64")]
type Word = u32;
#[cfg(target_arch = "aarch64")]
type Word = u64;
#[cfg(not(any(target_arch = "x86_64", target_arch = "aarch64")))]
type Word = ();

impl Drop for Host {
    fn drop(&mut self) {
        set(self.0);
    }
}

/// Does `work` in the environment of a new process, and restores that of the host.
pub(super) fn in_default_environment<T>(work: impl FnOnce() -> T) -> T {
    let _host = Host(present());
    #[cfg(any(target_arch = "x86_64", target_arch = "aarch64"))]
    set(DEFAULT);
    work()
}

#[cfg(target_arch = "x86_64")]
fn present() -> Word {
    let mut word: u32 = 0;
    // SAFETY: stores the word of this thread in the variable.
    unsafe { asm!("stmxcsr [{}]", in(reg) &raw mut word, options(nostack, preserves_flags)) };
    word
}

#[cfg(target_arch = "x86_64")]
fn set(word: Word) {
    // SAFETY: the word is the default one, or one that this thread had.
    unsafe { asm!("ldmxcsr [{}]", in(reg) &raw const word, options(nostack, preserves_flags)) };
}

#[cfg(target_arch = "aarch64")]
fn present() -> Word {
    let word: u64;
    // SAFETY: reads the word of this thread.
    unsafe { asm!("mrs {}, fpcr", out(reg) word, options(nomem, nostack, preserves_flags)) };
    word
}

#[cfg(target_arch = "aarch64")]
fn set(word: Word) {
    // SAFETY: the word is the default one, or one that this thread had.
    unsafe { asm!("msr fpcr, {}", in(reg) word, options(nostack, preserves_flags)) };
}

#[cfg(not(any(target_arch = "x86_64", target_arch = "aarch64")))]
fn present() -> Word {}

#[cfg(not(any(target_arch = "x86_64", target_arch = "aarch64")))]
fn set(_word: Word) {}
