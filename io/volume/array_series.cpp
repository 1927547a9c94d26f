// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Opens volumes that lie one behind the other as labels or as numbers.
#include "io/volume/array_series.h"

#include <vector>

#include "io/file/errors.h"
#include "io/volume/checks.h"
#include "io/volume/masks/open_masks.h"
#include "io/volume/number_volume.h"

namespace mw::io {
namespace {

using SharedSource = std::shared_ptr<const ByteSource>;

std::shared_ptr<const LabelVolume> part(const SharedSource& source, const VolumeInfo& info,
                                        const ArrayLayout& first, std::int64_t i) {
  ArrayLayout layout = first;
  layout.offset += static_cast<std::uint64_t>(i) * payload_bytes(info);
  return std::make_shared<RawArrayVolume>(source, info, layout);
}

/// Merges masks that lie one behind the other to labels.
std::unique_ptr<LabelVolume> merge(const SharedSource& source, const VolumeInfo& info,
                                   const ArrayLayout& first, std::int64_t count, Overlap overlap) {
  MaskMerger merger(info, overlap, source->name());
  for (std::int64_t i = 0; i < count; ++i) {
    const std::shared_ptr<const LabelVolume> volume = part(source, info, first, i);
    merger.add({.volume = volume.get(), .file = text(source->name(), ", volume ", i)});
  }
  return merger.finish();
}

}  // namespace

std::unique_ptr<LabelVolume> open_series(std::unique_ptr<ByteSource> source, VolumeInfo info,
                                         const ArrayLayout& first, std::int64_t count,
                                         const OpenOptions& options) {
  check_payload(*source, info, first.offset, BytesBehind::kIgnored,
                static_cast<std::uint64_t>(count));
  const SharedSource shared = std::move(source);
  if (count == 1) {
    refuse_overlap_rule(shared->name(), options);
    return std::make_unique<RawArrayVolume>(shared, std::move(info), first);
  }
  if (options.values == VoxelValues::kLabels) {
    return merge(shared, info, first, count, options.overlap);
  }
  std::vector<std::shared_ptr<const LabelVolume>> parts;
  for (std::int64_t i = 0; i < count; ++i) parts.push_back(part(shared, info, first, i));
  return std::make_unique<NumberStack>(std::move(parts));
}

}  // namespace mw::io
