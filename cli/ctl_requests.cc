// One connection for each request.
#include "cli/ctl_requests.h"

#include "cli/runtime_file.h"

namespace lfd {

Result<ControlClient> connect_controller(const std::string& endpoint) {
  if (!endpoint.empty()) return ControlClient::connect(endpoint);
  LFD_TRY(const std::string running, only_running_endpoint());
  return ControlClient::connect(running);
}

Result<proto::Reply> ask_controller(const std::string& endpoint, const proto::Request& request,
                                    Clock::duration patience) {
  LFD_TRY(ControlClient client, connect_controller(endpoint));
  return client.ask(request, patience);
}

Result<proto::Status> ask_status(const std::string& endpoint) {
  proto::Request request;
  request.mutable_status();
  LFD_TRY(const proto::Reply reply, ask_controller(endpoint, request));
  return reply.status();
}

}  // namespace lfd
