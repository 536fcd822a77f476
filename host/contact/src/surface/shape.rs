//! What a surface is, and the one way from it to an array of gaps.

use std::path::PathBuf;

use super::super::Cells;
use super::smooth::Offsets;
use super::{SurfaceError, height_map, rough, smooth};

/// Shape of the initial gap. Lengths are in the scene's units.
#[derive(Clone, Debug, PartialEq)]
pub enum Shape {
    /// Paraboloid of this radius at its apex, gap = r^2 / 2R; in 2-D the parabola x^2 / 2R.
    Sphere {
        /// Radius R.
        radius: f64,
    },
    /// Parabolic cylinder with its axis along y, gap = x^2 / 2R.
    Cylinder {
        /// Radius R.
        radius: f64,
    },
    /// Cone, gap = r tan(angle); in 2-D a wedge.
    Cone {
        /// Degrees between the flank and the plane, between 0 and 90.
        angle: f64,
    },
    /// No gap where |x| <= width/2, in 3-D r <= width/2; beyond, never contact (an infinite gap).
    FlatPunch {
        /// Width, or diameter in 3-D.
        width: f64,
    },
    /// Waves of height amplitude * cos(2 pi kx x / Lx) * cos(2 pi ky y / Ly), x and y from the apex, which is a crest;
    /// gap = amplitude - height. A direction without waves has the factor 1.
    Wavy {
        /// Height from mean to crest.
        amplitude: f64,
        /// Waves per size of the grid in x and y; the second is not read in 2-D.
        waves: [u64; 2],
    },
    /// Self-affine random roughness, gap = largest height - height; see [`rough`](super::rough).
    Rough {
        /// Hurst exponent, above 0 and up to 1.
        hurst: f64,
        /// Root mean square of the slope, in 3-D of the gradient's length.
        rms_slope: f64,
        /// Wave number, in waves per size in x, up to which the spectrum is flat.
        roll_off: f64,
        /// Largest wave number, in waves per size in x.
        cut_off: f64,
        /// Seed of the phases.
        seed: u64,
    },
    /// Heights from a file, gap = largest height - height: they are those of the body above, measured downwards.
    File {
        /// The file, in `.npy`, `.csv`, `.txt` or `.asc`; see [`height_map`](super::height_map).
        path: PathBuf,
    },
}

/// A shape and its place.
#[derive(Clone, Debug, PartialEq)]
pub struct Surface {
    /// The shape.
    pub shape: Shape,
    /// Where its apex lies, from the corner of the grid (the centre of cell i lies at (i + 1/2) h; the second number is
    /// not read in 2-D); `None`: on the centre of cell n/2, counted from 0.
    pub center: Option<[f64; 2]>,
}

impl Surface {
    /// The initial gap `[cells]`, x fastest; not negative, and infinite where the bodies never touch.
    ///
    /// On a `periodic` grid the distance to the apex is that to its nearest image.
    ///
    /// # Errors
    /// Numbers that give no shape, waves that the cells cannot show, a file that cannot be read or does not fit.
    pub fn initial_gap(&self, cells: &Cells, periodic: bool) -> Result<Vec<f64>, SurfaceError> {
        let offsets = || Offsets::new(cells, self.center, periodic);
        let no_center = |shape| match self.center {
            Some(_) => Err(SurfaceError::Center { shape }),
            None => Ok(()),
        };
        match &self.shape {
            Shape::Sphere { radius } => smooth::sphere(&offsets()?, *radius),
            Shape::Cylinder { radius } => smooth::cylinder(&offsets()?, *radius),
            Shape::Cone { angle } => smooth::cone(&offsets()?, *angle),
            Shape::FlatPunch { width } => smooth::flat_punch(&offsets()?, *width),
            Shape::Wavy { amplitude, waves } => smooth::wavy(&offsets()?, *amplitude, *waves),
            Shape::Rough { hurst, rms_slope, roll_off, cut_off, seed } => {
                no_center("rough")?;
                let spectrum = rough::Spectrum {
                    hurst: *hurst,
                    rms_slope: *rms_slope,
                    roll_off: *roll_off,
                    cut_off: *cut_off,
                    seed: *seed,
                };
                Ok(below_highest(spectrum.heights(cells)?))
            }
            Shape::File { path } => {
                no_center("file")?;
                Ok(below_highest(height_map::read(path, cells)?))
            }
        }
    }

    /// Distances of the cells' centres from the apex `[cells]`, x fastest; on a `periodic` grid from its nearest image.
    ///
    /// # Errors
    /// A centre that is not finite.
    pub fn distances(&self, cells: &Cells, periodic: bool) -> Result<Vec<f64>, SurfaceError> {
        Ok(Offsets::new(cells, self.center, periodic)?.distances())
    }
}

/// The gap that a body with these heights leaves above a plane that touches its highest cell.
fn below_highest(mut heights: Vec<f64>) -> Vec<f64> {
    let highest = heights.iter().copied().fold(f64::NEG_INFINITY, f64::max);
    heights.iter_mut().for_each(|height| *height = highest - *height);
    heights
}
