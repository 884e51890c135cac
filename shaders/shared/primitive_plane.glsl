// One triangle as a fragment needs it: its plane in physical space, normal . P = offset, and where on the plane the scene's triangle
// lies that it is a part of. The normal points to its front.
struct PrimitivePlane {
  vec4 normal_offset;  // unit normal, offset (m)
  vec4 range;          // x: smallest, y: largest physical z of the scene's triangle; z: constant of the third coordinate; w: square
                       // of the sine of the angle between line and plane below which a pixel may be off the triangle, on its
                       // plane, by more than the slack
  vec4 inside_0;       // first two barycentric coordinates in that triangle, each raised by the slack: gradient (1/m), constant;
  vec4 inside_1;       // the third is range.z minus both. None is negative in the triangle or within the slack of it
};
