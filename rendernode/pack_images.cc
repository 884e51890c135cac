// Packing.
#include "rendernode/pack_images.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>

namespace lfd {
namespace {

using Pixel = std::array<float, 4>;

// A surface that viewers see; others are there for ambient occlusion alone (surface_gbuffer.frag).
bool has_seen_surface(const Pixel& pixel) { return pixel[3] == 1; }

// Applies `convert` to each pixel of type In.
template <class In, class Convert>
std::shared_ptr<const std::string> converted(std::span<const std::byte> pixels, Convert convert) {
  const std::size_t count = pixels.size() / sizeof(In);
  auto bytes = std::make_shared<std::string>(count * sizeof(Pixel), '\0');
  for (std::size_t i = 0; i < count; ++i) {
    In in;
    std::memcpy(&in, pixels.data() + i * sizeof(In), sizeof(In));
    const Pixel out = convert(in);
    std::memcpy(bytes->data() + i * sizeof(Pixel), &out, sizeof(Pixel));
  }
  return bytes;
}

std::shared_ptr<const std::string> pack_color(std::span<const std::byte> pixels) {
  auto bytes = std::make_shared<std::string>(reinterpret_cast<const char*>(pixels.data()), pixels.size());
  for (std::size_t i = 3; i < bytes->size(); i += 4) (*bytes)[i] = static_cast<char>(255);
  return bytes;
}

std::shared_ptr<const std::string> pack_position(std::span<const std::byte> pixels, const RegionOfInterest& roi) {
  const Vector3<World> shift = roi.world_centre - position_origin(roi);
  return converted<Pixel>(pixels, [&](const Pixel& p) -> Pixel {
    if (!has_seen_surface(p)) return {};
    return {static_cast<float>(p[0] + shift.x), static_cast<float>(p[1] + shift.y), static_cast<float>(p[2] + shift.z),
            1};
  });
}

std::shared_ptr<const std::string> pack_depth(std::span<const std::byte> pixels, const RegionOfInterest& roi) {
  const glm::dmat3 m = physical_from_world(roi).linear;
  const double offset = roi.physical_centre.z;
  return converted<Pixel>(pixels, [&](const Pixel& p) -> Pixel {
    if (!has_seen_surface(p)) return {};
    const float z = static_cast<float>(m[0][2] * p[0] + m[1][2] * p[1] + m[2][2] * p[2] + offset);
    return {z, z, z, 1};
  });
}

std::shared_ptr<const std::string> pack_ao(std::span<const std::byte> pixels, const AoSettings& ao) {
  return converted<float>(pixels, [&](float hidden) -> Pixel {
    if (hidden < 0) return {};
    const double open = std::clamp(ao.curve.b * ((1.0 - hidden) + ao.curve.a), 0.0, 1.0);
    const float value = static_cast<float>(1 - std::pow(open, ao.curve.c));
    return {value, value, value, 1};
  });
}

std::shared_ptr<const std::string> pack_bent_normal(std::span<const std::byte> pixels) {
  return converted<Pixel>(pixels, [](const Pixel& p) -> Pixel {
    if (p[0] < 0) return {};
    return {p[1], p[2], p[3], 1};
  });
}

}  // namespace

std::shared_ptr<const std::string> pack_image(proto::BufferKind kind, std::span<const std::byte> pixels,
                                              const PackInputs& in) {
  switch (kind) {
    case proto::COLOR:
      return pack_color(pixels);
    case proto::POSITION:
      return pack_position(pixels, in.roi);
    case proto::DEPTH:
      return pack_depth(pixels, in.roi);
    case proto::AO:
      if (in.ao_pass) return pack_ao(pixels, in.ao);
      return converted<Pixel>(pixels, [](const Pixel& p) -> Pixel { return {0, 0, 0, p[3]}; });
    case proto::BENT_NORMAL:
      if (in.bent) return pack_bent_normal(pixels);
      [[fallthrough]];
    default:
      return converted<Pixel>(pixels, [](const Pixel& p) { return has_seen_surface(p) ? p : Pixel(); });
  }
}

}  // namespace lfd
