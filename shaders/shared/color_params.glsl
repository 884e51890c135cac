// One module's colour calibration (calibration/color.h says what the numbers mean). Samples lie in the buffer of all modules.
struct ColorParams {
  vec4 device_from_display_0;  // rows; w of the first: 1, or 0 where the module has no colour calibration
  vec4 device_from_display_1;
  vec4 device_from_display_2;
  vec4 black_level;            // linear r g b; w unused
  vec4 gain;                   // x: columns, y: rows of nodes, z: where they begin, each r g b; w unused
  vec4 curve_0;                // of red. x: 0 sRGB, 1 gamma, 2 table; y: 1 / gamma, or where the table begins; z: its samples; w unused
  vec4 curve_1;                // of green
  vec4 curve_2;                // of blue
};
