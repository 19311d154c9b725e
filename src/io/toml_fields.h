// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <toml++/toml.h>

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "io/place.h"
#include "render/color.h"
#include "render/vec3.h"

// Typed access to one table of a TOML file, with the place of everything that is wrong.
namespace tessera::io {

/// A table whose keys are all known. Every function throws Error(bad_scene) with the place of the offending value.
class TomlFields {
 public:
  using Keys = std::vector<std::string>;

  /// `name` is how messages call the table: "[[sphere]]". Refuses a key that is not in `known`.
  /// requires: `file` and `table` outlive this object
  TomlFields(const std::string& file, const toml::table& table, std::string name, const Keys& known);

  /// Refuses a key that is not in `known`; messages call the table `name`.
  void refuse_unknown_keys(const Keys& known, const std::string& name) const;

  bool has(std::string_view key) const { return table_.contains(key); }

  /// Reads the value of `key`; where the key is left out, `value` stays as it is, the default.
  /// shapes:  T is double, uint32_t, uint64_t, PlacedWord, std::vector<PlacedWord>, Vec3 or Rgb; numbers are finite
  template <class T>
  void read(std::string_view key, T& value) const {
    if (const toml::node* node = table_.get(key)) convert(key, *node, value);
  }

  /// The same for a key that must be there.
  template <class T>
  void require(std::string_view key, T& value) const {
    require_key(key);
    read(key, value);
  }
  void require_key(std::string_view key) const {
    if (!has(key)) refuse(key, "missing key " + in_quotes(key) + " in " + name_);
  }

  /// Reads one of a few words.
  template <class Enum>
  void read_choice(std::string_view key, Enum& value, const std::vector<std::pair<std::string, Enum>>& choices) const {
    if (!has(key)) return;
    Keys words;
    for (const auto& [word, choice] : choices) words.push_back(word);
    value = choices[index_of_choice(key, words)].second;
  }

  /// Calls `visit` with the fields of the table `key`, if it is there.
  using Visit = std::function<void(const TomlFields&)>;
  void visit_table(std::string_view key, const Keys& known, const Visit& visit) const;

  /// Calls `visit` with the fields of each table of the array `key`.
  void visit_tables(std::string_view key, const Keys& known, const Visit& visit) const;

  /// Calls `visit` with the name and the fields of each table in the table `key`.
  void visit_named_tables(std::string_view key, const Keys& known,
                          const std::function<void(const std::string&, const TomlFields&)>& visit) const;

  /// Where the value of `key` begins, or the table where the key is left out.
  Place place_of(std::string_view key) const;

  /// throws:  Error(bad_scene) at place_of(key), always
  [[noreturn]] void refuse(std::string_view key, const std::string& problem) const {
    io::refuse(place_of(key), problem);
  }

  /// The same in the words "KEY must be EXPECTED (found VALUE)".
  /// requires: has(key)
  [[noreturn]] void refuse_value(std::string_view key, const std::string& expected) const {
    refuse_value(key, *table_.get(key), expected);
  }

  /// Refuses what render::problem_with() does. Its text begins with the key that is wrong.
  void check(const std::optional<std::string>& problem) const {
    if (problem) refuse(problem->substr(0, problem->find(' ')), *problem);
  }

 private:
  void convert(std::string_view key, const toml::node& node, double& value) const;
  void convert(std::string_view key, const toml::node& node, std::uint32_t& value) const;
  void convert(std::string_view key, const toml::node& node, std::uint64_t& value) const;
  void convert(std::string_view key, const toml::node& node, PlacedWord& value) const;
  void convert(std::string_view key, const toml::node& node, std::vector<PlacedWord>& value) const;
  void convert(std::string_view key, const toml::node& node, render::Vec3& value) const;
  void convert(std::string_view key, const toml::node& node, render::Rgb& value) const;

  std::size_t index_of_choice(std::string_view key, const Keys& words) const;
  Place place_of(const toml::node& node) const;
  [[noreturn]] void refuse_value(std::string_view key, const toml::node& node, const std::string& expected) const;

  const std::string& file_;
  const toml::table& table_;
  std::string name_;
};

}  // namespace tessera::io
