// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// A volume in which some labels have become others.
#include "io/labels/merged_volume.h"

#include <algorithm>
#include <map>

#include "io/file/errors.h"
#include "io/labels/label_runs.h"

namespace mw::io {
namespace {

LabelTable table_of(const std::vector<MergeRule>& rules, bool is_signed) {
  std::vector<RawLabel> all;
  for (const MergeRule& rule : rules) all.insert(all.end(), rule.from.begin(), rule.from.end());
  LabelTable table(all, is_signed);
  if (table.size() == all.size()) return table;
  std::sort(all.begin(), all.end());
  const RawLabel twice = *std::adjacent_find(all.begin(), all.end());
  fail_usage("--merge: label ", label_text(twice, is_signed), " is to be merged twice");
}

/// Checks that labels of the volume, whose 64 bits are signed or unsigned numbers, can be `to`.
void check_target(const MergeRule& rule, bool is_signed) {
  const bool is_high = rule.to >> 63U != 0;
  if (is_high && is_signed != rule.to_is_negative) {
    fail_usage("--merge: ", label_text(rule.to, rule.to_is_negative), ": labels of the volume are ",
               is_signed ? "signed, below 2^63" : "not negative");
  }
}

void require_labels(const LabelVolume& volume, const LabelTable& wanted) {
  std::vector<bool> found(wanted.size());
  std::size_t missing = wanted.size();
  std::vector<RawLabel> buffer;
  for_each_z_slab({{0, 0, 0}, volume.info().shape}, kSlabVoxels, [&](const Box3& slab) {
    if (missing == 0) return;
    buffer.resize(static_cast<std::size_t>(slab.voxels()));
    volume.read(slab, buffer);
    RawLabel last = ~buffer[0];
    for (const RawLabel label : buffer) {
      if (label == last) continue;
      last = label;
      if (!wanted.contains(label) || found[wanted.dense(label)]) continue;
      found[wanted.dense(label)] = true;
      --missing;
    }
  });
  if (missing == 0) return;
  const auto first = std::find(found.begin(), found.end(), false) - found.begin();
  fail_usage("--merge: the volume has no label ",
             label_text(wanted.raw(static_cast<Label>(first)), wanted.is_signed()));
}

}  // namespace

MergedVolume::MergedVolume(const LabelVolume& volume, const std::vector<MergeRule>& rules)
    : VolumeView(volume),
      info_(volume.info()),
      from_(table_of(rules, has_signed_labels(volume.info()))) {
  to_.resize(from_.size());
  std::map<RawLabel, RawLabel> becomes;
  for (const MergeRule& rule : rules) {
    check_target(rule, from_.is_signed());
    for (const RawLabel label : rule.from) {
      to_[from_.dense(label)] = rule.to;
      becomes[label] = rule.to;
    }
  }
  require_labels(volume, from_);
  info_.masks = merged_masks(info_.masks, becomes);
}

void MergedVolume::read(const Box3& box, std::span<RawLabel> out) const {
  below().read(box, out);
  if (out.empty()) return;
  RawLabel last = out[0];
  RawLabel becomes = merged(last);
  for (RawLabel& label : out) {
    if (label != last) {
      last = label;
      becomes = merged(last);
    }
    label = becomes;
  }
}

std::vector<RawLabel> merged_labels(std::vector<RawLabel> labels,
                                    const std::vector<MergeRule>& rules) {
  for (RawLabel& label : labels) {
    const auto rule = std::find_if(rules.begin(), rules.end(), [&](const MergeRule& r) {
      return std::find(r.from.begin(), r.from.end(), label) != r.from.end();
    });
    if (rule != rules.end()) label = rule->to;
  }
  std::sort(labels.begin(), labels.end());
  labels.erase(std::unique(labels.begin(), labels.end()), labels.end());
  return labels;
}

}  // namespace mw::io
