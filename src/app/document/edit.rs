//! Every change of the document that can be asked for, and the one place where it is made.

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
use crate::solver::training::TrainingSpec;

/// A change of the document.
#[derive(Clone, Debug, PartialEq)]
pub enum Edit {
    /// M and L.
    Moes(Moes),
    Quantity(Quantity, f64),
    /// One quantity that was typed in SI units and stays.
    Typed(Quantity, f64),
    /// Whether a quantity is held.
    Hold(Quantity, bool),
    /// The oil that η₀ and α are of; with none they stay as they are.
    Oil(Option<Oil>),
    /// The bodies that R, E′, u_m and SRR are of.
    Bodies(Bodies),
    /// Whether temperatures are computed.
    Heat(bool),
    /// The material of a body, 0 or 1.
    Material(usize, Material),
    /// Roller, ball or ellipse.
    Shape(Shape),
    /// Laws and constants of the lubricant.
    Laws(Box<Lubricant>),
    /// A named lubricant.
    Named(&'static NamedLubricant),
    /// Another contact of another fluid.
    Contact(OperatingPoint, Box<Lubricant>),
    /// What follows M; what follows L changes along where both cannot be had together.
    LoadFollower(LoadFollower),
    /// What follows L.
    LubricantFollower(LubricantFollower),
    /// The truncation of the reduced model, and what else its view holds.
    View(Box<View>),
    /// The grid of a point contact's full solutions.
    Plane(PointGridSpec),
    /// The training it describes.
    Training(Box<TrainingSpec>),
    /// The contact in time it describes.
    Transient(Box<TransientStudy>),
}

impl Document {
    /// Makes a change.
    ///
    /// # Errors
    /// A sentence when it is refused; the document is unchanged then.
    pub fn edit(&mut self, edit: Edit) -> Result<(), Refusal> {
        match edit {
            Edit::Moes(moes) => return self.set_moes(moes),
            Edit::Quantity(quantity, value) => return self.set_quantity(quantity, value),
            Edit::Typed(quantity, value) => return self.type_quantity(quantity, value),
            Edit::Hold(quantity, held) => self.view.held.set(quantity, held),
            Edit::Oil(Some(oil)) => return self.set_oil(oil),
            Edit::Oil(None) => self.view.oil = None,
            Edit::Bodies(bodies) => return self.set_bodies(bodies),
            Edit::Heat(on) => return self.switch_heat(on),
            Edit::Material(body, material) => return self.set_material(body, material),
            Edit::Shape(shape) => return self.set_shape(shape),
            Edit::Laws(laws) => return self.set_lubricant(*laws),
            Edit::Named(named) => return self.pick_lubricant(named),
            Edit::Contact(point, lubricant) => return self.set_contact(point, *lubricant),
            Edit::Training(spec) => return self.set_training(*spec),
            Edit::Transient(study) => return self.set_transient(*study),
            Edit::LoadFollower(follower) => self.set_load_follower(follower),
            Edit::LubricantFollower(follower) => {
                // Where the lubricant fixes α, what follows M is chosen along with it.
                self.view.when_m_moves = self.followers().0;
                self.view.when_l_moves = follower;
            }
            Edit::View(view) => self.view = *view,
            Edit::Plane(spec) => self.set_plane(spec),
        }
        Ok(())
    }
}
