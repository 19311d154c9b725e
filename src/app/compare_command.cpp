// SPDX-License-Identifier: BSD-3-Clause
#include "app/compare_command.h"

#include <cmath>
#include <cstdio>
#include <string>

#include "io/error.h"
#include "io/image_file.h"
#include "render/image_difference.h"

namespace tessera::app {
namespace {

std::string size_text(const render::Image& image) {
  return std::to_string(image.width) + "x" + std::to_string(image.height);
}

void print_text(const render::ImageDifference& d) {
  std::printf(
      "max abs   %.6g\nRMSE      %.6g\nPSNR      %.6g dB\nrelMSE    %.6g\noff       %zu pixels (%.4g %%) by more than "
      "1/510\n",
      d.max_abs, d.rmse, d.psnr_db, d.rel_mse, d.off_pixels, 100 * d.off_share);
}

/// JSON has neither infinity, as the PSNR of equal pictures, nor NaN: they are null.
std::string json_number(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.17g", value);
  return std::isfinite(value) ? text : "null";
}

void print_json(const render::ImageDifference& d) {
  std::printf(
      "{\"max_abs\": %s, \"rmse\": %s, \"psnr_db\": %s, \"rel_mse\": %s, \"off_pixels\": %zu, \"off_share\": %s}\n",
      json_number(d.max_abs).c_str(), json_number(d.rmse).c_str(), json_number(d.psnr_db).c_str(),
      json_number(d.rel_mse).c_str(), d.off_pixels, json_number(d.off_share).c_str());
}

}  // namespace

ExitCode run_compare(const CompareOptions& options) {
  const render::Image a = io::read_image(options.a);
  const render::Image b = io::read_image(options.b);
  if (a.width != b.width || a.height != b.height) {
    throw io::Error(io::ErrorKind::bad_scene, options.a.string() + " is " + size_text(a) + " and " +
                                                  options.b.string() + " is " + size_text(b) +
                                                  " (only pictures of one size can be compared)");
  }
  const render::ImageDifference difference = difference_between(a, b);
  options.json ? print_json(difference) : print_text(difference);
  // Written so that a NaN in a picture counts as a difference.
  return difference.max_abs <= options.tolerance ? ExitCode::success : ExitCode::different;
}

}  // namespace tessera::app
