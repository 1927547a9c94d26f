// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Colours of DICOM files, which are in CIELab, on a screen (PS3.3, C.10.7.1.1).
#pragma once

#include <array>
#include <cstdint>

#include "io/names/label_names.h"

namespace mw::io {

/// CIE 1976 L*, a*, b* under the white D50, by which the profiles of ICC connect colours.
struct CieLab {
  double lightness = 0;  ///< 0 to 100
  double a = 0;          ///< green below 0, red above
  double b = 0;          ///< blue below 0, yellow above
};

/// Returns the colour whose lightness from 0 to 100, and a and b from -128 to 127, are each spread
/// over 16 bits.
[[nodiscard]] CieLab cielab_of(const std::array<std::uint16_t, 3>& spread);

/// Returns the opaque colour in sRGB, whose white is D65; white stays white (Bradford).  Each part
/// of a colour that screens cannot show becomes the nearest that they can.
[[nodiscard]] Colour srgb_of(const CieLab& lab);

}  // namespace mw::io
