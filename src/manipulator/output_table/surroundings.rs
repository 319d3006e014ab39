//! Outputs of what is around the device: magnets and coils beside the external magnet, shaft, vessel.

use nalgebra::Vector3;

use super::quantity::{FORCE, LENGTH, MOMENT, POSITION, RATIO};
use super::row::{Derivative, Index, OutputRow, Owner, Request, Scope, WrenchPart};
use super::spelling::{M, MM, MN, N, NMM, NUMBER, UM, UNM};
use crate::equilibrium::{Output, WallForces};
use crate::magnetics::Wrench;
use crate::manipulator::{Outputs, Reaction};

/// A component of a part of one wrench of a list; NaN where there is none.
fn of_wrench(wrenches: &[Wrench], at: Index, part: WrenchPart) -> f64 {
    wrenches.get(at.item).map_or(f64::NAN, |wrench| part.of(wrench)[at.component])
}

/// What is read of the wall; NaN without one.
fn of_wall(outputs: &Outputs, read: impl Fn(&WallForces) -> f64) -> f64 {
    outputs.wall.as_ref().map_or(f64::NAN, read)
}

/// A component of the reaction on a magnet or coil beside the external magnet; NaN where there is none.
fn of_reaction(outputs: &Outputs, at: Index, part: fn(&Reaction) -> &Vector3<f64>) -> f64 {
    outputs.on_others().get(at.item).map_or(f64::NAN, |reaction| part(reaction)[at.component])
}

/// Reactions on magnets and coils beside the external magnet, and wrenches of all on one another.
pub const SOURCES: &[OutputRow] = &[
    OutputRow::new("{source}.reaction_force", FORCE, "Force on the {source}", |out, at| {
        of_reaction(out, at, |reaction| &reaction.force)
    })
    .of(Owner::OtherSource)
    .vector()
    .derivative(Derivative::Rows(|other| Output::SourceReactionForce(other + 1)))
    .json("further_reaction_forces")
    .printed("force on source {}", MN, "magnets first, then coils"),
    OutputRow::new(
        "{source}.reaction_torque",
        MOMENT,
        "Torque on the {source} about its centre",
        |out, at| of_reaction(out, at, |reaction| &reaction.torque),
    )
    .of(Owner::OtherSource)
    .vector()
    .derivative(Derivative::Rows(|other| Output::SourceReactionTorque(other + 1)))
    .json("further_reaction_torques")
    .printed("torque on source {}", UNM, "about its centre"),
    OutputRow::new(
        "{source}.mutual_force",
        FORCE,
        "Force of all other magnets and coils on the {source}",
        |out, at| of_wrench(&out.mutual_wrenches, at, WrenchPart::Force),
    )
    .of(Owner::Source)
    .scope(Scope::MutualWrenches)
    .vector()
    .derivative(Derivative::MutualWrench(WrenchPart::Force))
    .on_request(Request::MutualWrenches)
    .json("mutual_forces")
    .printed("force on {} by others", N, "of the other magnets and coils"),
    OutputRow::new(
        "{source}.mutual_torque",
        MOMENT,
        "Torque of all other magnets and coils on the {source} about its centre",
        |out, at| of_wrench(&out.mutual_wrenches, at, WrenchPart::Torque),
    )
    .of(Owner::Source)
    .scope(Scope::MutualWrenches)
    .vector()
    .derivative(Derivative::MutualWrench(WrenchPart::Torque))
    .on_request(Request::MutualWrenches)
    .json("mutual_torques")
    .printed("torque on {} by others", NMM, "about its centre"),
];

/// What a shaft adds.
pub const SHAFT: &[OutputRow] = &[
    OutputRow::new("feed.length", LENGTH, "Length of shaft inside the port", |out, _| {
        out.feed_length.unwrap_or(f64::NAN)
    })
    .scope(Scope::Shaft)
    .min(0.0)
    .derivative(Derivative::Rows(|_| Output::FeedLength))
    .json("feed_length")
    .column("feed_length", M)
    .printed("inserted length", MM, ""),
    OutputRow::new(
        "feed.reaction_force",
        FORCE,
        "Push that holds the shaft: derivative of the potential energy by the inserted length",
        |out, _| out.feed_reaction.unwrap_or(f64::NAN),
    )
    .scope(Scope::Shaft)
    .derivative(Derivative::Rows(|_| Output::FeedReaction))
    .json("feed_reaction_force")
    .column("feed_reaction_force", N)
    .printed("push at the port", MN, ""),
];

/// What a vessel adds.
pub const CONTACT: &[OutputRow] = &[
    OutputRow::new("contact.force", FORCE, "Total force of the wall", |out, at| {
        of_wall(out, |wall| wall.force[at.component])
    })
    .scope(Scope::Vessel)
    .vector()
    .json("contact_force")
    .column("contact_force", N)
    .printed("force of the wall", MN, ""),
    OutputRow::new("contact.count", RATIO, "Separate contacts with the wall", |out, _| {
        of_wall(out, |wall| wall.count as f64)
    })
    .scope(Scope::Vessel)
    .min(0.0)
    .derivative(Derivative::Whole)
    .json("contact_count")
    .column("contact_count", NUMBER),
    OutputRow::new("contact.largest_force", FORCE, "Force of the contact with the largest one", |out, _| {
        of_wall(out, |wall| wall.largest_force)
    })
    .scope(Scope::Vessel)
    .min(0.0)
    .json("largest_contact_force")
    .column("largest_contact_force", N)
    .printed("largest contact force", MN, ""),
    OutputRow::new("contact.largest_indentation", LENGTH, "Largest depth in the wall", |out, _| {
        of_wall(out, |wall| wall.largest_indentation)
    })
    .scope(Scope::Vessel)
    .min(0.0)
    .json("largest_indentation")
    .column("largest_indentation", M)
    .printed("largest indentation", UM, ""),
    OutputRow::new("ring[k].contact_force", FORCE, "Force of the wall on the ring", |out, at| {
        of_wall(out, |wall| wall.rings[at.item][at.component])
    })
    .of(Owner::Ring)
    .scope(Scope::Vessel)
    .vector()
    .json("ring_contact_forces"),
    OutputRow::new("contact.places", POSITION, "Place of a contact", |out, at| {
        of_wall(out, |wall| wall.places[at.item][0][at.component])
    })
    .of(Owner::Contact)
    .scope(Scope::Vessel)
    .vector()
    .outside_the_fmu()
    .json("contact_places"),
    OutputRow::new("contact.forces", FORCE, "Force of the wall at a contact", |out, at| {
        of_wall(out, |wall| wall.places[at.item][1][at.component])
    })
    .of(Owner::Contact)
    .scope(Scope::Vessel)
    .vector()
    .outside_the_fmu()
    .json("contact_forces"),
];
