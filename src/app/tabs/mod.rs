//! Tabs of the window. Each tab shows one view of the contact. It owns its state, reads the document and the
//! answers, and changes everything else by commands. No tab uses another one.

pub mod accuracy;
pub mod all;
pub mod basis;
pub mod contact_map;
pub mod frame;
mod offer;
pub mod profiles;
pub mod regimes;
pub mod results;
#[cfg(test)]
mod tests;
pub mod traction;
pub mod training;
pub mod transient;
mod view;

pub use offer::Offer;
pub use view::{About, View};

/// Lists every tab in the order of the window: identity, title, field and type of its object.
macro_rules! every_tab {
    ($with:ident) => {
        $with! {
            /// Pressure and film thickness.
            Profiles "Profiles" profiles: profiles::Profiles,
            /// Film thickness, pressure and interferogram of a point contact.
            ContactMap "Contact map" contact_map: contact_map::ContactMap,
            /// The M–L chart.
            Regimes "Regimes" regimes: regimes::Regimes,
            /// Traction along one quantity.
            Traction "Traction" traction: traction::Traction,
            /// Singular values, modes, sampled equations.
            Basis "Reduced basis" basis: basis::Basis,
            /// Residuals and errors.
            Accuracy "Accuracy" accuracy: accuracy::Accuracy,
            /// Training a reduced model.
            Training "Training" training: training::TrainingTab,
            /// The transient contact.
            Transient "Transient" transient: transient::Transient,
            /// The linearised model of the transient contact.
            Tpwl "TPWL" tpwl: transient::Tpwl,
            /// The study of the open scene.
            Results "Results" results: results::Results,
        }
    };
}

pub(crate) use every_tab;
