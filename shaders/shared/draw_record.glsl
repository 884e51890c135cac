// One draw of one item into one module; indexed by the base instance.
struct DrawRecord {
  uint layer;           // of the array textures, and index of the module
  uint primitive_base;  // first entry of the item's planes
  uint material;
  uint flags;           // DRAW_*
};
#define DRAW_DOUBLE_SIDED 1u
#define DRAW_UNLIT 2u
