//! Stress below the surface of body 1, along the axis of the contact. A worker computes the field; until it is done,
//! the previous one is drawn grey.

use crate::app::answers::picture::Picture;
use crate::app::context::Context;
use crate::app::figure::Texture;
use crate::app::plot::color_bar;
use crate::app::plot::direction::Direction;
use crate::app::plot::{axes, color_map};
use crate::app::theme::Palette;
use crate::app::units::{self, Scale, Scales};
use crate::app::wake::wake;
use crate::app::{drawn, figure, numbers};
use crate::engine::Store;
use crate::engine::job::{Background, Ending, Job, JobError, Reporter, Standing, Task};
use crate::solver::discrete::half_space::StressMeasure;
use crate::solver::full::{Solution, SubsurfaceStress};
use crate::solver::physics::engineering::QuantityKind;
use egui::{Color32, ColorImage, Id, Ui, Vec2b};
use egui_plot::{HoverPosition, MarkerShape, Points};
use serde::{Deserialize, Serialize};
use std::sync::Arc;

/// Colour of the mark of the maximum, which contrasts with the upper end of the colour scale.
const MARK: Color32 = Color32::from_rgb(20, 20, 20);

/// Computes a stress field.
#[derive(Serialize, Deserialize)]
pub struct StressTask {
    solution: Arc<Solution>,
    poisson: f64,
}

impl Task for StressTask {
    const KIND: &'static str = "stress";
    const LANE: usize = 1;
    type Message = SubsurfaceStress;

    fn run(self, _: &Store, reporter: &Reporter<SubsurfaceStress>) -> Ending {
        reporter.send(self.solution.subsurface_stress(self.poisson).map_err(JobError::failed)?);
        Ok(())
    }
}

/// Solution and Poisson's ratio of a field.
type Of = (Arc<Solution>, f64);

/// Stress field with its image, and the job that computes the next one.
#[derive(Default)]
pub struct StressImage {
    work: Background<SubsurfaceStress>,
    /// What the running or last job computes.
    asked: Option<Of>,
    field: Option<(Of, SubsurfaceStress)>,
    texture: Option<Texture>,
    drawn: Option<StressMeasure>,
    /// Values at the ends of the colour scale \[Pa\].
    range: (f64, f64),
}

fn same((solution, poisson): &Of, (other, ratio): &Of) -> bool {
    Arc::ptr_eq(solution, other) && poisson == ratio
}

impl StressImage {
    /// Starts the computation of the field if it is out of date and no other one runs, and updates the image.
    pub fn follow(&mut self, ctx: &egui::Context, context: &Context<'_>, picture: &Picture, shown: StressMeasure) {
        let of = (Arc::clone(&picture.solution), context.document.bodies().0[0].poisson);
        let idle = self.work.job().is_none();
        if idle && self.asked.as_ref().is_none_or(|asked| !same(asked, &of)) {
            let (solution, poisson) = of.clone();
            let task = StressTask { solution, poisson };
            self.work.run(Job::of("Stress below the surface", wake(ctx), context.answers.store(), task));
            self.asked = Some(of);
        }
        if self.drawn != Some(shown) {
            self.draw(ctx, shown);
        }
    }

    /// Receives the field of the job.
    pub fn receive(&mut self) {
        let mut received = None;
        self.work.receive(|field| received = Some(field));
        if let Some((field, of)) = received.zip(self.asked.clone()) {
            (self.field, self.drawn) = (Some((of, field)), None);
        }
    }

    /// Returns the progress of the job.
    pub fn standing(&self) -> Option<Standing> {
        self.work.standing()
    }

    /// Stops the job.
    pub fn stop(&self) {
        self.work.stop();
    }

    /// Returns the field of a solution if it is up to date.
    pub fn field_of(&self, solution: &Arc<Solution>) -> Option<&SubsurfaceStress> {
        self.field.as_ref().filter(|((of, _), _)| Arc::ptr_eq(of, solution)).map(|(_, field)| field)
    }

    fn draw(&mut self, ctx: &egui::Context, shown: StressMeasure) {
        let Some((_, field)) = &self.field else { return };
        let values: Vec<f64> = field.stress.iter().map(|stress| stress.measure(shown)).collect();
        self.range = values.iter().fold((0.0f64, 1.0f64), |(low, high), v| (low.min(*v), high.max(*v)));
        let colors = color_map::table(false);
        let (low, high) = self.range;
        let color = |value: &f64| {
            let t = ((value - low) / (high - low)).clamp(0.0, 1.0);
            colors[(t * (colors.len() - 1) as f64).round() as usize]
        };
        // The first row is the surface, as images start at the top.
        let image = ColorImage::new([field.x.len(), field.z.len()], values.iter().map(color).collect());
        Texture::put(&mut self.texture, ctx, "subsurface stress", image);
        self.drawn = Some(shown);
    }
}

/// Draws the field below the surface, on the axis of the profiles, with its maximum.
pub fn ui(ui: &mut Ui, image: &StressImage, (picture, shown): (&Picture, StressMeasure), stale: bool, height: f32) {
    let (Some(((solution, _), field)), Some(texture)) = (&image.field, &image.texture) else {
        ui.weak("The stress below the surface is being computed");
        return;
    };
    let texture = texture.shown(ui.ctx());
    let point = &solution.problem.point;
    let system = units::system(ui.ctx());
    let scales = Scales::of(point, system);
    let half_width_m = point.hertz().half_width_m;
    let largest = field.maximum(shown);
    let stale = stale || !Arc::ptr_eq(solution, &picture.solution);
    ui.horizontal(|ui| {
        ui.label(crate::app::controls::sentence(shown.name()).trim_end_matches('.'));
        let depth = numbers::length(largest.z * half_width_m, system);
        let text = format!("largest {} at a depth of {depth}", numbers::pressure(largest.stress_pa, system));
        let tip = format!(
            "At X = {}, Z = {} below the surface of body 1 with ν = {}, from pressure and shear stress",
            numbers::digits(largest.x, 3),
            numbers::digits(largest.z, 3),
            field.poisson
        );
        ui.weak(text).on_hover_text(tip);
    });
    let (from, to) = Direction::Along.range();
    let (Some(left), Some(right), Some(deepest)) = (field.x.first(), field.x.last(), field.z.last()) else { return };
    let nearest = |nodes: &[f64], at: f64| nodes.partition_point(|node| *node < at).min(nodes.len() - 1);
    let group = Id::unique(Direction::Along.id("profiles"));
    let palette = Palette::of(ui);
    let plot = axes::plot(ui, "subsurface stress", (height - 26.0).max(90.0), "", "Height {z}/{a}")
        .paper_x("{X} = {x}/{a}")
        .units_x(scales.along, "{x}")
        .units_y(scales.along, "Height {z}")
        .link_axis(group, Vec2b::new(true, false))
        .link_cursor(group, Vec2b::new(true, false))
        .marks_y(3.0)
        .default_x_bounds(from, to)
        .default_y_bounds(-deepest, 0.0)
        .show_y(false)
        .label_formatter(|at| {
            let (HoverPosition::NearDataPoint { position, .. } | HoverPosition::Elsewhere { position }) = at;
            let (x, z) = (position.x, -position.y);
            let inside = (*left..=*right).contains(&x) && (0.0..=*deepest).contains(&z);
            let value = field.at(nearest(&field.x, x), nearest(&field.z, z)).measure(shown);
            let place = format!("X = {}   depth {} a", numbers::digits(x, 3), numbers::digits(z, 3));
            inside.then(|| format!("{place}\n{} {}", shown.name(), numbers::pressure(value, system)))
        });
    axes::show(plot, ui, "Stress below the surface", |plot| {
        plot.field("stress field", texture, (*left, *right), (-deepest, 0.0), drawn::tint(stale));
        let place = Points::new("", vec![[largest.x, -largest.z]]).id("maximum").shape(MarkerShape::Cross);
        plot.points(place.radius(6.0).color(if stale { palette.reference } else { MARK }).allow_hover(false));
    });
    let (low, high) = image.range;
    let Scale { factor, unit } = Scale::of(QuantityKind::Stress, system, 1.0);
    let label = format!("{} in {unit}", crate::app::controls::sentence(shown.name()).trim_end_matches('.'));
    let colors = color_bar::strips(&color_map::table(false));
    figure::scale(ui.ctx(), &label, (factor * low, factor * high), &colors);
}
