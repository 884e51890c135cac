// What all methods of ambient occlusion are told.
struct AoParams {
  vec4 radii;   // x: R in world metres; y: number of radii (R, R/2, R/4, ...); z: number of samples; w: seed
  vec4 options; // x: least number of samples far away, 0: as many everywhere; y: guard band that is drawn (px); zw unused
};
