// SPDX-License-Identifier: BSD-3-Clause
#include "app/failure.h"
#include "app/run.h"

int main(int argc, char** argv) {
  using namespace tessera;
  try {
    return static_cast<int>(app::run(argc, argv));
  } catch (const app::UsageError&) {
    return static_cast<int>(app::report_usage_error(argc, argv));
  } catch (...) {
    return static_cast<int>(app::report_failure());
  }
}
