//! What the keys and the mouse ask for.

use embedded_graphics::geometry::{Point, Size};
use embedded_graphics_simulator::sdl2::{Keycode, MouseButton, MouseWheelDirection};
use embedded_graphics_simulator::{SimulatorEvent, Window as Screen};

use crate::scene::Motion;

/// What the viewer wants.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Wish {
    Next,
    Previous,
    Go(Motion),
    /// The scene as it was, its file read again.
    Reload,
    Save,
    Close,
}

/// Remembers where the mouse is.
pub(super) struct Hand {
    size: Size,
    pointer: Point,
}

impl Hand {
    /// In the middle of a display of this size.
    pub(super) fn new(size: Size) -> Self {
        Self { size, pointer: middle(size) }
    }

    /// The wishes among the events that are waiting. The simulator itself turns Esc into a request to quit.
    pub(super) fn wishes(&mut self, screen: &Screen) -> Vec<Wish> {
        screen.events().filter_map(|event| self.wish(event)).collect()
    }

    fn wish(&mut self, event: SimulatorEvent) -> Option<Wish> {
        let middle = middle(self.size);
        // an eighth of the shorter side
        let step = (self.size.width.min(self.size.height) / 8).max(1) as i32;
        let pan = |right: i32, up: i32| Some(Wish::Go(Motion::Pan { right, up }));
        let zoom = |about: Option<Point>, closer: bool| Some(Wish::Go(Motion::Zoom { about, closer }));
        let light = |right: i32, up: i32| Some(Wish::Go(Motion::Light { right, up }));
        match event {
            SimulatorEvent::Quit => Some(Wish::Close),
            SimulatorEvent::MouseMove { point } => {
                self.pointer = point;
                None
            }
            SimulatorEvent::MouseButtonDown { mouse_btn: MouseButton::Left, point } => {
                pan(point.x - middle.x, middle.y - point.y)
            }
            SimulatorEvent::MouseWheel { scroll_delta, direction } => {
                let up = scroll_delta.y * if direction == MouseWheelDirection::Flipped { -1 } else { 1 };
                if up == 0 { None } else { zoom(Some(self.pointer), up > 0) }
            }
            SimulatorEvent::KeyDown { keycode, .. } => match keycode {
                Keycode::Left | Keycode::A => pan(-step, 0),
                Keycode::Right | Keycode::D => pan(step, 0),
                Keycode::Up | Keycode::W => pan(0, step),
                Keycode::Down | Keycode::S => pan(0, -step),
                Keycode::Plus | Keycode::Equals | Keycode::KpPlus => zoom(None, true),
                Keycode::Minus | Keycode::KpMinus => zoom(None, false),
                Keycode::RightBracket => Some(Wish::Go(Motion::Iterate { more: true })),
                Keycode::LeftBracket => Some(Wish::Go(Motion::Iterate { more: false })),
                Keycode::J => light(-step, 0),
                Keycode::L => light(step, 0),
                Keycode::I => light(0, step),
                Keycode::K => light(0, -step),
                Keycode::R => Some(Wish::Reload),
                Keycode::Return | Keycode::KpEnter => Some(Wish::Save),
                Keycode::PageDown | Keycode::N => Some(Wish::Next),
                Keycode::PageUp | Keycode::P => Some(Wish::Previous),
                _ => None,
            },
            _ => None,
        }
    }
}

fn middle(size: Size) -> Point {
    Point::new(size.width as i32 / 2, size.height as i32 / 2)
}
