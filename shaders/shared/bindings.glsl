// Binding points, said once for both languages.
// Small buffers of which all pixels read the same entries are uniform buffers (software rasterisers read those much faster):
// MODULES, FRAME, AO, AO_METHOD, AO_SAMPLES, COLORS, SHARING, PATTERNS; their arrays have a fixed length. The others are storage buffers, of which
// OpenGL promises the numbers 0 to 7.
#define MODULES_PER_NODE 256
#define AO_MOST_SAMPLES 256
#define BINDING_MODULES 0
#define BINDING_MATERIALS 2
#define BINDING_FRAME 3
#define BINDING_LIGHTS 4
#define BINDING_COLOR_SAMPLES 5
#define BINDING_AO_SAMPLES 6
#define BINDING_LAYERS 7
#define BINDING_COLORS 8
#define BINDING_AO 9
#define BINDING_AO_METHOD 10
#define BINDING_SHARING 11
#define BINDING_PATTERNS 12
#define UNIT_TEXTURE 0
#define UNIT_PIXEL_TABLE 1
#define UNIT_ALBEDO 2
#define UNIT_POSITION 3
#define UNIT_NORMAL 4
#define UNIT_AO 5
#define UNIT_WARP_TABLE 6
#define UNIT_PLANES 7
#define UNIT_PYRAMID 8
