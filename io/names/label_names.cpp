// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// What labels are called, and the colours they are shown in.
#include "io/names/label_names.h"

#include <algorithm>

#include "io/names/clean_name.h"

namespace mw::io {
namespace {

bool comes_before(const LabelName& a, const LabelName& b) {
  return a.label < b.label;
}

/// Leaves the last row of each label.  REQUIRES: rows of a label are neighbours.
void keep_last_of_each(std::vector<LabelName>& rows) {
  const auto first = std::unique(rows.rbegin(), rows.rend(),
                                 [](const auto& a, const auto& b) { return a.label == b.label; });
  rows.erase(rows.begin(), first.base());
}

}  // namespace

LabelNames::LabelNames(std::vector<LabelName> rows) {
  for (LabelName& row : rows) {
    row.name = clean_name(row.name);
    if (row.colour == Colour{}) row.colour.reset();
  }
  std::erase_if(rows, [](const LabelName& row) { return row.name.empty() && !row.colour; });
  if (rows.empty()) return;
  std::stable_sort(rows.begin(), rows.end(), comes_before);
  keep_last_of_each(rows);
  rows_ = std::make_shared<const std::vector<LabelName>>(std::move(rows));
}

std::span<const LabelName> LabelNames::rows() const {
  if (!rows_) return {};
  return *rows_;
}

const LabelName* LabelNames::find(RawLabel label) const {
  const auto all = rows();
  const auto found =
      std::lower_bound(all.begin(), all.end(), LabelName{.label = label}, comes_before);
  return found != all.end() && found->label == label ? &*found : nullptr;
}

const std::string& LabelNames::name(RawLabel label) const {
  static const std::string none;
  const LabelName* row = find(label);
  return row == nullptr ? none : row->name;
}

LabelNames LabelNames::merged_with(const LabelNames& others) const {
  if (empty()) return others;
  if (others.empty()) return *this;
  std::vector<LabelName> all(rows().begin(), rows().end());
  for (LabelName row : others.rows()) {
    if (const LabelName* ours = find(row.label)) {
      if (row.name.empty()) row.name = ours->name;
      if (!row.colour) row.colour = ours->colour;
    }
    all.push_back(std::move(row));
  }
  return LabelNames(std::move(all));
}

LabelNames LabelNames::only(const std::function<bool(RawLabel)>& wanted) const {
  std::vector<LabelName> kept;
  for (const LabelName& row : rows()) {
    if (wanted(row.label)) kept.push_back(row);
  }
  return LabelNames(std::move(kept));
}

std::uint64_t LabelNames::bytes() const {
  std::uint64_t sum = 0;
  for (const LabelName& row : rows()) sum += sizeof row + row.name.capacity() + 1;
  return sum;
}

}  // namespace mw::io
