// One material.
struct MaterialParams {
  vec4 base_color;      // linear r g b a
  vec4 uv_transform_0;  // rows of the 2x3 matrix applied to (u, v, 1); w of the first: layer in the texture array, or -1
  vec4 uv_transform_1;
  vec4 alpha;           // x: cutoff, or -1; yzw unused
};
