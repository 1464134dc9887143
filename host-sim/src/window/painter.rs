//! A picture that is drawn in a thread of its own, so that the window answers meanwhile.
//!
//! It is copied only when it is asked for.

use std::sync::mpsc::{Receiver, Sender, TryRecvError, channel};
use std::thread::{self, JoinHandle};

use embedded_graphics_simulator::SimulatorDisplay;

use crate::color::Depth;
use crate::fail::Fail;
use crate::scene::{Request, Scene};

/// At work on a scene, which is lent to it.
pub(super) struct Painter<C: Depth> {
    /// Asks for the picture as far as it is; given up when nobody wants it any more, which ends the work.
    requests: Option<Sender<()>>,
    frames: Receiver<SimulatorDisplay<C>>,
    /// Whether there has been no answer yet.
    is_asked: bool,
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
        let (requests, requested) = channel();
        let (sender, frames) = channel();
        let thread = thread::spawn(move || {
            let watch = &mut |display: &mut SimulatorDisplay<C>, _, _| match requested.try_recv() {
                Ok(()) => sender.send(display.clone()).is_ok(),
                Err(TryRecvError::Empty) => true,
                Err(TryRecvError::Disconnected) => false,
            };
            let done = scene.draw(&request, &mut display, watch);
            Work { scene, display, done }
        });
        Self { requests: Some(requests), frames, is_asked: false, thread }
    }

    /// Asks for what has been drawn, unless it has been asked already.
    pub(super) fn ask(&mut self) {
        if let Some(requests) = self.requests.as_ref().filter(|_| !self.is_asked) {
            // a painter that has just ended answers with its work
            self.is_asked = requests.send(()).is_ok();
        }
    }

    /// The answer, if it is there.
    pub(super) fn frame(&mut self) -> Option<SimulatorDisplay<C>> {
        let frame = self.frames.try_recv().ok();
        self.is_asked &= frame.is_none();
        frame
    }

    /// Asks for no more: the work ends after its next portion.
    pub(super) fn stop(&mut self) {
        self.requests = None;
    }

    /// Whether the work ends, or has ended, before the picture is complete.
    pub(super) fn is_stopped(&self) -> bool {
        self.requests.is_none()
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
