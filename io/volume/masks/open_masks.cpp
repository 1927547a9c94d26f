// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Opens files that have one mask each as a volume of labels.
#include "io/volume/masks/open_masks.h"

#include <algorithm>
#include <array>
#include <optional>

#include "io/volume/masks/mask_merger.h"
#include "io/volume/open_volume.h"
#include "io/volume/slices/slice_folder.h"

namespace mw::io {
namespace {

/// Returns a file's name without the ending that masks have; empty: it has none of these endings.
std::string stem(const std::filesystem::path& path) {
  constexpr std::array<std::string_view, 7> kEndings{".seg.nrrd", ".nii.gz", ".nii", ".nrrd",
                                                     ".nhdr",     ".mha",    ".mhd"};
  const std::string name = path.filename().string();
  for (const std::string_view ending : kEndings) {
    if (name.ends_with(ending)) return name.substr(0, name.size() - ending.size());
  }
  return {};
}

bool is_mask(const std::filesystem::directory_entry& entry) {
  std::error_code ignored;
  return !stem(entry.path()).empty() && entry.path().filename().string().front() != '.' &&
         entry.is_regular_file(ignored);
}

}  // namespace

std::string mask_name(const std::filesystem::path& file) {
  const std::string without_ending = stem(file);
  return without_ending.empty() ? file.filename().string() : without_ending;
}

bool is_mask_folder(const std::filesystem::path& folder) {
  const auto found = entries_of(folder);
  return std::any_of(begin(found), end(found), is_mask);
}

std::unique_ptr<LabelVolume> open_mask_folder(const std::filesystem::path& folder,
                                              const OpenOptions& options) {
  std::vector<std::filesystem::path> files;
  for (const auto& entry : entries_of(folder)) {
    if (is_mask(entry)) files.push_back(entry.path());
  }
  std::sort(files.begin(), files.end(), [](const auto& a, const auto& b) {
    return comes_before(a.filename().string(), b.filename().string());
  });
  return open_masks(files, folder.string(), options);
}

std::vector<std::filesystem::path> listed_masks(const std::filesystem::path& list) {
  const std::string text = list.string();
  std::error_code ignored;
  if (text.find(',') == std::string::npos || std::filesystem::exists(list, ignored)) return {};
  std::vector<std::filesystem::path> out;
  for (std::size_t at = 0; at <= text.size();) {
    const std::size_t end = std::min(text.find(',', at), text.size());
    out.emplace_back(text.substr(at, end - at));
    if (!std::filesystem::is_regular_file(out.back(), ignored)) return {};
    at = end + 1;
  }
  return out;
}

std::unique_ptr<LabelVolume> open_masks(const std::vector<std::filesystem::path>& files,
                                        const std::string& name, const OpenOptions& options) {
  OpenOptions each = options;
  each.crop.reset();
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
