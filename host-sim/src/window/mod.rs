//! `attractor window`: scenes on a simulated display, row by row as they are computed, and a way to move
//! about in them.

#[cfg(feature = "window")]
mod hand;
#[cfg(any(feature = "window", test))]
mod moved;
#[cfg(feature = "window")]
mod painter;
#[cfg(feature = "window")]
mod show;

#[cfg(not(feature = "window"))]
pub(crate) use without::run;

#[cfg(feature = "window")]
pub(crate) use show::run;

#[cfg(not(feature = "window"))]
mod without {
    use crate::cli::Window;
    use crate::fail::Fail;

    /// Says how to get a window.
    pub(crate) fn run(args: &Window) -> Result<(), Fail> {
        crate::scene::load(&args.scene)?;
        Err(Fail::new(
            "window: built without the feature `window`: apt install libsdl2-dev, then \
             cargo run --features window -- window SCENE",
        ))
    }
}
