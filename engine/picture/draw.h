// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// A scene becomes a PNG picture.
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
  bool transparent = false;  ///< what shows nothing; else white
};

/// ERRORS: mw::Error(kUsage) unless from 16 to 8,192 pixels.
void check_sides(std::int64_t width, std::int64_t height);

/// Returns how many triangles it drew, hidden ones too.
/// Memory: 64 MiB of samples, and for one row; the scene is drawn once for each band of rows that
/// fits there, and once more before to see how large it is.
/// ENSURES: the pixels are the same on every machine (Raster).
/// ERRORS: those of scene and take; kInput when there is nothing to see or it is too large to
/// compute with.
std::uint64_t draw(MeshScene& scene, const PictureStyle& style, const io::TakeBytes& take);

}  // namespace mw::picture
