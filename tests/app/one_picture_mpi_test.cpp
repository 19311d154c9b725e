// SPDX-License-Identifier: BSD-3-Clause
#include <boost/test/unit_test.hpp>

#include "app/small_job.h"
#include "scheduler/mpi/session.h"
#include "scheduler/mpi/session_for_tests.h"
#include "scheduler/mpi/transport.h"
#include "scheduler/run.h"

using namespace tessera;
using namespace tessera::app;

BOOST_AUTO_TEST_SUITE(OnePictureOverMpi)

BOOST_AUTO_TEST_CASE(every_tile_size_and_policy_gives_the_same_bytes_on_this_many_ranks) {
  scheduler::mpi::Session& session = scheduler::mpi::session_for_tests();
  scheduler::Bytes bytes;
  if (session.rank() == scheduler::kMasterRank) bytes = encode_job(test::small_job());
  session.broadcast(bytes);
  RenderJob job = decode_job(bytes);
  const render::Scene scene(job.scene, job.kernel);
  const std::string reference = test::reference_files(job, scene);
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

BOOST_AUTO_TEST_SUITE_END()
