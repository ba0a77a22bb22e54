//! Flow-curve study: viscosity of the lubricant over shear stress (Fig. 3.10).

use super::question::{
    Chart, ChartAxis, Checked, Experiment, Findings, Marks, Question, RunError, Setting, Table, Tell,
};
use crate::scene::check::{count, interval, number, refuse};
use crate::solver::physics::lubricant::{Fluidity, ShearLaw};
use serde::{Deserialize, Serialize};

/// Viscosity of the lubricant, relative to its viscosity at zero shear, over shear stress for several Newtonian plateau
/// ratios.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct FlowCurve {
    /// Newtonian plateau ratios, one per curve.
    pub plateaus: Vec<f64>,
    /// First and last shear stress \[Pa\].
    pub stress: (f64, f64),
}

/// One curve.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Row {
    /// Newtonian plateau ratio.
    pub plateau: f64,
    /// Shear stress \[Pa\], η/μ, and shear rate times μ \[Pa\]. μ is the viscosity at zero shear.
    pub curve: Vec<[f64; 3]>,
}

/// Number of points per curve.
const POINTS: usize = 121;

impl Question for FlowCurve {
    type Row = Row;

    fn check(&self, experiment: &Experiment) -> Checked {
        if experiment.lubricant.shear == ShearLaw::Newtonian {
            return Err(refuse("lubricant.shear", "is Newtonian, but a flow curve needs a shear-thinning law"));
        }
        count("study.plateaus (how many)", self.plateaus.len(), 1, 20)?;
        self.plateaus.iter().try_for_each(|&plateau| number("study.plateaus", plateau, 0.0, 1.0))?;
        interval("study.stress", self.stress, 1e-3, 1e12)
    }

    fn run(&self, setting: &mut Setting<'_>, tell: &Tell<'_, Row>) -> Result<(), RunError> {
        let (from, to) = self.stress;
        for (k, &plateau) in self.plateaus.iter().enumerate() {
            setting.step("curves", k, self.plateaus.len())?;
            let law = Fluidity::of(setting.experiment.lubricant.shear, plateau);
            let curve = law.into_iter().flat_map(|(fluidity, scale)| {
                (0..POINTS).map(move |k| {
                    let stress = from * (to / from).powf(k as f64 / (POINTS - 1) as f64);
                    let (thinned, _) = fluidity.at(stress / scale);
                    [stress, 1.0 / thinned, stress * thinned]
                })
            });
            tell(Row { plateau, curve: curve.collect() });
        }
        Ok(())
    }

    /// Values of each curve, numbered from 0: `rest_0` … and `end_0` …, the viscosity ratio at the first and the last
    /// stress.
    fn findings(&self, _experiment: &Experiment, rows: &[&Row], found: &mut Findings) {
        for (k, row) in rows.iter().enumerate() {
            let of = |point: Option<&[f64; 3]>| point.map_or(f64::NAN, |[_, ratio, _]| *ratio);
            found.push(format!("rest_{k}"), None, of(row.curve.first()));
            found.push(format!("end_{k}"), None, of(row.curve.last()));
        }
    }

    fn tables(&self, rows: &[&Row]) -> Vec<Table> {
        let mut table = Table::new("flow_curve", &["npr", "stress_pa", "viscosity_ratio", "rate_times_viscosity_pa"]);
        for row in rows {
            table.rows.extend(row.curve.iter().map(|&[stress, ratio, rate]| vec![row.plateau, stress, ratio, rate]));
        }
        vec![table]
    }

    fn charts(&self, rows: &[&Row]) -> Vec<Chart> {
        let mut ratios = Chart::new("Relative viscosity", ChartAxis::log("Shear stress [Pa]"), ChartAxis::log("η/μ"));
        let mut flow =
            Chart::new("Flow curve", ChartAxis::log("Shear rate × μ [Pa]"), ChartAxis::log("Shear stress [Pa]"));
        for row in rows {
            let name = format!("NPR {}", row.plateau);
            ratios.add(name.clone(), Marks::Line, row.curve.iter().map(|&[stress, ratio, _]| [stress, ratio]));
            flow.add(name, Marks::Line, row.curve.iter().map(|&[stress, _, rate]| [rate, stress]));
        }
        vec![ratios, flow]
    }
}
