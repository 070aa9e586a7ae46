//! Figures as standalone SVG, fit for print.

mod curve;
mod legend;
mod panel;
mod scale;
mod stroke;
mod text;

use crate::paper::FigureSpec;
use curve::{Frame, decimal};
use text::Anchor;

const TITLE: f64 = 14.0;
const CAPTION: f64 = 11.0;
const BORDER: f64 = 12.0;

/// Writes a figure as SVG: the panels in rows of `columns`, with axes, grid, legends, title and caption.
///
/// Colours are those of [`crate::paper::PALETTE`]; the stroke follows the role of a curve. Curves are clipped to the
/// axes, and no point is left out except exact repetitions in pixels of two decimals.
///
/// # Examples
/// ```
/// use descry::document::figure_to_svg;
/// let svg = figure_to_svg(&descry::paper::FigureSpec { title: "Fig. <1>".into(), ..Default::default() });
/// assert!(svg.starts_with("<svg") && svg.contains("Fig. &lt;1&gt;"));
/// ```
pub fn figure_to_svg(figure: &FigureSpec) -> String {
    let columns = figure.columns.clamp(1, figure.panels.len().max(1));
    let rows = figure.panels.len().div_ceil(columns);
    let [wide, high] = panel_size(columns, rows);
    let width = (wide * columns as f64).max(320.0) + 2.0 * BORDER;
    let titles = text::wrapped(&figure.title, TITLE, width - 2.0 * BORDER);
    let captions = text::wrapped(&figure.caption, CAPTION, width - 2.0 * BORDER);
    let top = BORDER + 1.4 * TITLE * titles.len() as f64;
    let below = top + high * rows as f64;
    let height = below + 1.4 * CAPTION * captions.len() as f64 + BORDER;

    let mut svg = format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{w}\" height=\"{h}\" viewBox=\"0 0 {w} {h}\" \
         font-family=\"Helvetica, Arial, sans-serif\" fill=\"#222\">\n",
        w = decimal(width),
        h = decimal(height)
    );
    for (tag, content) in [("title", &figure.title), ("desc", &figure.caption)] {
        let content = text::escape(content);
        svg.extend(["<", tag, ">", &content, "</", tag, ">\n"]);
    }
    svg.push_str("<rect width=\"100%\" height=\"100%\" fill=\"#fff\"/>\n");
    for (i, line) in titles.iter().enumerate() {
        let y = BORDER + TITLE * 1.4_f64.mul_add(i as f64, 0.9);
        svg.push_str(&text::bold([width / 2.0, y], TITLE, Anchor::Middle, line));
    }
    for (i, panel) in figure.panels.iter().enumerate() {
        let left = BORDER + wide * (i % columns) as f64;
        let upper = top + high * (i / columns) as f64;
        let frame = Frame { left, top: upper, right: left + wide, bottom: upper + high };
        svg.push_str(&panel::panel(panel, &frame));
    }
    for (i, line) in captions.iter().enumerate() {
        let y = below + CAPTION * 1.4_f64.mul_add(i as f64, 1.0);
        svg.push_str(&text::text([BORDER, y], CAPTION, Anchor::Start, line));
    }
    svg.push_str("</svg>\n");
    svg
}

/// Width and height of a panel with its labels.
fn panel_size(columns: usize, rows: usize) -> [f64; 2] {
    let wide = match columns {
        1 => 640.0,
        2 => 400.0,
        3 => 310.0,
        _ => 260.0,
    };
    let high = match (columns, rows) {
        (1, 0 | 1) => 400.0,
        (1, _) => 240.0,
        (2, _) => 260.0,
        _ => 200.0,
    };
    [wide, high]
}
