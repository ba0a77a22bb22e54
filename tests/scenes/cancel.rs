//! Time until a cancelled study returns, in processor time of one thread, so that other load on the machine does
//! not matter.

use crate::common::scene_files;
use crate::common::stop_after::assert_stops;
use ehl_explorer::engine::{Workbench, run_scene};

#[test]
fn cancelled_studies_return_within_a_tenth_of_a_second() {
    for (name, moments) in [
        ("random_test_embedded", &[20, 200, 700][..]),
        ("fig_3_14_line", &[20, 200]),
        ("fig_2_6_right", &[20, 300]),
        ("fig_4_17_quick", &[20, 300, 700]),
        ("convergence_table_3_4", &[100, 400]),
    ] {
        let scene = scene_files::read(name);
        assert_stops(name, "", moments, |observer| {
            let mut workbench = Workbench::new(scene_files::path(name).parent().unwrap());
            run_scene(&scene, &mut workbench, observer).is_err_and(|error| error.cancelled())
        });
    }
}
