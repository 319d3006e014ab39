//! An FMU state as bytes, for another run or another process.
//!
//! The bytes are a mark, the number of the format, the length of what follows, its CRC-32 (all numbers little-endian), and
//! a `postcard` record that begins with the version and the GUID. What follows from the package is left out: inputs and
//! parameters are listed in the order of the table, and the manipulator is built anew and restored from its [`Snapshot`].

use std::collections::BTreeSet;

use serde::{Deserialize, Serialize};

use super::fmu_state::{FmuState, Search};
use super::input_derivatives::InputDerivatives;
use super::package::Package;
use super::state::{Interface, State};
use super::value::Value;
use super::variable::{Causality, Variable};
use crate::error::Error;
use crate::manipulator::{Manipulator, Snapshot, TipTolerance};

const MARK: [u8; 8] = *b"mcmstate";

/// Number of the format; must be raised with every change of [`Record`] or of the types in it.
const FORMAT: u32 = 16;

const VERSION: &str = env!("CARGO_PKG_VERSION");

const HEADER: usize = MARK.len() + 4 + 8 + 4;

/// What the bytes hold of an FMU state.
#[derive(Debug, Serialize, Deserialize)]
struct Record {
    state: State,
    /// Values of inputs and parameters in the order of the table.
    host_values: Vec<Value>,
    input_derivatives: InputDerivatives,
    manipulator: Option<Snapshot>,
    accepted: Option<Snapshot>,
    search: Search,
    refused: BTreeSet<u32>,
    solved_ahead: bool,
    near_fold: bool,
    snaps: u32,
    time: f64,
}

fn refused(reason: impl Into<String>) -> Error {
    Error::Syntax { what: "serialised FMU state".into(), reason: reason.into() }
}

fn is_settable(variable: &Variable) -> bool {
    matches!(variable.causality, Causality::Input | Causality::Parameter)
}

/// The inputs and parameters.
fn settable(package: &Package) -> impl Iterator<Item = &Variable> {
    package.table().variables().iter().filter(|variable| is_settable(variable))
}

/// The bytes of an FMU state.
///
/// # Errors
/// [`Error::Syntax`] if it cannot be written.
pub(super) fn to_bytes(fmu_state: &FmuState, package: &Package) -> Result<Vec<u8>, Error> {
    let value = |variable: &Variable| variable.host_value(&fmu_state.host_values);
    let record = Record {
        state: fmu_state.state,
        host_values: settable(package).filter_map(value).collect(),
        input_derivatives: fmu_state.input_derivatives.clone(),
        manipulator: fmu_state.manipulator.as_ref().map(Manipulator::snapshot),
        accepted: fmu_state.accepted.as_ref().map(Manipulator::snapshot),
        search: fmu_state.search.clone(),
        refused: fmu_state.refused.clone(),
        solved_ahead: fmu_state.solved_ahead,
        near_fold: fmu_state.near_fold,
        snaps: fmu_state.snaps,
        time: fmu_state.time,
    };
    let body = postcard::to_stdvec(&(VERSION, package.guid(), record)).map_err(|e| refused(e.to_string()))?;
    let mut bytes = Vec::with_capacity(HEADER + body.len());
    bytes.extend(MARK);
    bytes.extend(FORMAT.to_le_bytes());
    bytes.extend((body.len() as u64).to_le_bytes());
    bytes.extend(crc32fast::hash(&body).to_le_bytes());
    bytes.extend(body);
    Ok(bytes)
}

/// The FMU state that these bytes hold.
///
/// # Errors
/// [`Error::Syntax`] for bytes that are no FMU state, or one that was truncated, altered, or written by another version or
/// for another design.
pub(super) fn from_bytes(bytes: &[u8], package: &Package) -> Result<FmuState, Error> {
    let body = checked_body(bytes)?;
    let unreadable = |error: postcard::Error| refused(error.to_string());
    let ((version, guid), rest) = postcard::take_from_bytes::<(&str, &str)>(body).map_err(unreadable)?;
    if version != VERSION {
        return Err(refused(format!("it was written by mcm {version}, and this is mcm {VERSION}")));
    }
    if guid != package.guid() {
        return Err(refused(format!("it is of the design {guid}, and this is {}", package.guid())));
    }
    let record: Record = postcard::from_bytes(rest).map_err(unreadable)?;
    restored(record, package)
}

/// The bytes after the header, if they are those that the header announces.
fn checked_body(bytes: &[u8]) -> Result<&[u8], Error> {
    let (header, body) = bytes.split_at_checked(HEADER).ok_or_else(|| refused("it is too short"))?;
    let number = |from: usize, length: usize| {
        header[from..from + length].iter().rev().fold(0, |sum, &byte| (sum << 8) | u64::from(byte))
    };
    if !header.starts_with(&MARK) {
        return Err(refused("it is none of this FMU"));
    }
    let (format, length, sum) = (number(8, 4), number(12, 8), number(20, 4));
    if format != u64::from(FORMAT) {
        return Err(refused(format!("its format is {format}, and this version reads {FORMAT}")));
    }
    if length != body.len() as u64 {
        return Err(refused(format!("it has {} bytes where {length} were written", body.len())));
    }
    if sum != u64::from(crc32fast::hash(body)) {
        return Err(refused("it was altered: the checksum does not fit"));
    }
    Ok(body)
}

/// The FMU state of a record, after a check of everything that a forged record with a valid checksum could break.
fn restored(record: Record, package: &Package) -> Result<FmuState, Error> {
    let mut fmu_state = FmuState::new(package.start());
    let rows: Vec<&Variable> = settable(package).collect();
    let complete = rows.len() == record.host_values.len();
    let all_set = rows
        .iter()
        .zip(&record.host_values)
        .all(|(row, value)| row.set(&mut fmu_state.host_values, *value).is_ok());
    let of_input = |(reference, derivative): (u32, f64)| {
        let variable = package.table().find(reference);
        derivative.is_finite() && variable.is_some_and(|row| row.causality == Causality::Input)
    };
    let sound = complete
        && all_set
        && record.input_derivatives.nonzero().all(of_input)
        && record.time.is_finite()
        && record.state != State::Broken
        && record.refused.iter().all(|&reference| package.table().find(reference).is_some_and(is_settable))
        && (record.manipulator.is_some() || matches!(record.search, Search::Open | Search::Refused(_)))
        && (record.accepted.is_some() || record.state.interface() != Some(Interface::ModelExchange));
    if !sound {
        return Err(refused("its values do not fit the variables"));
    }
    if let Some(snapshot) = &record.manipulator {
        let values = &fmu_state.host_values;
        let built = values.with_tunables_of(package.start());
        let mut manipulator = built.manipulator(package.table().counts().shape_points)?;
        // What is refused of them stands in the state, and counts in no solve.
        let _ = manipulator.set_tolerance(TipTolerance::of(&values.settings));
        let _ = manipulator.set_friction(values.friction);
        if let Some(snapshot) = &record.accepted {
            let mut accepted = manipulator.clone();
            accepted.restore(snapshot)?;
            fmu_state.accepted = Some(accepted);
        }
        manipulator.restore(snapshot)?;
        fmu_state.manipulator = Some(manipulator);
    }
    let Record { state, input_derivatives, search, refused, solved_ahead, near_fold, snaps, time, .. } =
        record;
    Ok(FmuState {
        state,
        input_derivatives,
        search,
        refused,
        solved_ahead,
        near_fold,
        snaps,
        time,
        ..fmu_state
    })
}
