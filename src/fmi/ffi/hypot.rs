//! The function `hypot` of the C library, for this library alone.
//!
//! glibc has it anew since version 2.35, so that a library built there would not load on systems with an older one, as RHEL 9 (2.34). It is
//! needed by `f64::hypot` here and in other crates. The definition is hidden: it is found where this library is linked, before that of the
//! C library, and not exported.

use core::arch::global_asm;

/// `sqrt(x^2 + y^2)` without overflow of the squares; infinite where one of both is, as C demands (C11, F.10.4.3).
extern "C" fn hypotenuse(x: f64, y: f64) -> f64 {
    if x.is_infinite() || y.is_infinite() {
        return f64::INFINITY;
    }
    let (x, y) = (x.abs(), y.abs());
    let (long, short) = if x > y { (x, y) } else { (y, x) };
    if long == 0.0 {
        return 0.0;
    }
    let ratio = short / long;
    long * (1.0 + ratio * ratio).sqrt()
}

#[cfg(target_arch = "x86_64")]
global_asm!(".globl hypot", ".hidden hypot", ".type hypot, @function", "hypot: jmp {}", sym hypotenuse);
#[cfg(target_arch = "aarch64")]
global_asm!(".globl hypot", ".hidden hypot", ".type hypot, @function", "hypot: b {}", sym hypotenuse);

#[cfg(test)]
mod tests {
    use super::hypotenuse;

    /// Relative error of two roundings and a square root.
    const ROUNDING: f64 = 1e-15;

    #[test]
    fn lengths_are_right_and_do_not_overflow() {
        for (x, y, expected) in [
            (3.0, -4.0, 5.0),
            (-5e300, 12e300, 13e300),
            (8e-300, 15e-300, 17e-300),
            (0.0, -2.0, 2.0),
            (0.0, 0.0, 0.0),
        ] {
            assert!((hypotenuse(x, y) - expected).abs() <= ROUNDING * expected, "{x} {y}");
        }
        assert!(hypotenuse(f64::NAN, f64::NEG_INFINITY) > f64::MAX);
        assert!(hypotenuse(f64::NAN, 1.0).is_nan() && hypotenuse(1.0, f64::NAN).is_nan());
    }
}
