//! The device as an FMI 2.0 co-simulation FMU.

#[rustfmt::skip]
pub mod bindings; // types of the official headers

pub mod units; // units and quantities

pub mod given; // inputs and parameters as the host sets them

pub mod slope; // where a variable stands in the device's Jacobian

pub mod variable; // one row of the table

pub mod variables; // the table: reference, name, causality, unit, start, get, set

pub mod state; // which call is allowed when

mod condition; // what changes in an instance's life

pub mod rates; // the path of the inputs during a step

mod serialise; // a condition as bytes

pub mod log; // what is told to the host

pub mod guid; // a GUID that follows from content

pub mod xml; // the model description, written from the table

pub mod documentation; // the page for people, written from the table

pub mod package; // what an archive carries besides the library

pub mod location; // where a host says that the resources are

pub mod instance; // one instance, safe

mod saved; // its saved states

mod derivatives; // its derivatives by time and by inputs

pub mod guard; // a panic stops here

mod registry; // live instances by handle

pub mod ffi; // the C functions: the only unsafe code

pub use instance::Instance;
pub use package::Package;
