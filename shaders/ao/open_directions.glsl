// Bent normals (Landis 2002; Klehm et al. 2011): the mean of the directions that a method finds open. Without BENT nothing is kept.

#ifdef BENT
// Sums over what is looked at for one radius: of all directions, and of what is open of them.
vec3 all_directions, open_directions;
float all_weight, open_weight;

void see_nothing_yet() {
  all_directions = open_directions = vec3(0.0);
  all_weight = open_weight = 0.0;
}

// Directions in the world on the normal's side, summed up with their weights; `open` and `open_share` are what is open of them.
void see(vec3 all, vec3 open, float share, float open_share) {
  all_directions += all;
  open_directions += open;
  all_weight += share;
  open_weight += open_share;
}

// In units of its length where all is open. What looks at few directions does not look about the normal evenly: by how much it leans
// where all is open, what is found leans too, by the share that is open of it. That is taken off again.
vec3 mean_open_direction(vec3 normal) {
  float upward = dot(all_directions, normal);
  if (upward <= 0.0) return vec3(0.0);
  return (open_directions - open_weight / all_weight * (all_directions - upward * normal)) / upward;
}
#else
void see_nothing_yet() {}
void see(vec3 all, vec3 open, float share, float open_share) {}
vec3 mean_open_direction(vec3 normal) { return vec3(0.0); }
#endif

// One direction, unit.
void see(vec3 direction, float open) { see(direction, open * direction, 1.0, open); }

// Integral of the directions (cos e, sin e) from a horizon with this sine up to the zenith, each as likely in space: of
// (cos e, sin e) cos e de.
vec2 arc_above(float sine) {
  float cosine2 = max(1.0 - sine * sine, 0.0);
  return 0.5 * vec2(1.57079632679 - asin(clamp(sine, -1.0, 1.0)) - sine * sqrt(cosine2), cosine2);
}
