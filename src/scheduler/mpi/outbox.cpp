// SPDX-License-Identifier: BSD-3-Clause
#include "scheduler/mpi/outbox.h"

#include <limits>
#include <stdexcept>
#include <string>
#include <utility>

#include "scheduler/mpi/check.h"
#include "scheduler/mpi/transport.h"

namespace tessera::scheduler::mpi {

Outbox::~Outbox() {
  for (Parcel& parcel : parcels_) leave_to_mpi(std::move(parcel.bytes));
}

void Outbox::send(Rank to, std::span<const std::byte> head, std::span<const std::byte> rest) {
  const std::size_t size = head.size() + rest.size();
  if (size > std::size_t{std::numeric_limits<int>::max()}) {
    throw std::length_error("a message is too long for MPI (" + std::to_string(size) + " bytes) use smaller tasks");
  }
  Bytes bytes = buffers_.take();
  bytes.reserve(size);
  bytes.assign(head.begin(), head.end());
  bytes.insert(bytes.end(), rest.begin(), rest.end());
  if (size <= kShortBytes) return start(to, std::move(bytes), kWholeTag, channel_.short_ones);

  const Announcement announcement{.bytes = size, .tag = next_long_tag_};
  next_long_tag_ = (next_long_tag_ + 1) % kLongTags;
  const auto announced = std::as_bytes(std::span(&announcement, 1));
  Bytes words = buffers_.take();
  words.assign(announced.begin(), announced.end());
  start(to, std::move(words), kAnnouncementTag, channel_.short_ones);
  start(to, std::move(bytes), announcement.tag, channel_.long_ones);
}

void Outbox::start(Rank to, Bytes&& bytes, int tag, const Communicator& communicator) {
  MPI_Request request = MPI_REQUEST_NULL;
  check(MPI_Isend(bytes.data(), static_cast<int>(bytes.size()), MPI_BYTE, static_cast<int>(to), tag, communicator.get(),
                  &request),
        "MPI_Isend");
  // Most short messages have left by now.
  int has_left = 0;
  check(MPI_Test(&request, &has_left, MPI_STATUS_IGNORE), "MPI_Test");
  if (has_left != 0) return buffers_.give_back(std::move(bytes));
  requests_.push(request);
  parcels_.push_back({to, std::move(bytes)});
  if (!is_abandoned(to)) ++waiting_;
}

void Outbox::reap() {
  requests_.test();
  // From the last to the first: what is put in the place of a removed one has been looked at.
  const auto completed = requests_.completed();
  for (auto i = completed.rbegin(); i != completed.rend(); ++i) {
    const auto index = static_cast<std::size_t>(*i);
    if (!is_abandoned(parcels_[index].to)) --waiting_;
    buffers_.give_back(std::move(parcels_[index].bytes));
    std::swap(parcels_[index], parcels_.back());
    parcels_.pop_back();
    requests_.remove(index);
  }
}

void Outbox::abandon(Rank rank) {
  if (is_abandoned(rank)) return;
  if (abandoned_.size() <= rank) abandoned_.resize(std::size_t{rank} + 1);
  abandoned_[rank] = true;
  for (const Parcel& parcel : parcels_) waiting_ -= parcel.to == rank ? 1 : 0;
}

}  // namespace tessera::scheduler::mpi
