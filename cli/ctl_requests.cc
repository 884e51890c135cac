// One connection for each request.
#include "cli/ctl_requests.h"

#include "cli/runtime_file.h"
#include "proto/deployment_keys.h"

namespace lfd {

Result<ControllerAt> resolved(ControllerAt controller) {
  RunningCluster cluster;
  if (controller.endpoint.empty()) {
    LFD_TRY(cluster, only_running_cluster());
    controller.endpoint = cluster.endpoint;
  } else {
    for (const RunningCluster& one : running_clusters()) {
      if (one.endpoint == controller.endpoint) cluster = one;
    }
  }
  if (controller.key_file.empty()) controller.key_file = cluster.key_file;
  LFD_TRY_STATUS(check_endpoint(controller.endpoint, !controller.key_file.empty(), controller.accept_plain));
  return controller;
}

Result<ControlClient> connect_controller(const ControllerAt& controller) {
  LFD_TRY(const ControllerAt at, resolved(controller));
  return ControlClient::connect(at.endpoint, at.key_file);
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
