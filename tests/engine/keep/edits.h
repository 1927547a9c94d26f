// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Edits of segmentations, as people and programs make them.
#pragma once

#include <algorithm>
#include <cstdint>
#include <string>

#include "kernels/core/index.h"
#include "tests/oracle/small_volumes.h"

namespace mw::engine::test {

using audit::test::below;
using audit::test::SmallVolume;

/// Labels of volumes that are edited are multiples of this, so that new ones fall between them.
inline constexpr Label kLabelStep = 3;

/// Returns the volume with room for new labels.
[[nodiscard]] inline SmallVolume with_room(SmallVolume volume) {
  for (Label& label : volume.labels) label *= kLabelStep;
  volume.label_count *= kLabelStep;
  return volume;
}

/// Changes volumes at random, one kind of edit after the other.
class Editor {
 public:
  static constexpr std::uint32_t kKinds = 9;

  explicit Editor(std::mt19937& random) : random_(random) {}

  /// Returns what was done.  box: has all that changed.
  std::string edit(SmallVolume& volume, Box3& box) {
    const Box3 all{{0, 0, 0}, volume.shape};
    box = all;
    const auto label_at = [&](Index3 v) -> Label& {
      return volume.labels[static_cast<std::size_t>(all.offset(v))];
    };
    const Index3 at = place(volume.shape);
    const Label here = label_at(at), there = label_at(place(volume.shape));
    switch (below(random_, kKinds)) {
      case 0:
        box = {at, at + Index3{1, 1, 1}};
        label_at(at) = there;
        return "a voxel";
      case 1:
        box = intersection(grown({at, at + Index3{1, 1, 1}}, 1 + below(random_, 2)), all);
        for_each_index(box, [&](Index3 v) { label_at(v) = here; });
        return "a brush";
      case 2:
        std::replace(volume.labels.begin(), volume.labels.end(), here, there);
        return "two labels become one";
      case 3:
        for_each_index(all, [&](Index3 v) {
          if (label_at(v) == here && v.x + 2 * v.y > at.x + 2 * at.y) label_at(v) = fresh(here);
        });
        return "a label is split by a plane";
      case 4:
        std::replace(volume.labels.begin(), volume.labels.end(), here, Label{0});
        return "a label is deleted";
      case 5:
        box = intersection(grown({at, at + Index3{1, 1, 1}}, below(random_, 3)), all);
        for_each_index(box, [&](Index3 v) { label_at(v) = fresh(here); });
        return "a new label";
      case 6: {
        const Index3 lo{0, at.y, at.z};
        box = intersection({lo, lo + Index3{2, 3, 3}}, all);
        for_each_index(box, [&](Index3 v) { label_at(v) = there; });
        return "a brush at a face";
      }
      case 7:
        box = {{0, at.y, at.z}, {volume.shape.x, at.y + 1, at.z + 1}};
        for_each_index(box, [&](Index3 v) { label_at(v) = here; });
        return "a line through all tiles";
      default:
        box = {at, at};
        return "nothing";
    }
  }

 private:
  Index3 place(Index3 shape) {
    const auto along = [&](std::int64_t n) {
      return std::int64_t{below(random_, static_cast<std::uint32_t>(n))};
    };
    const auto x = along(shape.x), y = along(shape.y), z = along(shape.z);
    return {x, y, z};
  }

  /// One that the volume need not have, beside a label.
  static Label fresh(Label label) { return label / kLabelStep * kLabelStep + 1; }

  std::mt19937& random_;
};

}  // namespace mw::engine::test
