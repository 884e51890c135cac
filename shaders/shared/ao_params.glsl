// The sample set of the sphere method.
struct AoParams {
  vec4 radii;   // x: R in world metres; y: number of radii (R, R/2, R/4, ...); z: number of samples; w: seed
};
