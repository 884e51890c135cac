// The pictures that passes write: array textures with one layer per module, made when a plan first needs them.
#pragma once

#include <string_view>

#include "base/result.h"
#include "rendernode/gl/objects.h"
#include "rendernode/passes/position_pyramid.h"
#include "rendernode/plan/frame_plan.h"

namespace lfd {

class Targets {
 public:
  Targets(ImageSize size, int layers) : size_(size), layers_(layers) {}

  // Makes what the plan needs and is not there yet. Error: the GPU has no memory for it or cannot draw into it; then
  // nothing is kept.
  Status prepare(const FramePlan& plan);

  ImageSize size() const { return size_; }
  int layers() const { return layers_; }

  // SRGB8_ALPHA8; alpha: 1 lit, about 0.5 unlit, 0 no surface.
  GLuint albedo() const { return albedo_.name(); }
  // RGBA32F, world minus ROI centre; w 1 where there is a surface, 0.5 where it is drawn for ambient occlusion alone.
  GLuint position() const { return position_.name(); }
  // RGBA16F, world.
  GLuint normal() const { return normal_.name(); }
  // R16F, share of hidden samples; -1 where there is no surface. Where neighbours share it is made in 1 and
  // gathered in 0. The blur goes from 0 to 1 and back. With bent normals
  // RGBA16F: g, b and a are the mean open direction in the world, of length 1 where all is open.
  GLuint ao(int i) const { return ao_[i].name(); }
  // The same of half the resolution, rounded up.
  GLuint half_ao() const { return half_ao_.name(); }
  GLuint half_ao_framebuffer() const { return half_ao_framebuffer_.name(); }
  ImageSize half_size() const { return {(size_.width + 1) / 2, (size_.height + 1) / 2}; }
  // SRGB8_ALPHA8, what the module is fed. Without a post pass it is the albedo.
  GLuint color(const FramePlan& plan) const { return plan.post ? color_.name() : albedo_.name(); }

  // Framebuffers over all layers. geometry: albedo, position, normal as the plan needs them, and depth.
  GLuint depth_only() const { return depth_framebuffer_.name(); }
  GLuint geometry(const FramePlan& plan) const {
    return geometry_framebuffer_[plan.position ? 1 : 0][plan.normal ? 1 : 0].name();
  }
  // With the geometry's depth.
  GLuint ao_framebuffer(int i) const { return ao_framebuffer_[i].name(); }
  GLuint color_framebuffer() const { return color_framebuffer_.name(); }
  const PositionPyramid& pyramid() const { return pyramid_; }

 private:
  Status make(const FramePlan& plan);         // may leave some of it
  bool make_textures(const FramePlan& plan);  // whether any was missing
  void drop_ao(bool bent);                    // those made next are so
  Status make_framebuffers(const FramePlan& plan, std::string_view what);

  ImageSize size_;
  int layers_;
  gl::Texture albedo_, depth_, position_, normal_, color_;
  gl::Texture ao_[2], half_ao_;
  bool bent_ = false;  // as these are
  PositionPyramid pyramid_;
  gl::Framebuffer depth_framebuffer_, color_framebuffer_;
  gl::Framebuffer ao_framebuffer_[2], half_ao_framebuffer_;
  gl::Framebuffer geometry_framebuffer_[2][2];  // [position][normal]
};

}  // namespace lfd
