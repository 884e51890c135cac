// One light, in world axes; positions are counted from the ROI centre.
struct LightParams {
  vec4 color_kind;       // r g b linear, times intensity; w: 0 ambient, 1 directional, 2 point, 3 spot
  vec4 position_range;   // w: range (m), 0 without end
  vec4 direction;        // unit, the way the light travels; w unused
  vec4 cone;             // x: scale, y: offset of the spot's angular attenuation (KHR_lights_punctual); zw unused
};
