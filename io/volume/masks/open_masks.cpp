// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Opens files that have one mask each as a volume of labels.
#include "io/volume/masks/open_masks.h"

#include <algorithm>
#include <array>
#include <optional>

#include "io/file/errors.h"
#include "io/file/folder.h"
#include "io/file/text_numbers.h"
#include "io/remote/address.h"
#include "io/volume/open_volume.h"
#include "io/volume/slices/slice_folder.h"

namespace mw::io {
namespace {

/// Returns a file's name without the ending that masks have, in any case; empty: it has none of
/// these endings.
std::string stem(const std::filesystem::path& path) {
  constexpr std::array<std::string_view, 7> kEndings{".seg.nrrd", ".nii.gz", ".nii", ".nrrd",
                                                     ".nhdr",     ".mha",    ".mhd"};
  const std::string name = path.filename().string(), lower = lower_case(name);
  for (const std::string_view ending : kEndings) {
    if (lower.ends_with(ending)) return name.substr(0, name.size() - ending.size());
  }
  return {};
}

bool is_mask(const std::filesystem::path& path) {
  std::error_code ignored;
  return !stem(path).empty() && path.filename().string().front() != '.' &&
         std::filesystem::is_regular_file(path, ignored);
}

}  // namespace

std::string mask_name(const std::filesystem::path& file) {
  const std::string without_ending = stem(file);
  return without_ending.empty() ? file.filename().string() : without_ending;
}

bool is_mask_folder(const std::filesystem::path& folder) {
  return std::ranges::any_of(entries_in(folder),
                             [&](const std::string& name) { return is_mask(folder / name); });
}

std::unique_ptr<LabelVolume> open_mask_folder(const std::filesystem::path& folder,
                                              const OpenOptions& options) {
  std::vector<std::filesystem::path> files;
  for (const std::string& name : entries_in(folder)) {
    if (is_mask(folder / name)) files.push_back(folder / name);
  }
  std::sort(files.begin(), files.end(), [](const auto& a, const auto& b) {
    return comes_before(a.filename().string(), b.filename().string());
  });
  return open_masks(files, folder.string(), options);
}

std::vector<std::filesystem::path> listed_masks(const std::filesystem::path& list) {
  const std::string all = list.string();
  std::error_code ignored;
  if (all.find(',') == std::string::npos || is_remote_address(all) ||
      std::filesystem::exists(list, ignored)) {
    return {};
  }
  std::vector<std::filesystem::path> out;
  for (const std::string_view mask : split_at(',', all)) out.emplace_back(mask);
  const auto is_file = [](const std::filesystem::path& file) {
    std::error_code none;
    return std::filesystem::is_regular_file(file, none);
  };
  const auto missing = std::find_if_not(out.begin(), out.end(), is_file);
  if (missing == out.end()) return out;
  if (std::none_of(out.begin(), out.end(), is_file)) return {};
  fail_input(all, {},
             missing->empty() ? std::string("the list has an empty name")
                              : text("the list names ", missing->string(), ", which is no file"),
             "check the paths of the list");
}

std::unique_ptr<LabelVolume> open_masks(const std::vector<std::filesystem::path>& files,
                                        const std::string& name, const OpenOptions& options) {
  OpenOptions each = options;
  // What follows from all masks together is found once they are put together.
  each.crop.reset();
  each.object.clear();
  each.overlap = Overlap::kRefused;
  std::optional<MaskMerger> merger;
  for (const std::filesystem::path& file : files) {
    const std::unique_ptr<LabelVolume> mask = open_volume(file, each);
    if (!merger) merger.emplace(mask->info(), options.overlap, name);
    merger->add({.volume = mask.get(),
                 .value = {},
                 .file = file.string(),
                 .name = mask_name(file),
                 .colour = {}});
  }
  return merger->finish();
}

}  // namespace mw::io
