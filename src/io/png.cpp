// SPDX-License-Identifier: BSD-3-Clause
#include "io/png.h"

#include <png.h>
#include <zlib.h>

#include <algorithm>
#include <bit>
#include <csetjmp>
#include <cstddef>
#include <cstring>
#include <new>
#include <stdexcept>

#include "io/error.h"

// libpng leaves a function on an error by longjmp, which skips destructors. So each call to setjmp stands in a
// function that owns nothing: what it works on belongs to its caller.
namespace tessera::io {
namespace {

constexpr int kGammaSrgb = 45455;  // 1 / 2.2 in units of 1 / 100,000, as the PNG specification asks for beside sRGB

using Rows = std::vector<png_bytep>;

enum class Mode { read, write };

// libpng's two objects and the text of its last error.
struct PngHandle {
  explicit PngHandle(Mode m);
  ~PngHandle() { release(); }
  PngHandle(const PngHandle&) = delete;
  PngHandle& operator=(const PngHandle&) = delete;
  void release() noexcept;

  Mode mode;
  png_structp png;
  png_infop info;
  char error[128] = "";
};

[[noreturn]] void leave(png_structp png, png_const_charp message) {
  auto* handle = static_cast<PngHandle*>(png_get_error_ptr(png));
  std::strncpy(handle->error, message, sizeof handle->error - 1);
  png_longjmp(png, 1);
}

void ignore_warning(png_structp, png_const_charp) {}

PngHandle::PngHandle(Mode m)
    : mode(m),
      png(m == Mode::read ? png_create_read_struct(PNG_LIBPNG_VER_STRING, this, leave, ignore_warning)
                          : png_create_write_struct(PNG_LIBPNG_VER_STRING, this, leave, ignore_warning)),
      info(png ? png_create_info_struct(png) : nullptr) {
  if (info) return;
  release();
  throw std::bad_alloc();
}

void PngHandle::release() noexcept {
  if (mode == Mode::read) {
    png_destroy_read_struct(&png, &info, nullptr);
  } else {
    png_destroy_write_struct(&png, &info);
  }
}

void append_bytes(png_structp png, png_bytep data, std::size_t size) {
  bool appended = true;
  try {
    static_cast<std::string*>(png_get_io_ptr(png))->append(reinterpret_cast<const char*>(data), size);
  } catch (const std::exception&) {
    appended = false;
  }
  if (!appended) png_error(png, "out of memory");
}

void take_bytes(png_structp png, png_bytep data, std::size_t size) {
  auto& rest = *static_cast<std::string_view*>(png_get_io_ptr(png));
  if (size > rest.size()) png_error(png, "the file ends too early");
  std::memcpy(data, rest.data(), size);
  rest.remove_prefix(size);
}

// Whether all went well; if not, handle.error says why. Neighbours' differences are mostly runs of zeros in pictures
// like ours: run lengths pack them four times as fast as a search for older matches does, and within 2 % as well.
bool begin_write(PngHandle& handle, const PngHeader& header, std::vector<png_text>& text, std::string& sink) {
  if (setjmp(png_jmpbuf(handle.png))) return false;
  png_set_write_fn(handle.png, &sink, append_bytes, nullptr);
  png_set_IHDR(handle.png, handle.info, header.width, header.height,
               header.format == render::PixelFormat::rgb8 ? 8 : 16, PNG_COLOR_TYPE_RGB, PNG_INTERLACE_NONE,
               PNG_COMPRESSION_TYPE_DEFAULT, PNG_FILTER_TYPE_DEFAULT);
  if (header.transfer == render::Transfer::srgb) {
    png_set_sRGB(handle.png, handle.info, PNG_sRGB_INTENT_PERCEPTUAL);
    png_set_gAMA_fixed(handle.png, handle.info, kGammaSrgb);
  }
  png_set_text(handle.png, handle.info, text.data(), static_cast<int>(text.size()));
  png_set_filter(handle.png, PNG_FILTER_TYPE_BASE, PNG_FILTER_SUB);
  png_set_compression_strategy(handle.png, Z_RLE);
  png_write_info(handle.png, handle.info);
  if constexpr (std::endian::native == std::endian::little) png_set_swap(handle.png);
  return true;
}

bool write_rows(PngHandle& handle, Rows& rows) {
  if (setjmp(png_jmpbuf(handle.png))) return false;
  png_write_rows(handle.png, rows.data(), static_cast<png_uint_32>(rows.size()));
  return true;
}

bool end_write(PngHandle& handle) {
  if (setjmp(png_jmpbuf(handle.png))) return false;
  png_write_end(handle.png, nullptr);
  return true;
}

// Reads the header and asks for RGB of 8 or 16 bits.
bool read_header(PngHandle& handle, std::string_view& source) {
  if (setjmp(png_jmpbuf(handle.png))) return false;
  png_set_read_fn(handle.png, &source, take_bytes);
  png_read_info(handle.png, handle.info);
  png_set_expand(handle.png);
  png_set_gray_to_rgb(handle.png);
  png_set_strip_alpha(handle.png);
  if constexpr (std::endian::native == std::endian::little) png_set_swap(handle.png);
  png_set_interlace_handling(handle.png);
  png_read_update_info(handle.png, handle.info);
  return true;
}

bool read_pixels(PngHandle& handle, Rows& rows) {
  if (setjmp(png_jmpbuf(handle.png))) return false;
  png_read_image(handle.png, rows.data());
  png_read_end(handle.png, nullptr);
  return true;
}

Rows rows_of(std::byte* pixels, std::size_t bytes_per_row, std::size_t height) {
  Rows rows(height);
  for (std::size_t y = 0; y < height; ++y) rows[y] = reinterpret_cast<png_bytep>(pixels + y * bytes_per_row);
  return rows;
}

// tEXt holds Latin-1; what goes beyond ASCII is UTF-8 and needs iTXt.
png_text text_chunk(const std::string& keyword, const std::string& text) {
  const bool is_ascii = std::all_of(text.begin(), text.end(), [](char c) { return static_cast<signed char>(c) >= 0; });
  png_text chunk{};
  chunk.compression = is_ascii ? PNG_TEXT_COMPRESSION_NONE : PNG_ITXT_COMPRESSION_NONE;
  chunk.key = const_cast<char*>(keyword.c_str());  // libpng copies both
  chunk.text = const_cast<char*>(text.c_str());
  (is_ascii ? chunk.text_length : chunk.itxt_length) = text.size();
  return chunk;
}

Error unreadable(const std::string& name, const std::string& why) {
  return Error(ErrorKind::bad_scene, name + ": not a readable PNG (" + why + ")");
}

}  // namespace

struct PngEncoder::State {
  explicit State(const PngHeader& header)
      : row_bytes(header.width * bytes_per_pixel(header.format)), missing_rows(header.height) {}

  void require(bool success) const {
    if (!success) throw Error(ErrorKind::io_failure, "cannot make a PNG (" + std::string(handle.error) + ")");
  }

  PngHandle handle{Mode::write};
  std::size_t row_bytes;
  std::size_t missing_rows;
  std::string bytes;
};

PngEncoder::PngEncoder(const PngHeader& header, const PngText& text) : state_(std::make_unique<State>(header)) {
  if (header.format == render::PixelFormat::rgb32f) throw std::invalid_argument("a PNG cannot hold float pixels");
  std::vector<png_text> chunks;
  for (const auto& [keyword, content] : text) chunks.push_back(text_chunk(keyword, content));
  state_->require(begin_write(state_->handle, header, chunks, state_->bytes));
}

PngEncoder::PngEncoder(PngEncoder&&) noexcept = default;
PngEncoder::~PngEncoder() = default;

void PngEncoder::add_rows(std::span<const std::byte> pixels) {
  const std::size_t count = pixels.size() / state_->row_bytes;
  if (count * state_->row_bytes != pixels.size() || count > state_->missing_rows) {
    throw std::invalid_argument("these are not the next rows of the PNG");
  }
  Rows rows = rows_of(const_cast<std::byte*>(pixels.data()), state_->row_bytes, count);  // libpng only reads them
  state_->require(write_rows(state_->handle, rows));
  state_->missing_rows -= count;
}

std::string PngEncoder::finish() && {
  if (state_->missing_rows != 0) throw std::logic_error("rows of the PNG are missing");
  state_->require(end_write(state_->handle));
  return std::move(state_->bytes);
}

std::string encode_png(const render::Image& image, render::Transfer transfer, const PngText& text) {
  PngEncoder encoder({image.width, image.height, image.format, transfer}, text);
  encoder.add_rows(image.bytes);
  return std::move(encoder).finish();
}

render::Image decode_png(std::string_view bytes, const std::string& name) {
  PngHandle handle(Mode::read);
  std::string_view rest = bytes;
  if (!read_header(handle, rest)) throw unreadable(name, handle.error);

  // A header may announce any size: deflate packs at most 1032 to 1, so the file's length bounds what can be in it
  constexpr std::size_t kMostPacked = 1032;
  const std::size_t height = png_get_image_height(handle.png, handle.info);
  const std::size_t bytes_per_row = png_get_rowbytes(handle.png, handle.info);
  if (bytes_per_row > kMostPacked * bytes.size() / height) throw unreadable(name, "the file ends too early");

  const bool is_deep = png_get_bit_depth(handle.png, handle.info) == 16;
  render::Image image(png_get_image_width(handle.png, handle.info), static_cast<std::uint32_t>(height),
                      is_deep ? render::PixelFormat::rgb16 : render::PixelFormat::rgb8);
  Rows rows = rows_of(image.bytes.data(), bytes_per_row, height);
  if (!read_pixels(handle, rows)) throw unreadable(name, handle.error);
  return image;
}

}  // namespace tessera::io
