// From the light that is meant to the bytes that a module is fed: GLSL twins of calibration/color.h.

layout(std430, binding = BINDING_COLOR_SAMPLES) readonly buffer ColorSamples { float color_samples[]; };

bool has_color(ColorParams c) { return c.device_from_display_0.w != 0.0; }

vec3 gain_node(ColorParams c, ivec2 node) {
  int at = int(c.gain.z) + 3 * (node.y * int(c.gain.x) + node.x);
  return vec3(color_samples[at], color_samples[at + 1], color_samples[at + 2]);
}

// place: 0 to 1 over the image.
vec3 gain_at(ColorParams c, vec2 place) {
  vec2 at = clamp(place, vec2(0.0), vec2(1.0)) * (c.gain.xy - 1.0);
  ivec2 first = ivec2(at), last = min(first + 1, ivec2(c.gain.xy) - 1);
  vec2 share = at - vec2(first);
  vec3 upper = mix(gain_node(c, first), gain_node(c, ivec2(last.x, first.y)), share.x);
  vec3 lower = mix(gain_node(c, ivec2(first.x, last.y)), gain_node(c, last), share.x);
  return mix(upper, lower, share.y);
}

float drive_from_light(vec4 curve, float light) {
  if (curve.x == 1.0) return pow(light, curve.y);
  if (curve.x == 0.0) return light <= 0.0031308 ? light * 12.92 : 1.055 * pow(light, 1.0 / 2.4) - 0.055;
  float place = light * (curve.z - 1.0);
  int first = clamp(int(place), 0, int(curve.z) - 2), at = int(curve.y) + first;
  return mix(color_samples[at], color_samples[at + 1], place - float(first));
}

vec3 drive_for(ColorParams c, vec3 gain, vec3 light) {
  vec3 shown = gain * clamp(light, 0.0, 1.0) - c.black_level.rgb;
  vec3 device = clamp(vec3(dot(c.device_from_display_0.xyz, shown), dot(c.device_from_display_1.xyz, shown),
                           dot(c.device_from_display_2.xyz, shown)), 0.0, 1.0);
  return vec3(drive_from_light(c.curve_0, device.r), drive_from_light(c.curve_1, device.g), drive_from_light(c.curve_2, device.b));
}

// The linear value that a target with the sRGB transfer stores as the byte nearest to the drive.
vec3 stored_as(vec3 drive) {
  vec3 value = floor(drive * 255.0 + 0.5) / 255.0;
  return mix(pow((value + 0.055) / 1.055, vec3(2.4)), value / 12.92, lessThanEqual(value, vec3(0.04045)));
}
