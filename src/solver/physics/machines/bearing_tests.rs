use super::*;
use crate::solver::physics::bodies::Bodies;
use crate::solver::physics::contact::OperatingPoint;

/// E′ of steel \[Pa\], E 207 GPa and ν 0.3.
const STEEL: f64 = 207e9 / 0.91;

fn close(a: f64, b: f64, relative: f64, what: &str) {
    assert!((a / b - 1.0).abs() < relative, "{what}: {a} against {b}");
}

/// Deep-groove ball bearing 209 of Harris, and of Hamrock and Dowson.
const HARRIS_209: Bearing = Bearing {
    element: Element::BALL,
    pitch_diameter_m: 0.065,
    element_diameter_m: 0.0127,
    elements: 9,
    clearance_m: 0.0,
    inner_rpm: 3_819.718_634,
    outer_rpm: 0.0,
    radial_n: 8900.0,
    axial_n: 0.0,
    race: Race::Inner,
    orbit_deg: 0.0,
};

fn radii(contact: &MachineContact) -> [f64; 2] {
    let [first, second] = contact.surfaces;
    [1.0 / (first.along + second.along), 1.0 / (first.across + second.across)]
}

#[test]
fn bearing_209_has_the_published_radii_and_speed() {
    // Hamrock and Dowson's example (from memory): d_i 52.291 mm, d_o 77.706 mm, 9 balls of 12.7 mm, f 0.52, 400 rad/s:
    // R_x 5.11 mm and 7.59 mm, R_y 165 mm, u 6.252 m/s.
    let inner = HARRIS_209.contact(STEEL).unwrap();
    let outer = Bearing { race: Race::Outer, ..HARRIS_209 }.contact(STEEL).unwrap();
    for (contact, radius) in [(inner, 5.11e-3), (outer, 7.59e-3)] {
        let [along, across] = radii(&contact);
        close(along, radius, 5e-3, "R_x");
        close(across, 0.1651, 5e-3, "R_y");
        close(contact.mean_speed(), 6.252, 1e-3, "u");
    }
    // Harris, example 2.4 (from memory): curvature sums 0.202 and 0.138 1/mm.
    for (contact, sum) in [(inner, 202.0), (outer, 138.0)] {
        let [along, across] = radii(&contact);
        close(along.recip() + across.recip(), sum, 5e-3, "Σρ");
    }
}

#[test]
fn bearing_6206_by_its_true_geometry() {
    let inner = Bearing::default().contact(STEEL).unwrap();
    let [along, across] = radii(&inner);
    // A race of 36.475 mm: R_x = 4.7625 (1 − 9.525/46), R_y = 13 · 9.525 mm.
    close(along, 3.7764e-3, 1e-4, "R_x");
    close(across, 123.825e-3, 1e-6, "R_y");
    close(inner.surfaces[1].along.recip(), 0.5 * 36.475e-3, 1e-12, "radius of the race");
}

#[test]
fn elements_and_rings_move_alike_seen_from_the_cage() {
    for (inner_rpm, outer_rpm) in [(1500.0, 0.0), (0.0, 1500.0), (3000.0, -2000.0)] {
        let bearing = Bearing { inner_rpm, outer_rpm, ..HARRIS_209 };
        let state = bearing.state(STEEL).unwrap();
        for (race, rpm, sign) in [(Race::Inner, inner_rpm, -1.0), (Race::Outer, outer_rpm, 1.0)] {
            let radius = 0.5 * (bearing.pitch_diameter_m + sign * bearing.element_diameter_m);
            let surface = radius * (rpm * TAU / 60.0 - state.cage_speed).abs();
            let contact = Bearing { race, ..bearing }.contact(STEEL).unwrap();
            close(contact.mean_speed(), surface, 1e-12, "speed");
        }
    }
}

/// Sjövall's radial integral J_r(ε), by Simpson's rule.
fn sjoevall(epsilon: f64, exponent: f64) -> f64 {
    let half = (1.0 - 2.0 * epsilon).clamp(-1.0, 1.0).acos();
    let steps = 20_000;
    let f = |k: usize| {
        let angle = half * k as f64 / steps as f64;
        (1.0 - (1.0 - angle.cos()) / (2.0 * epsilon)).max(0.0).powf(exponent) * angle.cos()
    };
    let sum: f64 = (1..steps).map(|k| f(k) * if k % 2 == 1 { 4.0 } else { 2.0 }).sum();
    (f(0) + f(steps) + sum) * half / steps as f64 / 3.0 / PI
}

#[test]
fn the_largest_load_follows_sjoevalls_integral() {
    // NSK, Technical Report E728g, section 5.1: Q_max = 4.37 F_r/(Z cos α) for balls, 4.08 for rollers, at ε = ½.
    close(1.0 / sjoevall(0.5, 1.5), 4.37, 2e-3, "balls");
    close(1.0 / sjoevall(0.5, 10.0 / 9.0), 4.08, 2e-3, "rollers");
    // Many elements, so that sums are integrals.
    let roller = Bearing { element: Element::ROLLER, element_diameter_m: 1e-3, elements: 150, ..HARRIS_209 };
    let ball = Bearing { element: Element::BALL, ..roller };
    for (bearing, exponent) in [(roller, 10.0 / 9.0), (ball, 1.5)] {
        for clearance_m in [-4e-6, 0.0, 4e-6, 12e-6] {
            let bearing = Bearing { clearance_m, radial_n: 500.0, ..bearing };
            let state = bearing.state(STEEL).unwrap();
            let epsilon = 0.5 * (1.0 - 0.5 * clearance_m / state.radial_displacement_m);
            let expected = bearing.radial_n / (f64::from(bearing.elements) * sjoevall(epsilon, exponent));
            close(state.largest_load_n, expected, 2e-3, "Q_max");
            if clearance_m >= 0.0 {
                close(state.loaded_zone, (1.0 - 2.0 * epsilon).acos(), 2e-3, "loaded zone");
            }
        }
    }
}

#[test]
fn normal_clearance_gives_stribecks_five() {
    let bearing = Bearing { clearance_m: 15e-6, ..HARRIS_209 };
    let number = bearing.state(STEEL).unwrap().largest_load_n * 9.0 / bearing.radial_n;
    assert!((4.37..5.0).contains(&number), "{number}");
    // Harris, example 7.1 (from memory): 209 with 0.015 mm and 8900 N has Q_max 4536 N.
    close(bearing.state(STEEL).unwrap().largest_load_n, 4536.0, 5e-3, "Q_max");
}

#[test]
fn the_elements_carry_the_loads() {
    for (contact_angle_deg, clearance_m, radial_n, axial_n) in
        [(0.0, 1e-5, 5000.0, 0.0), (0.0, 1e-5, 3000.0, 2000.0), (25.0, 0.0, 4000.0, 3000.0), (40.0, 0.0, 0.0, 1000.0)]
    {
        let element = Element::Ball { inner_conformity: 0.52, outer_conformity: 0.53, contact_angle_deg };
        let bearing = Bearing { element, clearance_m, radial_n, axial_n, ..HARRIS_209 };
        let state = bearing.state(STEEL).unwrap();
        let (mut radial, mut axial) = (0.0, 0.0);
        for k in 0..9 {
            let orbit = TAU * f64::from(k) / 9.0;
            let (load, angle) = state.element(orbit);
            radial += load * angle.cos() * orbit.cos();
            axial += load * angle.sin();
        }
        let size = radial_n.hypot(axial_n);
        assert!((radial - radial_n).abs() < 1e-8 * size && (axial - axial_n).abs() < 1e-8 * size, "{radial} {axial}");
    }
}

#[test]
fn a_thrust_load_raises_the_contact_angle_as_published() {
    // Harris, 218 angular-contact bearing under 17 800 N of thrust (from memory): 40° become 41.6°, δ_a 0.0386 mm.
    let element = Element::Ball { inner_conformity: 0.5232, outer_conformity: 0.5232, contact_angle_deg: 40.0 };
    let bearing = Bearing {
        element,
        pitch_diameter_m: 0.12526,
        element_diameter_m: 0.022_225,
        elements: 16,
        radial_n: 0.0,
        axial_n: 17_800.0,
        ..HARRIS_209
    };
    let state = bearing.state(STEEL).unwrap();
    close(state.contact_angle.to_degrees(), 41.6, 5e-3, "contact angle");
    close(state.largest_load_n, 17_800.0 / (16.0 * state.contact_angle.sin()), 1e-9, "load");
    assert!(state.loaded_zone == PI);
    // The free angle that a clearance leaves: Harris, example 2.1 (from memory), 209 with 0.015 mm: 9°52′.
    let light = Bearing { clearance_m: 15e-6, radial_n: 0.0, axial_n: 1e-3, ..HARRIS_209 }.state(STEEL).unwrap();
    close(light.contact_angle.to_degrees(), 9.0 + 52.0 / 60.0, 5e-3, "free contact angle");
}

#[test]
fn a_cylindrical_roller_bearing_has_the_published_contact() {
    // Hamrock and Dowson's roller bearing (from memory): d_i 64 mm, d_o 96 mm, 9 rollers of 16 mm, 524 rad/s, 10.8 kN:
    // R_x 6.4 mm and 9.6 mm, u 10.061 m/s.
    let bearing = Bearing {
        element: Element::Roller { length_m: 0.016, crown_radius_m: None },
        pitch_diameter_m: 0.08,
        element_diameter_m: 0.016,
        inner_rpm: 524.0 * 60.0 / TAU,
        radial_n: 10_800.0,
        ..HARRIS_209
    };
    for (race, radius) in [(Race::Inner, 6.4e-3), (Race::Outer, 9.6e-3)] {
        let contact = Bearing { race, ..bearing }.contact(STEEL).unwrap();
        close(contact.radius_m(), radius, 1e-12, "R");
        close(contact.mean_speed(), 10.061, 5e-4, "u");
        // Largest load 4.08 F_r/Z, spread over the length.
        close(contact.load * 0.016, 4.08 * 10_800.0 / 9.0, 0.02, "Q");
    }
    let crowned = Element::Roller { length_m: 0.016, crown_radius_m: Some(1.5) };
    let contact = Bearing { element: crowned, ..bearing }.contact(STEEL).unwrap();
    assert!(contact.kind == ContactKind::Point && (radii(&contact)[1] - 1.5).abs() < 1e-12);
}

#[test]
fn the_path_is_heaviest_amid_the_loaded_zone() {
    let bearing = Bearing::default();
    let path = bearing.path(STEEL, 41).unwrap();
    let heaviest = path.iter().map(|contact| contact.load).fold(0.0, f64::max);
    assert_eq!(heaviest, path[20].load);
    close(path[0].load, 0.05 * heaviest, 1e-6, "load at the edge");
    let cage = bearing.state(STEEL).unwrap().cage_speed;
    close(path[40].time_s - path[0].time_s, (path[40].position - path[0].position) / cage, 1e-12, "time");
    let point = path[20].operating_point(Bodies::on_plane(0.01, 1.0, 0.0), OperatingPoint::TABLE_2_1).unwrap();
    point.check().unwrap();
    assert!((1.0e9..3.0e9).contains(&point.hertz().pressure_pa), "{}", point.hertz().pressure_pa);
}

#[test]
fn bearings_that_do_not_exist_are_refused() {
    let of = |change: fn(&mut Bearing)| {
        let mut bearing = Bearing::default();
        change(&mut bearing);
        bearing.contact(STEEL).unwrap_err().to_string()
    };
    let said = |text: String, words: &str| assert!(text.contains(words), "{text}");
    said(of(|b| b.elements = 16), "at most 15 do");
    said(of(|b| b.pitch_diameter_m = f64::NAN), "the pitch diameter is NaN mm, but must be between 1 mm");
    said(of(|b| b.inner_rpm = 0.0), "nothing rolls");
    said(of(|b| b.radial_n = 0.0), "carries no load");
    said(of(|b| b.radial_n = f64::INFINITY), "radial load");
    said(of(|b| b.orbit_deg = 120.0), "the loaded zone is ±");
    said(of(|b| b.clearance_m = 1e-3), "the clearance is 1 mm");
    said(
        of(|b| b.element = Element::Ball { inner_conformity: 0.5, outer_conformity: 0.52, contact_angle_deg: 0.0 }),
        "inner ring is 0.5",
    );
    said(
        of(|b| b.element = Element::Ball { inner_conformity: 0.52, outer_conformity: 0.52, contact_angle_deg: 30.0 }),
        "loses its contact angle",
    );
    said(of(|b| (b.element, b.axial_n) = (Element::ROLLER, 10.0)), "carries no axial load");
    let still = Bearing { inner_rpm: 1000.0, outer_rpm: -1000.0, element: Element::ROLLER, ..Bearing::default() };
    let ratio = still.element_diameter_m / still.pitch_diameter_m;
    let outer_rpm = -1000.0 * (1.0 - ratio) / (1.0 + ratio);
    said(Bearing { outer_rpm, ..still }.path(STEEL, 10).unwrap_err().to_string(), "cage stands still");
}
