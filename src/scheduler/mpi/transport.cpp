// SPDX-License-Identifier: BSD-3-Clause
#include "scheduler/mpi/transport.h"

#include <algorithm>
#include <limits>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "scheduler/backoff.h"
#include "scheduler/mpi/check.h"
#include "scheduler/mpi/communicator.h"

namespace tessera::scheduler::mpi {
namespace {

constexpr int kTag = 0;

// Large messages that arrive at the same time; the next one waits at its sender.
constexpr std::size_t kMostArriving = 16;

// Gives up memory that MPI may still read or write.
void abandon(Bytes& message) {
  static_cast<void>(new Bytes(std::move(message)));
}

// Completes what can be completed now; a completed request becomes MPI_REQUEST_NULL.
void test_some(std::vector<MPI_Request>& requests) {
  static thread_local std::vector<int> indices;
  indices.resize(requests.size());
  int completed = 0;
  check(
      MPI_Testsome(static_cast<int>(requests.size()), requests.data(), &completed, indices.data(), MPI_STATUSES_IGNORE),
      "MPI_Testsome");
}

}  // namespace

/// What was sent and has not left.
class MpiTransport::Outbox {
 public:
  explicit Outbox(MPI_Comm communicator) : communicator_(communicator) {}
  Outbox(const Outbox&) = delete;
  Outbox& operator=(const Outbox&) = delete;
  ~Outbox() {
    for (Bytes& message : messages_) abandon(message);
  }

  void send(Rank to, Bytes&& message) {
    if (message.size() > std::size_t{std::numeric_limits<int>::max()}) {
      throw std::length_error("a message is too long for MPI (" + std::to_string(message.size()) +
                              " bytes) use smaller tasks");
    }
    messages_.push_back(std::move(message));
    requests_.push_back(MPI_REQUEST_NULL);
    const Bytes& kept = messages_.back();
    check(MPI_Isend(kept.data(), static_cast<int>(kept.size()), MPI_BYTE, static_cast<int>(to), kTag, communicator_,
                    &requests_.back()),
          "MPI_Isend");
  }

  void reap() {
    if (requests_.empty()) return;
    test_some(requests_);
    for (std::size_t i = 0; i < requests_.size();) {
      if (requests_[i] != MPI_REQUEST_NULL) {
        ++i;
        continue;
      }
      requests_[i] = requests_.back();
      requests_.pop_back();
      std::swap(messages_[i], messages_.back());
      messages_.pop_back();
    }
  }

  bool empty() const noexcept { return requests_.empty(); }

 private:
  MPI_Comm communicator_;
  std::vector<MPI_Request> requests_;
  std::vector<Bytes> messages_;
};

/// What is arriving. A large message takes a while and must not let a later one of the same rank pass.
class MpiTransport::Inbox {
 public:
  explicit Inbox(MPI_Comm communicator) : communicator_(communicator) {}
  Inbox(const Inbox&) = delete;
  Inbox& operator=(const Inbox&) = delete;
  ~Inbox() {
    for (Envelope& envelope : envelopes_) abandon(envelope.bytes);
  }

  std::optional<Envelope> take() {
    while (requests_.size() < kMostArriving && begin_next()) {
    }
    if (requests_.empty()) return std::nullopt;
    test_some(requests_);
    for (std::size_t i = 0; i < requests_.size(); ++i) {
      if (requests_[i] != MPI_REQUEST_NULL || waits_for_earlier(i)) continue;
      const auto offset = static_cast<std::ptrdiff_t>(i);
      Envelope envelope = std::move(envelopes_[i]);
      requests_.erase(requests_.begin() + offset);
      envelopes_.erase(envelopes_.begin() + offset);
      return envelope;
    }
    return std::nullopt;
  }

 private:
  /// Whether a message was there to be received.
  bool begin_next() {
    int found = 0;
    MPI_Message message = MPI_MESSAGE_NULL;
    MPI_Status status;
    check(MPI_Improbe(MPI_ANY_SOURCE, kTag, communicator_, &found, &message, &status), "MPI_Improbe");
    if (found == 0) return false;
    int count = 0;
    check(MPI_Get_count(&status, MPI_BYTE, &count), "MPI_Get_count");
    envelopes_.push_back({static_cast<Rank>(status.MPI_SOURCE), Bytes(static_cast<std::size_t>(count))});
    requests_.push_back(MPI_REQUEST_NULL);
    check(MPI_Imrecv(envelopes_.back().bytes.data(), count, MPI_BYTE, &message, &requests_.back()), "MPI_Imrecv");
    return true;
  }

  bool waits_for_earlier(std::size_t i) const {
    const auto end = envelopes_.begin() + static_cast<std::ptrdiff_t>(i);
    return std::any_of(envelopes_.begin(), end, [&](const Envelope& e) { return e.source == envelopes_[i].source; });
  }

  MPI_Comm communicator_;
  std::vector<MPI_Request> requests_;
  std::vector<Envelope> envelopes_;  ///< in the order of arrival
};

MpiTransport::MpiTransport(const Session& session)
    : session_(session),
      outbox_(std::make_unique<Outbox>(session.communicator().get())),
      inbox_(std::make_unique<Inbox>(session.communicator().get())) {}

MpiTransport::~MpiTransport() = default;

void MpiTransport::flush() {
  Backoff backoff(is_oversubscribed() ? Patience::yield_only : Patience::spin_first);
  for (outbox_->reap(); !outbox_->empty(); outbox_->reap()) backoff.wait();
}

void MpiTransport::do_send(Rank to, Bytes&& message) {
  outbox_->send(to, std::move(message));
}

std::optional<Envelope> MpiTransport::do_receive() {
  outbox_->reap();
  return inbox_->take();
}

}  // namespace tessera::scheduler::mpi
