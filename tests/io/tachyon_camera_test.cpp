// SPDX-License-Identifier: BSD-3-Clause
#include "io/tachyon_camera.h"

#include <boost/test/unit_test.hpp>
#include <cmath>
#include <numbers>
#include <string>
#include <string_view>
#include <vector>

#include "io/error.h"
#include "io/temp_folder.h"

namespace tessera::io {
namespace {

using test::error_of;

TachyonCamera read(const std::string& head, const std::string& tail = "") {
  const test::TempFolder folder;
  TachyonTokens in(
      folder.write("a.dat", "CAMERA " + head + " CENTER 1 2 3 VIEWDIR 0 0 2 UPDIR 0 5 1 " + tail + " END_CAMERA NEXT"));
  in.expect("CAMERA");
  render::ImageSettings image;
  image.width = 200;
  image.height = 100;
  TachyonCamera camera = read_camera(in, image);
  in.expect("NEXT");
  return camera;
}

const std::string kPlain = "ZOOM 1 ASPECTRATIO 1 ANTIALIASING 0 RAYDEPTH 5";

double degrees(double radians) {
  return radians * 180 / std::numbers::pi;
}

}  // namespace

BOOST_AUTO_TEST_SUITE(TachyonCameraTest)

BOOST_AUTO_TEST_CASE(looks_along_viewdir_from_center_left_handed) {
  const TachyonCamera read_back = read(kPlain);
  const render::Camera& camera = read_back.camera;
  BOOST_TEST((camera.eye == render::Vec3{1, 2, 3}));
  BOOST_TEST((camera.target == render::Vec3{1, 2, 5}));
  BOOST_TEST((camera.up == render::Vec3{0, 5, 1}));
  BOOST_TEST((camera.handedness == render::Handedness::left));
  BOOST_TEST((camera.projection == render::Projection::perspective));
  BOOST_TEST(read_back.notes.empty());
}

BOOST_AUTO_TEST_CASE(zoom_is_one_over_the_height_of_the_image_plane) {
  // tan(fov / 2) = 0.5 / zoom
  for (const double zoom : {0.5, 1.0, 1.20711}) {
    const auto camera = read("ZOOM " + std::to_string(zoom) + " ASPECTRATIO 1 ANTIALIASING 0 RAYDEPTH 5").camera;
    BOOST_TEST(camera.fov == degrees(2 * std::atan(0.5 / zoom)), boost::test_tools::tolerance(1e-14));
  }
  const auto flat = read("PROJECTION ORTHOGRAPHIC ZOOM 0.25 ASPECTRATIO 1 ANTIALIASING 0 RAYDEPTH 5").camera;
  BOOST_TEST((flat.projection == render::Projection::orthographic));
  BOOST_TEST(flat.height == 4);
}

BOOST_AUTO_TEST_CASE(raydepth_counts_the_first_hit_too) {
  for (const auto& [depth, bounces] : {std::pair{"12", 11u}, {"1", 0u}, {"0", 0u}, {"-3", 0u}}) {
    BOOST_TEST(read(std::string("ZOOM 1 ASPECTRATIO 1 ANTIALIASING 0 RAYDEPTH ") + depth).max_bounces == bounces);
  }
}

BOOST_AUTO_TEST_CASE(frustum_overrides_zoom) {
  const TachyonCamera exact = read(kPlain, "FRUSTUM -2 2 -1 1");
  BOOST_TEST(exact.camera.fov == 90, boost::test_tools::tolerance(1e-14));
  BOOST_TEST(exact.notes.empty());
  const std::vector<std::string> note{"FRUSTUM drawn centred and with square pixels"};
  BOOST_TEST(read(kPlain, "FRUSTUM -1 3 -1 1").notes == note);  // off centre
  BOOST_TEST(read(kPlain, "FRUSTUM -1 1 -1 1").notes == note);  // not the shape of the picture
  BOOST_TEST(read("PROJECTION ORTHOGRAPHIC " + kPlain, "FRUSTUM -3 3 -1.5 1.5").camera.height == 3);
}

BOOST_AUTO_TEST_CASE(what_is_drawn_in_another_way_is_noted) {
  using Notes = std::vector<std::string>;
  BOOST_TEST(read("ZOOM 1 ASPECTRATIO 1.5 ANTIALIASING 8 RAYDEPTH 5").notes ==
             (Notes{"ASPECTRATIO 1.5 ignored (pixels are drawn square)",
                    "ANTIALIASING 8 ignored (--spp takes more samples per pixel)"}));
  BOOST_TEST(read("PROJECTION perspective " + kPlain).notes == Notes{});
  BOOST_TEST(read("PROJECTION PERSPECTIVE_DOF FOCALLENGTH 2 APERTURE 1 " + kPlain).notes ==
             Notes{"PROJECTION PERSPECTIVE_DOF drawn as PERSPECTIVE (all of it in focus)"});
  const TachyonCamera fisheye = read("PROJECTION FishEye " + kPlain, "FRUSTUM -3 3 -1 1");
  BOOST_TEST(fisheye.notes == (Notes{"PROJECTION \"FishEye\" drawn as PERSPECTIVE", "FRUSTUM ignored"}));
  BOOST_TEST(fisheye.camera.fov == degrees(2 * std::atan(0.5)), boost::test_tools::tolerance(1e-14));
}

BOOST_AUTO_TEST_CASE(bad_cameras_are_refused_with_their_place) {
  const auto problem_of = [](const std::string& head, const std::string& tail) {
    const auto error = error_of([&] { read(head, tail); });
    const std::string what = error ? error->what() : "none";
    return what.substr(what.find("a.dat:") + 6);
  };
  BOOST_TEST(problem_of("ASPECTRATIO 1", "") == "1:8: expected ZOOM (found \"ASPECTRATIO\")");
  BOOST_TEST(problem_of("ZOOM 0 ASPECTRATIO 1", "") == "1:13: ZOOM must be > 0");
  BOOST_TEST(problem_of(kPlain, "FRUSTUM 1 -1 1 -1").ends_with("FRUSTUM must have left < right and bottom < top"));
  BOOST_TEST(problem_of(kPlain, "UPDIR 0 1 0").ends_with("expected END_CAMERA (found \"UPDIR\")"));
  const auto parallel = problem_of(kPlain + " CENTER 0 0 0 VIEWDIR 0 1 0 UPDIR 0 -1 0 END_CAMERA", "");
  BOOST_TEST(parallel.starts_with("1:1: up is parallel to the view direction"), parallel);
}

BOOST_AUTO_TEST_SUITE_END()

}  // namespace tessera::io
