//! Identities of the tabs.

use crate::app::tabs::every_tab;
use serde::{Deserialize, Serialize};

macro_rules! identities {
    ($($(#[$what:meta])* $tab:ident $title:literal $field:ident: $module:ident::$type:ident,)*) => {
        /// Tab of the window.
        #[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
        pub enum Tab {
            $($(#[$what])* $tab,)*
        }

        impl Tab {
            /// All tabs in their order.
            pub const ALL: &[Self] = &[$(Self::$tab,)*];

            pub fn title(self) -> &'static str {
                match self {
                    $(Self::$tab => $title,)*
                }
            }
        }
    };
}

every_tab!(identities);
