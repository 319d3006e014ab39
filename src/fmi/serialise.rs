//! A condition as bytes, for another run or another process.
//!
//! The bytes are: a mark, the number of the format, the length of what follows, its CRC-32 (all numbers little-endian),
//! and a `postcard` record that begins with the version and the GUID. Whatever can be had from the package is left out:
//! inputs and parameters go by the table, and the device is made anew and takes up its [`Snapshot`].

use serde::{Deserialize, Serialize};

use super::condition::Condition;
use super::package::Package;
use super::rates::Rates;
use super::state::State;
use super::variable::{Role, Value, Variable};
use crate::error::Error;
use crate::manipulator::{Manipulator, Snapshot};

const MARK: [u8; 8] = *b"mcmstate";

/// To be raised with every change of [`Record`] or of what it holds.
const FORMAT: u32 = 7;

const VERSION: &str = env!("CARGO_PKG_VERSION");

const HEADER: usize = MARK.len() + 4 + 8 + 4;

#[derive(Debug, Serialize, Deserialize)]
struct Record {
    state: State,
    /// Inputs and parameters in the order of the table.
    values: Vec<Value>,
    rates: Rates,
    device: Option<Snapshot>,
    solved: bool,
    ahead: bool,
    near_fold: bool,
    snaps: u32,
    time: f64,
    stop: Option<f64>,
}

fn refused(reason: impl Into<String>) -> Error {
    Error::Syntax { what: "serialised FMU state".into(), reason: reason.into() }
}

/// The variables that the host gives.
fn settable(package: &Package) -> impl Iterator<Item = &Variable> {
    let settable = |variable: &&Variable| matches!(variable.role, Role::Input | Role::Fixed | Role::Tunable);
    package.table().variables().iter().filter(settable)
}

/// The bytes of a condition.
///
/// # Errors
/// [`Error::Syntax`] if it cannot be written.
pub(super) fn to_bytes(condition: &Condition, package: &Package) -> Result<Vec<u8>, Error> {
    let record = Record {
        state: condition.state,
        values: settable(package).filter_map(|variable| variable.given(&condition.given)).collect(),
        rates: condition.rates.clone(),
        device: condition.device.as_ref().map(Manipulator::snapshot),
        solved: condition.solved,
        ahead: condition.ahead,
        near_fold: condition.near_fold,
        snaps: condition.snaps,
        time: condition.time,
        stop: condition.stop,
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

/// The condition that these bytes hold.
///
/// # Errors
/// [`Error::Syntax`] for bytes that are no state, truncated, altered, of another version or of another design.
pub(super) fn from_bytes(bytes: &[u8], package: &Package) -> Result<Condition, Error> {
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

/// What follows the header.
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

fn restored(record: Record, package: &Package) -> Result<Condition, Error> {
    let mut condition = Condition::new(package.start());
    let rows: Vec<&Variable> = settable(package).collect();
    let known =
        |(row, value): (&&Variable, &Value)| row.holds(*value) && row.set(&mut condition.given, *value);
    let whole = rows.len() == record.values.len() && rows.iter().zip(&record.values).all(known);
    let inputs = |(reference, rate): (u32, f64)| {
        rate.is_finite() && package.table().find(reference).is_some_and(|row| row.role == Role::Input)
    };
    let sound = whole
        && record.rates.present().all(inputs)
        && record.time.is_finite()
        && record.state != State::Broken
        && (record.device.is_some() || !record.solved);
    if !sound {
        return Err(refused("its values do not fit the variables"));
    }
    if let Some(snapshot) = &record.device {
        let mut device = condition.given.manipulator(package.table().counts().shape_points)?;
        device.restore(snapshot)?;
        condition.device = Some(device);
    }
    let Record { state, rates, solved, ahead, near_fold, snaps, time, stop, .. } = record;
    Ok(Condition { state, rates, solved, ahead, near_fold, snaps, time, stop, ..condition })
}
