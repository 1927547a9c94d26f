// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Names and numbers of groups, and the labels of masks.
#include "io/mesh/grouped/group_names.h"

#include <algorithm>
#include <optional>
#include <unordered_map>
#include <unordered_set>

#include "io/file/errors.h"
#include "io/mesh/grouped/plain_names.h"
#include "io/names/csv_names.h"

namespace mw::io {
namespace {

/// Returns for each name whether it is one, is not too long, and no other is the same.
std::vector<char> are_kept(const std::vector<std::string>& names, std::size_t max_bytes) {
  std::unordered_map<std::string_view, std::size_t> uses;
  for (const std::string& name : names) ++uses[name];
  std::vector<char> out;
  for (const std::string& name : names) {
    out.push_back(!name.empty() && name.size() <= max_bytes && uses[name] == 1 ? 1 : 0);
  }
  return out;
}

}  // namespace

const char* side_name(Side side) {
  constexpr std::array<const char*, kSides> kNames{"interface", "x_min", "x_max", "y_min",
                                                   "y_max",     "z_min", "z_max", "outer"};
  return kNames[static_cast<std::size_t>(side)];
}

std::string label_digits(const LabelTable& table, Label rank) {
  return label_text(table.raw(rank), table.is_signed());
}

GroupNames::GroupNames(const GroupedMesh& mesh, const Spelling& spelled, std::size_t max_bytes)
    : table_(mesh.table()) {
  for (Label rank = 0; rank < table_.size(); ++rank) {
    const std::string& name = mesh.names().name(table_.raw(rank));
    volumes_.push_back(spelled ? spelled(name) : name);
  }
  const std::vector<char> kept = are_kept(volumes_, max_bytes);
  std::unordered_set<std::string_view> taken;
  for (Label rank = 0; rank < table_.size(); ++rank) {
    if (kept[rank] != 0) taken.insert(volumes_[rank]);
  }
  for (Label rank = 0; rank < table_.size(); ++rank) {
    std::string& name = volumes_[rank];
    if (kept[rank] == 0) {
      const std::string behind = text(" (", label_digits(table_, rank), ")");
      name = name.empty() ? "label_" + label_digits(table_, rank) : name + behind;
      if (name.size() > max_bytes) name = plain_volume_name(table_, rank);
      while (taken.contains(name)) name += behind;
      taken.insert(name);
    }
    if (name.find('|') != std::string::npos) barred_.insert(name);
  }
  name_masks(mesh, spelled, max_bytes, {volumes_.begin(), volumes_.end()});
}

void GroupNames::name_masks(const GroupedMesh& mesh, const Spelling& spelled, std::size_t max_bytes,
                            std::set<std::string> taken) {
  const std::vector<MaskGroup> masks = mask_groups(mesh);
  std::optional<PlainNames> plain;  // made where a name is too long, as it looks at all interfaces
  for (std::size_t i = 0; i < masks.size(); ++i) {
    std::string name = std::string(kMaskNames) + (spelled ? spelled(masks[i].name) : masks[i].name);
    if (name.size() > max_bytes) {
      if (!plain) plain.emplace(mesh);
      name = plain->mask(i);
    }
    while (!taken.insert(name).second) name += '_';
    masks_.push_back(std::move(name));
  }
}

/// Where no name has a '|', that of an interface has one, which says what both labels are called.
/// The others end in different labels, and have two or more.
std::string GroupNames::facets(const FacetGroup& group) const {
  if (group.side != Side::kInterface) return side_name(group.side);
  std::string name = volume(group.first) + "|" + volume(group.second);
  bool is_taken = is_barred(group.first) || is_barred(group.second) || barred_.contains(name);
  while (is_taken) {
    name +=
        text(" (", label_digits(table_, group.first), "|", label_digits(table_, group.second), ")");
    is_taken = barred_.contains(name);
  }
  return name;
}

std::filesystem::path facet_table_path(const std::filesystem::path& mesh) {
  return std::filesystem::path(mesh).replace_extension(".facets.csv");
}

void append_facet_table(AtomicFile& file, const GroupedMesh& mesh, const GroupNames& names) {
  file.append("number,name,side,first,second\n");
  const auto label = [&](Label rank) {
    return rank == kExterior ? std::string() : label_digits(mesh.table(), rank);
  };
  for_each_numbered(mesh, names, [&](const NumberedFacets& run) {
    file.append(text(run.number, ",", csv_quoted(run.name), ",", side_name(run.side), ",",
                     label(run.first), ",", label(run.second), "\n"));
  });
}

std::vector<MaskGroup> mask_groups(const GroupedMesh& mesh) {
  std::vector<MaskGroup> out;
  for (const MaskLabels& mask : mesh.header().record.masks) {
    MaskGroup group{.name = mask.name, .ranks = {}};
    for (const RawLabel label : mask.labels) {
      if (mesh.table().contains(label)) group.ranks.push_back(mesh.table().dense(label));
    }
    std::sort(group.ranks.begin(), group.ranks.end());
    if (!group.ranks.empty()) out.push_back(std::move(group));
  }
  return out;
}

std::vector<std::string> mask_arrays(const MeshHeader& header) {
  std::set<std::string> taken(header.values.begin(), header.values.end());
  std::vector<std::string> out;
  for (const MaskLabels& mask : header.record.masks) {
    std::string name = std::string(kMaskNames) + mask.name;
    std::replace(name.begin(), name.end(), '/', '_');
    while (!taken.insert(name).second) name += '_';
    out.push_back(std::move(name));
  }
  return out;
}

}  // namespace mw::io
