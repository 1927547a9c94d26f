// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// What groups of tets and facets are called in files that know names, and their numbers in other
// files.
#include "io/mesh/grouped/group_names.h"

#include <cctype>
#include <unordered_map>
#include <unordered_set>

#include "io/file/errors.h"
#include "io/names/csv_names.h"

namespace mw::io {
namespace {

std::string plain_digits(const LabelTable& table, Label rank) {
  std::string digits = label_digits(table, rank);
  if (digits.front() == '-') digits.front() = 'M';
  return digits;
}

constexpr std::int64_t kFirstInterface = kSides;

bool is_letter(char c) {
  return (c >= 'A' && c <= 'Z') || (c >= 'a' && c <= 'z');
}

bool is_plain(char c, const NameRule& rule) {
  return is_letter(c) || (c >= '0' && c <= '9') || c == '_' || (c == '-' && rule.allows_dash);
}

std::string in_capitals(std::string name) {
  for (char& c : name) c = static_cast<char>(std::toupper(static_cast<unsigned char>(c)));
  return name;
}

/// Returns the name with '_' for each gap of characters that are not allowed; empty if none is.
std::string plain_text(std::string_view name, const NameRule& rule) {
  std::string out;
  bool gap = false;
  for (const char c : name) {
    gap = gap || !is_plain(c, rule);
    if (!is_plain(c, rule)) continue;
    if (gap && !out.empty()) out += '_';
    gap = false;
    out += c;
  }
  return out.empty() || is_letter(out.front()) ? out : "L_" + out;
}

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

std::string plain_volume_name(const LabelTable& table, Label rank) {
  return "LABEL_" + plain_digits(table, rank);
}

std::string plain_facet_name(const LabelTable& table, const FacetGroup& group) {
  if (group.side == Side::kInterface) {
    return "FACE_" + plain_digits(table, group.first) + "_" + plain_digits(table, group.second);
  }
  return in_capitals(side_name(group.side));
}

PlainNames::PlainNames(const GroupedMesh& mesh, const NameRule& rule) : rule_(rule) {
  for (std::size_t side = 0; side < kSides; ++side) {
    taken_.insert(in_capitals(side_name(static_cast<Side>(side))));
  }
  for (const std::string& name : rule.reserved) taken_.insert(in_capitals(name));
  name_volumes(mesh);
  for (const FacetGroup& group : mesh.facet_groups()) {
    if (group.side != Side::kInterface) continue;
    name_interface(mesh, group.first, group.second);
    name_interface(mesh, group.second, group.first);
  }
  for (const WedgeGroup& group : mesh.wedge_groups()) {
    wedges_.push_back(take(text(kWedgeNames, pair_text(mesh, group.bottom, group.top)),
                           text(plain_digits(mesh.table(), group.bottom), "_",
                                plain_digits(mesh.table(), group.top))));
  }
}

void PlainNames::name_volumes(const GroupedMesh& mesh) {
  const LabelTable& table = mesh.table();
  std::vector<std::string> wanted;
  std::map<std::string, std::size_t> uses;
  for (Label rank = 0; rank < table.size(); ++rank) {
    wanted.push_back(plain_text(mesh.names().name(table.raw(rank)), rule_));
    if (wanted.back().empty()) wanted.back() = plain_volume_name(table, rank);
    ++uses[in_capitals(wanted.back())];
  }
  for (Label rank = 0; rank < table.size(); ++rank) {
    const std::string number = plain_digits(table, rank);
    const bool only_one = uses[in_capitals(wanted[rank])] == 1;
    volumes_.push_back(take(only_one ? wanted[rank] : wanted[rank] + "_" + number, number));
  }
}

void PlainNames::name_interface(const GroupedMesh& mesh, Label from, Label to) {
  interfaces_[{from, to}] =
      take("FACE_" + pair_text(mesh, from, to),
           text(plain_digits(mesh.table(), from), "_", plain_digits(mesh.table(), to)));
}

std::string PlainNames::pair_text(const GroupedMesh& mesh, Label one, Label other) const {
  const LabelTable& table = mesh.table();
  const auto part = [&](Label rank) {
    const bool named = !plain_text(mesh.names().name(table.raw(rank)), rule_).empty();
    return named ? volumes_[rank] : plain_digits(table, rank);
  };
  return text(part(one), "_", part(other));
}

std::string PlainNames::take(const std::string& wanted, const std::string& number) {
  const std::size_t max = rule_.max_bytes;
  std::string name = wanted;
  for (int i = 1; name.size() > max || !taken_.insert(in_capitals(name)).second; ++i) {
    std::string behind = text("_", number, i == 1 ? std::string() : text("_", i));
    if (behind.size() >= max) behind = text("_", i);
    name = wanted.substr(0, max - behind.size()) + behind;
  }
  return name;
}

std::string PlainNames::facets(const FacetGroup& group, bool of_second) const {
  if (group.side != Side::kInterface) return in_capitals(side_name(group.side));
  return interfaces_.at(of_second ? std::pair(group.second, group.first)
                                  : std::pair(group.first, group.second));
}

std::vector<NumberedFacets> number_facets(const GroupedMesh& mesh) {
  const GroupNames names(mesh);
  std::vector<NumberedFacets> out;
  std::int64_t next = kFirstInterface;
  for (const FacetGroup& group : mesh.facet_groups()) {
    const bool interface = group.side == Side::kInterface;
    if (!interface && !out.empty() && out.back().side == group.side) {
      out.back().facets.end = group.facets.end;
      continue;
    }
    out.push_back({.number = interface ? next++ : static_cast<std::int64_t>(group.side),
                   .name = names.facets(group),
                   .side = group.side,
                   .first = interface ? group.first : kExterior,
                   .second = group.second,
                   .facets = group.facets});
  }
  return out;
}

std::filesystem::path facet_table_path(const std::filesystem::path& mesh) {
  return std::filesystem::path(mesh).replace_extension(".facets.csv");
}

void append_facet_table(AtomicFile& file, const LabelTable& table,
                        const std::vector<NumberedFacets>& facets) {
  file.append("number,name,side,first,second\n");
  const auto label = [&](Label rank) {
    return rank == kExterior ? std::string() : label_digits(table, rank);
  };
  for (const NumberedFacets& run : facets) {
    file.append(text(run.number, ",", csv_quoted(run.name), ",", side_name(run.side), ",",
                     label(run.first), ",", label(run.second), "\n"));
  }
}

}  // namespace mw::io
