// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <boost/test/unit_test.hpp>
#include <cstddef>
#include <cstdlib>
#include <exception>
#include <fstream>
#include <sstream>
#include <string>

// What a case of the stress matrix measured against what it demands. Each is also one line of a table, for
// scripts/stress.sh.
namespace tessera::stress {

class Verdict {
 public:
  Verdict(int number, std::string criterion) : number_(number), criterion_(std::move(criterion)) {}
  Verdict(const Verdict&) = delete;
  Verdict& operator=(const Verdict&) = delete;

  /// Appends "number, criterion, measured, pass" between tabs to the file that TESSERA_STRESS_TABLE names. A case that
  /// an exception ends has not passed, whatever it measured before.
  ~Verdict() {
    passes_ = passes_ && std::uncaught_exceptions() == 0;
    BOOST_TEST_MESSAGE("case " << number_ << ": " << criterion_ << ": " << measured_);
    if (const char* table = std::getenv("TESSERA_STRESS_TABLE")) {
      std::ofstream(table, std::ios::app)
          << number_ << '\t' << criterion_ << '\t' << measured_ << '\t' << (passes_ ? "pass" : "FAIL") << '\n';
    }
  }

  /// A yes or no, named as in the table: "bits equal".
  void require(bool holds, const std::string& what) {
    note(what + (holds ? "" : ": NO"));
    check(holds, what);
  }

  /// A measured quantity against its bound. A NaN fails.
  void at_most(const std::string& name, double measured, double bound) {
    std::ostringstream text;
    text.precision(2);
    text << name << ' ' << measured << " <= " << bound;
    note(text.str());
    check(measured <= bound, text.str());
  }

  /// COUNT(0): wrong decisions among so many, of which there must be some.
  void none_wrong(const std::string& name, std::size_t wrong, std::size_t tried) {
    const std::string text = std::to_string(wrong) + " of " + std::to_string(tried) + " " + name;
    note(text);
    check(wrong == 0 && tried > 0, text);
  }

  /// Something measured that there is no bound for.
  void note(const std::string& text) { measured_ += (measured_.empty() ? "" : "; ") + text; }

 private:
  void check(bool holds, const std::string& text) {
    passes_ = passes_ && holds;
    BOOST_TEST(holds, "case " << number_ << ": " << text);
  }

  int number_;
  std::string criterion_;
  std::string measured_;
  bool passes_ = true;
};

}  // namespace tessera::stress
