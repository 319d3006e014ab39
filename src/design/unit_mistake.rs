//! Numbers that are allowed, but look as if they were given in another unit.

use core::fmt;

/// What numbers of one kind usually are, and the units that they are mistaken in.
#[derive(Debug, PartialEq)]
pub struct UnitRule {
    /// Last words of the names of such quantities.
    names: &'static [&'static str],
    /// What they usually are, in the unit of the library, and in words.
    usual: [f64; 2],
    words: &'static str,
    /// Other units, the likeliest first, with how many of each make one unit of the library, and the range in which a guess makes sense.
    units: &'static [(&'static str, f64)],
    likely: [f64; 2],
    /// The unit in which a guess is told, and how many of it make one of the library.
    told: (&'static str, f64),
    /// What else helps to find the right number.
    help: &'static str,
}

/// Lengths and radii of what is built.
pub static SIZE: UnitRule = UnitRule {
    names: &["length", "radius", "size", "reach"],
    usual: [5e-5, 1.0],
    words: "usual are 0.05 mm to 1 m",
    units: &[("m", 1.0), ("um", 1e6), ("mm", 1e3)],
    likely: [5e-5, 1.0],
    told: ("mm", 1e3),
    help: "",
};

/// Remanences of rings, magnets and particles.
///
/// The grades are those of sintered `NdFeB` at 20 deg C in the data sheets of their makers, which differ by 0.01 T, for example
/// <https://nblihe.com/NdFeB-Magnets> and <https://en.shanghaimagnet.com/about/Production-Process>.
pub static REMANENCE: UnitRule = UnitRule {
    names: &["remanence"],
    usual: [0.0, 2.0],
    words: "no permanent magnet has more than 2 T",
    units: &[("kG", 10.0), ("mT", 1e3), ("G", 1e4)],
    likely: [0.1, 2.0],
    told: ("T", 1.0),
    help: "; sintered NdFeB has, in T: N35 1.17 to 1.22, N38 1.22 to 1.25, N40 1.25 to 1.28, N42 1.28 to 1.32, N45 1.32 to 1.38, \
           N48 1.38 to 1.42, N50 1.40 to 1.45, N52 1.43 to 1.48",
};

/// All rules.
const RULES: [&UnitRule; 2] = [&SIZE, &REMANENCE];

/// What is odd about a number, in words that begin with its name.
#[derive(Debug, Clone, PartialEq)]
pub struct UnitMistake(String);

impl UnitRule {
    /// The rule for a quantity of this name, without its unit and index; `None` for one whose size tells nothing.
    ///
    /// ```
    /// use mcm::design::unit_mistake::{SIZE, UnitRule};
    /// assert_eq!(UnitRule::of("design.helix.core_outer_radius"), Some(&SIZE));
    /// assert_eq!(UnitRule::of("magnet.position"), None);
    /// ```
    #[must_use]
    pub fn of(name: &str) -> Option<&'static Self> {
        let last = name.rsplit(['.', '_']).next().unwrap_or_default();
        RULES.into_iter().find(|rule| rule.names.contains(&last))
    }

    /// What is odd about a number that is written in a unit of which `per_unit` make one of the library; `None` if it is usual, or 0.
    ///
    /// ```
    /// use mcm::design::unit_mistake::{REMANENCE, SIZE};
    /// let odd = SIZE.mistake("length_mm", 0.004, 1e3).map(|odd| odd.to_string());
    /// assert_eq!(odd.as_deref(), Some("length_mm = 0.004: usual are 0.05 mm to 1 m; if it was meant in m, it is 4 mm"));
    /// assert_eq!(SIZE.mistake("length_mm", 4.0, 1e3), None);
    /// let odd = REMANENCE.mistake("remanence_t", -14.5, 1.0).unwrap().to_string();
    /// assert!(odd.contains("if it was meant in kG, it is -1.45 T"), "{odd}");
    /// ```
    #[must_use]
    pub fn mistake(&self, name: &str, written: f64, per_unit: f64) -> Option<UnitMistake> {
        if self.is_usual(written / per_unit) {
            return None;
        }
        let Self { words, help, .. } = self;
        let guess = self.guess(written, per_unit).map_or_else(String::new, |guess| format!("; {guess}"));
        Some(UnitMistake(format!("{name} = {written}: {words}{guess}{help}")))
    }

    /// Whether a number in the unit of the library is what such quantities usually are, or none.
    fn is_usual(&self, value: f64) -> bool {
        let [low, high] = self.usual;
        let size = value.abs();
        size == 0.0 || size.is_nan() || (low..=high).contains(&size)
    }

    /// The unit in which the number would be likely, in words; `None` for one that is usual as it is written.
    #[must_use]
    pub fn guess(&self, written: f64, per_unit: f64) -> Option<String> {
        if self.is_usual(written / per_unit) {
            return None;
        }
        let [low, high] = self.likely;
        let others = self.units.iter().filter(|(_, per)| per.total_cmp(&per_unit).is_ne());
        let (unit, per) = others.copied().find(|(_, per)| (low..=high).contains(&(written / per).abs()))?;
        let (told, per_told) = self.told;
        Some(format!("if it was meant in {unit}, it is {} {told}", Short(written / per * per_told)))
    }
}

impl fmt::Display for UnitMistake {
    fn fmt(&self, out: &mut fmt::Formatter<'_>) -> fmt::Result {
        out.write_str(&self.0)
    }
}

/// A number without the rounding of a conversion.
struct Short(f64);

impl fmt::Display for Short {
    fn fmt(&self, out: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(out, "{}", (self.0 * 1e9).round() / 1e9)
    }
}
