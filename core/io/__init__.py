"""Files in and out: the project file, shapes from other programs, frames for other programs."""
