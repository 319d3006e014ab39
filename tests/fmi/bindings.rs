//! The checked-in bindings are what bindgen writes from the headers.

#[test]
fn checked_in_bindings_are_those_that_bindgen_writes() {
    let written = include_str!(concat!(env!("OUT_DIR"), "/bindings.rs"));
    let kept = include_str!("../../src/fmi/bindings.rs");
    assert!(written == kept, "src/fmi/bindings.rs differs: copy {}/bindings.rs over it", env!("OUT_DIR"));
}
