//! Measures of the abdominal aorta and its branches, each with its source.

use core::f64::consts::FRAC_PI_2;

/// Width of the aorta at its top and at its bifurcation, m.
///
/// Usual values. In 478 men it was 22.0 mm above and 19.0 mm below the renal arteries: J. H. Joh, H.-J. Ahn and H.-C. Park,
/// Reference diameters of the abdominal aorta and iliac arteries in the Korean population, Yonsei Med. J. 54 (2013) 48-54.
const AORTA_WIDTHS: [f64; 2] = [25e-3, 19e-3];

/// Widths of celiac trunk, superior and inferior mesenteric artery (6.43 ± 1.59, 7.38 ± 1.67, 3.61 ± 0.72 mm), m.
///
/// A. Songür et al., Abdominal aorta and its branches: morphometry - variations in autopsy cases, Eur. J. Gen. Med. 7 (2010)
/// 321-325, on 95 autopsies.
const UNPAIRED_WIDTHS: [f64; 3] = [6.43e-3, 7.38e-3, 3.61e-3];

/// Heights of their mouths above the bifurcation, m.
///
/// Songür et al. 2010, see [`UNPAIRED_WIDTHS`]: from the celiac trunk to the superior mesenteric artery 14.3 ± 2.7 mm, from there
/// to the inferior one 57.8 ± 8.0 mm, from there to the bifurcation 35.2 ± 7.4 mm. Together these are 107.3 mm; measured as a
/// whole it was 107.2 ± 11.5 mm.
const UNPAIRED_HEIGHTS: [f64; 3] = [107.3e-3, 93.0e-3, 35.2e-3];

/// Widths and lengths of the left and the right renal artery, m.
///
/// L. Lauder et al., Eurointervention 2018, doi 10.4244/EIJ-D-18-00112: 5.4 ± 1.2 and 5.2 ± 1.2 mm wide, 35 ± 13 and
/// 41 ± 15 mm long, in 1000 patients.
const RENAL: [[f64; 2]; 2] = [[5.4e-3, 35e-3], [5.2e-3, 41e-3]];

/// Distances of the left and the right renal artery below the superior mesenteric one, m.
///
/// B. D. Hutchinson, D. Keane and J. D. Dodd, Am. J. Roentgenol. 201 (2013) W342-W346 (PMID 23883251): 16 ± 12 and 10 ± 7 mm,
/// in 90 patients.
const RENAL_BELOW: [f64; 2] = [16e-3, 10e-3];

/// Angles of the left and the right renal artery from the aorta's downward direction, rad.
///
/// D. Csonka et al., Kidney Blood Press. Res. 48 (2023) 249-259, doi 10.1159/000530169: 78 and 66 deg, in 44 angiograms.
const RENAL_ANGLES: [f64; 2] = [78.0 * DEGREE, 66.0 * DEGREE];

/// Where the left and the right renal artery leave around the aorta, rad, from ventral to the right.
///
/// J.-P. Beregi et al., Eur. Radiol. 9 (1999) 1330-1334, doi 10.1007/s003300050843: 11 deg dorsal of the left side and 24 deg
/// ventral of the right side, means of 100 patients.
const RENAL_AZIMUTHS: [f64; 2] = [-101.0 * DEGREE, 66.0 * DEGREE];

/// Angle of the superior mesenteric artery from the aorta's downward direction, rad.
///
/// 45 deg, so that a device from below turns by 135 deg, the largest turn of the paper's phantom. In 385 patients it was
/// 52.7 ± 20.7 deg, doi 10.3126/nmmj.v6i2.89105.
const SMA_ANGLE: f64 = 45.0 * DEGREE;

/// Angles of the celiac trunk and the inferior mesenteric artery from the aorta's downward direction, rad.
///
/// Chosen: the celiac trunk's between the superior mesenteric artery's and a right angle, the inferior one's steeper. That they
/// leave forwards and downwards, and the inferior one to the left, is from N. Pennington and R. Soames, The anterior visceral
/// branches of the abdominal aorta and their relationship to the renal arteries, Surg. Radiol. Anat. 27 (2005) 395-403.
const CELIAC_AND_IMA_ANGLES: [f64; 2] = [60.0 * DEGREE, 30.0 * DEGREE];

/// Angles of the left and the right common iliac artery from the aorta's axis, seen from the front, rad.
///
/// C. B. Bargeron et al., Arteriosclerosis 6 (1986) 109-113, doi 10.1161/01.ATV.6.1.109: 35 ± 11 deg between them, in 70 casts.
/// The left one goes on straighter: P. M. Shah, H. A. Scarton and M. J. Tsapogas, J. Anat. 126 (1978) 451-458.
const COMMON_ILIAC_ANGLES: [f64; 2] = [15.0 * DEGREE, 20.0 * DEGREE];

/// Width and length of a common iliac artery, m.
///
/// M. Koziej et al., Anat. Sci. Int. 100 (2025) 25-35, doi 10.1007/s12565-024-00808-z: 10.5 and 55.9 mm, of 5785 patients.
const COMMON_ILIAC: [f64; 2] = [10.5e-3, 55.9e-3];

/// Width and length of an external iliac artery, m.
///
/// 7.9 ± 1.6 mm wide in 32 cadavers (Arterial variation relevant to transfemoral transcatheter aortic valve replacement, Surg.
/// Radiol. Anat.), 110.9 ± 16.0 mm long in 224 patients (R. Lunn-Collier et al., doi 10.1016/j.tria.2024.100341).
const EXTERNAL_ILIAC: [f64; 2] = [7.9e-3, 110.9e-3];

/// Width and length of an internal iliac artery, m.
///
/// M. Koziej et al., Folia Morphol. 83 (2024) 517-530, doi 10.5603/fm.97800: 6.9 and 40.0 mm.
const INTERNAL_ILIAC: [f64; 2] = [6.86e-3, 39.95e-3];

/// One degree, rad.
const DEGREE: f64 = FRAC_PI_2 / 90.0;

/// An artery that leaves the aorta.
#[derive(Debug, Clone, PartialEq)]
pub struct SideArtery {
    /// Inner width (diameter), m.
    pub width: f64,
    /// Height of the middle of its mouth above the aortic bifurcation, along the aorta, m.
    pub height: f64,
    /// Angle at its mouth from the aorta's downward direction, rad: between 20 and 150 deg.
    pub angle: f64,
    /// Where its mouth lies around the aorta, rad: 0 is ventral, positive is to the patient's right.
    pub azimuth: f64,
    /// Length from its mouth, m.
    pub length: f64,
    /// Turns behind its mouth, rad: upwards, away from the aorta, and to the right as seen along it, with the head up.
    pub turn: [f64; 2],
}

/// The iliac arteries of one side. Directions are two angles (rad) from the aorta's downward axis: away from the body's middle,
/// and ventral.
#[derive(Debug, Clone, PartialEq)]
pub struct Iliac {
    /// Inner width of the common iliac artery, m.
    pub common_width: f64,
    /// Its length from the aortic bifurcation, m.
    pub common_length: f64,
    /// Its direction, rad.
    pub common_direction: [f64; 2],
    /// Inner width of the external iliac artery, and of what follows, m.
    pub external_width: f64,
    /// Its length, m.
    pub external_length: f64,
    /// Its direction, rad.
    pub external_direction: [f64; 2],
    /// Inner width of the internal iliac artery, m.
    pub internal_width: f64,
    /// Its length, m.
    pub internal_length: f64,
    /// Its direction, rad.
    pub internal_direction: [f64; 2],
}

/// An abdominal aorta with its branches, made of published measures.
///
/// The port, where a catheter enters, is the origin: the femoral side of the left iliac artery, which runs along +z there. So does
/// the aorta at its bifurcation. The patient's right is +x, ventral is +y and the head is towards +z. The bifurcation is where the
/// lumens of the two common iliac arteries part.
///
/// ```
/// use mcm::vessel::{Aorta, Lumen};
/// let aorta = Aorta { access_length: 0.0, ..Aorta::spatial() };
/// let lumen = Lumen::new(aorta.branches()?)?;
/// let route = aorta.route("superior mesenteric", 0.02)?;
/// assert!(route.points.iter().all(|point| lumen.clearance(point).value > 3e-3)); // room for a device of 2 mm radius
/// assert!(Aorta { bottom_width: 0.0, ..aorta }.branches().is_err());
/// # Ok::<(), mcm::error::Error>(())
/// ```
#[derive(Debug, Clone, PartialEq)]
pub struct Aorta {
    /// Inner width at the celiac trunk and above, m.
    pub top_width: f64,
    /// Inner width just above the bifurcation, m.
    pub bottom_width: f64,
    /// Length above the bifurcation, m.
    pub length: f64,
    /// Turn from the bifurcation to the upper end, dorsally as the lumbar spine's lordosis, rad.
    pub lordosis: f64,
    /// The celiac trunk.
    pub celiac: SideArtery,
    /// The superior mesenteric artery.
    pub sma: SideArtery,
    /// The inferior mesenteric artery.
    pub ima: SideArtery,
    /// The left renal artery.
    pub left_renal: SideArtery,
    /// The right renal artery.
    pub right_renal: SideArtery,
    /// The left iliac arteries.
    pub left_iliac: Iliac,
    /// The right iliac arteries.
    pub right_iliac: Iliac,
    /// Straight length between the port and the external iliac artery, m.
    pub access_length: f64,
    /// Length of the vessel behind the port, m.
    pub behind_port: f64,
}

impl Default for Aorta {
    /// [`Aorta::planar`].
    fn default() -> Self {
        Self::planar()
    }
}

impl Aorta {
    /// All in the plane y = 0, as the paper's phantom, which lies flat.
    ///
    /// No measures of the phantom are published: those of the autopsies are laid into the plane. Superior and inferior mesenteric
    /// artery leave to the left, the celiac trunk to the right. The superior mesenteric artery turns outwards, so that it passes
    /// above the left renal artery, which is 20 mm below it here instead of 16 mm. With 220 mm of access the way to it is longer
    /// than 50 cm, as in the paper.
    #[must_use]
    pub fn planar() -> Self {
        let [left_iliac, right_iliac] = COMMON_ILIAC_ANGLES.map(|angle| Iliac {
            common_direction: [angle, 0.0],
            external_direction: [30.0 * DEGREE, 0.0],
            internal_direction: [-25.0 * DEGREE, 0.0],
            ..iliac()
        });

        let side = |artery: SideArtery, azimuth: f64, outwards: f64| SideArtery {
            azimuth,
            turn: [outwards * DEGREE, 0.0],
            ..artery
        };

        let spatial = Self::spatial();

        Self {
            lordosis: 0.0,
            celiac: side(spatial.celiac, FRAC_PI_2, 15.0),
            sma: SideArtery { length: 65e-3, ..side(spatial.sma, -FRAC_PI_2, 50.0) },
            ima: side(spatial.ima, -FRAC_PI_2, -10.0),
            left_renal: SideArtery { height: 73e-3, ..side(spatial.left_renal, -FRAC_PI_2, -20.0) },
            right_renal: side(spatial.right_renal, FRAC_PI_2, -10.0),
            left_iliac,
            right_iliac,
            ..spatial
        }
    }

    /// In space, as in a patient who lies on the back: celiac trunk and superior mesenteric artery ventral, renal arteries to the
    /// sides, the aorta slightly bent with the lumbar spine.
    ///
    /// Chosen are the courses behind the mouths, the aorta's bend of 15 deg (the lumbar spine's own is 54 deg on average, and the
    /// aorta's is flatter), and the iliac arteries' directions across the frontal plane. These turn by 52 deg where the common
    /// becomes the external iliac artery and by 47 deg at the groin; the veins beside them turn by 43-54 and 55-58 deg (doi
    /// 10.1016/j.jvsv.2020.06.014).
    #[must_use]
    pub fn spatial() -> Self {
        let [celiac, sma, ima] = [0, 1, 2].map(|which| SideArtery {
            width: UNPAIRED_WIDTHS[which],
            height: UNPAIRED_HEIGHTS[which],
            angle: [CELIAC_AND_IMA_ANGLES[0], SMA_ANGLE, CELIAC_AND_IMA_ANGLES[1]][which],
            azimuth: [0.0, 0.0, -25.0 * DEGREE][which],
            length: [20e-3, 100e-3, 60e-3][which],
            turn: [[20.0 * DEGREE, 0.0], [-33.0 * DEGREE, 10.0 * DEGREE], [-20.0 * DEGREE, 0.0]][which],
        });

        let [left_renal, right_renal] = [0, 1].map(|side| SideArtery {
            width: RENAL[side][0],
            height: UNPAIRED_HEIGHTS[1] - RENAL_BELOW[side],
            angle: RENAL_ANGLES[side],
            azimuth: RENAL_AZIMUTHS[side],
            length: RENAL[side][1],
            turn: [[0.0, -15.0 * DEGREE], [0.0, 45.0 * DEGREE]][side],
        });

        let [left_iliac, right_iliac] = COMMON_ILIAC_ANGLES.map(|angle| Iliac {
            common_direction: [angle, -12.0 * DEGREE],
            external_direction: [30.0 * DEGREE, 38.0 * DEGREE],
            internal_direction: [0.0, -50.0 * DEGREE],
            ..iliac()
        });

        let [top_width, bottom_width] = AORTA_WIDTHS;
        Self {
            top_width,
            bottom_width,
            length: 140e-3,
            lordosis: 15.0 * DEGREE,
            celiac,
            sma,
            ima,
            left_renal,
            right_renal,
            left_iliac,
            right_iliac,
            access_length: 220e-3,
            behind_port: 40e-3,
        }
    }
}

/// Widths and lengths of the iliac arteries.
fn iliac() -> Iliac {
    let [[common_width, common_length], [external_width, external_length], [internal_width, internal_length]] =
        [COMMON_ILIAC, EXTERNAL_ILIAC, INTERNAL_ILIAC];
    Iliac {
        common_width,
        common_length,
        common_direction: [0.0; 2],
        external_width,
        external_length,
        external_direction: [0.0; 2],
        internal_width,
        internal_length,
        internal_direction: [0.0; 2],
    }
}
