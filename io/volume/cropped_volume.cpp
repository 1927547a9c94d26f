// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// A box of a volume, seen as a volume.
#include "io/volume/cropped_volume.h"

#include "io/file/errors.h"

namespace mw::io {

void check_crop(std::string_view file, const Box3& crop, Index3 shape) {
  const Index3 &lo = crop.lo, &hi = crop.hi;
  const bool is_box = lo.x < hi.x && lo.y < hi.y && lo.z < hi.z;
  if (is_box && intersection(crop, {{0, 0, 0}, shape}) == crop) return;
  fail_usage("--crop ", lo.x, ",", lo.y, ",", lo.z, ",", hi.x, ",", hi.y, ",", hi.z,
             is_box ? ": reaches outside of " : ": no box in ", file, ", which has ", shape.x,
             " x ", shape.y, " x ", shape.z,
             " voxels; give the first voxel and the one past the last, 0 <= first < last");
}

CroppedVolume::CroppedVolume(std::unique_ptr<LabelVolume> volume, const Box3& box,
                             bool moves_origin)
    : VolumeView(std::move(volume)), first_(box.lo), info_(below().info()) {
  info_.shape = box.shape();
  if (below().scores() != nullptr) scores_.emplace(*below().scores(), box);
  info_.first = info_.first + box.lo;
  if (moves_origin) info_.space = moved_to(info_.space, box.lo);
}

void CroppedVolume::read(const Box3& box, std::span<RawLabel> out) const {
  below().read({box.lo + first_, box.hi + first_}, out);
}

std::unique_ptr<LabelVolume> cropped(std::unique_ptr<LabelVolume> volume, std::string_view file,
                                     const OpenOptions& options) {
  if (!options.crop) return volume;
  check_crop(file, *options.crop, volume->info().shape);
  return std::make_unique<CroppedVolume>(std::move(volume), *options.crop, !options.origin);
}

}  // namespace mw::io
