//! Scenes made by our own generator.
