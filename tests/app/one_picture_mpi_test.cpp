// SPDX-License-Identifier: BSD-3-Clause
#include <boost/test/unit_test.hpp>

#include "app/shared_arrays.h"
#include "app/shared_tree.h"
#include "app/small_job.h"
#include "scheduler/mpi/node_memory.h"
#include "scheduler/mpi/session.h"
#include "scheduler/mpi/session_for_tests.h"
#include "scheduler/mpi/transport.h"
#include "scheduler/run.h"

using namespace tessera;
using namespace tessera::app;

namespace {

void render_in_all_ways(scheduler::mpi::Sharing memory) {
  scheduler::mpi::Session& session = scheduler::mpi::session_for_tests();
  render::SceneData whole;
  scheduler::Bytes bytes;
  if (session.rank() == scheduler::kMasterRank) {
    RenderJob job = test::small_job();
    whole = job.scene;
    job.scene.spheres.clear();
    job.scene.materials.clear();
    bytes = encode_job(job);
  }
  session.broadcast(bytes);
  RenderJob job = decode_job(bytes);
  const SceneArrays arrays = share_arrays(session, whole.spheres, whole.materials, memory);
  const render::Scene scene(arrays.spheres, arrays.materials, job.scene, job.kernel,
                            build_on_node(session, arrays.spheres, memory));
  const std::string reference = test::reference_files(job, render::Scene(test::small_scene(), job.kernel));
  for (const test::Sharing& sharing : test::all_sharings(job)) {
    sharing.apply_to(job);
    scheduler::mpi::MpiTransport transport(session);
    session.barrier();
    if (session.rank() != scheduler::kMasterRank) {
      const auto tiles = tiles_of(job, session.size());
      scheduler::run_worker(transport, plan_of(job, tiles), TileWork(scene, job, tiles));
      continue;
    }
    const std::string files =
        test::files_of(job, scene, session.size(), [&](const auto& plan, const auto& work, const auto& accept) {
          scheduler::run_master(transport, plan, work, accept);
        });
    BOOST_TEST((files == reference), sharing.text());
  }
}

}  // namespace

BOOST_AUTO_TEST_SUITE(OnePictureOverMpi)

BOOST_AUTO_TEST_CASE(every_tile_size_and_policy_gives_the_same_bytes_on_this_many_ranks) {
  render_in_all_ways(scheduler::mpi::Sharing::if_possible);
}

BOOST_AUTO_TEST_CASE(so_it_does_where_ranks_cannot_share_memory) {
  render_in_all_ways(scheduler::mpi::Sharing::never);
}

BOOST_AUTO_TEST_SUITE_END()
