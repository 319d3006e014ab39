//! `mcm init`: a scene with every key, to begin with.

mod remarks;

use std::path::PathBuf;
use std::process::ExitCode;

use mcm::manipulator::SceneFile;
use mcm::vessel::Aorta;

use super::failure::Failure;
use super::output::{Output, print};

/// Every key; those without a value have their default, and all get a remark.
const TEMPLATE: &str = include_str!("init/template.txt");

/// The nine-segment device on a silicone tube of 40 Shore A, in a vessel that follows.
const IN_VESSEL: &str = "\
# Nine segments at the end of a silicone tube, in an abdominal aorta. `mcm init` explains the other keys.

[design]
spiral = \"alternating\"

[design.backbone]                # the tube through all bores; behind the base it goes on as the shaft
outer_radius_mm = 0.75
inner_radius_mm = 0.25
shore_a = 40.0
poisson = 0.45

[magnet]                         # beneath the port, its field along the vessel
position_mm = [0.0, -120.0, 20.0]

[feed]
mode = \"insertion\"
insertion_mm = 0.0

[model]
interaction = \"rings\"
time_budget_s = 10.0

[vessel]
wall_modulus_mpa = 1.0

";

/// A vessel to begin with.
#[derive(Debug, Clone, Copy, clap::ValueEnum)]
enum VesselName {
    /// An abdominal aorta flat in a plane, as a phantom on a table
    Aorta,
    /// An abdominal aorta in three dimensions
    AortaSpatial,
}

/// A device to begin with.
#[derive(Debug, Clone, Copy, clap::ValueEnum)]
enum DesignName {
    /// A magnet at the tip of a tube
    TipMagnet,
    /// Two magnets on a tube, one across the axis
    TwoMagnets,
    /// A soft magnetic tip on a tube
    MagneticTip,
    /// A wire with a bent tip, fed through a port
    JTip,
    /// A soft rod with alternating and turning magnetisation
    Tentacle,
    /// The nine segments of the paper, with one value for each
    Paper,
}

impl DesignName {
    /// Its scene.
    fn scene(self) -> &'static str {
        match self {
            Self::TipMagnet => include_str!("init/designs/tip-magnet.toml"),
            Self::TwoMagnets => include_str!("init/designs/two-magnets.toml"),
            Self::MagneticTip => include_str!("init/designs/magnetic-tip.toml"),
            Self::JTip => include_str!("init/designs/j-tip.toml"),
            Self::Tentacle => include_str!("init/designs/tentacle.toml"),
            Self::Paper => include_str!("init/designs/paper.toml"),
        }
    }
}

/// Prints a scene with every key, its default and a remark, as a beginning of one's own.
#[derive(clap::Args)]
#[command(after_help = "Examples: mcm init --out scene.toml; mcm init --schema --out scene.schema.json")]
pub(crate) struct Init {
    /// File to write instead of printing; must not exist yet
    #[arg(long, value_name = "FILE")]
    out: Option<PathBuf>,
    /// A device on a shaft in this vessel instead of every key
    #[arg(long, value_enum, value_name = "NAME")]
    vessel: Option<VesselName>,
    /// A scene with this device instead of every key
    #[arg(long, value_enum, value_name = "NAME", conflicts_with = "vessel")]
    design: Option<DesignName>,
    /// The JSON schema of scenes instead, from which editors complete and check keys
    #[arg(long, conflicts_with_all = ["vessel", "design"])]
    schema: bool,
}

impl Init {
    /// Runs the command.
    pub(crate) fn run(&self) -> Result<ExitCode, Failure> {
        let scene = match self.vessel {
            None if self.schema => SceneFile::SCHEMA.to_owned(),
            None => match self.design {
                Some(design) => design.scene().to_owned(),
                None => remarks::completed(TEMPLATE)?,
            },
            Some(VesselName::Aorta) => IN_VESSEL.to_owned() + &Aorta::planar().scene_text()?,
            Some(VesselName::AortaSpatial) => IN_VESSEL.to_owned() + &Aorta::spatial().scene_text()?,
        };
        match &self.out {
            Some(out) if out.exists() => return Err(Failure(format!("{} exists already", out.display()))),
            Some(out) => Output::at(out)?.fill(scene.as_bytes())?,
            None => print(scene)?,
        }
        Ok(ExitCode::SUCCESS)
    }
}
