//! Strings of a host that are not UTF-8: they are refused with the reason, and not repaired.

use super::*;

/// Asserts that the last message of an environment says which string is wrong and why.
fn assert_told(environment: usize, which: &str) {
    let said = heard(environment).pop().unwrap_or_default();
    assert!(said.contains(which) && said.contains("is not valid UTF-8: invalid utf-8 sequence"), "{said}");
}

#[test]
fn instantiation_with_a_string_that_is_not_utf8_is_refused() {
    let guid = CString::new(Package::built_in().unwrap().guid()).unwrap();
    let altered = CString::new([guid.as_bytes(), b"\xff"].concat()).unwrap();
    let functions = callbacks(401);
    let attempt = |name: &CStr, guid: &CStr, location: &CStr| {
        let (name, guid, location) = (name.as_ptr(), guid.as_ptr(), location.as_ptr());
        // SAFETY: texts are zero-terminated, `functions` is the callbacks above.
        unsafe {
            fmi2Instantiate(name, fmi2Type::fmi2CoSimulation, guid, location, &raw const functions, 0, 0)
        }
    };
    for (name, guid, location, which) in [
        (c"Gl\xfcck", &*guid, c"", "the instance name"),
        (c"one", &*altered, c"", "the GUID"),
        (c"one", &*guid, c"file:///nowhere/\xfc", "the resource location"),
    ] {
        assert!(attempt(name, guid, location).is_null(), "{which}");
        assert_told(401, which);
    }
    // The same characters in UTF-8 are as good as any.
    let component = attempt(c"Gl\xc3\xbcck", &guid, c"file:///nowhere/\xc3\xbc");
    assert!(!component.is_null(), "{:?}", heard(401));
    fmi2FreeInstance(component);
}

#[test]
fn strings_that_are_not_utf8_are_refused_in_calls() {
    let component = instantiate(402);
    let reference = reference("magnet.strength");
    let (references, texts) = ([reference; 2], [c"sound".as_ptr(), c"\xfe".as_ptr()]);
    let (categories, null) = ([c"logEvents".as_ptr(), c"log\xffEvents".as_ptr()], [ptr::null()]);
    // SAFETY: as many references and zero-terminated texts as said.
    unsafe {
        assert_eq!(fmi2SetString(component, references.as_ptr(), 2, texts.as_ptr()), ERROR);
        assert_told(402, "value cannot be used: string 2");
        assert_eq!(fmi2SetDebugLogging(component, 1, 2, categories.as_ptr()), ERROR);
        assert_told(402, "categories cannot be used: string 2");
        assert_eq!(fmi2SetDebugLogging(component, 1, 1, null.as_ptr()), ERROR);
        assert!(heard(402).pop().unwrap().ends_with("categories cannot be used: string 1 is null"));
        assert_eq!(fmi2SetString(component, references.as_ptr(), 1, texts.as_ptr()), ERROR);
    }
    assert!(heard(402).pop().unwrap().ends_with("there are no String variables"));
    fmi2FreeInstance(component);
}
