// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Looks for volumes in a Zarr store.
#include "io/volume/zarr/store_contents.h"

#include <algorithm>

#include "io/volume/zarr/multiscale.h"
#include "kernels/core/error.h"

namespace mw::io {
namespace {

constexpr std::size_t kMaxVolumes = 100;
constexpr int kMaxDepth = 5;

/// Folders below, sorted.
std::vector<std::string> folders_in(const std::filesystem::path& folder) {
  std::vector<std::string> names;
  std::error_code failed;
  for (std::filesystem::directory_iterator at(folder, failed), end; !failed && at != end;
       at.increment(failed)) {
    std::error_code ignored;
    if (at->is_directory(ignored)) names.push_back(at->path().filename().string());
  }
  std::sort(names.begin(), names.end());
  return names;
}

/// Chunks are in no group, so that their folders are never listed.
void search(const std::filesystem::path& group, const std::string& prefix, int depth,
            std::vector<std::string>& found) {
  if (depth == 0) return;
  for (const std::string& name : folders_in(group)) {
    if (found.size() >= kMaxVolumes) return;
    const std::filesystem::path folder = group / name;
    const auto node = read_zarr_node(folder);
    if (!node) continue;
    if (node->is_array || has_multiscale(node->attributes)) {
      found.push_back(prefix + name);
    } else {
      search(folder, prefix + name + "/", depth - 1, found);
    }
  }
}

}  // namespace

std::vector<std::string> volumes_below(const std::filesystem::path& group) {
  std::vector<std::string> found;
  search(group, "", kMaxDepth, found);
  return found;
}

std::vector<std::string> labels_of_image(const std::filesystem::path& group) {
  try {
    const auto node = read_zarr_node(group / "labels");
    if (!node) return {};
    std::vector<std::string> names = label_images(node->attributes);
    for (std::string& name : names) name.insert(0, "labels/");
    return names;
  } catch (const Error&) {
    return {};
  }
}

std::string listed(const std::vector<std::string>& names) {
  constexpr std::size_t kMax = 20;
  std::string out;
  for (std::size_t i = 0; i < std::min(names.size(), kMax); ++i) {
    out += (i == 0 ? "" : ", ") + names[i].substr(0, 100);
  }
  return names.size() > kMax ? out + ", ..." : out;
}

}  // namespace mw::io
