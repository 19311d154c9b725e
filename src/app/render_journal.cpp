// SPDX-License-Identifier: BSD-3-Clause
#include "app/render_journal.h"

#include <string_view>
#include <type_traits>

#include "app/coverage.h"
#include "app/open_tiles.h"
#include "app/version.h"
#include "io/checksum.h"
#include "io/scene_codec.h"

namespace tessera::app {
namespace {

/// What decides pixels besides the scene.
struct Aspects {
  render::Rect area;
  render::PixelFormat format;
  render::Tracer tracer;
  Layers layers;
};
static_assert(std::has_unique_object_representations_v<Aspects> && sizeof(Aspects) == 20);

}  // namespace

std::uint64_t picture_hash(const RenderJob& job) {
  const Aspects aspects{job.area, job.format, job.tracer, job.layers};
  std::uint64_t hash = io::checksum_of(std::as_bytes(std::span(std::string_view(kVersion))));
  hash = io::checksum_of(std::as_bytes(std::span(&aspects, 1)), hash);
  const std::uint64_t scene = io::hash_of(job.scene);
  return io::checksum_of(std::as_bytes(std::span(&scene, 1)), hash);
}

RenderJournal::RenderJournal(const std::filesystem::path& path, const RenderJob& job, io::ExistingJournal existing)
    : area_(job.area), file_(path, {picture_hash(job), job.area, stored_bytes_per_pixel(job)}, existing) {}

scheduler::Bytes RenderJournal::mark_open(std::span<const render::Rect> tiles) const {
  if (!file_.is_resumed()) return {};
  Coverage coverage(area_);
  file_.replay([&](const io::JournalRecord& record) { coverage.add(record.tile); });
  return app::mark_open(tiles, coverage);
}

void RenderJournal::restore(Mosaic& mosaic) const {
  if (!file_.is_resumed()) return;
  file_.replay([&](const io::JournalRecord& record) { mosaic.restore(record.tile, record.pixels); });
}

std::uint64_t RenderJournal::resumed_rays() const {
  std::uint64_t rays = 0;
  file_.replay([&](const io::JournalRecord& record) { rays += record.rays.total(); });
  return rays;
}

void RenderJournal::add(const render::Rect& tile, const render::RayCounts& rays, const Mosaic& mosaic) {
  file_.append(tile, rays, [&](std::span<std::byte> pixels) { mosaic.copy(tile, pixels); });
}

}  // namespace tessera::app
