// SPDX-License-Identifier: BSD-3-Clause
#include "io/text_table.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstddef>
#include <system_error>

#include "io/error.h"
#include "io/table_row.h"

namespace tessera::io {
namespace {

bool is_blank(char c) {
  return c == ' ' || c == '\t' || c == '\r';
}
bool is_letter(char c) {
  return ('a' <= c && c <= 'z') || ('A' <= c && c <= 'Z');
}

/// Splits a line at blanks and commas, so that "1, 2" has two fields and "1,,2" has three.
void split(std::string_view line, std::vector<std::string_view>& fields) {
  fields.clear();
  std::size_t i = 0;
  const auto skip_blanks = [&] {
    while (i < line.size() && is_blank(line[i])) ++i;
  };
  skip_blanks();
  bool after_comma = false;
  while (i < line.size() || after_comma) {
    const std::size_t begin = i;
    while (i < line.size() && !is_blank(line[i]) && line[i] != ',') ++i;
    fields.push_back(line.substr(begin, i - begin));
    skip_blanks();
    after_comma = i < line.size() && line[i] == ',';
    if (after_comma) ++i;
    skip_blanks();
  }
}

std::from_chars_result parse_number(std::string_view field, double& number) {
  const bool has_plus = field.size() > 1 && field[0] == '+' && field[1] != '-';
  return std::from_chars(field.data() + (has_plus ? 1 : 0), field.data() + field.size(), number);
}

/// A line that begins with a word that is no number names the columns.
bool is_heading(std::string_view first_field) {
  double ignored = 0;
  return !first_field.empty() && (is_letter(first_field[0]) || first_field[0] == '"') &&
         parse_number(first_field, ignored).ec != std::errc{};
}

class TextTableParser {
 public:
  TextTableParser(const std::string& file, const SphereTableOptions& options, MaterialSet& materials)
      : file_(file), materials_(materials), rows_(options.material, materials) {
    if (!options.columns.empty()) columns_ = name_columns(options.columns).columns;
  }

  SphereTable parse(std::string_view text) {
    constexpr std::string_view kByteOrderMark = "\xef\xbb\xbf";
    if (text.starts_with(kByteOrderMark)) text.remove_prefix(kByteOrderMark.size());
    table_.spheres.reserve(static_cast<std::size_t>(std::count(text.begin(), text.end(), '\n')) + 1);

    while (!text.empty()) {
      const std::size_t end = std::min(text.find('\n'), text.size());
      line_ = text.substr(0, end);
      text.remove_prefix(std::min(end + 1, text.size()));
      ++line_number_;
      parse_line();
    }
    if (table_.spheres.empty()) throw Error(ErrorKind::bad_scene, file_ + ": no spheres in the table");
    return std::move(table_);
  }

 private:
  void parse_line() {
    split(line_.substr(0, line_.find('#')), fields_);
    if (fields_.empty()) return;
    if (columns_.empty() && table_.spheres.empty() && is_heading(fields_[0])) {
      parse_heading();
    } else {
      parse_row();
    }
  }

  void parse_heading() {
    std::vector<PlacedWord> names;
    for (std::string_view field : fields_) {
      const Place place = place_of(field);
      if (field.size() > 1 && field.front() == '"' && field.back() == '"') field = field.substr(1, field.size() - 2);
      names.push_back({std::string(field), place});
    }
    auto [columns, unused] = name_columns(names);
    columns_ = std::move(columns);
    if (unused.empty()) return;
    std::string list;
    for (const std::string& name : unused) list += (list.empty() ? "" : ", ") + name;
    table_.notes.push_back(file_ + ": columns not used: " + list);
  }

  void parse_row() {
    const std::vector<Column>& columns = columns_.empty() ? plain_columns(fields_.size()) : columns_;
    if (columns.size() != fields_.size()) refuse_field_count();

    TableRow row;
    for (std::size_t i = 0; i < columns.size(); ++i) {
      const Column column = columns[i];
      if (column == Column::material) {
        row.material = material_named(fields_[i]);
      } else if (column != Column::unused) {
        row.numbers[position_of(column)] = number_in(fields_[i], column);
        row.has_color |= column == Column::red;
      }
    }

    render::Sphere& sphere = table_.spheres.emplace_back();
    if (const auto problem = rows_.convert(row, sphere)) {
      const auto at = std::find(columns.begin(), columns.end(), problem->column) - columns.begin();
      refuse(place_of(fields_[static_cast<std::size_t>(at)]), problem->text);
    }
  }

  double number_in(std::string_view field, Column column) const {
    double number = 0;
    const auto [end, error] = parse_number(field, number);
    if (error == std::errc{} && end == field.data() + field.size() && std::isfinite(number)) return number;

    const std::string found = " (found " + in_quotes(field) + ")";
    const std::string name(name_of(column));
    if (error == std::errc::result_out_of_range) refuse(place_of(field), name + " is out of range" + found);
    const bool is_number = error == std::errc{} && end == field.data() + field.size();
    refuse(place_of(field), name + (is_number ? " must be finite" : " must be a number") + found);
  }

  render::MaterialIndex material_named(std::string_view name) const {
    const auto material = materials_.find(name);
    if (!material) refuse(place_of(name), materials_.unknown(name));
    return *material;
  }

  [[noreturn]] void refuse_field_count() const {
    const std::string expected = columns_.empty()
                                     ? "4, 5, 7 or 8 fields (x y z r [r g b] [material])"
                                     : std::to_string(columns_.size()) + (columns_.size() == 1 ? " field" : " fields");
    refuse(place_of(fields_[0]), "a row must have " + expected + ", found " + std::to_string(fields_.size()));
  }

  /// shapes:  `field` lies in the line
  Place place_of(std::string_view field) const {
    return {file_, line_number_, static_cast<std::size_t>(field.data() - line_.data()) + 1};
  }

  const std::string& file_;
  MaterialSet& materials_;
  RowConverter rows_;
  std::vector<Column> columns_;  // empty: by the number of fields
  SphereTable table_;
  std::string_view line_;
  std::size_t line_number_ = 0;
  std::vector<std::string_view> fields_;
};

}  // namespace

SphereTable parse_text_table(std::string_view text, const std::string& file, const SphereTableOptions& options,
                             MaterialSet& materials) {
  return TextTableParser(file, options, materials).parse(text);
}

}  // namespace tessera::io
