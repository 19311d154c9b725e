// SPDX-License-Identifier: BSD-3-Clause
#include "io/toml_fields.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <sstream>

#include "io/hex_color.h"
#include "io/suggest.h"

namespace tessera::io {
namespace {

/// What a value is, for "(found …)".
std::string describe(const toml::node& node) {
  if (const auto* text = node.as_string()) return in_quotes(text->get());
  if (const auto* integer = node.as_integer()) return std::to_string(integer->get());
  if (const auto* boolean = node.as_boolean()) return boolean->get() ? "true" : "false";
  if (const auto* number = node.as_floating_point()) {
    std::ostringstream out;
    out << number->get();
    return out.str();
  }
  if (const auto* array = node.as_array()) return "an array of " + std::to_string(array->size());
  return node.is_table() ? "a table" : "a date or time";
}

/// `"a", "b" or "c"`
std::string list_of(const std::vector<std::string>& words) {
  std::string list;
  for (std::size_t i = 0; i < words.size(); ++i) {
    list += i == 0 ? "" : i + 1 == words.size() ? " or " : ", ";
    list += in_quotes(words[i]);
  }
  return list;
}

std::string known_keys(const std::vector<std::string>& keys) {
  std::string list;
  for (const std::string& key : keys) list += (list.empty() ? " (known: " : ", ") + key;
  return list + ")";
}

}  // namespace

TomlFields::TomlFields(const std::string& file, const toml::table& table, std::string name, const Keys& known)
    : file_(file), table_(table), name_(std::move(name)) {
  refuse_unknown_keys(known, name_);
}

void TomlFields::refuse_unknown_keys(const Keys& known, const std::string& name) const {
  for (const auto& [key, value] : table_) {
    if (std::find(known.begin(), known.end(), key.str()) != known.end()) continue;
    const std::string hint = did_you_mean(key.str(), known);
    const auto begin = key.source().begin;
    io::refuse({file_, begin.line, begin.column},
               "unknown key " + in_quotes(key.str()) + " in " + name + (hint.empty() ? known_keys(known) : hint));
  }
}

Place TomlFields::place_of(const toml::node& node) const {
  const auto begin = node.source().begin;
  return {file_, begin.line, begin.column};
}

Place TomlFields::place_of(std::string_view key) const {
  const toml::node* node = table_.get(key);
  return place_of(node != nullptr ? *node : table_);
}

void TomlFields::refuse_value(std::string_view key, const toml::node& node, const std::string& expected) const {
  io::refuse(place_of(node), std::string(key) + " must be " + expected + " (found " + describe(node) + ")");
}

// --- values ---

void TomlFields::convert(std::string_view key, const toml::node& node, double& value) const {
  if (const auto* integer = node.as_integer()) {
    value = static_cast<double>(integer->get());
    return;
  }
  const auto* number = node.as_floating_point();
  if (number == nullptr) refuse_value(key, node, "a number");
  if (!std::isfinite(number->get())) refuse_value(key, node, "finite");
  value = number->get();
}

void TomlFields::convert(std::string_view key, const toml::node& node, std::uint64_t& value) const {
  const auto* integer = node.as_integer();
  if (integer == nullptr || integer->get() < 0) refuse_value(key, node, "a whole number >= 0");
  value = static_cast<std::uint64_t>(integer->get());
}

void TomlFields::convert(std::string_view key, const toml::node& node, std::uint32_t& value) const {
  std::uint64_t wide = 0;
  convert(key, node, wide);
  constexpr std::uint32_t kLargest = std::numeric_limits<std::uint32_t>::max();
  if (wide > kLargest) refuse_value(key, node, "at most " + std::to_string(kLargest));
  value = static_cast<std::uint32_t>(wide);
}

void TomlFields::convert(std::string_view key, const toml::node& node, PlacedWord& value) const {
  const auto* text = node.as_string();
  if (text == nullptr) refuse_value(key, node, "a string");
  value = {text->get(), place_of(node)};
}

void TomlFields::convert(std::string_view key, const toml::node& node, std::vector<PlacedWord>& value) const {
  const auto* array = node.as_array();
  if (array == nullptr || array->empty()) refuse_value(key, node, "an array of strings");
  value.clear();
  for (const toml::node& element : *array) convert("each of " + std::string(key), element, value.emplace_back());
}

void TomlFields::convert(std::string_view key, const toml::node& node, render::Vec3& value) const {
  const auto* array = node.as_array();
  if (array == nullptr || array->size() != 3) refuse_value(key, node, "[x, y, z]");
  const std::string element = "each of " + std::string(key);
  convert(element, (*array)[0], value.x);
  convert(element, (*array)[1], value.y);
  convert(element, (*array)[2], value.z);
}

void TomlFields::convert(std::string_view key, const toml::node& node, render::Rgb& value) const {
  if (const auto* text = node.as_string()) {
    if (const auto color = parse_hex_color(text->get())) {
      value = *color;
      return;
    }
  }
  const auto* array = node.as_array();
  if (array == nullptr || array->size() != 3) refuse_value(key, node, "\"#rrggbb\" or [r, g, b]");
  const std::string element = "each of " + std::string(key);
  convert(element, (*array)[0], value.r);
  convert(element, (*array)[1], value.g);
  convert(element, (*array)[2], value.b);
}

std::size_t TomlFields::index_of_choice(std::string_view key, const Keys& words) const {
  const toml::node& node = *table_.get(key);
  const auto* text = node.as_string();
  if (text == nullptr) refuse_value(key, node, list_of(words));
  const auto found = std::find(words.begin(), words.end(), text->get());
  if (found == words.end()) {
    refuse(key, std::string(key) + " must be " + list_of(words) + " (found " + describe(node) + ")" +
                    did_you_mean(text->get(), words));
  }
  return static_cast<std::size_t>(found - words.begin());
}

// --- tables ---

void TomlFields::visit_table(std::string_view key, const Keys& known, const Visit& visit) const {
  const toml::node* node = table_.get(key);
  if (node == nullptr) return;
  const std::string name = std::string("[").append(key).append("]");
  if (!node->is_table()) refuse_value(key, *node, "a table " + name);
  visit(TomlFields(file_, *node->as_table(), name, known));
}

void TomlFields::visit_tables(std::string_view key, const Keys& known, const Visit& visit) const {
  const toml::node* node = table_.get(key);
  if (node == nullptr) return;
  const std::string name = std::string("[[").append(key).append("]]");
  if (!node->is_array()) refuse_value(key, *node, "an array of tables " + name);
  for (const toml::node& element : *node->as_array()) {
    if (!element.is_table()) refuse_value("each of " + std::string(key), element, "a table " + name);
    visit(TomlFields(file_, *element.as_table(), name, known));
  }
}

void TomlFields::visit_named_tables(std::string_view key, const Keys& known,
                                    const std::function<void(const std::string&, const TomlFields&)>& visit) const {
  const toml::node* node = table_.get(key);
  if (node == nullptr) return;
  const std::string prefix = std::string("[").append(key).append(".");
  if (!node->is_table()) refuse_value(key, *node, "tables " + prefix + "NAME]");
  for (const auto& [name, element] : *node->as_table()) {
    const std::string full_name = prefix + std::string(name.str()) + "]";
    if (!element.is_table())
      refuse_value(std::string(key) + "." + std::string(name.str()), element, "a table " + full_name);
    visit(std::string(name.str()), TomlFields(file_, *element.as_table(), full_name, known));
  }
}

}  // namespace tessera::io
