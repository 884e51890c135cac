// Buffers of a drawn frame as pictures.
#pragma once

#include "proto/pictures/picture.h"
#include "rendernode/renderer.h"

namespace lfd::bench {

// Of a buffer of floats; a module without geometry is all 0.
PictureF picture_of(const ModuleImage& image);

// The first image of this kind. The buffer must have been asked for.
const ModuleImage& image_of(const FrameResult& frame, proto::BufferKind kind);
PictureF picture_of(const FrameResult& frame, proto::BufferKind kind);

}  // namespace lfd::bench
