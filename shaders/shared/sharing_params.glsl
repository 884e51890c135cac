// What a module shares with its neighbours. Entry i tells it of layer i; its `rank` is of the i-th of all sharing modules, from left to right.
struct SharingParams {
  vec4 window;  // x, y: first and last rank of the layer's neighbours, itself among them; z: its first sample; w unused
  vec4 turn;    // xyz: added to the surface's noise, modulo 1; w unused
  vec4 rank;    // x: the layer that has the rank i; yzw unused
};
