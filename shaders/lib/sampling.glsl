// Per-pixel turning of sample sets, which proto/occlusion/sample_sets.h makes.

// PCG hash (Jarzynski & Olano 2020, "Hash Functions for GPU Rendering"): three well-mixed numbers of three.
uvec3 pcg3d(uvec3 v) {
  v = v * 1664525u + 1013904223u;
  v.x += v.y * v.z;
  v.y += v.z * v.x;
  v.z += v.x * v.y;
  v ^= v >> 16u;
  v.x += v.y * v.z;
  v.y += v.z * v.x;
  v.z += v.x * v.y;
  return v;
}

// A uniformly distributed rotation from three numbers in [0, 1) (Shoemake 1992): a turn about a random axis.
mat3 random_rotation(vec3 u) {
  const float two_pi = 6.28318530718;
  float a = sqrt(1.0 - u.x), b = sqrt(u.x);
  vec4 q = vec4(a * sin(two_pi * u.y), a * cos(two_pi * u.y), b * sin(two_pi * u.z), b * cos(two_pi * u.z));
  vec3 q2 = q.xyz + q.xyz;
  vec3 x = q.x * q2, y = q.y * q2, w = q.w * q2;
  float zz = q.z * q2.z;
  return mat3(1.0 - y.y - zz, x.y + w.z, x.z - w.y,
              x.y - w.z, 1.0 - x.x - zz, y.z + w.x,
              x.z + w.y, y.z - w.x, 1.0 - x.x - y.y);
}

// Three numbers in [0, 1) of a pixel of a module.
vec3 noise_of_pixel(uvec2 pixel, uint module_number, uint seed) {
  return vec3(pcg3d(uvec3(pixel, module_number + seed * 4096u)) >> 8u) * (1.0 / 16777216.0);
}

// Axes with the unit vector n as the third, the others turned about it (Duff et al. 2017, "Building an orthonormal basis, revisited").
mat3 frame_about(vec3 n, float turn) {
  float s = n.z < 0.0 ? -1.0 : 1.0;
  float a = -1.0 / (s + n.z), b = n.x * n.y * a;
  vec3 x = vec3(1.0 + s * n.x * n.x * a, s * b, -s * n.x), y = vec3(b, s + n.y * n.y * a, -n.y);
  return mat3(cos(turn) * x + sin(turn) * y, cos(turn) * y - sin(turn) * x, n);
}
