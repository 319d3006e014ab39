//! Saved and serialised states through the C interface.

use super::*;

/// The bytes of a saved state.
fn serialised(component: fmi2Component, state: fmi2FMUstate) -> Vec<u8> {
    let mut size = 0;
    // SAFETY: one size is written, then as many bytes.
    unsafe {
        assert_eq!(fmi2SerializedFMUstateSize(component, state, &raw mut size), OK);
        let mut bytes = vec![0_u8; size];
        assert_eq!(fmi2SerializeFMUstate(component, state, bytes.as_mut_ptr().cast(), size), OK);
        bytes
    }
}

#[test]
fn a_serialised_state_is_taken_up_by_another_instance() {
    let (first, second) = (instantiate(201), instantiate(201));
    initialise(first);
    let (mut state, mut copy) = (ptr::null_mut(), ptr::null_mut());
    // SAFETY: the states are handles that the FMU wrote, or null; the bytes have their length.
    unsafe {
        assert_eq!(set(first, "magnet.position[2]", -0.118), OK);
        assert_eq!(fmi2DoStep(first, 0.0, 0.1, 0), OK);
        assert_eq!(fmi2GetFMUstate(first, &raw mut state), OK);
        let bytes = serialised(first, state);
        assert!(bytes.len() < 20_000, "{} bytes", bytes.len());
        assert_eq!(fmi2DeSerializeFMUstate(second, bytes.as_ptr().cast(), bytes.len(), &raw mut copy), OK);
        assert!(!copy.is_null() && copy != state);
        assert_eq!(fmi2SetFMUstate(first, copy), ERROR, "of another instance");
        assert_eq!(fmi2SetFMUstate(second, copy), OK);
        let kept = copy;
        assert_eq!(fmi2DeSerializeFMUstate(second, bytes.as_ptr().cast(), bytes.len(), &raw mut copy), OK);
        assert_eq!(copy, kept, "in the place of a known one");
        for component in [first, second] {
            assert_eq!(set(component, "magnet.position[2]", -0.117), OK);
            assert_eq!(fmi2DoStep(component, 0.1, 0.1, 0), OK);
        }
        assert_eq!(get(first, "tip.angle").1.to_bits(), get(second, "tip.angle").1.to_bits());
        assert_eq!(fmi2FreeFMUstate(second, &raw mut copy), OK);
        assert!(copy.is_null());
    }
    fmi2FreeInstance(first);
    fmi2FreeInstance(second);
}

#[test]
fn room_and_pointers_are_checked() {
    let component = instantiate(202);
    let (mut state, mut copy, mut size) = (ptr::null_mut(), ptr::null_mut(), 0);
    let null = ptr::null_mut();
    // SAFETY: null, and arrays shorter than what they are for, are what is tested.
    unsafe {
        assert_eq!(fmi2GetFMUstate(component, &raw mut state), OK);
        let bytes = serialised(component, state);
        let (start, length) = (bytes.as_ptr().cast(), bytes.len());
        let mut short = vec![7_u8; length - 1];
        assert_eq!(fmi2SerializeFMUstate(component, state, short.as_mut_ptr().cast(), length - 1), ERROR);
        assert!(heard(202).pop().unwrap().contains("room for"));
        assert!(short.iter().all(|&byte| byte == 7), "nothing was written");
        assert_eq!(fmi2SerializeFMUstate(component, state, ptr::null_mut(), length), ERROR);
        assert_eq!(fmi2SerializedFMUstateSize(component, null, &raw mut size), ERROR);
        assert_eq!(fmi2SerializedFMUstateSize(component, state, ptr::null_mut()), ERROR);
        assert_eq!(fmi2DeSerializeFMUstate(component, ptr::null(), length, &raw mut copy), ERROR);
        assert_eq!(fmi2DeSerializeFMUstate(component, ptr::null(), 0, &raw mut copy), ERROR);
        assert_eq!(fmi2DeSerializeFMUstate(component, start, length, ptr::null_mut()), ERROR);
        assert_eq!(fmi2DeSerializeFMUstate(component, start, length - 1, &raw mut copy), ERROR);
        assert!(heard(202).pop().unwrap().contains("bytes where"));
        assert!(copy.is_null());
        assert_eq!(fmi2FreeFMUstate(component, &raw mut state), OK);
        assert_eq!(fmi2FreeFMUstate(component, &raw mut state), OK, "null");
    }
    fmi2FreeInstance(component);
}
