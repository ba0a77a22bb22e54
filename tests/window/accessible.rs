//! Names for screen readers, and the order of the Tab key.

use crate::driver::{CONTROLS, TABS, Window, click, press, wait};
use egui::accesskit::Role;
use egui::ecolor::Rgba;
use egui::epaint::{ClippedShape, TextShape};
use egui::{Color32, Key, Modifiers, Pos2, Rect, Shape, Theme};
use egui_kittest::kittest::{NodeT as _, Queryable as _};
use ehl_explorer::app::Explorer;

/// Largest distance between the middles of two controls in the same visual row.
const ROW: f32 = 8.0;

fn open(height: f32) -> Window {
    let explorer = Explorer::with_embedded_models().without_system_dialogs();
    let mut harness = crate::driver::window(explorer, [1280.0, height]);
    wait(&mut harness, "the picture", |app| app.central_film().is_some());
    harness
}

/// Returns controls without a name, or without the value that their kind has.
fn nameless(harness: &Window) -> Vec<String> {
    let mut faults = Vec::new();
    for role in CONTROLS {
        for node in harness.query_all_by_role(role) {
            let told = node.accesskit_node();
            let name = told.label().unwrap_or_default();
            let value = match role {
                Role::Slider | Role::SpinButton => told.numeric_value().is_some() || told.value().is_some(),
                Role::ComboBox | Role::TextInput => told.value().is_some(),
                Role::CheckBox | Role::RadioButton => told.toggled().is_some(),
                _ => true,
            };
            if name.trim().is_empty() || !value {
                faults.push(format!("{role:?} “{name}” at {:?} ({:?})", node.rect(), told.value()));
            }
        }
    }
    faults
}

#[test]
fn every_control_of_every_tab_has_a_name_and_its_value() {
    let mut harness = open(1400.0);
    let mut faults = Vec::new();
    for kind in ["Roller", "Ball", "Ellipse"] {
        harness.query_all_by_label(kind).next().unwrap().click();
        harness.run_steps(3);
        for tab in TABS {
            click(&mut harness, tab);
            harness.run_steps(2);
            faults.extend(nameless(&harness).into_iter().map(|fault| format!("{kind}, {tab}: {fault}")));
        }
    }
    assert!(faults.is_empty(), "{}", faults.join("\n"));
}

/// Returns the controls that the Tab key visits in one cycle.
fn round(harness: &mut Window) -> Vec<(String, Rect)> {
    let mut places: Vec<(String, Rect)> = Vec::new();
    for _ in 0..120 {
        press(harness, Modifiers::NONE, Key::Tab);
        let focused = CONTROLS.into_iter().flat_map(|role| harness.query_all_by_role(role));
        let Some(node) = focused.into_iter().find(|node| node.accesskit_node().is_focused()) else { continue };
        let place = (node.accesskit_node().label().unwrap_or_default(), node.rect());
        // The focus may stay for one press while a control appears or disappears.
        if places.len() > 1 && places.first() == Some(&place) {
            break;
        }
        if places.last() != Some(&place) {
            places.push(place);
        }
    }
    places
}

#[test]
fn tab_key_goes_down_the_panel_and_along_rows() {
    let mut harness = open(1400.0);
    harness.run_steps(3);
    let places = round(&mut harness);
    let edge = 330.0;
    let panel: Vec<&(String, Rect)> =
        places.iter().filter(|(_, rect)| rect.right() < edge && rect.top() > 30.0 && rect.bottom() < 1370.0).collect();
    assert!(panel.len() > 15, "{panel:?}");
    for pair in panel.windows(2) {
        let ((before, a), (after, b)) = (pair[0], pair[1]);
        let down = b.center().y - a.center().y;
        let follows = down > ROW || down.abs() <= ROW && b.left() > a.left();
        assert!(follows, "{after} at {b:?} comes after {before} at {a:?}");
    }
}

/// Returns the contrast of two opaque colours as defined by WCAG 2.2.
fn contrast(a: Color32, b: Color32) -> f32 {
    let luminance = |color: Color32| {
        let [r, g, b, _] = Rgba::from(color).to_array();
        0.2126 * r + 0.7152 * g + 0.0722 * b + 0.05
    };
    let (a, b) = (luminance(a), luminance(b));
    a.max(b) / a.min(b)
}

/// Fills of a frame in their order; `None` for pictures, whose colours are not available.
type Fills = Vec<(Rect, Option<Color32>)>;

/// Visits shapes in the order in which they are painted, and calls `text` with the fills below each text.
fn painted(clip: Rect, shape: &Shape, fills: &mut Fills, text: &mut dyn FnMut(&TextShape, Pos2, &Fills)) {
    match shape {
        Shape::Vec(shapes) => shapes.iter().for_each(|shape| painted(clip, shape, fills, text)),
        Shape::Rect(rect) if rect.fill.a() > 0 => fills.push((rect.rect.intersect(clip), Some(rect.fill))),
        Shape::Mesh(mesh) => fills.push((mesh.calc_bounds().intersect(clip), None)),
        Shape::Text(shape) => {
            let at = shape.visual_bounding_rect().center();
            if clip.contains(at) {
                text(shape, at, fills);
            }
        }
        _ => {}
    }
}

/// Returns the colours of a text, without letters that draw nothing.
fn inks(shape: &TextShape) -> Vec<Color32> {
    let of = |format: &egui::TextFormat| match (shape.override_text_color, format.color) {
        (Some(color), _) => color,
        (None, Color32::PLACEHOLDER) => shape.fallback_color,
        (None, color) => color,
    };
    let sections = &shape.galley.job.sections;
    let said = |section: &&egui::text::LayoutSection| {
        let range = section.byte_range.start.0..section.byte_range.end.0;
        shape.galley.text().get(range).is_some_and(|text| !text.trim().is_empty())
    };
    sections.iter().filter(said).map(|section| of(&section.format).gamma_multiply(shape.opacity_factor)).collect()
}

/// Returns texts of a frame with too little contrast to their background. Disabled controls are excluded, since they
/// are meant to be faint.
fn faint(harness: &Window, ground: Color32, checked: &mut usize) -> Vec<String> {
    let roles = CONTROLS.into_iter().chain([Role::Label]);
    let disabled: Vec<Rect> = roles
        .flat_map(|role| harness.query_all_by_role(role).collect::<Vec<_>>())
        .filter(|node| node.accesskit_node().is_disabled())
        .map(|node| node.rect())
        .collect();
    let (mut fills, mut faults) = (Fills::new(), Vec::new());
    for ClippedShape { clip_rect, shape, .. } in &harness.output().shapes {
        painted(*clip_rect, shape, &mut fills, &mut |text, at, fills| {
            if disabled.iter().any(|rect| rect.contains(at)) {
                return;
            }
            let there: Vec<Option<Color32>> =
                fills.iter().filter(|(rect, _)| rect.contains(at)).map(|(_, fill)| *fill).collect();
            let covers = |fill: &Option<Color32>| fill.is_some_and(|fill| fill.is_opaque());
            let seen = there.iter().skip(there.iter().rposition(covers).unwrap_or(0));
            let under = seen.copied().try_fold(ground, |under, fill| Some(under.blend(fill?)));
            let Some(under) = under else { return };
            for ink in inks(text) {
                *checked += 1;
                let reached = contrast(under.blend(ink), under);
                if reached < 4.5 {
                    faults.push(format!("“{}” at {at:?}: {ink:?} on {under:?}, {reached:.2}", text.galley.text()));
                }
            }
        });
    }
    faults
}

#[test]
fn every_text_of_every_tab_can_be_read_in_both_themes() {
    let mut harness = open(800.0);
    let (mut faults, mut checked) = (Vec::new(), 0);
    for kind in ["Roller", "Ball", "Ellipse"] {
        harness.query_all_by_label(kind).next().unwrap().click();
        harness.run_steps(3);
        for tab in TABS {
            click(&mut harness, tab);
            wait(&mut harness, "the picture", |app| app.central_film().is_some() && !app.marching());
            for theme in [Theme::Dark, Theme::Light] {
                harness.ctx.set_theme(theme);
                harness.run_steps(3);
                let ground = harness.ctx.style_of(theme).visuals.panel_fill;
                let found = faint(&harness, ground, &mut checked);
                faults.extend(found.into_iter().map(|fault| format!("{theme:?}, {kind}, {tab}: {fault}")));
            }
        }
    }
    println!("{checked} texts");
    assert!(checked > 3000, "{checked}");
    assert!(faults.is_empty(), "{}", faults.join("\n"));
}
