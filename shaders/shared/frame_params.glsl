// What all modules share in a frame. The world is counted from the ROI centre: world points here are world minus roi_centre.
struct FrameParams {
  vec4 physical_from_world_0;  // rows of the map's linear part; w: its offset, so P = row . (world - roi_centre, 1)
  vec4 physical_from_world_1;
  vec4 physical_from_world_2;
  vec4 world_from_physical_0;  // rows of the inverse: world - roi_centre = row . (P, 1)
  vec4 world_from_physical_1;
  vec4 world_from_physical_2;
  vec4 depth;                  // x: front limit, y: scale, so that clip.z = scale * (front - depth); z: back limit; w: px of tessellation
  vec4 background;             // linear r g b; w: number of lights
  vec4 ambient_occlusion;      // a, b, c of the curve; w: 0 ao off, 1 multiplies ambient light, 2 multiplies the whole colour
};
