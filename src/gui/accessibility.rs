//! What a frame shows, as a list of widgets: for pages, where the toolkit itself tells screen readers nothing.

use std::collections::HashMap;
use std::hash::{DefaultHasher, Hash as _, Hasher as _};

use egui::accesskit::{Node, NodeId, Role, Toggled, TreeUpdate};
use serde::Serialize;

/// A widget as a screen reader needs it.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Widget {
    /// Stays the same as long as the widget does.
    pub id: String,
    /// Role in the words of ARIA.
    pub role: &'static str,
    /// Name.
    pub name: String,
    /// Value or text.
    pub value: String,
    /// Whether it cannot be used now.
    pub disabled: bool,
    /// Whether it is checked, pressed or selected, where it can be.
    pub checked: Option<bool>,
    /// Left, top, width and height in CSS pixels.
    pub rect: [f64; 4],
    /// Whether it has the keyboard.
    pub focused: bool,
}

type OnChange = Box<dyn Fn(&[Widget]) + Send + Sync>;

/// Passes the widgets of a frame on whenever they are others than in the frame before.
pub struct Mirror {
    on_change: OnChange,
    shown: u64,
}

impl std::fmt::Debug for Mirror {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("Mirror").field("shown", &self.shown).finish_non_exhaustive()
    }
}

impl Mirror {
    /// A mirror that hands lists of widgets to `on_change`.
    pub fn new(on_change: impl Fn(&[Widget]) + Send + Sync + 'static) -> Self {
        Self { on_change: Box::new(on_change), shown: 0 }
    }
}

impl egui::Plugin for Mirror {
    fn debug_name(&self) -> &'static str {
        "accessibility mirror"
    }

    fn setup(&mut self, ctx: &egui::Context) {
        ctx.enable_accesskit();
    }

    fn output_hook(&mut self, ctx: &egui::Context, output: &mut egui::FullOutput) {
        let Some(update) = &output.platform_output.accesskit_update else { return };
        let zoom = f64::from(ctx.zoom_factor());
        // most frames change curves only: a hash tells so without writing a single text
        let hash = fingerprint(update, zoom);
        if hash != self.shown {
            self.shown = hash;
            (self.on_change)(&widgets(update, zoom));
        }
    }
}

/// The role in the words of ARIA; `None` for what has no meaning of its own.
fn role(role: Role) -> Option<&'static str> {
    Some(match role {
        Role::Button | Role::DefaultButton | Role::DisclosureTriangle | Role::ColorWell => "button",
        Role::SpinButton => "spinbutton",
        Role::TextInput
        | Role::MultilineTextInput
        | Role::SearchInput
        | Role::NumberInput
        | Role::PasswordInput => "textbox",
        Role::CheckBox => "checkbox",
        Role::RadioButton => "radio",
        Role::Switch => "switch",
        Role::Label | Role::Note => "note",
        Role::Heading => "heading",
        Role::Paragraph => "paragraph",
        Role::Slider => "slider",
        Role::ComboBox | Role::EditableComboBox => "combobox",
        Role::ListBoxOption | Role::MenuListOption => "option",
        Role::MenuItem => "menuitem",
        Role::MenuItemCheckBox => "menuitemcheckbox",
        Role::MenuItemRadio => "menuitemradio",
        Role::Link => "link",
        Role::Tab => "tab",
        Role::ProgressIndicator => "progressbar",
        Role::Meter => "meter",
        Role::Image | Role::Figure | Role::Canvas | Role::GraphicsObject | Role::GraphicsSymbol => "img",
        Role::Status => "status",
        Role::Alert => "alert",
        Role::Cell | Role::GridCell => "gridcell",
        _ => return None,
    })
}

/// The nodes that are widgets with a place on screen.
fn listed(update: &TreeUpdate) -> impl Iterator<Item = (NodeId, &'static str, [f64; 4], &Node)> {
    update.nodes.iter().filter_map(|(id, node)| {
        let role = role(node.role())?;
        let bounds = node.bounds()?;
        Some((*id, role, [bounds.x0, bounds.y0, bounds.width(), bounds.height()], node))
    })
}

fn fingerprint(update: &TreeUpdate, zoom: f64) -> u64 {
    let mut hasher = DefaultHasher::new();
    update.focus.hash(&mut hasher);
    zoom.to_bits().hash(&mut hasher);
    for (id, role, rect, node) in listed(update) {
        (id, role, rect.map(f64::to_bits)).hash(&mut hasher);
        (node.label(), node.value(), node.numeric_value().map(f64::to_bits)).hash(&mut hasher);
        (node.is_disabled(), state(node), node.labelled_by()).hash(&mut hasher);
    }
    hasher.finish()
}

fn state(node: &Node) -> Option<bool> {
    node.toggled().map(|toggled| toggled == Toggled::True).or_else(|| node.is_selected())
}

fn widgets(update: &TreeUpdate, zoom: f64) -> Vec<Widget> {
    let nodes: HashMap<NodeId, &Node> = update.nodes.iter().map(|(id, node)| (*id, node)).collect();
    let place: HashMap<NodeId, usize> =
        order(update, &nodes).into_iter().enumerate().map(|(k, id)| (id, k)).collect();
    let label_of = |id: &NodeId| {
        let node = nodes.get(id)?;
        node.label().or_else(|| node.value())
    };
    let widget = |(id, role, rect, node): (NodeId, &'static str, [f64; 4], &Node)| {
        let name = node.label().or_else(|| node.labelled_by().iter().find_map(label_of));
        let number = || node.numeric_value().map(|value| value.to_string());
        Widget {
            id: format!("{:x}", id.0),
            role,
            name: name.unwrap_or_default().to_owned(),
            value: node.value().map(str::to_owned).or_else(number).unwrap_or_default(),
            disabled: node.is_disabled(),
            checked: state(node),
            rect: rect.map(|length| (length * zoom).round()),
            focused: id == update.focus,
        }
    };
    let mut listed: Vec<_> = listed(update).collect();
    listed.sort_by_key(|(id, ..)| place.get(id).copied().unwrap_or(usize::MAX));
    let empty = |widget: &Widget| widget.role == "note" && widget.name.is_empty() && widget.value.is_empty();
    listed.into_iter().map(widget).filter(|widget| !empty(widget)).collect()
}

/// The nodes as they follow each other in the tree: panel by panel, each in the order in which it was drawn.
fn order(update: &TreeUpdate, nodes: &HashMap<NodeId, &Node>) -> Vec<NodeId> {
    let mut order = Vec::with_capacity(nodes.len());
    let mut open: Vec<NodeId> = update.tree.iter().map(|tree| tree.root).collect();
    // a tree has no more nodes than there are: a damaged one ends there, too
    while let Some(id) = open.pop().filter(|_| order.len() <= nodes.len()) {
        order.push(id);
        if let Some(node) = nodes.get(&id) {
            open.extend(node.children().iter().rev());
        }
    }
    order
}

#[cfg(all(test, not(target_arch = "wasm32")))]
mod tests {
    use std::sync::{Arc, Mutex};

    use super::*;

    #[test]
    fn a_frame_is_mirrored_once() {
        let seen = Arc::new(Mutex::new(Vec::new()));
        let sink = Arc::clone(&seen);
        let ctx = egui::Context::default();
        ctx.add_plugin(Mirror::new(move |widgets| sink.lock().unwrap().push(widgets.to_vec())));
        let frame = |value: f64, ctx: &egui::Context| {
            let mut value = value;
            let mut output = ctx.run_ui(egui::RawInput::default(), |ui| {
                ui.label("a note");
                drop(ui.button("Press"));
                ui.add(egui::Slider::new(&mut value, 0.0..=9.0).text("Factor"));
            });
            output.textures_delta.clear();
        };
        for _ in 0..3 {
            frame(1.0, &ctx);
        }
        let settled = seen.lock().unwrap().len();
        frame(1.0, &ctx);
        assert_eq!(seen.lock().unwrap().len(), settled, "nothing changed, nothing is said");
        frame(2.0, &ctx);
        let seen = seen.lock().unwrap();
        assert_eq!(seen.len(), settled + 1, "a changed value is said");
        let last = seen.last().unwrap();
        let has = |role: &str, name: &str| last.iter().any(|w| w.role == role && w.name == name);
        assert!(has("button", "Press"), "the button: {last:?}");
        assert!(last.iter().any(|w| w.role == "slider"), "the slider: {last:?}");
    }
}
