// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Masks that may overlap become labels that do not; opens files that have one mask each as a volume
// of labels: a folder of them, or a list.
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "io/file/scratch/scratch_file.h"
#include "io/volume/label_volume.h"
#include "io/volume/open_options.h"

namespace mw::io {

/// Slices from `begin` on and before `end`.
struct SliceRange {
  std::int64_t begin = 0;
  std::int64_t end = 0;
};

/// The voxels of a volume that belong to a mask, and what the mask is called.
struct Mask {
  const LabelVolume* volume = nullptr;
  /// The value of its voxels; without one they are all that is not 0, which must be one value.
  std::optional<RawLabel> value;
  /// The slices outside of which the mask is known to have no voxel; the volume is read only there.
  std::optional<std::vector<SliceRange>> slices{};
  std::string file;  ///< what errors call the volume
  std::string name;
  std::optional<Colour> colour;
};

/// ERRORS: mw::Error(kUsage) naming the file where the options say what masks become that overlap:
/// it has one label a voxel, and a rule that says nothing about it is a mistake.
void refuse_overlap_rule(const std::string& file, const OpenOptions& options);

/// Puts masks over each other, one at a time, so that only one of them need be open.  The first
/// mask becomes label 1, the second label 2 and so on; 0 is where no mask is.  With Overlap::kAll
/// each set of masks that have voxels in common gets a label of its own behind them, in the order
/// of the sets' masks, and a name such as "liver + tumour"; VolumeInfo::masks tells which labels
/// each mask has then. Memory: 10 MiB, and some bytes a set.  Two bytes a voxel of a mask wait in
/// $TMPDIR. ERRORS: mw::Error(kResource) naming the folder when the disk is full.
class MaskMerger {
 public:
  /// frame has the shape and place of all masks.  Errors call the masks together `name`.
  MaskMerger(const VolumeInfo& frame, Overlap overlap, std::string name);

  /// ERRORS: mw::Error(kInput) naming files when a mask has another shape or place than the first,
  /// or several values where one is due; when masks overlap and nothing was said about that; when
  /// there are more than 65,535 labels.
  void add(const Mask& mask);

  /// Returns the labels.  REQUIRES: the object is not used afterwards.
  [[nodiscard]] std::unique_ptr<LabelVolume> finish();

 private:
  /// A row of sets_; 0 is the empty set.
  using Set = std::uint16_t;

  struct Refused {
    std::uint64_t voxels = 0;
    Set with = 0;
    Index3 first{0, 0, 0};
  };

  [[nodiscard]] Set new_set(std::vector<std::uint16_t> masks);
  /// Returns the set of a voxel of the mask that is being added.
  [[nodiscard]] Set joined(Set present, Set own);
  void add_slab(const Mask& mask, Set own, const Box3& slab);
  void refuse_overlap(const Mask& mask) const;
  [[nodiscard]] std::vector<RawLabel> label_sets(std::vector<LabelName>& names,
                                                 std::uint64_t& numbering) const;
  [[nodiscard]] std::vector<MaskLabels> masks_of(const std::vector<RawLabel>& labels) const;

  VolumeInfo info_;
  Overlap overlap_;
  std::string name_;
  UnlinkedFile file_;
  std::vector<LabelName> names_;                  ///< names of the masks
  std::vector<std::vector<std::uint16_t>> sets_;  ///< masks of each set, ascending
  std::vector<std::int64_t> voxels_;              ///< how many each set has
  std::map<std::pair<Set, Set>, Set> joins_;
  std::uint64_t overlaps_ = 0;
  std::optional<RawLabel> value_;  ///< that of the mask that is being added
  Refused refused_;
};

/// Returns what a file with one mask is called: its name without the ending of a volume.
[[nodiscard]] std::string mask_name(const std::filesystem::path& file);

/// Whether the folder holds a NIfTI, NRRD or MetaImage file, whose ending may be in any case;
/// hidden files do not count.
[[nodiscard]] bool is_mask_folder(const std::filesystem::path& folder);

/// Opens all these files, in natural order of their names, as masks; other files are not looked at.
/// REQUIRES: is_mask_folder(folder).  ERRORS: those of open_masks().
[[nodiscard]] std::unique_ptr<LabelVolume> open_mask_folder(const std::filesystem::path& folder,
                                                            const OpenOptions& options);

/// Returns the paths of "A,B,C" where this names no file itself and each of its parts does; none
/// where none of its parts names a file.
/// ERRORS: mw::Error(kInput) naming the first part that is no file where others are.
[[nodiscard]] std::vector<std::filesystem::path> listed_masks(const std::filesystem::path& list);

/// Opens files as masks, each named after its file; see MaskMerger.  options.crop is ignored.
/// ERRORS: mw::Error(kInput) naming the file that is no mask, or lies elsewhere than the others.
[[nodiscard]] std::unique_ptr<LabelVolume> open_masks(
    const std::vector<std::filesystem::path>& files, const std::string& name,
    const OpenOptions& options);

}  // namespace mw::io
