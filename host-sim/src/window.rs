//! `attractor window`: scenes on a simulated display, row by row as they are computed.

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
    use std::time::{Duration, Instant};

    use embedded_graphics_simulator::sdl2::Keycode;
    use embedded_graphics_simulator::{
        OutputSettingsBuilder, SimulatorDisplay, SimulatorEvent, Window as Screen,
    };

    use crate::builtin;
    use crate::cli::{Look, Window};
    use crate::color::{Depth, with_depth};
    use crate::fail::Fail;
    use crate::scene::{self, Request, Scene};

    /// Time between two looks at the keys while a picture is drawn.
    const FRAME: Duration = Duration::from_millis(16);

    /// What the keys ask for.
    #[derive(Debug, Clone, Copy, PartialEq, Eq)]
    enum Wish {
        Stay,
        Next,
        Previous,
        Close,
    }

    /// Shows a scene; the built-in ones follow.
    pub(crate) fn run(args: &Window) -> Result<(), Fail> {
        let first = scene::load(&args.scene)?;
        let mut names: Vec<&str> = builtin::SCENES.iter().map(|(name, _)| *name).collect();
        let at = names.iter().position(|name| *name == args.scene).unwrap_or_else(|| {
            names.insert(0, &args.scene);
            0
        });
        with_depth!(args.look.color, show, &args.look, &names, at, first)
    }

    fn show<C: Depth>(look: &Look, names: &[&str], mut at: usize, first: Scene) -> Result<(), Fail> {
        let settings = OutputSettingsBuilder::new().scale(look.scale).build();
        let mut screen = Screen::new("attractor", &settings);
        let mut scene = first;
        loop {
            let mut display = SimulatorDisplay::<C>::new(look.size);
            screen.update(&display);
            let mut wish = Wish::Stay;
            let mut last = Instant::now();
            let request = Request { size: look.size, seed: look.seed };
            scene.draw(&request, &mut display, &mut |display: &mut SimulatorDisplay<C>, _, _| {
                if last.elapsed() >= FRAME {
                    screen.update(display);
                    wish = wished(&screen);
                    last = Instant::now();
                }
                wish == Wish::Stay
            })?;
            while wish == Wish::Stay {
                // waits for the next frame
                screen.update(&display);
                wish = wished(&screen);
            }
            at = match wish {
                Wish::Close => return Ok(()),
                Wish::Previous => at.checked_sub(1).unwrap_or(names.len() - 1),
                _ => (at + 1) % names.len(),
            };
            scene = scene::load(names.get(at).copied().unwrap_or_default())?;
        }
    }

    /// The last wish among the events that are waiting. The simulator itself turns Esc into a request to quit.
    fn wished(screen: &Screen) -> Wish {
        let mut wish = Wish::Stay;
        for event in screen.events() {
            match event {
                SimulatorEvent::Quit => return Wish::Close,
                SimulatorEvent::KeyDown { keycode: Keycode::Right | Keycode::Down, .. } => wish = Wish::Next,
                SimulatorEvent::KeyDown { keycode: Keycode::Left | Keycode::Up, .. } => wish = Wish::Previous,
                _ => {}
            }
        }
        wish
    }
}
