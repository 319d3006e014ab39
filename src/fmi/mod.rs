//! The manipulator as an FMU for co-simulation and model exchange (FMI 2.0).

#[cfg(not(target_family = "wasm"))] // whose C types have other sizes, and which loads no FMUs
#[rustfmt::skip]
pub mod bindings; // types of the official headers

pub use crate::manipulator::output_table::quantity as units; // units and quantities

pub mod host_values; // inputs and parameters as the host has set them

pub mod value; // values and data types

pub mod dependency; // which inputs and parameters each output depends on

pub mod derivative_role; // where a variable stands in the Jacobian

pub mod variable; // one row of the table

pub mod variables; // the table of all variables, in the order of their value references

pub mod state; // the states of the calling sequence: which call is allowed when

pub mod input_derivatives; // the path of the inputs during a communication step

pub mod search_report; // what the search for an equilibrium has come to

mod fmu_state; // everything about an instance that changes

mod serialise; // an FMU state as bytes

pub mod log; // messages to the host

pub mod guid; // a GUID computed from the content

pub mod xml; // the model description, written from the table

pub mod terminals; // which variables belong together, written from the table

pub mod documentation; // the page for people, written from the table

pub mod package; // what an archive carries besides the library

pub mod location; // the directory of the unpacked resources

mod advice; // what a host is told where no equilibrium was found

pub mod instance; // one instance, and the search for its equilibrium

mod lifecycle; // its calls from set-up to termination

mod co_simulation; // its communication steps

mod model_exchange; // its modes and accepted steps in model exchange

mod get_set; // its variables, read and set

mod saved_states; // its saved FMU states

mod derivatives; // its derivatives with respect to time and inputs
mod directional_derivatives; // between variables and the Jacobian
mod neighbours; // as differences of neighbouring devices

pub mod guard; // no panic crosses the C boundary

#[cfg(not(target_family = "wasm"))]
mod registry; // live instances by handle

#[cfg(not(target_family = "wasm"))]
pub mod ffi; // the C functions: the only unsafe code

pub use instance::Instance;
pub use package::Package;
