//! The coupling as a drawn graph: nodes to click, edges to draw.

use egui::{Align2, FontId, Id, Pos2, Rect, Response, Role, Sense, Shape, Stroke, Ui, WidgetInfo, vec2};

use super::super::{plot::short, theme};
use super::geometry::{Circle, distance};
use super::links::{Link, Links};

/// Up to this many nodes are widgets of their own, which the keyboard reaches and between which edges can be drawn.
pub(super) const WIDGETS: usize = 200;
/// Distance from an edge within which it is meant.
const REACH: f32 = 6.0;

/// What is drawn.
pub(super) struct Picture<'a> {
    /// The edges.
    pub links: &'a Links,
    /// The subsystems whose local observers are plugged in; `None` for all that are measured.
    pub plugged: Option<&'a [usize]>,
    /// The chosen subsystem.
    pub chosen: usize,
    /// The chosen edge, `(to, from)`.
    pub edge: (usize, usize),
}

/// What a person did.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Act {
    /// Clicked a node.
    Node(usize),
    /// Clicked an edge, `(to, from)`.
    Edge(usize, usize),
    /// Drew from one node to another, `(to, from)`.
    Join(usize, usize),
}

/// What a subsystem has locally.
#[derive(Clone, Copy, PartialEq)]
enum Equipment {
    Nothing,
    Sensors,
    Observer,
}

impl Picture<'_> {
    fn count(&self) -> usize {
        self.links.own.len()
    }

    fn equipment(&self, k: usize) -> Equipment {
        match (self.links.measured.get(k), self.plugged) {
            (Some(true), None) => Equipment::Observer,
            (Some(true), Some(list)) if list.contains(&k) => Equipment::Observer,
            (Some(true), Some(_)) => Equipment::Sensors,
            _ => Equipment::Nothing,
        }
    }

    /// A subsystem in words.
    fn words(&self, k: usize) -> String {
        let has = match self.equipment(k) {
            Equipment::Nothing => "not measured locally",
            Equipment::Sensors => "measured locally, local observer out",
            Equipment::Observer => "local observer plugged in",
        };
        format!("Subsystem {}: {has}", k + 1)
    }
}

/// Draws the graph and says what a person did to it.
pub(super) fn show(ui: &mut Ui, picture: &Picture<'_>) -> Option<Act> {
    const LARGEST: f32 = 300.0;
    let side = ui.available_width().min(LARGEST);
    let (place, area) = ui.allocate_exact_size(vec2(ui.available_width(), side), Sense::hover());
    let square = Rect::from_center_size(place.center(), vec2(side, side));
    let graph = Graph { picture, circle: Circle::new(square, picture.count()) };
    area.widget_info(|| {
        let label = format!("graph of {} subsystems, {} edges", picture.count(), picture.links.total);
        WidgetInfo::labeled(Role::Image, true, label)
    });
    // below the nodes, which are drawn later and take what is theirs
    let ground = ui.interact(square, Id::unique("graph ground"), Sense::click());
    let mut act = None;
    let mut drawn = None;
    if picture.count() <= WIDGETS {
        for k in 0..picture.count() {
            let response = graph.node(ui, k);
            act = graph.pressed(&response, k, &mut drawn).or(act);
        }
    }
    if ground.clicked() && act.is_none() {
        act = ground.interact_pointer_pos().and_then(|at| graph.act_at(at));
    }
    let pointer = ui.input(|input| input.pointer.hover_pos());
    let pointer = pointer.filter(|_| ui.rect_contains_pointer(square) && drawn.is_none());
    let under = pointer.and_then(|at| graph.link_at(at));
    graph.paint(ui, under, drawn);
    graph.tell(ui, &area, pointer, under);
    act
}

struct Graph<'a> {
    picture: &'a Picture<'a>,
    circle: Circle,
}

impl Graph<'_> {
    /// A node as a widget: Tab leads to it, Enter or Space plugs its observer in or out.
    fn node(&self, ui: &Ui, k: usize) -> Response {
        let reach = (2.0 * self.circle.node).max(12.0);
        let place = Rect::from_center_size(self.circle.at(k), vec2(reach, reach));
        let response = ui.interact(place, Id::unique(("node", k)), Sense::click_and_drag());
        response.widget_info(|| {
            let on = self.picture.equipment(k) == Equipment::Observer;
            WidgetInfo::selected(Role::Switch, true, on, self.picture.words(k))
        });
        response
    }

    /// Clicks and drags that began on a node; while one is going on, `drawn` is the line from it.
    fn pressed(&self, response: &Response, k: usize, drawn: &mut Option<(usize, Pos2)>) -> Option<Act> {
        if response.clicked() {
            return Some(Act::Node(k));
        }
        let at = response.interact_pointer_pos()?;
        if response.drag_stopped() {
            let to = self.circle.node_at(at).filter(|to| *to != k)?;
            return Some(Act::Join(to, k));
        }
        if response.dragged() {
            *drawn = Some((k, at));
        }
        None
    }

    /// What a click at a point means.
    fn act_at(&self, at: Pos2) -> Option<Act> {
        let node = self.circle.node_at(at).map(Act::Node);
        node.or_else(|| self.link_at(at).map(|link| Act::Edge(link.to, link.from)))
    }

    /// The edge under a point.
    fn link_at(&self, at: Pos2) -> Option<Link> {
        if self.circle.node_at(at).is_some() || self.picture.count() > WIDGETS {
            return None;
        }
        let links = self.picture.links.drawn.iter();
        let near = links.map(|link| (distance(at, &self.circle.edge(link)), link));
        let nearest = near.min_by(|a, b| a.0.total_cmp(&b.0))?;
        (nearest.0 <= REACH).then_some(*nearest.1)
    }

    fn paint(&self, ui: &Ui, under: Option<Link>, drawn: Option<(usize, Pos2)>) {
        for link in &self.picture.links.drawn {
            let marked = (link.to, link.from) == self.picture.edge && self.picture.count() <= WIDGETS;
            self.edge(ui, link, marked || under == Some(*link));
        }
        if let Some((from, to)) = drawn {
            let stroke = Stroke::new(2.0, theme::accent(ui));
            ui.painter().line_segment([self.circle.at(from), to], stroke);
        }
        for k in 0..self.picture.count() {
            self.disc(ui, k);
        }
    }

    /// An edge: wider for a stronger one, dashed and in another colour for a negative one.
    fn edge(&self, ui: &Ui, link: &Link, marked: bool) {
        let points = self.circle.edge(link);
        let Some([.., before, tip]) = points.get(..) else { return };
        let crowded = self.picture.links.drawn.len() > 200;
        #[expect(clippy::cast_possible_truncation, reason = "a share between zero and one")]
        let share = (link.weight.abs() / self.picture.links.largest.max(f64::MIN_POSITIVE)) as f32;
        let (thin, thick) = if crowded { (0.4, 0.6) } else { (1.0, 2.4) };
        let colour = match (theme::edge(ui, link.weight > 0.0), link.weight > 0.0, marked) {
            (_, true, true) => ui.visuals().text_color(),
            (colour, _, false) if crowded => colour.gamma_multiply(0.45),
            (colour, ..) => colour,
        };
        let stroke = Stroke::new(thin + thick * share + if marked { 1.0 } else { 0.0 }, colour);
        let way = (*tip - *before).normalized();
        if crowded {
            ui.painter().line_segment([points[0], *tip], stroke);
            return;
        }
        if link.weight < 0.0 {
            ui.painter().extend(Shape::dashed_line(&points, stroke, 5.0, 4.0));
        } else {
            ui.painter().line(points.clone(), stroke);
        }
        let (length, half) = (5.5 + stroke.width, 2.4 + 0.8 * stroke.width);
        let back = *tip - length * way;
        let head = vec![*tip, back + half * way.rot90(), back - half * way.rot90()];
        ui.painter().add(Shape::convex_polygon(head, colour, Stroke::NONE));
    }

    /// A node: a ring where something is measured locally, filled where an observer is plugged in.
    fn disc(&self, ui: &Ui, k: usize) {
        let (circle, painter) = (&self.circle, ui.painter());
        let (at, radius) = (circle.at(k), circle.node);
        let (text, ground) = (ui.visuals().text_color(), ui.visuals().panel_fill);
        let equipment = self.picture.equipment(k);
        let (fill, ring, number) = match equipment {
            Equipment::Nothing => (ground, Stroke::new(1.0, theme::faint(ui)), text),
            Equipment::Sensors => (ground, Stroke::new((0.2 * radius).max(1.2), theme::accent(ui)), text),
            Equipment::Observer => (theme::accent(ui), Stroke::new(1.0, theme::accent(ui)), ground),
        };
        painter.circle(at, radius, fill, ring);
        if ui.memory(|memory| memory.has_focus(Id::unique(("node", k)))) {
            painter.circle_stroke(at, radius + 3.5, Stroke::new(2.0, text));
        } else if k == self.picture.chosen && self.picture.count() > 1 {
            painter.circle_stroke(at, radius + 2.5, Stroke::new(1.0, text));
        }
        let count = self.picture.count();
        let label = (k + 1).to_string();
        if count <= Circle::INSIDE {
            painter.text(at, Align2::CENTER_CENTER, label, FontId::proportional(12.0), number);
            if let Some(own) = self.picture.links.own.get(k).filter(|own| **own != 0.0) {
                let beside = at + (radius + 13.0) * circle.outwards(k);
                let font = FontId::proportional(10.5);
                painter.text(beside, Align2::CENTER_CENTER, short(*own), font, theme::faint(ui));
            }
        } else if count <= Circle::NUMBERED {
            let beside = at + (radius + 9.0) * circle.outwards(k);
            painter.text(beside, Align2::CENTER_CENTER, label, FontId::proportional(10.0), text);
        }
    }

    /// What is under the pointer, in words.
    fn tell(&self, ui: &Ui, area: &Response, pointer: Option<Pos2>, under: Option<Link>) {
        let node = pointer.and_then(|at| self.circle.node_at(at));
        let text = match (node, under) {
            (Some(k), _) => {
                let own = self.picture.links.own.get(k).copied().unwrap_or_default();
                let number = k + 1;
                format!("{}\nGamma[{number}, {number}] = {}", self.picture.words(k), short(own))
            }
            (None, Some(Link { to, from, weight, .. })) => {
                let (to, from) = (to + 1, from + 1);
                format!("{to} listens to {from}: Gamma[{to}, {from}] = {}", short(weight))
            }
            (None, None) => return,
        };
        ui.ctx().set_cursor_icon(egui::CursorIcon::PointingHand);
        // nodes lie above the area, so that it is never hovered itself
        egui::Tooltip::for_widget(area).at_pointer().gap(12.0).show(|ui| ui.label(text));
    }
}

/// The signs of the graph, explained.
pub(super) fn legend(ui: &mut Ui, picture: &Picture<'_>) {
    let negative = picture.links.drawn.iter().any(|link| link.weight < 0.0);
    ui.horizontal_wrapped(|ui| {
        ui.spacing_mut().item_spacing.x = 4.0;
        for (equipment, word) in [
            (Equipment::Observer, "plugged in"),
            (Equipment::Sensors, "measured locally"),
            (Equipment::Nothing, "not measured"),
        ] {
            let (rect, _) = ui.allocate_exact_size(vec2(14.0, 14.0), Sense::hover());
            let stroke = match equipment {
                Equipment::Nothing => Stroke::new(1.0, theme::faint(ui)),
                Equipment::Sensors | Equipment::Observer => Stroke::new(2.0, theme::accent(ui)),
            };
            let filled = equipment == Equipment::Observer;
            let fill = if filled { theme::accent(ui) } else { ui.visuals().panel_fill };
            ui.painter().circle(rect.center(), 5.0, fill, stroke);
            ui.label(egui::RichText::new(word).small());
            ui.add_space(8.0);
        }
        if negative {
            let (rect, _) = ui.allocate_exact_size(vec2(22.0, 14.0), Sense::hover());
            let stroke = Stroke::new(2.0, theme::edge(ui, false));
            let ends = [rect.left_center(), rect.right_center()];
            ui.painter().extend(Shape::dashed_line(&ends, stroke, 5.0, 4.0));
            ui.label(egui::RichText::new("negative").small());
        }
    });
}
