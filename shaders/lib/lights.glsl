// Diffuse light of the kinds of KHR_lights_punctual.

// Light that arrives at a point from one light, without its colour and without the cosine; xyz: unit direction to the light.
vec4 arriving(LightParams light, vec3 position) {
  if (light.color_kind.w == 1.0) return vec4(-light.direction.xyz, 1.0);
  vec3 to_light = light.position_range.xyz - position;
  float distance2 = max(dot(to_light, to_light), 1e-12);
  float range = light.position_range.w;
  float falloff = 1.0 / distance2;
  if (range > 0.0) {
    float share = distance2 / (range * range);
    falloff *= clamp(1.0 - share * share, 0.0, 1.0);
  }
  vec3 direction = to_light * inversesqrt(distance2);
  if (light.color_kind.w == 3.0) {
    float cone = clamp(dot(-light.direction.xyz, direction) * light.cone.x + light.cone.y, 0.0, 1.0);
    falloff *= cone * cone;
  }
  return vec4(direction, falloff);
}
