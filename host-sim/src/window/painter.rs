//! A picture that is drawn in a thread of its own, so that the window answers meanwhile.

use std::sync::mpsc::{Receiver, TrySendError, sync_channel};
use std::thread::{self, JoinHandle};
use std::time::{Duration, Instant};

use embedded_graphics_simulator::SimulatorDisplay;

use crate::color::Depth;
use crate::fail::Fail;
use crate::scene::{Request, Scene};

/// Time between two frames of a picture that is being drawn.
pub(super) const FRAME: Duration = Duration::from_millis(40);

/// At work on a scene, which is lent to it.
pub(super) struct Painter<C: Depth> {
    /// The picture as far as it is; given up when nobody wants it any more, which ends the work.
    frames: Option<Receiver<SimulatorDisplay<C>>>,
    thread: JoinHandle<Work<C>>,
}

/// What a painter hands back.
pub(super) struct Work<C: Depth> {
    pub(super) scene: Scene,
    pub(super) display: SimulatorDisplay<C>,
    /// Why there is no picture.
    pub(super) done: Result<(), Fail>,
}

impl<C: Depth> Painter<C> {
    /// Begins to draw over what is on the display.
    pub(super) fn start(scene: Scene, mut display: SimulatorDisplay<C>, request: Request) -> Self {
        let (sender, frames) = sync_channel(1);
        let thread = thread::spawn(move || {
            let mut last = Instant::now();
            let done = scene.draw(&request, &mut display, &mut |display: &mut SimulatorDisplay<C>, _, _| {
                if last.elapsed() < FRAME {
                    return true;
                }
                last = Instant::now();
                // a frame that nobody has fetched yet is not replaced
                !matches!(sender.try_send(display.clone()), Err(TrySendError::Disconnected(_)))
            });
            Work { scene, display, done }
        });
        Self { frames: Some(frames), thread }
    }

    /// What has been drawn since the last time.
    pub(super) fn frame(&self) -> Option<SimulatorDisplay<C>> {
        self.frames.as_ref()?.try_recv().ok()
    }

    /// Asks for no more: the work ends after its next portion.
    pub(super) fn stop(&mut self) {
        self.frames = None;
    }

    /// Whether the work ends, or has ended, before the picture is complete.
    pub(super) fn is_stopped(&self) -> bool {
        self.frames.is_none()
    }

    /// Whether nobody would have to wait for the work.
    pub(super) fn is_done(&self) -> bool {
        self.thread.is_finished()
    }

    /// The work, finished or stopped.
    pub(super) fn work(self) -> Result<Work<C>, Fail> {
        self.thread.join().map_err(|_| Fail::new("window: the picture could not be drawn"))
    }
}
