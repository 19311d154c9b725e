// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <deque>
#include <optional>
#include <queue>
#include <random>
#include <variant>
#include <vector>

#include "scheduler/master.h"
#include "scheduler/master_model.h"

// A machine on which everything goes wrong that can: a simulated clock, network and ranks around one Master, whose
// every answer is held against a MasterModel.
namespace tessera::scheduler {

/// What may go wrong in a history. Times are in leases.
struct Mishaps {
  double loses = 0;            ///< chance that a message is lost
  double doubles = 0;          ///< chance that it comes twice
  double damages = 0;          ///< chance that a result is broken
  double longest_delay = 0;    ///< of a message
  bool reorders = false;       ///< whether messages between two ranks overtake each other
  bool answers_badly = false;  ///< whether what is asked back is answered with nothing, with wrong tasks, or late
  double dies = 0;             ///< chance that a worker dies some time
  double stalls = 0;           ///< chance that a worker stands still some time
  double longest_stall = 0;
  double mute = 0;            ///< chance that a worker gives no signs of life from a long task
  double longest_tick = 0.3;  ///< between two ticks
  bool master_stalls = false;
  std::uint32_t junk = 0;  ///< events that make no sense
};

/// How a history came out.
struct Outcome {
  Faults faults;
  std::uint32_t died = 0;      ///< workers that died before they went home
  std::uint32_t given_up = 0;  ///< workers that the master gave up
};

/// One history, from the first task until the master has nobody to wait for.
class FaultyCluster {
 public:
  FaultyCluster(std::uint64_t seed, const Mishaps& mishaps);

  /// throws:  BrokenPromise where the master does what it must not, or the history does not end
  Outcome play();

 private:
  struct ToMaster {
    Event event;
    std::uint64_t payload = 0;  ///< of a result
  };
  struct TaskEnds {
    std::uint32_t generation = 0;
  };
  struct Sign {
    std::uint32_t generation = 0;
  };
  struct Death {};
  struct Stall {
    double duration = 0;
  };
  struct TickTime {};
  struct Junk {};
  using Happening = std::variant<ToMaster, Action, TaskEnds, Sign, Death, Stall, TickTime, Junk>;
  struct Entry {
    double time = 0;
    std::uint64_t number = 0;
    Rank rank = 0;  ///< where it happens; a message to the master happens at rank 0
    Happening what;
    friend bool operator<(const Entry& a, const Entry& b) {
      return a.time > b.time || (a.time == b.time && a.number > b.number);
    }
  };
  struct Member {
    std::deque<std::uint32_t> queue;
    std::optional<std::uint32_t> in_hand;
    std::uint32_t generation = 0;  ///< of the task in hand
    bool is_dead = false;
    bool is_home = false;
    bool is_mute = false;
    double away_until = 0;
    double slowness = 1;
    double last_to_master = 0;  ///< when its last message arrives, and the master's last one to it
    double last_from_master = 0;
  };

  std::uint32_t below(std::uint32_t n) { return static_cast<std::uint32_t>(random_() % n); }
  double unit() { return static_cast<double>(random_() >> 11) * 0x1p-53; }
  bool chance(double probability) { return probability > 0 && unit() < probability; }

  Plan random_plan();
  void begin();
  void schedule(double time, Rank rank, Happening what);
  void go_on(const Entry& entry);
  void tell_master(const Event& event, std::uint64_t payload);
  void perform(const Action& action);
  void look_after_own_seat();
  void send_to_master(Rank from, ToMaster message);
  void send_to_worker(Rank to, const Action& action);
  double arrival(double& last);
  void follow(Rank rank, const Action& action);
  void take_up_work(Rank rank);
  void finish_task(Rank rank);
  RunList give_back(Rank rank, std::uint32_t most);
  Event random_event();

  std::mt19937_64 random_;
  Mishaps mishaps_;
  std::uint32_t ranks_;
  Plan plan_;
  double task_duration_;  ///< the mean, in leases
  Master master_;
  MasterModel model_;
  std::vector<Action> actions_;
  std::vector<Member> members_;
  std::vector<std::optional<std::uint64_t>> picture_;  ///< per task, what was accepted
  std::priority_queue<Entry> agenda_;
  std::uint64_t entries_ = 0;
  double now_ = 0;
  std::uint32_t given_up_ = 0;
};

}  // namespace tessera::scheduler
