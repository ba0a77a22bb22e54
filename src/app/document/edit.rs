//! List of all changes of the document, and the function that makes them.

use super::experiment::Document;
use super::shape::Shape;
use crate::app::refusal::Refusal;
use crate::scene::named_lubricant::NamedLubricant;
use crate::scene::{LoadFollower, LubricantFollower, TransientStudy, View};
use crate::solver::discrete::grid::PointGridSpec;
use crate::solver::parameters::Quantity;
use crate::solver::physics::bodies::{Bodies, Material};
use crate::solver::physics::contact::{Moes, OperatingPoint};
use crate::solver::physics::engineering::Oil;
use crate::solver::physics::lubricant::Lubricant;
use crate::solver::physics::machines::Machine;
use crate::solver::training::TrainingSpec;

/// Change of the document.
#[derive(Clone, Debug, PartialEq)]
pub enum Edit {
    /// Sets M and L.
    Moes(Moes),
    Quantity(Quantity, f64),
    /// Sets a quantity that the user typed in SI units, and holds it.
    Typed(Quantity, f64),
    /// Sets whether a quantity is held.
    Hold(Quantity, bool),
    /// Sets the oil that determines η₀ and α. With `None` they keep their values.
    Oil(Option<Oil>),
    /// Sets the length of a line contact \[m\].
    Length(Option<f64>),
    /// Sets the bodies that determine R, E′, u_m and SRR.
    Bodies(Bodies),
    /// Sets the rms roughness of body 1 and body 2 \[m\].
    Surfaces([f64; 2]),
    /// Sets whether asperities carry load.
    Mixed(bool),
    /// Sets bodies, speeds and load of a bearing, a gear pair or a cam.
    Machine(Box<Machine>),
    /// Sets whether temperatures are computed.
    Heat(bool),
    /// Sets the material of a body, 0 or 1.
    Material(usize, Material),
    /// Sets the shape: roller, ball or ellipse.
    Shape(Shape),
    /// Sets laws and constants of the lubricant.
    Laws(Box<Lubricant>),
    /// Selects a named lubricant.
    Named(&'static NamedLubricant),
    /// Sets another contact with another fluid.
    Contact(OperatingPoint, Box<Lubricant>),
    /// Sets the quantity that follows M. Also changes the quantity that follows L if the two are incompatible.
    LoadFollower(LoadFollower),
    /// Sets the quantity that follows L.
    LubricantFollower(LubricantFollower),
    /// Sets the view: the truncation of the reduced model and further settings.
    View(Box<View>),
    /// Sets the grid of full solutions of a point contact.
    Plane(PointGridSpec),
    /// Sets the training.
    Training(Box<TrainingSpec>),
    /// Sets the transient contact.
    Transient(Box<TransientStudy>),
}

impl Document {
    /// Makes a change.
    ///
    /// # Errors
    /// A sentence if the change is refused. The document is then unchanged.
    pub fn edit(&mut self, edit: Edit) -> Result<(), Refusal> {
        match edit {
            Edit::Moes(moes) => return self.set_moes(moes),
            Edit::Quantity(quantity, value) => return self.set_quantity(quantity, value),
            Edit::Typed(quantity, value) => return self.type_quantity(quantity, value),
            Edit::Hold(quantity, held) => self.view.held.set(quantity, held),
            Edit::Oil(Some(oil)) => return self.set_oil(oil),
            Edit::Oil(None) => self.view.oil = None,
            Edit::Length(length_m) => self.length_m = length_m,
            Edit::Bodies(bodies) => return self.set_bodies(bodies),
            Edit::Surfaces(rms_m) => return self.set_surfaces(rms_m),
            Edit::Mixed(on) => return self.switch_mixed(on),
            Edit::Machine(machine) => return self.set_machine(*machine),
            Edit::Heat(on) => return self.switch_heat(on),
            Edit::Material(body, material) => return self.set_material(body, material),
            Edit::Shape(shape) => return self.set_shape(shape),
            Edit::Laws(laws) => return self.set_laws(*laws),
            Edit::Named(named) => return self.pick_lubricant(named),
            Edit::Contact(point, lubricant) => return self.set_contact(point, *lubricant),
            Edit::Training(spec) => return self.set_training(*spec),
            Edit::Transient(study) => return self.set_transient(*study),
            Edit::LoadFollower(follower) => self.set_load_follower(follower),
            Edit::LubricantFollower(follower) => {
                // If the lubricant fixes α, the quantity that follows M is chosen as well.
                self.view.when_m_moves = self.followers().0;
                self.view.when_l_moves = follower;
            }
            Edit::View(view) => self.view = *view,
            Edit::Plane(spec) => self.set_plane(spec),
        }
        Ok(())
    }
}
