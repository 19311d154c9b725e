// SPDX-License-Identifier: BSD-3-Clause
#include "io/scene_codec.h"

#include <algorithm>
#include <bit>
#include <concepts>
#include <cstdint>
#include <cstring>
#include <optional>
#include <string>
#include <type_traits>
#include <utility>

#include "io/checksum.h"
#include "io/error.h"

// Every struct is described once, by a pass() over its members that works in both directions: a Writer takes them as
// they are, a Reader fills them in.
namespace tessera::io {
namespace {

static_assert(std::endian::native == std::endian::little, "numbers are copied as they are in memory");

constexpr std::uint64_t kMagic = 0x41'52'45'53'53'45'54;  // "TESSERA"
constexpr std::uint32_t kVersion = 1;

// A sphere goes without the padding at its end, so that equal scenes are equal bytes
constexpr std::size_t kSphereBytes = sizeof(render::Vec3) + sizeof(double) + sizeof(render::MaterialIndex);
static_assert(std::is_trivially_copyable_v<render::Sphere>);
static_assert(offsetof(render::Sphere, material) + sizeof(render::MaterialIndex) == kSphereBytes);

[[noreturn]] void refuse_bytes(const std::string& problem) {
  throw Error(ErrorKind::bad_scene, "encoded scene: " + problem);
}

class Writer {
 public:
  void raw(const void* data, std::size_t size) {
    const auto* begin = static_cast<const std::byte*>(data);
    bytes_.insert(bytes_.end(), begin, begin + size);
  }
  void reserve(std::size_t more) { bytes_.reserve(bytes_.size() + more); }
  std::vector<std::byte> take() { return std::move(bytes_); }

 private:
  std::vector<std::byte> bytes_;
};

class Reader {
 public:
  explicit Reader(std::span<const std::byte> bytes) : rest_(bytes) {}

  void raw(void* data, std::size_t size) {
    if (size > rest_.size()) refuse_bytes("it is cut off");
    std::memcpy(data, rest_.data(), size);
    rest_ = rest_.subspan(size);
  }
  std::size_t left() const noexcept { return rest_.size(); }

 private:
  std::span<const std::byte> rest_;
};

// --- numbers and enumerators ---

template <class T>
concept Number = std::is_arithmetic_v<T>;
template <class T>
concept Enumerator = std::is_enum_v<T>;

void pass(Writer& stream, const Number auto& value) {
  stream.raw(&value, sizeof value);
}
void pass(Reader& stream, Number auto& value) {
  stream.raw(&value, sizeof value);
}

constexpr render::LightKind last_of(render::LightKind) {
  return render::LightKind::directional;
}
constexpr render::Projection last_of(render::Projection) {
  return render::Projection::orthographic;
}
constexpr render::Handedness last_of(render::Handedness) {
  return render::Handedness::left;
}
constexpr render::Transfer last_of(render::Transfer) {
  return render::Transfer::none;
}
constexpr render::Shade last_of(render::Shade) {
  return render::Shade::blinn;
}
constexpr render::MaterialIndex last_of(render::MaterialIndex) {
  return render::MaterialIndex{UINT32_MAX};
}

void pass(Writer& stream, const Enumerator auto& value) {
  stream.raw(&value, sizeof value);
}

template <Enumerator Enum>
void pass(Reader& stream, Enum& value) {
  std::underlying_type_t<Enum> number = 0;
  pass(stream, number);
  if (number > static_cast<std::underlying_type_t<Enum>>(last_of(value))) refuse_bytes("an enumerator is out of range");
  value = static_cast<Enum>(number);
}

// --- structs; `auto&` is const where a Writer passes over them ---

template <class T, class Plain>
concept Is = std::same_as<std::remove_const_t<T>, Plain>;

void pass_all(auto& stream, auto&... members) {
  (pass(stream, members), ...);
}

void pass(auto& stream, Is<render::Vec3> auto& v) {
  pass_all(stream, v.x, v.y, v.z);
}
void pass(auto& stream, Is<render::Rgb> auto& c) {
  pass_all(stream, c.r, c.g, c.b);
}
void pass(auto& stream, Is<render::Checker> auto& c) {
  pass_all(stream, c.material, c.size);
}
void pass(auto& stream, Is<render::Light> auto& l) {
  pass_all(stream, l.kind, l.vector, l.color);
}
void pass(auto& stream, Is<render::Environment> auto& e) {
  pass_all(stream, e.ambient, e.background);
}
void pass(auto& stream, Is<render::Material> auto& m) {
  pass_all(stream, m.color, m.ambient, m.diffuse, m.specular, m.shininess, m.reflection);
}
void pass(auto& stream, Is<render::Camera> auto& c) {
  pass_all(stream, c.eye, c.target, c.up, c.projection, c.fov, c.height, c.handedness);
}
void pass(auto& stream, Is<render::ImageSettings> auto& i) {
  pass_all(stream, i.width, i.height, i.samples, i.max_bounces, i.transfer, i.shade);
}

// --- what may be there or not, or several times ---

template <class T>
void pass(Writer& stream, const std::optional<T>& value) {
  pass(stream, std::uint8_t{value.has_value()});
  if (value) pass(stream, *value);
}

template <class T>
void pass(Reader& stream, std::optional<T>& value) {
  std::uint8_t is_there = 0;
  pass(stream, is_there);
  if (is_there > 1) refuse_bytes("a flag is neither 0 nor 1");
  if (is_there == 1) pass(stream, value.emplace());
}

void pass(auto& stream, Is<render::Plane> auto& p) {
  pass_all(stream, p.point, p.normal, p.material, p.checker);
}

template <class T>
void pass(Writer& stream, const std::vector<T>& values) {
  pass(stream, std::uint64_t{values.size()});
  for (const T& value : values) pass(stream, value);
}

template <class T>
void pass(Reader& stream, std::vector<T>& values) {
  std::uint64_t count = 0;
  pass(stream, count);
  // Growing as we read: a count that lies ends at the last byte, not in a huge allocation
  for (std::uint64_t i = 0; i < count; ++i) pass(stream, values.emplace_back());
}

void write_spheres(Writer& stream, std::span<const render::Sphere> spheres) {
  stream.reserve(spheres.size() * kSphereBytes);
  for (const render::Sphere& sphere : spheres) stream.raw(&sphere, kSphereBytes);
}

void pass(Writer& stream, const std::vector<render::Sphere>& spheres) {
  pass(stream, std::uint64_t{spheres.size()});
  write_spheres(stream, spheres);
}

void pass(Reader& stream, std::vector<render::Sphere>& spheres) {
  std::uint64_t count = 0;
  pass(stream, count);
  if (count > stream.left() / kSphereBytes) refuse_bytes("it is cut off");
  spheres.reserve(count);
  for (std::uint64_t i = 0; i < count; ++i) stream.raw(&spheres.emplace_back(), kSphereBytes);
}

void pass_all_but_spheres(auto& stream, auto& s) {
  pass_all(stream, s.image, s.environment, s.camera, s.materials, s.lights, s.planes);
}

void pass_scene(auto& stream, auto& s) {
  pass_all_but_spheres(stream, s);
  pass(stream, s.spheres);
}

void check_materials(const render::SceneData& scene) {
  const auto check = [&](render::MaterialIndex material) {
    if (static_cast<std::size_t>(material) >= scene.materials.size()) refuse_bytes("a material is missing");
  };
  for (const render::Sphere& sphere : scene.spheres) check(sphere.material);
  if (scene.spheres.empty() && scene.materials.empty()) return;  // they travel apart
  for (const render::Plane& plane : scene.planes) {
    check(plane.material);
    if (plane.checker) check(plane.checker->material);
  }
}

}  // namespace

std::vector<std::byte> encode_scene(const render::SceneData& scene) {
  Writer stream;
  pass_all(stream, kMagic, kVersion);
  pass_scene(stream, scene);
  return stream.take();
}

std::uint64_t hash_of(const render::SceneData& scene) {
  Writer stream;
  pass_all(stream, kMagic, kVersion);
  pass_all_but_spheres(stream, scene);
  pass(stream, std::uint64_t{scene.spheres.size()});
  std::uint64_t hash = checksum_of(stream.take());

  // There may be too many spheres to have them twice.
  constexpr std::size_t kPiece = 4096;
  for (std::span<const render::Sphere> rest = scene.spheres; !rest.empty();) {
    Writer piece;
    const std::size_t count = std::min(kPiece, rest.size());
    write_spheres(piece, rest.first(count));
    hash = checksum_of(piece.take(), hash);
    rest = rest.subspan(count);
  }
  return hash;
}

render::SceneData decode_scene(std::span<const std::byte> bytes) {
  Reader stream(bytes);
  std::uint64_t magic = 0;
  std::uint32_t version = 0;
  pass_all(stream, magic, version);
  if (magic != kMagic) refuse_bytes("it does not begin like one");
  if (version != kVersion)
    refuse_bytes("its version is " + std::to_string(version) + " where this program writes " +
                 std::to_string(kVersion));

  render::SceneData scene;
  pass_scene(stream, scene);
  if (stream.left() != 0) refuse_bytes(std::to_string(stream.left()) + " bytes follow its end");
  check_materials(scene);
  return scene;
}

}  // namespace tessera::io
