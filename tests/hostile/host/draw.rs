//! From bytes to what a call is given.

use arbitrary::Unstructured;

/// Numbers at which arithmetic ends, first those that are none.
const EXTREMES: [f64; 16] = [
    f64::NAN,
    f64::INFINITY,
    f64::NEG_INFINITY,
    f64::MAX,
    f64::MIN,
    f64::MIN_POSITIVE,
    5e-324,
    0.0,
    -0.0,
    1.0,
    -1.0,
    1e-9,
    1e9,
    -1e100,
    1e200,
    -1e-200,
];

/// A source of decisions: random bytes, or those that a fuzzer has found to lead somewhere.
pub(crate) struct Draw<'a> {
    bytes: Unstructured<'a>,
    /// Whether finite numbers may be of any size: equilibria are then seldom found, which takes long.
    bold: bool,
}

impl<'a> Draw<'a> {
    pub(crate) fn new(bytes: &'a [u8]) -> Self {
        let mut draw = Self { bytes: Unstructured::new(bytes), bold: false };
        draw.bold = draw.once_in(200);
        draw
    }

    pub(crate) fn is_empty(&self) -> bool {
        self.bytes.is_empty()
    }

    pub(crate) fn byte(&mut self) -> u8 {
        self.bytes.arbitrary().unwrap_or_default()
    }

    /// Below `end`, which is at most 256.
    pub(crate) fn below(&mut self, end: usize) -> usize {
        usize::from(self.byte()) % end.max(1)
    }

    /// True once in so many times.
    pub(crate) fn once_in(&mut self, times: u8) -> bool {
        self.byte() % times == times - 1
    }

    pub(crate) fn pick<T: Copy>(&mut self, among: &[T]) -> Option<T> {
        let index = usize::from(self.bytes.arbitrary::<u16>().unwrap_or_default());
        among.get(index % among.len().max(1)).copied()
    }

    pub(crate) fn integer(&mut self) -> i32 {
        if self.once_in(8) {
            self.bytes.arbitrary().unwrap_or_default()
        } else {
            i32::from(self.byte() % 8) - 1
        }
    }

    /// Mostly a number near `near`, or of its size; sometimes anything.
    pub(crate) fn real(&mut self, near: f64) -> f64 {
        let part = f64::from(self.bytes.arbitrary::<i16>().unwrap_or_default()) / f64::from(i16::MAX);
        match self.byte() % 64 {
            0 if !self.bold => self.pick(&EXTREMES[..3]).unwrap_or_default(),
            1..=24 if !self.bold => near,
            0 => self.pick(&EXTREMES).unwrap_or_default(),
            1 => f64::from_bits(self.bytes.arbitrary().unwrap_or_default()),
            2 => part * 10_f64.powi(i32::from(self.byte() % 16) - 8),
            3..=4 => near + 0.1 * part,
            5..=24 => near * (1.0 + 0.1 * part) + 1e-4 * part,
            _ => near * (1.0 + 0.01 * part) + 1e-6 * part,
        }
    }

    pub(crate) fn reals(&mut self, near: &[f64]) -> Vec<f64> {
        near.iter().map(|&near| self.real(near)).collect()
    }

    /// Some value references, mostly of `likely`.
    pub(crate) fn references(&mut self, likely: &[u32]) -> Vec<u32> {
        let length = if self.once_in(64) { 40 } else { self.below(6) };
        let wild = self.once_in(12);
        let one = |draw: &mut Self| {
            let any = draw.integer().unsigned_abs();
            if wild { any } else { draw.pick(likely).unwrap_or(any) }
        };
        (0..length).map(|_| one(self)).collect()
    }

    /// The start of an array, seldom null.
    pub(crate) fn pointer<T>(&mut self, array: &[T]) -> *const T {
        if self.once_in(40) { std::ptr::null() } else { array.as_ptr() }
    }
}
