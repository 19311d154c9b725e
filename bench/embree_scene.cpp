// SPDX-License-Identifier: BSD-3-Clause
#include "embree_scene.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>

#include "render/vec3.h"

namespace tessera::embree {
namespace {

void refuse_unknown(const render::SceneData& data) {
  if (data.image.samples != 1) throw std::runtime_error("only one sample a pixel is drawn here");
  if (data.image.shade != render::Shade::phong) throw std::runtime_error("only Phong's highlights are drawn here");
  for (const render::Plane& plane : data.planes) {
    if (plane.checker) throw std::runtime_error("no checker boards are drawn here");
  }
}

void throw_on_error(void* /*user*/, RTCError /*code*/, const char* text) {
  throw std::runtime_error(std::string("Embree: ") + text);
}

FloatPlane float_plane(const render::Plane& plane) {
  const render::Vec3 normal = render::normalized(plane.normal);
  return {to_float(normal), static_cast<float>(render::dot(normal, plane.point)),
          static_cast<std::uint32_t>(plane.material)};
}

FloatMaterial float_material(const render::Material& m, const render::Rgb& ambient_light) {
  return {.ambient = to_float(ambient_light * (m.ambient * m.color)),
          .diffuse = to_float(m.diffuse * m.color),
          .specular = static_cast<float>(m.specular),
          .shininess = static_cast<float>(m.shininess),
          .reflection = static_cast<float>(m.reflection)};
}

FloatLight float_light(const render::Light& light) {
  const bool is_point = light.kind == render::LightKind::point;
  return {is_point, to_float(is_point ? light.vector : render::normalized(-light.vector)), to_float(light.color)};
}

void add_spheres(Scene& scene, const std::vector<render::Sphere>& spheres) {
  const RTCGeometry geometry = rtcNewGeometry(scene.device.get(), RTC_GEOMETRY_TYPE_SPHERE_POINT);
  auto* buffer = static_cast<FloatSphere*>(rtcSetNewGeometryBuffer(
      geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT4, sizeof(FloatSphere), spheres.size()));
  scene.sphere_materials.resize(spheres.size());
  for (std::size_t i = 0; i != spheres.size(); ++i) {
    const Triple<float> center = to_float(spheres[i].center);
    buffer[i] = {center.x, center.y, center.z, static_cast<float>(spheres[i].radius)};
    scene.sphere_materials[i] = static_cast<std::uint32_t>(spheres[i].material);
  }
  scene.spheres = buffer;
  rtcSetGeometryBuildQuality(geometry, RTC_BUILD_QUALITY_HIGH);
  rtcCommitGeometry(geometry);
  rtcAttachGeometry(scene.tree.get(), geometry);
  rtcReleaseGeometry(geometry);
}

}  // namespace

Scene build_scene(const render::SceneData& data) {
  refuse_unknown(data);
  Scene scene;
  scene.device.reset(rtcNewDevice("threads=1,set_affinity=0"));
  if (!scene.device) throw std::runtime_error("Embree: no device");
  rtcSetDeviceErrorFunction(scene.device.get(), throw_on_error, nullptr);
  scene.tree.reset(rtcNewScene(scene.device.get()));
  rtcSetSceneBuildQuality(scene.tree.get(), RTC_BUILD_QUALITY_HIGH);
  if (!data.spheres.empty()) add_spheres(scene, data.spheres);
  rtcCommitScene(scene.tree.get());

  for (const render::Plane& plane : data.planes) scene.planes.push_back(float_plane(plane));
  for (const render::Material& m : data.materials) {
    scene.materials.push_back(float_material(m, data.environment.ambient));
    if (std::floor(m.shininess) != m.shininess || m.shininess > 1e6) scene.has_whole_shininess = false;
  }
  for (const render::Light& light : data.lights) scene.lights.push_back(float_light(light));
  scene.background = to_float(data.environment.background);
  scene.max_bounces = data.image.max_bounces;
  return scene;
}

}  // namespace tessera::embree
