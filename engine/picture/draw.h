// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Draws a scene as a PNG picture.
#pragma once

#include "engine/picture/mesh_scene.h"
#include "io/picture/png_writer.h"

namespace mw::picture {

enum class Lines : std::uint8_t {
  kAuto,  ///< edges fade where triangles are only some pixels wide
  kAll,
  kNone,
};

struct PictureStyle {
  int width = 1200;  ///< pixels
  int height = 900;
  View view;
  Lines lines = Lines::kAuto;
  bool transparent = false;  ///< the background is transparent, else white
};

/// ERRORS: mw::Error(kUsage) unless both sides have 16 to 8,192 pixels.
void check_sides(std::int64_t width, std::int64_t height);

/// Draws the scene, and returns how many triangles it drew, hidden ones too.
/// Memory: 64 MiB of samples, and one row.  The scene is visited once for its extent, and once for
/// each band of rows that fits into the samples.
/// ENSURES: the pixels are the same on every machine (Raster).
/// ERRORS: those of scene and take; kInput when there is nothing to see or coordinates are too
/// large to compute with.
std::uint64_t draw(MeshScene& scene, const PictureStyle& style, const io::TakeBytes& take);

}  // namespace mw::picture
