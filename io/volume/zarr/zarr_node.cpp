// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Groups and arrays of a Zarr store.
#include "io/volume/zarr/open_zarr.h"

#include <algorithm>

#include "io/json/json_fields.h"
#include "io/volume/zarr/multiscale.h"
#include "kernels/core/error.h"

namespace mw::io {
namespace {

bool has_document(const Place& folder, const char* name) {
  return (folder / name).is_document();
}

Json object_or_none(const Json& document, const std::string& file, const char* key) {
  const JsonFields fields(document, file);
  if (!fields.has(key)) return Json::object();
  static_cast<void>(fields.object(key));  // checks that it is one
  return document[key];
}

ZarrNode read_v3(const Place& folder) {
  const Place path = folder / "zarr.json";
  ZarrNode node{.folder = folder, .version = 3};
  node.metadata_file = node.attributes_file = path.string();
  node.metadata = read_json(path);
  const JsonFields fields(node.metadata, node.metadata_file);
  const std::string type = fields.text("node_type");
  if (type != "array" && type != "group") {
    fields.fail("node_type", "'" + type.substr(0, 60) + "' is neither 'array' nor 'group'",
                "the file is damaged");
  }
  node.is_array = type == "array";
  node.attributes = object_or_none(node.metadata, node.metadata_file, "attributes");
  return node;
}

ZarrNode read_v2(const Place& folder) {
  ZarrNode node{.folder = folder, .version = 2};
  node.is_array = has_document(folder, ".zarray");
  node.metadata_file = (folder / ".zarray").string();
  node.attributes_file = (folder / ".zattrs").string();
  node.attributes = Json::object();
  if (node.is_array) {
    node.metadata = read_json(folder / ".zarray");
    return node;
  }
  if (!has_document(folder, ".zattrs")) return node;
  node.attributes = read_json(folder / ".zattrs");
  static_cast<void>(JsonFields(node.attributes, node.attributes_file));  // checks that it is one
  return node;
}

constexpr std::size_t kMaxVolumes = 100;
constexpr int kMaxDepth = 5;

/// Looks through groups only, so that the folders of chunks are never listed.
void search(const Place& group, const std::string& prefix, int depth,
            std::vector<std::string>& found) {
  if (depth == 0) return;
  const auto names = group.folders();
  if (!names) return;
  for (const std::string& name : *names) {
    if (found.size() >= kMaxVolumes) return;
    const Place folder = group / name;
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

bool is_zarr_node(const Place& folder) {
  constexpr std::array kFiles{"zarr.json", ".zarray", ".zgroup", ".zattrs"};
  return std::any_of(kFiles.begin(), kFiles.end(),
                     [&](const char* file) { return has_document(folder, file); });
}

std::optional<ZarrNode> read_zarr_node(const Place& folder) {
  if (has_document(folder, "zarr.json")) return read_v3(folder);
  if (is_zarr_node(folder)) return read_v2(folder);
  return std::nullopt;
}

std::optional<Place> path_in_store(const Place& folder, std::string_view path) {
  Place out = folder;
  while (!path.empty()) {
    const std::size_t end = std::min(path.find('/'), path.size());
    const std::string_view part = path.substr(0, end);
    path.remove_prefix(std::min(end + 1, path.size()));
    if (part == ".." || part.find('\0') != part.npos) return std::nullopt;
    if (!part.empty() && part != ".") out = out / part;
  }
  return out;
}

std::vector<std::string> volumes_below(const Place& group) {
  std::vector<std::string> found;
  search(group, "", kMaxDepth, found);
  return found;
}

std::vector<std::string> labels_of_image(const Place& group) {
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
