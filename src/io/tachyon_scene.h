// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>

#include "io/scene_reader.h"

// Scenes of the ray tracer Tachyon (.dat), which VMD, OVITO and Jmol write.
//
// What its pictures show, measured, and so what we read from a file:
// - It is left-handed, see tachyon_camera.h. No transfer curve: its numbers go to bytes as they are (it cuts off the
//   fraction where we round). All lights, colours and weights count as they are; only the pixel is clamped.
// - pixel = AMBIENT color + sum over unblocked lights of light (DIFFUSE color N.L + PHONG (R.V)^PHONG_SIZE) +
//   SPECULAR mirrored. PHONG METAL is tinted by the surface instead of the light.
// - DIRECTION is the way the light travels, of any length. Lights have no fall-off by themselves and those with RAD > 0
//   are seen but throw no shadow. Shadows of a point light end at the light. Spheres and planes are two-sided.
// - A path that RAYDEPTH cuts gets the background in full, where ours gets SPECULAR times the background.
// - The first TEXDEF of a name counts; an INCLUDE may have an END_SCENE of its own.
namespace tessera::io {

/// Reads a scene with its INCLUDEs, which are relative to the file that names them. Equal materials are shared.
/// throws:  Error(input_missing / io_failure / bad_scene); the last one "file:line:column: problem (why) suggestion"
ReadScene read_tachyon(const std::filesystem::path& path);

}  // namespace tessera::io
