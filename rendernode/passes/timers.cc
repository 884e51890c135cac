// Timer queries.
#include "rendernode/passes/timers.h"

#include <utility>

namespace lfd {

void PassTimers::begin(std::string pass, std::vector<std::uint32_t> layers) {
  if (queries_.size() == passes_.size()) queries_.push_back(gl::make_query(GL_TIME_ELAPSED));
  glBeginQuery(GL_TIME_ELAPSED, queries_[passes_.size()].name());
  passes_.push_back({std::move(pass), 0, std::move(layers)});
}

void PassTimers::end() { glEndQuery(GL_TIME_ELAPSED); }

std::vector<TimedPass> PassTimers::collect() {
  for (std::size_t i = 0; i < passes_.size(); ++i) {
    GLuint64 nanoseconds = 0;
    glGetQueryObjectui64v(queries_[i].name(), GL_QUERY_RESULT, &nanoseconds);
    passes_[i].gpu_ms = static_cast<double>(nanoseconds) * 1e-6;
  }
  return std::exchange(passes_, {});
}

}  // namespace lfd
