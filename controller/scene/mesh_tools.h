// Small changes of triangle arrays: flat normals, mended normals, the other winding.
#pragma once

#include "proto/mesh_arrays.h"

namespace lfd::scene {

// The unit normal of a triangle, counter-clockwise seen from its tip; +z where the triangle has no area.
glm::vec3 face_normal(glm::vec3 a, glm::vec3 b, glm::vec3 c);

// Three vertices of its own for every triangle, each with the triangle's normal.
MeshArrays with_flat_normals(const MeshArrays& arrays);

// Makes normals unit length; one that is zero or not finite becomes that of a triangle that uses it.
void mend_normals(MeshArrays& arrays);

// Turns every triangle over: counter-clockwise becomes clockwise. For instances whose transform mirrors.
void swap_winding(MeshArrays& arrays);

}  // namespace lfd::scene
