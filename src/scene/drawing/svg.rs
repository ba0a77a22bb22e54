//! Writes drawings as SVG.

use super::words::LOWERED;
use super::{Drawing, Lettering, Mark, Pen, Pixels, Rgb, TextAnchor, encode};
use std::fmt::Write as _;

/// Escapes a text for XML.
pub fn escaped(text: &str) -> String {
    text.replace('&', "&amp;").replace('<', "&lt;").replace('>', "&gt;").replace('"', "&quot;")
}

fn hex([red, green, blue]: Rgb) -> String {
    format!("#{red:02x}{green:02x}{blue:02x}")
}

fn stroke(pen: &Pen) -> String {
    let mut text = format!("stroke=\"{}\" stroke-width=\"{:.2}\"", hex(pen.color), pen.width);
    // Writing to a string cannot fail.
    if pen.opacity < 1.0 {
        let _ = write!(text, " stroke-opacity=\"{:.3}\"", pen.opacity);
    }
    if !pen.dashes.is_empty() {
        let dashes: Vec<String> = pen.dashes.iter().map(f64::to_string).collect();
        let _ = write!(text, " stroke-dasharray=\"{}\"", dashes.join(" "));
    }
    text
}

impl Drawing {
    /// Returns the drawing as a complete SVG document, one element per line.
    pub fn to_svg(&self) -> String {
        let ([width, height], [wide, high]) = (self.size(), self.size_mm);
        let mut lines = vec![
            format!(
                "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{wide}mm\" height=\"{high}mm\" \
                 viewBox=\"0 0 {width:.2} {height:.2}\" font-family=\"Ubuntu, sans-serif\">"
            ),
            format!("<title>{}</title>", escaped(&self.title)),
            format!("<rect width=\"{width:.2}\" height=\"{height:.2}\" fill=\"{}\"/>", hex(self.ground)),
        ];
        let (mut clips, mut open) = (0, false);
        for mark in &self.marks {
            match mark {
                Mark::Within(rect) => {
                    if open {
                        lines.push("</g>".to_owned());
                    }
                    open = rect.is_some();
                    if let Some([x, y, w, h]) = rect {
                        clips += 1;
                        lines.push(format!(
                            "<clipPath id=\"c{clips}\"><rect x=\"{x:.2}\" y=\"{y:.2}\" width=\"{w:.2}\" \
                             height=\"{h:.2}\"/></clipPath><g clip-path=\"url(#c{clips})\">"
                        ));
                    }
                }
                _ => lines.push(element(mark)),
            }
        }
        if open {
            lines.push("</g>".to_owned());
        }
        lines.push("</svg>\n".to_owned());
        lines.join("\n")
    }
}

/// Returns points as the text of an attribute.
fn list(points: &[[f64; 2]]) -> String {
    points.iter().map(|[x, y]| format!("{x:.3},{y:.3}")).collect::<Vec<_>>().join(" ")
}

fn element(mark: &Mark) -> String {
    match mark {
        Mark::Line(points, pen) => {
            let points = list(points);
            format!("<polyline points=\"{points}\" fill=\"none\" {} stroke-linejoin=\"round\"/>", stroke(pen))
        }
        Mark::Area([x, y, w, h], color, opacity) => format!(
            "<rect x=\"{x:.2}\" y=\"{y:.2}\" width=\"{w:.2}\" height=\"{h:.2}\" fill=\"{}\" fill-opacity=\"{opacity:.3}\"/>",
            hex(*color)
        ),
        Mark::Polygon(corners, color, opacity) => {
            let (corners, color) = (list(corners), hex(*color));
            format!("<polygon points=\"{corners}\" fill=\"{color}\" fill-opacity=\"{opacity:.3}\"/>")
        }
        Mark::Frame([x, y, w, h], pen) => format!(
            "<rect x=\"{x:.2}\" y=\"{y:.2}\" width=\"{w:.2}\" height=\"{h:.2}\" fill=\"none\" {}/>",
            stroke(pen)
        ),
        Mark::Dot([x, y], radius, color) => {
            format!("<circle cx=\"{x:.3}\" cy=\"{y:.3}\" r=\"{radius}\" fill=\"{}\"/>", hex(*color))
        }
        Mark::Ring([x, y], radius, pen) => {
            format!("<circle cx=\"{x:.3}\" cy=\"{y:.3}\" r=\"{radius}\" fill=\"none\" {}/>", stroke(pen))
        }
        Mark::Image([x, y, w, h], pixels) => format!(
            "<image x=\"{x:.2}\" y=\"{y:.2}\" width=\"{w:.2}\" height=\"{h:.2}\" preserveAspectRatio=\"none\" \
             href=\"data:image/png;base64,{}\"/>",
            file(pixels)
        ),
        Mark::Words(words) => text(words),
        Mark::Within(_) => String::new(),
    }
}

fn file(pixels: &Pixels) -> String {
    base64(&encode(pixels, None))
}

fn text(lettering: &Lettering) -> String {
    let Lettering { words, at: [x, y], beside, upwards, size, bold, color, class } = lettering;
    let anchor = match beside {
        TextAnchor::Right => "start",
        TextAnchor::Middle => "middle",
        TextAnchor::Left => "end",
    };
    let mut more = String::new();
    if !class.is_empty() {
        let _ = write!(more, " class=\"{class}\"");
    }
    if *upwards {
        let _ = write!(more, " transform=\"rotate(-90 {x:.2} {y:.2})\"");
    }
    if *bold {
        more.push_str(" font-weight=\"bold\"");
    }
    let mut inside = String::new();
    let mut below = 0.0;
    for piece in words.pieces() {
        let lowered = if piece.subscript { LOWERED * size } else { 0.0 };
        let letters = escaped(&piece.text);
        if !piece.italic && lowered == below {
            inside.push_str(&letters);
            continue;
        }
        let slant = if piece.italic { " font-style=\"italic\"" } else { "" };
        let (down, own) = (lowered - below, piece.size(*size));
        let _ = write!(inside, "<tspan dy=\"{down:.2}\" font-size=\"{own:.2}\"{slant}>{letters}</tspan>");
        below = lowered;
    }
    let color = hex(*color);
    format!(
        "<text x=\"{x:.2}\" y=\"{y:.2}\" text-anchor=\"{anchor}\" font-size=\"{size}\" fill=\"{color}\"{more} \
         xml:space=\"preserve\">{inside}</text>"
    )
}

/// Encodes bytes as Base64 (RFC 4648).
fn base64(bytes: &[u8]) -> String {
    const DIGITS: &[u8; 64] = b"ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    let mut out = String::with_capacity(bytes.len().div_ceil(3) * 4);
    for triple in bytes.chunks(3) {
        let word = (0..3).fold(0u32, |word, k| word << 8 | u32::from(triple.get(k).copied().unwrap_or(0)));
        for k in 0..4 {
            let digit = DIGITS.get((word >> (18 - 6 * k) & 63) as usize).copied().unwrap_or(b'=');
            out.push(if k <= triple.len() { char::from(digit) } else { '=' });
        }
    }
    out
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn base64_is_that_of_the_standard() {
        for (plain, coded) in [("", ""), ("f", "Zg=="), ("fo", "Zm8="), ("foo", "Zm9v"), ("foobar", "Zm9vYmFy")] {
            assert_eq!(base64(plain.as_bytes()), coded);
        }
    }
}
