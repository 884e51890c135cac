// What all methods of ambient occlusion are told.
struct AoParams {
  vec4 radii;   // x: R in world metres; y: number of radii (R, R/2, R/4, ...); z: number of samples; w: seed
  vec4 noise;   // origin of surface_noise(), xyz: the ROI centre along its axes, modulo the longest run (m); w: that run's exponent
  vec4 options; // x: least number of samples far away, 0: as many everywhere; y: guard band that is drawn (px); zw unused
};
