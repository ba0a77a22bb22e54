//! Checks all values of a scene before anything is computed from it. The error names the first invalid field.

use super::check::count;
use super::check::{Checked, number, refuse};
use super::document::{Scene, TrainedModel};
use super::error::SceneError;
use super::expectation::{Expectation, Within};
use super::grid;
use super::kept_lubricant::KeptLubricant;
use super::measured_data::measured_points;
use super::study::Study;
use super::view::View;
use crate::solver::limits::plain;
use crate::solver::parameters::Quantity;
use crate::solver::physics::contact::OperatingPoint;
use crate::solver::physics::engineering::Extent;
use crate::solver::physics::lubricant::{LubricantError, ScaledShear};
use crate::solver::physics::surfaces::LARGEST_RMS;

impl Scene {
    /// Refuses values that are not finite, out of range, or do not match each other.
    ///
    /// # Errors
    /// With the first invalid field.
    pub fn check(&self) -> Result<(), SceneError> {
        plain("title", &self.title)?;
        let lubricant = |problem: LubricantError| refuse("lubricant", format!("is refused: {problem}"));
        self.lubricant.check().map_err(lubricant)?;
        self.cavitation.check().map_err(|problem| refuse("cavitation", format!("is refused: {problem}")))?;
        let point = self.point()?;
        let fluid = self.lubricant.scaled(&point).map_err(lubricant)?;
        if self.heat.is_some() {
            let refused = |problem: LubricantError| refuse("heat", format!("is refused: {problem}"));
            self.laws().check().map_err(refused)?;
            let sliding = OperatingPoint { sliding: self.sliding(), ..point };
            self.laws().scaled_heat(&fluid, &sliding).map_err(refused)?;
            self.study.check_heat()?;
        }
        if self.roughness.is_some() {
            self.laws().check().map_err(|problem| refuse("roughness", format!("is refused: {problem}")))?;
            if matches!(&self.study, Study::Training(spec) if !spec.range.is_rough()) {
                let problem = "must be left out, or the range must vary SmoothFilmRatio";
                return Err(refuse("roughness", problem).into());
            }
        }
        ScaledShear::new(self.lubricant.shear, self.sliding(), &point)
            .map_err(|problem| refuse("srr, npr", format!("are refused: {problem}")))?;
        if let Some(length) = self.length {
            if self.contact.is_point() {
                return Err(refuse("length", "belongs to a line contact; leave it out").into());
            }
            let (least, most) = Extent::LENGTHS_M;
            number("length", length, least, most)?;
        }
        grid::check(&self.grid, self.contact)?;
        self.study.check(&self.experiment())?;
        if self.training == TrainedModel::Embedded && !matches!(self.study, Study::Training(_) | Study::Transient(_)) {
            let problem = "is `Embedded`, but only the studies Training and Transient train such models";
            return Err(refuse("training", problem).into());
        }
        self.view.iter().try_for_each(view)?;
        self.expect.iter().enumerate().try_for_each(|(i, entry)| expectation(i, entry))?;
        Ok(())
    }
}

/// Checks the settings of the view.
fn view(view: &View) -> Checked {
    for (field, loss) in [("pressure_loss", view.pressure_loss), ("deformation_loss", view.deformation_loss)] {
        loss.iter().try_for_each(|&loss| number(&format!("view.{field}"), loss, 1e-16, 0.99))?;
    }
    for rms in view.surfaces.iter().flatten() {
        number("view.surfaces", *rms, 0.0, LARGEST_RMS)?;
    }
    for table in &view.measured {
        measured_points(&table.text).map_err(|error| refuse("view.measured", format!("is refused: {error}")))?;
    }
    count("view.lubricants (how many)", view.lubricants.len(), 0, KeptLubricant::MOST)?;
    for KeptLubricant { name, viscosity_pa_s, alpha_per_pa, .. } in &view.lubricants {
        count("view.lubricants.name (letters)", name.chars().count(), 1, KeptLubricant::LONGEST)?;
        let (viscosity, alpha) = (Quantity::Viscosity.range(), Quantity::Alpha.range());
        number("view.lubricants.viscosity_pa_s", *viscosity_pa_s, viscosity.0, viscosity.1)?;
        number("view.lubricants.alpha_per_pa", *alpha_per_pa, alpha.0, alpha.1)?;
    }
    let (low, high) = Quantity::RadiusY.range();
    view.radius_y_m.iter().try_for_each(|&radius_y| number("view.radius_y_m", radius_y, low, high))?;
    if !view.when_m_moves.partners().contains(&view.when_l_moves) {
        let partners = view.when_m_moves.partners().iter().map(|p| format!("{p:?}")).collect::<Vec<_>>().join(", ");
        let problem =
            format!("cannot be {:?} when M moves {:?}; write {partners}", view.when_l_moves, view.when_m_moves);
        return Err(refuse("view.when_l_moves", problem));
    }
    Ok(())
}

/// Checks the expectation with this index.
fn expectation(index: usize, entry: &Expectation) -> Checked {
    let field = format!("expect.{index} ({})", entry.name);
    let limits: &[f64] = match &entry.within {
        Within::Relative(v) | Within::Absolute(v) => {
            if entry.value.is_none() {
                return Err(refuse(field, "needs a `value` to be compared with"));
            }
            number(&format!("{field}.within"), *v, 0.0, f64::MAX)?;
            &[]
        }
        Within::AtMost(v) | Within::AtLeast(v) => &[*v],
        Within::Between(low, high) => &[*low, *high],
    };
    let all = limits.iter().copied().chain(entry.value);
    all.into_iter().try_for_each(|value| number(&field, value, -f64::MAX, f64::MAX))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::study::{error_split, grid_study, point, sweep, trajectory};
    use crate::scene::{At, Axis, Contacts, Grid, Method, Steps};
    use crate::solver::parameters::ParameterSpace;
    use crate::solver::physics::lubricant::{Cavitation, Heat};

    #[test]
    fn numbers_that_make_no_sense_are_refused_by_name() {
        let good = Scene::at_moes(40.0, 10.0);
        good.check().unwrap();
        let message = |scene: Scene| scene.check().unwrap_err().to_string();
        assert!(message(Scene { at: At::moes(f64::NAN, 10.0), ..good.clone() }).contains("Moes number M"));
        let bad_grid = Grid::Uniform { dx: f64::INFINITY, domain: (-4.0, 2.0) };
        assert!(message(Scene { grid: bad_grid, ..good.clone() }).contains("grid.dx"));
        let cavitation = Cavitation::MassConserving { supply_film_m: Some(f64::NAN) };
        assert!(message(Scene { cavitation, ..good.clone() }).contains("cavitation"));
        assert!(
            message(Scene { study: Study::Point(point::Point { methods: vec![] }), ..good.clone() })
                .contains("methods")
        );
        let heat = |scene: Scene| message(Scene { heat: Some(Heat::default()), ..scene });
        Scene { heat: Some(Heat::default()), ..good.clone() }.check().unwrap();
        let march = Study::GridStudy(grid_study::GridStudy { dx: vec![0.02, 0.01] });
        assert!(heat(Scene { study: march, ..good.clone() }).contains("RandomTest, LoadCases, Fit and Training only"));
        let full = Scene { study: Study::Point(point::Point { methods: vec![Method::Full] }), ..good.clone() };
        assert!(heat(Scene { srr: 2.0, ..full.clone() }).contains("moving heat sources"));
        let cold = Heat { inlet_temperature: 20.0, ..Heat::default() };
        assert!(message(Scene { heat: Some(cold), ..full.clone() }).contains("inlet temperature"));
        let warm = Scene { heat: Some(Heat::default()), ..full };
        warm.check().unwrap();
        assert_eq!(Scene::from_ron(&warm.to_ron().unwrap()).unwrap(), warm);
        assert!(message(Scene { training: TrainedModel::Embedded, ..good.clone() }).contains("training"));
        let huge = Study::Sweep(sweep::Sweep {
            over: vec![Axis { vary: Quantity::M, values: Steps::Log { from: 1.0, to: 9.0, n: usize::MAX } }],
            methods: vec![Method::Full],
            cold: false,
            compare_on_model_grid: false,
        });
        assert!(message(Scene { study: huge, ..good.clone() }).contains("study.over.M"));
        let follows = Study::Sweep(sweep::Sweep {
            over: vec![Axis { vary: Quantity::HertzPressure, values: Steps::List(vec![1e9]) }],
            methods: vec![Method::Full],
            cold: false,
            compare_on_model_grid: false,
        });
        assert!(message(Scene { study: follows, ..good.clone() }).contains("cannot be varied; accepted are M, L"));
        let alone = Study::Sweep(sweep::Sweep {
            over: vec![Axis { vary: Quantity::M, values: Steps::List(vec![20.0]) }],
            methods: vec![Method::Full],
            cold: false,
            compare_on_model_grid: true,
        });
        assert!(message(Scene { study: alone, ..good.clone() }).contains("study.compare_on_model_grid"));
        let mut range = ParameterSpace::table_3_1();
        range.axis_mut(Quantity::Load).unwrap().ends = (2.0, f64::NAN);
        let study = Study::Trajectory(trajectory::Trajectory { range, points: 10, methods: vec![Method::Full] });
        assert!(message(Scene { study, ..good.clone() }).contains("study.range.axes.Load.1"));
        let study = Study::ErrorSplit(error_split::ErrorSplitStudy { contacts: Contacts::Here, method: Method::Full });
        assert!(message(Scene { study, ..good.clone() }).contains("study.method"));
        let study = Study::GridStudy(grid_study::GridStudy { dx: vec![0.02, 0.01, 0.004] });
        assert!(message(Scene { study, ..good }).contains("constant factor"));
    }
}
