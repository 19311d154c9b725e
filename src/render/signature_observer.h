// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "render/path_observer.h"
#include "render/signature.h"

namespace tessera::render {

/// Adds the decisions of a path to a signature.
class SignatureObserver final : public PathObserver {
 public:
  explicit SignatureObserver(Signature& signature) noexcept : signature_(signature) {}

  void on_hit(const PathVertex& vertex) override { signature_.meet(vertex.hit.surface, vertex.cell); }
  void on_light(std::size_t, bool is_lit) override { signature_.light(is_lit); }
  void on_miss(const Ray&, double) override { signature_.miss(); }

 private:
  Signature& signature_;
};

}  // namespace tessera::render
