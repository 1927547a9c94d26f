// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Opens the files of scores.
#include "io/volume/scores/open_scores.h"

#include <limits>

#include "io/file/errors.h"
#include "io/volume/checks.h"
#include "io/volume/masks/open_masks.h"

namespace mw::io {
namespace {

void check_options(const std::filesystem::path& path, const OpenOptions& options) {
  if (options.overlap == Overlap::kRefused) return;
  fail_usage("--overlap: ", path.string(),
             " is read as probabilities or distances, of which the best wins; it is for "
             "masks");
}

void check_numbers_of(const ScoreComponent& component) {
  if (dynamic_cast<const NumberVolume*>(component.volume.get()) != nullptr) return;
  fail_input(component.name, {},
             "numbers of a " + component.volume->info().format + " file are not read here",
             "give them as .npy, NIfTI, NRRD, MetaImage, HDF5, Zarr or N5");
}

/// Adds the volume, or each part of it where it is a stack.
void add_components(std::unique_ptr<LabelVolume> opened, const std::string& file,
                    std::vector<ScoreComponent>& out) {
  const std::shared_ptr<const LabelVolume> volume = std::move(opened);
  const auto* const stack = dynamic_cast<const NumberStack*>(volume.get());
  if (stack == nullptr) {
    out.push_back({volume, file});
    return;
  }
  for (const auto& part : stack->parts()) {
    out.push_back({part, text(file, ", component ", &part - stack->parts().data())});
  }
}

LabelNames names_of_files(const std::vector<std::filesystem::path>& files, VoxelValues values) {
  std::vector<LabelName> rows;
  RawLabel label = ScoredLabels::has_ground(files.size(), values) ? 1 : 0;
  for (const std::filesystem::path& file : files) {
    rows.push_back({.label = label++, .name = mask_name(file), .colour = {}});
  }
  return LabelNames(std::move(rows));
}

}  // namespace

std::unique_ptr<LabelVolume> open_scores(
    const std::filesystem::path& path, const OpenOptions& options,
    const std::function<std::unique_ptr<LabelVolume>(const std::filesystem::path&,
                                                     const OpenOptions&)>& open) {
  check_options(path, options);
  std::vector<std::filesystem::path> files = listed_masks(path);
  if (files.empty()) files.push_back(path);
  OpenOptions each = options;
  each.crop.reset();
  each.cache_bytes /= files.size();
  std::vector<ScoreComponent> components;
  for (const std::filesystem::path& file : files) {
    add_components(open(file, each), file.string(), components);
  }
  constexpr std::size_t kMostComponents = std::numeric_limits<std::uint16_t>::max();
  if (components.size() > kMostComponents) {
    fail_input(path.string(), {}, text("there are more than ", kMostComponents, " components"));
  }
  for (const ScoreComponent& c : components) check_numbers_of(c);
  const VolumeInfo& first = components.front().volume->info();
  for (const ScoreComponent& c : components) {
    check_same_grid(c.name, c.volume->info(), first, "values");
  }
  LabelNames names = components.size() == files.size() ? names_of_files(files, options.values)
                                                       : components.front().volume->info().names;
  return std::make_unique<ScoredLabels>(std::move(components), options.values, std::move(names));
}

}  // namespace mw::io
