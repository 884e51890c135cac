// The special screen forward and backward: GLSL twins of calibration/optics.h and calibration/curved_screen.h.

// k of the conical and linear diffuser for a screen point at height sy.
float convergence(ModuleParams m, float sy) {
  if (m.observer.z == 0.0) return m.observer.y / -m.emitter.z;
  return length(vec2(m.observer.x - sy, m.observer.y)) / length(vec2(sy - m.emitter.y, m.emitter.z));
}

bool is_curved(ModuleParams m) { return m.surface.x != 0.0; }

// f of a point (x, z): 0 on a curved screen, growing toward the viewer, constant on concentric arcs; in metres.
float level_of(ModuleParams m, vec2 q) { return q.y + 0.5 * m.surface.x * dot(q, q); }

// Direction in which f grows; of length 1 on the screen.
vec2 outward(ModuleParams m, vec2 q) { return vec2(m.surface.x * q.x, 1.0 + m.surface.x * q.y); }

// How far from `from` along the unit vector `direction` f grows through `level`; -1e30 where it never does.
float rise_through(ModuleParams m, vec2 from, vec2 direction, float level) {
  float a = 0.5 * m.surface.x;
  float b = dot(outward(m, from), direction);
  float c = level_of(m, from) - level;
  float discriminant = b * b - 4.0 * a * c;
  if (!(discriminant > 0.0)) return -1e30;
  float root = sqrt(discriminant);
  return b > 0.0 ? -2.0 * c / (b + root) : (root - b) / (2.0 * a);
}

// The horizontal ray from the emitter along a unit vector: path lengths to the screen (x) and to the observers (y); not 0 < x < y
// where it does not light the screen toward them.
vec2 curved_ray(ModuleParams m, vec2 direction) {
  vec2 from = m.emitter.xz;
  float to_observers = m.surface.y != 0.0 ? rise_through(m, from, direction, m.surface.y)
                     : direction.y > 0.0 ? (m.observer.y - from.y) / direction.y : -1e30;
  return vec2(rise_through(m, from, direction, 0.0), to_observers);
}

// Where a physical point is shown: screen point (xy), weight w (z) and depth in metres (w). No image: weight <= 0, or a depth beyond
// the observers.
vec4 screen_from_physical(ModuleParams m, vec3 p) {
  if (is_curved(m)) {
    vec2 from = m.emitter.xz, to = p.xz - from;
    float to_point = length(to);
    vec2 direction = to / to_point;
    vec2 ray = curved_ray(m, direction);
    if (!(to_point > 0.0 && ray.x > 0.0 && ray.y > ray.x && to_point < ray.y)) return vec4(0.0, 0.0, -1.0, 0.0);
    vec2 normal = outward(m, from + ray.x * direction);
    if (!(normal.y > 0.0)) return vec4(0.0, 0.0, -1.0, 0.0);
    float whole = ray.y - ray.x;
    return vec4(atan(normal.x, normal.y) / m.surface.x,
                p.y + (p.y - m.observer.x) * ((to_point - ray.x) / (ray.y - to_point)), to_point / ray.x, m.observer.y * ((to_point - ray.x) / whole));
  }
  // As what is added to the point: observers and emitters may be 1e6 m away, where single precision has no millimetres.
  float sy = p.y + (p.y - m.observer.x) * (p.z / (m.observer.y - p.z));
  float q = convergence(m, sy) * (p.z / m.observer.y);
  float w = m.observer.z == 0.0 ? (p.z - m.emitter.z) / -m.emitter.z : 1.0 + q;
  return vec4(p.x + (m.emitter.x - p.x) * (q / w), sy, w, p.z);
}

// Depth of a point: z on a planar screen.
float depth_of(ModuleParams m, vec3 p) { return is_curved(m) ? screen_from_physical(m, p).w : p.z; }

// A point of the screen's surface in space.
vec3 surface_point(ModuleParams m, vec2 s) {
  if (!is_curved(m)) return vec3(s, 0.0);
  float half_angle = 0.5 * m.surface.x * s.x;
  float chord = half_angle == 0.0 ? s.x : s.x * sin(half_angle) / half_angle;
  return vec3(chord * cos(half_angle), s.y, -chord * sin(half_angle));
}

// Direction of the pixel's own line: from the screen point to the observers, in units of which depth is observer.y. Zero where the
// emitter does not light the point toward them.
vec3 line_direction(ModuleParams m, vec2 s) {
  if (is_curved(m)) {
    vec2 at = surface_point(m, s).xz;
    vec2 direction = normalize(at - m.emitter.xz);
    vec2 ray = curved_ray(m, direction);
    if (!(dot(outward(m, at), direction) > 0.0 && ray.x > 0.0 && ray.y > ray.x)) return vec3(0.0);
    vec2 along = (ray.y - ray.x) * direction;
    return vec3(along.x, m.observer.x - s.y, along.y);
  }
  return vec3((s.x - m.emitter.x) * convergence(m, s.y), m.observer.x - s.y, m.observer.y);
}
