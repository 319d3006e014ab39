//! Handles of saved FMU states.

use std::ptr;

use super::super::bindings::fmi2FMUstate;
use super::super::instance::Instance;
use super::super::registry;
use super::super::saved_states::UNKNOWN;
use super::super::state::Ending;
use super::memory::Output;

/// Saves an FMU state and writes its handle to where the host wants it.
///
/// `known` is the handle that the host has already, or null: a known FMU state is overwritten and keeps its handle. `save`
/// saves under the handle with this number.
pub(super) fn save(
    instance: &mut Instance,
    known: Option<fmi2FMUstate>,
    handle: Output<fmi2FMUstate>,
    save: impl FnOnce(&mut Instance, usize) -> Ending,
) -> Ending {
    let number = match known.filter(|known| !known.is_null()) {
        None => registry::new_handle(),
        Some(known) if instance.has_saved(known.addr()) => known.addr(),
        Some(_) => return instance.refuse(UNKNOWN),
    };
    let ending = save(instance, number);
    handle.write_one(ptr::without_provenance_mut(number), ending)
}
