// SPDX-License-Identifier: BSD-3-Clause
#include "scheduler/mpi/inbox.h"

#include <cstring>
#include <limits>
#include <stdexcept>
#include <string>
#include <utility>

#include "scheduler/mpi/check.h"
#include "scheduler/mpi/transport.h"

namespace tessera::scheduler::mpi {
namespace {

// So many short messages are received without MPI putting them aside. More slots would not fit the innermost cache.
constexpr std::size_t kSlots = 16;

// A little more than a page from one slot to the next, or all of them would compete for the same lines of the cache.
constexpr std::size_t kSlotStride = 4096 + 64;
static_assert(kShortBytes <= kSlotStride);

// Long messages that arrive at the same time.
constexpr std::size_t kMostArriving = 64;

std::size_t length_of(const MPI_Status& status) {
  int count = 0;
  check(MPI_Get_count(&status, MPI_BYTE, &count), "MPI_Get_count");
  return static_cast<std::size_t>(count);
}

}  // namespace

Inbox::Inbox(const Channel& channel, std::uint32_t ranks) : channel_(channel), is_arriving_of_(ranks) {
  memory_.resize(kSlots * kSlotStride);
  for (std::size_t slot = 0; slot != kSlots; ++slot) {
    slots_.push(MPI_REQUEST_NULL);
    post(slot);
  }
}

Inbox::~Inbox() {
  bool all_back = true;
  for (std::size_t slot = 0; slot != slots_.size(); ++slot) {
    if (slots_[slot] == MPI_REQUEST_NULL) continue;
    int is_back = 0;
    MPI_Cancel(&slots_[slot]);
    MPI_Test(&slots_[slot], &is_back, MPI_STATUS_IGNORE);
    all_back = all_back && is_back != 0;
  }
  if (!all_back) leave_to_mpi(std::move(memory_));
  for (Arriving& message : arriving_) leave_to_mpi(std::move(message.bytes));
}

std::optional<Envelope> Inbox::take() {
  // What was handed out is read by now.
  if (open_) post(*std::exchange(open_, std::nullopt));
  buffers_.give_back(std::move(open_long_));

  if (auto envelope = next_short()) return envelope;
  if (auto envelope = next_long()) return envelope;
  look();
  if (auto envelope = next_short()) return envelope;
  return next_long();
}

void Inbox::abandon(Rank rank) {
  // Nothing of what the rank began to send comes any more; whatever MPI still does with it, it may.
  std::erase_if(announced_, [&](const Announced& message) { return message.source == rank; });
  for (std::size_t i = arriving_.size(); i-- > 0;) {
    if (arriving_[i].source != rank) continue;
    leave_to_mpi(std::move(arriving_[i].bytes));
    MPI_Request_free(&long_requests_[i]);
    long_requests_.remove(i);
    arriving_[i] = std::move(arriving_.back());
    arriving_.pop_back();
  }
  is_arriving_of_[rank] = false;
}

std::span<std::byte> Inbox::slot_memory(std::size_t slot) noexcept {
  return std::span(memory_).subspan(slot * kSlotStride, kShortBytes);
}

void Inbox::post(std::size_t slot) {
  const auto memory = slot_memory(slot);
  check(MPI_Irecv(memory.data(), static_cast<int>(memory.size()), MPI_BYTE, MPI_ANY_SOURCE, MPI_ANY_TAG,
                  channel_.short_ones.get(), &slots_[slot]),
        "MPI_Irecv");
}

void Inbox::look() {
  slots_.test();
  next_completed_ = 0;
  begin_announced();
  long_requests_.test();
  const auto completed = long_requests_.completed();
  for (auto i = completed.rbegin(); i != completed.rend(); ++i) {
    const auto index = static_cast<std::size_t>(*i);
    is_arriving_of_[arriving_[index].source] = false;
    arrived_.push_back(std::move(arriving_[index]));
    arriving_[index] = std::move(arriving_.back());
    arriving_.pop_back();
    long_requests_.remove(index);
  }
}

std::optional<Envelope> Inbox::next_short() {
  while (next_completed_ != slots_.completed().size()) {
    const std::size_t i = next_completed_++;
    const auto slot = static_cast<std::size_t>(slots_.completed()[i]);
    const MPI_Status& status = slots_.status(i);
    const auto source = static_cast<Rank>(status.MPI_SOURCE);
    const auto bytes = slot_memory(slot).first(length_of(status));
    if (status.MPI_TAG == kWholeTag) {
      open_ = slot;
      return Envelope{source, bytes};
    }
    note(source, bytes);
    post(slot);
  }
  return std::nullopt;
}

std::optional<Envelope> Inbox::next_long() {
  begin_announced();
  if (arrived_.empty()) return std::nullopt;
  Arriving message = std::move(arrived_.back());
  arrived_.pop_back();
  open_long_ = std::move(message.bytes);
  return Envelope{message.source, std::span(open_long_).first(message.length)};
}

void Inbox::note(Rank source, std::span<const std::byte> announcement) {
  Announced announced{source, {}};
  if (announcement.size() != sizeof announced.announcement) {
    throw std::runtime_error("rank " + std::to_string(source) + " announced a message in " +
                             std::to_string(announcement.size()) + " bytes (" +
                             std::to_string(sizeof announced.announcement) + " are right)");
  }
  std::memcpy(&announced.announcement, announcement.data(), announcement.size());
  if (announced.announcement.bytes > std::size_t{std::numeric_limits<int>::max()}) {
    throw std::runtime_error("rank " + std::to_string(source) + " announced a message that is too long for MPI (" +
                             std::to_string(announced.announcement.bytes) + " bytes)");
  }
  announced_.push_back(announced);
}

void Inbox::begin_announced() {
  for (std::size_t left = announced_.size(); left != 0 && arriving_.size() != kMostArriving; --left) {
    const Announced next = announced_.front();
    announced_.pop_front();
    if (is_arriving_of_[next.source]) {
      announced_.push_back(next);
      continue;
    }
    const std::size_t length = next.announcement.bytes;
    Bytes bytes = buffers_.take();
    if (bytes.size() < length) bytes.resize(length);
    MPI_Request request = MPI_REQUEST_NULL;
    check(MPI_Irecv(bytes.data(), static_cast<int>(length), MPI_BYTE, static_cast<int>(next.source),
                    next.announcement.tag, channel_.long_ones.get(), &request),
          "MPI_Irecv");
    is_arriving_of_[next.source] = true;
    arriving_.push_back({next.source, length, std::move(bytes)});
    long_requests_.push(request);
  }
}

}  // namespace tessera::scheduler::mpi
