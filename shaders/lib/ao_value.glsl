// What the passes of ambient occlusion hand on of a pixel: its hidden share and, with BENT, its mean open direction. Where values are
// mixed, it is how that leans away from the surface's own normal: edges stay as sharp as the normals are.

#ifdef BENT
#define AoValue vec4  // r: hidden; gba: mean open direction in the world, of length 1 where all is open
const AoValue kNoSurface = vec4(-1.0, 0.0, 0.0, 0.0);
AoValue ao_value(float hidden, vec3 open) { return vec4(hidden, open); }
float hidden_of(AoValue value) { return value.r; }
AoValue leaning(vec4 texel, vec3 normal) { return vec4(texel.r, texel.gba - normal); }
AoValue upright(AoValue value, vec3 normal) {
  vec3 open = value.gba + normal;
  return vec4(value.r, open / max(1.0, length(open)));  // of unlike normals the sum may be longer than all that is open
}
#else
#define AoValue float
const AoValue kNoSurface = -1.0;
AoValue ao_value(float hidden, vec3 open) { return hidden; }
float hidden_of(AoValue value) { return value; }
AoValue leaning(vec4 texel, vec3 normal) { return texel.r; }
AoValue upright(AoValue value, vec3 normal) { return value; }
#endif
