// From one space to another. Needs shared/frame_params.glsl.

// The physical point of a world point that is counted from the ROI centre.
vec3 physical_from_world(FrameParams frame, vec3 p) {
  return vec3(dot(frame.physical_from_world_0, vec4(p, 1.0)), dot(frame.physical_from_world_1, vec4(p, 1.0)),
              dot(frame.physical_from_world_2, vec4(p, 1.0)));
}
