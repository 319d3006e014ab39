//! Which instructions evaluate fields at many points and multiply matrices: the widest vectors of this processor, or those
//! that every one has.
//!
//! The results are the same bits; only the time differs.

use std::sync::atomic::{AtomicU8, Ordering};

/// Instructions that evaluate fields at many points and multiply matrices.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Instructions {
    /// Those that every processor of this kind has.
    Portable,
    /// AVX2: vectors of four numbers.
    Avx2,
    /// AVX-512: vectors of eight numbers.
    Avx512,
}

/// Environment variable that, if set to anything but nothing, forces portable instructions.
const FORCING: &str = "MCM_PORTABLE";

/// The choice, once it is made: portable instructions, or the processor's.
static CHOSEN: AtomicU8 = AtomicU8::new(UNKNOWN);
const UNKNOWN: u8 = 0;
const PORTABLE: u8 = 1;
const DETECTED: u8 = 2;

impl Instructions {
    /// The instructions in use: those of the processor, unless the environment variable `MCM_PORTABLE` was set when they
    /// were first needed, or [`Instructions::force_portable`] has decided.
    ///
    /// ```
    /// use mcm::numerics::processor::Instructions;
    /// Instructions::force_portable(true);
    /// assert_eq!(Instructions::in_use(), Instructions::Portable);
    /// ```
    #[must_use]
    pub fn in_use() -> Self {
        if are_portable() { Self::Portable } else { Self::detected() }
    }

    /// Forces portable instructions for the whole process, or leaves the choice to the processor again.
    pub fn force_portable(force: bool) {
        CHOSEN.store(if force { PORTABLE } else { DETECTED }, Ordering::Relaxed);
    }

    #[cfg(target_arch = "x86_64")]
    fn detected() -> Self {
        if is_x86_feature_detected!("avx512f")
            && is_x86_feature_detected!("avx512dq")
            && is_x86_feature_detected!("avx512vl")
        {
            Self::Avx512
        } else if is_x86_feature_detected!("avx2") {
            Self::Avx2
        } else {
            Self::Portable
        }
    }

    #[cfg(not(target_arch = "x86_64"))]
    fn detected() -> Self {
        Self::Portable
    }
}

impl std::fmt::Display for Instructions {
    fn fmt(&self, out: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        out.write_str(match self {
            Self::Portable => "portable",
            Self::Avx2 => "AVX2",
            Self::Avx512 => "AVX-512",
        })
    }
}

/// Whether portable instructions are to be used.
#[inline]
pub(crate) fn are_portable() -> bool {
    match CHOSEN.load(Ordering::Relaxed) {
        UNKNOWN => decide(),
        chosen => chosen == PORTABLE,
    }
}

#[cold]
fn decide() -> bool {
    let forced = std::env::var_os(FORCING).is_some_and(|value| !value.is_empty());
    Instructions::force_portable(forced);
    forced
}

/// Compiles a function for several processors; a call takes the one that [`Instructions::in_use`] tells.
macro_rules! for_each_processor {
    ($(#[$doc:meta])* $seen:vis fn $name:ident($($own:ident: $kind:ty),* $(,)?) $(-> $out:ty)? $body:block) => {
        $(#[$doc])*
        #[inline]
        $seen fn $name($($own: $kind),*) $(-> $out)? {
            #[inline(always)]
            fn every($($own: $kind),*) $(-> $out)? $body

            #[multiversion::multiversion(targets(
                "x86_64+avx+avx2+avx512f+avx512dq+avx512vl",
                "x86_64+avx+avx2"
            ))]
            fn detected($($own: $kind),*) $(-> $out)? {
                every($($own),*)
            }

            fn portable($($own: $kind),*) $(-> $out)? {
                every($($own),*)
            }

            if $crate::numerics::processor::are_portable() { portable($($own),*) } else { detected($($own),*) }
        }
    };
}
pub(crate) use for_each_processor;
