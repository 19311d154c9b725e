// SPDX-License-Identifier: BSD-3-Clause
#include "simulation/simulated_transport.h"

#include <simgrid/s4u.hpp>
#include <string>
#include <utility>

namespace tessera::simulation {
namespace {

namespace s4u = simgrid::s4u;

using scheduler::Envelope;

s4u::Mailbox* mailbox_of(scheduler::Rank rank) {
  return s4u::Mailbox::by_name(std::to_string(rank));
}

}  // namespace

/// A message on its way.
struct SimulatedTransport::Letter {
  scheduler::Rank source = 0;
  scheduler::Bytes bytes;
};

/// Where the messages to this rank arrive, whether it waits for them or not.
class SimulatedTransport::Mailbox {
 public:
  explicit Mailbox(scheduler::Rank rank) : mailbox_(mailbox_of(rank)) { mailbox_->set_receiver(s4u::Actor::self()); }
  Mailbox(const Mailbox&) = delete;
  Mailbox& operator=(const Mailbox&) = delete;
  ~Mailbox() { mailbox_->set_receiver(nullptr); }

  bool has_arrived() const { return mailbox_->ready(); }
  /// Sleeps until there is one.
  std::unique_ptr<Letter> take() { return mailbox_->get_unique<Letter>(); }

 private:
  s4u::Mailbox* mailbox_;
};

SimulatedTransport::SimulatedTransport(scheduler::Rank rank, std::uint32_t ranks)
    : rank_(rank), ranks_(ranks), mailbox_(std::make_unique<Mailbox>(rank)) {}

SimulatedTransport::~SimulatedTransport() = default;

void SimulatedTransport::wait_for_message(scheduler::Backoff&) {
  if (!arrived_) arrived_ = mailbox_->take();
}

void SimulatedTransport::do_send(scheduler::Rank to, std::span<const std::byte> head, std::span<const std::byte> rest) {
  auto letter = std::make_unique<Letter>(Letter{rank_, {head.begin(), head.end()}});
  letter->bytes.insert(letter->bytes.end(), rest.begin(), rest.end());
  const std::size_t bytes = letter->bytes.size();
  const auto discard = [](void* lost) { delete static_cast<Letter*>(lost); };
  mailbox_of(to)->put_init(letter.release(), bytes)->detach(discard);  // the receiver's from here on
}

std::optional<Envelope> SimulatedTransport::do_receive() {
  open_ = std::move(arrived_);
  if (!open_ && mailbox_->has_arrived()) open_ = mailbox_->take();
  if (!open_) return std::nullopt;
  return Envelope{open_->source, open_->bytes};
}

}  // namespace tessera::simulation
