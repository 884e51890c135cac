// What was drawn, as the report.json beside the images: geometry, times, what was left out, hashes, versions.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "proto/deployment_file.h"
#include "proto/wire.pb.h"

namespace lfd {

// Numbers have as many digits as it takes to read the same doubles back.
std::string report_json(const Deployment& deployment, const std::string& scene,
                        const std::vector<proto::FrameReport>& frames, const std::vector<std::string>& warnings);

// What the nodes warn of, and that nothing of the scene is seen where all of the `modules` drawn were left out; each
// once.
std::vector<std::string> warnings_of(const std::vector<proto::FrameReport>& frames, std::size_t modules);

// Where the time went: mean milliseconds of a drawn frame by node and pass, one line each, and how many frames were
// drawn, for people.
std::string time_table(const std::vector<proto::FrameReport>& frames);

}  // namespace lfd
