// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "render/reference/quad.h"

namespace tessera::render::reference {

/// base^exponent in quad precision.
/// shapes:  base in [0, 1], exponent >= 0; 0^0 = 1
/// error:   relative at most 2^-97 + exponent 2^-112
Quad quad_power(Quad base, double exponent);

}  // namespace tessera::render::reference
