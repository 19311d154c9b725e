// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "app/cut_to_cost.h"
#include "app/tile_size.h"
#include "render/tile.h"
#include "scheduler/cost_field.h"
#include "scheduler/grain.h"
#include "scheduler/simulated_cluster.h"

// Whole renders in simulation: a picture of known costs, cut as the program cuts it, on a cluster of any size.
namespace tessera::app::test {

using scheduler::Policy;
using scheduler::SimulatedRun;
using scheduler::test::CostField;

/// One picture on one cluster.
class SimulatedRender {
 public:
  SimulatedRender(const CostField& field, std::uint32_t ranks)
      : field_(field), area_{0, 0, field.side(), field.side()}, cluster_{.ranks = ranks} {}

  double work_ratio() const { return scheduler::work_ratio(field_.seconds(), cluster_.ranks); }

  SimulatedRun by_bands() const { return run(Policy::static_bands, render::bands(area_, cluster_.ranks)); }
  SimulatedRun by_rows() const { return run(Policy::cyclic_rows, render::tile_grid(area_, area_.width, 1)); }

  /// With tiles of a size.
  SimulatedRun by_tiles(const Size& size, Policy policy = Policy::dynamic) const {
    return run(policy, render::tile_grid(area_, size.width, size.height));
  }

  /// As the program does it of itself.
  SimulatedRun by_itself() const {
    if (bands_will_do(area_, 1, cluster_.ranks)) return by_bands();
    return by_tiles(tile_size_without_costs(area_, 1));
  }

  /// With what an earlier run is believed to have found.
  SimulatedRun by_costs(const CostField& believed) const {
    return by_costs(
        [&](const render::Rect& rect) { return believed.seconds(rect.x, rect.y, rect.width, rect.height); });
  }
  SimulatedRun by_costs(const std::function<double(const render::Rect&)>& believed) const {
    std::vector<render::Rect> tiles;
    std::vector<double> costs;
    for (const render::CostedTile& tile : cut_to_cost(area_, believed, cluster_.ranks)) {
      tiles.push_back(tile.rect);
      costs.push_back(tile.cost);
    }
    return run(Policy::dynamic, tiles, costs);
  }
  SimulatedRun by_known_costs() const { return by_costs(field_); }

 private:
  SimulatedRun run(Policy policy, const std::vector<render::Rect>& tiles, std::vector<double> costs = {}) const {
    scheduler::Plan plan;
    plan.policy = policy;
    plan.tasks = static_cast<std::uint32_t>(tiles.size());
    plan.costs = std::move(costs);
    plan.role = settled_role(plan, cluster_.ranks);
    std::vector<double> task_s;
    for (const render::Rect& rect : tiles) {
      task_s.push_back(field_.seconds(rect.x, rect.y, rect.width, rect.height));
    }
    return simulate(cluster_, plan, task_s);
  }

  const CostField& field_;
  render::Rect area_;
  scheduler::Cluster cluster_;
};

}  // namespace tessera::app::test
