// How alike two surfaces are for a blur that keeps edges (Aalund 2013, "A comparative study of screen-space ambient occlusion methods",
// section 5.3). Needs shared/frame_params.glsl.

// How far apart two world points are along physical z, in metres of the world.
float depth_between(FrameParams frame, vec3 a, vec3 b) {
  vec3 along_z = frame.physical_from_world_2.xyz;
  return abs(dot(along_z, b - a)) / length(along_z);
}

// (0.5 + 0.5 n1.n2)^10 / (1 + 10 |dz| / R)^0.5 of unit normals.
float likeness(vec3 n1, vec3 n2, float apart_m, float radius_m) {
  return pow(0.5 + 0.5 * clamp(dot(n1, n2), -1.0, 1.0), 10.0) * inversesqrt(1.0 + 10.0 * apart_m / radius_m);
}
