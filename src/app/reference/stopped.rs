//! A run that ended before all of its samples were there.

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Cause {
    /// A person has stopped it.
    Person,
    /// What is shown is no longer what it traced.
    PictureGone,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Stopped {
    pub cause: Cause,
    /// A pixel, at least.
    pub samples: u32,
    pub of: u32,
}

impl Stopped {
    /// What was done, and what becomes of it.
    pub fn sentence(&self) -> String {
        let Self { samples, of, .. } = self;
        match self.cause {
            Cause::Person => {
                format!("Stopped at {samples} of {of}: what is traced is kept, and Start goes on from there.")
            }
            Cause::PictureGone => format!(
                "Stopped at {samples} of {of}, for the picture has changed. Back at that picture, Start goes on from there."
            ),
        }
    }
}
