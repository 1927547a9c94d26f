// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// What holds of every volume that a reader opens.
#include "tests/fuzz/look_at_volume.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "io/names/label_names.h"
#include "tests/fuzz/target.h"

namespace mw::fuzz {
namespace {

void check_facts(const io::VolumeInfo& info) {
  require(info.shape.x > 0 && info.shape.y > 0 && info.shape.z > 0, "no axis is empty");
  require(std::max({info.shape.x, info.shape.y, info.shape.z}) <= 1 << 20, "axes have a limit");
  require(!info.format.empty(), "a volume has a format");
  for (std::size_t i = 0; i < 3; ++i) {
    require(std::isfinite(info.space.spacing[i]) && info.space.spacing[i] > 0,
            "spacing is finite and positive");
    require(std::isfinite(info.space.origin[i]), "the origin is finite");
    for (const double x : info.space.axes[i]) {
      require(std::abs(x) <= 1.001, "axes are of unit length");
    }
  }
  for (const io::LabelName& row : info.names.rows()) {
    require(io::clean_name(row.name) == row.name, "names are clean");
  }
}

/// The voxels of the box at once are those of its rows.
void check_box(const io::LabelVolume& volume, const Box3& box) {
  std::vector<RawLabel> whole(static_cast<std::size_t>(box.voxels()));
  volume.read(box, whole);
  auto next = whole.begin();
  std::vector<RawLabel> row(static_cast<std::size_t>(box.hi.x - box.lo.x));
  for (std::int64_t z = box.lo.z; z < box.hi.z; ++z) {
    for (std::int64_t y = box.lo.y; y < box.hi.y; ++y) {
      volume.read({{box.lo.x, y, z}, {box.hi.x, y + 1, z + 1}}, row);
      require(std::equal(row.begin(), row.end(), next), "rows are those of the box");
      next += static_cast<std::ptrdiff_t>(row.size());
    }
  }
}

}  // namespace

void look_at(const io::LabelVolume& volume) {
  check_facts(volume.info());
  const Index3 n = volume.info().shape;
  const Index3 part{std::min<std::int64_t>(n.x, 5), std::min<std::int64_t>(n.y, 4),
                    std::min<std::int64_t>(n.z, 3)};
  check_box(volume, {{0, 0, 0}, part});
  check_box(volume, {n - part, n});
}

}  // namespace mw::fuzz
