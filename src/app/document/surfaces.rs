//! Document of rough surfaces: the roughness of both bodies, and whether their asperities carry load.

use super::experiment::Document;
use crate::app::refusal::Refusal;
use crate::solver::physics::bodies::Bodies;
use crate::solver::physics::lubricant::Lubricant;
use crate::solver::physics::surfaces::Roughness;

impl Document {
    /// Returns the rms roughness Rq \[m\] of body 1 and body 2: of the solution, or as entered. Without an entry, both are
    /// as smooth as good bearings.
    pub fn surfaces(&self) -> [f64; 2] {
        match &self.lubricant.roughness {
            Some(roughness) => roughness.surfaces(),
            None => self.bodies().0.map(|body| body.roughness_m),
        }
    }

    /// Returns the composite rms roughness σ \[m\].
    pub fn composite_roughness_m(&self) -> f64 {
        let [first, second] = self.surfaces();
        first.hypot(second)
    }

    /// Returns true if a roughness was entered.
    pub fn has_surfaces(&self) -> bool {
        self.lubricant.roughness.is_some() || self.view.surfaces.is_some() || self.view.bodies.is_some()
    }

    /// Sets the rms roughness Rq \[m\] of body 1 and body 2. The contact keeps all other values.
    ///
    /// # Errors
    /// A sentence if a roughness is out of range. The document is then unchanged.
    pub fn set_surfaces(&mut self, rms_m: [f64; 2]) -> Result<(), Refusal> {
        if rms_m.iter().any(|rms| rms.is_nan() || *rms < 0.0) {
            return Err(Refusal::new("a roughness must be a finite number of at least 0"));
        }
        let present = self.lubricant.roughness;
        let wanted = present.unwrap_or_else(|| Roughness::new(0.0)).with_surfaces(rms_m);
        wanted.check()?;
        if present.is_some() {
            self.set_lubricant(self.lubricant.on_rough_surfaces(Some(wanted)))?;
        }
        // It is also stored for the film ratio of smooth solutions.
        match &mut self.view.bodies {
            Some(Bodies(bodies)) => bodies.iter_mut().zip(rms_m).for_each(|(body, rms)| body.roughness_m = rms),
            None => self.view.surfaces = Some(rms_m),
        }
        Ok(())
    }

    /// Switches mixed lubrication: the solution then includes the pressure of the asperities and their effect on the
    /// flow.
    ///
    /// # Errors
    /// A sentence if a law of the lubricant does not support rough surfaces. The document is then unchanged.
    pub fn switch_mixed(&mut self, on: bool) -> Result<(), Refusal> {
        let surfaces = self.surfaces();
        if on {
            let rough = Roughness::new(0.0).with_surfaces(surfaces);
            return self.set_lubricant(self.lubricant.on_rough_surfaces(Some(rough)));
        }
        self.set_lubricant(Lubricant { roughness: None, ..self.lubricant })?;
        if self.surfaces() != surfaces { self.set_surfaces(surfaces) } else { Ok(()) }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::named_lubricant::{MINERAL_OIL, NAMED, SQUALANE_PIP};
    use crate::solver::parameters::Quantity;

    #[test]
    fn typing_a_roughness_changes_nothing_else() {
        let mut document = Document::default();
        document.set_quantity(Quantity::Modulus, 117e9).unwrap();
        document.set_quantity(Quantity::SlideToRollRatio, 0.3).unwrap();
        let before = document.point;
        document.set_surfaces([0.3e-6, 0.4e-6]).unwrap();
        assert_eq!(document.point, before);
        assert_eq!((document.surfaces(), document.lubricant.roughness), ([0.3e-6, 0.4e-6], None));
        // Bodies that are entered later have it, and bodies keep what is typed.
        document.set_bodies(document.bodies()).unwrap();
        assert_eq!(document.surfaces(), [0.3e-6, 0.4e-6]);
        let entered = document.point;
        document.set_surfaces([0.1e-6, 0.2e-6]).unwrap();
        assert_eq!((document.point, document.surfaces()), (entered, [0.1e-6, 0.2e-6]));
        assert!(document.bodies_in_force().is_some());
        for bad in [-1e-9, f64::NAN, f64::INFINITY, 1.0] {
            let before = document.clone();
            document.set_surfaces([bad, 0.0]).unwrap_err();
            assert_eq!(document, before);
        }
    }

    #[test]
    fn asperities_carry_load_once_switched_on() {
        let mut document = Document::default();
        document.set_surfaces([0.3e-6, 0.4e-6]).unwrap();
        document.switch_mixed(true).unwrap();
        let rough = document.lubricant.roughness.unwrap();
        assert!((rough.sigma - 0.5e-6).abs() < 1e-18 && rough.shear_flow > 0.0);
        document.set_surfaces([0.6e-6, 0.8e-6]).unwrap();
        assert!((document.lubricant.roughness.unwrap().sigma - 1e-6).abs() < 1e-18);
        // Other fluids keep the surfaces, also shear-thinning ones and those with heat.
        for fluid in [&MINERAL_OIL, &SQUALANE_PIP] {
            document.pick_lubricant(NAMED.iter().find(|named| named.laws.shear == fluid.shear).unwrap()).unwrap();
            assert!(document.lubricant.is_rough());
        }
        document.pick_lubricant(NAMED.iter().find(|named| named.laws.shear == MINERAL_OIL.shear).unwrap()).unwrap();
        document.switch_heat(true).unwrap();
        assert!(document.lubricant.is_rough() && document.lubricant.heat.is_some());
        let again = Document::from_ron(&document.to_ron().unwrap()).unwrap();
        assert_eq!(again.lubricant.roughness, document.lubricant.roughness);
        document.switch_mixed(false).unwrap();
        let [first, second] = document.surfaces();
        assert!(document.lubricant.roughness.is_none());
        assert!((first - 0.6e-6).abs() < 1e-18 && (second - 0.8e-6).abs() < 1e-18);
        document.switch_mixed(true).unwrap();
        assert!(document.lubricant.is_rough() && document.lubricant.heat.is_some());
    }
}
