// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Makes a grid of labels from frames, each at one place: by masks of segments, or as they are.
#include "io/volume/dicom/open_dicom.h"

#include <algorithm>
#include <array>
#include <cstring>
#include <map>
#include <optional>
#include <string_view>
#include <tuple>
#include <vector>

#include "io/file/errors.h"
#include "io/volume/checks.h"
#include "io/volume/masks/open_masks.h"
#include "io/volume/raw_array.h"
#include "kernels/core/assert.h"
#include "kernels/core/vector3.h"

namespace mw::io {
namespace {

/// Returns length * way.
Vector3 along(const Vector3& way, double length) {
  return {length * way[0], length * way[1], length * way[2]};
}

struct SliceFrame {
  std::int64_t slice = 0;
  std::int64_t frame = 0;
};

/// The frames of a segment by their slices.  Most slices of a segment may have none, and slices may
/// be many more than the file has frames, so there is no list of all slices.
class SliceFrames {
 public:
  void add(SliceFrame frame) { frames_.push_back(frame); }

  /// Sorts the frames, after which the other functions may be called; returns two of one slice, if
  /// there are any.
  [[nodiscard]] std::optional<std::array<std::int64_t, 2>> sort() {
    std::sort(frames_.begin(), frames_.end(), [](const SliceFrame& a, const SliceFrame& b) {
      return std::tie(a.slice, a.frame) < std::tie(b.slice, b.frame);
    });
    const auto same =
        std::adjacent_find(frames_.begin(), frames_.end(),
                           [](const auto& a, const auto& b) { return a.slice == b.slice; });
    if (same == frames_.end()) return std::nullopt;
    return std::array{same->frame, std::next(same)->frame};
  }

  [[nodiscard]] std::optional<std::int64_t> at(std::int64_t slice) const {
    const auto found =
        std::lower_bound(frames_.begin(), frames_.end(), slice,
                         [](const SliceFrame& f, std::int64_t z) { return f.slice < z; });
    if (found == frames_.end() || found->slice != slice) return std::nullopt;
    return found->frame;
  }

  /// Returns the slices that have frames.
  [[nodiscard]] std::vector<SliceRange> slices() const {
    std::vector<SliceRange> out;
    for (const SliceFrame& f : frames_) {
      if (out.empty() || out.back().end != f.slice) out.push_back({f.slice, f.slice});
      ++out.back().end;
    }
    return out;
  }

 private:
  std::vector<SliceFrame> frames_;
};

/// A volume that is 1 at the voxels of one segment, and 0 elsewhere.
class SegmentMask : public LabelVolume {
 public:
  SegmentMask(const DicomSegments& dicom, const VolumeInfo& info, const SliceFrames& frames)
      : dicom_(dicom), info_(info), frames_(frames) {}

  [[nodiscard]] const VolumeInfo& info() const override { return info_; }

  void read(const Box3& box, std::span<RawLabel> out) const override {
    MW_ASSERT(out.size() == static_cast<std::size_t>(box.voxels()));
    std::fill(out.begin(), out.end(), 0);
    const auto width = static_cast<std::size_t>(box.shape().x);
    for (Index3 v = box.lo; v.z < box.hi.z; ++v.z) {
      const auto frame = frames_.at(v.z);
      if (!frame) continue;
      for (v.y = box.lo.y; v.y < box.hi.y; ++v.y) {
        const std::int64_t first = (*frame * info_.shape.y + v.y) * info_.shape.x + v.x;
        read_row(static_cast<std::uint64_t>(first),
                 out.subspan(static_cast<std::size_t>(box.offset(v)), width));
      }
    }
  }

 private:
  /// Reads a row; `first` voxels of the file are before it.
  void read_row(std::uint64_t first, std::span<RawLabel> out) const {
    const auto bits = static_cast<std::uint64_t>(dicom_.grid.bits);
    const std::uint64_t begin = first * bits / 8, end = ((first + out.size()) * bits + 7) / 8;
    std::vector<std::byte> bytes(end - begin);
    dicom_.pixels->read_at(begin, bytes);
    for (std::size_t i = 0; i < out.size(); ++i) {
      const std::uint64_t bit = (first + i) * bits - 8 * begin;
      const auto byte = std::to_integer<unsigned>(bytes[bit / 8]);
      const unsigned value = bits == 1 ? byte >> bit % 8 & 1U : byte;
      out[i] = value >= static_cast<unsigned>(dicom_.grid.threshold) ? 1 : 0;
    }
  }

  const DicomSegments& dicom_;
  const VolumeInfo& info_;
  const SliceFrames& frames_;
};

/// The voxels of a label map.
class LabelMap : public LabelVolume {
 public:
  LabelMap(const DicomSegments& dicom, VolumeInfo info, SliceFrames frames)
      : pixels_(dicom.pixels),
        background_(static_cast<RawLabel>(dicom.grid.background)),
        info_(std::move(info)),
        frames_(std::move(frames)) {}

  [[nodiscard]] const VolumeInfo& info() const override { return info_; }

  void read(const Box3& box, std::span<RawLabel> out) const override {
    MW_ASSERT(out.size() == static_cast<std::size_t>(box.voxels()));
    std::fill(out.begin(), out.end(), background_);
    for (std::int64_t z = box.lo.z; z < box.hi.z; ++z) {
      const auto frame = frames_.at(z);
      if (!frame) continue;
      const Box3 part{{box.lo.x, box.lo.y, z}, {box.hi.x, box.hi.y, z + 1}};
      read_array(*pixels_, slice(z, *frame), part, {box, out});
    }
  }

 private:
  [[nodiscard]] StoredArray slice(std::int64_t z, std::int64_t frame) const {
    const Index3 n = info_.shape;
    return {.first = static_cast<std::uint64_t>(frame * n.x * n.y),
            .strides = {1, n.x, n.x * n.y},
            .coding = {.type = info_.type, .order = ByteOrder::kLittle},
            .box = {{0, 0, z}, {n.x, n.y, z + 1}},
            .name = pixels_->name()};
  }

  std::shared_ptr<const ByteSource> pixels_;
  RawLabel background_;
  VolumeInfo info_;
  SliceFrames frames_;
};

using FramesOfSegments = std::map<std::int32_t, SliceFrames>;

FramesOfSegments frames_by_slice(const DicomSegments& dicom, const SliceGrid& slices,
                                 const std::string& file) {
  const bool is_label_map = dicom.grid.voxels == DicomVoxels::kLabels;
  FramesOfSegments out;
  for (std::size_t i = 0; i < dicom.frames.size(); ++i) {
    out[dicom.frames[i].segment].add({slices.slice(i), static_cast<std::int64_t>(i)});
  }
  for (auto& [segment, frames] : out) {
    const auto same = frames.sort();
    if (!same) continue;
    fail_input(file, "Image Position (Patient)",
               text("frames ", (*same)[0] + 1, " and ", (*same)[1] + 1, " are both ",
                    is_label_map ? "" : text("of segment ", segment, " "), "at one place"),
               is_label_map ? "export segments that overlap as BINARY"
                            : "export it again with one frame for each slice of a segment");
  }
  return out;
}

VolumeInfo info_of(const DicomSegments& dicom, const SliceGrid& slices, const std::string& file,
                   const OpenOptions& options) {
  const DicomGrid& grid = dicom.grid;
  FileSpace space;
  space.steps = {along(grid.along_row, grid.column_spacing),
                 along(grid.along_column, grid.row_spacing), along(slices.normal(), slices.step())};
  space.lengths = Vector3{grid.column_spacing, grid.row_spacing, slices.step()};
  space.first = slices.first();
  space.unit = "mm";
  space.frame = WorldFrame::kLps;
  space.steps_field = "Pixel Spacing, Image Orientation (Patient)";
  space.first_field = "Image Position (Patient)";
  VolumeInfo info{.shape = {grid.columns, grid.rows, slices.count()},
                  .type = grid.bits == 16 ? VoxelType::kU16 : VoxelType::kU8,
                  .format = "dicom"};
  info.space = placed(file, space, options);
  if (const std::int64_t empty = slices.empty(); empty > 0) {
    info.note = text(file, ": ", empty, " of ", slices.count(),
                     " slices have no frame, and are taken to be empty");
  }
  return info;
}

LabelNames names_of(const DicomSegments& dicom) {
  std::vector<LabelName> rows;
  for (const DicomSegment& s : dicom.segments) {
    rows.push_back({.label = static_cast<RawLabel>(s.number), .name = s.name, .colour = s.colour});
  }
  return LabelNames(std::move(rows));
}

std::unique_ptr<LabelVolume> label_map(const DicomSegments& dicom, VolumeInfo info,
                                       SliceFrames frames) {
  info.names = names_of(dicom);
  return std::make_unique<LabelMap>(dicom, std::move(info), std::move(frames));
}

std::unique_ptr<LabelVolume> merged_masks(DicomSegments dicom, const FramesOfSegments& frames,
                                          const VolumeInfo& info, MaskMerger merger) {
  std::sort(dicom.segments.begin(), dicom.segments.end(),
            [](const DicomSegment& a, const DicomSegment& b) { return a.number < b.number; });
  const SliceFrames none;
  for (const DicomSegment& segment : dicom.segments) {
    const auto found = frames.find(segment.number);
    const SliceFrames& own = found == frames.end() ? none : found->second;
    const SegmentMask mask(dicom, info, own);
    merger.add(
        {.volume = &mask,
         .value = 1,
         .slices = own.slices(),
         .file = text(dicom.pixels->name(), ", segment ", segment.number, " '", segment.name, "'"),
         .name = segment.name,
         .colour = segment.colour});
  }
  return merger.finish();
}

}  // namespace

bool has_dicom_magic(std::span<const std::byte> head) {
  constexpr std::size_t kAt = 128;
  constexpr std::string_view kMagic = "DICM";
  return head.size() >= kAt + kMagic.size() &&
         std::memcmp(head.data() + kAt, kMagic.data(), kMagic.size()) == 0;
}

std::unique_ptr<LabelVolume> open_dicom(std::unique_ptr<ByteSource> source,
                                        const OpenOptions& options) {
  const std::string file = source->name();
  DicomSegments dicom = read_dicom_segments(*source);
  const SliceGrid slices(dicom, file);
  FramesOfSegments frames = frames_by_slice(dicom, slices, file);
  const VolumeInfo info = info_of(dicom, slices, file, options);
  if (dicom.grid.voxels == DicomVoxels::kLabels) {
    refuse_overlap_rule(file, options);
    return label_map(dicom, info, std::move(frames.at(kAllSegments)));
  }
  return merged_masks(std::move(dicom), frames, info, MaskMerger(info, options.overlap, file));
}

}  // namespace mw::io
