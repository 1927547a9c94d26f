// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// What groups of tets and facets are called in files of programs that allow few characters.
#include "io/mesh/grouped/plain_names.h"

#include <cctype>

#include "io/file/errors.h"
#include "io/file/scratch/external_sort.h"
#include "io/mesh/grouped/group_names.h"
#include "kernels/core/mix_bits.h"

namespace mw::io {
namespace {

std::string plain_digits(const LabelTable& table, Label rank) {
  std::string digits = label_digits(table, rank);
  if (digits.front() == '-') digits.front() = 'M';
  return digits;
}

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

/// Returns the name's beginning with "_NUMBER" behind it, or "_NUMBER_2" and so on.
/// REQUIRES: this is not longer than max_bytes.
std::string with_number(const std::string& name, const std::string& number, int count,
                        std::size_t max_bytes) {
  const std::string behind = text("_", number, count == 1 ? std::string() : text("_", count));
  return name.substr(0, max_bytes - behind.size()) + behind;
}

}  // namespace

std::string plain_name(std::string_view name, const NameRule& rule) {
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

std::string plain_volume_name(const LabelTable& table, Label rank) {
  return "LABEL_" + plain_digits(table, rank);
}

std::string plain_facet_name(const LabelTable& table, const FacetGroup& group) {
  if (group.side == Side::kInterface) {
    return "FACE_" + plain_digits(table, group.first) + "_" + plain_digits(table, group.second);
  }
  return in_capitals(side_name(group.side));
}

PlainNames::PlainNames(const GroupedMesh& mesh, const NameRule& rule) : mesh_(mesh), rule_(rule) {
  Taken taken;
  for (std::size_t side = 0; side < kSides; ++side) {
    for (const Kind kind : {Kind::kFacets, Kind::kTriangles}) {
      taken.insert(in_capitals(side_text(kind, static_cast<Side>(side))));
    }
  }
  for (const std::string& name : rule.reserved) taken.insert(in_capitals(name));
  name_volumes(taken);
  name_masks(taken);
  tell_pairs_apart(taken);
}

void PlainNames::name_volumes(Taken& taken) {
  const LabelTable& table = mesh_.table();
  std::map<std::string, std::size_t> uses;
  for (Label rank = 0; rank < table.size(); ++rank) {
    volumes_.push_back(plain_name(mesh_.names().name(table.raw(rank)), rule_));
    has_name_.push_back(!volumes_.back().empty());
    if (volumes_.back().empty()) volumes_.back() = plain_volume_name(table, rank);
    ++uses[in_capitals(volumes_.back())];
  }
  for (Label rank = 0; rank < table.size(); ++rank) {
    const std::string number = plain_digits(table, rank);
    std::string& name = volumes_[rank];
    if (uses[in_capitals(name)] > 1) name += "_" + number;
    const std::string wanted = name;
    for (int i = 1; name.size() > rule_.max_bytes || !taken.insert(in_capitals(name)).second; ++i) {
      name = with_number(wanted, number, i, rule_.max_bytes);
    }
  }
}

void PlainNames::name_masks(Taken& taken) {
  for (const MaskGroup& mask : mask_groups(mesh_)) {
    const std::string number = std::to_string(masks_.size() + 1);
    const std::string plain = plain_name(mask.name, rule_);
    const std::string wanted = "MASK_" + (plain.empty() ? number : plain);
    std::string name = wanted;
    for (int i = 1; name.size() > rule_.max_bytes || !taken.insert(in_capitals(name)).second; ++i) {
      name = with_number(wanted, number, i, rule_.max_bytes);
    }
    masks_.push_back(std::move(name));
  }
}

/// Gives the pairs whose name is taken or another pair's the next one that they may have, until
/// all differ.  Names are compared by their hashes, so that they need not be kept: should two have
/// one by chance, a name has a number that it would not need.
void PlainNames::tell_pairs_apart(const Taken& taken) {
  constexpr std::size_t kSortBytes = 8 << 20;
  bool is_changed = true;
  while (is_changed) {
    is_changed = false;
    const auto change = [&](const Pair& pair) {
      ++renamed_[pair];
      is_changed = true;
    };
    ExternalSort<4> names(mesh_.folder(), kSortBytes);
    for_each_pair([&](const Pair& pair) {
      const std::string name = in_capitals(name_of(pair));
      if (taken.contains(name)) change(pair);
      names.add({mix_text(name), static_cast<std::uint64_t>(pair.kind), pair.from, pair.to});
    });
    std::uint64_t last = 0;
    bool is_first = true;
    names.each([&](const std::array<std::uint64_t, 4>& name) {
      if (!is_first && name[0] == last) {
        change(
            {static_cast<Kind>(name[1]), static_cast<Label>(name[2]), static_cast<Label>(name[3])});
      }
      is_first = false;
      last = name[0];
    });
  }
}

template <class Visit>
void PlainNames::for_each_pair(Visit visit) const {
  for (const FacetGroup& group : mesh_.facet_groups()) {
    if (group.side != Side::kInterface) continue;
    for (const Kind kind : {Kind::kFacets, Kind::kTriangles}) {
      if (kind == Kind::kTriangles && rule_.of_triangles.empty()) continue;
      visit(Pair{kind, group.first, group.second});
      visit(Pair{kind, group.second, group.first});
    }
  }
  for (const WedgeGroup& group : mesh_.wedge_groups()) {
    visit(Pair{Kind::kWedges, group.bottom, group.top});
  }
}

std::string PlainNames::side_text(Kind kind, Side side) const {
  const std::string name = in_capitals(side_name(side));
  return kind == Kind::kTriangles ? rule_.of_triangles + name : name;
}

/// Returns "FACE_a_b" or the like, with the names or numbers of both labels.
std::string PlainNames::pair_text(const Pair& pair) const {
  const auto part = [&](Label rank) {
    return has_name_[rank] ? volumes_[rank] : plain_digits(mesh_.table(), rank);
  };
  const std::string of_triangles = pair.kind == Kind::kTriangles ? rule_.of_triangles : "";
  return text(of_triangles, pair.kind == Kind::kWedges ? kWedgeNames : "FACE_", part(pair.from),
              "_", part(pair.to));
}

std::string PlainNames::name_of(const Pair& pair) const {
  constexpr std::size_t kOfCount = 12;  // room for "_" before the number and "_2" behind it
  const std::string wanted = pair_text(pair);
  const bool is_short = wanted.size() <= rule_.max_bytes;
  const auto found = renamed_.find(pair);
  const int changes = (found == renamed_.end() ? 0 : found->second) + (is_short ? 0 : 1);
  if (changes == 0) return wanted;
  std::string number =
      text(plain_digits(mesh_.table(), pair.from), "_", plain_digits(mesh_.table(), pair.to));
  // The ranks of labels are shorter than labels of 64 bits.
  if (number.size() + kOfCount > rule_.max_bytes) number = text(pair.from, "_", pair.to);
  return with_number(wanted, number, changes, rule_.max_bytes);
}

std::string PlainNames::name_of(Kind kind, const FacetGroup& group, bool of_second) const {
  if (group.side != Side::kInterface) return side_text(kind, group.side);
  return of_second ? name_of({kind, group.second, group.first})
                   : name_of({kind, group.first, group.second});
}

std::string PlainNames::wedges(const WedgeGroup& group) const {
  return name_of({Kind::kWedges, group.bottom, group.top});
}

}  // namespace mw::io
