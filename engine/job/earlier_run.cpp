// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Steps as a word for the kind of step, then its numbers; and the comparison of boxes.
#include "engine/job/earlier_run.h"

#include <sstream>

#include "engine/store/journal/identity.h"
#include "engine/store/journal/work_file.h"
#include "io/file/errors.h"

namespace mw::engine {
namespace {

std::string numbers(const std::vector<RawLabel>& labels) {
  std::string out;
  for (const RawLabel label : labels) out += " " + std::to_string(label);
  return out;
}

/// Reads the labels up to the end of the line.
std::vector<RawLabel> labels_of(std::istream& line) {
  std::vector<RawLabel> out;
  for (RawLabel label = 0; line >> label;) out.push_back(label);
  return out;
}

/// Reads a line of text_of().  Returns false if it is none.
bool read_step(std::istream& line, io::InputSteps& steps) {
  std::string kind;
  line >> kind;
  if (kind == "merge") {
    io::MergeRule rule;
    if (!(line >> rule.to_is_negative >> rule.to)) return false;
    rule.from = labels_of(line);
    steps.merge.push_back(std::move(rule));
  } else if (kind == "specks") {
    io::SpeckRule& rule = steps.specks.emplace();
    return !(line >> rule.min >> rule.diagonal).fail();
  } else if (kind == "interpolate") {
    steps.interpolate = true;
  } else if (kind == "weld") {
    steps.weld = labels_of(line);
  } else {
    return false;
  }
  return line.eof();
}

}  // namespace

std::string text_of(const io::InputSteps& steps) {
  std::ostringstream out;
  for (const io::MergeRule& rule : steps.merge) {
    out << "merge " << rule.to_is_negative << " " << rule.to << numbers(rule.from) << "\n";
  }
  if (steps.specks) out << "specks " << steps.specks->min << " " << steps.specks->diagonal << "\n";
  if (steps.interpolate) out << "interpolate\n";
  if (!steps.weld.empty()) out << "weld" << numbers(steps.weld) << "\n";
  return out.str();
}

io::InputSteps steps_of(const std::string& text) {
  io::InputSteps out;
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) {
    std::istringstream words(line);
    if (!read_step(words, out)) throw DamagedWork("steps of the labels", "unknown: " + line);
  }
  return out;
}

void check_object_box(const io::VolumeInfo& volume, const MeshJob& job) {
  const std::filesystem::path& folder = job.run.keep.folder;
  if (!job.ends_around_object || folder.empty()) return;
  const std::string different = place_differences(folder, volume);
  if (different.empty()) return;
  io::fail_usage(folder.string(), ": was kept of another box: the one that --object finds ",
                 "is no longer the same (", different,
                 "); delete the folder and begin it by --keep; with --labels and a wider "
                 "--crop instead of --object, the box stays from edit to edit");
}

}  // namespace mw::engine
