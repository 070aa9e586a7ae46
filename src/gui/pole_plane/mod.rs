//! The complex plane: wished poles to drag, achieved poles over them, fixed modes, eigenvalues of the plant.

mod ground;
mod wish;

use egui::{Align2, FontId, Id, Key, Pos2, Rect, Response, Role, Sense, Stroke, Ui, Vec2, vec2};

use super::plot::round_step;
use super::{Output, theme};
use crate::document::PlantData;
use crate::numerics::Complex64;
use crate::observer::{Method, scaled_pole, show};
use crate::session::{Derived, Session};
use crate::system::TimeDomain;
pub use wish::Wish;

/// Distance in points from a pole within which it is taken: by a mouse, by a finger.
const MOUSE_RADIUS: f32 = 14.0;
const TOUCH_RADIUS: f32 = 24.0;

/// What is drawn.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Poles {
    /// Discrete time: the unit circle bounds the stable poles.
    pub discrete: bool,
    /// The bandwidth factor.
    pub scale: f64,
    /// Wished poles of the document, scaled; those that the order uses come first.
    pub wished: Vec<Complex64>,
    /// How many of them the order uses.
    pub used: usize,
    /// Whose they are, one for each; of a single list, none.
    pub owners: Vec<Wish>,
    /// Eigenvalues that the gain gave.
    pub achieved: Vec<Complex64>,
    /// Modes that no gain moves.
    pub fixed: Vec<Complex64>,
    /// Finite eigenvalues of the plant.
    pub plant: Vec<Complex64>,
    /// The design is by matrix inequalities: there are no wishes, only a region.
    pub by_region: bool,
    /// The demand on the decay, which bounds the region.
    pub decay: Option<f64>,
}

impl Poles {
    /// Collects what is to be drawn; achieved poles are those of the newest analysis.
    pub fn collect(session: &Session, derived: &Derived) -> Self {
        let document = session.document();
        let discrete = match &document.plant {
            PlantData::Descriptor(data) => data.time == TimeDomain::Discrete,
            PlantData::Network(_) => false,
        };
        let scale = document.design.scale;
        let by_region = document.design.method.uses_lmi();
        let decay = document.design.lmi.decay.filter(|_| by_region);
        let mut poles = Self { discrete, scale, by_region, decay, ..Self::default() };
        let analysis = derived.analysis();
        let assessment = analysis.and_then(|analysis| analysis.assessment.as_ref().ok());
        let design = assessment.and_then(|assessment| assessment.outcome.as_ref().ok());
        if !by_region {
            let (wishes, used) = wish::wishes(session, design);
            poles.used = used;
            // undoing the inverse scale is scaling
            poles.wished = wishes.iter().map(|(_, pole)| scaled_pole(*pole, scale, discrete)).collect();
            if document.design.method == Method::Hierarchical {
                poles.owners = wishes.into_iter().map(|(wish, _)| wish).collect();
            }
        }
        if let Some(analysis) = analysis {
            poles.plant.clone_from(&analysis.plant_eigenvalues);
        }
        if let Some(design) = design {
            poles.achieved.clone_from(&design.verification.spectrum);
            poles.fixed = design.synthesis.fixed_modes();
            let locals = design.hierarchical.iter().flat_map(|found| found.locals()).take(1);
            poles.fixed.extend(locals.flat_map(|(_, local)| local.placement.fixed_modes.iter().copied()));
        }
        poles
    }

    /// Whose a wished pole is.
    fn wish(&self, k: usize) -> Wish {
        self.owners.get(k).copied().unwrap_or(Wish { local: false, index: k })
    }

    /// Where a wish stands among those that the order uses.
    fn place(&self, wish: Wish) -> Option<usize> {
        (0..self.used).find(|k| self.wish(*k) == wish)
    }

    /// What a wished pole is called.
    fn name(&self, k: usize) -> String {
        let Wish { local, index } = self.wish(k);
        match (self.owners.is_empty(), local) {
            (true, _) => format!("pole {}", index + 1),
            (false, false) => format!("global pole {}", index + 1),
            (false, true) => format!("local pole {}", index + 1),
        }
    }

    /// The smallest rectangle that a view must show: `[re low, re high, im half]`.
    fn needed(&self) -> [f64; 3] {
        let border = self.decay.filter(|_| !self.discrete).map(|decay| Complex64::from(-decay));
        let own = self.wished[..self.used].iter().chain(&self.achieved).chain(&self.fixed).chain(&border);
        let far = own.clone().map(|z| z.norm()).fold(0.0, f64::max);
        // a fast mode of the plant must not press the observer's poles into one point
        let plant = self.plant.iter().filter(|z| z.norm() <= 3.0 * far.max(1e-3));
        let all = || own.clone().chain(plant.clone()).filter(|z| z.re.is_finite() && z.im.is_finite());
        let (low, high, half) = all().fold((0.0_f64, 0.0_f64, 0.0_f64), |(low, high, half), z| {
            (low.min(z.re), high.max(z.re), half.max(z.im.abs()))
        });
        if self.discrete {
            let edge = |value: f64| value.abs().max(1.0) * 1.15;
            return [-edge(low), edge(high), edge(half)];
        }
        let span = (high - low).max(2.0 * half).max(1e-3);
        [low - 0.12 * span, high + 0.15 * span, half * 1.25]
    }
}

/// The part of the plane that is shown; the same scale on both axes.
#[derive(Clone, Copy, Debug, PartialEq)]
struct View {
    centre: f64,
    per_point: f64,
    size: Vec2,
}

impl View {
    fn fit([low, high, half]: [f64; 3], size: Vec2) -> Self {
        let per_point = ((high - low) / f64::from(size.x)).max(2.0 * half / f64::from(size.y)).max(1e-12);
        Self { centre: f64::midpoint(low, high), per_point, size }
    }

    /// Whether what is needed fits into the view and is not lost in it.
    fn suits(&self, needed: [f64; 3], size: Vec2) -> bool {
        let ideal = Self::fit(needed, size);
        let half_width = 0.5 * f64::from(size.x) * self.per_point;
        let [low, high, half] = needed;
        let margin = 0.1 * (high - low);
        self.size == size
            && low + margin >= self.centre - half_width
            && high - margin <= self.centre + half_width
            && 0.85 * half <= 0.5 * f64::from(size.y) * self.per_point
            && ideal.per_point >= 0.45 * self.per_point
    }

    #[expect(clippy::cast_possible_truncation, reason = "screen coordinates")]
    fn screen(&self, z: Complex64, rect: Rect) -> Pos2 {
        let offset = |value: f64| (value / self.per_point).clamp(-1e6, 1e6) as f32;
        rect.center() + vec2(offset(z.re - self.centre), -offset(z.im))
    }

    fn value(&self, at: Pos2, rect: Rect) -> Complex64 {
        let offset = at - rect.center();
        Complex64::new(
            self.centre + f64::from(offset.x) * self.per_point,
            -f64::from(offset.y) * self.per_point,
        )
    }
}

/// What is remembered between frames.
#[derive(Clone, Copy, Debug, Default)]
struct Memory {
    view: Option<View>,
    /// The pole that is dragged and its offset from the pointer.
    dragged: Option<(Wish, Vec2)>,
    /// The pole that arrow keys are moving.
    stepping: Option<Wish>,
}

/// Draws the plane and turns drags and arrow keys into moved poles.
pub fn pole_plane_ui(ui: &mut Ui, session: &Session, derived: &Derived, size: Vec2, out: &mut Output) {
    let poles = Poles::collect(session, derived);
    let (_, rect) = ui.allocate_space(size);
    // an id of its own: remarks that come and go above it must not break off a drag
    let response = ui.interact(rect, Id::unique("pole plane"), Sense::click_and_drag());
    ui.ctx().accesskit_node_builder(response.id, |node| {
        node.set_role(Role::Group);
        node.set_label("pole plane");
    });
    let id = response.id.with("memory");
    let mut memory = ui.data(|data| data.get_temp::<Memory>(id)).unwrap_or_default();
    let needed = poles.needed();
    let view = match memory.view {
        Some(view) if memory.dragged.is_some() || view.suits(needed, size) => view,
        _ => View::fit(needed, size),
    };
    memory.view = Some(view);
    ground::background(ui, rect, &view, &poles);
    ground::marks(ui, rect, &view, &poles);
    let plane = Plane { poles: &poles, view, rect };
    plane.pointer(ui, &response, &mut memory, out);
    let focused = plane.nodes(ui, response.id, &mut memory, out);
    let dragged = memory.dragged.and_then(|(wish, _)| poles.place(wish));
    plane.wishes(ui, &response, dragged.or(focused));
    plane.read_out(ui, response, dragged);
    ui.data_mut(|data| data.insert_temp(id, memory));
}

struct Plane<'a> {
    poles: &'a Poles,
    view: View,
    rect: Rect,
}

impl Plane<'_> {
    fn at(&self, z: Complex64) -> Pos2 {
        self.view.screen(z, self.rect)
    }

    /// The used pole nearest to the pointer, within reach.
    fn nearest(&self, ui: &Ui, pointer: Pos2) -> Option<usize> {
        let touch = ui.input(egui::InputState::any_touches);
        let radius = if touch { TOUCH_RADIUS } else { MOUSE_RADIUS };
        let distance = |k: &usize| self.at(self.poles.wished[*k]).distance(pointer);
        (0..self.poles.used)
            .filter(|k| distance(k) <= radius)
            .min_by(|a, b| distance(a).total_cmp(&distance(b)))
    }

    fn move_to(&self, k: usize, to: Complex64, done: bool, out: &mut Output) {
        let to = scaled_pole(to, 1.0 / self.poles.scale, self.poles.discrete);
        out.edit(self.poles.wish(k).moved(to, done));
    }

    /// Drags: a pole keeps its distance from the pointer, and does not leave the view.
    fn pointer(&self, ui: &Ui, response: &Response, memory: &mut Memory, out: &mut Output) {
        if response.drag_started() {
            let origin = ui.input(|input| input.pointer.press_origin());
            memory.dragged = origin
                .and_then(|origin| Some((self.nearest(ui, origin)?, origin)))
                .map(|(k, origin)| (self.poles.wish(k), self.at(self.poles.wished[k]) - origin));
        }
        if response.clicked() || response.drag_started() {
            let at = ui.input(|input| input.pointer.press_origin()).or(response.interact_pointer_pos());
            if let Some(k) = at.and_then(|at| self.nearest(ui, at)) {
                ui.memory_mut(|memory| memory.request_focus(node_id(response.id, self.poles.wish(k))));
            }
        }
        let Some((wish, offset)) = memory.dragged else { return };
        let ended = response.drag_stopped() || !response.dragged();
        if ended {
            memory.dragged = None;
        }
        let Some(k) = self.poles.place(wish) else { return };
        if let Some(pointer) = response.interact_pointer_pos() {
            let inside = self.rect.shrink(2.0).clamp(pointer + offset);
            if ended || response.drag_delta() != Vec2::ZERO || response.drag_started() {
                self.move_to(k, self.view.value(inside, self.rect), ended, out);
            }
        } else if ended {
            self.move_to(k, self.poles.wished[k], true, out);
        }
    }

    /// One node for each used pole: focus by Tab, moves by arrow keys, names for assistive technology.
    fn nodes(&self, ui: &Ui, plane: Id, memory: &mut Memory, out: &mut Output) -> Option<usize> {
        let mut focused = None;
        for (k, pole) in self.poles.wished[..self.poles.used].iter().enumerate() {
            let id = node_id(plane, self.poles.wish(k));
            let node = Rect::from_center_size(self.at(*pole), Vec2::splat(12.0));
            let response = ui.interact(node, id, Sense::focusable_noninteractive());
            response.widget_info(|| egui::WidgetInfo::labeled(Role::Slider, true, self.poles.name(k)));
            ui.ctx().accesskit_node_builder(id, |node| node.set_value(show(*pole)));
            if response.has_focus() {
                focused = Some(k);
                let arrows = egui::EventFilter {
                    horizontal_arrows: true,
                    vertical_arrows: true,
                    ..egui::EventFilter::default()
                };
                ui.memory_mut(|memory| memory.set_focus_lock_filter(id, arrows));
                self.keys(ui, k, memory, out);
            }
        }
        focused
    }

    /// Arrow keys; holding one is one step of the history.
    fn keys(&self, ui: &Ui, k: usize, memory: &mut Memory, out: &mut Output) {
        let (count, fine, released) = ui.input(|input| {
            let pressed = |key| input.num_presses(key) as f64;
            let count = (
                pressed(Key::ArrowRight) - pressed(Key::ArrowLeft),
                pressed(Key::ArrowUp) - pressed(Key::ArrowDown),
            );
            let arrows = [Key::ArrowRight, Key::ArrowLeft, Key::ArrowUp, Key::ArrowDown];
            (count, input.modifiers.shift, !arrows.iter().any(|key| input.key_down(*key)))
        });
        let pole = self.poles.wished[k];
        if count != (0.0, 0.0) {
            let step = round_step(8.0 * self.view.per_point) * if fine { 0.1 } else { 1.0 };
            let mut to = pole + Complex64::new(count.0 * step, count.1 * step);
            if pole.im == 0.0 && count.1 != 0.0 {
                // far enough from the real axis not to snap back onto it
                to.im = count.1.signum() * step.max(0.04 * pole.norm());
            }
            memory.stepping = Some(self.poles.wish(k));
            self.move_to(k, to, released, out);
        } else if released && memory.stepping == Some(self.poles.wish(k)) {
            self.move_to(k, pole, true, out);
        }
        if released {
            memory.stepping = None;
        }
    }

    /// Crosses for wished poles; those that the order does not use are faint.
    fn wishes(&self, ui: &Ui, response: &Response, active: Option<usize>) {
        let painter = ui.painter().with_clip_rect(self.rect.intersect(ui.clip_rect()));
        let under = response.hover_pos().and_then(|at| self.nearest(ui, at));
        for (k, pole) in self.poles.wished.iter().enumerate() {
            let at = self.at(*pole);
            let used = k < self.poles.used;
            let marked = active == Some(k) || active.is_none() && under == Some(k);
            let colour = match (used, self.poles.wish(k).local) {
                (true, false) => theme::accent(ui),
                (true, true) => theme::series(ui, 1),
                (false, _) => theme::faint(ui).gamma_multiply(0.5),
            };
            let arm = if marked { 8.0 } else { 6.0 };
            let stroke = Stroke::new(if used { 2.2 } else { 1.2 }, colour);
            painter.line_segment([at - vec2(arm, arm), at + vec2(arm, arm)], stroke);
            painter.line_segment([at - vec2(arm, -arm), at + vec2(arm, -arm)], stroke);
            if marked {
                painter.circle_stroke(at, 13.0, Stroke::new(1.5, colour));
            }
        }
        for pole in &self.poles.achieved {
            painter.circle_filled(self.at(*pole), 3.2, theme::good(ui));
        }
        if under.is_some() || active.is_some() && response.dragged() {
            let icon = if response.dragged() { egui::CursorIcon::Grabbing } else { egui::CursorIcon::Grab };
            ui.ctx().set_cursor_icon(icon);
        }
    }

    /// What is under the pointer, in the upper left corner; the reason for a fixed mode as a tooltip.
    fn read_out(&self, ui: &Ui, response: Response, dragged: Option<usize>) {
        let Some(pointer) = response.hover_pos() else { return };
        let near = |values: &[Complex64]| {
            values.iter().copied().find(|z| self.at(*z).distance(pointer) <= MOUSE_RADIUS)
        };
        let text = if let Some(k) = dragged.or_else(|| self.nearest(ui, pointer)) {
            format!("{}: {}", self.poles.name(k), show(self.poles.wished[k]))
        } else if let Some(fixed) = near(&self.poles.fixed) {
            format!("fixed mode {}", show(fixed))
        } else if let Some(unused) = near(&self.poles.wished[self.poles.used..]) {
            let uses = if self.poles.owners.is_empty() { "this order uses" } else { "these observers use" };
            format!("{} waits: {uses} {} poles", show(unused), self.poles.used)
        } else if let Some(achieved) = near(&self.poles.achieved).filter(|_| self.poles.by_region) {
            format!("mode of the error {}", show(achieved))
        } else if let Some(plant) = near(&self.poles.plant) {
            format!("eigenvalue of the plant {}", show(plant))
        } else {
            show(self.view.value(pointer, self.rect))
        };
        let painter = ui.painter().with_clip_rect(self.rect.intersect(ui.clip_rect()));
        let corner = self.rect.left_top() + vec2(8.0, 6.0);
        painter.text(corner, Align2::LEFT_TOP, text, FontId::proportional(12.0), ui.visuals().text_color());
        if dragged.is_none() && near(&self.poles.fixed).is_some() {
            response.on_hover_text_at_pointer(
                "A fixed mode: the outputs do not see it, so no gain can move it. Another output could.",
            );
        }
    }
}

fn node_id(plane: Id, wish: Wish) -> Id {
    plane.with(("pole", wish.local, wish.index))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn real(values: &[f64]) -> Poles {
        let wished: Vec<Complex64> = values.iter().map(|value| Complex64::from(*value)).collect();
        Poles { used: wished.len(), wished, scale: 1.0, ..Poles::default() }
    }

    #[test]
    fn a_view_shows_every_pole_and_the_border_of_stability() {
        let mut poles = real(&[-22.0, -18.0, -33.0]);
        poles.wished.push(Complex64::new(-3.0, 20.0));
        poles.used = 4;
        let size = vec2(300.0, 200.0);
        let rect = Rect::from_min_size(Pos2::ZERO, size);
        let view = View::fit(poles.needed(), size);
        for pole in poles.wished.iter().chain([&Complex64::new(0.0, 0.0)]) {
            assert!(rect.shrink(4.0).contains(view.screen(*pole, rect)), "{pole} is inside");
        }
    }

    #[test]
    fn values_and_places_are_inverse() {
        let view = View::fit([-40.0, 5.0, 10.0], vec2(300.0, 200.0));
        let rect = Rect::from_min_size(Pos2::new(50.0, 70.0), vec2(300.0, 200.0));
        let z = Complex64::new(-7.0, 3.0);
        assert!((view.value(view.screen(z, rect), rect) - z).norm() < 1e-4, "there and back");
    }

    #[test]
    fn a_view_is_kept_until_a_pole_leaves_it_or_is_lost_in_it() {
        let size = vec2(300.0, 200.0);
        let view = View::fit(real(&[-20.0, -10.0]).needed(), size);
        assert!(view.suits(real(&[-18.0, -9.0]).needed(), size), "small moves keep the view");
        assert!(!view.suits(real(&[-40.0, -10.0]).needed(), size), "a pole outside");
        assert!(!view.suits(real(&[-2.0, -1.0]).needed(), size), "poles in a corner");
    }
}
