// The special screen forward and backward: GLSL twins of calibration/optics.h and calibration/curved_screen.h. Software rasterisers
// compute both sides of every condition, so what no module has may be left out: flags PLANAR_SCREEN, LINEAR_DIFFUSER.
#include "lib/series.glsl"

// k of the conical and linear diffuser for a screen point at height sy.
float convergence(ModuleParams m, float sy) {
#ifdef LINEAR_DIFFUSER
  return m.observer.y / -m.emitter.z;
#else
  if (m.observer.z == 0.0) return m.observer.y / -m.emitter.z;
  return length(vec2(m.observer.x - sy, m.observer.y)) / length(vec2(sy - m.emitter.y, m.emitter.z));
#endif
}

#ifdef PLANAR_SCREEN
bool is_curved(ModuleParams m) { return false; }
#else
bool is_curved(ModuleParams m) { return m.surface.x != 0.0; }
#endif

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

// The horizontal ray from the emitter along a unit vector, by path lengths from a point on it, not from the emitter, which may be 1e6 m
// away: to the screen (x; negative where that lies behind the point) and to the observers (y; -1e30 where there are none).
vec2 curved_ray(ModuleParams m, vec2 from, vec2 direction) {
  float to_observers = m.surface.y != 0.0 ? rise_through(m, from, direction, m.surface.y)
                     : direction.y > 0.0 ? (m.observer.y - from.y) / direction.y : -1e30;
  return vec2(rise_through(m, from, direction, 0.0), to_observers);
}

// Where a physical point is shown: screen point (xy), weight w (z) and depth in metres (w). No image: weight <= 0, or a depth beyond
// the observers.
vec4 screen_from_physical(ModuleParams m, vec3 p) {
  if (is_curved(m)) {
    vec2 to = p.xz - m.emitter.xz;
    float from_emitter = length(to);
    vec2 direction = to / from_emitter;
    vec2 ray = curved_ray(m, p.xz, direction);
    float to_screen = from_emitter + ray.x;
    if (!(from_emitter > 0.0 && to_screen > 0.0 && ray.y > ray.x && ray.y > 0.0)) return vec4(0.0, 0.0, -1.0, 0.0);
    vec2 at = p.xz + ray.x * direction;
    vec2 normal = outward(m, at);
    if (!(normal.y > 0.0)) return vec4(0.0, 0.0, -1.0, 0.0);
    return vec4(at.x / normal.y * atan_over(normal.x / normal.y), p.y + (p.y - m.observer.x) * (-ray.x / ray.y), from_emitter / to_screen,
                m.observer.y * (-ray.x / (ray.y - ray.x)));
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
  float half_angle = 0.5 * m.surface.x * s.x;  // at most pi / 4 on the half that faces the viewer
  vec2 turn = sine_over_and_cosine(half_angle);
  float chord = s.x * turn.x;
  return vec3(chord * turn.y, s.y, -chord * turn.x * half_angle);
}

// Direction of the pixel's own line: from the screen point to the observers, in units of which depth is observer.y. Zero where the
// emitter does not light the point toward them.
vec3 line_direction(ModuleParams m, vec2 s) {
  if (is_curved(m)) {
    vec2 at = surface_point(m, s).xz;
    vec2 direction = normalize(at - m.emitter.xz);
    float to_observers = curved_ray(m, at, direction).y;
    if (!(dot(outward(m, at), direction) > 0.0 && to_observers > 0.0)) return vec3(0.0);
    vec2 along = to_observers * direction;
    return vec3(along.x, m.observer.x - s.y, along.y);
  }
  return vec3((s.x - m.emitter.x) * convergence(m, s.y), m.observer.x - s.y, m.observer.y);
}
