// SPDX-License-Identifier: BSD-3-Clause
#include "io/tachyon_camera.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <sstream>

#include "render/check.h"

namespace tessera::io {
namespace {

// The image plane at distance 1.
struct Window {
  double left = 0;
  double right = 0;
  double bottom = 0;
  double top = 0;

  double width() const noexcept { return right - left; }
  double height() const noexcept { return top - bottom; }
  bool is_centred() const noexcept { return left == -right && bottom == -top; }
};

// Reads what may stand between CAMERA and ZOOM; true for a projection that FRUSTUM measures at distance 1.
bool read_projection(TachyonTokens& in, TachyonCamera& result) {
  if (!in.take("PROJECTION")) return true;
  const std::string_view name = in.word("a projection");
  if (is_keyword(name, "PERSPECTIVE")) return true;
  if (is_keyword(name, "ORTHOGRAPHIC")) {
    result.camera.projection = render::Projection::orthographic;
    return true;
  }
  if (is_keyword(name, "PERSPECTIVE_DOF")) {
    in.expect("FOCALLENGTH");
    in.number();
    in.expect("APERTURE");
    in.number();
    result.notes.push_back("PROJECTION PERSPECTIVE_DOF drawn as PERSPECTIVE (all of it in focus)");
    return true;
  }
  result.notes.push_back("PROJECTION " + in_quotes(name) + " drawn as PERSPECTIVE");
  return false;
}

std::string ignored(std::string_view keyword, double value, std::string_view instead) {
  std::ostringstream note;
  note << keyword << " " << value << " ignored (" << instead << ")";
  return note.str();
}

double read_zoom(TachyonTokens& in) {
  in.expect("ZOOM");
  const double zoom = in.number();
  if (!(zoom > 0)) in.fail("ZOOM must be > 0");
  return zoom;
}

Window read_window(TachyonTokens& in) {
  Window window;
  window.left = in.number();
  window.right = in.number();
  window.bottom = in.number();
  window.top = in.number();
  if (!(window.width() > 0 && window.height() > 0)) in.fail("FRUSTUM must have left < right and bottom < top");
  return window;
}

}  // namespace

TachyonCamera read_camera(TachyonTokens& in, const render::ImageSettings& image) {
  const TachyonTokens::Mark mark = in.mark();
  TachyonCamera result;
  render::Camera& camera = result.camera;
  camera.handedness = render::Handedness::left;

  const bool is_flat = read_projection(in, result);
  double window_height = 1 / read_zoom(in);
  in.expect("ASPECTRATIO");
  if (const double aspect = in.number(); aspect != 1) {
    result.notes.push_back(ignored("ASPECTRATIO", aspect, "pixels are drawn square"));
  }
  in.expect("ANTIALIASING");
  if (const auto samples = in.integer(); samples > 0) {
    result.notes.push_back(ignored("ANTIALIASING", static_cast<double>(samples), "--spp takes more samples per pixel"));
  }
  in.expect("RAYDEPTH");
  result.max_bounces = static_cast<std::uint32_t>(
      std::clamp<std::int64_t>(in.integer(), 1, std::numeric_limits<std::uint32_t>::max()) - 1);

  in.expect("CENTER");
  camera.eye = in.vector();
  in.expect("VIEWDIR");
  camera.target = camera.eye + in.vector();
  in.expect("UPDIR");
  camera.up = in.vector();

  if (in.take("FRUSTUM")) {
    const Window window = read_window(in);
    const double shape = window.width() / window.height() * image.height / image.width;
    if (is_flat) window_height = window.height();
    if (!is_flat || !window.is_centred() || std::abs(shape - 1) > 1e-6) {
      result.notes.push_back(is_flat ? "FRUSTUM drawn centred and with square pixels" : "FRUSTUM ignored");
    }
  }
  in.expect("END_CAMERA");

  camera.height = window_height;
  camera.fov = 2 * std::atan(window_height / 2) * 180 / std::numbers::pi;
  if (const auto problem = problem_with(camera)) in.fail(mark, *problem);
  return result;
}

}  // namespace tessera::io
