//! Drawing of what is in the picture of a scene.

use plotters::coord::Shift;
use plotters::coord::types::RangedCoordf64;
use plotters::prelude::*;
use plotters::style::text_anchor::{HPos, Pos, VPos};

use super::outline::{LumenOutline, Outline};
use super::{INSIDE, Picture};
use crate::picture::{Drawn, GRID, INK, LINE, PAPER, TITLE, colour, pen, scaled, text, tick, use_font};

/// Length of the longest arrow of a force, relative to the shorter side, and least force that is drawn, relative to the largest.
const ARROW: f64 = 0.16;
const LEAST: f64 = 0.02;

/// Length and half width of an arrow's head and height of letters in the legend, pixels.
const HEAD: [f64; 2] = [11.0, 4.5];
const LEGEND: f64 = 18.0;

/// Colours by number.
const DEVICE: usize = 0;
const FORCE: usize = 1;
const FIELD: usize = 2;
const VESSEL: usize = 3;
const COIL: usize = 4;

type Plane<'a, B> = ChartContext<'a, B, Cartesian2d<RangedCoordf64, RangedCoordf64>>;

impl Picture {
    pub(super) fn draw<B: DrawingBackend>(&self, area: &DrawingArea<B, Shift>) -> Drawn
    where
        B::ErrorType: 'static,
    {
        use_font()?;
        area.fill(&WHITE)?;
        let area = area.margin(scaled(8.0), scaled(14.0), scaled(8.0), scaled(8.0));
        let (heading, body) = area.split_vertically(scaled(68.0));
        heading.draw_text(&self.title, &text(TITLE), (0, scaled(14.0)))?;
        let [(left, low), (right, high)] = self.corners;
        let mut chart = ChartBuilder::on(&body)
            .margin_top(scaled(8.0))
            .margin_right(scaled(10.0))
            .x_label_area_size(scaled(62.0))
            .y_label_area_size(scaled(84.0))
            .build_cartesian_2d(left..right, low..high)?;
        let [x, y] = self.view.labels();
        chart
            .configure_mesh()
            .disable_mesh()
            .x_desc(x)
            .y_desc(y)
            .x_labels(9)
            .y_labels(7)
            .axis_style(pen(INK, 1.0))
            .label_style(text(LEGEND))
            .axis_desc_style(text(LEGEND))
            .set_all_tick_mark_size(scaled(6.0))
            .x_label_formatter(&|value| tick(*value))
            .y_label_formatter(&|value| tick(*value))
            .draw()?;
        self.draw_vessel(&mut chart)?;
        self.draw_bodies(&mut chart)?;
        let mut scale = None;
        let largest = self.forces.iter().map(|[_, force]| force.0.hypot(force.1)).fold(0.0, f64::max);
        if largest > 0.0 {
            let [across, up] = self.sides();
            let per_newton = ARROW * across.min(up) / largest;
            for [at, force] in &self.forces {
                let length = (force.0 * per_newton, force.1 * per_newton);
                if force.0.hypot(force.1) >= LEAST * largest {
                    self.draw_arrow(&mut chart, (at.0 - length.0, at.1 - length.1), *at, FORCE)?;
                }
            }
            let round = rounded(largest);
            scale = Some((round, round * per_newton * INSIDE / across));
        }
        self.draw_field(&mut chart)?;
        self.draw_legend(&heading, scale)
    }

    fn draw_vessel<B: DrawingBackend>(&self, chart: &mut Plane<B>) -> Drawn
    where
        B::ErrorType: 'static,
    {
        let LumenOutline { parts, holes } = &self.vessel;
        let lumen = parts.iter().map(|ring| Polygon::new(ring.clone(), colour(VESSEL).mix(0.13)));
        chart.draw_series(lumen)?;
        chart.draw_series(holes.iter().map(|ring| Polygon::new(ring.clone(), WHITE.filled())))?;
        let [low, high] = self.corners;
        let edge = 0.01 * (high.0 - low.0) / INSIDE;
        let inside = |at: &(f64, f64)| {
            at.0 > low.0 + edge && at.0 < high.0 - edge && at.1 > low.1 + edge && at.1 < high.1 - edge
        };
        for ring in parts.iter().chain(holes) {
            for run in ring.split(|at| !inside(at)).filter(|run| run.len() > 1) {
                chart.draw_series([PathElement::new(run.to_vec(), pen(colour(VESSEL), 1.6))])?;
            }
        }
        Ok(())
    }

    fn draw_bodies<B: DrawingBackend>(&self, chart: &mut Plane<B>) -> Drawn
    where
        B::ErrorType: 'static,
    {
        let mut fill = |outline: &Outline, inner: RGBAColor, edge: RGBColor| -> Drawn {
            chart.draw_series([Polygon::new(outline.clone(), inner)])?;
            let closed = outline.iter().chain(outline.first()).copied().collect::<Vec<_>>();
            chart.draw_series([PathElement::new(closed, pen(edge, 1.2))])?;
            Ok(())
        };
        for coil in &self.coils {
            fill(coil, colour(COIL).mix(0.35), colour(COIL))?;
        }
        for (whole, north, _) in &self.magnet {
            fill(whole, GRID.mix(0.8), PAPER)?;
            fill(north, PAPER.mix(0.55), PAPER)?;
        }
        for shaft in &self.shaft {
            fill(shaft, GRID.mix(1.0), PAPER)?;
        }
        let [body, core] = &self.device;
        fill(body, colour(DEVICE).mix(0.3), colour(DEVICE))?;
        if !self.rings.is_empty() {
            fill(core, colour(DEVICE).mix(0.8), colour(DEVICE))?;
        }
        for ring in &self.rings {
            fill(ring, INK.mix(1.0), INK)?;
        }
        for (.., letter) in &self.magnet {
            let style = text(TITLE).pos(Pos::new(HPos::Center, VPos::Center));
            chart.draw_series([Text::new("N", *letter, style)])?;
        }
        Ok(())
    }

    fn draw_arrow<B: DrawingBackend>(
        &self,
        chart: &mut Plane<B>,
        from: (f64, f64),
        to: (f64, f64),
        number: usize,
    ) -> Drawn
    where
        B::ErrorType: 'static,
    {
        let length = (to.0 - from.0).hypot(to.1 - from.1);
        let pixel = self.sides()[0] / INSIDE;
        let shrink = (length / (HEAD[0] * pixel)).min(1.0);
        let (x, y) = ((to.0 - from.0) / length, (to.1 - from.1) / length);
        let [back, side] = HEAD.map(|size| size * pixel * shrink);
        let neck = (to.0 - back * x, to.1 - back * y);
        let head = [to, (neck.0 - side * y, neck.1 + side * x), (neck.0 + side * y, neck.1 - side * x)];
        chart.draw_series([PathElement::new(vec![from, neck], pen(colour(number), LINE))])?;
        chart.draw_series([Polygon::new(head, colour(number).filled())])?;
        Ok(())
    }

    /// Draws the direction of a uniform field in the corner at the upper right.
    fn draw_field<B: DrawingBackend>(&self, chart: &mut Plane<B>) -> Drawn
    where
        B::ErrorType: 'static,
    {
        let Some(((x, y), magnitude)) = self.field else { return Ok(()) };
        let pixel = self.sides()[0] / INSIDE;
        // As long as it seems in the plane.
        let length = 26.0 * pixel / magnitude;
        let [_, high] = self.corners;
        let centre = (high.0 - 40.0 * pixel, high.1 - 40.0 * pixel);
        let half = (x * length, y * length);
        if half.0.hypot(half.1) > pixel {
            let ends = [-1.0, 1.0].map(|sign| (centre.0 + sign * half.0, centre.1 + sign * half.1));
            self.draw_arrow(chart, ends[0], ends[1], FIELD)?;
        }
        Ok(())
    }

    fn draw_legend<B: DrawingBackend>(&self, area: &DrawingArea<B, Shift>, scale: Option<(f64, f64)>) -> Drawn
    where
        B::ErrorType: 'static,
    {
        let body = if self.rings.is_empty() { "rod" } else { "spirals" };
        let entries = [
            (body, colour(DEVICE).mix(0.3), true),
            ("core", colour(DEVICE).mix(0.8), !self.rings.is_empty()),
            ("rings", INK.mix(1.0), !self.rings.is_empty()),
            ("shaft", GRID.mix(1.0), !self.shaft.is_empty()),
            ("vessel", colour(VESSEL).mix(0.3), !self.vessel.parts.is_empty()),
            ("magnet", PAPER.mix(0.55), !self.magnet.is_empty()),
            ("coils", colour(COIL).mix(0.35), !self.coils.is_empty()),
        ];
        let style = text(LEGEND);
        let (mut x, y) = (0, scaled(48.0));
        for (label, fill, _) in entries.into_iter().filter(|(.., shown)| *shown) {
            let box_around = [(x, y - scaled(7.0)), (x + scaled(22.0), y + scaled(7.0))];
            area.draw(&Rectangle::new(box_around, fill.filled()))?;
            area.draw_text(label, &style, (x + scaled(28.0), y))?;
            x += scaled(46.0) + i32::try_from(area.estimate_text_size(label, &style)?.0)?;
        }
        let arrow = |from: i32, length: f64, number: usize| -> Drawn {
            let to = from + scaled(length);
            let neck = to - scaled(HEAD[0]);
            area.draw(&PathElement::new(vec![(from, y), (neck, y)], pen(colour(number), LINE)))?;
            let side = scaled(HEAD[1]);
            area.draw(&Polygon::new([(to, y), (neck, y - side), (neck, y + side)], colour(number).filled()))?;
            Ok(())
        };
        if let Some((force, length)) = scale {
            arrow(x, length, FORCE)?;
            let label = format!("wall, {} mN", tick(1e3 * force));
            area.draw_text(&label, &style, (x + scaled(length + 8.0), y))?;
            x += scaled(length + 26.0) + i32::try_from(area.estimate_text_size(&label, &style)?.0)?;
        }
        if let Some((_, magnitude)) = self.field {
            arrow(x, 26.0, FIELD)?;
            let label = format!("field, {} mT", tick((magnitude * 1e2).round() / 1e2));
            area.draw_text(&label, &style, (x + scaled(34.0), y))?;
        }
        Ok(())
    }
}

/// The largest of 1, 2 and 5 times a power of ten that is not above this.
fn rounded(value: f64) -> f64 {
    let power = 10_f64.powf(value.log10().floor());
    [5.0, 2.0, 1.0].into_iter().map(|digit| digit * power).find(|round| *round <= value).unwrap_or(power)
}
