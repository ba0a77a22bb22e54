//! The tabs of a window, each an object.

use super::view::View;
use crate::app::tab::Tab;
use crate::app::tabs::every_tab;

macro_rules! objects {
    ($($(#[$what:meta])* $tab:ident $title:literal $field:ident: $module:ident::$type:ident,)*) => {
        /// All tabs with what they keep.
        #[derive(Default)]
        pub struct Tabs {
            $($(#[$what])* pub $field: super::$module::$type,)*
        }

        impl Tabs {
            /// Returns the object of a tab.
            pub fn of(&self, tab: Tab) -> &dyn View {
                match tab {
                    $(Tab::$tab => &self.$field,)*
                }
            }

            /// Returns the object of a tab, to be changed.
            pub fn of_mut(&mut self, tab: Tab) -> &mut dyn View {
                match tab {
                    $(Tab::$tab => &mut self.$field,)*
                }
            }
        }
    };
}

every_tab!(objects);

impl Tabs {
    /// Receives what the jobs of all tabs have found since the last frame.
    pub fn receive(&mut self) {
        Tab::ALL.iter().for_each(|tab| self.of_mut(*tab).receive());
    }

    /// Stops the jobs of all tabs; what they have found stays.
    pub fn stop(&mut self) {
        Tab::ALL.iter().for_each(|tab| self.of_mut(*tab).stop());
    }

    /// Returns what the session keeps of each tab, as text.
    pub fn kept(&self) -> Vec<(Tab, String)> {
        Tab::ALL.iter().filter_map(|tab| Some((*tab, self.of(*tab).kept()?))).collect()
    }

    /// Takes over what a session kept; returns false if a text makes no sense. Its tab is then unchanged.
    pub fn restore(&mut self, kept: &[(Tab, String)]) -> bool {
        kept.iter().fold(true, |sound, (tab, text)| self.of_mut(*tab).restore(text) && sound)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_tab_says_why_in_three_sentences() {
        let tabs = Tabs::default();
        for tab in Tab::ALL {
            let why = tabs.of(*tab).about().why;
            assert!(why.ends_with('.') && why.matches(". ").count() == 2, "{tab:?}");
        }
    }
}
