// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// A folder that is read in the natural order of its names.
#include "io/volume/slices/slice_folder.h"

#include <algorithm>
#include <cstdint>

#include "io/file/errors.h"
#include "io/file/folder.h"
#include "io/file/text_numbers.h"
#include "io/volume/checks.h"
#include "io/volume/png/open_png.h"
#include "io/volume/tiff/open_tiff.h"

namespace mw::io {

namespace {

std::string lower_extension(const std::filesystem::path& path) {
  return lower_case(path.extension().string());
}

bool is_png(const std::filesystem::path& path) {
  return lower_extension(path) == ".png";
}

bool is_slice(const std::filesystem::path& path) {
  const std::string extension = lower_extension(path);
  std::error_code ignored;
  return (extension == ".tif" || extension == ".tiff" || extension == ".png") &&
         path.filename().string().front() != '.' && std::filesystem::is_regular_file(path, ignored);
}

std::vector<std::string> slice_names(const std::filesystem::path& folder) {
  std::vector<std::string> names;
  for (std::string& name : entries_in(folder)) {
    if (is_slice(folder / name)) names.push_back(std::move(name));
    if (static_cast<std::int64_t>(names.size()) > kMaxAxisVoxels) {
      fail_input(folder.string(), {}, text("more than ", kMaxAxisVoxels, " slices"),
                 "cut the volume into parts");
    }
  }
  std::sort(names.begin(), names.end(), comes_before);
  return names;
}

void check_names(const std::filesystem::path& folder, const std::vector<std::string>& names) {
  const auto other = std::find_if(names.begin(), names.end(), [&](const std::string& name) {
    return is_png(name) != is_png(names.front());
  });
  if (other != names.end()) {
    fail_input(folder.string(), {},
               text("it holds TIFF and PNG files: ", names.front(), " and ", *other),
               "keep those of one volume in it");
  }
  if (const auto gap = find_gap(names)) {
    fail_input((folder / gap->b).string(), {},
               text("it follows ", gap->a, ", by another step than the others do"),
               "put the missing slice there, or number them in even steps");
  }
}

}  // namespace

bool is_slice_folder(const std::filesystem::path& folder) {
  return std::ranges::any_of(entries_in(folder),
                             [&](const std::string& name) { return is_slice(folder / name); });
}

std::unique_ptr<LabelVolume> open_slice_folder(const std::filesystem::path& folder,
                                               const OpenOptions& options) {
  const std::vector<std::string> names = slice_names(folder);
  check_names(folder, names);
  std::vector<std::filesystem::path> files;
  for (const std::string& name : names) files.push_back(folder / name);
  return is_png(files.front()) ? open_png_slices(std::move(files), options)
                               : open_tiff_slices(std::move(files), options);
}

}  // namespace mw::io
