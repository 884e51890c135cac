// What a file asks for and this driver does not do: required things are errors, the rest one warning.
#pragma once

#include <tiny_gltf.h>

#include <string>
#include <vector>

#include "base/result.h"

namespace lfd::scene::gltf {

// Refuses a model with an extension in extensionsRequired that is not supported.
Status check_required_extensions(const tinygltf::Model& model);

// Names of all that the model contains and that is left out, e.g. "skins", "cameras", "KHR_materials_clearcoat".
std::vector<std::string> unsupported(const tinygltf::Model& model);

}  // namespace lfd::scene::gltf
