//! Document in engineering quantities: an oil at a temperature, and two bodies.

use super::experiment::Document;
use crate::app::refusal::Refusal;
use crate::scene::named_lubricant::of_laws;
use crate::solver::parameters::Quantity;
use crate::solver::physics::bodies::{Bodies, Body, Material, surface_speeds};
use crate::solver::physics::contact::OperatingPoint;
use crate::solver::physics::engineering::{Extent, Oil};
use crate::solver::physics::lubricant::{Heat, Lubricant};
use crate::solver::physics::machines::Machine;

const OF_THE_OIL: [Quantity; 2] = [Quantity::Viscosity, Quantity::Alpha];
const OF_THE_BODIES: [Quantity; 3] = [Quantity::Radius, Quantity::Modulus, Quantity::Speed];

impl Document {
    /// Sets η₀ and α from an oil and holds them. For a thermal contact it sets the inlet temperature and the thermal
    /// constants of the oil.
    ///
    /// # Errors
    /// A sentence if there is no such oil, or if the lubricant's own law fixes α. The document is then
    /// unchanged.
    pub fn set_oil(&mut self, oil: Oil) -> Result<(), Refusal> {
        if self.lubricant.own_coefficient().is_some() {
            let why = "the lubricant’s own viscosity law fixes α; choose Mineral oil above to enter a grade";
            return Err(Refusal::new(why));
        }
        let point = self.of_oil(&oil)?;
        let state = oil.state()?;
        // The temperature of the oil is that of the inlet.
        let heat =
            self.lubricant.heat.map(|heat| Heat { oil: state.heat, inlet_temperature: oil.temperature_k, ..heat });
        self.set_contact(point, Lubricant { heat, ..self.lubricant })?;
        self.view.oil = Some(oil);
        OF_THE_OIL.into_iter().for_each(|quantity| self.view.held.set(quantity, true));
        Ok(())
    }

    /// Sets R, E′, u_m and SRR from two bodies and holds the first three. For a point contact it also sets R_y if
    /// the radii along and across differ. For a thermal contact it sets the thermal constants of the bodies.
    ///
    /// # Errors
    /// A sentence if the bodies form no contact. The document is then unchanged.
    pub fn set_bodies(&mut self, bodies: Bodies) -> Result<(), Refusal> {
        let (point, lubricant) = self.of_bodies(&bodies)?;
        self.set_contact(point, lubricant)?;
        self.view.bodies = Some(bodies);
        OF_THE_BODIES.into_iter().for_each(|quantity| self.view.held.set(quantity, true));
        if self.point.radius_y_m.is_some() {
            self.view.held.set(Quantity::RadiusY, true);
        }
        Ok(())
    }

    /// Returns the length of a line contact, and the radii of the bodies that the contact has the values of.
    pub fn extent(&self) -> Extent {
        let radii_m = self.bodies_in_force().map_or([None; 2], |bodies| bodies.0.map(|body| body.radius_m));
        Extent { length_m: self.length_m.filter(|_| self.point.kind.is_line()), radii_m }
    }

    /// Sets kind of contact, bodies, speeds and load of a machine at its position, and holds them. Materials and
    /// roughness of the bodies stay.
    ///
    /// # Errors
    /// A sentence if the machine has no contact there. The document is then unchanged.
    pub fn set_machine(&mut self, machine: Machine) -> Result<(), Refusal> {
        let base = self.bodies();
        let contact = machine.contact(base.reduced_modulus_pa()?)?;
        let bodies = contact.bodies(base);
        let point = contact.operating_point(base, self.point)?;
        let heat = self.lubricant.heat.map(|heat| Heat { bodies: bodies.heat(), ..heat });
        self.set_contact(point, Lubricant { heat, ..self.lubricant })?;
        self.view.bodies = Some(bodies);
        self.view.machine = Some(machine);
        let held = OF_THE_BODIES.into_iter().chain([Quantity::Load]);
        held.for_each(|quantity| self.view.held.set(quantity, true));
        self.view.held.set(Quantity::RadiusY, self.point.radius_y_m.is_some());
        Ok(())
    }

    /// Returns true if the present contact still has the values of the entered machine.
    pub fn machine_counts(&self) -> bool {
        let contact = || {
            let (machine, base) = (self.view.machine.as_ref()?, self.bodies());
            let contact = machine.contact(base.reduced_modulus_pa().ok()?).ok()?;
            contact.operating_point(base, self.point).ok()
        };
        contact() == Some(self.point)
    }

    /// Returns true if the present contact still has the values of its oil.
    pub fn oil_counts(&self) -> bool {
        self.view.oil.is_some_and(|oil| self.of_oil(&oil) == Ok(self.point))
    }

    /// Returns the bodies of the present contact: those that were entered, with the values that were changed since
    /// then. Without an entry, returns a roller or ball on a plane. An edit of one value therefore keeps all others.
    pub fn bodies(&self) -> Bodies {
        let point = &self.point;
        let srr = point.sliding.slide_to_roll_ratio;
        let entered = self.view.bodies.unwrap_or_else(|| {
            let [own, other] = self.lubricant.heat.unwrap_or_default().bodies;
            let Bodies([first, second]) = Bodies::on_plane(point.radius_m, point.speed_m_per_s, srr);
            let mut bodies = [first.conducting(own), second.conducting(other)];
            if let Some(surfaces) = self.view.surfaces {
                bodies.iter_mut().zip(surfaces).for_each(|(body, rms)| body.roughness_m = rms);
            }
            Bodies(bodies)
        });
        let same = |one: f64, other: f64| (one - other).abs() <= 1e-12 * other.abs();
        let mut bodies = entered;
        let along = entered.reduced_radius_m().is_ok_and(|radius| same(radius, point.radius_m));
        let radius_y = point.radius_y_m.unwrap_or(point.radius_m);
        let line = point.kind.is_line();
        let across = line || entered.reduced_transverse_radius_m().is_ok_and(|radius| same(radius, radius_y));
        if !(along && across) {
            let Bodies([first, second]) = Bodies::on_plane(point.radius_m, point.speed_m_per_s, srr);
            // An elliptical contact with a plane needs a body with both radii.
            let first = point.radius_y_m.map_or(first, |radius_y| first.with_transverse_radius_m(Some(radius_y)));
            for (body, Body { radius_m, transverse, .. }) in bodies.0.iter_mut().zip([first, second]) {
                *body = Body { radius_m, transverse, ..*body };
            }
        }
        let moving = |(mean, sliding): (f64, f64)| same(mean, point.speed_m_per_s) && (sliding - srr).abs() <= 1e-12;
        if !entered.entrainment().is_ok_and(moving) {
            let speeds = surface_speeds(point.speed_m_per_s, srr);
            bodies.0.iter_mut().zip(speeds).for_each(|(body, speed)| body.speed_m_per_s = speed);
        }
        if let Ok(modulus) = entered.reduced_modulus_pa()
            && !same(modulus, point.modulus_pa)
        {
            bodies.0.iter_mut().for_each(|body| body.modulus_pa *= point.modulus_pa / modulus);
        }
        let heat = self.lubricant.heat.into_iter().flat_map(|heat| heat.bodies);
        bodies.0.iter_mut().zip(heat).for_each(|(body, heat)| body.heat = heat);
        bodies
    }

    /// Returns the bodies that were entered, if the present contact still has their values.
    pub fn bodies_in_force(&self) -> Option<Bodies> {
        self.view.bodies.filter(|bodies| self.of_bodies(bodies) == Ok((self.point, self.lubricant)))
    }

    fn of_oil(&self, oil: &Oil) -> Result<OperatingPoint, Refusal> {
        let state = oil.state()?;
        Ok(OperatingPoint { viscosity_pa_s: state.viscosity_pa_s, alpha_per_pa: state.alpha_per_pa, ..self.point })
    }

    /// Switches the computation of temperatures. The bodies are those that were entered if E′ is still theirs,
    /// otherwise steel.
    ///
    /// # Errors
    /// A sentence if the contact cannot be computed with heat. The document is then unchanged.
    pub fn switch_heat(&mut self, on: bool) -> Result<(), Refusal> {
        let named = of_laws(&self.lubricant, &self.point).map(|named| named.heat);
        let chosen = self.view.oil.filter(|_| self.oil_counts());
        let oil = chosen.and_then(|oil| oil.state().ok()).map(|state| state.heat).or(named).unwrap_or_default();
        let inlet_temperature = chosen.map_or(Heat::default().inlet_temperature, |oil| oil.temperature_k);
        let entered = self.view.bodies.filter(|bodies| bodies.reduced_modulus_pa() == Ok(self.point.modulus_pa));
        let bodies = entered.map_or(Heat::default().bodies, |bodies| bodies.heat());
        let heat = on.then_some(Heat { oil, bodies, inlet_temperature });
        self.set_lubricant(Lubricant { heat, ..self.lubricant })
    }

    /// Sets the laws of the lubricant. If an oil is in force, a changed inlet temperature is that of the oil, which then
    /// sets η₀, α and its thermal constants.
    ///
    /// # Errors
    /// A sentence if a law is not defined for the contact. The document is then unchanged.
    pub fn set_laws(&mut self, laws: Lubricant) -> Result<(), Refusal> {
        let inlet = |laws: &Lubricant| laws.heat.map(|heat| heat.inlet_temperature);
        let wanted = inlet(&laws).filter(|wanted| inlet(&self.lubricant).is_some_and(|before| before != *wanted));
        let oil = self.view.oil.filter(|_| self.oil_counts());
        let mut with = self.clone();
        with.set_lubricant(laws)?;
        if let (Some(oil), Some(temperature_k)) = (oil, wanted) {
            with.set_oil(Oil { temperature_k, ..oil })?;
        }
        *self = with;
        Ok(())
    }

    /// Sets the material of a body, 0 or 1. If the contact still has the values of the entered bodies, the body
    /// changes; otherwise only the thermal constants change.
    ///
    /// # Errors
    /// A sentence if the bodies form no contact. The document is then unchanged.
    pub fn set_material(&mut self, body: usize, material: Material) -> Result<(), Refusal> {
        if let Some(mut bodies) = self.bodies_in_force() {
            bodies.0[body] = bodies.0[body].of(material);
            return self.set_bodies(bodies);
        }
        let mut lubricant = self.lubricant;
        lubricant.heat.iter_mut().for_each(|heat| heat.bodies[body] = material.heat);
        self.set_lubricant(lubricant)
    }

    /// Returns the contact and the lubricant's laws that result from the bodies and the present contact.
    fn of_bodies(&self, bodies: &Bodies) -> Result<(OperatingPoint, Lubricant), Refusal> {
        let point = bodies.contact(self.point)?;
        let heat = self.lubricant.heat.map(|heat| Heat { bodies: bodies.heat(), ..heat });
        Ok((point, Lubricant { heat, ..self.lubricant }))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::app::document::{Edit, Shape};
    use crate::solver::full::Problem;
    use crate::solver::physics::contact::Moes;
    use crate::solver::physics::engineering::{Grade, OilFamily};
    use crate::solver::physics::machines::{Bearing, CamFollower, GearPair};

    const VG_68: Oil = Oil {
        grade: Grade::IsoVg(68.0),
        family: OilFamily::Mineral,
        temperature_k: 333.15,
        density_15: 880.0,
        alpha_per_pa: None,
    };

    #[test]
    fn a_machine_defines_bodies_and_load_and_is_remembered() {
        let mut document = Document::default();
        document.set_oil(VG_68).unwrap();
        let rough = |bodies: Bodies| bodies.0.map(|body| (body.roughness_m, body.modulus_pa));
        let before = (document.point.viscosity_pa_s, rough(document.bodies()));
        for machine in [
            Machine::Bearing(Bearing::default()),
            Machine::Gear(GearPair::default()),
            Machine::Cam(CamFollower::default()),
        ] {
            document.set_machine(machine.clone()).unwrap();
            let contact = machine.contact(document.bodies().reduced_modulus_pa().unwrap()).unwrap();
            assert_eq!((document.point.load, document.point.kind), (contact.load, contact.kind));
            assert!((document.point.radius_m / contact.radius_m() - 1.0).abs() < 1e-12);
            assert!((document.point.speed_m_per_s / contact.mean_speed().abs() - 1.0).abs() < 1e-12);
            assert!(document.machine_counts() && document.bodies_in_force() == Some(document.bodies()));
            assert_eq!((document.point.viscosity_pa_s, rough(document.bodies())), before, "oil and materials stay");
            let again = Document::from_ron(&document.to_ron().unwrap()).unwrap();
            assert_eq!((again.view.machine.as_ref(), again.point), (Some(&machine), document.point));
        }
        let wrong = Machine::Bearing(Bearing { radial_n: 0.0, ..Bearing::default() });
        let before = document.clone();
        assert!(document.set_machine(wrong).unwrap_err().contains("carries no load"));
        assert_eq!(document, before);
        document.type_quantity(Quantity::Load, 1e5).unwrap();
        assert!(!document.machine_counts());
    }

    #[test]
    fn one_oil_serves_film_friction_and_heat() {
        let mut document = Document::default();
        document.set_oil(VG_68).unwrap();
        document.switch_heat(true).unwrap();
        let heat = |document: &Document| document.lubricant.heat.unwrap();
        assert_eq!((heat(&document).oil, heat(&document).inlet_temperature), (VG_68.state().unwrap().heat, 333.15));
        // The inlet temperature is that of the oil, whichever is typed.
        let warm = Heat { inlet_temperature: 353.15, ..heat(&document) };
        document.edit(Edit::Laws(Box::new(Lubricant { heat: Some(warm), ..document.lubricant }))).unwrap();
        let state = Oil { temperature_k: 353.15, ..VG_68 }.state().unwrap();
        assert_eq!(document.view.oil.unwrap().temperature_k, 353.15);
        assert_eq!((document.point.viscosity_pa_s, heat(&document).oil), (state.viscosity_pa_s, state.heat));
        document.set_oil(VG_68).unwrap();
        assert_eq!(heat(&document).inlet_temperature, 333.15);
    }

    #[test]
    fn a_roughness_or_a_material_leaves_all_other_entries() {
        // Typed values in turn; each keeps what was typed before.
        let mut document = Document::default();
        document.type_quantity(Quantity::Modulus, 220e9).unwrap();
        document.type_quantity(Quantity::SlideToRollRatio, 0.1).unwrap();
        let point = document.point;
        let mut bodies = document.bodies();
        bodies.0[0].roughness_m = 2e-7;
        document.set_bodies(bodies).unwrap();
        for (now, before) in document.point.quantities().into_iter().zip(point.quantities()) {
            assert!((now / before - 1.0).abs() < 1e-12, "a roughness changes no other value: {now} {before}");
        }
        document.type_quantity(Quantity::SlideToRollRatio, 0.2).unwrap();
        let mut bodies = document.bodies();
        bodies.0[1].roughness_m = 3e-7;
        document.set_bodies(bodies).unwrap();
        assert!((document.point.sliding.slide_to_roll_ratio - 0.2).abs() < 1e-12, "the sliding stays");
        assert_eq!(document.bodies().0.map(|body| body.roughness_m), [2e-7, 3e-7]);
    }

    #[test]
    fn oil_and_bodies_define_the_contact_and_stay() {
        let mut document = Document::default();
        document.set_oil(VG_68).unwrap();
        let bodies = Bodies::on_plane(0.012, 3.0, 0.05);
        document.set_bodies(bodies).unwrap();
        let point = document.point;
        assert!((point.radius_m - 0.012).abs() < 1e-15 && (point.speed_m_per_s - 3.0).abs() < 1e-12);
        assert!((point.sliding.slide_to_roll_ratio - 0.05).abs() < 1e-12);
        assert!(document.oil_counts() && document.bodies_in_force() == Some(bodies));
        let moes = point.moes();
        document.set_moes(Moes { m: 1.5 * moes.m, ..moes }).unwrap();
        assert_eq!(OperatingPoint { load: point.load, ..document.point }, point, "only the load follows");
        assert!((document.point.load / point.load - 1.5).abs() < 1e-9);
        assert!(document.set_moes(Moes { l: 1.1 * moes.l, ..moes }).unwrap_err().contains("held"));
        // Saving and opening again loses nothing.
        let again = Document::from_ron(&document.to_ron().unwrap()).unwrap();
        assert_eq!((&again.view, again.point), (&document.view, document.point));
        // A value typed over the oil's values no longer belongs to the oil.
        document.type_quantity(Quantity::Alpha, 2e-8).unwrap();
        assert!(!document.oil_counts() && document.view.oil == Some(VG_68));
    }

    #[test]
    fn a_glass_disc_is_the_same_body_at_the_same_speed_with_heat() {
        let Bodies([first, second]) = Bodies::on_plane(0.0127, 0.74, 0.4);
        let glass = first.of(Material::GLASS);
        let pair = Bodies([glass, second]);
        assert!(glass.speed_m_per_s < second.speed_m_per_s);
        // Set the bodies first, or switch heat on first.
        let (mut document, mut other) = (Document::default(), Document::default());
        document.set_bodies(pair).unwrap();
        document.switch_heat(true).unwrap();
        other.switch_heat(true).unwrap();
        other.set_bodies(pair).unwrap();
        assert_eq!((document.key(), document.bodies_in_force()), (other.key(), Some(pair)));
        let heat = Problem::new(&document.point, document.lubricant).unwrap().heat.unwrap();
        for (body, (speed, thermal)) in pair.0.iter().zip(heat.speeds.iter().zip(heat.heat.bodies)) {
            assert!((speed * document.point.speed_m_per_s / body.speed_m_per_s - 1.0).abs() < 1e-12);
            assert_eq!(thermal, body.heat);
        }
        // A material chosen next to Heat applies to the body, as long as the contact has the values of the bodies.
        document.set_material(1, Material::GLASS).unwrap();
        assert_eq!(document.bodies_in_force(), Some(Bodies([glass, second.of(Material::GLASS)])));
        document.type_quantity(Quantity::Modulus, 123e9).unwrap();
        document.set_material(1, Material::STEEL).unwrap();
        assert_eq!(document.lubricant.heat.map(|heat| heat.bodies), Some(pair.heat()));
        assert!(document.point.modulus_pa == 123e9 && document.bodies_in_force().is_none());
    }

    #[test]
    fn ball_in_a_groove_is_an_ellipse() {
        let mut document = Document::default();
        document.set_shape(Shape::Ball).unwrap();
        let Bodies([ball, race]) = Bodies::on_plane(4.7625e-3, 3.0, 0.0);
        let race = Body { radius_m: Some(18.2375e-3), ..race };
        let pair = |groove_m: f64| Bodies([ball, race.with_transverse_radius_m(Some(groove_m))]);
        document.set_bodies(pair(-4.953e-3)).unwrap();
        assert!((document.point.radius_ratio() - 32.8).abs() < 0.1, "{}", document.point.radius_ratio());
        assert!(document.bodies_in_force().is_some() && document.holds(Quantity::RadiusY));
        let said = document.set_bodies(pair(-4.5e-3)).unwrap_err();
        assert!(said.contains("across the rolling direction") && said.contains("beyond -0.0047625 m"), "{said}");
        let said = document.set_bodies(pair(-4.763e-3)).unwrap_err();
        assert!(said.contains("R_y/R_x"), "{said}");
        document.set_shape(Shape::Roller).unwrap();
        document.set_bodies(pair(-4.953e-3)).unwrap();
        assert_eq!(document.point.radius_y_m, None);
    }

    #[test]
    fn what_is_refused_leaves_the_document_as_it_was() {
        let mut document = Document::default();
        let before = document.clone();
        assert!(document.set_oil(Oil { grade: Grade::IsoVg(33.0), ..VG_68 }).unwrap_err().contains("no ISO"));
        let Bodies([first, second]) = Bodies::on_plane(0.012, 3.0, 0.05);
        let backwards = Bodies([Body { speed_m_per_s: -9.0, ..first }, second]);
        assert!(document.set_bodies(backwards).unwrap_err().contains("carry no oil"));
        assert_eq!(document, before);
    }
}
