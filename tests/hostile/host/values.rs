//! Calls that read and set values.

use std::ptr;

use mcm::fmi::ffi::*;

use super::*;

/// What lies in an array before the FMU writes to it; no answer.
const UNTOUCHED: u64 = 0x7ff8_dead_beef_0000;

/// Room for answers, with a place behind it that nobody may touch.
struct Room(Vec<f64>);

impl Room {
    fn of(length: usize) -> Self {
        Self(vec![f64::from_bits(UNTOUCHED); length + 1])
    }

    /// Checks that all was answered with numbers, or nothing.
    fn check(&self, name: &str, status: fmi2Status) {
        let (behind, answers) = self.0.split_last().unwrap();
        assert_eq!(behind.to_bits(), UNTOUCHED, "{name} writes beyond the array");
        if status == OK {
            assert!(answers.iter().all(|answer| answer.is_finite()), "{name} answers {answers:?}");
        } else {
            let untouched = answers.iter().all(|answer| answer.to_bits() == UNTOUCHED);
            assert!(untouched, "{name} is refused and has written {answers:?}");
        }
    }

    /// Where to write; seldom null.
    fn pointer(&mut self, draw: &mut Draw) -> *mut f64 {
        if draw.once_in(40) { ptr::null_mut() } else { self.0.as_mut_ptr() }
    }
}

impl Host<'_> {
    pub(super) fn set_reals(&mut self, guest: &mut Guest) {
        let design = &self.designs[guest.design];
        let references = match self.draw.byte() % 8 {
            0 => self.draw.references(&design.parameters),
            1 => self.draw.references(&design.outputs),
            _ => self.draw.references(&design.inputs),
        };
        let starts: Vec<_> = references.iter().map(|&reference| design.start(reference)).collect();
        let values = self.draw.reals(&starts);
        let (at, from) = (self.draw.pointer(&references), self.draw.pointer(&values));
        // SAFETY: null, or as many references and values as said.
        self.call(guest, "fmi2SetReal", |it| unsafe { fmi2SetReal(it, at, references.len(), from) });
    }

    pub(super) fn get_reals(&mut self, guest: &mut Guest) {
        let design = &self.designs[guest.design];
        let references = match self.draw.byte() % 8 {
            0 => self.draw.references(&design.parameters),
            1 => self.draw.references(&design.inputs),
            2 => design.outputs.clone(),
            _ => self.draw.references(&design.outputs),
        };
        let mut room = Room::of(references.len());
        let (at, to) = (self.draw.pointer(&references), room.pointer(&mut self.draw));
        // SAFETY: null, or as many references and values as said.
        let status =
            self.call(guest, "fmi2GetReal", |it| unsafe { fmi2GetReal(it, at, references.len(), to) });
        room.check("fmi2GetReal", status);
    }

    pub(super) fn set_others(&mut self, guest: &mut Guest) {
        let design = &self.designs[guest.design];
        let kind = self.draw.byte() % 3;
        let references = self.draw.references(if kind == 0 { &design.booleans } else { &design.integers });
        let values: Vec<_> = references.iter().map(|_| self.draw.integer()).collect();
        let texts = vec![NAME.as_ptr(); references.len()];
        let (at, count) = (self.draw.pointer(&references), references.len());
        let (from, texts) = (self.draw.pointer(&values), self.draw.pointer(&texts));
        // SAFETY: null, or as many references and values as said.
        match kind {
            0 => self.call(guest, "fmi2SetBoolean", |it| unsafe { fmi2SetBoolean(it, at, count, from) }),
            1 => self.call(guest, "fmi2SetInteger", |it| unsafe { fmi2SetInteger(it, at, count, from) }),
            _ => self.call(guest, "fmi2SetString", |it| unsafe { fmi2SetString(it, at, count, texts) }),
        };
    }

    pub(super) fn get_others(&mut self, guest: &mut Guest) {
        let design = &self.designs[guest.design];
        let kind = self.draw.byte() % 3;
        let references = self.draw.references(if kind == 0 { &design.booleans } else { &design.integers });
        let (at, count) = (self.draw.pointer(&references), references.len());
        let mut values = vec![i32::MIN; count + 1];
        let mut texts = vec![ptr::null(); count + 1];
        let to = if self.draw.once_in(40) { ptr::null_mut() } else { values.as_mut_ptr() };
        // SAFETY: null, or as many references and values as said.
        let status = match kind {
            0 => self.call(guest, "fmi2GetBoolean", |it| unsafe { fmi2GetBoolean(it, at, count, to) }),
            1 => self.call(guest, "fmi2GetInteger", |it| unsafe { fmi2GetInteger(it, at, count, to) }),
            _ => self.call(guest, "fmi2GetString", |it| unsafe {
                fmi2GetString(it, at, count, texts.as_mut_ptr())
            }),
        };
        let answered = status == OK && kind < 2;
        assert!(texts.iter().all(|text| text.is_null()));
        assert!(
            values[..count].iter().all(|&value| (value != i32::MIN) == answered),
            "{status:?} {values:?}"
        );
        assert!(kind != 0 || !answered || values[..count].iter().all(|value| [0, 1].contains(value)));
        assert_eq!(values[count], i32::MIN);
    }

    pub(super) fn directional_derivative(&mut self, guest: &mut Guest) {
        let design = &self.designs[guest.design];
        let unknowns = self.draw.references(&design.outputs);
        let knowns = self.draw.references(&design.inputs);
        let seed = self.draw.reals(&vec![1.0; knowns.len()]);
        let mut room = Room::of(unknowns.len());
        let (of, by) = (self.draw.pointer(&unknowns), self.draw.pointer(&knowns));
        let (along, to) = (self.draw.pointer(&seed), room.pointer(&mut self.draw));
        let status = self.call(guest, "fmi2GetDirectionalDerivative", |it| {
            // SAFETY: null, or as many references and values as said.
            unsafe { fmi2GetDirectionalDerivative(it, of, unknowns.len(), by, knowns.len(), along, to) }
        });
        room.check("fmi2GetDirectionalDerivative", status);
    }

    pub(super) fn set_input_derivatives(&mut self, guest: &mut Guest) {
        let design = &self.designs[guest.design];
        let references = self.draw.references(&design.inputs);
        let (orders, values) = (self.orders(references.len()), self.draw.reals(&vec![0.1; references.len()]));
        let (at, order, from) =
            (self.draw.pointer(&references), self.draw.pointer(&orders), self.draw.pointer(&values));
        self.call(guest, "fmi2SetRealInputDerivatives", |it| {
            // SAFETY: null, or as many references, orders and values as said.
            unsafe { fmi2SetRealInputDerivatives(it, at, references.len(), order, from) }
        });
    }

    pub(super) fn output_derivatives(&mut self, guest: &mut Guest) {
        let design = &self.designs[guest.design];
        let references = self.draw.references(&design.outputs);
        let orders = self.orders(references.len());
        let mut room = Room::of(references.len());
        let (at, order, to) =
            (self.draw.pointer(&references), self.draw.pointer(&orders), room.pointer(&mut self.draw));
        let status = self.call(guest, "fmi2GetRealOutputDerivatives", |it| {
            // SAFETY: null, or as many references, orders and values as said.
            unsafe { fmi2GetRealOutputDerivatives(it, at, references.len(), order, to) }
        });
        room.check("fmi2GetRealOutputDerivatives", status);
    }

    /// Orders of derivatives, mostly the one that there is.
    fn orders(&mut self, count: usize) -> Vec<fmi2Integer> {
        let odd = self.draw.once_in(8);
        (0..count).map(|_| if odd { self.draw.integer() } else { 1 }).collect()
    }
}
