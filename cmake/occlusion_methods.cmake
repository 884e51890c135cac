# Every method of ambient occlusion: NAME is described by proto/occlusion/NAME.cc and computed by shaders/ao/NAME.frag.
set(LFD_OCCLUSION_METHODS
  alchemy
  crytek
  gtao
  hbao
  march
  pyramid_hbao
  scalable
  schmitt
  sphere
  starcraft
  unreal
  volumetric)
