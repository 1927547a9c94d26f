// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// What a DICOM segmentation says: its segments, its frames and the slices on which these lie; and
// opens it as a volume of labels.
// Format: https://dicom.nema.org/medical/dicom/current/output/chtml/part03/sect_A.51.html
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "io/file/source/byte_source.h"
#include "io/names/label_names.h"
#include "io/volume/open_options.h"
#include "io/volume/volume_space.h"

namespace mw::io {

/// The way out that errors name where a file is damaged.
inline constexpr const char* kCheckDicom = "check that the file is complete, or export it again";

/// What a voxel says.
enum class DicomVoxels : std::int32_t {
  kMasks,   ///< whether it belongs to the segment of its frame
  kLabels,  ///< the number of its segment (Segmentation Type LABELMAP)
};

/// The segment of frames of a label map, which have voxels of all segments.
inline constexpr std::int32_t kAllSegments = 0;

/// What all frames have in common.  Lengths are in mm, places in DICOM's patient coordinates (LPS).
struct DicomGrid {
  std::int32_t rows = 0;
  std::int32_t columns = 0;
  DicomVoxels voxels = DicomVoxels::kMasks;
  std::int32_t bits = 1;        ///< bits of a voxel: 1 or 8 in masks, 8 or 16 in label maps
  std::int32_t threshold = 1;   ///< in masks, the least value of a voxel of the segment
  std::int32_t background = 0;  ///< in label maps, the value of voxels of no segment
  Vector3 along_row{1, 0, 0};   ///< direction from a voxel to the next column
  Vector3 along_column{0, 1, 0};
  double column_spacing = 0;  ///< between columns
  double row_spacing = 0;
  double slice_spacing = 0;    ///< 0: the file does not say
  double slice_thickness = 0;  ///< 0: the file does not say
};

struct DicomSegment {
  std::int32_t number = 0;
  std::string name;
  std::optional<Colour> colour;
};

/// A slice of one segment, or of all of them.
struct DicomFrame {
  std::int32_t segment = kAllSegments;
  Vector3 first{};  ///< the centre of its first voxel
};

/// Frames follow each other in `pixels` without gaps, rows first, as DICOM packs them: where voxels
/// have one bit, the lowest bit of a byte comes first; where they have 16, the lower byte does.
struct DicomSegments {
  DicomGrid grid;
  std::vector<DicomSegment> segments;
  std::vector<DicomFrame> frames;
  std::shared_ptr<const ByteSource> pixels;
};

/// Whether the grid has a size, spacings and directions that a file can have.  The process that
/// reads the file checks all that, too, but is not to be believed, as the file may have taken it
/// over.
[[nodiscard]] bool is_sound(const DicomGrid& grid);
/// Whether the grid is sound, and segments and frames keep what read_dicom_segments() promises.  It
/// does not look at the pixels.
[[nodiscard]] bool is_sound(const DicomSegments& dicom);

/// Reads a file of the classes Segmentation Storage and Label Map Segmentation Storage, in a
/// process of its own (io/file/wall/apart.h).
/// Memory: the headers of the frames, some kilobytes each, packed pixels, and one frame unpacked,
/// in that process only; the pixels go to $TMPDIR.
/// ENSURES: there are frames, each of a segment that is there, or of all in a label map, and pixels
/// of all of them; numbers are finite.  A label map may have labels that no segment has.
/// ERRORS: mw::Error(kInput) naming file and attribute for damage, for images and for types of
/// segmentations that are not read; kResource when the disk is full or there can be no process.
[[nodiscard]] DicomSegments read_dicom_segments(const ByteSource& source);

/// Equal steps along the normal of the frames' plane, each of which is a slice.
/// The step is the Spacing Between Slices that the file states where frames agree with it: where
/// each lies within a twentieth of a step of a multiple of it.  Coordinates may be rounded and the
/// spacing, too, by up to a hundredth; then the step is the one that fits the frames best.  Where
/// no spacing is stated, or frames contradict it, the step is the Slice Thickness if this is the
/// least distance of two slices, else the distance that most neighbours have (the median).
class SliceGrid {
 public:
  /// REQUIRES: is_sound(dicom).
  /// ERRORS: mw::Error(kInput) naming the frames that lie off all multiples of the step, or beside
  /// the others; the file is called `file`.
  SliceGrid(const DicomSegments& dicom, const std::string& file);

  /// Returns how many slices there are from the first to the last frame.
  [[nodiscard]] std::int64_t count() const { return count_; }
  /// Returns the slice of a frame.
  [[nodiscard]] std::int64_t slice(std::size_t frame) const { return slices_[frame]; }
  /// Returns how many of the slices have no frame.
  [[nodiscard]] std::int64_t empty() const;
  [[nodiscard]] const Vector3& normal() const { return normal_; }
  /// Returns the centre of the first voxel of slice 0.
  [[nodiscard]] const Vector3& first() const { return first_; }
  [[nodiscard]] double step() const { return step_; }

 private:
  void check_beside(const DicomSegments& dicom, const std::string& file) const;

  Vector3 normal_;
  double step_ = 0;
  std::vector<std::int64_t> slices_;  ///< those of the frames
  std::int64_t count_ = 0;
  Vector3 first_{};
};

/// Whether this is the beginning of a DICOM file.
[[nodiscard]] bool has_dicom_magic(std::span<const std::byte> head);

/// Segments become labels as masks do, in the order of their numbers (MaskMerger), with their
/// names; slices without a frame are empty.  Voxels of FRACTIONAL segments count from half of the
/// largest value on.  Labels of a LABELMAP stay as they are, numbers of segments, and have their
/// names; slices without a frame have its Pixel Padding Value, or 0.
/// Array axes: columns, rows, slices along the normal.
/// ERRORS: those of read_dicom_segments() and MaskMerger; mw::Error(kInput) when frames do not lie
/// on one grid, or two frames of a segment, or of a label map, lie at one place.
[[nodiscard]] std::unique_ptr<LabelVolume> open_dicom(std::unique_ptr<ByteSource> source,
                                                      const OpenOptions& options);

}  // namespace mw::io
