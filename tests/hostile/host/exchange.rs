//! Calls of model exchange.

use std::ptr;

use mcm::fmi::ffi::*;

use super::*;

impl Host<'_> {
    /// A change of mode, a time, an accepted step, or an array that is none.
    pub(super) fn exchange(&mut self, guest: &mut Guest) -> fmi2Status {
        let (mut enter, mut end, to_null) = (0, 0, self.draw.once_in(8));
        let mut event = NO_EVENT;
        let (time, length) = (self.draw.real(0.0), usize::from(self.draw.byte() % 3));
        let (values, none) = ([0.0; 2], ptr::null_mut());
        // SAFETY: null, or as many values as said.
        let status = match self.draw.byte() % 16 {
            0..=2 => self.call(guest, "fmi2EnterEventMode", |it| unsafe { fmi2EnterEventMode(it) }),
            3..=4 => self.call(guest, "fmi2NewDiscreteStates", |it| unsafe {
                fmi2NewDiscreteStates(it, if to_null { ptr::null_mut() } else { &raw mut event })
            }),
            5..=7 => self
                .call(guest, "fmi2EnterContinuousTimeMode", |it| unsafe { fmi2EnterContinuousTimeMode(it) }),
            8..=11 => self.call(guest, "fmi2CompletedIntegratorStep", |it| unsafe {
                let enter = if to_null { ptr::null_mut() } else { &raw mut enter };
                fmi2CompletedIntegratorStep(it, 1, enter, &raw mut end)
            }),
            12 => self.call(guest, "fmi2SetTime", |it| unsafe { fmi2SetTime(it, time) }),
            13 => self.call(guest, "fmi2SetContinuousStates", |it| unsafe {
                fmi2SetContinuousStates(it, values.as_ptr(), length)
            }),
            14 => {
                self.call(guest, "fmi2GetDerivatives", |it| unsafe { fmi2GetDerivatives(it, none, length) })
            }
            _ => self.call(guest, "fmi2GetEventIndicators", |it| unsafe {
                fmi2GetEventIndicators(it, none, length)
            }),
        };
        let exchanges = guest.kind == fmi2Type::fmi2ModelExchange;
        assert!(exchanges || status == ERROR, "model exchange on an instance for co-simulation");
        assert!((enter == 0 || enter == 1) && end == 0 && event.terminateSimulation == 0);
        status
    }
}
