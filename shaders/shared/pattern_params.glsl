// The test pattern of one module. Colours are as it is fed them.
struct PatternParams {
  vec4 what;   // x: PATTERN_*; y: from line to line, or a square's side (px, on the screen m); z: 1 on the screen, 0 in the image; w unused
  vec4 color;  // r g b; w unused
};
#define PATTERN_BLACK 0
#define PATTERN_NUMBER 1
#define PATTERN_GRID 2
#define PATTERN_CHECKER 3
#define PATTERN_SOLID 4
