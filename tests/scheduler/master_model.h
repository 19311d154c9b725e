// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <optional>
#include <stdexcept>
#include <vector>

#include "scheduler/master.h"

// The promises of a Master as a table: who is where, who has what, what is accepted. It knows nothing of queues, of
// policies only how much they let a rank hold, and finds everything by looking through all of it.
namespace tessera::scheduler {

struct BrokenPromise : std::runtime_error {
  using std::runtime_error::runtime_error;
};

inline void promise(bool is_kept, const char* what) {
  if (!is_kept) throw BrokenPromise(what);
}

class MasterModel {
 public:
  MasterModel(const Plan& plan, std::uint32_t ranks);

  /// Takes down what happens; returns the verdict that a master must come to.
  Verdict happen(const Event& event, double now_s);

  /// Takes down what the master wants done because of it.
  /// throws:  BrokenPromise where it must not
  void want(const Action& action);

  /// Holds the master's account of things against this one, once all that it wants is taken down.
  /// throws:  BrokenPromise
  void compare_with(const Master& master) const;

  const Faults& faults() const noexcept { return faults_; }
  bool is_given_up(Rank rank) const noexcept { return members_[rank].where == Where::given_up; }
  bool is_seated() const noexcept { return members_[kMasterRank].where == Where::present; }

 private:
  enum class Where { away, present, silent, leaving, given_up, gone };
  struct Member {
    Where where = Where::away;
    bool greeted = false;
    bool asked = false;
    bool is_overdue = false;  ///< it is to be given up now
    std::uint32_t broken = 0;
    double heard_s = 0;
    std::vector<std::uint32_t> has;  ///< a task as often as the rank has it
    std::size_t had = 0;             ///< how many tasks when it was last heard of
  };
  struct Task {
    bool accepted = false;
    bool touched = false;        ///< somebody had it
    std::optional<Rank> holder;  ///< who is counted on
  };

  Verdict on(const Hello& hello);
  Verdict on(const TakeSeat&);
  Verdict on(const LeaveSeat&);
  Verdict on(const Result& result);
  Verdict on(const Returned& returned);
  Verdict on(const Damaged& damaged);
  Verdict on(const Alive& alive);
  Verdict on(const Bye& bye);
  Verdict on(const Tick&);
  void check(const Assign& assign);
  void check(const AskBack& ask);
  void check(const Stop& stop);
  void check(const GiveUp& give_up);
  void check(const Done&);

  bool is_worker(Rank rank) const noexcept { return rank != kMasterRank && rank < members_.size(); }
  bool is_done() const noexcept { return accepted_ == tasks_.size(); }
  bool could_have_work(Rank rank) const;
  std::uint32_t limit(Rank rank) const;
  std::uint32_t longest_chunk() const;
  void hand_out(std::uint32_t task, Rank rank);
  void hear(Rank rank);
  void fall_silent(Rank rank);
  void release(std::uint32_t task);
  bool lose(Rank rank, std::uint32_t task);

  Plan plan_;
  std::vector<Member> members_;
  std::vector<Task> tasks_;
  std::vector<std::uint32_t> untouched_;  ///< per owner, or one number for all
  std::uint32_t accepted_ = 0;
  std::uint32_t open_again_ = 0;  ///< tasks that somebody had and that nobody is counted on for
  std::uint32_t dones_ = 0;
  bool is_heard_ = false;          ///< what happened last came from a rank that may say it
  std::optional<Rank> answering_;  ///< the rank that has just returned something
  double now_s_ = 0;
  Faults faults_;
};

}  // namespace tessera::scheduler
