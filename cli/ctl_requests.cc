// One connection for each request.
#include "cli/ctl_requests.h"

#include "cli/runtime_file.h"
#include "proto/deployment_keys.h"

namespace lfd {

Result<ControlClient> connect_controller(const ControllerAt& controller) {
  RunningCluster cluster;
  if (controller.endpoint.empty()) {
    LFD_TRY(cluster, only_running_cluster());
  } else {
    for (const RunningCluster& one : running_clusters()) {
      if (one.endpoint == controller.endpoint) cluster = one;
    }
    cluster.endpoint = controller.endpoint;
  }
  const std::string& key_file = controller.key_file.empty() ? cluster.key_file : controller.key_file;
  LFD_TRY_STATUS(check_endpoint(cluster.endpoint, !key_file.empty(), controller.accept_plain));
  return ControlClient::connect(cluster.endpoint, key_file);
}

Result<proto::Reply> ask_controller(const ControllerAt& controller, const proto::Request& request,
                                    Clock::duration patience) {
  LFD_TRY(ControlClient client, connect_controller(controller));
  return client.ask(request, patience);
}

Result<proto::Status> ask_status(const ControllerAt& controller) {
  proto::Request request;
  request.mutable_status();
  LFD_TRY(const proto::Reply reply, ask_controller(controller, request));
  return reply.status();
}

}  // namespace lfd
