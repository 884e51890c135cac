// The plane of one triangle in physical space: normal . P = offset; the normal points to its front.
struct PrimitivePlane {
  vec4 normal_offset;  // unit normal, offset (m)
  vec4 z_range;        // x: smallest, y: largest physical z of the scene's triangle that it is a part of; zw unused
};
