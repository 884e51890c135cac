// Noise that sticks to surfaces: pixels of whatever module that show nearly the same point of the world get nearly the same numbers. Needs
// shared/module_params.glsl, shared/frame_params.glsl, lib/optics.glsl.

// The axes along which the numbers run; no scene's walls are across one of them (a turn by 1 rad about (1, 2, 3)).
const mat3 axes_of_noise = mat3(0.573137855449, 0.740348840461, -0.351278512124,
                                -0.609006642137, 0.671644504192, 0.421905877918,
                                0.548291809609, -0.027879282948, 0.835822252096);

// How far apart the points are that neighbouring pixels of a module show at a physical point, across the pixel's own line: the geometric
// mean of both directions, in metres of the world. (The image taken as filling the screen, as it does but for its distortion.)
float pixel_size_at(ModuleParams m, FrameParams frame, vec3 p_in_physical) {
  vec4 s = screen_from_physical(m, p_in_physical);
  vec2 pixel = m.screen.xy / m.screen.zw * vec2(s.z, 1.0 - s.w / m.observer.y);
  mat3 to_world = transpose(mat3(frame.world_from_physical_0.xyz, frame.world_from_physical_1.xyz, frame.world_from_physical_2.xyz));
  return sqrt(pixel.x * pixel.y * length(to_world[0]) * length(to_world[1]));
}

// Three numbers in [0, 1) of a point counted from the ROI centre, where pixels have this size. Each runs from 0 to 1 along its own axis,
// over 8 to 16 pixels: a power of two in metres, at most 2^origin.w. The neighbours' pixels, up to half a pixel off, so have turned their
// samples alike but for 1/16, and still complete each other; a blur sees most of the turns. (Error of the armadillo without and with blur:
// 0.0092 and 0.0058; of random numbers for cells of a pixel's size 0.0103 and 0.0055, for cells of 8 to 16 pixels 0.0091 and 0.0064.)
vec3 surface_noise(vec3 p, vec4 origin, float pixel_size) {
  int exponent = min((floatBitsToInt(pixel_size) >> 23) - 127 + 4, int(origin.w));
  return fract(ldexp(axes_of_noise * p + origin.xyz, ivec3(-exponent)));
}
