//! The C boundary: the only unsafe code of the project.
//!
//! Handles are looked up in the registry of live instances; every function that works passes a guard against panics.

#![allow(unsafe_code, reason = "C calls in with raw pointers and takes a logger's C function")]
#![allow(non_snake_case, reason = "names of the standard")]

mod logger;
mod memory;

use std::convert::Infallible;
use std::ffi::{c_char, c_int};
use std::ptr;
use std::sync::Arc;

#[allow(clippy::wildcard_imports, reason = "types of the standard, named by its prefix")]
use super::bindings::*;
use super::guard::guarded;
use super::instance::{Instance, identify};
use super::location;
use super::log::{Category, Log};
use super::registry;
use super::state::{Call, Ending};
use super::value::Value;
use logger::{Logger, c_string, status};
use memory::{NO_ARRAY, answer, array, get, keep, pointer, set, text, write};

/// The two texts that identify the interface.
macro_rules! export_text {
    ($($name:ident: $type:ident = $text:ident;)*) => {$(
        #[doc = concat!("`", stringify!($name), "` of FMI 2.0.")]
        #[unsafe(no_mangle)]
        pub extern "C" fn $name() -> *const c_char {
            $text.as_ptr().cast()
        }
        const _: $type = Some($name);
    )*};
}

export_text! {
    fmi2GetTypesPlatform: fmi2GetTypesPlatformTYPE = fmi2TypesPlatform;
    fmi2GetVersion: fmi2GetVersionTYPE = fmi2Version;
}

/// `fmi2Instantiate` of FMI 2.0.
///
/// # Safety
/// As the standard says: texts are null or zero-terminated, `functions` is null or points to the callbacks.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi2Instantiate(
    instanceName: fmi2String,
    fmuType: fmi2Type,
    fmuGUID: fmi2String,
    fmuResourceLocation: fmi2String,
    functions: *const fmi2CallbackFunctions,
    _visible: fmi2Boolean,
    loggingOn: fmi2Boolean,
) -> fmi2Component {
    // SAFETY: by the contract of this function. The struct is copied: it is the host's after this call.
    let (name, guid, location, callbacks) = unsafe {
        (text(instanceName), text(fmuGUID), text(fmuResourceLocation), array(functions, 1).map(|one| one[0]))
    };
    let logger = Logger {
        call: callbacks.and_then(|callbacks| callbacks.logger),
        environment: callbacks.map_or(ptr::null_mut(), |callbacks| callbacks.componentEnvironment),
        instance_name: c_string(name.as_deref().unwrap_or_default()),
    };
    let made = guarded(|| {
        if name.is_none_or(|name| name.is_empty()) {
            return Err("the instance name is null or empty".to_owned());
        }
        if fmuType != fmi2Type::fmi2CoSimulation {
            return Err("this FMU is for co-simulation only".to_owned());
        }
        let guid = guid.ok_or("the GUID is null")?;
        let paths = location::paths(&location.unwrap_or_default()).map_err(|error| error.to_string())?;
        identify(&guid, &paths).map_err(|error| error.to_string())
    });
    match made.and_then(|made| made) {
        Ok(package) => {
            let sink =
                Box::new(move |ending, category, message: &str| logger.tell(ending, category, message));
            let instance = Instance::new(Arc::new(package), Log::new(sink, loggingOn != 0));
            pointer(registry::enter(instance))
        }
        Err(reason) => {
            logger.tell(Ending::Error, Category::Error, &format!("not instantiated: {reason}"));
            ptr::null_mut()
        }
    }
}
const _: fmi2InstantiateTYPE = Some(fmi2Instantiate);

/// `fmi2FreeInstance` of FMI 2.0; a null, unknown or freed handle does nothing.
#[unsafe(no_mangle)]
pub extern "C" fn fmi2FreeInstance(component: fmi2Component) {
    registry::leave(component.addr());
}

/// Exports the functions on an instance: panic guard, handle and state are checked before the body runs.
macro_rules! export {
    ($($name:ident: $type:ident, $call:ident = |$instance:ident $(, $argument:ident: $of:ty)*| $body:expr;)*) => {$(
        #[doc = concat!("`", stringify!($name), "` of FMI 2.0.")]
        ///
        /// # Safety
        /// As the standard says: pointers are null or valid for the lengths given, texts are zero-terminated.
        #[unsafe(no_mangle)]
        pub unsafe extern "C" fn $name(component: fmi2Component $(, $argument: $of)*) -> fmi2Status {
            status(registry::on(component.addr(), stringify!($name), Call::$call, |$instance| $body))
        }
        const _: $type = Some($name);
    )*};
}

type References = *const fmi2ValueReference;

// SAFETY of all blocks below: the exported function's contract is that of the helper which the block calls.
export! {
    fmi2SetDebugLogging: fmi2SetDebugLoggingTYPE, SetDebugLogging =
        |instance, on: fmi2Boolean, length: usize, names: *const fmi2String| {
            // SAFETY: see above.
            let names = unsafe { array(names, length) }
                .and_then(|names| names.iter().map(|&name| unsafe { text(name) }).collect::<Option<Vec<_>>>());
            let Some(names) = names else { return instance.refuse("a log category is null") };
            instance.set_debug_logging(on != 0, &names.iter().map(AsRef::as_ref).collect::<Vec<_>>())
        };
    fmi2SetupExperiment: fmi2SetupExperimentTYPE, SetupExperiment =
        |instance, _tolerance_defined: fmi2Boolean, _tolerance: fmi2Real, start: fmi2Real, stop_defined: fmi2Boolean,
         stop: fmi2Real| instance.setup_experiment(start, (stop_defined != 0).then_some(stop));
    fmi2EnterInitializationMode: fmi2EnterInitializationModeTYPE, EnterInitializationMode =
        |instance| instance.enter_initialization();
    fmi2ExitInitializationMode: fmi2ExitInitializationModeTYPE, ExitInitializationMode =
        |instance| instance.exit_initialization();
    fmi2Terminate: fmi2TerminateTYPE, Terminate = |instance| instance.terminate();
    fmi2Reset: fmi2ResetTYPE, Reset = |instance| instance.reset();
    fmi2GetReal: fmi2GetRealTYPE, Get =
        |instance, references: References, length: usize, values: *mut fmi2Real| {
            let real = |value| if let Value::Real(value) = value { Some(value) } else { None };
            // SAFETY: see above.
            unsafe { get(instance, array(references, length), "Real", real, values) }
        };
    fmi2GetInteger: fmi2GetIntegerTYPE, Get =
        |instance, references: References, length: usize, values: *mut fmi2Integer| {
            let integer = |value| if let Value::Integer(value) = value { Some(value) } else { None };
            // SAFETY: see above.
            unsafe { get(instance, array(references, length), "Integer", integer, values) }
        };
    fmi2GetBoolean: fmi2GetBooleanTYPE, Get =
        |instance, references: References, length: usize, values: *mut fmi2Boolean| {
            let boolean = |value| if let Value::Boolean(value) = value { Some(c_int::from(value)) } else { None };
            // SAFETY: see above.
            unsafe { get(instance, array(references, length), "Boolean", boolean, values) }
        };
    fmi2GetString: fmi2GetStringTYPE, Get =
        |instance, references: References, length: usize, values: *mut fmi2String| {
            // SAFETY: see above.
            unsafe { get::<Infallible>(instance, array(references, length), "String", |_| None, values.cast()) }
        };
    fmi2SetReal: fmi2SetRealTYPE, Set =
        |instance, references: References, length: usize, values: *const fmi2Real| {
            // SAFETY: see above.
            let (references, values) = unsafe { (array(references, length), array(values, length)) };
            set(instance, references, values, Value::Real)
        };
    fmi2SetInteger: fmi2SetIntegerTYPE, Set =
        |instance, references: References, length: usize, values: *const fmi2Integer| {
            // SAFETY: see above.
            let (references, values) = unsafe { (array(references, length), array(values, length)) };
            set(instance, references, values, Value::Integer)
        };
    fmi2SetBoolean: fmi2SetBooleanTYPE, Set =
        |instance, references: References, length: usize, values: *const fmi2Boolean| {
            // SAFETY: see above.
            let (references, values) = unsafe { (array(references, length), array(values, length)) };
            set(instance, references, values, |value| Value::Boolean(value != 0))
        };
    fmi2SetString: fmi2SetStringTYPE, Set =
        |instance, _references: References, length: usize, _values: *const fmi2String| {
            if length == 0 { Ending::Ok } else { instance.refuse("there are no String variables") }
        };
    fmi2GetFMUstate: fmi2GetFMUstateTYPE, GetFmuState = |instance, state: *mut fmi2FMUstate| {
        // SAFETY: see above.
        unsafe { keep(instance, state, Instance::save) }
    };
    fmi2SetFMUstate: fmi2SetFMUstateTYPE, SetFmuState = |instance, state: fmi2FMUstate| instance.restore(state.addr());
    fmi2FreeFMUstate: fmi2FreeFMUstateTYPE, FreeFmuState = |instance, state: *mut fmi2FMUstate| {
        // SAFETY: see above.
        match unsafe { array(state, 1) } {
            Some([known]) if !known.is_null() => match instance.forget(known.addr()) {
                // SAFETY: see above.
                Ending::Ok => unsafe { write(instance, &[ptr::null_mut()], state) },
                refused => refused,
            },
            _ => Ending::Ok, // the standard: freeing null does nothing
        }
    };
    fmi2SerializedFMUstateSize: fmi2SerializedFMUstateSizeTYPE, SerializeFmuState =
        |instance, state: fmi2FMUstate, size: *mut usize| {
            let size_of = instance.serialised(state.addr()).map(|bytes| vec![bytes.len()]);
            // SAFETY: see above.
            unsafe { answer(instance, size_of, size) }
        };
    fmi2SerializeFMUstate: fmi2SerializeFMUstateTYPE, SerializeFmuState =
        |instance, state: fmi2FMUstate, bytes: *mut fmi2Byte, size: usize| match instance.serialised(state.addr()) {
            Ok(own) if own.len() > size => {
                instance.refuse(&format!("the state has {} bytes, and there is room for {size}", own.len()))
            }
            // SAFETY: see above.
            own => unsafe { answer(instance, own, bytes.cast()) },
        };
    fmi2DeSerializeFMUstate: fmi2DeSerializeFMUstateTYPE, SerializeFmuState =
        |instance, bytes: *const fmi2Byte, size: usize, state: *mut fmi2FMUstate| {
            // SAFETY: see above.
            match unsafe { array(bytes.cast::<u8>(), size) } {
                // SAFETY: see above.
                Some(bytes) => unsafe { keep(instance, state, |instance, handle| instance.deserialise(handle, bytes)) },
                None => instance.refuse("the serialised state is null"),
            }
        };
    fmi2GetDirectionalDerivative: fmi2GetDirectionalDerivativeTYPE, GetDirectionalDerivative =
        |instance, unknowns: References, unknown_count: usize, knowns: References, known_count: usize,
         seed: *const fmi2Real, sensitivity: *mut fmi2Real| {
            // SAFETY: see above.
            let arrays = unsafe { (array(unknowns, unknown_count), array(knowns, known_count), array(seed, known_count)) };
            let (Some(unknowns), Some(knowns), Some(seed)) = arrays else { return instance.refuse(NO_ARRAY) };
            let derivatives = instance.directional_derivative(unknowns, knowns, seed);
            // SAFETY: see above.
            unsafe { answer(instance, derivatives, sensitivity) }
        };
    fmi2SetRealInputDerivatives: fmi2SetRealInputDerivativesTYPE, SetRealInputDerivatives =
        |instance, references: References, length: usize, orders: *const fmi2Integer, values: *const fmi2Real| {
            // SAFETY: see above.
            match unsafe { (array(references, length), array(orders, length), array(values, length)) } {
                (Some(references), Some(orders), Some(values)) => {
                    instance.set_input_derivatives(references, orders, values)
                }
                _ => instance.refuse(NO_ARRAY),
            }
        };
    fmi2GetRealOutputDerivatives: fmi2GetRealOutputDerivativesTYPE, GetRealOutputDerivatives =
        |instance, references: References, length: usize, orders: *const fmi2Integer, values: *mut fmi2Real| {
            // SAFETY: see above.
            let arrays = unsafe { (array(references, length), array(orders, length)) };
            let (Some(references), Some(orders)) = arrays else { return instance.refuse(NO_ARRAY) };
            let derivatives = instance.output_derivatives(references, orders);
            // SAFETY: see above.
            unsafe { answer(instance, derivatives, values) }
        };
    fmi2DoStep: fmi2DoStepTYPE, DoStep =
        |instance, time: fmi2Real, step: fmi2Real, _no_set_state_before: fmi2Boolean| instance.do_step(time, step);
    // Steps are never pending: there is none to cancel, and nothing to tell about one.
    fmi2CancelStep: fmi2CancelStepTYPE, CancelStep = |_instance| Ending::Error;
    fmi2GetStatus: fmi2GetStatusTYPE, GetStatus =
        |_instance, _kind: fmi2StatusKind, _value: *mut fmi2Status| Ending::Discard;
    fmi2GetRealStatus: fmi2GetRealStatusTYPE, GetStatus =
        |instance, kind: fmi2StatusKind, value: *mut fmi2Real| match kind {
            // SAFETY: see above.
            fmi2StatusKind::fmi2LastSuccessfulTime => unsafe { write(instance, &[instance.time()], value) },
            _ => Ending::Discard,
        };
    fmi2GetIntegerStatus: fmi2GetIntegerStatusTYPE, GetStatus =
        |_instance, _kind: fmi2StatusKind, _value: *mut fmi2Integer| Ending::Discard;
    fmi2GetBooleanStatus: fmi2GetBooleanStatusTYPE, GetStatus =
        |instance, kind: fmi2StatusKind, value: *mut fmi2Boolean| match kind {
            // SAFETY: see above.
            fmi2StatusKind::fmi2Terminated => unsafe { write(instance, &[0], value) },
            _ => Ending::Discard,
        };
    fmi2GetStringStatus: fmi2GetStringStatusTYPE, GetStatus =
        |_instance, _kind: fmi2StatusKind, _value: *mut fmi2String| Ending::Discard;
}
