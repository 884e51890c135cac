// One optical module: its optics and its map. vec4 only, so that C++, std140 and std430 lay it out alike.
struct ModuleParams {
  vec4 emitter;            // ex, ey, ez in physical metres; w: map kind, 0 homography (ideal maps too), 1 pinhole, 2 table
  vec4 observer;           // x: height vy, y: distance vz (m); z: diffuser, 0 linear, 1 conical; w: layer of the pixel table, or -1
  vec4 screen;             // width, height of the screen (m); zw: width, height of the image (px), both with the guard band
  vec4 surface;            // x: curvature of the screen (1/m), 0: planar; y: level of the observers' arc, 0: a straight line; zw: width,
                           // height of what viewers see of the screen (m); all of it but for a guard band
  vec4 image_from_screen_0;  // rows of the homography screen (m) -> image (px); of a table its base; w unused
  vec4 image_from_screen_1;
  vec4 image_from_screen_2;
  vec4 screen_from_image_0;  // rows of its inverse
  vec4 screen_from_image_1;
  vec4 screen_from_image_2;
  vec4 pinhole_0;          // rows of module_from_physical (rotation; w: offset): q = row . (P, 1). Table: first node (m), nodes per metre
  // of a table: pinhole_1 has columns, rows, layer
  vec4 pinhole_1;
  vec4 pinhole_2;
  vec4 focal_principal;    // focal_u, focal_v, principal_u, principal_v (px)
  vec4 distortion;         // k1, k2, k3, square of the largest radius that can be inverted
  vec4 tangential;         // p1, p2; z: number of the module in the display; w: guard band (px)
};
