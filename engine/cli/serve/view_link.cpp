// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// A link that shows a folder of precomputed meshes in neuroglancer.
#include "engine/cli/serve/view_link.h"

#include <algorithm>
#include <functional>
#include <ranges>

#include "io/file/errors.h"
#include "io/file/source/file_source.h"
#include "io/json/json.h"
#include "io/json/json_fields.h"
#include "io/store/place.h"

namespace mw::cli {
namespace {

constexpr const char* kBox = "mwmesh_box";
constexpr std::size_t kMostShown = 100;
/// Room for the properties of some million segments.
constexpr std::uint64_t kMostInfoBytes = 256ULL << 20U;

/// Returns the numbers by which segments are large: volumes, or areas where surfaces are open.
std::vector<double> read_sizes(const io::JsonFields& inlined) {
  std::vector<double> areas;
  for (std::size_t i = 0; i < inlined.count("properties"); ++i) {
    const io::JsonFields property = inlined.element("properties", i);
    if (property.text("id") == "volume") return property.numbers("values");
    if (property.text("id") == "area") areas = property.numbers("values");
  }
  return areas;
}

std::vector<std::string> largest_segments(const io::JsonFields& inlined) {
  const std::vector<std::string> ids = inlined.texts("ids");
  const std::vector<double> sizes = read_sizes(inlined);
  if (sizes.size() != ids.size()) inlined.fail("properties", "has no size for each of the ids");
  std::vector<std::size_t> rows;
  for (std::size_t i = 0; i < ids.size(); ++i) {
    if (ids[i] != "0") rows.push_back(i);  // neuroglancer takes 0 for what is no segment
  }
  std::ranges::stable_sort(rows, std::greater(), [&](std::size_t row) { return sizes[row]; });
  std::vector<std::string> out;
  for (const std::size_t row : rows | std::views::take(kMostShown)) out.push_back(ids[row]);
  return out;
}

void read_box(const io::Json& info, const io::JsonFields& fields, FolderView& view) {
  if (!fields.is_array(kBox) || info[kBox].elements().size() != 2) {
    fields.fail(kBox, "is no pair of corners");
  }
  const io::Json box{{"low", info[kBox].elements()[0]}, {"high", info[kBox].elements()[1]}};
  view.low = io::JsonFields(box, fields.file(), kBox).numbers3("low");
  view.high = io::JsonFields(box, fields.file(), kBox).numbers3("high");
}

std::string name_of(const std::filesystem::path& folder) {
  return std::filesystem::absolute(folder / "").lexically_normal().parent_path().filename();
}

/// Writes every byte that may have a meaning in a link, or none at all, as %HH.
std::string percent_encoded(std::string_view text) {
  constexpr std::string_view kPlain =
      "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789-._~/";
  constexpr std::string_view kDigits = "0123456789ABCDEF";
  std::string out;
  for (const char c : text) {
    const auto byte = static_cast<unsigned char>(c);
    if (kPlain.find(c) != kPlain.npos) {
      out += c;
    } else {
      out += {'%', kDigits[byte >> 4U], kDigits[byte & 0xfU]};
    }
  }
  return out;
}

FolderView read_meshes(const std::filesystem::path& folder) {
  const std::filesystem::path path = folder / "info";
  const io::Json info = io::read_json(path, kMostInfoBytes);
  const io::JsonFields fields(info, path.string());
  FolderView view{.name = name_of(folder)};
  read_box(info, fields, view);
  constexpr const char* kProperties = "segment_properties";
  const std::filesystem::path below =
      io::named_path(path, kProperties, fields.text(kProperties), false) / "info";
  const io::Json properties = io::read_json(below, kMostInfoBytes);
  view.segments = largest_segments(io::JsonFields(properties, below.string()).object("inline"));
  return view;
}

}  // namespace

FolderView read_folder_view(const std::filesystem::path& folder) {
  try {
    return read_meshes(folder);
  } catch (const Error& error) {
    if (error.kind() != ErrorKind::kInput) throw;
    io::fail_input(folder.string(), {},
                   io::text("no precomputed meshes of mwmesh here (", error.what(), ")"),
                   "write them by mwmesh surface MESH --format draco -o FOLDER");
  }
}

std::string view_link(const FolderView& view, const std::string& address,
                      const std::string& viewer) {
  io::Json::Array centre;
  double longest = 0;
  for (std::size_t k = 0; k < 3; ++k) {
    centre.push_back((view.low[k] + view.high[k]) / 2);
    longest = std::max(longest, view.high[k] - view.low[k]);
  }
  const io::Json metre = io::Json::Array{1e-9, "m"};
  const io::Json layer{{"type", "segmentation"},
                       {"name", view.name},
                       {"source", "precomputed://" + address},
                       {"segments", view.segments}};
  const io::Json state{{"dimensions", {{"x", metre}, {"y", metre}, {"z", metre}}},
                       {"position", centre},
                       {"projectionScale", 2 * longest},
                       {"layout", "3d"},
                       {"showSlices", false},
                       {"layers", io::Json::Array{layer}}};
  return viewer + "#!" + percent_encoded(state.dump());
}

}  // namespace mw::cli
