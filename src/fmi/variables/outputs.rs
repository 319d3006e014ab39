//! Outputs.

use super::super::dependency::Dependency;
use super::super::derivative_role::DerivativeRole;
use super::super::host_values::HostValues;
use super::super::search_report::SearchReport;
use super::super::units::RATIO;
use super::super::value::DataType;
use super::super::variable::{Access, Availability};
use super::Counts;
use super::parameters::INTERACTION;
use super::rows::{Draft, Rows};
use crate::manipulator::output_table::{
    self, CENTRELINE, CONTACT, DEVICE, Derivative, OutputRow, Owner, SHAFT, SOURCES, Scope,
};
use crate::manipulator::{Outcome, Outputs};

/// What of a scene its outputs belong to.
struct Bodies {
    counts: Counts,
    /// Names of all magnets and coils.
    sources: Vec<String>,
    mutual_wrenches: bool,
    vessel: bool,
}

impl Bodies {
    fn of(start: &HostValues, counts: &Counts) -> Self {
        Self {
            counts: *counts,
            sources: start.source_names().map(|(name, _)| name).collect(),
            mutual_wrenches: start.settings.mutual_wrenches,
            vessel: start.vessel.is_some(),
        }
    }

    fn have(&self, scope: Scope) -> bool {
        match scope {
            Scope::Always => true,
            Scope::Shaft => self.counts.shaft,
            Scope::Vessel => self.vessel,
            Scope::MutualWrenches => self.mutual_wrenches,
        }
    }

    /// How many there are of an owner.
    fn count(&self, owner: Owner) -> usize {
        match owner {
            Owner::Device => 1,
            Owner::Point => self.counts.shape_points,
            Owner::Ring => self.counts.rings,
            Owner::Core => self.counts.cores,
            Owner::OtherSource => self.sources.len() - 1,
            Owner::Source => self.sources.len(),
            Owner::Contact => 0, // they come and go
        }
    }

    /// Name and description of an output of the body with this number.
    fn named(&self, row: &OutputRow, item: usize) -> (String, String) {
        let source = match row.owner {
            Owner::OtherSource => self.sources[item + 1].as_str(),
            Owner::Source => self.sources[item].as_str(),
            _ => "",
        };
        let kind = source.split('[').next().unwrap_or_default();
        let name = row.name.replace("[k]", &format!("[{}]", item + 1)).replace("{source}", source);
        (name, row.description.replace("{source}", kind))
    }
}

fn count(number: u32) -> i32 {
    i32::try_from(number).unwrap_or(i32::MAX)
}

/// A number that describes the search for an equilibrium, and that can always be read.
fn count_of_search(name: &str, description: &str, get: fn(&SearchReport) -> i32) -> Draft {
    let draft = Draft::result(name, DataType::Integer, description, Access::IntegerOfSearch(get));
    draft.availability(Availability::Always)
}

/// A ratio that describes the search for an equilibrium, and that can always be read.
fn ratio_of_search(name: &str, description: &str, get: fn(&SearchReport) -> f64) -> Draft {
    let draft = Draft::result(name, RATIO, description, Access::RealOfSearch(get));
    draft.availability(Availability::Always)
}

fn boolean(name: &str, description: &str, get: fn(&Outputs) -> bool) -> Draft {
    Draft::result(name, DataType::Boolean, description, Access::BooleanOutput(get))
}

impl Rows {
    /// All results: those of the table of outputs, and what the search for an equilibrium has come to.
    pub(super) fn outputs(&mut self, start: &HostValues, counts: &Counts) {
        let bodies = Bodies::of(start, counts);
        self.of_table(DEVICE, &bodies);
        self.stability(&bodies);
        self.solver();
        self.model_outputs(&bodies);
        for group in [SOURCES, SHAFT, CONTACT, CENTRELINE] {
            self.of_table(group, &bodies);
        }
    }

    /// The variables of rows of the table of outputs: whole numbers first, then the others in their order. Rows of one kind of body
    /// that follow one another are written body by body.
    fn of_table(&mut self, rows: &[OutputRow], bodies: &Bodies) {
        let whole = |row: &OutputRow| matches!(row.derivative, Derivative::Whole);
        let own: Vec<&OutputRow> = rows.iter().filter(|row| row.in_fmu && bodies.have(row.scope)).collect();
        let (whole, others): (Vec<_>, Vec<_>) = own.into_iter().partition(|row| whole(row));
        let together = |a: &&OutputRow, b: &&OutputRow| a.owner == b.owner && a.owner.is_body();
        for rows in whole.chunk_by(together).chain(others.chunk_by(together)) {
            for item in 0..bodies.count(rows[0].owner) {
                for row in rows {
                    self.output(row, item, bodies);
                }
            }
        }
    }

    /// The variables of number `item` of an output.
    fn output(&mut self, row: &OutputRow, item: usize, bodies: &Bodies) {
        let whole = matches!(row.derivative, Derivative::Whole);
        let data_type = if whole { DataType::Integer } else { row.quantity.into() };
        let (name, description) = bodies.named(row, item);
        let mut draft = Draft::result(name, data_type, &description, Access::NumberOutput(row.get));
        draft = row.bounds[0].into_iter().fold(draft, Draft::min);
        draft = row.bounds[1].into_iter().fold(draft, Draft::max);

        let role = DerivativeRole::of(
            row.derivative,
            item,
            bodies.counts.shaft.then_some(bodies.counts.shape_points),
        );
        if role != DerivativeRole::None {
            let Counts { clamped_rings, shaft, .. } = bodies.counts;
            draft = draft.continuous(role).dependency(Dependency::of(role, clamped_rings, shaft));
        }
        if let Some(request) = row.request {
            draft = draft.availability(Availability::OnRequest(request));
        }

        match (row.owner, row.components) {
            (Owner::Point, 1) => self.scalar_of(item, draft.indexed(&format!("[{}]", item + 1))),
            // Point and component are two indices of one array.
            (Owner::Point, count) => self
                .components_of(item, count, &draft, |component| format!("[{},{}]", item + 1, component + 1)),
            (_, 1) => self.scalar_of(item, draft),
            (_, count) => self.array_of(item, count, &draft),
        }
    }

    /// The variables of the row of the table with this name.
    fn named(&mut self, name: &str, bodies: &Bodies) {
        if let Some(row) = output_table::row(name) {
            self.output(row, 0, bodies);
        }
    }

    fn stability(&mut self, bodies: &Bodies) {
        let description = "Whether the equilibrium is known to be stable";
        self.scalar(boolean("stability.stable", description, |o| o.stable == Some(true)));
        let description = "Whether one direction is free, as about the axis of an axisymmetric scene: neither stable nor unstable";
        self.scalar(boolean("stability.neutral", description, |o| o.outcome == Outcome::Neutral));
        self.named("stability.margin", bodies);
        let description = "Jumps to another branch since initialisation";
        self.scalar(count_of_search("stability.snaps", description, |report| count(report.snaps)).min(0.0));
    }

    fn solver(&mut self) {
        let description = "0 solved, 1 near a fold, 2 snapped in this step, 3 not solved or input refused (the other outputs are the last good ones)";
        self.scalar(count_of_search("solver.status", description, |report| report.status).min(0.0).max(3.0));
        let description = "0 solved, 1 solved but neutral; not solved: 2 the branch ends, 3 bodies touch, 4 out of budget, 5 wedged, 6 input refused";
        self.scalar(
            count_of_search("solver.outcome", description, |report| report.outcome).min(0.0).max(6.0),
        );
        let description = "Newton iterations of the last solve";
        self.scalar(
            count_of_search("solver.iterations", description, |report| count(report.iterations)).min(0.0),
        );
        let description =
            "How far along the last change of inputs an equilibrium was found: 1 where it is solved";
        self.scalar(
            ratio_of_search("solver.progress", description, |report| report.progress).min(0.0).max(1.0),
        );
        let description = "Residual of the last solve relative to the elastic forces";
        self.scalar(ratio_of_search("solver.residual", description, |report| report.residual).min(0.0));
    }

    fn model_outputs(&mut self, bodies: &Bodies) {
        let description = "Level of local interaction that was used";
        let level = Access::IntegerOutput(|o| o.interaction as i32);
        self.scalar(Draft::result("model.level", DataType::Enumeration(&INTERACTION), description, level));
        self.named("model.error_estimate", bodies);
    }
}
