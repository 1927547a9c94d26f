// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Where an N5 array lies, by the attributes that several programs have agreed on.
#pragma once

#include "io/volume/n5/n5_array.h"
#include "io/volume/open_options.h"

namespace mw::io {

/// The attributes of an array, and of what is around a level of a pyramid (s0, s1, ... in a group).
struct N5Attributes {
  const N5Document& own;
  const N5Document* group = nullptr;   ///< null: none, or not a level
  const N5Document* finest = nullptr;  ///< of s0; null for s0 itself
  std::size_t level = 0;
};

/// By `transform` {axes, units, scale, translate} (COSEM: the centre of the first voxel; names of
/// axes give the order), else by `pixelResolution` or `resolution`, `units` and `offset` (the first
/// corner), fastest axis first.  A level whose resolution is missing, or the same as the finest
/// one's, has that times its `downsamplingFactors`; pyramids share a corner.
/// ERRORS: mw::Error(kInput) naming file and field.  What the options replace is not looked at.
[[nodiscard]] VolumeSpace n5_space(const N5Attributes& attributes, const N5Array& array,
                                   const OpenOptions& options);

}  // namespace mw::io
