//! Opens glTF files.
