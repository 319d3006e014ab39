//! Devices made of sections, and lists with one value for each segment or ring.

mod devices;
mod laws;
mod lists;
mod reference;
mod refusals;
