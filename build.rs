//! Says where the libraries are built. With feature `bindgen`: writes the FMI bindings anew from the official headers, to `$OUT_DIR/bindings.rs`, and fails
//! unless the checked-in `src/fmi/bindings.rs`, which is what the crate compiles, is the same.

fn main() {
    println!("cargo::rerun-if-changed=build.rs");
    // The folder in which cargo leaves the library, three above that of this script's output: `mcm pack` looks for it there.
    let out = std::path::PathBuf::from(std::env::var("OUT_DIR").unwrap_or_default());
    let folder = out.ancestors().nth(3).unwrap_or(&out);
    println!("cargo::rustc-env=MCM_BUILD_FOLDER={}", folder.display());
    #[cfg(feature = "bindgen")]
    bindings::write();
}

#[cfg(feature = "bindgen")]
mod bindings {
    use std::path::{Path, PathBuf};
    use std::{env, fs};

    const KEPT: &str = "src/fmi/bindings.rs";

    pub(crate) fn write() {
        println!("cargo::rerun-if-changed=fmu/headers");
        println!("cargo::rerun-if-changed={KEPT}");
        let out = PathBuf::from(env::var("OUT_DIR").unwrap_or_default()).join("bindings.rs");
        let written = bindgen::Builder::default()
            .header("fmu/headers/fmi2Functions.h")
            .allowlist_item("fmi2.*")
            .ignore_functions() // `ffi.rs` defines them; their types (`fmi2DoStepTYPE`...) are kept
            .default_enum_style(bindgen::EnumVariation::NewType { is_bitfield: false, is_global: false })
            .ctypes_prefix("libc")
            .layout_tests(true)
            .rust_edition(bindgen::RustEdition::Edition2024)
            .raw_line("//! Types of the official headers in `fmu/headers`, as bindgen writes them (feature `bindgen`).")
            .raw_line("#![allow(missing_docs, nonstandard_style, reason = \"names of the standard\")]")
            .raw_line("#![allow(clippy::all, clippy::pedantic, clippy::allow_attributes_without_reason)]")
            .generate()
            .map_err(|error| error.to_string())
            .and_then(|bindings| bindings.write_to_file(&out).map_err(|error| error.to_string()));
        match written {
            Err(error) => println!("cargo::error=the FMI bindings could not be written: {error}"),
            Ok(()) if !same(&out, Path::new(KEPT)) => {
                println!(
                    "cargo::error={KEPT} differs from what bindgen writes: copy {} over it",
                    out.display()
                );
            }
            Ok(()) => {}
        }
    }

    fn same(written: &Path, kept: &Path) -> bool {
        fs::read(written).is_ok_and(|written| fs::read(kept).is_ok_and(|kept| written == kept))
    }
}
