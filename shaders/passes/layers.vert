// Full-picture passes: one triangle that covers a layer, once per layer that is drawn. It lies at the far end of the depth buffer, behind
// every surface: by a depth test, passes leave out pixels without one.
#version 450 core
#extension GL_ARB_shader_viewport_layer_array : require
#include "shared/bindings.glsl"

layout(std430, binding = BINDING_LAYERS) readonly buffer Layers { uint layers[]; };

layout(location = 0) uniform int first_layer;

flat out int layer;

void main() {
  layer = int(layers[first_layer + gl_InstanceID]);
  gl_Layer = layer;
  gl_Position = vec4(gl_VertexID == 1 ? 3.0 : -1.0, gl_VertexID == 2 ? 3.0 : -1.0, 1.0, 1.0);
}
