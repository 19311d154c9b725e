// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <type_traits>

#include "scheduler/mpi/communicator.h"

// How messages lie on MPI. A short one goes into a receive that the other side has posted beforehand, so nobody looks
// for it. A long one is announced by a short one, and the receiver then posts a receive of its size for the rest.
namespace tessera::scheduler::mpi {

/// What a message in `Channel::short_ones` is.
inline constexpr int kWholeTag = 0;
inline constexpr int kAnnouncementTag = 1;

/// Announces a message of `bytes` in `Channel::long_ones`, whose tag is `tag`: what two long messages of a rank have
/// in common is never on its way at the same time.
struct Announcement {
  std::uint64_t bytes = 0;
  std::int32_t tag = 0;
  std::int32_t unused = 0;
};
static_assert(std::has_unique_object_representations_v<Announcement>);

/// Tags of long messages are 0 ... kLongTags - 1, then again from 0: what every MPI allows.
inline constexpr std::int32_t kLongTags = 32767;

/// Two communicators that carry the messages of one transport and nothing else. Collective.
struct Channel {
  Channel(const Communicator& ranks, Patience patience)
      : short_ones(Communicator::copy_of(ranks, patience)), long_ones(Communicator::copy_of(ranks, patience)) {}

  Communicator short_ones;
  Communicator long_ones;
};

}  // namespace tessera::scheduler::mpi
