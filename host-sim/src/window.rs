//! `attractor window`: scenes on a simulated display, row by row as they are computed, and a way to move about in them.

#[cfg(not(feature = "window"))]
pub(crate) use without::run;

#[cfg(feature = "window")]
pub(crate) use with_sdl::run;

#[cfg(not(feature = "window"))]
mod without {
    use crate::cli::Window;
    use crate::fail::Fail;

    /// Says how to get a window.
    pub(crate) fn run(args: &Window) -> Result<(), Fail> {
        crate::scene::load(&args.scene)?;
        Err(Fail::new(
            "window: built without the feature `window`: apt install libsdl2-dev, then \
             cargo run --release -p attractor-sim --features window -- window SCENE",
        ))
    }
}

#[cfg(feature = "window")]
mod with_sdl {
    use std::io::Write as _;
    use std::path::PathBuf;
    use std::time::{Duration, Instant};

    use embedded_graphics::geometry::{Point, Size};
    use embedded_graphics_simulator::sdl2::{Keycode, MouseButton, MouseWheelDirection};
    use embedded_graphics_simulator::{
        OutputSettingsBuilder, SimulatorDisplay, SimulatorEvent, Window as Screen,
    };

    use crate::builtin;
    use crate::canvas;
    use crate::cli::{KEYS, Look, Window};
    use crate::color::{Depth, with_depth};
    use crate::fail::{Fail, say};
    use crate::output;
    use crate::scene::{self, Motion, Request, Scene};

    /// Time between two looks at the keys while a picture is drawn.
    const FRAME: Duration = Duration::from_millis(16);

    /// What the keys and the mouse ask for.
    #[derive(Debug, Clone, Copy, PartialEq, Eq)]
    enum Wish {
        Next,
        Previous,
        Go(Motion),
        /// The scene as it was, its file read again.
        Reload,
        Save,
        Close,
    }

    impl Wish {
        /// Whether the picture that is being drawn is no longer wanted.
        fn ends_the_picture(self) -> bool {
            self != Self::Save
        }
    }

    /// Shows a scene; the built-in ones follow.
    pub(crate) fn run(args: &Window) -> Result<(), Fail> {
        let first = scene::load(&args.scene)?;
        let mut names: Vec<&str> = builtin::SCENES.iter().map(|(name, _)| *name).collect();
        let at = names.iter().position(|name| *name == args.scene).unwrap_or_else(|| {
            names.insert(0, &args.scene);
            0
        });
        // nobody listening is no error
        let _ = writeln!(std::io::stderr(), "{KEYS}");
        with_depth!(args.look.color, show, &args.look, &names, at, first)
    }

    fn show<C: Depth>(look: &Look, names: &[&str], mut at: usize, first: Scene) -> Result<(), Fail> {
        let settings = OutputSettingsBuilder::new().scale(look.scale).build();
        let mut screen = Screen::new("attractor", &settings);
        let mut hand = Hand { size: look.size, pointer: middle(look.size) };
        let mut scene = first;
        loop {
            let mut display = SimulatorDisplay::<C>::new(look.size);
            screen.update(&display);
            let mut wishes = Vec::new();
            let mut last = Instant::now();
            let request = Request { size: look.size, seed: look.seed };
            scene.draw(&request, &mut display, &mut |display: &mut SimulatorDisplay<C>, _, _| {
                if last.elapsed() >= FRAME {
                    screen.update(display);
                    wishes.extend(hand.wishes(&screen));
                    last = Instant::now();
                }
                !wishes.iter().any(|wish: &Wish| wish.ends_the_picture())
            })?;
            // a picture that was left half done is drawn again
            let mut changed = wishes.iter().any(|wish| wish.ends_the_picture());
            loop {
                for wish in wishes.drain(..) {
                    let turn_to = |at: usize| scene::load(names.get(at).copied().unwrap_or_default());
                    let done = match wish {
                        Wish::Close => return Ok(()),
                        Wish::Save => save(&scene, &display, look),
                        Wish::Go(motion) => scene.go(look.size, motion),
                        Wish::Reload => turn_to(at).map(|read| scene = read),
                        Wish::Next => {
                            at = (at + 1) % names.len();
                            turn_to(at).map(|read| scene = read)
                        }
                        Wish::Previous => {
                            at = at.checked_sub(1).unwrap_or(names.len() - 1);
                            turn_to(at).map(|read| scene = read)
                        }
                    };
                    // a wish that cannot be granted is no reason to close the window
                    match done {
                        Err(Fail::Message(message)) => say(&message),
                        Err(pipe) => return Err(pipe),
                        Ok(()) => changed |= wish.ends_the_picture(),
                    }
                }
                if changed {
                    break;
                }
                // waits for the next frame
                screen.update(&display);
                wishes.extend(hand.wishes(&screen));
            }
        }
    }

    /// The picture as a file, and on standard output what a scene file says to come back here.
    fn save<C: Depth>(scene: &Scene, display: &SimulatorDisplay<C>, look: &Look) -> Result<(), Fail> {
        let bytes = canvas::png(display, look.scale)
            .map_err(|error| Fail::new(format_args!("{}: {error}", scene.name)))?;
        let free =
            (1..).map(|n| PathBuf::from(format!("{}-{n}.png", scene.name))).find(|path| !path.exists());
        let path = free.unwrap_or_default();
        output::write(&path, &bytes)?;
        let mut out = std::io::stdout().lock();
        writeln!(out, "{}", path.display())?;
        write!(out, "{}", scene.place(look.size).unwrap_or_default())?;
        Ok(())
    }

    fn middle(size: Size) -> Point {
        Point::new(size.width as i32 / 2, size.height as i32 / 2)
    }

    /// Remembers where the mouse is.
    struct Hand {
        size: Size,
        pointer: Point,
    }

    impl Hand {
        /// The wishes among the events that are waiting. The simulator itself turns Esc into a request to quit.
        fn wishes(&mut self, screen: &Screen) -> Vec<Wish> {
            screen.events().filter_map(|event| self.wish(event)).collect()
        }

        fn wish(&mut self, event: SimulatorEvent) -> Option<Wish> {
            let middle = middle(self.size);
            // an eighth of the shorter side
            let step = (self.size.width.min(self.size.height) / 8).max(1) as i32;
            let pan = |right: i32, up: i32| Some(Wish::Go(Motion::Pan { right, up }));
            let zoom = |about: Option<Point>, closer: bool| Some(Wish::Go(Motion::Zoom { about, closer }));
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
}
