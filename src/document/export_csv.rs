//! Figures and trajectories as comma-separated values, every number with the digits that read back to it.

use nalgebra::DMatrix;

use super::matrix_text::csv_number;
use crate::paper::{FigureSpec, Panel, Series};
use crate::simulation::Trajectory;

/// Writes the curves of a figure.
///
/// One table with a column for each curve when all of them share their abscissae; else the long form
/// `panel,series,x,y` with a line for each point.
pub fn figure_to_csv(figure: &FigureSpec) -> String {
    let curves: Vec<(&Panel, &Series)> = figure
        .panels
        .iter()
        .flat_map(|panel| panel.series.iter().map(move |series| (panel, series)))
        .collect();
    match curves.split_first() {
        Some(((panel, first), rest))
            if rest.iter().all(|(p, s)| p.x.label == panel.x.label && same_x(first, s)) =>
        {
            table(&panel.x.label, &curves)
        }
        _ => long(&curves),
    }
}

fn same_x(a: &Series, b: &Series) -> bool {
    let bits = |p: &[f64; 2]| p[0].to_bits();
    a.points.len() == b.points.len() && a.points.iter().map(bits).eq(b.points.iter().map(bits))
}

fn table(x: &str, curves: &[(&Panel, &Series)]) -> String {
    let x = if x.is_empty() { "x" } else { x };
    let names = column_names(curves);
    let mut text = line(std::iter::once(x.to_owned()).chain(names).map(|name| quoted(&name)));
    let count = curves.first().map_or(0, |(_, series)| series.points.len());
    for k in 0..count {
        let x = curves.first().map(|(_, series)| series.points[k][0]);
        let values = curves.iter().map(|(_, series)| series.points[k][1]);
        text.push_str(&line(x.into_iter().chain(values).map(csv_number)));
    }
    text
}

/// Names of the curves, with their panel's where they would repeat, numbered where even that repeats.
fn column_names(curves: &[(&Panel, &Series)]) -> Vec<String> {
    let repeats = |name: &str| curves.iter().filter(|(_, s)| s.name == name).count() > 1;
    let mut names: Vec<String> = Vec::new();
    for (panel, series) in curves {
        let of = if panel.y.label.is_empty() { &panel.title } else { &panel.y.label };
        let name = match (repeats(&series.name), of.is_empty() || *of == series.name) {
            (true, false) => format!("{of}: {}", series.name),
            _ => series.name.clone(),
        };
        let mut unique = name.clone();
        let mut number = 1;
        while names.contains(&unique) {
            number += 1;
            unique = format!("{name} ({number})");
        }
        names.push(unique);
    }
    names
}

fn long(curves: &[(&Panel, &Series)]) -> String {
    let mut text = "panel,series,x,y\n".to_owned();
    for (panel, series) in curves {
        let title = if panel.title.is_empty() { &panel.y.label } else { &panel.title };
        let (panel, name) = (quoted(title), quoted(&series.name));
        for [x, y] in &series.points {
            text.push_str(&line([panel.clone(), name.clone(), csv_number(*x), csv_number(*y)].into_iter()));
        }
    }
    text
}

/// Writes a trajectory with the columns `t, u1.., d1.., y1.., x1.., x1_hat.., d1_hat.., e1..`.
///
/// The columns of a second observer end in `_2`, and so on.
pub fn trajectory_to_csv(trajectory: &Trajectory) -> String {
    let Trajectory { t, u, d, y, x, observers, .. } = trajectory;
    let mut columns: Vec<(String, &DMatrix<f64>, usize)> = Vec::new();
    let mut add = |front: &str, back: &str, of: &str, matrix| {
        let of_matrix: &DMatrix<f64> = matrix;
        columns.extend((0..of_matrix.nrows()).map(|i| (format!("{front}{}{back}{of}", i + 1), of_matrix, i)));
    };
    for (front, matrix) in [("u", u), ("d", d), ("y", y), ("x", x)] {
        add(front, "", "", matrix);
    }
    for (k, observer) in observers.iter().enumerate() {
        let of = if k == 0 { String::new() } else { format!("_{}", k + 1) };
        add("x", "_hat", &of, &observer.x_hat);
        add("d", "_hat", &of, &observer.d_hat);
        add("e", "", &of, &observer.e);
    }
    let names = columns.iter().map(|(name, _, _)| name.clone());
    let mut text = line(std::iter::once("t".to_owned()).chain(names));
    for (k, t) in t.iter().enumerate() {
        let values = columns.iter().map(|(_, matrix, i)| matrix[(*i, k)]);
        text.push_str(&line(std::iter::once(*t).chain(values).map(csv_number)));
    }
    text
}

fn line(fields: impl Iterator<Item = String>) -> String {
    let mut line = fields.collect::<Vec<_>>().join(",");
    line.push('\n');
    line
}

/// A field in quotes where it holds a comma, a quote or a line end (RFC 4180).
pub(super) fn quoted(text: &str) -> String {
    if text.contains(['"', ',', '\n', '\r']) {
        format!("\"{}\"", text.replace('"', "\"\""))
    } else {
        text.to_owned()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::paper::Axis;

    fn series(name: &str, points: &[[f64; 2]]) -> Series {
        Series { name: name.to_owned(), points: points.to_vec(), ..Series::default() }
    }

    fn figure(panels: &[(&str, Vec<Series>)]) -> FigureSpec {
        let panel = |(title, series): &(&str, Vec<Series>)| Panel {
            title: (*title).to_owned(),
            x: Axis { label: "t (s)".to_owned(), ..Axis::default() },
            series: series.clone(),
            ..Panel::default()
        };
        FigureSpec { panels: panels.iter().map(panel).collect(), ..FigureSpec::default() }
    }

    #[test]
    fn shared_abscissae_give_one_table() {
        let points = [[0.0, 1.0], [0.1, 1.0 / 3.0]];
        let spec = figure(&[("a", vec![series("x1", &points)]), ("b", vec![series("x1", &points)])]);
        assert_eq!(
            figure_to_csv(&spec),
            "t (s),a: x1,b: x1\n0,1,1\n0.1,0.3333333333333333,0.3333333333333333\n",
            "repeated names carry their panel"
        );
    }

    #[test]
    fn different_abscissae_give_the_long_form() {
        let spec = figure(&[("a, b", vec![series("p", &[[0.0, 1.0]]), series("q", &[[0.5, 1e-9]])])]);
        assert_eq!(figure_to_csv(&spec), "panel,series,x,y\n\"a, b\",p,0,1\n\"a, b\",q,0.5,1e-9\n");
        assert_eq!(figure_to_csv(&FigureSpec::default()), "panel,series,x,y\n", "an empty figure");
    }
}
