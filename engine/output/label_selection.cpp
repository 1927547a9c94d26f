// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Which labels a mesh holds, and a block without the others.
#include "engine/output/label_selection.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <string>
#include <string_view>

#include "io/file/errors.h"

namespace mw::engine {
namespace {

/// What nnU-Net, ITK-SNAP and FreeSurfer call label 0, in small letters.
constexpr std::array<std::string_view, 3> kNothing{"background", "clear label", "unknown"};

void require_label(RawLabel label, const io::LabelTable& table, const char* option) {
  if (table.contains(label)) return;
  const std::string digits =
      table.is_signed() ? std::to_string(static_cast<std::int64_t>(label)) : std::to_string(label);
  io::fail_usage(std::string(option) + ": the volume has no label " + digits);
}

}  // namespace

LabelSelection::LabelSelection(const WantedLabel& wanted, const io::LabelTable& table) {
  if (!wanted) return;
  for (std::size_t label = 0; label < table.size(); ++label) {
    wanted_.push_back(wanted(table.raw(static_cast<Label>(label))));
  }
}

void LabelSelection::apply(BlockMesh& block) const {
  if (wanted_.empty()) return;
  block.samples.clear();
  std::erase_if(block.tets, [&](const BlockTet& t) { return !wanted_[t.label]; });
  std::vector<bool> used(block.vertices.size());
  for (const BlockTet& t : block.tets) {
    for (const std::uint32_t v : t.vertices) used[v] = true;
  }
  std::vector<std::uint32_t> row(used.size());
  std::uint32_t kept = 0;
  for (std::size_t v = 0; v < used.size(); ++v) {
    row[v] = kept;
    if (used[v]) block.vertices[kept++] = block.vertices[v];
  }
  block.vertices.resize(kept);
  for (BlockTet& t : block.tets) {
    for (std::uint32_t& v : t.vertices) v = row[v];
  }
}

bool is_zero_nothing(const io::LabelTable& table, const io::LabelNames& names) {
  if (!table.contains(0) || table.size() < 2) return false;
  std::string zero = names.name(0);
  std::ranges::transform(zero, zero.begin(), [](unsigned char c) { return std::tolower(c); });
  if (!zero.empty()) return std::ranges::find(kNothing, zero) != kNothing.end();
  for (Label label = 0; label < table.size(); ++label) {
    if (table.raw(label) != 0 && names.name(table.raw(label)).empty()) return false;
  }
  return true;
}

void check_choice(const LabelChoice& choice) {
  if (choice.labels && (choice.background || choice.keeps_zero)) {
    io::fail_usage("--labels and --background: give one of them, not both");
  }
}

WantedLabel wanted_labels(const LabelChoice& choice, const io::LabelTable& table) {
  if (!choice.labels && !choice.background) return {};
  if (choice.background) {
    require_label(*choice.background, table, "--background");
    if (table.size() == 1) io::fail_usage("--background: it is the only label");
    return [left_out = *choice.background](RawLabel label) { return label != left_out; };
  }
  for (const RawLabel label : *choice.labels) require_label(label, table, choice.labels_option);
  const io::LabelTable kept(*choice.labels, table.is_signed());
  return [kept](RawLabel label) { return kept.contains(label); };
}

}  // namespace mw::engine
