//! Tabs of a window, each as one object.

use super::view::View;
use crate::app::tab::Tab;
use crate::app::tabs::every_tab;

macro_rules! objects {
    ($($(#[$what:meta])* $tab:ident $title:literal $field:ident: $module:ident::$type:ident,)*) => {
        /// All tabs with their state.
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
    /// Receives results of the jobs of all tabs since the last frame.
    pub fn receive(&mut self) {
        Tab::ALL.iter().for_each(|tab| self.of_mut(*tab).receive());
    }

    /// Stops the jobs of all tabs and keeps their results so far.
    pub fn stop(&mut self) {
        Tab::ALL.iter().for_each(|tab| self.of_mut(*tab).stop());
    }

    /// Returns the settings of each tab as text, for the session.
    pub fn kept(&self) -> Vec<(Tab, String)> {
        Tab::ALL.iter().filter_map(|tab| Some((*tab, self.of(*tab).kept()?))).collect()
    }

    /// Restores the settings of the tabs. Returns false if a text is invalid; its tab is then unchanged.
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
