// The special screen forward and backward: GLSL twins of calibration/optics.h (design geometry, section 2).

// k of the conical and linear diffuser for a screen point at height sy.
float convergence(ModuleParams m, float sy) {
  if (m.observer.z == 0.0) return m.observer.y / -m.emitter.z;
  return length(vec2(m.observer.x - sy, m.observer.y)) / length(vec2(sy - m.emitter.y, m.emitter.z));
}

// The homogeneous weight 1 + k z / vz of a point at height z whose screen point is at height sy; positive where it has an image.
float homogeneous_w(ModuleParams m, float z, float sy) {
  if (m.observer.z == 0.0) return (z - m.emitter.z) / -m.emitter.z;
  return 1.0 + convergence(m, sy) * (z / m.observer.y);
}

// Screen point (xy) of a physical point and its homogeneous weight (z). No image: weight <= 0, or z beyond the observer.
vec3 screen_from_physical(ModuleParams m, vec3 p) {
  float sy = m.observer.x + (p.y - m.observer.x) * (m.observer.y / (m.observer.y - p.z));
  float w = homogeneous_w(m, p.z, sy);
  return vec3(m.emitter.x + (p.x - m.emitter.x) / w, sy, w);
}

// Direction of the pixel's own line: from the screen point to the observer line.
vec3 line_direction(ModuleParams m, vec2 s) {
  float ox = s.x + (s.x - m.emitter.x) * convergence(m, s.y);
  return vec3(ox - s.x, m.observer.x - s.y, m.observer.y);
}
