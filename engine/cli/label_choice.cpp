// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Which labels a mesh holds.
#include "engine/cli/label_choice.h"

#include "engine/cli/values.h"
#include "kernels/core/error.h"

namespace mw::cli {
namespace {

void require_label(RawLabel label, const io::LabelTable& table, const char* option) {
  if (table.contains(label)) return;
  throw Error(ErrorKind::kUsage, std::string(option) + ": the volume has no label " +
                                     format_label(label, table.is_signed()));
}

}  // namespace

void add_choice_options(OptionSet& options, LabelChoice& choice) {
  options.add({.name = "labels",
               .value = "LIST",
               .help = "labels of the mesh, e.g. 1,2,5; others are meshed but left out of it",
               .kind = ValueKind::kLabels,
               .assign = [&](const std::string& text) { choice.labels = parse_labels(text); }});
  options.add({.name = "background",
               .value = "L",
               .help = "label that is meshed but left out of the mesh",
               .kind = ValueKind::kLabels,
               .assign = [&](const std::string& text) { choice.background = parse_label(text); }});
}

void check_choice(const LabelChoice& choice) {
  if (choice.labels && choice.background) {
    throw Error(ErrorKind::kUsage, "--labels and --background: give one of them, not both");
  }
}

engine::WantedLabel wanted_labels(const LabelChoice& choice, const io::LabelTable& table) {
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

}  // namespace mw::cli
