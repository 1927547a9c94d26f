// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// A box of a volume, seen as a volume.
#include "io/volume/cropped_volume.h"

#include "io/file/errors.h"

namespace mw::io {

std::string box_text(const Box3& box) {
  return text(box.lo.x, ",", box.lo.y, ",", box.lo.z, ",", box.hi.x, ",", box.hi.y, ",", box.hi.z);
}

Box3 voxels_of_crop(std::string_view file, const Box3& crop, const VolumeInfo& whole) {
  const Index3 &lo = crop.lo, &hi = crop.hi, &shape = whole.shape;
  const bool is_box = lo.x < hi.x && lo.y < hi.y && lo.z < hi.z;
  const Box3 all{whole.offset, whole.offset + shape};
  if (is_box && intersection(crop, all) == crop) return {lo - whole.offset, hi - whole.offset};
  const std::string counted = whole.offset == Index3{}
                                  ? ""
                                  : text(", ", box_text(all), " as the data set counts them and ",
                                         box_text({{}, shape}), " in its array");
  fail_usage("--crop ", box_text(crop), is_box ? ": reaches outside of " : ": no box in ", file,
             ", which has ", shape.x, " x ", shape.y, " x ", shape.z, " voxels", counted,
             "; give the first voxel and the one past the last, ",
             counted.empty() ? "0 <= first < last" : "as the data set counts them");
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
  const Box3 box = voxels_of_crop(file, *options.crop, volume->info());
  return std::make_unique<CroppedVolume>(std::move(volume), box, !options.origin);
}

}  // namespace mw::io
