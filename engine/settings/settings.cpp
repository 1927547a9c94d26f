// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Which settings make sense.
#include "engine/settings/settings.h"

#include <algorithm>
#include <limits>
#include <string>

#include "engine/settings/setting_table.h"
#include "io/file/errors.h"

namespace mw::engine {

int largest_cell_level(const MeshSettings& s) {
  constexpr int kMaxLevel = 4;
  if (s.start == StartMesh::kDense) return 0;
  const int block = s.window / 2;
  int level = 0;
  while (level < kMaxLevel && block % (2 << level) == 0) ++level;
  return level;
}

double SizeRules::least() const {
  double out = others.value_or(std::numeric_limits<double>::infinity());
  for (const LabelSize& s : labels) out = std::min(out, s.edge);
  for (const InterfaceSize& s : interfaces) out = std::min(out, s.edge);
  return out;
}

std::optional<double> SizeRules::of_label(RawLabel label) const {
  const auto listed =
      std::lower_bound(labels.begin(), labels.end(), label,
                       [](const LabelSize& s, RawLabel wanted) { return s.label < wanted; });
  if (listed != labels.end() && listed->label == label) return listed->edge;
  return others;
}

std::optional<double> SizeRules::of_interface(RawLabel a, RawLabel b) const {
  using Side = std::optional<RawLabel>;
  const auto listed = [&](Side low, Side high) {
    const auto at =
        std::ranges::lower_bound(interfaces, std::pair(low, high), {},
                                 [](const InterfaceSize& s) { return std::pair(s.low, s.high); });
    const bool is_there = at != interfaces.end() && at->low == low && at->high == high;
    return is_there ? std::optional(at->edge) : std::nullopt;
  };
  if (const auto pair = listed(std::min(a, b), std::max(a, b))) return pair;
  const auto of_a = listed({}, a), of_b = listed({}, b);
  if (of_a && of_b) return std::min(*of_a, *of_b);
  if (of_a || of_b) return of_a ? of_a : of_b;
  return listed({}, {});
}

SizeRules SizeRules::scaled(double factor) const {
  SizeRules out = *this;
  if (out.others) *out.others *= factor;
  for (LabelSize& s : out.labels) s.edge *= factor;
  for (InterfaceSize& s : out.interfaces) s.edge *= factor;
  return out;
}

SizeRules SizeRules::in_physical_units(double voxel) const {
  if (!in_voxels) return *this;
  SizeRules out = scaled(voxel);
  out.in_voxels = false;
  return out;
}

void check(const MeshSettings& settings) {
  for (const Setting& setting : setting_table()) {
    try {
      check(setting, settings);
    } catch (const Error& error) {
      throw Error(error.kind(),
                  setting.name + " = " + setting.text(settings) + ": " + error.what());
    }
  }
  for (const SettingRule& rule : setting_rules()) {
    if (!rule.is_kept(settings)) io::fail_usage(rule.told);
  }
}

}  // namespace mw::engine
