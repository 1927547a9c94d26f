// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Which labels a mesh holds.
#include "engine/output/label_choice.h"

#include <string>

#include "kernels/core/error.h"

namespace mw::engine {
namespace {

void require_label(RawLabel label, const io::LabelTable& table, const char* option) {
  if (table.contains(label)) return;
  const std::string digits =
      table.is_signed() ? std::to_string(static_cast<std::int64_t>(label)) : std::to_string(label);
  throw Error(ErrorKind::kUsage, std::string(option) + ": the volume has no label " + digits);
}

}  // namespace

void check_choice(const LabelChoice& choice) {
  if (choice.labels && choice.background) {
    throw Error(ErrorKind::kUsage, "--labels and --background: give one of them, not both");
  }
}

WantedLabel wanted_labels(const LabelChoice& choice, const io::LabelTable& table) {
  if (!choice.labels && !choice.background) return {};
  if (choice.background) {
    require_label(*choice.background, table, "--background");
    if (table.size() == 1) throw Error(ErrorKind::kUsage, "--background: it is the only label");
    return [left_out = *choice.background](RawLabel label) { return label != left_out; };
  }
  for (const RawLabel label : *choice.labels) require_label(label, table, "--labels");
  const io::LabelTable kept(*choice.labels, table.is_signed());
  return [kept](RawLabel label) { return kept.contains(label); };
}

}  // namespace mw::engine
