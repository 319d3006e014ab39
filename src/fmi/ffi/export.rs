//! The macro by which every C function is defined, so that none goes without the guard against panics, the default floating-point
//! environment, the checks of its pointers and the comparison of its signature with the official header.

/// Defines C functions of the standard.
///
/// The arguments of a C function are raw pointers and lengths. After `where`, a line says what they become before the body
/// runs: `input(pointer, length)` a slice, `texts(pointer, length)` a list of `&str`, `text(pointer)` one `&str`, and
/// `output(pointer, length)` an [`Output`](super::memory::Output), to which values can be written. `pointer as T` is a
/// pointer to entries of another type. The body is safe code.
///
/// There are three forms:
/// - `instance`: functions on an instance, which also check that its state allows the call. A pointer that is null, not
///   aligned or not UTF-8 is refused in the name of its argument.
/// - `instantiate`: the function that makes an instance. What is read from its pointers comes as a `Result`. A panic gives
///   the value after `else`.
/// - `safe`: functions that read no pointers. A panic gives the value after `else`.
macro_rules! export {
    (instance $(
        $name:ident: $type:ident, $call:ident = ($($argument:ident: $of:ty),*)
        $(where $($value:ident = $read:ident($pointer:ident $(as $entry:ty)?, $length:expr)),+;)?
        |$instance:ident| $body:expr;
    )*) => {$(
        #[doc = concat!("`", stringify!($name), "` of FMI 2.0.")]
        ///
        /// # Safety
        /// Every pointer is null or valid for the number of values that the standard states, and every string is
        /// zero-terminated, until the function returns.
        #[unsafe(no_mangle)]
        pub unsafe extern "C" fn $name(component: fmi2Component $(, $argument: $of)*) -> fmi2Status {
            let work = |$instance: &mut Instance| {
                $($(
                    let (pointer, length) = ($pointer $(.cast::<$entry>())?, $length);
                    // SAFETY: the contract of this function is that of the function that reads its arguments.
                    let $value = match unsafe { memory::$read(pointer, length) } {
                        Ok(value) => value,
                        Err(flaw) => return $instance.refuse(&format!("{} {flaw}", stringify!($pointer))),
                    };
                )+)?
                $body
            };
            in_default_environment(|| {
                status(registry::on(component.addr(), stringify!($name), Call::$call, work))
            })
        }
        const _: $type = Some($name);
    )*};
    (instantiate
        $name:ident: $type:ident = ($($argument:ident: $of:ty),*) -> $result:ty
        where $($value:ident = $read:ident($pointer:ident)),+;
        $body:expr, else $otherwise:expr;
    ) => {
        #[doc = concat!("`", stringify!($name), "` of FMI 2.0.")]
        ///
        /// # Safety
        /// Every pointer is null or valid, and every string is zero-terminated, until the function returns.
        #[unsafe(no_mangle)]
        pub unsafe extern "C" fn $name($($argument: $of),*) -> $result {
            let work = || {
                $(
                    // SAFETY: the contract of this function is that of the function that reads its arguments.
                    let $value = unsafe { memory::$read($pointer) };
                )+
                $body
            };
            in_default_environment(|| guarded(work)).unwrap_or($otherwise)
        }
        const _: $type = Some($name);
    };
    (safe $(
        $name:ident: $type:ident = ($($argument:ident: $of:ty),*) -> $result:ty { $body:expr } else $otherwise:expr;
    )*) => {$(
        #[doc = concat!("`", stringify!($name), "` of FMI 2.0.")]
        #[unsafe(no_mangle)]
        pub extern "C" fn $name($($argument: $of),*) -> $result {
            in_default_environment(|| guarded(|| $body)).unwrap_or($otherwise)
        }
        const _: $type = Some($name);
    )*};
}
pub(super) use export;
