//! Document as the fragment of an address. A link opens exactly this contact, its tabs and their arrangement.

mod address;
mod arrangement;
mod fragment;
mod window;

pub use address::Address;
pub use fragment::{Embed, Fragment};
pub use window::LinkWindow;
