//! A curve belongs to a contact. Where that is not the present one it is drawn grey: here it is decided, and noted for
//! everything that a frame draws.

use super::document::Key;
use egui::{Color32, Context, Id};

/// Something drawn: what it is called, the contact that it belongs to, and whether it is grey.
#[derive(Clone, Debug, PartialEq)]
pub struct Drawn {
    /// What it is.
    pub name: &'static str,
    /// The contact.
    pub of: Key,
    /// Whether it stands back because that is not the present one.
    pub grey: bool,
}

fn id() -> Id {
    Id::unique("drawn")
}

/// Forgets what the last frame drew.
pub fn begin(ctx: &Context) {
    ctx.data_mut(|data| data.get_temp_mut_or_default::<Vec<Drawn>>(id()).clear());
}

/// What this frame has drawn so far.
pub fn all(ctx: &Context) -> Vec<Drawn> {
    ctx.data_mut(|data| data.get_temp_mut_or_default::<Vec<Drawn>>(id()).clone())
}

/// Whether what belongs to a contact is to be grey while another one is present.
pub fn is_grey(ctx: &Context, name: &'static str, of: &Key, present: &Key) -> bool {
    let grey = of != present;
    ctx.data_mut(|data| data.get_temp_mut_or_default::<Vec<Drawn>>(id()).push(Drawn { name, of: *of, grey }));
    grey
}

/// What an image is multiplied with, grey or not.
pub fn tint(grey: bool) -> Color32 {
    if grey { Color32::from_gray(120) } else { Color32::WHITE }
}
