// The groups of the stability suite, in the order of the table.
#pragma once

#include "bench/stability/case.h"

namespace lfd::bench {

// Points that approach the planes where the optics end (calibration/optics.h).
void add_limit_cases(StabilityCases& cases);
// Regions of interest far away, flat, empty or turned by something else than a rotation.
void add_roi_cases(StabilityCases& cases);
// Cylindrical screens from a centimetre to a million kilometres.
void add_radius_cases(StabilityCases& cases);
// Measured grids with folds, holes and nonsense.
void add_grid_cases(StabilityCases& cases);
// Pinholes whose distortion turns back.
void add_distortion_cases(StabilityCases& cases);
// Bad numbers in every field of calibrations, regions of interest, settings and deployments.
void add_field_cases(StabilityCases& cases);
// Bad numbers in scenes and in requests of control clients.
void add_scene_field_cases(StabilityCases& cases);
// Bad numbers in observations, in MPCDI archives, in other programs' models, and in files of measured grids.
void add_text_field_cases(StabilityCases& cases);
void add_mpcdi_field_cases(StabilityCases& cases);
void add_model_field_cases(StabilityCases& cases);
void add_grid_file_field_cases(StabilityCases& cases);
// Float on the GPU against double: the map's functions near their limits.
void add_gpu_map_cases(StabilityCases& cases);
// Emitters near the screen, far from it, and at and below the observer's height, as pictures.
void add_module_cases(StabilityCases& cases);
// Pictures at the ends of the limits of calibration/limits.h.
void add_end_cases(StabilityCases& cases);
// Pictures through measured grids with folds and holes, and through lenses that turn back.
void add_map_picture_cases(StabilityCases& cases);
// Whole pictures of far, flat and tiny regions of interest.
void add_picture_cases(StabilityCases& cases);
// Triangles without area, too small, too large, and through every limit.
void add_triangle_cases(StabilityCases& cases);
// Ambient occlusion with radii beyond reason.
void add_occlusion_cases(StabilityCases& cases);

}  // namespace lfd::bench
