//! The C functions that the page calls. Numbers are never passed as pointers: the page writes into room that it has reserved, and
//! reads what the last call has left.
//!
//! A device is called by its number. Each function answers 1 if it went well and 0 if it did not; the text that it leaves says why,
//! or what there is to say. A panic ends the program, as WebAssembly does, and the page starts it anew.

#![allow(
    unsafe_code,
    reason = "names of exported functions, and the page's clock, are declarations that no compiler can check"
)]

use std::cell::RefCell;
use std::collections::BTreeMap;

use super::Device;
use crate::equilibrium::{Interaction, set_clock};
use crate::error::Error;

#[link(wasm_import_module = "page")]
unsafe extern "C" {
    /// Seconds since some moment, by the page's clock.
    safe fn seconds() -> f64;
}

/// What page and core share.
#[derive(Default)]
struct Desk {
    /// Room for what comes from the page.
    text: Vec<u8>,
    grid: Vec<u8>,
    inputs: Vec<f64>,
    /// Rows of inputs, one after the other.
    way: Vec<f64>,
    /// What the last call has left for the page.
    said: String,
    outputs: Vec<f64>,
    devices: BTreeMap<u32, Device>,
}

thread_local! {
    static DESK: RefCell<Desk> = RefCell::default();
}

fn at_desk<T>(work: impl FnOnce(&mut Desk) -> T) -> T {
    DESK.with_borrow_mut(work)
}

/// Room for a scene's text, UTF-8.
#[unsafe(no_mangle)]
pub extern "C" fn mcm_text(bytes: usize) -> *mut u8 {
    at_desk(|desk| {
        desk.text = vec![0; bytes];
        desk.text.as_mut_ptr()
    })
}

/// Room for the distance grid of a scene's mesh; none if that is 0 bytes long.
#[unsafe(no_mangle)]
pub extern "C" fn mcm_grid(bytes: usize) -> *mut u8 {
    at_desk(|desk| {
        desk.grid = vec![0; bytes];
        desk.grid.as_mut_ptr()
    })
}

/// Room for inputs.
#[unsafe(no_mangle)]
pub extern "C" fn mcm_inputs(count: usize) -> *mut f64 {
    at_desk(|desk| {
        desk.inputs = vec![0.0; count];
        desk.inputs.as_mut_ptr()
    })
}

/// Room for the rows of a way.
#[unsafe(no_mangle)]
pub extern "C" fn mcm_way(count: usize) -> *mut f64 {
    at_desk(|desk| {
        desk.way = vec![0.0; count];
        desk.way.as_mut_ptr()
    })
}

/// The text that the last call has left.
#[unsafe(no_mangle)]
pub extern "C" fn mcm_said() -> *const u8 {
    at_desk(|desk| desk.said.as_ptr())
}

/// Its length in bytes.
#[unsafe(no_mangle)]
pub extern "C" fn mcm_said_bytes() -> usize {
    at_desk(|desk| desk.said.len())
}

/// The outputs that the last call has left.
#[unsafe(no_mangle)]
pub extern "C" fn mcm_outputs() -> *const f64 {
    at_desk(|desk| desk.outputs.as_ptr())
}

/// Their number.
#[unsafe(no_mangle)]
pub extern "C" fn mcm_outputs_count() -> usize {
    at_desk(|desk| desk.outputs.len())
}

/// Opens the device of the scene in the room for text under this number, and leaves its description.
#[unsafe(no_mangle)]
pub extern "C" fn mcm_open(number: u32) -> u32 {
    set_clock(|| seconds());
    at_desk(|desk| {
        let grid = (!desk.grid.is_empty()).then_some(desk.grid.as_slice());
        let opened = std::str::from_utf8(&desk.text)
            .map_err(|error| Error::Syntax { what: "scene".into(), reason: error.to_string() })
            .and_then(|text| Device::open(text, grid))
            .and_then(|device| Ok((device.description()?, device)));
        match opened {
            Ok((description, device)) => {
                desk.devices.insert(number, device);
                desk.said = description;
                1
            }
            Err(error) => {
                desk.said = error.to_string();
                0
            }
        }
    })
}

/// Opens the device `number` once more as `other`, by the level with this index in the order of the FMU.
#[unsafe(no_mangle)]
pub extern "C" fn mcm_open_at_level(number: u32, other: u32, level: usize) -> u32 {
    at_desk(|desk| {
        let level = Interaction::ALL.get(level).map(|row| row.0);
        let opened = desk.devices.get(&number).zip(level).map(|(device, level)| device.at_level(level));
        opened.map_or(0, |device| {
            desk.devices.insert(other, device);
            1
        })
    })
}

/// Closes a device.
#[unsafe(no_mangle)]
pub extern "C" fn mcm_close(number: u32) {
    at_desk(|desk| desk.devices.remove(&number));
}

/// Loads a device at the inputs in the room for them, and leaves its outputs.
#[unsafe(no_mangle)]
pub extern "C" fn mcm_load(number: u32) -> u32 {
    at_desk(|desk| desk.answer(number, Device::load))
}

/// Moves a device on to the inputs in the room for them, and leaves its outputs.
#[unsafe(no_mangle)]
pub extern "C" fn mcm_step(number: u32) -> u32 {
    at_desk(|desk| desk.answer(number, Device::step))
}

/// Measures the stability margin of a device, and leaves its outputs.
#[unsafe(no_mangle)]
pub extern "C" fn mcm_measure(number: u32) -> u32 {
    at_desk(|desk| desk.answer(number, |device, _| device.measure()))
}

/// Leaves the text of a device's scene at the inputs in the room for them, with the way to them.
#[unsafe(no_mangle)]
pub extern "C" fn mcm_scene_at(number: u32) -> u32 {
    at_desk(|desk| desk.write(number, Device::scene_at))
}

/// Leaves the text of the way to the inputs in the room for them.
#[unsafe(no_mangle)]
pub extern "C" fn mcm_way_text(number: u32) -> u32 {
    at_desk(|desk| desk.write(number, Device::way_text))
}

/// A text of a device at inputs, with the way to them.
type TextAt = fn(&Device, &[f64], &[f64]) -> Result<String, Error>;

impl Desk {
    fn write(&mut self, number: u32, text: TextAt) -> u32 {
        let nothing = || Err(Error::Unsupported(format!("there is no device {number}")));
        let written = self.devices.get(&number).map_or_else(nothing, |it| text(it, &self.inputs, &self.way));
        let went_well = written.is_ok();
        self.said = written.unwrap_or_else(|error| error.to_string());
        u32::from(went_well)
    }

    fn answer(&mut self, number: u32, go: fn(&mut Device, &[f64]) -> bool) -> u32 {
        let Some(device) = self.devices.get_mut(&number) else {
            self.said = format!("there is no device {number}");
            self.outputs.clear();
            return 0;
        };
        let went_well = go(device, &self.inputs);
        self.outputs = device.outputs();
        self.said = device.said();
        u32::from(went_well)
    }
}
