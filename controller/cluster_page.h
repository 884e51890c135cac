// The controller's metrics: what Prometheus gets of a cluster.
#pragma once

#include "base/metric_page.h"
#include "controller/cluster_stats.h"

namespace lfd::controller {

// docs/metrics.md says what each of them is. The status is the cluster's, filled in.
MetricPage cluster_page(const proto::Status& status, const ClusterStats& stats);

}  // namespace lfd::controller
