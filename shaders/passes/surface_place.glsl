// Puts one vertex in physical space into the clip space of one module (one layer). Needs lib/optics.glsl, lib/image_map.glsl.

layout(std140, binding = BINDING_MODULES) uniform Modules { ModuleParams modules[MODULES_PER_NODE]; };
layout(std430, binding = BINDING_MATERIALS) readonly buffer Materials { MaterialParams materials[]; };
layout(std140, binding = BINDING_FRAME) uniform Frame { FrameParams frame; };

invariant gl_Position;
flat out uvec4 draw;
#ifdef ATTRIBUTES
out vec3 normal;
out vec4 color;  // of vertex and material
#endif
#ifdef INTERPOLATED
out vec3 p_interpolated;  // physical; for comparison with positions computed per pixel
out vec2 s_interpolated;  // on the screen
#endif
#ifdef ALPHA_MASK
flat out float alpha_cutoff;
#endif
#ifdef TEXTURED
// The transform and the layer come from here, not from the fragment's material: a picture's level is chosen by differences between
// neighbouring pixels, and those outside the triangle may read nothing from buffers.
out vec2 uv;
flat out float texture_layer;
#endif

// What is written is scale * (front - depth) / w: it grows from 0 at the front limit, and along every pixel's line it orders as depth
// does, since w is the same function of depth for all points of one line (design geometry, section 4).
void place(vec3 p_in_physical, vec3 normal_in_world, vec2 uv_in, vec4 color_in, uvec4 record) {
  ModuleParams m = modules[record.x];
  vec4 s = screen_from_physical(m, p_in_physical);
  vec3 pixel = image_from_screen(m, s.xy);
  gl_Layer = int(record.x);
  draw = record;
#ifdef ATTRIBUTES
  normal = normal_in_world;
  color = color_in * materials[record.z].base_color;
#endif
#ifdef INTERPOLATED
  p_interpolated = p_in_physical;
  s_interpolated = s.xy;
#endif
#ifdef ALPHA_MASK
  alpha_cutoff = materials[record.z].alpha.x;
#endif
#ifdef TEXTURED
  MaterialParams material = materials[record.z];
  uv = vec2(dot(material.uv_transform_0.xyz, vec3(uv_in, 1.0)), dot(material.uv_transform_1.xyz, vec3(uv_in, 1.0)));
  texture_layer = material.uv_transform_0.w;
#endif
  // A vertex without a pixel takes its triangle out of sight: what clipping leaves of it is a sliver at the other corners.
  if (pixel.z == 0.0 || !(s.z > 0.0)) {
    gl_Position = vec4(0.0, 0.0, 2.0, 1.0);
    gl_ClipDistance[0] = -1e30;
    return;
  }
  gl_ClipDistance[0] = 1.0;
  gl_Position = vec4((2.0 * pixel.xy / m.screen.zw - 1.0) * s.z, frame.depth.y * (frame.depth.x - s.w), s.z);
}
