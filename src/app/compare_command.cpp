// SPDX-License-Identifier: BSD-3-Clause
#include "app/compare_command.h"

#include <cmath>
#include <cstdio>
#include <optional>
#include <string>

#include "io/error.h"
#include "io/image_file.h"
#include "io/signature_file.h"
#include "render/image_difference.h"

namespace tessera::app {
namespace {

using render::ImageDifference;
using render::SignatureDifference;

/// throws:  io::Error unless both are of one size
template <class A, class B>
void require_one_size(const std::filesystem::path& a_name, const A& a, const std::filesystem::path& b_name,
                      const B& b) {
  if (a.width == b.width && a.height == b.height) return;
  const auto text = [](const std::filesystem::path& name, const auto& picture) {
    return name.string() + " is " + std::to_string(picture.width) + "x" + std::to_string(picture.height);
  };
  throw io::Error(io::ErrorKind::bad_scene,
                  text(a_name, a) + " and " + text(b_name, b) + " (only pictures of one size can be compared)");
}

void print_text(const ImageDifference& d) {
  std::printf(
      "max abs   %.6g\nRMSE      %.6g\nPSNR      %.6g dB\nrelMSE    %.6g\noff       %zu pixels (%.4g %%) by more than "
      "1/510\n",
      d.max_abs, d.rmse, d.psnr_db, d.rel_mse, d.off_pixels, 100 * d.off_share);
}

void print_text(const SignatureDifference& d) {
  std::printf("ids       %zu pixels see another surface first, %zu meet other surfaces on their way\n", d.first,
              d.surfaces);
  std::printf("shadows   %zu pixels meet the same surfaces in another light\n", d.lights);
}

/// JSON has neither infinity, as the PSNR of equal pictures, nor NaN: they are null.
std::string json_number(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.17g", value);
  return std::isfinite(value) ? text : "null";
}

std::string json_members(const ImageDifference& d) {
  return "\"max_abs\": " + json_number(d.max_abs) + ", \"rmse\": " + json_number(d.rmse) +
         ", \"psnr_db\": " + json_number(d.psnr_db) + ", \"rel_mse\": " + json_number(d.rel_mse) +
         ", \"off_pixels\": " + std::to_string(d.off_pixels) + ", \"off_share\": " + json_number(d.off_share);
}

std::string json_members(const SignatureDifference& d) {
  return ", \"other_first\": " + std::to_string(d.first) + ", \"other_surfaces\": " + std::to_string(d.surfaces) +
         ", \"other_lights\": " + std::to_string(d.lights);
}

/// The signatures of two pictures, the first of which is `picture`.
SignatureDifference compare_signatures(const CompareOptions& options, const render::Image& picture) {
  const render::SignatureImage a = io::read_signatures(options.signatures[0]);
  const render::SignatureImage b = io::read_signatures(options.signatures[1]);
  require_one_size(options.a, picture, options.signatures[0], a);
  require_one_size(options.signatures[0], a, options.signatures[1], b);
  return difference_between(a, b);
}

}  // namespace

ExitCode run_compare(const CompareOptions& options) {
  const render::Image a = io::read_image(options.a);
  const render::Image b = io::read_image(options.b);
  require_one_size(options.a, a, options.b, b);
  const ImageDifference picture = difference_between(a, b);
  std::optional<SignatureDifference> signatures;
  if (!options.signatures.empty()) signatures = compare_signatures(options, a);
  if (options.json) {
    std::printf("{%s%s}\n", json_members(picture).c_str(), signatures ? json_members(*signatures).c_str() : "");
  } else {
    print_text(picture);
    if (signatures) print_text(*signatures);
  }
  // Written so that a NaN in a picture counts as a difference.
  return picture.max_abs <= options.tolerance ? ExitCode::success : ExitCode::different;
}

}  // namespace tessera::app
