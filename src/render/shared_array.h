// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <memory>
#include <span>
#include <utility>
#include <vector>

namespace tessera::render {

/// Elements to look at, in memory that lives as long as anyone does so, whoever provides it.
template <class T>
class SharedArray {
 public:
  SharedArray() = default;
  SharedArray(std::shared_ptr<const void> memory, std::span<const T> elements) noexcept
      : memory_(std::move(memory)), elements_(elements) {}
  SharedArray(std::vector<T> elements) {
    const auto memory = std::make_shared<const std::vector<T>>(std::move(elements));
    elements_ = *memory;
    memory_ = memory;
  }

  const T& operator[](std::size_t i) const noexcept { return elements_[i]; }
  std::size_t size() const noexcept { return elements_.size(); }
  bool empty() const noexcept { return elements_.empty(); }
  auto begin() const noexcept { return elements_.begin(); }
  auto end() const noexcept { return elements_.end(); }

 private:
  std::shared_ptr<const void> memory_;
  std::span<const T> elements_;
};

}  // namespace tessera::render
