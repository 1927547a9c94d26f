// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Puts masks over each other: each voxel has the number of the set of masks that it is in.
#include "io/volume/masks/open_masks.h"

#include <algorithm>
#include <limits>
#include <set>
#include <utility>

#include "io/file/errors.h"
#include "io/file/source/file_source.h"
#include "io/volume/checks.h"
#include "io/volume/raw_array.h"
#include "kernels/core/mix_bits.h"
#include "kernels/core/sort_distinct.h"

namespace mw::io {
namespace {

constexpr std::int64_t kSlabVoxels = 1 << 20;
constexpr std::size_t kMostSets = std::numeric_limits<std::uint16_t>::max();

/// Shows an array of the numbers of sets as the labels of the sets.
class SetVolume : public VolumeView {
 public:
  SetVolume(std::unique_ptr<LabelVolume> sets, std::vector<RawLabel> labels)
      : VolumeView(std::move(sets)), labels_(std::move(labels)) {}

  void read(const Box3& box, std::span<RawLabel> out) const override {
    below().read(box, out);
    for (RawLabel& label : out) label = labels_[static_cast<std::size_t>(label)];
  }

 private:
  std::vector<RawLabel> labels_;
};

/// Calls visit(box) on slabs of about kSlabVoxels voxels that cover these slices of a volume, in
/// order.  A slab is a run of whole slices or, where slices are large, of whole rows of one.
template <typename Visit>
void each_slab(Index3 shape, SliceRange range, Visit visit) {
  const std::int64_t rows = std::clamp<std::int64_t>(kSlabVoxels / shape.x, 1, shape.y);
  const std::int64_t slices =
      std::clamp<std::int64_t>(kSlabVoxels / (shape.x * shape.y), 1, shape.z);
  for (std::int64_t z = range.begin; z < range.end; z += slices) {
    for (std::int64_t y = 0; y < shape.y; y += rows) {
      visit(
          Box3{{0, y, z}, {shape.x, std::min(y + rows, shape.y), std::min(z + slices, range.end)}});
    }
  }
}

}  // namespace

void refuse_overlap_rule(const std::string& file, const OpenOptions& options) {
  if (options.overlap == Overlap::kRefused) return;
  fail_usage("--overlap: ", file,
             " has one label a voxel, so that none overlap; it is for "
             "masks");
}

MaskMerger::MaskMerger(const VolumeInfo& frame, Overlap overlap, std::string name)
    : info_{.shape = frame.shape,
            .space = frame.space,
            .type = VoxelType::kU16,
            .format = "masks",
            .is_placed = frame.is_placed,
            .note = frame.note},
      overlap_(overlap),
      name_(std::move(name)),
      file_(scratch_folder()),
      sets_(1),
      voxels_(1) {
  // What is not written in front of it reads as zeros.
  const Set none = 0;
  file_.write_at(payload_bytes(info_) - sizeof(Set), std::as_bytes(std::span(&none, 1)));
}

MaskMerger::Set MaskMerger::new_set(std::vector<std::uint16_t> masks) {
  if (sets_.size() > kMostSets) {
    fail_input(name_, "masks", text("there are more than ", kMostSets, " sets of masks"),
               "give --overlap first or last");
  }
  sets_.push_back(std::move(masks));
  voxels_.push_back(0);
  return static_cast<Set>(sets_.size() - 1);
}

MaskMerger::Set MaskMerger::joined(Set present, Set own) {
  if (present == 0) return own;
  ++overlaps_;
  if (overlap_ != Overlap::kAll) return overlap_ == Overlap::kLast ? own : present;
  const auto [at, is_new] = joins_.try_emplace({present, own}, Set{0});
  if (is_new) {
    std::vector<std::uint16_t> masks = sets_[present];
    masks.push_back(sets_[own].front());
    at->second = new_set(std::move(masks));
  }
  return at->second;
}

void MaskMerger::add_slab(const Mask& mask, Set own, const Box3& slab) {
  const auto count = static_cast<std::size_t>(slab.voxels());
  std::vector<RawLabel> labels(count);
  std::vector<Set> sets(count);
  mask.volume->read(slab, labels);
  const std::uint64_t offset =
      static_cast<std::uint64_t>(Box3{{0, 0, 0}, info_.shape}.offset(slab.lo)) * sizeof(Set);
  file_.read_at(offset, std::as_writable_bytes(std::span(sets)));
  bool is_changed = false;
  for (std::size_t i = 0; i < count; ++i) {
    if (mask.value ? labels[i] != *mask.value : labels[i] == 0) continue;
    if (!value_) value_ = labels[i];
    if (labels[i] != *value_) {
      fail_input(mask.file, "mask",
                 text("it has the labels ", *value_, " and ", labels[i], ", a mask has one"),
                 "give a volume of labels by itself");
    }
    const Set present = sets[i];
    if (present != 0 && overlap_ == Overlap::kRefused && refused_.voxels++ == 0) {
      refused_.with = present;
      refused_.first =
          Index3{static_cast<std::int64_t>(i) % info_.shape.x,
                 slab.lo.y + static_cast<std::int64_t>(i) / info_.shape.x % slab.shape().y,
                 slab.lo.z + static_cast<std::int64_t>(i) / (info_.shape.x * slab.shape().y)};
    }
    sets[i] = joined(present, own);
    --voxels_[present];
    ++voxels_[sets[i]];
    is_changed = true;
  }
  if (is_changed) file_.write_at(offset, std::as_bytes(std::span(sets)));
}

void MaskMerger::refuse_overlap(const Mask& mask) const {
  const Index3& at = refused_.first;
  const LabelName& other = names_[sets_[refused_.with].front()];
  fail_input(mask.file, "mask",
             text(refused_.voxels, " of its voxels are in other masks, too; the first is ", at.x,
                  ",", at.y, ",", at.z, " of ",
                  other.name.empty() ? text("mask ", other.label) : text("'", other.name, "'")),
             "give --overlap first, last or all");
}

void MaskMerger::add(const Mask& mask) {
  check_same_grid(mask.file, mask.volume->info(), info_, "masks");
  value_ = mask.value;
  const Set own = new_set({static_cast<std::uint16_t>(names_.size())});
  names_.push_back({.label = names_.size() + 1, .name = mask.name, .colour = mask.colour});
  info_.numbering = mix_text(mask.file, info_.numbering);
  for (const SliceRange& range : mask.slices.value_or(std::vector{SliceRange{0, info_.shape.z}})) {
    each_slab(info_.shape, range, [&](const Box3& slab) { add_slab(mask, own, slab); });
  }
  if (refused_.voxels != 0) refuse_overlap(mask);
}

/// Returns the label of each set, and adds those that have several masks to names and numbering.
std::vector<RawLabel> MaskMerger::label_sets(std::vector<LabelName>& names,
                                             std::uint64_t& numbering) const {
  std::vector<RawLabel> labels(sets_.size());
  std::vector<std::size_t> several;
  for (std::size_t set = 1; set < sets_.size(); ++set) {
    if (sets_[set].size() == 1) labels[set] = sets_[set].front() + 1U;
    if (sets_[set].size() > 1 && voxels_[set] > 0) several.push_back(set);
  }
  std::sort(several.begin(), several.end(),
            [&](std::size_t a, std::size_t b) { return sets_[a] < sets_[b]; });
  for (const std::size_t set : several) {
    labels[set] = names.size() + 1;
    std::string joined;
    for (const std::uint16_t mask : sets_[set]) {
      joined += (joined.empty() ? "" : " + ") + names_[mask].name;
    }
    names.push_back({.label = labels[set], .name = joined, .colour = {}});
    for (const std::uint16_t mask : sets_[set]) numbering = mix_bits(numbering ^ (mask + 1U));
    numbering = mix_bits(numbering);  // the set ends
  }
  return labels;
}

/// Returns the masks that have voxels, with the labels of the sets that they are in.  Masks of one
/// name are told apart by their numbers.
std::vector<MaskLabels> MaskMerger::masks_of(const std::vector<RawLabel>& labels) const {
  std::vector<MaskLabels> out(names_.size());
  for (std::size_t set = 1; set < sets_.size(); ++set) {
    if (voxels_[set] == 0) continue;
    for (const std::uint16_t mask : sets_[set]) out[mask].labels.push_back(labels[set]);
  }
  std::set<std::string> taken;
  for (std::size_t mask = 0; mask < out.size(); ++mask) {
    sort_distinct(out[mask].labels);
    out[mask].name = clean_name(names_[mask].name);
    const std::string number = std::to_string(names_[mask].label);
    if (out[mask].name.empty()) out[mask].name = number;
    while (!taken.insert(out[mask].name).second) {
      out[mask].name += " (" + number + ")";
      if (out[mask].name.size() > kMaxNameBytes) out[mask].name = number;
    }
  }
  std::erase_if(out, [](const MaskLabels& mask) { return mask.labels.empty(); });
  return out;
}

std::unique_ptr<LabelVolume> MaskMerger::finish() {
  std::vector<LabelName> names = names_;
  std::vector<RawLabel> labels = label_sets(names, info_.numbering);
  if (overlap_ == Overlap::kAll) info_.masks = masks_of(labels);
  if (overlaps_ != 0) {
    info_.note += text(info_.note.empty() ? "" : "; ", name_, ": ", overlaps_,
                       " voxels are in several masks");
  }
  info_.names = LabelNames(std::move(names));
  const std::uint64_t bytes = payload_bytes(info_);
  auto source = std::make_unique<FileSource>(file_.release(), bytes, name_);
  auto sets =
      std::make_unique<RawArrayVolume>(std::move(source), info_, ArrayLayout{.order = kHostOrder});
  return std::make_unique<SetVolume>(std::move(sets), std::move(labels));
}

}  // namespace mw::io
