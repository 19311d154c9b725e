// SPDX-License-Identifier: BSD-3-Clause
#include "io/tachyon_skip.h"

#include <algorithm>
#include <cstdint>
#include <string>

#include "io/tachyon_texture.h"

namespace tessera::io {
namespace {

struct Shape {
  std::string_view keyword;
  std::string_view name;  // in the notes
  std::string_view pattern;
};

constexpr Shape kShapes[] = {
    {"TRI", "triangle", "V0 3 V1 3 V2 3 texture"},
    {"STRI", "triangle", "V0 3 V1 3 V2 3 N0 3 N1 3 N2 3 texture"},
    {"VCSTRI", "triangle", "V0 3 V1 3 V2 3 N0 3 N1 3 N2 3 C0 3 C1 3 C2 3 vertex-colors"},
    {"FCYLINDER", "cylinder", "BASE 3 APEX 3 RAD 1 texture"},
    {"CYLINDER", "infinite cylinder", "CENTER 3 AXIS 3 RAD 1 texture"},
    {"POLYCYLINDER", "polycylinder", "POINTS n*3 RAD 1 texture"},
    {"RING", "ring", "CENTER 3 NORMAL 3 INNER 1 OUTER 1 texture"},
    {"BOX", "box", "MIN 3 MAX 3 texture"},
    {"SCAPE", "landscape", "RES 2 SCALE 2 CENTER 3 texture"},
    {"SCALARVOL", "volume", "MIN 3 MAX 3 DIM 3 FILE word texture"},
    {"TPOLYFILE", "triangle file", "SCALE 3 ROT 3 CENTER 3 FILE word texture"},
    {"MGFFILE", "MGF file", "word"},
};

std::int64_t read_count(TachyonTokens& in) {
  const std::int64_t n = in.integer();
  if (n < 0) in.fail("expected a count (found " + std::to_string(n) + ")");
  return n;
}

void read_numbers(TachyonTokens& in, std::int64_t n) {
  for (std::int64_t i = 0; i < n; ++i) in.number();
}

// A mesh: columns of numbers for all its vertices, then any number of strips and lists of triangles.
void skip_vertex_array(TachyonTokens& in, TachyonNotes& notes) {
  in.expect("NUMVERTS");
  const std::int64_t vertices = read_count(in);
  const auto read_column = [&in, vertices] {
    for (std::int64_t i = 0; i < vertices; ++i) in.vector();
  };
  in.expect("COORDS");
  read_column();
  in.expect("NORMALS");
  read_column();
  while (!in.take("END_VERTEXARRAY")) {
    if (in.take("COLORS")) {
      read_column();
    } else if (in.take("TEXTURE")) {
      read_texture_body(in);
    } else if (in.take("TRIMESH")) {
      const std::int64_t triangles = read_count(in);
      for (std::int64_t i = 0; i < triangles; ++i) read_numbers(in, 3);
      notes.skip("triangle", static_cast<std::uint64_t>(triangles));
    } else {
      in.expect("TRISTRIP");
      const std::int64_t corners = read_count(in);
      read_numbers(in, corners);
      notes.skip("triangle", static_cast<std::uint64_t>(std::max<std::int64_t>(corners - 2, 0)));
    }
  }
}

// A picture written out as one word of hexadecimal digits a pixel. Textures that use it are counted as TEXFUNC > 0.
void skip_image_definition(TachyonTokens& in) {
  read_past(in, "word FORMAT word RESOLUTION");
  const std::int64_t width = read_count(in);
  const std::int64_t height = read_count(in);
  const std::int64_t depth = read_count(in);
  read_past(in, "ENCODING word");
  for (std::int64_t z = 0; z < depth; ++z) {
    for (std::int64_t y = 0; y < height; ++y) {
      for (std::int64_t x = 0; x < width; ++x) in.word("a pixel");
    }
  }
}

}  // namespace

void read_past(TachyonTokens& in, std::string_view pattern) {
  while (!pattern.empty()) {
    const std::string_view item = pattern.substr(0, pattern.find(' '));
    pattern.remove_prefix(std::min(item.size() + 1, pattern.size()));
    if (item.size() == 1) {
      read_numbers(in, item[0] - '0');
    } else if (item.starts_with("n*")) {
      const std::int64_t n = read_count(in);
      for (std::int64_t i = 0; i < n; ++i) read_numbers(in, item[2] - '0');
    } else if (item == "word") {
      in.word("a word");
    } else if (item == "texture") {
      if (is_keyword(in.word("a texture"), "TEXTURE")) read_texture_body(in);
    } else if (item == "vertex-colors") {
      skip_vertex_color_body(in);
    } else {
      in.expect(item);
    }
  }
}

bool skip_shape(std::string_view keyword, TachyonTokens& in, TachyonNotes& notes) {
  for (const Shape& shape : kShapes) {
    if (!is_keyword(keyword, shape.keyword)) continue;
    read_past(in, shape.pattern);
    notes.skip(shape.name);
    return true;
  }
  if (is_keyword(keyword, "VERTEXARRAY")) {
    skip_vertex_array(in, notes);
    return true;
  }
  if (is_keyword(keyword, "IMAGEDEF")) {
    skip_image_definition(in);
    return true;
  }
  return false;
}

std::vector<std::string> shape_keywords() {
  std::vector<std::string> keywords{"VERTEXARRAY", "IMAGEDEF"};
  for (const Shape& shape : kShapes) keywords.emplace_back(shape.keyword);
  return keywords;
}

}  // namespace tessera::io
