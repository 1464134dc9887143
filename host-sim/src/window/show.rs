//! The window itself: shows what is drawn, grants wishes.
//!
//! The thread of the window computes nothing: it shows what the painter has done and listens to the keys. A
//! wish ends the picture that is being drawn;
//! the last one stays, moved or scaled, until rows of the next one cover it.

use std::collections::VecDeque;
use std::io::Write as _;
use std::path::PathBuf;
use std::thread;
use std::time::{Duration, Instant};

use embedded_graphics_simulator::{OutputSettingsBuilder, SimulatorDisplay, Window as Screen};

use super::hand::{Hand, Wish};
use super::moved::moved;
use super::painter::{Painter, Work};
use crate::builtin;
use crate::canvas;
use crate::cli::{KEYS, Look, Window};
use crate::color::{Depth, with_depth};
use crate::fail::{Fail, say};
use crate::output;
use crate::scene::{self, Request, Scene};

/// Time between two looks at the keys.
const LISTEN: Duration = Duration::from_millis(8);
/// Time after which a picture is shown again: another window may have lain over it.
const REFRESH: Duration = Duration::from_millis(250);

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
    let request = Request { size: look.size, seed: look.seed };
    let mut view = View { screen: Screen::new("attractor", &settings), last: Instant::now() };
    let mut hand = Hand::new(look.size);
    let (mut scene, mut display) = (first, SimulatorDisplay::<C>::new(look.size));
    let mut wishes = VecDeque::new();
    let mut is_first = true;
    view.show(&display);
    loop {
        let mut painter = Painter::start(scene, display.clone(), request);
        while !painter.is_done() {
            match painter.frame() {
                Some(frame) => {
                    view.show(&frame);
                    display = frame;
                }
                None => view.wait(&display),
            }
            wishes.extend(hand.wishes(&view.screen));
            if wishes.contains(&Wish::Close) {
                // nobody waits for the painter
                return Ok(());
            }
            // what is to be saved is finished first
            if wishes.front().is_some_and(|wish| *wish != Wish::Save) {
                painter.stop();
            }
        }
        // a picture that was left half done is drawn again
        let mut changed = painter.is_stopped();
        let work = painter.work()?;
        let Work { done, .. } = work;
        (scene, display) = (work.scene, work.display);
        match done {
            Err(Fail::Message(message)) if !is_first => say(&message),
            done => done?,
        }
        is_first = false;
        view.show(&display);
        loop {
            while let Some(&wish) = wishes.front() {
                if changed && wish == Wish::Save {
                    // what is to be saved has yet to be drawn
                    break;
                }
                wishes.pop_front();
                let turn_to = |at: usize| scene::load(names.get(at).copied().unwrap_or_default());
                let blank = || SimulatorDisplay::new(look.size);
                let done = match wish {
                    Wish::Close => return Ok(()),
                    Wish::Save => save(&scene, &display, look),
                    Wish::Go(motion) => scene.go(look.size, motion).map(|()| {
                        if scene.is_flat() {
                            display = moved(&display, motion);
                        }
                    }),
                    Wish::Reload => turn_to(at).map(|read| (scene, display) = (read, blank())),
                    Wish::Next => {
                        at = (at + 1) % names.len();
                        turn_to(at).map(|read| (scene, display) = (read, blank()))
                    }
                    Wish::Previous => {
                        at = at.checked_sub(1).unwrap_or(names.len() - 1);
                        turn_to(at).map(|read| (scene, display) = (read, blank()))
                    }
                };
                // a wish that cannot be granted is no reason to close the window
                match done {
                    Err(Fail::Message(message)) => say(&message),
                    Err(pipe) => return Err(pipe),
                    Ok(()) => changed |= wish != Wish::Save,
                }
            }
            if changed {
                break;
            }
            view.wait(&display);
            wishes.extend(hand.wishes(&view.screen));
        }
        view.show(&display);
    }
}

/// The screen, and when something was last shown on it.
struct View {
    screen: Screen,
    last: Instant,
}

impl View {
    fn show<C: Depth>(&mut self, display: &SimulatorDisplay<C>) {
        self.screen.update(display);
        self.last = Instant::now();
    }

    /// Waits a little; what is shown stays.
    fn wait<C: Depth>(&mut self, display: &SimulatorDisplay<C>) {
        thread::sleep(LISTEN);
        if self.last.elapsed() >= REFRESH {
            self.show(display);
        }
    }
}

/// The picture as a file, and on standard output what a scene file says to come back here.
fn save<C: Depth>(scene: &Scene, display: &SimulatorDisplay<C>, look: &Look) -> Result<(), Fail> {
    let bytes = canvas::png(display, look.scale)
        .map_err(|error| Fail::new(format_args!("{}: {error}", scene.name)))?;
    let free = (1..).map(|n| PathBuf::from(format!("{}-{n}.png", scene.name))).find(|path| !path.exists());
    let path = free.unwrap_or_default();
    output::write(&path, &bytes)?;
    let mut out = std::io::stdout().lock();
    writeln!(out, "{}", path.display())?;
    write!(out, "{}", scene.place(look.size).unwrap_or_default())?;
    Ok(())
}
